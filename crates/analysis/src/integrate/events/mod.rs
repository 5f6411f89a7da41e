//! Events: the first root of a guard inside a step, impacts, and the modes that hold after it.

mod contacts;
mod impacts;
mod modes;
mod nearest;
mod rivals;
mod sides;
pub(crate) use impacts::{Hit, Impact};
pub(crate) use modes::opposite;
pub use rivals::Rival;
pub(crate) use sides::{BoundState, STILL, size};
pub mod roots;
pub mod words;

use crate::Mode;

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
