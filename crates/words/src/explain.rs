//! Long explanations of the codes of notices: `strutt explain M021`. One row a code, in a table of the room that raises it.

use crate::Language;

/// The explanation of a code.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Explanation {
    /// Code.
    pub code: &'static str,
    /// Title, English and Russian.
    pub title: (&'static str, &'static str),
    /// What is behind it, English and Russian.
    pub text: (&'static str, &'static str),
    /// How it looks wrong; empty where no file shows it.
    pub wrong: &'static str,
    /// How it looks right; may be empty.
    pub right: &'static str,
}

impl Explanation {
    /// Title in a language.
    pub fn title(&self, language: Language) -> &'static str {
        language.pick(self.title.0, self.title.1)
    }
    /// What is behind it, in a language.
    pub fn text(&self, language: Language) -> &'static str {
        language.pick(self.text.0, self.text.1)
    }
}

/// A row with a wrong and a right example.
pub const fn row(
    code: &'static str,
    title: (&'static str, &'static str),
    text: (&'static str, &'static str),
    wrong: &'static str,
    right: &'static str,
) -> Explanation {
    Explanation { code, title, text, wrong, right }
}

/// A row of what no line of a file shows.
pub const fn plain(code: &'static str, title: (&'static str, &'static str), text: (&'static str, &'static str)) -> Explanation {
    row(code, title, text, "", "")
}
