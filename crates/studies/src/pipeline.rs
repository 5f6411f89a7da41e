//! strutt from top to bottom. Each verb is one call into one room, and nothing is changed after it was made:
//!
//! | step | room |
//! |---|---|
//! | file -> model | `mechanics::read_with`, with the keys of the studies |
//! | model -> model with its frame | `frame::mount`, by `structures` |
//! | model -> equations | `mechanics::derive`, Lagrange and Newton-Euler |
//! | equations -> equations with numbers | `machine::unknowns`, starts that close |
//! | equations -> machine | `program` lowers, `analysis::Machine` holds |
//! | machine -> results | a study of the table |
//! | results -> document | `document`; `written`, to be handed in |
//! | document -> a format | `report` |

use crate::claims;
use crate::document;
use crate::failure::Failure;
use crate::machine;
use crate::results::{Extent, Results};
use crate::source::Source;
use crate::watch::Watch;
use crate::{Origin, STUDIES, written};
use mechanics::asked::Asked;
use mechanics::derive::Detail;
use report::Document;
use words::Language;

pub use crate::calculation::Calculation;
pub use crate::machine::{Machine, no_numbers};

/// From a file to all results.
///
/// # Errors
/// Findings about the model. What ends a study early stands beside its results.
pub fn run(source: &Source, overrides: &[(String, String)], watch: &mut Watch) -> Result<Calculation, Failure> {
    let mut machine = build_in(source, overrides, Detail::Steps, watch)?;
    let mut results: Vec<Results> = Vec::new();
    for asked in &machine.model.studies.clone() {
        if watch.is_interrupted() {
            break;
        }
        results.extend(study(&mut machine, asked, watch));
    }
    if !watch.is_interrupted() {
        results.extend(claims::run(&mut machine, watch));
    }
    Ok(Calculation { machine, results, files: Vec::new() })
}

/// From a file to a machine, without the written derivation.
///
/// # Errors
/// Findings about the model.
pub fn build(source: &Source, overrides: &[(String, String)], watch: &mut Watch) -> Result<Machine, Failure> {
    build_in(source, overrides, Detail::Equations, watch)
}

/// From a file to a machine.
///
/// # Errors
/// Findings about the model.
pub fn build_in(source: &Source, overrides: &[(String, String)], detail: Detail, watch: &mut Watch) -> Result<Machine, Failure> {
    machine::build(Origin { source: source.clone(), overrides: overrides.to_vec(), studies: &STUDIES }, detail, watch)
}

/// One study of the file; none where it computes no numbers.
pub fn study(machine: &mut Machine, asked: &Asked, watch: &mut Watch) -> Option<Results> {
    machine.origin.studies.find(asked.kind)?.run(machine, asked, watch)
}

/// The page of a calculation.
pub fn document(calculation: &Calculation, extent: Extent, language: Language) -> Document {
    // a page is set as the written calculation is
    let step = written::steps(calculation, language);
    let signs = if extent == Extent::Page { written::signs(calculation) } else { Vec::new() };
    let setting = document::Setting { signs, step: &step };
    document::compose(calculation, (extent, language), &setting)
}

/// The written calculation that is handed in.
pub fn report(calculation: &Calculation, language: Language) -> Document {
    written::compose(calculation, language)
}
