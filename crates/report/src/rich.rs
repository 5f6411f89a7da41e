//! Words with formulas and symbols among them.

use crate::formula::{Form, Formula};
use crate::symbol;
use words::Language;

/// Words with formulas and symbols among them.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Rich(pub Vec<Inline>);

/// A piece of [`Rich`].
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Inline {
    /// Plain words.
    Words(String),
    /// A formula within the line.
    Formula(Formula),
    /// A name of the model, shown as a symbol (`c_x`, `phi'`).
    Symbol(String),
}

impl Rich {
    /// A name of the model, shown as a symbol.
    pub fn symbol(name: impl Into<String>) -> Rich {
        Rich(vec![Inline::Symbol(name.into())])
    }

    /// A formula.
    pub fn formula(formula: Formula) -> Rich {
        Rich(vec![Inline::Formula(formula)])
    }

    /// All of it as plain text.
    pub fn plain(&self, language: Language) -> String {
        let pieces = self.0.iter().map(|piece| match piece {
            Inline::Words(words) => words.clone(),
            Inline::Formula(formula) => formula.text(),
            Inline::Symbol(name) => symbol::plain(name, language),
        });
        pieces.collect()
    }

    /// All of it in one form, words by `words`, formulas in a written form by `formula`.
    pub fn write(&self, form: Form, language: Language, (words, formula): (impl Fn(&str) -> String, impl Fn(String) -> String)) -> String {
        let pieces = self.0.iter().map(|piece| match piece {
            Inline::Words(text) => words(text),
            Inline::Formula(inner) => formula(inner.write(form)),
            Inline::Symbol(name) => formula(symbol::written(name, language, form)),
        });
        pieces.collect()
    }
}

impl From<&str> for Rich {
    fn from(words: &str) -> Rich {
        Rich(vec![Inline::Words(words.into())])
    }
}

impl From<String> for Rich {
    fn from(words: String) -> Rich {
        Rich(vec![Inline::Words(words)])
    }
}
