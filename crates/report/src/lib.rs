//! report
pub mod formula;
