//! Speeds of steady turning over a parameter: branches, folds, and motions beside them.

use super::curves::{Bend, Knot, Side, joined};
use super::formulas::Formulas;
use super::motions::{Ran, Runs, Way};
use super::show::Shown;
use super::tell::{asked_for, balance_words, gaps, json_of, nothing_repeats, several};
use crate::failure::in_words;
use crate::machine::Machine;
use crate::machine::bind::Binding;
use crate::provenance;
use crate::repeat::quantity;
use crate::results::{Body, Fact, Results};
use crate::watch::Watch;
use algebra::arrange::Arrange as _;
use analysis::dataset::{Column, Missing};
use analysis::studies::average::{Course, Steady, Summit, Turn, carried, steady, steady_again, turns};
use analysis::{Dataset, Quantity};
use mechanics::asked::{Asked, Named};
use serde_json::{Value, json};
use std::sync::Arc;
use words::{Notice, Text};

/// Speeds and values without a wish.
const POINTS: usize = 61;
/// The word for motions each of which begins where its neighbour ended.
pub(super) const NEIGHBOUR: &str = "neighbour";
/// Halvings of the way to another value on which an extreme is lost.
const HALVINGS: usize = 4;
/// Values at which the height of an extreme is looked at, to where they are neighbours.
const TRIED: usize = 60;

/// What was found along the parameter.
struct Along {
    /// Speeds of steady turning at each value.
    speeds: Vec<(f64, Vec<Steady>)>,
    folds: Vec<Fold>,
    /// The speeds joined over the folds.
    curves: Vec<Vec<Knot>>,
    /// Motions of the machine.
    runs: Vec<Ran>,
}

/// Balance that is left at a fold, as a share of its moments: what the halvings and AGREE of turns leave.
const MET: f64 = 1e-8;

/// A fold: the parameter, the turn there, and on which side of it the two speeds are.
struct Fold {
    value: f64,
    turn: Turn,
    side: Side,
}

struct Walk<'a> {
    machine: Machine,
    formulas: Formulas,
    name: &'a str,
    angle: Named,
    instant: f64,
    speeds: Vec<f64>,
    /// The answers of the value before: the numbers of the rest they belong to, and how many speeds have none; none where the formulas are others.
    before: Option<(Vec<f64>, usize)>,
    /// Speeds without a turn, at all values.
    gaps: usize,
    /// What is known of the answers, where there are most branches, and their number.
    several: (usize, Option<Text>),
    /// Intervals in which speeds appear or vanish and no fold was closed in.
    open: Vec<[f64; 2]>,
}

