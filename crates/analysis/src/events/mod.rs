//! Events: the first root of a guard inside a step, and the modes that hold after it.

mod modes;
pub(crate) use modes::{STILL, size};
pub mod roots;

use crate::Mode;

/// A change of mode of one guard.
#[derive(Clone, Debug, PartialEq)]
pub struct Switch {
    /// When.
    pub t: f64,
    /// Which guard.
    pub guard: usize,
    /// Mode before.
    pub before: Mode,
    /// Mode after.
    pub after: Mode,
}
