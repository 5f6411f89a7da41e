//! Places of rest at which a force has a kink: the edge of a play, |x|, max(x, 0), a law by `if`.
//!
//! On both sides of such a place stiffness and damping are others. The derivative there is that of one of them, by which `if(x > 0, ...)` and `if(x >= 0, ...)` would differ; small motions are not
//! linear, their period is a mean of both sides, and either side may repel.

use crate::linear::{LinearMachine, Place, largest};
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

/// Whether stiffness or damping are others on both sides of a place of rest, along some coordinate.
pub fn is_kink(machine: &mut LinearMachine, place: &Place) -> bool {
    let units: Vec<String> = machine.coordinates().iter().map(|c| c.unit.clone()).collect();
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
            Some([between(&before.stiffness, &behind.stiffness), between(&before.damping, &behind.damping)])
        };
        let Some((far, near)) = apart(step).zip(apart(step / NEARER)) else { return false };
        far.iter().zip(near).any(|([far, size], [near, _])| *far > APART * size && near > LEFT * far)
    })
}

/// The largest difference of two matrices, and their largest entry.
fn between(a: &[f64], b: &[f64]) -> [f64; 2] {
    [a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max), largest(a).max(largest(b))]
}

/// What is to be said of such a place.
pub fn remark() -> Text {
    Text::new(
        "a force has a kink at a place of rest (the edge of a play, |x|, max, min, an `if`): stiffness and damping are others on both sides, and what is told of small motions there is that of one side; whether it is stable is not decided, and `simulate` and `periodic` have the whole law",
        "в положении равновесия сила имеет излом (край зазора, |x|, max, min, `if`): жёсткость и демпфирование по обе стороны разные, и сказанное о малых движениях относится лишь к одной стороне; устойчивость не определена, полный закон учитывают `simulate` и `periodic`",
    )
}
