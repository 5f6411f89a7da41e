//! Golden formulas.

mod book;
mod golden;
mod machine;
mod names;
mod random;
mod reading;
