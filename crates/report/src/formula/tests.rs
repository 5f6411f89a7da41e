//! Golden formulas.

mod book;
mod reading;
