//! Small numerical tools.

pub mod complex;
pub mod divided;
pub mod expm;
pub mod lu;
pub mod random;
pub mod sum;
