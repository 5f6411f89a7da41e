//! Checks of a result by means that the result did not use.

pub mod bodies;
pub mod defect;
pub mod digits;
pub mod friction;
pub mod halving;
pub mod impacts;
pub mod ledger;
pub mod power;
pub mod second;
