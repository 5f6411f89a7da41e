//! The structure of a model file bound to `structures`: its numbers ([`bind`]), its coordinates ([`coordinates`]), as a part of the machine
//! ([`mount`], by its `figures`), and with other values ([`renew`]).

pub mod bind;
pub mod coordinates;
mod figures;
mod groups;
pub mod mount;
pub mod renew;
