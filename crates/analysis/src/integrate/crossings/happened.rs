//! What happens at an event, as data.

use crate::Mode;
use algebra::sum::Instant;

/// A change of mode of one guard, or an impact at it.
#[derive(Clone, Debug, PartialEq)]
pub struct Switch {
    /// When.
    pub t: f64,
    /// Which guard.
    pub guard: usize,
    /// Mode before.
    pub before: Mode,
    /// Mode after; that before when a contact rebounds.
    pub after: Mode,
    /// What else happened.
    pub change: Change,
}

/// What happens at a switch besides the change of its mode.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Change {
    /// Nothing: the state is continuous.
    Mode,
    /// The rates of the state jump.
    Impact {
        /// Rate of the gap before and after.
        rates: [f64; 2],
        /// Impulse that the contact gave in all.
        impulse: f64,
    },
    /// Prescribed velocities jump, and the rates with them.
    Jolt,
    /// A contact closes after infinitely many impacts.
    Rests {
        /// Sum of their intervals: the instant at which they end.
        limit: f64,
    },
}

/// An impact at one contact.
#[derive(Clone, Debug, PartialEq)]
pub(in crate::integrate) struct Impact {
    pub guard: usize,
    /// Rates of the gap before and after.
    pub rates: [f64; 2],
    pub impulse: f64,
    /// Whether it is rounding of the rates and impulses of the instant: the contact closes or stays closed, and nobody is told of an impact.
    pub silent: bool,
}

/// The last impact at a contact.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Hit {
    pub(in crate::integrate) at: Instant,
    pub(in crate::integrate) rate: f64,
}

/// What a friction does in another motion that obeys the laws.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rival {
    /// The guard of the friction.
    pub guard: usize,
    /// Its mode there.
    pub mode: Mode,
    /// Whether what presses it has the other sign there.
    pub turned: bool,
}

/// What a trial of modes showed.
#[derive(Clone, Debug, PartialEq)]
pub(in crate::integrate) enum Verdict {
    /// The flow agrees.
    Holds,
    /// The flow asks for these.
    Wants(Vec<Mode>),
    /// Conditions repeat each other, or one left to others is not implied by them.
    Repeats,
}

pub(crate) fn opposite(mode: Mode) -> Mode {
    match mode {
        Mode::Negative => Mode::Positive,
        Mode::Zero => Mode::Zero,
        Mode::Positive => Mode::Negative,
    }
}
