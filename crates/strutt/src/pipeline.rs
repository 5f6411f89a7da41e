//! strutt from top to bottom: read -> derive -> lower -> study -> dataset -> document. Each verb is one call into one room.

use crate::document::{self, Extent};
use crate::failure::Failure;
use crate::finite::checked;
use crate::small::modes::ModesFound;
use crate::small::response::ResponseFound;
use crate::source::Source;
use crate::studies::{Origin, Results};
use crate::watch::Watch;
use crate::wording::Word;
use crate::{guards, phases, plan, provenance};
use analysis::Dataset;
use analysis::dataset::Audit;
use analysis::linear::LinearMachine;
use analysis::rest::mean::Resting;
use analysis::studies::transient::{Found, Phase, Transient};
use analysis::studies::{self, simulate::Outcome};
use mechanics::Model;
use mechanics::derive::Detail;
use mechanics::model::{self, Between, Simulate, StudyKind};
use report::Document;
use report::formula::{Form, Printer};
use std::sync::Arc;
use symbolic::linear::About;
use symbolic::{Equations, SymbolId};
use words::{Language, Notice};

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
    pub files: Vec<(String, Word)>,
}

/// From a file to all results.
///
/// # Errors
/// Findings about the model. What ends a study early stands beside its results.
pub fn run(source: &Source, overrides: &[(String, String)], watch: &mut Watch) -> Result<Calculation, Failure> {
    let mut machine = build_in(source, overrides, Detail::Steps, watch)?;
    let studies = machine.model.studies.clone();
    let mut findings: Vec<Finding> = Vec::new();
    for study in &studies {
        if watch.is_interrupted() {
            break;
        }
        findings.extend(self::study(&mut machine, &study.kind, watch));
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
    let mut reading = mechanics::read(&source.text, &source.path, overrides).map_err(findings)?;
    reading.warnings.extend(crate::letters::printed_alike(&reading.model));
    reading.warnings.extend(crate::structure::mount::mount(&mut reading.model)?);
    watch.lap(Word::TimeRead);
    let mut equations = mechanics::derive::derive_in(&reading.model, detail).map_err(findings)?;
    number(&reading.model, &mut equations).map_err(Notice::from)?;
    watch.lap(Word::TimeDerive);
    let system = lower(&equations).map_err(Notice::from)?;
    watch.lap(Word::TimeLower);
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

/// One study of the file; equations are no study of numbers.
pub fn study(machine: &mut Machine, kind: &StudyKind, watch: &mut Watch) -> Option<Finding> {
    match kind {
        StudyKind::Equations => None,
        StudyKind::Kinematics(study) => Some(crate::studies::kinematics::run(machine, study, watch)),
        StudyKind::Cycle(study) => Some(crate::studies::cycle::run(machine, study, watch)),
        StudyKind::Sweep(study) => Some(crate::studies::sweep::run(machine, study, watch)),
        StudyKind::Periodic(study) => Some(crate::studies::periodic::run(machine, study, watch)),
        StudyKind::Equilibrium { guess, over } => Some(equilibrium_over(machine, guess, *over, watch)),
        StudyKind::Statics => crate::structure::statics(machine).or_else(|| Some(crate::studies::statics::run(machine))),
        StudyKind::Response(study) => Some(response(machine, study, watch)),
        StudyKind::Transient(study) => {
            let motion = plan::with_plots(&study.motion, &machine.equations);
            let finding = transient(machine, &model::Transient { motion: motion.clone(), ..study.clone() }, watch);
            Some(match plan::finer(&motion, finding.data()) {
                Some(finer) => transient(machine, &model::Transient { motion: finer, ..study.clone() }, watch),
                None => finding,
            })
        }
        StudyKind::Modes(study) => Some(modes(machine, study, watch)),
        StudyKind::Inverse(study) => Some(crate::studies::inverse::run(machine, study, watch)),
        StudyKind::Simulate(study) => {
            let study = plan::with_plots(study, &machine.equations);
            let finding = simulate(machine, &study, watch);
            // plots need several points on every swing; how many swings there are shows in the steps
            let finding = match plan::finer(&study, finding.data()) {
                Some(finer) => simulate(machine, &finer, watch),
                None => finding,
            };
            Some(confirm(machine, finding, watch))
        }
    }
}

/// A motion with the digits that a repetition confirms.
fn confirm(machine: &mut Machine, finding: Finding, watch: &mut Watch) -> Finding {
    let Finding::Motion(study, mut data, trouble) = finding else { return finding };
    if let (false, Ok(start)) = (data.partial, machine.system.start()) {
        let mut options = plan::options(&study, watch);
        options.events = plan::events(&machine.model, &machine.equations);
        options.pushes = plan::pushes(&machine.model, &machine.equations);
        studies::simulate::confirm(&mut machine.system, &start, &mut options, &mut data);
        watch.lap(Word::TimeRun);
    }
    Finding::Motion(study, data, trouble)
}

/// A motion.
pub fn simulate(machine: &mut Machine, study: &Simulate, watch: &mut Watch) -> Finding {
    simulate_with_works(machine, study, &[], watch)
}

/// A motion; the integrals of `works`, outputs of the study that are powers, are compared with the energy.
pub fn simulate_with_works(machine: &mut Machine, study: &Simulate, works: &[String], watch: &mut Watch) -> Finding {
    let mut options = plan::options(study, watch);
    options.works = works.to_vec();
    options.events = plan::events(&machine.model, &machine.equations);
    options.pushes = plan::pushes(&machine.model, &machine.equations);
    let outcome = match moving(&machine.equations).and_then(|()| machine.system.start()) {
        Ok(start) => studies::simulate::simulate(&mut machine.system, &start, options),
        Err(fault) => Outcome { dataset: Dataset::default(), fault: Some(fault) },
    };
    watch.lap(Word::TimeRun);
    let data = provenance::stamp(outcome.dataset, &machine.equations, &machine.model_hash);
    checked(Finding::Motion(study.clone(), data, outcome.fault.map(|fault| explained(fault, &machine.equations))))
}

/// S084 where no coordinate moves and no formula changes with time: every row would be the first.
fn moving(equations: &Equations) -> Result<(), analysis::Fault> {
    let rests = equations.balances.iter().map(|b| b.rest);
    let outputs = equations.outputs.iter().map(|o| o.formula);
    let defined = equations.definitions.iter().map(|d| d.formula);
    let timed = |e| equations.graph.contains(e, |s| s == equations.time);
    match equations.coordinates.is_empty() && equations.auxiliaries.is_empty() && !rests.chain(outputs).chain(defined).any(timed) {
        true => Err(analysis::fault::nothing_moves()),
        false => Ok(()),
    }
}

/// A motion in closed form.
pub fn transient(machine: &mut Machine, study: &model::Transient, watch: &mut Watch) -> Finding {
    let options = Transient { twin: plan::options(&study.motion, watch), ends: machine.model.phases.clone(), linearise: study.linearise };
    let found = match moving(&machine.equations).and_then(|()| machine.system.start()) {
        Ok(start) => studies::transient::transient(&mut machine.system, &machine.equations, &start, options),
        Err(fault) => Found { outcome: Outcome { dataset: Dataset::default(), fault: Some(fault) }, phases: Vec::new() },
    };
    watch.lap(Word::TimeRun);
    let data = provenance::stamp(found.outcome.dataset, &machine.equations, &machine.model_hash);
    let trouble = found.outcome.fault.map(Notice::from);
    let phases = Phases { list: found.phases, names: phases::state_names(&machine.equations), restarts: machine.model.restarts.clone() };
    checked(Finding::Transient(study.motion.clone(), data, phases, trouble))
}

/// Positions of equilibrium, from the start of the motion and from a guess.
pub fn equilibrium(machine: &mut Machine, guess: &[(SymbolId, f64)], watch: &mut Watch) -> Finding {
    equilibrium_over(machine, guess, None, watch)
}

/// The same, or all with a coordinate between two values.
pub fn equilibrium_over(machine: &mut Machine, guess: &[(SymbolId, f64)], over: Option<Between>, watch: &mut Watch) -> Finding {
    let outcome = at_rest(machine, guess, over).unwrap_or_else(|fault| Outcome { dataset: Dataset::default(), fault: Some(fault) });
    watch.lap(Word::TimeRun);
    let data = provenance::stamp(outcome.dataset, &machine.equations, &machine.model_hash);
    checked(Finding::Equilibrium(data, outcome.fault.map(|fault| explained(fault, &machine.equations))))
}

fn at_rest(machine: &mut Machine, guess: &[(SymbolId, f64)], over: Option<Between>) -> Result<Outcome, analysis::Fault> {
    let start = machine.system.start()?;
    let mut options = plan::guesses(&machine.equations, &start, guess);
    options.over = over.and_then(|between| plan::range(&machine.equations, between));
    // with unknowns they have been used to find these
    if machine.model.unknowns.is_empty() {
        options.impending = crate::small::impending(&machine.model, &machine.equations);
    }
    let (mut outcome, timing, equations) = if analysis::rest::report::is_free(&machine.equations) {
        use analysis::System;
        let n = machine.equations.coordinates.len();
        let mut linear = LinearMachine::new(&Arc::new(machine.equations.clone()), About::Rest)?;
        let found = studies::equilibrium::find(&mut linear, &machine.system.states()[..n], &start[..n], &options);
        (found, linear.timing(), machine.equations.clone())
    } else {
        let resting = Resting::new(&machine.equations)?;
        let parameters = numbers_of(resting.equations());
        (analysis::rest::report::study(resting.equations(), &parameters, &start, &options), resting.timing, resting.equations().clone())
    };
    crate::small::add_roots(machine, &mut outcome.dataset);
    analysis::rest::observed::add(&equations, &numbers_of(&equations), timing.frozen, &mut outcome.dataset);
    outcome.dataset.notes.extend(crate::small::timing_notes(timing));
    outcome.dataset.notes.extend(crate::small::unknown_notes(machine));
    Ok(outcome)
}

fn numbers_of(equations: &Equations) -> Vec<f64> {
    equations.parameters.iter().map(|p| p.value).collect()
}

/// Natural frequencies and shapes.
pub fn modes(machine: &mut Machine, study: &mechanics::model::Modes, watch: &mut Watch) -> Finding {
    if let Some(finding) = crate::structure::modes(machine, study) {
        watch.lap(Word::TimeRun);
        return finding;
    }
    let found = crate::small::modes::find(machine, study);
    watch.lap(Word::TimeRun);
    checked(Finding::Modes(Box::new(found)))
}

/// Forced oscillations over the frequency.
pub fn response(machine: &mut Machine, study: &mechanics::model::Response, watch: &mut Watch) -> Finding {
    let found = crate::small::response::find(machine, study);
    watch.lap(Word::TimeRun);
    checked(Finding::Response(Box::new(found)))
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