impl Walk<'_> {
    /// The formulas at a value.
    fn put(&mut self, value: f64) -> Result<(), Notice> {
        match self.machine.bind(&[(self.name, value)]).map_err(in_words)? {
            Binding::Numbers => self.formulas.put(&self.machine.equations)?,
            Binding::Anew => {
                self.formulas = Formulas::of(&self.machine, &self.angle, self.instant)?;
                self.before = None;
            }
        }
        Ok(())
    }

    /// The balances at a value, beside those at another: where the equations of the rest are the same, so are its answers.
    fn steady(&mut self, value: f64, old: Option<&Course>) -> Result<Course, Notice> {
        self.put(value)?;
        let basis = self.formulas.basis();
        let same = self.before.take().filter(|(before, _)| *before == basis);
        let again = same.zip(old).and_then(|((_, gaps), old)| Some((steady_again(&self.formulas, old)?, gaps)));
        let (course, gaps) = match again {
            Some(again) => again,
            None => {
                let found = turns(&self.formulas, &self.speeds);
                if found.iter().all(Option::is_none) {
                    return Err(nothing_repeats());
                }
                let course = steady(&self.formulas, &self.speeds, &found);
                let gaps = found.iter().filter(|turn| turn.is_none()).count() + course.unseen;
                (course, gaps)
            }
        };
        self.before = Some((basis, gaps));
        self.gaps += gaps;
        if course.branches.len() > self.several.0 {
            self.several = (course.branches.len(), several(&course));
        }
        Ok(course)
    }

    /// Folds between two neighbouring values: where an extreme of L passes zero. What does not add up is left open.
    fn folds(&mut self, (a, old): (f64, &Course), (b, new): (f64, &Course)) -> Result<Vec<Fold>, Notice> {
        let mut all = Vec::new();
        let mut count = old.steady.len() as isize;
        for summit in &old.summits {
            let Some(far) = self.moved(old, summit, [a, b], HALVINGS)? else { continue };
            let ends = match (summit.height() > 0.0, far.height() > 0.0) {
                (true, false) => [(a, summit.clone()), (b, far)],
                (false, true) => [(b, far), (a, summit.clone())],
                _ => continue,
            };
            let side = if ends[0].0 == a { Side::Before } else { Side::Behind };
            count += if side == Side::Before { -2 } else { 2 };
            all.extend(self.fold(old, (ends, side))?);
        }
        if count != new.steady.len() as isize {
            self.open.push([a, b]);
        }
        all.arrange_by(|x: &Fold, y: &Fold| ((x.value - a) * (b - a)).total_cmp(&((y.value - a) * (b - a))));
        Ok(all)
    }

    /// An extreme at another value; none where it is lost on the way.
    fn moved(&mut self, course: &Course, summit: &Summit, [from, to]: [f64; 2], halvings: usize) -> Result<Option<Summit>, Notice> {
        self.put(to)?;
        let found = carried(&self.formulas, course, summit);
        if found.is_some() || halvings == 0 {
            return Ok(found);
        }
        let middle = 0.5 * (from + to);
        match self.moved(course, summit, [from, middle], halvings - 1)? {
            Some(half) => self.moved(course, &half, [middle, to], halvings - 1),
            None => Ok(None),
        }
    }

    /// Where the height of an extreme passes zero between two values: the secant, with the weight of an end that stays halved (Illinois).
    fn fold(&mut self, course: &Course, ([mut with, mut without], side): ([(f64, Summit); 2], Side)) -> Result<Option<Fold>, Notice> {
        let mut weights = [with.1.height(), without.1.height()];
        let mut kept = None;
        for k in 0..TRIED {
            let (a, b) = (with.0, without.0);
            // some hundred roundings of a value
            if (b - a).abs() <= 1e-13 * a.abs().max(b.abs()) {
                break;
            }
            let secant = b - weights[1] * (b - a) / (weights[1] - weights[0]);
            let inside = secant.is_finite() && (secant - a) * (secant - b) < 0.0;
            let middle = if inside && k % 8 != 7 { secant } else { 0.5 * (a + b) };
            let near = if (middle - a).abs() < (middle - b).abs() { &with } else { &without };
            let Some(summit) = self.moved(course, &near.1.clone(), [near.0, middle], HALVINGS)? else { return Ok(None) };
            let height = summit.height();
            let end = usize::from(height <= 0.0);
            let stands = (if end == 1 { &without } else { &with }).0 == middle;
            *(if end == 1 { &mut without } else { &mut with }) = (middle, summit);
            weights[end] = height;
            weights[1 - end] *= if kept == Some(1 - end) { 0.5 } else { 1.0 };
            kept = Some(1 - end);
            if height == 0.0 || stands {
                break;
            }
        }
        let best = if with.1.height().abs() < without.1.height().abs() { with } else { without };
        let size = |turn: &Turn| turn.own.abs().max(turn.vibration.abs());
        let fold = Fold { value: best.0, turn: best.1.turn().clone(), side };
        // an end of the interval is no fold
        Ok(Some(fold).filter(|fold| fold.turn.balance().abs() <= MET * size(&fold.turn)))
    }
}

/// The letter of the shaft's speed; where the parameter itself is called Ω, the other one.
fn letter(parameter: &Quantity) -> &'static str {
    if parameter.symbol == "Ω" { "ω" } else { "Ω" }
}

