//! What ends a command early: findings about the model, or one trouble with its cause and cure.

use crate::source::Source;
use mechanics::{Diagnostic, Severity, Source as Place};
use words::Text;

/// Why a command cannot go on.
#[derive(Clone, Debug)]
pub enum Failure {
    /// Findings about the model, at least one of them an error.
    Findings {
        /// The file they are about.
        source: Box<Source>,
        /// The findings.
        diagnostics: Vec<Diagnostic>,
    },
    /// The model, a calculation or a disk failed.
    Trouble(Box<Trouble>),
    /// The command line asks for something that does not exist.
    Misuse(Box<Trouble>),
    /// Whoever read the output went away; nothing to say.
    ClosedPipe,
}

impl Failure {
    /// 0 done, 1 model or check failed, 2 wrong use.
    pub fn exit_code(&self) -> u8 {
        match self {
            Failure::Findings { diagnostics, .. } => {
                let mut errors = diagnostics.iter().filter(|d| d.severity == Severity::Error);
                // a model that only the command line spoils is wrong use
                if errors.all(|d| matches!(d.source, Place::Override { .. })) { 2 } else { 1 }
            }
            // a path that leads nowhere is a slip on the command line
            Failure::Trouble(t) if t.code == "C001" => 2,
            Failure::Trouble(_) => 1,
            Failure::Misuse(_) => 2,
            Failure::ClosedPipe => 0,
        }
    }
}

/// Something wrong that has no place in the model file.
#[derive(Clone, Debug, PartialEq)]
pub struct Trouble {
    /// Code for `strutt explain`.
    pub code: &'static str,
    /// What is wrong.
    pub what: Text,
    /// The likely cause; may be empty.
    pub why: Text,
    /// The cure; may be empty.
    pub help: Text,
}

impl Trouble {
    /// Without cause and cure.
    pub fn new(code: &'static str, en: impl Into<String>, ru: impl Into<String>) -> Trouble {
        Trouble { code, what: Text::new(en, ru), why: Text::default(), help: Text::default() }
    }
    /// Adds the likely cause.
    pub fn why(mut self, en: impl Into<String>, ru: impl Into<String>) -> Trouble {
        self.why = Text::new(en, ru);
        self
    }
    /// Adds the cure.
    pub fn help(mut self, en: impl Into<String>, ru: impl Into<String>) -> Trouble {
        self.help = Text::new(en, ru);
        self
    }
    /// As wrong use of the command line.
    pub fn misuse(self) -> Failure {
        Failure::Misuse(Box::new(self))
    }
}

impl From<Trouble> for Failure {
    fn from(trouble: Trouble) -> Failure {
        Failure::Trouble(Box::new(trouble))
    }
}

impl From<Box<Trouble>> for Failure {
    fn from(trouble: Box<Trouble>) -> Failure {
        Failure::Trouble(trouble)
    }
}

impl From<analysis::Fault> for Trouble {
    fn from(fault: analysis::Fault) -> Trouble {
        Trouble { code: fault.code, what: fault.what.clone(), why: fault.why.clone(), help: fault.help.clone() }
    }
}
