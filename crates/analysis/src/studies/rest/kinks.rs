//! Places of rest at which a force has a kink: the edge of a play, |x|, max(x, 0), a law by `if`, a damper with unequal strokes, sgn x' in a formula.
//!
//! On both sides of such a place, or for motion forth and back, stiffness and damping are others. The derivative there is that of one of them, by which `if(x > 0, ...)` and `if(x >= 0, ...)` would differ; small motions are not
//! linear, their period is a mean of both sides, and either side may repel.

use crate::linear::{LinearMachine, Matrices, Place, largest};
use symbolic::Equations;
use symbolic::linear::About;
use words::Text;

/// How far places beside it lie, as a share of the largest coordinate of the unit: beyond what a place of rest is known to.
const BESIDE: f64 = 1e-8;
/// The least size of a coordinate, m or rad: a machine in its zero position has none of its own.
const LEAST: f64 = 1e-3;
/// How much nearer matrices are compared again, and the share of their difference that is left there at a kink: of a stiffness that passes through zero a sixteenth is.
const NEARER: f64 = 16.0;
const LEFT: f64 = 0.5;
/// Share of the largest entry by which matrices of both sides differ at a kink: those of a smooth force differ by about the share above.
const APART: f64 = 1e-3;

/// In units of the rounding of their entries: a difference that counts is far above it, see `APART`.
const ROUNDINGS: f64 = 1e6;
/// Rates forth and back, m/s or rad/s: far below those by which a law without a kink is rounded off.
const SLOW: f64 = 1e-8;
/// Share of the terms of a force below which a difference is rounding.
const ROUNDED: f64 = 1e-13;

/// Whether stiffness or damping are others on both sides of a place of rest along some coordinate, or for slow motion forth and back.
pub fn is_kink(machine: &mut LinearMachine, place: &Place) -> bool {
    is_kink_of_places(machine, place) || switches_with_rates(machine.equations()) && is_kink_of_rates(machine, place)
}

fn is_kink_of_places(machine: &mut LinearMachine, place: &Place) -> bool {
    let units: Vec<String> = machine.coordinates().iter().map(|c| c.unit.clone()).collect();
    // where a length vanishes they hang on the direction in which the place is left: both sides are alike, and not like the place itself
    let here = machine.at(place).ok();
    (0..place.q.len()).any(|j| {
        let alike = place.q.iter().zip(&units).filter(|(_, unit)| **unit == units[j]).map(|(q, _)| q.abs());
        let step = BESIDE * alike.fold(LEAST, f64::max);
        let mut apart = |step: f64| {
            let mut at = |step: f64| {
                let mut beside = Place { below: Vec::new(), ..place.clone() };
                beside.q[j] += step;
                machine.at(&beside).ok()
            };
            let (before, behind) = at(-step).zip(at(step))?;
            let pairs = [Some(&before), here.as_ref()].into_iter().flatten();
            let [damping, stiffness] = machine.rounding();
            // what differs by rounding alone has no size
            let clear = |[far, size]: [f64; 2], rounding: f64| [far, size.max(ROUNDINGS * rounding)];
            let differences = |m: &Matrices| {
                [clear(between(&m.stiffness, &behind.stiffness), stiffness), clear(between(&m.damping, &behind.damping), damping)]
            };
            Some(pairs.flat_map(differences).collect::<Vec<_>>())
        };
        let Some((far, near)) = apart(step).zip(apart(step / NEARER)) else { return false };
        far.iter().zip(near).any(|([far, size], [near, _])| *far > APART * size && near > LEFT * far)
    })
}

/// Whether a law of another form on both sides of a value is one of rates.
fn switches_with_rates(equations: &Equations) -> bool {
    let graph = &equations.graph;
    let of_rates = |e| graph.contains(e, |s| equations.coordinates.iter().any(|c| c.symbols[1] == s));
    graph.reachable(&equations.force).into_iter().any(|e| graph.node(e).switches() && of_rates(e))
}

/// Whether damping, or a force itself, is another one for slow motion forth and back.
fn is_kink_of_rates(machine: &LinearMachine, place: &Place) -> bool {
    let Ok(mut moving) = LinearMachine::new(machine.equations(), About::Motion) else { return false };
    if moving.renumber(machine.numbers()).is_err() {
        return false;
    }
    let Ok(terms) = moving.force_terms(place) else { return false };
    (0..place.q.len()).any(|j| {
        let mut apart = |rate: f64| {
            let mut at = |rate: f64| {
                let mut beside = Place { below: Vec::new(), ..place.clone() };
                beside.rates[j] += rate;
                moving.at(&beside).ok()
            };
            let (back, forth) = at(-rate).zip(at(rate))?;
            let jumps: Vec<f64> = back.force.iter().zip(&forth.force).map(|(a, b)| (a - b).abs()).collect();
            Some((between(&back.damping, &forth.damping), jumps))
        };
        let Some(((far, far_jumps), (near, near_jumps))) = apart(SLOW).zip(apart(SLOW / NEARER)) else { return false };
        let bends = far[0] > APART * far[1] && near[0] > LEFT * far[0];
        let jumps = far_jumps.iter().zip(near_jumps).zip(&terms);
        bends || jumps.into_iter().any(|((far, near), term)| *far > ROUNDED * term && near > LEFT * far)
    })
}

/// The largest difference of two matrices, and their largest entry.
fn between(a: &[f64], b: &[f64]) -> [f64; 2] {
    [a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max), largest(a).max(largest(b))]
}

/// What is to be said of such a place.
pub fn remark() -> Text {
    Text::new(
        "a force has a kink at a place of rest (the edge of a play, a damper with unequal strokes, |x|, max, min, an `if`): stiffness or damping are others on both sides, and what is told of small motions there is that of one side; whether it is stable is not decided, and `simulate` and `periodic` have the whole law",
        "в положении равновесия сила имеет излом (край зазора, демпфер с разными ходами, |x|, max, min, `if`): жёсткость или демпфирование по обе стороны разные, и сказанное о малых движениях относится лишь к одной стороне; устойчивость не определена, полный закон учитывают `simulate` и `periodic`",
    )
}
