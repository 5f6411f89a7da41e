//! A phase in closed form.

use super::form::Form;
use super::motion::Motion;
use crate::{Mode, System};

/// One phase of the motion.
#[derive(Clone, Debug, PartialEq)]
pub struct Phase {
    /// Start, s.
    pub start: f64,
    /// End, s.
    pub end: f64,
    /// The system within it.
    pub form: Form,
    /// Its motion over τ = t - start.
    pub motion: Motion,
    /// (q, q') at the start.
    pub state_at_start: Vec<f64>,
    /// (q, q') at the end.
    pub state_at_end: Vec<f64>,
    /// Whose accelerations outputs show.
    pub accelerations: Accelerations,
}

/// Where accelerations come from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Accelerations {
    /// From the equations, which are linear.
    OfEquations,
    /// From M q'' = f - B q' - C q of small motions: the equations are others.
    OfForm,
}

impl Phase {
    /// Gives the system the accelerations of (t, x), where they are not those of its equations.
    pub(super) fn accelerate<S: System + ?Sized>(&self, system: &mut S, t: f64, x: &[f64]) {
        match self.accelerations {
            Accelerations::OfEquations => system.impose(None),
            Accelerations::OfForm => system.impose(Some(&self.form.accelerations(t, x))),
        }
    }
}

/// Scheduled switches as inside the phase, others by their values.
pub(super) fn modes<S: System + ?Sized>(system: &mut S, phase: &Phase, t: f64, x: &[f64]) -> Vec<Mode> {
    let inside = 0.5 * (phase.start + phase.end);
    let count = system.guards().len();
    let plain = || vec![Mode::Positive; count];
    let (scheduled, own) = (system.modes_by_value(inside, x).unwrap_or_else(plain), system.modes_by_value(t, x).unwrap_or_else(plain));
    let choose = |(guard, (s, o)): (&crate::Guard, (Mode, Mode))| if guard.scheduled.is_some() { s } else { o };
    system.guards().iter().zip(scheduled.into_iter().zip(own)).map(choose).collect()
}
