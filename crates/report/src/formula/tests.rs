//! Golden formulas.

mod book;
mod golden;
mod names;
mod random;
mod reading;
