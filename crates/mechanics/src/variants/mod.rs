//! Variants of a model: a table as a course gives it, and the values that its rows and the formulas of the file make.

mod table;
mod unit;
mod values;

pub use table::Table;
pub use table::cells;
pub(crate) use unit::turned;
pub use unit::{in_unit, scale};
pub use values::{Given, Row, after_formulas, row, si, symbols};

use words::Text;

/// What is wrong with a table or a row; whoever read the table knows its place.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Misfit {
    /// What.
    pub what: Text,
    /// The cure; may be empty.
    pub help: Text,
}

impl Misfit {
    /// Without a cure.
    pub fn new(en: impl Into<String>, ru: impl Into<String>) -> Misfit {
        Misfit { what: Text::new(en, ru), help: Text::default() }
    }
    /// With a cure.
    pub fn help(self, en: impl Into<String>, ru: impl Into<String>) -> Misfit {
        Misfit { help: Text::new(en, ru), ..self }
    }
}