/// Fills in the results.
pub(super) fn walk(machine: &mut Machine, asked: &Asked, results: &mut Results, watch: &mut Watch) -> Result<(), Notice> {
    let (angle, speeds, instant) = asked_for(asked, POINTS)?;
    let (Some(name), Some(from), Some(to)) = (asked.word("parameter"), asked.number("from"), asked.number("to")) else { return Ok(()) };
    machine.number(name)?;
    let formulas = Formulas::of(machine, &angle, instant)?;
    let count = speeds.len();
    let mut walk = Walk {
        machine: machine.clone(),
        formulas,
        name,
        angle,
        instant,
        speeds,
        before: None,
        gaps: 0,
        several: (0, None),
        open: Vec::new(),
    };
    let (mut found, mut folds): (Vec<(f64, Vec<Steady>)>, Vec<Fold>) = (Vec::new(), Vec::new());
    let mut bends = Vec::new();
    let mut last: Option<(f64, Course)> = None;
    for k in 0..count {
        if watch.is_interrupted() {
            break;
        }
        if let Some(progress) = &mut watch.progress {
            progress(k as f64 / count as f64);
        }
        let value = if k + 1 == count { to } else { from + (to - from) * k as f64 / (count - 1) as f64 };
        let course = walk.steady(value, last.as_ref().map(|(_, course)| course))?;
        if let Some((before, old)) = &last {
            let fresh = walk.folds((*before, old), (value, &course))?;
            bends.extend(fresh.iter().map(|f| Bend { behind: k - 1, value: f.value, speed: f.turn.speed, side: f.side }));
            folds.extend(fresh);
        }
        found.push((value, course.steady.clone()));
        last = Some((value, course));
    }
    let runs = match asked.number("runs") {
        Some(until) => {
            let runs = Runs { name, angle: &walk.angle.name, ends: [from, to], until };
            motions(&runs, asked, (machine, watch))?
        }
        None => Vec::new(),
    };
    let data = table(machine, name, &found, &runs);
    results.data = provenance::stamp(data, &machine.equations, &machine.model_hash);
    results.data.partial = watch.is_interrupted();
    let speeds = found.iter().map(|(value, list)| (*value, list.iter().map(|s| (s.turn.speed, s.stable)).collect()));
    let curves = joined(&speeds.collect::<Vec<_>>(), &bends);
    results.body = Body::After(Arc::new(Shown {
        speed: letter(&quantity(machine, name)).into(),
        parameter: quantity(machine, name),
        curves: curves.clone(),
        folds: folds.iter().map(|fold| [fold.value, fold.turn.speed]).collect(),
        runs: runs.clone(),
    }));
    let lacking: Vec<Text> = gaps(walk.gaps).into_iter().chain(unclosed(&walk.open)).chain(walk.several.1).collect();
    tell(machine, name, &Along { speeds: found, folds, curves, runs }, results);
    results.words.extend(lacking);
    Ok(())
}

/// The machine itself, from where each motion is to begin.
fn motions(runs: &Runs, asked: &Asked, (machine, watch): (&Machine, &mut Watch)) -> Result<Vec<Ran>, Notice> {
    match asked.word("runs_from") {
        Some(NEIGHBOUR) => runs.forth_and_back(machine, watch),
        _ => runs.motions_from_start(machine, watch),
    }
}

/// Intervals of the parameter in which the number of speeds changes without a fold that is known.
fn unclosed(list: &[[f64; 2]]) -> Option<Text> {
    let of = |language| {
        let number = |v: f64| report::number::short(v, 5, language);
        list.iter().map(|[a, b]| format!("{} … {}", number(*a), number(*b))).collect::<Vec<_>>().join("; ")
    };
    (!list.is_empty()).then(|| {
        Text::new(
            format!(
                "Speeds appear or vanish between these values, and no fold was closed in there (several at once, or speeds that leave the range): {}; take more `points`.",
                of(words::Language::En)
            ),
            format!(
                "Между этими значениями скорости появляются или исчезают, а поворотная точка не найдена (их несколько, или скорость выходит из диапазона): {}; увеличьте `points`.",
                of(words::Language::Ru)
            ),
        )
    })
}

