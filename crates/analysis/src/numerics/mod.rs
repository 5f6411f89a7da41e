//! Small numerical tools.

pub mod lu;
pub mod random;
pub mod sum;
