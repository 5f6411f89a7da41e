//! What all rooms speak with: [`Text`] in two [`Language`]s, the one [`Notice`], explanations of its codes, tables of printed words,
//! numbers and units in sentences, letters of names, the nearest of known names. It knows nothing else of strutt.
//!
//! Rooms, in order of reading: [`language`], `text`, [`digits`], [`mod@unit`], `quantity` - [`letters`], `near`, [`limits`] - [`notice`], [`explain`], `table`.

#![cfg_attr(not(test), deny(clippy::too_many_lines, clippy::fn_params_excessive_bools))]

pub mod digits;
pub mod explain;
pub mod language;
pub mod letters;
pub mod limits;
mod near;
pub mod notice;
mod quantity;
mod table;
mod text;
pub mod unit;

pub use language::Language;
pub use near::{half_slips, nearest};
pub use notice::{Message, Notice, Place, Severity};
pub use quantity::Quantity;
pub use table::Printed;
pub use text::{Text, capital};
