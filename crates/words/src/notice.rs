//! What is wrong, where, the likely cause, the cure: the one form in which every room refuses or warns.

use crate::{Text, letters};
use std::fmt;
use std::ops::{Deref, DerefMut, Range};

/// How bad it is.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub enum Severity {
    /// There is no result.
    Error,
    /// There is a result, but something is probably not meant.
    Warning,
}

/// Where the faulty text stands; ranges count bytes.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub enum Place {
    /// In no text: a state, a calculation, a disk.
    #[default]
    Nowhere,
    /// A range of a piece of text whose own place is not known here.
    Piece(Range<usize>),
    /// A range of the model file.
    File(Range<usize>),
    /// A `--set name=quantity`.
    Override {
        /// Number in the list of overrides, from 0.
        index: usize,
        /// The text `name=quantity`.
        text: String,
        /// Range of that text.
        span: Range<usize>,
    },
    /// A key of a study that the command line gives in the place of the file.
    CommandLine {
        /// The line as it would stand in the file: `period = "1 kg"`.
        text: String,
        /// Range of that text.
        span: Range<usize>,
    },
}

/// The words of a notice.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct Message {
    /// Code of the explanation: `M021`.
    pub code: &'static str,
    /// What is wrong, with value and limit.
    pub what: Text,
    /// The likely physical cause; may be empty.
    pub why: Text,
    /// The cure; may be empty.
    pub help: Text,
}

/// Something wrong: its words, how bad it is, and where. The words stand behind a pointer, because results carry notices.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Notice {
    /// How bad it is.
    pub severity: Severity,
    /// Where.
    pub place: Place,
    /// Other places in the file that belong to it.
    pub related: Vec<(Range<usize>, Text)>,
    /// The words.
    pub message: Box<Message>,
}

impl From<Message> for Notice {
    fn from(message: Message) -> Notice {
        Notice { severity: Severity::Error, place: Place::Nowhere, related: Vec::new(), message: Box::new(message) }
    }
}

impl Notice {
    /// An error that has no place in a text.
    pub fn new(code: &'static str, en: impl Into<String>, ru: impl Into<String>) -> Notice {
        Notice::from(Message { code, what: Text::new(en, ru), ..Message::default() })
    }
    /// An error in a range of a piece of text.
    pub fn piece(code: &'static str, span: Range<usize>, en: impl Into<String>, ru: impl Into<String>) -> Notice {
        Notice { place: Place::Piece(span), ..Notice::new(code, en, ru) }
    }
    /// An error in a range of the model file.
    pub fn file(code: &'static str, span: Range<usize>, what: Text) -> Notice {
        Notice { place: Place::File(span), ..Notice::from(Message { code, what, ..Message::default() }) }
    }
    /// The same as a warning.
    pub fn warning(self) -> Notice {
        Notice { severity: Severity::Warning, ..self }
    }
    /// Adds the likely cause.
    pub fn why(self, en: impl Into<String>, ru: impl Into<String>) -> Notice {
        self.because(Text::new(en, ru))
    }
    /// Adds the cure.
    pub fn help(self, en: impl Into<String>, ru: impl Into<String>) -> Notice {
        self.cure(Text::new(en, ru))
    }
    /// Adds the likely cause.
    pub fn because(mut self, why: Text) -> Notice {
        self.why = why;
        self
    }
    /// Adds the cure.
    pub fn cure(mut self, help: Text) -> Notice {
        self.help = help;
        self
    }
    /// Offers the name that was meant; of names that look alike it says which letter is which.
    pub fn meant(self, word: &str, near: &str) -> Notice {
        self.cure(meant(word, near))
    }
    /// Adds another place in the file.
    pub fn related(mut self, span: Range<usize>, text: Text) -> Notice {
        self.related.push((span, text));
        self
    }
    /// The range in the file.
    pub fn span(&self) -> Option<Range<usize>> {
        match &self.place {
            Place::File(span) => Some(span.clone()),
            _ => None,
        }
    }
    /// The range in its text, whatever text that is; empty where there is none.
    pub fn range(&self) -> Range<usize> {
        match &self.place {
            Place::Nowhere => 0..0,
            Place::Piece(span) | Place::File(span) | Place::Override { span, .. } | Place::CommandLine { span, .. } => span.clone(),
        }
    }
    /// The same notice in a text in which its piece begins at byte `by`.
    pub fn shifted(mut self, by: usize) -> Notice {
        if let Place::Piece(span) = &mut self.place {
            *span = span.start + by..span.end + by;
        }
        self
    }
}

impl Deref for Notice {
    type Target = Message;
    fn deref(&self) -> &Message {
        &self.message
    }
}

impl DerefMut for Notice {
    fn deref_mut(&mut self) -> &mut Message {
        &mut self.message
    }
}

impl fmt::Display for Notice {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "error[{}]: {}\n  why: {}\n  help: {}", self.code, self.what.en, self.why.en, self.help.en)
    }
}

impl std::error::Error for Notice {}

/// "Did you mean", with the letters in which two names that look alike differ.
pub fn meant(word: &str, near: &str) -> Text {
    let plain = Text::new(format!("did you mean `{near}`?"), format!("может быть, `{near}`?"));
    let alike = letters::twin(word, [near]).is_some();
    let Some((typed, known)) = letters::difference(word, near).filter(|_| alike) else { return plain };
    let ((typed_en, typed_ru), (known_en, known_ru)) = (letters::alphabet(typed), letters::alphabet(known));
    Text::new(
        format!("{} With {known} ({known_en}); here stands {typed} ({typed_en})", plain.en),
        format!("{} В нём {known} ({known_ru}), а здесь {typed} ({typed_ru})", plain.ru),
    )
}

/// Sorts by place: the file, overrides, the command line; drops exact repetitions.
pub fn sort(notices: &mut Vec<Notice>) {
    let key = |n: &Notice| match &n.place {
        Place::Nowhere => (0, 0, 0, n.code),
        Place::File(span) | Place::Piece(span) => (0, span.start, span.end, n.code),
        Place::Override { index, span, .. } => (1 + index, span.start, span.end, n.code),
        Place::CommandLine { span, .. } => (usize::MAX, span.start, span.end, n.code),
    };
    notices.sort_by_key(key);
    notices.dedup();
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn overrides_come_after_the_file_and_repetitions_go() {
        let set = Notice { place: Place::Override { index: 0, text: "m=1".into(), span: 0..1 }, ..Notice::new("M020", "a", "б") };
        let (late, early) = (Notice::file("M001", 9..10, Text::same("x")), Notice::file("M002", 1..2, Text::same("y")));
        let mut all = vec![set.clone(), late.clone(), early.clone(), late.clone()];
        sort(&mut all);
        assert_eq!(all, [early, late, set]);
    }

    #[test]
    fn a_piece_moves_with_its_text() {
        assert_eq!(Notice::piece("M021", 1..2, "a", "б").shifted(10).place, Place::Piece(11..12));
        assert_eq!(Notice::new("S001", "a", "б").shifted(10).place, Place::Nowhere);
    }

    #[test]
    fn letters_that_look_alike_are_named() {
        assert_eq!(meant("с", "c").en, "did you mean `c`? With c (Latin); here stands с (Cyrillic)");
        assert_eq!(meant("mas", "mass").ru, "может быть, `mass`?");
    }
}
