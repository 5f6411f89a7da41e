//! From a file to a machine, step by step; every step makes something new out of what came before, and nothing is changed afterwards.

use super::built::{Machine, Origin, lower};
use super::study::Studies;
use super::unknowns;
use crate::answers::meaning;
use crate::failure::Failure;
use crate::frame;
use crate::source::Source;
use crate::watch::{Lap, Watch};
use mechanics::derive::{Detail, derive_in};
use mechanics::{Model, Reading};
use symbolic::Equations;
use words::Notice;

/// Reads a model file with the studies that it may ask for.
///
/// # Errors
/// All findings; at least one of them is an error.
pub fn read(source: &Source, overrides: &[(String, String)], studies: &Studies) -> Result<Reading, Vec<Notice>> {
    let reading = mechanics::read_with(&source.text, &source.path, overrides, studies.kinds())?;
    let found = meaning::findings(&reading.model, &|kind| studies.find(kind).is_some());
    if found.is_empty() { Ok(reading) } else { Err(reading.warnings.into_iter().chain(found).collect()) }
}

/// From a file to a machine.
///
/// # Errors
/// Findings about the model.
pub fn build(origin: Origin, detail: Detail, watch: &mut Watch) -> Result<Machine, Failure> {
    let findings = |diagnostics| Failure::Findings { source: Box::new(origin.source.clone()), diagnostics };
    let reading = read(&origin.source, &origin.overrides, origin.studies).map_err(findings)?;
    let alike = crate::letters::printed_alike(&reading.model);
    let (model, remarks) = frame::mount::mounted(reading.model)?;
    watch.lap(Lap::Read);
    let equations = derive_in(&model, detail).map_err(findings)?;
    let equations = numbered(&model, equations).map_err(Notice::from)?;
    watch.lap(Lap::Derive);
    let system = lower(&equations).map_err(Notice::from)?;
    watch.lap(Lap::Lower);
    let warnings = reading.warnings.into_iter().chain(alike).chain(remarks).collect();
    let model_hash = origin.source.hash(&origin.overrides);
    Ok(Machine { model, warnings, equations, system, model_hash, origin })
}

/// The equations with the numbers that the file does not give: places at the start, unknown parameters.
///
/// # Errors
/// Nothing closes, nothing rests.
pub fn numbered(model: &Model, mut equations: Equations) -> Result<Equations, analysis::Fault> {
    analysis::connections::settle_starts(&mut equations)?;
    unknowns::solve(model, &mut equations)?;
    // an unknown may be a length
    analysis::connections::settle_starts(&mut equations)?;
    Ok(equations)
}
