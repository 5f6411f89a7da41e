//! Formulas of the model file: text -> tokens -> tree -> dimension check -> expression.

mod check;
mod kind;
mod kinematic;
mod lex;
mod lower;
mod parse;
mod scope;
mod turns;

pub(crate) use check::{Context, check};
pub(crate) use kind::{Depends, Kind};
pub use kinematic::{FUNCTIONS as KINEMATIC_FUNCTIONS, KinematicFunction, Takes, Where};
pub(crate) use lex::{is_identifier, is_too_long};
pub(crate) use lower::{Builder, lower};
pub(crate) use parse::{Formula, parse};
pub(crate) use scope::{Entry, EntryKind, FREQUENCIES, Place, Scope, Told, shared};
pub(crate) use turns::{Plain, display};
