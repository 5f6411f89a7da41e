//! What all rooms speak with: [`Text`] in two [`Language`]s, tables of printed words, letters of names, the nearest of known names.
//! It knows nothing else of strutt.

pub mod language;
pub mod letters;
mod near;
mod text;

pub use language::{Language, Printed};
pub use near::{half_slips, nearest};
pub use text::Text;
