//! Analysis: what a study may see of a machine ([`System`]), what it returns ([`Dataset`]), the Taylor integrator with events, an
//! implicit method for stiff motions beside it, and one file per study. Nothing here prints, writes files or knows mechanics.
//!
//! Rooms, in order of reading: [`system`], [`dataset`], [`reduce`], `naming`, [`fault`], [`explain`] (what is seen, what is told, what goes wrong) - [`connections`], [`machine`] (assembly; a program as a
//! system) - [`interrupt`], [`integrate`] (steps, events, stiff motions) - `ensemble` (eight motions at a time) - [`proxies`], [`marks`], [`waveform`], [`peaks`] (quantities along a step) - [`audits`] - [`rest`] (equations of
//! rest) - [`linear`] (small motions) - [`studies`], [`made`] (the studies of machines, compiled here once).

// the same bits on every machine: see clippy.toml
#![cfg_attr(not(test), deny(clippy::disallowed_methods, clippy::too_many_lines, clippy::fn_params_excessive_bools))]

pub mod audits;
pub mod connections;
pub mod dataset;
mod ensemble;
pub mod explain;
pub mod fault;
pub mod integrate;
pub mod interrupt;
pub mod linear;
pub mod machine;
pub mod made;
pub mod marks;
mod naming;
pub mod peaks;
pub mod proxies;
pub mod reduce;
pub mod rest;
pub mod studies;
pub mod system;
pub mod waveform;

pub use dataset::Dataset;
pub use fault::Fault;
pub use linear::{LinearMachine, Matrices};
pub use machine::Machine;
pub use system::{Blow, Guard, GuardKind, Jacobian, Mode, Powers, Quantity, Since, SingleBlow, Supply, System, Tie, Touch, TouchLaw};
