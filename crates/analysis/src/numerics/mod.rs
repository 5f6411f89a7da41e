//! Small numerical tools.

pub mod lu;
pub mod random;
pub mod rank;
pub mod spectrum;
pub mod sum;
