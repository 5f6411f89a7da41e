//! What depends on the language inside a formula: function names, marks, the last case.

use symbolic::Function;

/// Language of function names, of the decimal mark and of the slope of Greek letters.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
#[allow(missing_docs)]
pub enum Language {
    #[default]
    En,
    Ru,
}

impl Language {
    /// The decimal mark.
    pub fn decimal_mark(self) -> char {
        match self {
            Language::En => '.',
            Language::Ru => ',',
        }
    }
}

impl Language {
    /// Between arguments; not a comma where the comma is decimal.
    pub(super) fn list_mark(self) -> &'static str {
        match self {
            Language::En => ",",
            Language::Ru => ";",
        }
    }
    /// The last case.
    pub(super) fn otherwise(self) -> &'static str {
        match self {
            Language::En => "otherwise",
            Language::Ru => "в остальных случаях",
        }
    }
    /// The name of a function in print.
    pub(super) fn function(self, function: Function) -> &'static str {
        use Function::{Acos, Asin, Atan, Cosh, Log, Sinh, Tan, Tanh};
        match (self, function) {
            (_, Asin) => "arcsin",
            (_, Acos) => "arccos",
            (_, Log) => "ln",
            (Language::En, Atan) => "arctan",
            (Language::Ru, Tan) => "tg",
            (Language::Ru, Atan) => "arctg",
            (Language::Ru, Sinh) => "sh",
            (Language::Ru, Cosh) => "ch",
            (Language::Ru, Tanh) => "th",
            (_, other) => other.name(),
        }
    }
}
