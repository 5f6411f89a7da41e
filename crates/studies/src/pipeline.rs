//! strutt from top to bottom: read -> derive -> lower -> study -> dataset -> document. Each verb is one call into one room.

use crate::document;
use crate::failure::Failure;
use crate::source::Source;
use crate::watch::{Lap, Watch};
use crate::{Extent, Origin, Results};
use crate::{guards, provenance};
use analysis::Dataset;
use analysis::dataset::Audit;
use mechanics::Model;
use mechanics::asked::Asked;
use mechanics::derive::Detail;
use report::Document;
use report::formula::{Form, Printer};
use symbolic::Equations;
use words::{Language, Notice, Text};

/// A machine ready for studies.
#[derive(Clone, Debug)]
pub struct Machine {
    /// What the file says.
    pub model: Model,
    /// Findings that do not prevent its use.
    pub warnings: Vec<Notice>,
    /// Equations of motion.
    pub equations: Equations,
    /// The same as a program with numbers.
    pub system: analysis::Machine,
    /// Hash of the file and the overrides.
    pub model_hash: String,
    /// What it was made from.
    pub origin: Origin,
}

impl Machine {
    /// Names of the states: coordinates, rates, auxiliary states.
    pub fn system_states(&self) -> Vec<String> {
        use analysis::System;
        self.system.states().iter().map(|q| q.name.clone()).collect()
    }
}

/// Everything a file asks for.
#[derive(Clone, Debug)]
pub struct Calculation {
    /// The machine.
    pub machine: Machine,
    /// Results in the order of the studies.
    pub results: Vec<Results>,
    /// Files beside the page: name and what it is.
    pub files: Vec<(String, Text)>,
}

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
        results.extend(crate::claims::run(&mut machine, watch));
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
    let findings = |diagnostics| Failure::Findings { source: Box::new(source.clone()), diagnostics };
    let mut reading = crate::read(source, overrides).map_err(findings)?;
    reading.warnings.extend(crate::letters::printed_alike(&reading.model));
    reading.warnings.extend(crate::structure::mount::mount(&mut reading.model)?);
    watch.lap(Lap::Read);
    let mut equations = mechanics::derive::derive_in(&reading.model, detail).map_err(findings)?;
    number(&reading.model, &mut equations).map_err(Notice::from)?;
    watch.lap(Lap::Derive);
    let system = lower(&equations).map_err(Notice::from)?;
    watch.lap(Lap::Lower);
    let origin = Origin { source: source.clone(), overrides: overrides.to_vec() };
    Ok(Machine { model: reading.model, warnings: reading.warnings, equations, system, model_hash: source.hash(overrides), origin })
}

/// Numbers that the file does not give: places at the start, unknown parameters.
///
/// # Errors
/// Nothing closes, nothing rests.
pub fn number(model: &Model, equations: &mut Equations) -> Result<(), analysis::Fault> {
    analysis::connections::settle_starts(equations)?;
    crate::small::solve_unknowns(model, equations)?;
    // an unknown may be a length
    analysis::connections::settle_starts(equations)
}

/// From equations to a program with numbers.
///
/// # Errors
/// A formula that has no value for the parameters as given.
pub fn lower(equations: &Equations) -> Result<analysis::Machine, analysis::Fault> {
    let values: Vec<f64> = equations.parameters.iter().map(|p| p.value).collect();
    analysis::Machine::assembled(equations, &values, &|program| guards::names(equations, program))
}

/// One study of the file; none where it computes no numbers.
pub fn study(machine: &mut Machine, asked: &Asked, watch: &mut Watch) -> Option<Results> {
    crate::find(asked.kind)?.run(machine, asked, watch)
}

/// A fault with the expression that failed in the user's symbols.
pub(crate) fn explained(fault: analysis::Fault, equations: &Equations) -> Notice {
    let expression = fault.expression();
    let mut trouble = Notice::from(fault);
    // small motions have a graph of their own: an expression of theirs is not one of these
    if let Some(e) = expression.filter(|e| e.index() < equations.graph.len()) {
        let what = &mut trouble.what;
        for (words, language) in [(&mut what.en, Language::En), (&mut what.ru, Language::Ru)] {
            let printer = Printer::of(equations, language);
            words.push_str(": ");
            words.push_str(&printer.inline(&equations.graph, e, Form::Text));
        }
    }
    trouble
}

/// The written calculation.
pub fn document(calculation: &Calculation, extent: Extent, language: Language) -> Document {
    document::compose(calculation, extent, language)
}

impl Calculation {
    /// All checks of all studies, equal ones once.
    pub fn audits(&self) -> Vec<&Audit> {
        let mut out: Vec<&Audit> = Vec::new();
        for audit in self.results.iter().flat_map(|f| &f.data.audits) {
            if !out.contains(&audit) {
                out.push(audit);
            }
        }
        out
    }
}

/// The result of a study that computes no numbers: provenance and checks only.
pub fn no_numbers(machine: &Machine) -> Dataset {
    provenance::stamp(Dataset::default(), &machine.equations, &machine.model_hash)
}
