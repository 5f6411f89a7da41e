//! Diagnostics: what is wrong, where, the likely physical cause, the cure.

use std::ops::Range;
use words::Text;

/// How bad it is.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub enum Severity {
    /// The model cannot be used.
    Error,
    /// The model can be used, but something in it is probably not meant.
    Warning,
}

/// Where the faulty text comes from.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum Source {
    /// The model file: a range of bytes.
    File(Range<usize>),
    /// A `--set name=quantity`: its number in the list, and a range of bytes in `name=quantity`.
    Override {
        /// Number in the list of overrides, from 0.
        index: usize,
        /// The text `name=quantity`.
        text: String,
        /// Range of bytes in that text.
        span: Range<usize>,
    },
    /// A key of a study that the command line gives in the place of the file.
    CommandLine {
        /// The line as it would stand in the file: `period = "1 kg"`.
        text: String,
        /// Range of bytes in that text.
        span: Range<usize>,
    },
}

/// A finding about a model.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Diagnostic {
    /// Code of the explanation: `M012`.
    pub code: &'static str,
    /// How bad it is.
    pub severity: Severity,
    /// Where.
    pub source: Source,
    /// What is wrong, with value and limit.
    pub what: Text,
    /// The likely physical cause; may be empty.
    pub why: Text,
    /// The cure; may be empty.
    pub help: Text,
    /// Other places in the file that belong to it.
    pub related: Vec<(Range<usize>, Text)>,
}

impl Diagnostic {
    /// An error in the file.
    pub fn error(code: &'static str, span: Range<usize>, what: Text) -> Diagnostic {
        Diagnostic {
            code,
            severity: Severity::Error,
            source: Source::File(span),
            what,
            why: Text::default(),
            help: Text::default(),
            related: Vec::new(),
        }
    }
    /// A warning about the file.
    pub fn warning(code: &'static str, span: Range<usize>, what: Text) -> Diagnostic {
        Diagnostic { severity: Severity::Warning, ..Diagnostic::error(code, span, what) }
    }
    /// Adds the likely cause.
    pub fn why(mut self, why: Text) -> Diagnostic {
        self.why = why;
        self
    }
    /// Adds the cure.
    pub fn help(mut self, help: Text) -> Diagnostic {
        self.help = help;
        self
    }
    /// Adds another place in the file.
    pub fn related(mut self, span: Range<usize>, text: Text) -> Diagnostic {
        self.related.push((span, text));
        self
    }
    /// Place in the file; `None` for an override.
    pub fn span(&self) -> Option<Range<usize>> {
        match &self.source {
            Source::File(span) => Some(span.clone()),
            Source::Override { .. } | Source::CommandLine { .. } => None,
        }
    }
}

/// Sorts by place in the file, overrides last, and drops exact repetitions.
pub fn sort(diagnostics: &mut Vec<Diagnostic>) {
    let key = |d: &Diagnostic| match &d.source {
        Source::File(span) => (0, span.start, span.end, d.code),
        Source::Override { index, span, .. } => (1 + index, span.start, span.end, d.code),
        Source::CommandLine { span, .. } => (usize::MAX, span.start, span.end, d.code),
    };
    diagnostics.sort_by_key(key);
    diagnostics.dedup();
}
