//! A machine ready for studies: what its file says, its equations, its program; how it is built, and how it gets other values.

pub mod bind;
pub mod build;
mod built;
mod sought;
pub mod study;
pub mod unknowns;

pub use build::build;
pub use built::{Machine, explained, lower, no_numbers};
pub use sought::sought;
