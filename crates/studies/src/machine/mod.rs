//! The machine of a file.

pub mod origin;
