//! What all tables need: fields by name, formulas with their checks, findings.

pub(crate) mod draft;
pub(crate) mod evaluate;
mod fields;
pub(crate) mod names;
mod state;
pub(crate) mod syntax;
mod toml_words;
mod values;
mod wording;

pub(crate) use fields::Fields;
#[cfg(test)]
pub(crate) use fields::asked;
pub use state::MAX_FINDINGS;
pub(crate) use state::{Checked, Raw, Reader};
pub(crate) use values::{components, string};
pub(crate) use wording::{short, wrong_type};
