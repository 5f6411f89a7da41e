//! Equilibria: h(q, 0, s, 0) = 0 by damped Newton from guesses.
//!
//! Rates are zero; how loads that depend on time enter is the machine's affair ([`crate::linear`] takes their means, a `System` stands at
//! t = 0). An equilibrium of a conservative system is stable when its stiffness K = -dh/dq is positive definite (Lagrange, Dirichlet) and unstable when K has a negative direction; when K is not symmetric the loads do
//! work over closed ways (follower forces), and definiteness of the symmetric part is only a hint.

use crate::fault::codes;
use algebra::arrange::Arrange;
use words::Text;

use crate::audits::worst;
use crate::dataset::{Audit, Column, Counter, Dataset, Missing};
use crate::rest::newton::RESIDUAL;
use crate::rest::search::{BESIDE, ONE, Rest, Search, Searched, Statics, at_poles, nothing_between, widened};
use crate::{Quantity, System};

use super::simulate::Outcome;

pub use crate::rest::search::{Equilibrium, Range, no_equilibrium};

/// Other angles that are also tried half a turn further.
const TURNED: usize = 3;

/// The result for a machine without coordinates: there is nothing whose rest could be sought.
pub fn nothing_moves() -> Text {
    Text::new(
        "nothing can move: the machine has no coordinates, so there is no equilibrium to look for and no stability",
        "двигаться нечему: координат нет, поэтому нет ни искомого положения равновесия, ни вопроса об устойчивости",
    )
}

/// What is said of places that are not isolated.
pub fn neutral() -> Text {
    Text::new(
        "neutral: no force resists a small motion in at least one direction, so these places are not isolated",
        "безразличное равновесие: хотя бы в одном направлении малому движению ничто не противится, и эти положения не изолированы",
    )
}

/// What is said where nobody knows whether places are isolated.
pub fn undecided() -> Text {
    Text::new(
        "not decided: in at least one direction no stiffness resists a small motion; whether forces of higher order do, and whether these places are isolated, is left open",
        "не решено: хотя бы в одном направлении жёсткость малому движению не противится; противятся ли ему силы высших порядков и изолированы ли эти положения, остаётся открытым",
    )
}

/// What rest means.
pub(crate) fn rates_are_zero() -> Text {
    Text::new("rates are zero", "скорости равны нулю")
}

/// Says what is absent in columns of equilibria.
pub fn state(data: &mut Dataset) {
    let growth = Text::new(
        "no roots: the place is not isolated, or its small motions are not linear",
        "корней нет: положение не изолировано либо малые движения в нём нелинейны",
    );
    let verdict = Text::new("small motions do not decide", "малыми движениями не решается");
    data.state("stable", Missing::Absent, verdict);
    data.state("growth", Missing::Absent, growth.clone());
    data.state("negative_directions", Missing::Absent, growth);
}

/// Equilibria from the state `start` and further guesses, one row of the result each.
///
/// Columns: the coordinates, `residual` (largest force relative to its terms), `stable` (1 yes, 0 no, NaN undecided).
///
/// *Errors* beside what was found: S007 when no guess leads to an equilibrium, S008 when nothing restores any motion there.
pub fn equilibrium<S: System + ?Sized>(system: &mut S, start: &[f64], options: &Equilibrium) -> Outcome {
    let coordinates = system.states()[..System::n_coordinates(system)].to_vec();
    find(system, &coordinates, start, options)
}

/// The same for anything that has forces of rest over these coordinates.
pub fn find<S: Statics + ?Sized>(system: &mut S, coordinates: &[Quantity], start: &[f64], options: &Equilibrium) -> Outcome {
    let n = coordinates.len();
    if n == 0 {
        return Outcome { dataset: Dataset { notes: vec![nothing_moves()], ..Dataset::default() }, fault: None };
    }
    let mut search = Search { beside: options.over.is_none(), ..Search::new(system) };
    let mut found: Vec<Rest> = Vec::new();
    let mut faults = Vec::new();
    let own = start[..n].to_vec();
    let mut along = Vec::new();
    if let Some(range) = options.over {
        along = search.along(range, start);
        turned(&mut along, coordinates, range.coordinate);
    }
    let (sizes, reach) = (search.sizes.clone(), options.reach(&own));
    let (mut flat, mut poles): (Vec<[Vec<f64>; 2]>, Vec<Rest>) = Default::default();
    for guess in std::iter::once(&own).chain(options.guesses.iter().filter(|g| g.len() == n)).chain(&along) {
        let mut x = still(start, n);
        x[..n].copy_from_slice(guess);
        let known = |list: &[Rest], rest: &Rest| list.iter().any(|other| sizes.same([&other.q, &rest.q], &own, ONE));
        match search.sought(x.clone()) {
            Ok(rest) if known(&found, &rest) || known(&poles, &rest) => {}
            Ok(rest) if search.is_pole(&[&rest.q, &x[n..]].concat()) => poles.push(rest),
            Ok(rest) => match one(&mut search, &mut flat, &rest, (start, &reach)) {
                Some((k, middle)) => found[k] = middle,
                None => found.push(rest),
            },
            Err(fault) => faults.push(fault),
        }
    }
    let steps = search.steps;
    if let Some(Range { coordinate, from, to }) = options.over {
        // places at an end of the range belong to it
        let slack = 1e-9 * (to - from);
        found.retain(|rest| (from - slack..=to + slack).contains(&rest.q[coordinate]));
        found.arrange_by(|a, b| a.q[coordinate].total_cmp(&b.q[coordinate]));
        faults.retain(|f| f.code == codes::NEUTRAL);
        if found.is_empty() && faults.is_empty() {
            let searched = if n > 1 { Searched::Guessed } else { Searched::Whole };
            faults.push(nothing_between(&coordinates[coordinate].name, (from, to), searched));
        }
    }
    let mut dataset = dataset(coordinates, &found, steps);
    let within = |r: Range| poles.iter().map(|p| p.q[r.coordinate]).filter(|v| (r.from..=r.to).contains(v)).collect::<Vec<_>>();
    dataset.notes.extend(options.over.and_then(|r| at_poles(&coordinates[r.coordinate].name, &within(r))));
    if options.over.is_some() && n > 1 {
        dataset.notes.push(Text::new(
            "found by Newton's method from guesses along the range: there may be more",
            "найдены методом Ньютона из приближений вдоль диапазона: могут быть и другие",
        ));
    }
    if options.over.is_none() && n > 1 && found.iter().any(|rest| rest.stable.is_none() && (rest.symmetric || rest.singular)) {
        dataset.notes.push(neutral());
    }
    // a guess that failed matters only when nothing was found, a free motion always
    let neutral = faults.iter().position(|f| f.code == codes::NEUTRAL);
    let fault = match neutral {
        Some(i) => Some(faults.swap_remove(i)),
        // poles alone are no place
        None if found.is_empty() => faults.into_iter().next().or_else(|| Some(no_equilibrium())),
        None => None,
    };
    Outcome { dataset, fault }
}

