//! All tests of the room in one program.

#[path = "../common/mod.rs"]
mod common;

mod conformance;
mod connections;
mod ensemble;
mod jets;
mod lowering;
mod tangent;
