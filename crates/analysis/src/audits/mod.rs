//! Checks of a result by means that the result did not use.

pub mod blows;
pub mod bodies;
pub mod certified;
pub mod damping;
pub mod defect;
pub mod digits;
pub mod friction;
pub mod frontier;
pub mod halving;
pub mod impacts;
pub mod ledger;
mod placements;
pub mod power;
pub mod released;
mod sampling;
pub mod second;
pub mod shared;
pub mod touches;
mod virtual_work;

/// Units of the last place to which the terms of a motion are rounded.
const ROUNDED: f64 = 64.0;

/// The least limit of an audit along a motion: below it rounding rules, while a wrong term shows as 1e-3 and more.
const LEAST: f64 = 1e-9;

/// What the error of a step grows to in an audit: the derivative of a polynomial of order p multiplies it by p (p <= 40, 25 in reserve).
const GROWN: f64 = 1e3;

/// Share of the largest scale of a row so far below which no scale of that row is: where its terms pass through zero together nothing closes against them.
const PASSING: f64 = 1e-3;

/// The larger; what is no number stays one, so that an audit of it fails.
pub fn worse(a: f64, b: f64) -> f64 {
    if a.is_nan() || b.is_nan() { f64::NAN } else { a.max(b) }
}

/// The largest deviation of an audit; none is 0, and what is no number stays.
pub fn worst(deviations: impl IntoIterator<Item = f64>) -> f64 {
    deviations.into_iter().fold(0.0, worse)
}

/// The limit of an audit of a motion of this tolerance.
fn limit(tolerance: f64) -> f64 {
    (GROWN * tolerance).max(LEAST)
}
