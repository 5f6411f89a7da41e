//! Showing results: numbers, units, tables, figures and pages in English and Russian. It computes no physics: everything shown here
//! was computed before, and full precision is kept until the moment of printing.
//!
//! [`Document`] is the middle form: the caller puts blocks into it once and writes it as an HTML page ([`page::write`]) or as
//! terminal text ([`terminal::write`]). [`Figure`] is drawn by [`figure::svg`] and [`figure::png`] and by the page itself.

pub mod csv;
pub mod document;
pub mod escape;
pub mod figure;
pub mod formula;
pub mod json;
pub mod number;
pub mod page;
mod rich;
pub mod symbol;
pub mod table;
pub mod terminal;
pub mod unit;
pub mod wording;

pub use document::{Block, Document, Download};
pub use figure::Figure;
pub use table::{Cell, Table};
pub use wording::Word;
