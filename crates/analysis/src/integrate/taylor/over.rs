//! What is known of change points.

use crate::integrate::Series;
use algebra::sum::Instant;

/// What is known of change points.
#[derive(Clone, Debug, Default)]
pub(super) struct Passage {
    /// Largest margin so far, and that of the present state.
    pub(super) best: f64,
    pub(super) here: f64,
    /// Least margin known within the present step.
    pub(super) least: f64,
    /// Instant of the last change point passed; long ago where there was none.
    pub(super) behind: Option<Instant>,
    /// The change point that the present step leads over.
    pub(super) over: Option<Over>,
}

/// A step over a change point.
#[derive(Clone, Debug)]
pub(super) struct Over {
    /// How far it is.
    pub(super) to: f64,
    /// Series of the step as they were.
    pub(super) whole: [Series; 2],
    /// Error relative to the change, and the change by state.
    pub(super) error: f64,
    pub(super) changes: Vec<f64>,
}
