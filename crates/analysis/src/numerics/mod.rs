//! Small numerical tools.

pub mod random;
pub mod sum;
