//! Speeds of steady turning over a parameter: branches, folds, and motions beside them.

use super::formulas::Formulas;
use super::motions::Motions;
use super::tell::{asked_for, balance_words, gaps, json_of, nothing_repeats};
use crate::failure::in_words;
use crate::machine::Machine;
use crate::machine::bind::Binding;
use crate::provenance;
use crate::repeat::quantity;
use crate::results::{Fact, Results};
use crate::watch::Watch;
use analysis::dataset::{Column, Missing};
use analysis::studies::average::{Steady, Turn, extreme, steady, turns};
use analysis::{Dataset, Quantity};
use mechanics::asked::{Asked, Named};
use mechanics::model::Plot;
use report::figure::Pen;
use serde_json::{Value, json};
use words::{Notice, Text};

/// Speeds and values without a wish.
const POINTS: usize = 61;
/// Motions that are laid beside.
const MOTIONS: usize = 13;
/// Halvings of an interval with a fold: each ends at neighbouring numbers.
const HALVINGS: usize = 60;

/// What was found along the parameter.
struct Course {
    /// Speeds of steady turning at each value.
    speeds: Vec<(f64, Vec<Steady>)>,
    folds: Vec<Fold>,
    /// Mean speeds of motions.
    motions: Vec<(f64, f64)>,
}

/// Balance that is left at a fold, as a share of its moments: what the halvings and AGREE of turns leave.
const MET: f64 = 1e-8;

/// A fold: the parameter, and the turn there.
struct Fold {
    value: f64,
    turn: Turn,
}

struct Walk<'a> {
    machine: Machine,
    formulas: Formulas,
    name: &'a str,
    angle: Named,
    instant: f64,
    speeds: Vec<f64>,
    /// Speeds without a turn, at all values.
    gaps: usize,
    /// Intervals in which speeds appear or vanish and no fold was closed in.
    open: Vec<[f64; 2]>,
}

impl Walk<'_> {
    /// The formulas at a value.
    fn put(&mut self, value: f64) -> Result<(), Notice> {
        match self.machine.bind(&[(self.name, value)]).map_err(in_words)? {
            Binding::Numbers => self.formulas.put(&self.machine.equations),
            Binding::Anew => self.formulas = Formulas::of(&self.machine, &self.angle, self.instant)?,
        }
        Ok(())
    }

    fn steady(&mut self, value: f64) -> Result<Vec<Steady>, Notice> {
        self.put(value)?;
        let found = turns(&self.formulas, &self.speeds);
        if found.iter().all(Option::is_none) {
            return Err(nothing_repeats());
        }
        self.gaps += found.iter().filter(|turn| turn.is_none()).count();
        Ok(steady(&self.formulas, &found))
    }

    /// Where two speeds that are neighbours at one value meet before another, at which they are not there.
    fn fold(&mut self, list: &[Steady], k: usize, [mut with, mut without]: [f64; 2]) -> Result<Option<Fold>, Notice> {
        let (a, b) = (list[k].turn.speed, list[k + 1].turn.speed);
        // the extreme moves with the value, by less than both speeds do; other speeds are farther
        let below = k.checked_sub(1).map_or(self.speeds[0], |k| 0.5 * (list[k].turn.speed + a));
        let above = list.get(k + 2).map_or(self.speeds[self.speeds.len() - 1], |s| 0.5 * (s.turn.speed + b));
        let (low, high) = (below.max(a - (b - a)), above.min(b + (b - a)));
        // between both the balance has the sign behind the first of them
        let sign = if list[k].stable { -1.0 } else { 1.0 };
        let mut last = None;
        for _ in 0..HALVINGS {
            let middle = 0.5 * (with + without);
            // some hundred roundings of a value
            if middle == with || middle == without || (without - with).abs() <= 1e-13 * middle.abs() {
                break;
            }
            self.put(middle)?;
            let Some(top) = extreme(&self.formulas, [low, high], sign) else { return Ok(None) };
            if sign * top.balance() > 0.0 {
                with = middle
            } else {
                without = middle
            }
            last = Some(Fold { value: middle, turn: top });
        }
        // an end of the interval is no fold
        let size = |turn: &Turn| turn.own.abs().max(turn.vibration.abs());
        Ok(last.filter(|fold| fold.turn.balance().abs() <= MET * size(&fold.turn)))
    }
}

