//! Small numerical tools.

pub mod sum;
