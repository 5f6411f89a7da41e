//! Symbolic core: a hash-consed graph of expressions with exact numbers, derivatives, textbook forms, and [`Equations`], the
//! hand-over from mechanics to numerics. It knows no bodies, no files, no output format.
//!
//! Rooms, in order of reading: `rational`, `graph`, `build` (exact numbers; equal expressions are one node) - `walk`, `evaluate`, `substitute`, `derivative` (what is done
//! with them) - `trigonometry`, `textbook` (how they are read) - `matrix`, `polynomial`, `characteristic`, [`transfer`] - [`equations`], [`connections`], [`mounted`], [`waveform`]
//! (the hand-over) - `periodic`, [`harmonics`], [`linear`] (small motions).

// the same bits on every machine: see clippy.toml
#![cfg_attr(not(test), deny(clippy::disallowed_methods, clippy::too_many_lines, clippy::fn_params_excessive_bools))]

mod build;
mod characteristic;
pub mod connections;
mod derivative;
pub mod equations;
mod evaluate;
mod graph;
pub mod harmonics;
pub mod linear;
mod matrix;
pub mod mounted;
mod periodic;
mod polynomial;
mod rational;
mod substitute;
mod textbook;
pub mod transfer;
mod trigonometry;
mod walk;
pub mod waveform;

pub use characteristic::characteristic;
pub use derivative::Derivation;
pub use equations::Equations;
pub use graph::{Edge, Expr, Function, Graph, Node, Symbol, SymbolId};
pub use linear::Linear;
pub use matrix::Matrix;
pub use mounted::Mounted;
pub use rational::Rational;
pub use substitute::Substitution;
pub use textbook::Textbook;
pub use walk::Occurrence;
