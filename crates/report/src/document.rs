//! The written calculation as a list of blocks, before it becomes a page or terminal text.
//!
//! A document is in one language: the caller picks the wording when it builds the blocks. Figures, tables and equations are
//! numbered by the writers in the order of the blocks, so that a caption never needs a number.

use crate::figure::Figure;
use crate::figure::bands::Bands;
use crate::table::Table;
use words::Language;

/// A document: title, blocks, and where it came from.
#[derive(Clone, Debug)]
pub struct Document {
    /// Language of all words and numbers.
    pub language: Language,
    /// Title of the model.
    pub title: String,
    /// What the model is, in a sentence or a paragraph; empty for none.
    pub description: String,
    /// The content, in order.
    pub blocks: Vec<Block>,
    /// Version of the program, for the footer.
    pub version: String,
    /// Hash of the model file, for the footer.
    pub model_hash: String,
}

/// One block of a [`Document`].
// a document has tens of blocks: a box around figures would cost readability and save nothing
#[allow(clippy::large_enum_variant)]
#[derive(Clone, Debug)]
pub enum Block {
    /// A heading; level 1 is the largest below the title.
    Heading {
        /// 1, 2 or 3.
        level: u8,
        /// Words.
        text: String,
    },
    /// A paragraph.
    Paragraph(Rich),
    /// A formula on its own line.
    Equation {
        /// The formula.
        formula: Formula,
        /// Whether it gets a number at the right edge.
        numbered: bool,
    },
    /// A table; it is numbered if it has a caption.
    Table(Table),
    /// A figure; always numbered.
    Figure(Figure),
    /// What contacts did over time; numbered as a figure.
    Bands(Bands),
    /// Something that opens on demand (always open in terminal text).
    Details {
        /// The line that is always seen.
        summary: String,
        /// What it opens.
        blocks: Vec<Block>,
    },
    /// Files beside or inside the page.
    Downloads(Vec<Download>),
}

impl Block {
    /// A heading.
    pub fn heading(level: u8, text: impl Into<String>) -> Block {
        Block::Heading { level, text: text.into() }
    }

    /// A paragraph.
    pub fn paragraph(rich: impl Into<Rich>) -> Block {
        Block::Paragraph(rich.into())
    }
}

/// A formula in the forms that the writers need.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Formula {
    /// A `<math>` element. It is trusted: whoever makes it escapes the user's names in it.
    pub mathml: String,
    /// The same as Unicode text; it may have several lines.
    pub text: String,
}

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
}

impl Rich {
    /// All of it as plain text.
    pub fn plain(&self, language: Language) -> String {
        let pieces = self.0.iter().map(|piece| match piece {
            Inline::Words(words) => words.clone(),
            Inline::Formula(formula) => formula.text.clone(),
            Inline::Symbol(name) => crate::symbol::plain(name, language),
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

/// A file that the reader of a page can take.
#[derive(Clone, Debug)]
pub struct Download {
    /// File name, as the reader will see it.
    pub name: String,
    /// What it is.
    pub label: String,
    /// Where its content is.
    pub content: Content,
}

/// Where the content of a [`Download`] is.
#[derive(Clone, Debug)]
pub enum Content {
    /// In a file beside the page, under [`Download::name`].
    Beside,
    /// Inside the page.
    Inside {
        /// Media type, `text/csv`.
        media: String,
        /// The bytes.
        bytes: Vec<u8>,
    },
}
