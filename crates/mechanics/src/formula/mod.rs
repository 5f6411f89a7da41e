//! Formulas of the model file: text -> tokens -> tree -> dimension check -> expression.

mod check;
mod kinematic;
mod lex;
mod lower;
mod parse;
mod scope;

pub(crate) use check::{Context, Depends, Kind, check, mismatch};
pub use kinematic::{FUNCTIONS as KINEMATIC_FUNCTIONS, KinematicFunction, Takes, Where};
pub(crate) use lex::is_identifier;
pub(crate) use lower::{Builder, lower};
pub(crate) use parse::{Formula, parse};
pub(crate) use scope::{Entry, EntryKind, Place, Scope};
