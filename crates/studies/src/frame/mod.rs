//! The structure of a model file bound to `structures`: its numbers ([`bind`]), and as a part of the machine ([`mount`]).

pub mod bind;
mod groups;
pub mod mount;
