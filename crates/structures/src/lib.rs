//! Plane frames and trusses of straight Euler-Bernoulli rods: nodes, rods, supports, loads as numbers, and what follows from them before any
//! study: degrees of freedom, exact elimination of constraints, reduced stiffness and mass.
//!
//! All of it is written once over a field of numbers ([`Scalar`]): with machine numbers for frames of any size, with exact rationals for
//! small frames, whose frequency equation then has exact coefficients.
//!
//! Small displacements: x and y of each node and its turn, counter-clockwise. An inextensible or rigid rod is a linear relation between them,
//! eliminated by Gauss-Jordan elimination ([`constraints`]), never a large stiffness.
//!
//! It knows no files of machines and no time: who reads a file fills a [`Frame`], who asks for motions takes matrices.
//!
//! Rooms, in order of reading: [`scalar`], [`dense`] (exact or machine numbers) - [`frame`], [`freedoms`], [`elements`], [`constraints`], [`assembly`], [`loads`] (matrices) -
//! [`equilibrium`] (does it stand?), [`statics`], [`truss`], [`deflection`] - [`reduced`], [`lowest`], [`substructure`] (coordinates) - [`continuum`] (bending waves) -
//! [`faults`], [`matrices`] (what can be wrong, in words).

// the same bits on every machine: see clippy.toml
#![cfg_attr(not(test), deny(clippy::disallowed_methods, clippy::too_many_lines, clippy::fn_params_excessive_bools))]

pub mod assembly;
pub mod constraints;
pub mod continuum;
pub mod deflection;
pub mod dense;
pub mod elements;
pub mod equilibrium;
pub mod faults;
pub mod frame;
pub mod freedoms;
pub mod loads;
pub mod lowest;
pub mod matrices;
pub mod reduced;
pub mod scalar;
pub mod statics;
pub mod substructure;
pub mod truss;

pub use assembly::Assembly;
pub use faults::Fault;
pub use frame::{Action, Component, Displacement, Frame, Load, Node, Place, Rod, RodKind, Support};
pub use scalar::Scalar;
