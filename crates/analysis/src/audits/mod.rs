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
pub mod second;
pub mod shared;
pub mod touches;
mod virtual_work;

/// Units of the last place to which the terms of a motion are rounded.
const ROUNDED: f64 = 64.0;
