//! Showing results: numbers, units, tables, figures and pages in English and Russian. It computes no physics: everything shown here
//! was computed before, and full precision is kept until the moment of printing.
//!
//! Rooms, in order of reading: `rich`, [`wording`], [`number`], [`mod@unit`], [`symbol`], [`escape`] (words and numbers) - [`formula`] - `palette`, [`table`], [`figure`], [`scheme`] -
//! [`document`] - [`formats`].
//!
//! [`Document`] is the middle form: the caller puts blocks into it once and writes it in a format of the table ([`formats::TABLE`]). [`Figure`] is drawn by [`figure::svg`] and [`figure::png`] and by the page itself.

#![cfg_attr(not(test), deny(clippy::too_many_lines, clippy::fn_params_excessive_bools))]

pub mod document;
pub mod escape;
pub mod figure;
pub mod formats;
pub mod formula;
pub mod number;
mod palette;
mod rich;
pub mod scheme;
pub mod symbol;
pub mod table;
pub mod unit;
pub mod wording;

pub use document::{Block, Document, Download};
pub use figure::Figure;
pub use formats::{Format, csv, html as page, json, text as terminal};
pub use scheme::Scheme;
pub use table::{Cell, Table};
pub use wording::Word;
