//! What a file may ask: one study, one file, one row of [`TABLE`].
//!
//! A study says its keys ([`Study::kind`]), is carried out on a machine ([`Study::run`]) and gives what it found. From its keys follow the reader of
//! `[[study]]`, the options of `strutt NAME` with their help in both languages, the completions of shells and the reference of the model file.

// a study fails once: what it says may be large
#![allow(clippy::result_large_err)]

pub mod claims;
pub mod cycle;
pub mod document;
pub mod equations;
pub mod equilibrium;
pub mod failure;
pub mod frictions;
pub mod guards;
pub mod inverse;
mod keys;
pub mod kinematics;
mod letters;
mod machine;
pub mod modes;
pub mod periodic;
pub mod phases;
pub mod pipeline;
pub mod plan;
pub mod poincare;
mod provenance;
pub mod response;
pub mod results;
mod section;
pub mod sections;
pub mod simulate;
pub mod small;
pub mod source;
pub mod statics;
mod strands;
pub mod structure;
pub mod sweep;
pub mod transient;
pub mod watch;
pub mod wording;

pub use failure::Failure;
pub use machine::origin::{Binding, Origin};
pub use results::{Alone, Extent, Fact, Results, Rows, View};
pub use source::Source;
pub use watch::Watch;

use crate::failure::Misuse;
use crate::pipeline::Machine;
use mechanics::Reading;
use mechanics::asked::{Asked, Key, Kind, Kinds, Value};
use std::sync::LazyLock;
use words::explain::Explanation;
use words::{Notice, Text};

/// Version of strutt.
pub const VERSION: &str = env!("CARGO_PKG_VERSION");

/// Every study, in the order of help and reference.
pub static TABLE: &[&dyn Study] = &[
    &equations::Equations,
    &simulate::Motion,
    &inverse::Inverse,
    &transient::ClosedForm,
    &equilibrium::Rest,
    &periodic::Regimes,
    &poincare::SectionPoints,
    &kinematics::Linkage,
    &cycle::Turn,
    &sweep::Sweeping,
    &modes::Natural,
    &statics::Statics,
    &response::Forced,
];

/// What a study found; none where it computes no numbers.
pub type Found = Option<Results>;

/// A study.
pub trait Study: Sync {
    /// Name, keys, and what the values contradict.
    fn kind(&self) -> &'static Kind;

    /// Carries it out as a file asks for it.
    fn run(&self, machine: &mut Machine, asked: &Asked, watch: &mut Watch) -> Found;

    /// Carries it out for a command of its own: exactly the rows that are asked for, no repetition that nobody asked for.
    fn command(&self, machine: &mut Machine, asked: &Asked, watch: &mut Watch) -> Found {
        self.run(machine, asked, watch)
    }

    /// Whether it has a command `strutt NAME` made of its keys.
    fn has_command(&self) -> bool {
        true
    }

    /// Kinds of studies of the file that the command takes its values from, the preferred ones first; none: its own.
    fn of_file(&self) -> &'static [&'static [&'static str]] {
        &[]
    }

    /// The study of a command: that of the file, changed by what the command line says.
    ///
    /// # Errors
    /// Something is missing, or contradicts.
    fn merge(&self, _: &Machine, given: Given) -> Result<Asked, Failure> {
        Ok(overlaid(given.written.or(given.of_file).unwrap_or_else(|| Asked::new(self.kind().name)), given.line))
    }

    /// Keys of other studies that its command takes too, because it carries these out.
    fn inner(&self) -> Vec<&'static Key> {
        Vec::new()
    }

    /// Columns that it adds to the outputs of the file.
    fn own_columns(&self, _: &Machine, _: &Asked) -> Vec<String> {
        Vec::new()
    }

    /// Options of its command that are no keys.
    fn extras(&self) -> &'static [Extra] {
        &[]
    }

    /// What becomes of it when it is interrupted.
    fn interrupts(&self) -> Interrupts {
        Interrupts::Short
    }

    /// The codes that only it raises.
    fn explanations(&self) -> &'static [Explanation] {
        &[]
    }

    /// What its repetition over values of parameters gives.
    fn repeats(&self) -> Repeats {
        Repeats::Numbers
    }
}

/// What a command line says about a study.
pub struct Given<'a> {
    /// A new study that it writes, as the reader read it.
    pub written: Option<Asked>,
    /// The study of the file.
    pub of_file: Option<Asked>,
    /// Values in place of those of the file.
    pub line: &'a Asked,
    /// Whether plots are drawn.
    pub drawn: bool,
}

/// An option of a command that is no key of the study.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Extra {
    /// The motion once more with half the tolerance.
    HalveTolerance,
    /// The motion once more with other steps.
    Check,
    /// Rows at events.
    Events,
    /// Rows at switches.
    Switches,
}

/// What becomes of a study that is interrupted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Interrupts {
    /// What is done is kept.
    Kept,
    /// It ends.
    Ending,
    /// It takes no time worth speaking of.
    Short,
}

/// What the repetition of a study gives.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Repeats {
    /// It is not repeated.
    Never,
    /// Least and greatest values of a motion, and its numbers.
    Motion,
    /// Values at rest, and its numbers.
    Rest,
    /// Its numbers.
    Numbers,
}

/// The study of that name.
pub fn find(name: &str) -> Option<&'static dyn Study> {
    TABLE.iter().find(|study| study.kind().name == name).copied()
}

/// The kinds of all studies, as the reader and the reference need them.
pub fn kinds() -> &'static Kinds {
    static KINDS: LazyLock<Kinds> = LazyLock::new(|| Kinds::new(TABLE.iter().map(|study| study.kind()).collect()));
    &KINDS
}

/// Reads a model file with its studies.
///
/// # Errors
/// All findings; at least one of them is an error.
pub fn read(source: &Source, overrides: &[(String, String)]) -> Result<Reading, Vec<Notice>> {
    mechanics::read_with(&source.text, &source.path, overrides, kinds())
}

/// The first study of the file of one of these kinds.
pub fn of_file<'m>(machine: &'m Machine, kinds: &[&str]) -> Option<&'m Asked> {
    machine.model.studies.iter().find(|asked| kinds.contains(&asked.kind))
}

/// A study with the values of the command line in place of its own.
pub fn overlaid(mut asked: Asked, line: &Asked) -> Asked {
    for (key, value) in line.values() {
        let excluded = |key: &Key, other: &str| key.excluded.is_some_and(|(name, _)| name == other);
        if let Some(kind) = find(asked.kind).map(|study| study.kind()) {
            let partners = kind.keys.iter().filter(|k| excluded(k, key) || kind.key(key).is_some_and(|own| excluded(own, k.name)));
            partners.for_each(|k| asked.unset(k.name));
        }
        asked.set(key, value.clone());
    }
    asked
}

/// C054: an option that would change nothing.
pub fn idle(option: &str, needs: &Text) -> Failure {
    Notice::new("C054", format!("{option} would change nothing"), format!("ключ {option} ничего не изменил бы"))
        .why(needs.en.clone(), needs.ru.clone())
        .misuse()
}

/// Lets a study give these columns only, and draw nothing.
pub fn observing(asked: &mut Asked, columns: Vec<String>) {
    let kind = find(asked.kind).map(|study| study.kind());
    if kind.is_some_and(|kind| kind.key("outputs").is_some() && kind.key("tolerance").is_some() && asked.kind != "transient") {
        asked.set("outputs", Value::Words(columns));
        asked.unset("plot");
    }
}
