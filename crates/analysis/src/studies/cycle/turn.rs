//! The motion that leads a machine through a cycle of its shaft.

use super::faults::not_turning;
use crate::integrate::Step;
use crate::integrate::taylor::{Flow, Options};
use crate::{Fault, GuardKind, System};

/// Options of the study.
#[derive(Clone, Debug, PartialEq)]
pub struct Cycle {
    /// Index of the coordinate that is the angle of the shaft.
    pub angle: usize,
    /// Angle of a cycle, rad; negative when it falls.
    pub range: f64,
    /// Uniform rate, rad/s.
    pub rate: f64,
    /// Rows of the result.
    pub points: usize,
    /// Relative tolerance of a step.
    pub tolerance: f64,
}

/// Most steps of a cycle.
const STEPS: usize = 100_000;

/// A motion through the cycle.
pub(in crate::studies) struct Turned {
    /// Its steps, each with the part of it that counts.
    pub(in crate::studies) steps: Vec<(Step, f64)>,
    /// The contact that opens, closes or is struck first, with the angle.
    pub(super) parted: Option<(usize, f64)>,
}

/// The motion through the cycle.
pub(in crate::studies) fn turn<S: System + ?Sized>(system: &mut S, start: &[f64], options: &Cycle, quicker: f64) -> Result<Turned, Fault> {
    let j = options.angle;
    let n = system.n_coordinates();
    let mut x = start.to_vec();
    let faster = if x[n + j] == 0.0 { 1.0 } else { quicker * options.rate / x[n + j] };
    x[n..2 * n].iter_mut().for_each(|v| *v *= faster);
    let end = start[j] + options.range;
    let sign = options.range.signum();
    let rate = if x[n + j] == 0.0 { options.rate } else { x[n + j] };
    // a nanosecond: the length of a run is not nothing
    let most = 10.0 * (options.range / rate).abs().max(1e-9);
    let contacts: Vec<bool> = system.guards().iter().map(|g| matches!(g.kind, GuardKind::Contact { .. })).collect();
    let mut flow = Flow::start(system, 0.0, &x, &Options { tolerance: options.tolerance, span: most, ..Options::default() })?;
    let (mut steps, mut parted): (Vec<(Step, f64)>, _) = (Vec::new(), None);
    while !flow.reached(most) && steps.len() < STEPS {
        flow.advance(most)?;
        let step = flow.step().clone();
        let place = |tau: f64| place(&step, j, tau);
        if sign * (place(step.length) - end) >= 0.0 {
            let (mut a, mut b) = (0.0, step.length);
            for _ in 0..200 {
                let middle = 0.5 * (a + b);
                if sign * (place(middle) - end) < 0.0 { a = middle } else { b = middle }
            }
            steps.push((step, b));
            return Ok(Turned { steps, parted });
        }
        let length = step.length;
        parted = parted.or_else(|| flow.switches().iter().find(|s| contacts[s.guard]).map(|s| (s.guard, place(length))));
        steps.push((step, length));
    }
    Err(not_turning(&system.states()[j].name))
}

/// A coordinate at tau in a step, with its whole turns.
pub(in crate::studies) fn place(step: &Step, j: usize, tau: f64) -> f64 {
    step.start_value(j) + step.coefficients(j)[1..].iter().rev().fold(0.0, |sum, c| (sum + c) * tau)
}