/// Fills in the results.
pub(super) fn walk(machine: &mut Machine, asked: &Asked, results: &mut Results, watch: &mut Watch) -> Result<(), Notice> {
    let (angle, speeds, instant) = asked_for(asked, POINTS)?;
    let (Some(name), Some(from), Some(to)) = (asked.word("parameter"), asked.number("from"), asked.number("to")) else { return Ok(()) };
    machine.number(name)?;
    let formulas = Formulas::of(machine, &angle, instant)?;
    let count = speeds.len();
    let mut walk = Walk { machine: machine.clone(), formulas, name, angle, instant, speeds, gaps: 0, open: Vec::new() };
    let (mut found, mut folds): (Vec<(f64, Vec<Steady>)>, Vec<Fold>) = (Vec::new(), Vec::new());
    for k in 0..count {
        if watch.is_interrupted() {
            break;
        }
        if let Some(progress) = &mut watch.progress {
            progress(k as f64 / count as f64);
        }
        let value = if k + 1 == count { to } else { from + (to - from) * k as f64 / (count - 1) as f64 };
        let list = walk.steady(value)?;
        if let Some((before, old)) = found.last() {
            let fold = between(&mut walk, (*before, old), (value, &list))?;
            if fold.is_none() && old.len() != list.len() {
                walk.open.push([*before, value]);
            }
            folds.extend(fold);
        }
        found.push((value, list));
    }
    let motions = match asked.number("runs") {
        Some(until) => of_machine(machine, (name, &walk.angle), [from, to], (until, watch))?,
        None => Vec::new(),
    };
    let data = table(machine, name, &found, &motions);
    results.data = provenance::stamp(data, &machine.equations, &machine.model_hash);
    results.data.partial = watch.is_interrupted();
    results.pen = Pen::Dots;
    let mut drawn = vec!["stable", "unstable"];
    drawn.extend((!motions.is_empty()).then_some("motion"));
    results.plots = vec![Plot { title: Text::default(), x: Some(name.to_owned()), y: drawn.into_iter().map(str::to_owned).collect() }];
    let lacking = gaps(walk.gaps).into_iter().chain(unclosed(&walk.open));
    tell(machine, name, &Course { speeds: found, folds, motions }, results);
    results.words.extend(lacking);
    Ok(())
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

/// Folds between two neighbouring values: where speeds are one more pair on one side.
fn between(walk: &mut Walk<'_>, (a, old): (f64, &Vec<Steady>), (b, new): (f64, &Vec<Steady>)) -> Result<Option<Fold>, Notice> {
    let (list, ends) = match (old.len(), new.len()) {
        (more, less) if more == less + 2 => (old, [a, b]),
        (less, more) if more == less + 2 => (new, [b, a]),
        _ => return Ok(None),
    };
    let gap = |k: &usize| list[k + 1].turn.speed - list[*k].turn.speed;
    match (0..list.len() - 1).min_by(|a, b| gap(a).total_cmp(&gap(b))) {
        Some(k) => walk.fold(list, k, ends),
        None => Ok(None),
    }
}

/// Mean speeds of motions at equally spaced values.
fn of_machine(
    machine: &Machine,
    (name, angle): (&str, &Named),
    [from, to]: [f64; 2],
    (until, watch): (f64, &Watch),
) -> Result<Vec<(f64, f64)>, Notice> {
    let mut motions = Motions::new(machine, &angle.name, until)?;
    let mut all = Vec::with_capacity(MOTIONS);
    for k in 0..MOTIONS {
        let value = from + (to - from) * k as f64 / (MOTIONS - 1) as f64;
        if watch.is_interrupted() {
            break;
        }
        all.push((value, motions.speed(&[(name.to_owned(), value)], watch)?));
    }
    Ok(all)
}

fn table(machine: &Machine, name: &str, found: &[(f64, Vec<Steady>)], motions: &[(f64, f64)]) -> Dataset {
    let rows = found.iter().flat_map(|(value, list)| list.iter().map(move |s| (*value, s)));
    let own = |label: Text, name: &str, symbol: &str, unit: &str| Quantity { symbol: symbol.into(), label, ..Quantity::new(name, unit) };
    let stable = Text::new("stable speed", "устойчивая скорость");
    let unstable = Text::new("unstable speed", "неустойчивая скорость");
    let motion = Text::new("mean speed of the motion itself", "средняя скорость самого движения");
    let quantities = [
        quantity(machine, name),
        own(stable, "stable", "Ω_s", "rad/s"),
        own(unstable, "unstable", "Ω_u", "rad/s"),
        own(Text::new("departure from uniform turning", "отклонение от равномерного вращения"), "ripple", "ε", "rad"),
        own(motion, "motion", "ω", "rad/s"),
    ];
    let mut columns: Vec<Column> = quantities.into_iter().map(|quantity| Column { quantity, values: Vec::new() }).collect();
    let mut push = |row: [f64; 5]| columns.iter_mut().zip(row).for_each(|(column, value)| column.values.push(value));
    for (value, s) in rows {
        let speed = |wanted: bool| if s.stable == wanted { s.turn.speed } else { f64::NAN };
        push([value, speed(true), speed(false), s.turn.ripple, f64::NAN]);
    }
    motions.iter().for_each(|(value, speed)| push([*value, f64::NAN, f64::NAN, f64::NAN, *speed]));
    if motions.is_empty() {
        columns.pop();
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

fn tell(machine: &Machine, name: &str, course: &Course, results: &mut Results) {
    let Course { speeds: found, folds, motions } = course;
    let quantity = quantity(machine, name);
    for (k, fold) in folds.iter().enumerate() {
        let label = Text::new("fold: two speeds meet", "поворотная точка: две скорости сливаются");
        results.facts.push(Fact::new(&format!("fold_{}", k + 1), &quantity.symbol, &quantity.unit, fold.value, label));
        let label = Text::new("the speed there", "скорость в ней");
        results.facts.push(Fact::new(&format!("fold_speed_{}", k + 1), &format!("Ω_{}", k + 1), "rad/s", fold.turn.speed, label));
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
    results.own.insert("runs".into(), motions.iter().map(|(value, speed)| json!({"value": value, "speed": speed})).collect());
}
