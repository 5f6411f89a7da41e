//! What ends a command early: findings about the model, or one trouble with its cause and cure.

use crate::source::Source;
use words::{Notice, Place, Severity};

/// Why a command cannot go on.
#[derive(Clone, Debug)]
pub enum Failure {
    /// Findings about the model, at least one of them an error.
    Findings {
        /// The file they are about.
        source: Box<Source>,
        /// The findings.
        diagnostics: Vec<Notice>,
    },
    /// The model, a calculation or a disk failed.
    Trouble(Box<Notice>),
    /// The command line asks for something that does not exist.
    Misuse(Box<Notice>),
    /// Whoever read the output went away; nothing to say.
    ClosedPipe,
}

/// Code of a path that leads nowhere.
pub const NO_FILE: &str = "C001";

impl Failure {
    /// 0 done, 1 model or check failed, 2 wrong use.
    pub fn exit_code(&self) -> u8 {
        match self {
            Failure::Findings { diagnostics, .. } => {
                let mut errors = diagnostics.iter().filter(|d| d.severity == Severity::Error);
                // a model that only the command line spoils is wrong use
                if errors.all(|d| matches!(d.place, Place::Override { .. })) { 2 } else { 1 }
            }
            // a path that leads nowhere is a slip on the command line
            Failure::Trouble(t) if t.code == NO_FILE => 2,
            Failure::Trouble(_) => 1,
            Failure::Misuse(_) => 2,
            Failure::ClosedPipe => 0,
        }
    }
}

/// What is wrong use of the command line.
pub trait Misuse {
    /// The failure of a wrong use.
    fn misuse(self) -> Failure;
}

impl Misuse for Notice {
    fn misuse(self) -> Failure {
        Failure::Misuse(Box::new(self))
    }
}

impl From<Notice> for Failure {
    fn from(notice: Notice) -> Failure {
        Failure::Trouble(Box::new(notice))
    }
}

impl From<Box<Notice>> for Failure {
    fn from(notice: Box<Notice>) -> Failure {
        Failure::Trouble(notice)
    }
}

/// A failure that stands beside results.
pub fn in_words(failure: Failure) -> Notice {
    match failure {
        Failure::Trouble(trouble) | Failure::Misuse(trouble) => *trouble,
        Failure::Findings { diagnostics, .. } => {
            let first = diagnostics.into_iter().find(|d| d.severity == Severity::Error);
            match first {
                Some(d) => Notice::from(*d.message),
                None => Notice::new("C031", "the model cannot be built with these values", "с этими значениями модель не строится"),
            }
        }
        Failure::ClosedPipe => Notice::new("C031", "the output was closed", "вывод закрыт"),
    }
}
