//! What a file may ask: one study, one file, one row of [`TABLE`].
//!
//! A study says its keys ([`Study::kind`]), is carried out on a machine ([`Study::run`]) and gives what it found. From its keys follow the reader of
//! `[[study]]`, the options of `strutt NAME` with their help in both languages, the completions of shells and the reference of the model file.
//! It knows no terminal, process, file or clock.
//!
//! Rooms, in order of reading: [`source`], [`watch`], [`failure`], [`wording`], `letters` - [`results`], `provenance`, [`observable`] - [`machine`], [`frame`] - `keys`, [`plan`],
//! `section`, `naming`, `numbering`, [`guards`], [`frictions`], `strands`, [`small`], [`structure`], [`phases`] (what several studies share) - one file a study - [`repeat`], [`sweep`], [`map`], [`threshold`], [`claims`], [`answers`], [`variants`] (studies of studies) - [`sections`], [`shown`], `connections`, [`scheme`], [`calculation`], [`document`],
//! [`written`] (what is shown) - [`pipeline`] (all of it from top to bottom).

// a study fails once: what it says may be large
#![allow(clippy::result_large_err)]
#![cfg_attr(not(test), deny(clippy::disallowed_methods, clippy::too_many_lines, clippy::fn_params_excessive_bools))]

pub mod answers;
pub mod average;
pub mod calculation;
pub mod claims;
mod connections;
pub mod continuation;
pub mod cycle;
pub mod document;
pub mod equations;
pub mod equilibrium;
pub mod failure;
pub mod frame;
pub mod frictions;
pub mod guards;
pub mod inverse;
mod keys;
pub mod kinematics;
mod letters;
pub mod machine;
pub mod map;
pub mod modes;
mod naming;
mod numbering;
pub mod observable;
pub mod periodic;
pub mod phases;
pub mod pipeline;
pub mod plan;
pub mod poincare;
mod provenance;
pub mod repeat;
pub mod response;
pub mod results;
pub mod scheme;
mod section;
pub mod sections;
pub mod shown;
pub mod simulate;
pub mod small;
pub mod source;
pub mod stability;
pub mod statics;
mod strands;
pub mod structure;
pub mod sweep;
pub mod threshold;
pub mod transient;
pub mod variants;
pub mod watch;
pub mod wording;
pub mod written;

pub use failure::Failure;
pub use machine::Machine;
pub use machine::bind::{Binding, Origin};
pub use machine::study::{
    Extra, Finds, Found, Given, Interrupts, Repeats, Studies, Study, agreed, idle, of_file, overlaid, turns_of_an_angle,
};
pub use provenance::VERSION;
pub use results::{Alone, Conclusion, Extent, Fact, Next, Results, Rows, View};
pub use source::Source;
pub use watch::Watch;

use mechanics::Reading;
use mechanics::asked::Kinds;
use std::sync::LazyLock;
use words::Notice;

/// Every study, in the order of help and reference.
pub static TABLE: &[&dyn Study] = &[
    &equations::Equations,
    &simulate::Motion,
    &inverse::Inverse,
    &transient::ClosedForm,
    &equilibrium::Rest,
    &periodic::Regimes,
    &stability::Disturbances,
    &continuation::Branches,
    &poincare::SectionPoints,
    &average::SlowBalance,
    &kinematics::Linkage,
    &cycle::Turn,
    &sweep::Sweeping,
    &map::Plane,
    &threshold::Change,
    &modes::Natural,
    &statics::Statics,
    &response::Forced,
];

/// The same as a table to look names up in.
pub static STUDIES: LazyLock<Studies> = LazyLock::new(|| Studies::new(TABLE));

/// The study of that name.
pub fn find(name: &str) -> Option<&'static dyn Study> {
    STUDIES.find(name)
}

/// The kinds of all studies, as the reader and the reference need them.
pub fn kinds() -> &'static Kinds {
    STUDIES.kinds()
}

/// Reads a model file with its studies.
///
/// # Errors
/// All findings; at least one of them is an error.
pub fn read(source: &Source, overrides: &[(String, String)]) -> Result<Reading, Vec<Notice>> {
    machine::build::read(source, overrides, &STUDIES)
}
