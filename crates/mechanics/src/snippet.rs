//! A piece of text with its place, and what turns a notice about the piece into one about the file.

use std::borrow::Cow;
use std::ops::Range;
use words::{Notice, Place};

/// Where a piece of text stands.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(crate) enum Site {
    /// In the file from this byte on, literally.
    Literal(usize),
    /// Somewhere inside this range of the file (a string with escapes, a number).
    Inside(Range<usize>),
    /// In an override from this byte on.
    Override { index: usize, text: String, from: usize },
}

impl Site {
    fn place(&self, span: Range<usize>) -> Place {
        match self {
            Site::Literal(from) => Place::File(from + span.start..from + span.end),
            Site::Inside(range) => Place::File(range.clone()),
            Site::Override { index, text, from } => {
                Place::Override { index: *index, text: text.clone(), span: from + span.start..from + span.end }
            }
        }
    }
    /// The notice about a range of the piece, about the text in which it stands.
    pub(crate) fn diagnose(&self, notice: Notice) -> Notice {
        match notice.place.clone() {
            Place::Piece(span) => Notice { place: self.place(span), ..notice },
            _ => notice,
        }
    }
}

/// A piece of text and where it stands.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(crate) struct Snippet<'a> {
    pub text: Cow<'a, str>,
    pub site: Site,
}

impl<'a> Snippet<'a> {
    /// A part of it, by bytes.
    pub(crate) fn part(&self, span: Range<usize>) -> Snippet<'a> {
        let site = match &self.site {
            Site::Literal(from) => Site::Literal(from + span.start),
            Site::Inside(range) => Site::Inside(range.clone()),
            Site::Override { index, text, from } => Site::Override { index: *index, text: text.clone(), from: from + span.start },
        };
        let text = match &self.text {
            Cow::Borrowed(s) => Cow::Borrowed(&s[span]),
            Cow::Owned(s) => Cow::Owned(s[span].to_owned()),
        };
        Snippet { text, site }
    }
    /// Where it stands in the file; nowhere when it was set from outside.
    pub(crate) fn place(&self) -> Option<Range<usize>> {
        match &self.site {
            Site::Literal(from) => Some(*from..from + self.text.len()),
            Site::Inside(range) => Some(range.clone()),
            Site::Override { .. } => None,
        }
    }
    /// Without white space at both ends.
    pub(crate) fn trimmed(&self) -> Snippet<'a> {
        let start = self.text.len() - self.text.trim_start().len();
        let end = start + self.text.trim().len();
        self.part(start..end)
    }
    /// All of it.
    pub(crate) fn all(&self) -> Range<usize> {
        0..self.text.len()
    }
    pub(crate) fn diagnose(&self, notice: Notice) -> Notice {
        self.site.diagnose(notice)
    }
}