/// The start without rates.
fn still(start: &[f64], n: usize) -> Vec<f64> {
    let mut x = start.to_vec();
    let rates = (2 * n).min(x.len());
    x[n..rates].fill(0.0);
    x
}

/// Which of the places found one more belongs to, and the middle of both, where no force between them is clear of its rounding; `flat` are the ends of the places found.
fn one<S: Statics + ?Sized>(
    search: &mut Search<'_, S>,
    flat: &mut Vec<[Vec<f64>; 2]>,
    rest: &Rest,
    (start, reach): (&[f64], &[f64]),
) -> Option<(usize, Rest)> {
    let x = still(start, rest.q.len());
    let sizes = search.sizes.clone();
    let joined = flat.iter_mut().enumerate().find_map(|(k, ends)| {
        let [a, b] = &*ends;
        if !sizes.same([a, &rest.q], reach, BESIDE) && !sizes.same([b, &rest.q], reach, BESIDE) {
            return None;
        }
        search.between([a, &rest.q], &x)?;
        *ends = widened(ends, &rest.q);
        let [a, b] = &*ends;
        Some((k, search.between([a, b], &x)?))
    });
    if joined.is_none() {
        flat.push([rest.q.clone(), rest.q.clone()]);
    }
    joined
}

/// Adds every guess with some of the angles, other than this one, turned by half a turn, where machines under gravity rest too.
fn turned(guesses: &mut Vec<Vec<f64>>, coordinates: &[Quantity], but: usize) {
    for i in (0..coordinates.len()).filter(|&i| i != but && coordinates[i].unit == "rad").take(TURNED) {
        let more: Vec<Vec<f64>> = guesses
            .iter()
            .map(|q| {
                let mut q = q.clone();
                q[i] += std::f64::consts::PI;
                q
            })
            .collect();
        guesses.extend(more);
    }
}

fn dataset(coordinates: &[Quantity], found: &[Rest], steps: usize) -> Dataset {
    let column = |(i, q): (usize, &Quantity)| Column { quantity: q.clone(), values: found.iter().map(|r| r.q[i]).collect() };
    let mut columns: Vec<Column> = coordinates.iter().enumerate().map(column).collect();
    let labelled = |name: &str, label: Text| Quantity { label, ..Quantity::new(name, "1") };
    columns.push(Column {
        quantity: labelled("residual", Text::new("largest relative force", "наибольшая относительная сила")),
        values: found.iter().map(|r| r.residual).collect(),
    });
    columns.push(Column {
        quantity: labelled("stable", Text::new("1 stable, 0 unstable", "1 устойчиво, 0 неустойчиво")),
        values: found.iter().map(|r| r.stable.map_or(f64::NAN, |s| f64::from(u8::from(s)))).collect(),
    });
    let mut notes = vec![rates_are_zero()];
    if found.iter().any(|r| !r.symmetric) {
        notes.push(Text::new(
            "the stiffness is not symmetric: the loads are not conservative, and the verdict on stability is only a hint",
            "матрица жёсткости несимметрична: нагрузки неконсервативны, и заключение об устойчивости лишь ориентировочное",
        ));
    }
    let worst = worst(found.iter().map(|r| r.residual));
    let name = Text::new("equilibrium: largest relative force", "равновесие: наибольшая относительная сила");
    let audits = if found.is_empty() { vec![] } else { vec![Audit::at_most("equilibrium", name, worst, RESIDUAL)] };
    let counters = vec![Counter {
        key: "newton_steps", name: Text::new("Newton steps", "шагов метода Ньютона"), value: steps as f64
    }];
    let mut data = Dataset { columns, notes, audits, counters, ..Dataset::default() };
    state(&mut data);
    data
}
