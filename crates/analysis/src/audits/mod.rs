//! Checks of a result by means that the result did not use.

pub mod halving;
pub mod power;
pub mod second;
