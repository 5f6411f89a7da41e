//! Golden formulas.

mod book;
mod golden;
mod machine;
mod meaning;
mod names;
mod random;
mod reading;
