//! From a file to a machine, step by step; every step makes something new out of what came before, and nothing is changed afterwards.

use super::built::{Machine, Origin, lower};
use super::study::Studies;
use super::unknowns;
use crate::answers::meaning;
use crate::failure::{Failure, in_words};
use crate::frame;
use crate::frame::mount::Mount;
use crate::frame::renew::{Again, Form};
use crate::source::Source;
use crate::watch::{Lap, Watch};
use mechanics::derive::{Detail, derive_in};
use mechanics::{Model, Reading};
use std::sync::Arc;
use symbolic::Equations;
use words::{Message, Notice};

/// Reads a model file with the studies that it may ask for.
///
/// # Errors
/// All findings; at least one of them is an error.
pub fn read(source: &Source, overrides: &[(String, String)], studies: &Studies) -> Result<Reading, Vec<Notice>> {
    let reading = mechanics::read_with(&source.text, &source.path, overrides, studies.kinds())?;
    let found = meaning::findings(&reading.model, &|kind| studies.find(kind).is_some());
    if found.is_empty() { Ok(reading) } else { Err(reading.warnings.into_iter().chain(found).collect()) }
}

impl Again for Origin {
    fn overrides(&self) -> &[(String, String)] {
        &self.overrides
    }

    fn read(&self, overrides: &[(String, String)]) -> Result<Model, Box<Message>> {
        let source = Box::new(self.source.clone());
        let findings = |diagnostics| in_words(Failure::Findings { source, diagnostics }).message;
        read(&self.source, overrides, self.studies).map(|reading| reading.model).map_err(findings)
    }
}

/// From a file to a machine.
///
/// # Errors
/// Findings about the model.
pub fn build(origin: Origin, detail: Detail, watch: &mut Watch) -> Result<Machine, Failure> {
    build_as(origin, (detail, Form::Own), watch)
}

/// The same with the numbers of its frame in a form.
///
/// # Errors
/// Findings about the model.
pub fn build_as(origin: Origin, (detail, form): (Detail, Form), watch: &mut Watch) -> Result<Machine, Failure> {
    let findings = |diagnostics| Failure::Findings { source: Box::new(origin.source.clone()), diagnostics };
    let reading = read(&origin.source, &origin.overrides, origin.studies).map_err(findings)?;
    let alike = crate::letters::printed_alike(&reading.model);
    let again: Arc<dyn Again> = Arc::new(origin.clone());
    let Mount { model, remarks, renewal } = frame::mount::mounted(reading.model, (&again, form))?;
    watch.lap(Lap::Read);
    let equations = Equations { mounted: renewal, ..derive_in(&model, detail).map_err(findings)? };
    let equations = numbered(&model, equations).map_err(Notice::from)?;
    let model = found(model, &equations);
    watch.lap(Lap::Derive);
    let system = lower(&equations).map_err(Notice::from)?;
    watch.lap(Lap::Lower);
    let warnings = reading.warnings.into_iter().chain(alike).chain(remarks).collect();
    let model_hash = origin.source.hash(&origin.overrides);
    Ok(Machine { model, warnings, equations, system, model_hash, origin })
}

/// The model with the unknowns that were found, where its frame, which is computed from the model too, depends on them.
fn found(mut model: Model, equations: &Equations) -> Model {
    let of_frame: Vec<(String, f64)> = equations
        .parameters
        .iter()
        .filter(|p| model.unknowns.contains(&p.symbol) && equations.is_mounted_on(p.symbol))
        .map(|p| (equations.graph.symbol_info(p.symbol).name.clone(), p.value))
        .collect();
    if of_frame.is_empty() {
        return model;
    }
    let values: Vec<(&str, f64)> = of_frame.iter().map(|(name, value)| (name.as_str(), *value)).collect();
    if let Some(change) = model.change(&values) {
        model.put(&change, &|_, value| format!("{value}"));
    }
    for p in &mut model.parameters {
        let found = equations.parameters.iter().find(|e| e.symbol == p.symbol);
        p.number = found.map_or(p.number, |e| Some(e.value));
    }
    model
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
