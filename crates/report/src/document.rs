//! The written calculation as a list of blocks, before it becomes a page or terminal text.
//!
//! A document is in one language: the caller picks the wording when it builds the blocks. Figures, tables and equations are
//! numbered by the writers in the order of the blocks, so that a caption never needs a number.

use crate::figure::Figure;
use crate::figure::bands::Bands;
use crate::scheme::{Moving, Scheme};
use crate::table::Table;
use words::Language;

pub use crate::formula::Formula;
pub use crate::rich::{Inline, Rich};

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
    /// The machine as a drawing of symbols; numbered as a figure.
    Scheme(Scheme),
    /// The machine in motion: played by pages, left out by all other formats.
    Moving(Moving),
    /// Something that opens on demand (always open in terminal text).
    Details {
        /// The line that is always seen.
        summary: String,
        /// What it opens.
        blocks: Vec<Block>,
    },
    /// Files beside or inside the page.
    Downloads(Vec<Download>),
    /// A title page; the document needs no title above it.
    Front(Front),
    /// The list of headings of levels 1 and 2.
    Contents,
    /// Text of a file, letter by letter.
    Verbatim(String),
}

/// A title page: lines above, the title, who made it, lines below.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Front {
    /// Organisation, department.
    pub above: Vec<String>,
    /// What the work is.
    pub kind: String,
    /// What it is about.
    pub subject: String,
    /// Lines below it: the discipline, the variant.
    pub about: Vec<String>,
    /// A person: what for, who; an empty name is a line to sign on.
    pub people: Vec<(String, String)>,
    /// City and year.
    pub below: String,
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

impl Document {
    /// Whether it begins with a title page.
    pub fn has_front(&self) -> bool {
        matches!(self.blocks.first(), Some(Block::Front(_)))
    }

    /// Headings of levels 1 and 2 when the document lists them.
    pub fn contents(&self) -> Vec<(u8, &str)> {
        if !self.blocks.iter().any(|block| matches!(block, Block::Contents)) {
            return Vec::new();
        }
        let heading = |block: &'_ Block| matches!(block, Block::Heading { level: 1 | 2, .. });
        let listed = self.blocks.iter().filter(|block| heading(block));
        listed.filter_map(|block| if let Block::Heading { level, text } = block { Some((*level, text.as_str())) } else { None }).collect()
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
