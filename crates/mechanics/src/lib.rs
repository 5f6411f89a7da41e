//! Mechanics: the model file, units, diagnostics, and the derivation of equations of motion. It does not evaluate states and draws
//! nothing.
//!
//! Rooms, in order of reading: [`units`], `keys`, [`fields`], [`asked`], [`formula`], `snippet` (what stands in a file) - [`model`], [`structure`], [`section`], [`variants`] (what it
//! means) - `reader`, [`elements`], [`connections`], `read` (from the one to the other) - `scene` (places and velocities), `requests` (what formulas ask of them) - [`mod@derive`] (the
//! equations) - [`mod@reference`], [`explain`] (tables and codes as documents).

// the same bits on every machine: see clippy.toml
#![cfg_attr(not(test), deny(clippy::disallowed_methods, clippy::too_many_lines, clippy::fn_params_excessive_bools))]

pub mod asked;
pub mod connections;
pub mod derive;
pub mod elements;
pub mod explain;
pub mod fields;
pub mod formula;
mod keys;
pub mod model;
mod read;
mod reader;
pub mod reference;
mod requests;
mod scene;
pub mod section;
mod snippet;
pub mod structure;
pub mod units;
pub mod variants;

pub use model::Model;
pub use read::{MAX_FILE, MAX_FINDINGS, Reading, SHAPES, read, read_with, split_override, sweep_range, sweep_stretch};
pub use scene::is_spatial;
pub use scene::places::Places;
