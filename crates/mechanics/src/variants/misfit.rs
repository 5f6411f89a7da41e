//! What is wrong with a table of variants.

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