fn table(machine: &Machine, name: &str, found: &[(f64, Vec<Steady>)], runs: &[Ran]) -> Dataset {
    let rows = found.iter().flat_map(|(value, list)| list.iter().map(move |s| (*value, s)));
    let own = |label: Text, name: &str, symbol: &str, unit: &str| Quantity { symbol: symbol.into(), label, ..Quantity::new(name, unit) };
    let stable = Text::new("stable speed", "устойчивая скорость");
    let unstable = Text::new("unstable speed", "неустойчивая скорость");
    let parameter = quantity(machine, name);
    let speed = letter(&parameter);
    let quantities = [
        parameter,
        own(stable, "stable", &format!("{speed}_s"), "rad/s"),
        own(unstable, "unstable", &format!("{speed}_u"), "rad/s"),
        own(Text::new("departure from uniform turning", "отклонение от равномерного вращения"), "ripple", "ε", "rad"),
    ];
    let ways: Vec<Way> = Way::ALL.into_iter().filter(|way| runs.iter().any(|ran| ran.way == *way)).collect();
    let of_runs = ways.iter().map(|way| own(way.label(), way.names().0, "ω", "rad/s"));
    let mut columns: Vec<Column> = quantities.into_iter().chain(of_runs).map(|quantity| Column { quantity, values: Vec::new() }).collect();
    let mut push = |row: &[f64]| {
        let values = row.iter().copied().chain(std::iter::repeat(f64::NAN));
        columns.iter_mut().zip(values).for_each(|(column, value)| column.values.push(value));
    };
    for (value, s) in rows {
        let speed = |wanted: bool| if s.stable == wanted { s.turn.speed } else { f64::NAN };
        push(&[value, speed(true), speed(false), s.turn.ripple]);
    }
    for ran in runs {
        let of = ways.iter().map(|way| if *way == ran.way { ran.speed } else { f64::NAN });
        push(&[ran.value, f64::NAN, f64::NAN, f64::NAN].into_iter().chain(of).collect::<Vec<_>>());
    }
    let mut data = Dataset { axis: None, columns, ..Dataset::default() };
    let words = Text::new(
        "a row is one speed: stable, unstable, or of a motion",
        "строка — одна скорость: устойчивая, неустойчивая или скорость движения",
    );
    let names: Vec<String> =
        data.columns[1..].iter().filter(|c| c.values.iter().any(|v| v.is_nan())).map(|c| c.quantity.name.clone()).collect();
    names.iter().for_each(|name| data.state(name, Missing::Absent, words.clone()));
    data
}

fn tell(machine: &Machine, name: &str, along: &Along, results: &mut Results) {
    let Along { speeds: found, folds, curves, runs } = along;
    let quantity = quantity(machine, name);
    for (k, fold) in folds.iter().enumerate() {
        let label = Text::new("fold: two speeds meet", "поворотная точка: две скорости сливаются");
        results.facts.push(Fact::new(&format!("fold_{}", k + 1), &quantity.symbol, &quantity.unit, fold.value, label));
        let label = Text::new("the speed there", "скорость в ней");
        results.facts.push(Fact::new(
            &format!("fold_speed_{}", k + 1),
            &format!("{}_{}", letter(&quantity), k + 1),
            "rad/s",
            fold.turn.speed,
            label,
        ));
    }
    if let Some(ripple) = found.iter().flat_map(|(_, list)| list).map(|s| s.turn.ripple).reduce(f64::max) {
        let label =
            Text::new("bound of the departure of the angle from uniform turning", "оценка сверху отклонения угла от равномерного вращения");
        results.facts.push(Fact::new("ripple", "ε", "rad", ripple, label));
    }
    results.words.push(balance_words());
    let rows = |(value, list): &(f64, Vec<Steady>)| json!({"value": value, "speeds": list.iter().map(json_of).collect::<Vec<Value>>()});
    results.own.insert("branches".into(), found.iter().map(rows).collect());
    results.own.insert("folds".into(), folds.iter().map(|f| json!({"parameter": f.value, "speed": f.turn.speed})).collect());
    results
        .own
        .insert("runs".into(), runs.iter().map(|ran| json!({"value": ran.value, "speed": ran.speed, "from": ran.way.names().1})).collect());
    let knot = |knot: &Knot| json!({"value": knot.value, "speed": knot.speed, "stable": knot.stable});
    results.own.insert("curves".into(), curves.iter().map(|curve| curve.iter().map(knot).collect::<Vec<Value>>()).collect());
}
