//! A finding about a piece of text, before it is known where that text stands; and the piece of text with its place.

use crate::diagnostic::{Diagnostic, Severity, Source};
use std::borrow::Cow;
use std::ops::Range;
use words::{Text, letters};

/// A finding inside a piece of text; the range counts bytes from its start.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Fault {
    /// Code of the explanation.
    pub code: &'static str,
    /// How bad it is.
    pub severity: Severity,
    /// Where, in bytes of the piece.
    pub span: Range<usize>,
    /// What to say.
    pub words: Box<Words>,
}

/// The wording of a finding.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct Words {
    /// What is wrong.
    pub what: Text,
    /// The likely cause; may be empty.
    pub why: Text,
    /// The cure; may be empty.
    pub help: Text,
}

impl Fault {
    pub(crate) fn new(code: &'static str, span: Range<usize>, en: impl Into<String>, ru: impl Into<String>) -> Fault {
        let words = Words { what: Text::new(en, ru), ..Words::default() };
        Fault { code, severity: Severity::Error, span, words: Box::new(words) }
    }
    pub(crate) fn why(mut self, en: impl Into<String>, ru: impl Into<String>) -> Fault {
        self.words.why = Text::new(en, ru);
        self
    }
    pub(crate) fn help(mut self, en: impl Into<String>, ru: impl Into<String>) -> Fault {
        self.words.help = Text::new(en, ru);
        self
    }
    pub(crate) fn warning(mut self) -> Fault {
        self.severity = Severity::Warning;
        self
    }
    /// Offers the name that was meant; of names that look alike it says which letter is which.
    pub(crate) fn meant(self, word: &str, near: &str) -> Fault {
        let (en, ru) = meant(word, near);
        self.help(en, ru)
    }
    /// The same finding in a text in which this one begins at byte `by`.
    pub(crate) fn shifted(mut self, by: usize) -> Fault {
        self.span = self.span.start + by..self.span.end + by;
        self
    }
}

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
    pub(crate) fn source(&self, span: Range<usize>) -> Source {
        match self {
            Site::Literal(from) => Source::File(from + span.start..from + span.end),
            Site::Inside(range) => Source::File(range.clone()),
            Site::Override { index, text, from } => {
                Source::Override { index: *index, text: text.clone(), span: from + span.start..from + span.end }
            }
        }
    }
    pub(crate) fn diagnose(&self, fault: Fault) -> Diagnostic {
        Diagnostic {
            code: fault.code,
            severity: fault.severity,
            source: self.source(fault.span),
            what: fault.words.what,
            why: fault.words.why,
            help: fault.words.help,
            related: Vec::new(),
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
    pub(crate) fn diagnose(&self, fault: Fault) -> Diagnostic {
        self.site.diagnose(fault)
    }
}

/// "Did you mean", in both languages.
fn meant(word: &str, near: &str) -> (String, String) {
    let (en, ru) = (format!("did you mean `{near}`?"), format!("может быть, `{near}`?"));
    let alike = letters::twin(word, [near]).is_some();
    match letters::difference(word, near).filter(|_| alike) {
        Some((typed, known)) => {
            let ((typed_en, typed_ru), (known_en, known_ru)) = (letters::alphabet(typed), letters::alphabet(known));
            (
                format!("{en} With {known} ({known_en}); here stands {typed} ({typed_en})"),
                format!("{ru} В нём {known} ({known_ru}), а здесь {typed} ({typed_ru})"),
            )
        }
        None => (en, ru),
    }
}

thread_local! {
    /// How many more suggestions this reading may look for: a file of a hundred thousand slips must not cost as many searches.
    static SEARCHES: std::cell::Cell<usize> = const { std::cell::Cell::new(SEARCH_LIMIT) };
}
const SEARCH_LIMIT: usize = 300;

/// Grants a new reading its suggestions.
pub(crate) fn renew_searches() {
    SEARCHES.with(|s| s.set(SEARCH_LIMIT));
}

/// Takes one search from the allowance.
pub(crate) fn may_search() -> bool {
    SEARCHES.with(|s| {
        let left = s.get();
        s.set(left.saturating_sub(1));
        left > 0
    })
}

/// The nearest of the candidates to a misspelt word, when it is near enough to be meant and this reading may still search.
pub(crate) fn nearest<'a>(word: &str, candidates: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    may_search().then(|| words::nearest(word, candidates)).flatten()
}
