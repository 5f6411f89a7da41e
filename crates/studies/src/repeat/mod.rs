//! A study that others repeat with other values of the machine: which of the file's it is, what is noted of it, and its run at one place.

pub(crate) mod abreast;
mod asking;
mod base;
pub(crate) mod course;
pub(crate) mod gathered;
pub(crate) mod journal;
mod keys;
pub mod many;
mod number;
mod one;
pub mod regimes;
mod repeated;
pub(crate) mod stands;
pub(crate) mod stated;
mod verdict;
mod wanted;

pub use asking::Asks;
pub use base::{moves, rests};
pub use keys::{OF, inner, keys, quantity};
pub use number::number;
pub use one::{At, one};
pub use repeated::Repeated;
pub use wanted::{Noted, noted, without_impulses};
