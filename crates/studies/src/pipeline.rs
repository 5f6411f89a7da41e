//! strutt from top to bottom: read -> derive -> lower -> study -> dataset -> document. Each verb is one call into one room.

use crate::document::{self, Extent};
use crate::failure::Failure;
use crate::simulate::Simulate;
use crate::small::modes::ModesFound;
use crate::small::response::ResponseFound;
use crate::source::Source;
use crate::watch::{Lap, Watch};
use crate::{Origin, Results};
use crate::{guards, provenance};
use analysis::Dataset;
use analysis::dataset::Audit;
use analysis::studies::transient::Phase;
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

/// What a study found, and what ended it early, if anything did.
#[derive(Clone, Debug)]
pub enum Finding {
    /// Positions of equilibrium: a column per coordinate, a row per equilibrium.
    Equilibrium(Dataset, Option<Notice>),
    /// A motion, and the study that asked for it.
    Motion(Simulate, Dataset, Option<Notice>),
    /// A motion in closed form, its phases, and the study that asked for it.
    Transient(Simulate, Dataset, Phases, Option<Notice>),
    /// Any other study.
    Study(Box<Results>),
    /// Natural frequencies and shapes.
    Modes(Box<ModesFound>),
    /// A study of a frame or truss.
    Structure(Box<crate::structure::StructureFound>),
    /// Forced oscillations over the frequency.
    Response(Box<ResponseFound>),
}

/// Phases of a motion, and the names of its state.
#[derive(Clone, Debug)]
pub struct Phases {
    /// In order of time.
    pub list: Vec<Phase>,
    /// Coordinates, then rates.
    pub names: Vec<String>,
    /// Instants at which the loads begin anew.
    pub restarts: Vec<f64>,
}

impl Phases {
    /// Whether the loads begin anew at the start of a phase.
    pub fn restarts(&self, phase: &Phase) -> bool {
        self.restarts.iter().any(|t| (t - phase.start).abs() <= 1e-12 * t.abs())
    }
}

/// Everything a file asks for.
#[derive(Clone, Debug)]
pub struct Calculation {
    /// The machine.
    pub machine: Machine,
    /// Results in the order of the studies.
    pub findings: Vec<Finding>,
    /// Files beside the page: name and what it is.
    pub files: Vec<(String, Text)>,
}

/// From a file to all results.
///
/// # Errors
/// Findings about the model. What ends a study early stands beside its results.
pub fn run(source: &Source, overrides: &[(String, String)], watch: &mut Watch) -> Result<Calculation, Failure> {
    let mut machine = build_in(source, overrides, Detail::Steps, watch)?;
    let mut findings: Vec<Finding> = Vec::new();
    for asked in &machine.model.studies.clone() {
        if watch.is_interrupted() {
            break;
        }
        findings.extend(study(&mut machine, asked, watch));
    }
    if !watch.is_interrupted() {
        findings.extend(crate::claims::run(&mut machine, watch));
    }
    Ok(Calculation { machine, findings, files: Vec::new() })
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
pub fn study(machine: &mut Machine, asked: &Asked, watch: &mut Watch) -> Option<Finding> {
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

impl Finding {
    /// The numbers.
    pub fn data(&self) -> &Dataset {
        match self {
            Finding::Equilibrium(data, _) | Finding::Motion(_, data, _) | Finding::Transient(_, data, ..) => data,
            Finding::Study(results) => &results.data,
            Finding::Modes(found) => &found.data,
            Finding::Structure(found) => &found.data,
            Finding::Response(found) => &found.data,
        }
    }
    /// Ends the study with a trouble.
    pub fn fail(&mut self, why: Notice) {
        let (data, trouble) = match self {
            Finding::Equilibrium(data, trouble) | Finding::Motion(_, data, trouble) | Finding::Transient(_, data, _, trouble) => {
                (data, trouble)
            }
            Finding::Study(results) => (&mut results.data, &mut results.trouble),
            Finding::Modes(found) => (&mut found.data, &mut found.trouble),
            Finding::Structure(found) => (&mut found.data, &mut found.trouble),
            Finding::Response(found) => (&mut found.data, &mut found.trouble),
        };
        data.partial = true;
        *trouble = Some(why);
    }
    /// What ended the study early.
    pub fn trouble(&self) -> Option<&Notice> {
        match self {
            Finding::Equilibrium(_, trouble) | Finding::Motion(_, _, trouble) | Finding::Transient(_, _, _, trouble) => trouble.as_ref(),
            Finding::Study(results) => results.trouble.as_ref(),
            Finding::Modes(found) => found.trouble.as_ref(),
            Finding::Structure(found) => found.trouble.as_ref(),
            Finding::Response(found) => found.trouble.as_ref(),
        }
    }
}

impl Calculation {
    /// All checks of all studies, equal ones once.
    pub fn audits(&self) -> Vec<&Audit> {
        let mut out: Vec<&Audit> = Vec::new();
        for audit in self.findings.iter().flat_map(|f| &f.data().audits) {
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
