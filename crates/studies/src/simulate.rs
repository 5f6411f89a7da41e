//! The study `simulate`: a motion from its start, as a table, with events, checks and the digits that a repetition confirms.

use super::keys::{AT, EVERY, METHOD, MOTIONS, OUTPUTS, PLOT, TOLERANCE_OF_MOTION, UNTIL};
use super::{Conclusion, Extra, Finds, Found, Given, Interrupts, Repeats, Results, Study, of_file, overlaid};
use crate::failure::{Failure, Misuse};
use crate::machine::{Machine, explained};
use crate::results::finite::checked;
use crate::results::{Alone, Strips, fields, figures};
use crate::watch::{Kept, Lap, Watch};
use crate::{plan, provenance};
use analysis::Dataset;
use analysis::marks::extremes::Sought;
use analysis::marks::windows::Window;
use analysis::studies::simulate::{Grid, Outcome, Simulate as Options};
use mechanics::asked::{Asked, Kind, Value, Words};
use mechanics::model::{Plot, Times};
use serde_json::json;
use std::sync::atomic::AtomicBool;
use symbolic::Equations;
use words::{Language, Notice, Printed};

/// The default tolerance of a motion.
pub const TOLERANCE: f64 = 1e-12;

/// A motion to compute; SI.
#[derive(Clone, Debug)]
pub struct Simulate {
    /// End of the motion.
    pub until: f64,
    /// Times at which results are wanted.
    pub times: Times,
    /// Relative tolerance.
    pub tolerance: f64,
    /// How the motion is integrated.
    pub method: analysis::integrate::stiff::Method,
    /// Outputs wanted, by name (also coordinates and rates); empty means all.
    pub outputs: Vec<String>,
    /// Plots wanted.
    pub plots: Vec<Plot>,
    /// Results of which numbers between two instants are wanted.
    pub windows: Vec<Window>,
}

/// An output between two instants; of `means` nothing else is wanted.
fn window(output: &str, between: [f64; 2], means: &[String]) -> Window {
    let sought = if means.iter().any(|own| own == output) { Sought::Mean } else { Sought::Extremes };
    Window { output: output.to_owned(), between, sought }
}

impl Simulate {
    /// The motion that is asked for.
    pub fn of(asked: &Asked) -> Simulate {
        Simulate {
            until: asked.number("until").unwrap_or(0.0),
            times: asked.times(),
            tolerance: asked.number("tolerance").unwrap_or(TOLERANCE),
            method: asked.word("method").and_then(analysis::integrate::stiff::Method::named).unwrap_or_default(),
            outputs: asked.words("outputs").to_vec(),
            plots: asked.plots().to_vec(),
            windows: asked.windows().iter().map(|(output, between)| window(output, *between, asked.words("means"))).collect(),
        }
    }

    /// The same with every column that its plots need.
    pub fn with_plots(&self, equations: &Equations) -> Simulate {
        Simulate { outputs: plan::columns_with_plots(&self.outputs, &self.plots, equations), ..self.clone() }
    }

    /// The same with more times, when the file leaves the times open and the motion is too quick for the usual 1001.
    pub fn finer(&self, data: &Dataset) -> Option<Simulate> {
        let parts = analysis::studies::simulate::parts(data.counter("steps")? as u64)?;
        let free = self.times == Times::Automatic && !data.partial;
        free.then(|| Simulate { times: Times::Every(self.until / parts as f64), ..self.clone() })
    }
}

fn grid(times: &Times) -> Grid {
    match times {
        Times::Automatic => Grid::Auto,
        Times::Every(step) => Grid::Every(*step),
        Times::At(times) => Grid::At(times.clone()),
    }
}

/// The options that the integrator gets.
pub fn options<'a>(study: &Simulate, watch: &'a mut Watch) -> analysis::studies::simulate::Simulate<'a> {
    let progress = watch.progress.as_mut().map(|p| &mut **p as &mut dyn FnMut(f64));
    Options {
        grid: grid(&study.times),
        tolerance: study.tolerance,
        method: study.method,
        outputs: Some(study.outputs.clone()),
        windows: study.windows.clone(),
        interrupt: watch.interrupt,
        tolerance_halving: watch.halve_tolerance,
        check: watch.check,
        kept: watch.kept,
        progress,
        ..Options::until(study.until)
    }
}

/// The motion by itself, of which nothing is kept but numbers.
pub(crate) fn numbers_only<'a>(machine: &Machine, study: &Simulate, interrupt: Option<&'a AtomicBool>) -> Options<'a> {
    Options {
        events: plan::events(&machine.model, &machine.equations),
        pushes: plan::pushes(&machine.model, &machine.equations),
        interrupt,
        kept: Kept::Numbers,
        grid: grid(&study.times),
        tolerance: study.tolerance,
        method: study.method,
        outputs: Some(study.outputs.clone()),
        windows: study.windows.clone(),
        ..Options::until(study.until)
    }
}

/// The study.
pub struct Motion;

/// Its keys.
pub static KIND: Kind = Kind::new("simulate", ("Compute a motion", "Рассчитать движение")).keys(&[
    UNTIL,
    TOLERANCE_OF_MOTION,
    METHOD,
    EVERY,
    AT,
    OUTPUTS,
    PLOT,
]);

impl Study for Motion {
    fn kind(&self) -> &'static Kind {
        &KIND
    }
    fn wanted(&self) -> Words {
        ("integrate the equations of motion", "найти закон движения численным интегрированием")
    }
    fn chapter(&self) -> &'static str {
        "motion"
    }
    fn finds(&self) -> Finds {
        Finds::Motion
    }
    fn concludes(&self, machine: &Machine, results: &Results, language: Language) -> Vec<Conclusion> {
        crate::results::greatest(&machine.equations, (&results.data, &results.plots), language)
    }
    fn run(&self, machine: &mut Machine, asked: &Asked, watch: &mut Watch) -> Found {
        let study = Simulate::of(asked).with_plots(&machine.equations);
        // plots need several points on every swing; how many swings there are shows in the steps
        let finding = followed(machine, &study, (&[], Rows::Fitted), watch);
        let study = study.finer(&finding.data).unwrap_or(study);
        Some(confirm(machine, &study, finding, watch))
    }
    fn command(&self, machine: &mut Machine, asked: &Asked, watch: &mut Watch) -> Found {
        Some(motion(machine, &Simulate::of(asked), watch))
    }
    fn of_file(&self) -> &'static [&'static [&'static str]] {
        &[&["simulate"], MOTIONS]
    }
    fn merge(&self, machine: &Machine, given: Given) -> Result<Asked, Failure> {
        merged(&KIND, &machine.equations, given)
    }
    fn extras(&self) -> &'static [Extra] {
        Extra::OF_A_MOTION
    }
    fn interrupts(&self) -> Interrupts {
        Interrupts::Kept
    }
    fn repeats(&self) -> Repeats {
        Repeats::Motion
    }
}

/// The motion to compute: that of the file, changed by what the command line says.
///
/// # Errors
/// Nobody says how long (C007).
pub fn merged(kind: &Kind, equations: &Equations, given: Given) -> Result<Asked, Failure> {
    let line = given.line;
    let file = given.of_file.as_ref().and_then(|asked| asked.number("until"));
    let last = line.numbers("at").and_then(|times| times.iter().copied().reduce(f64::max));
    let until = match (line.number("until"), file, last) {
        (Some(until), ..) => until,
        (None, Some(file), last) => last.map_or(file, |t| t.max(file)),
        (None, None, Some(last)) => last,
        (None, None, None) => return Err(no_end(kind.name)),
    };
    let mut asked = given.of_file.unwrap_or_default();
    asked.kind = kind.name;
    if let (Some(times), false) = (asked.numbers("at").map(<[f64]>::to_vec), line.has("at") || line.has("every")) {
        // a shorter run is not an error of the file
        asked.set("at", Value::Numbers(times.into_iter().filter(|t| *t <= until).collect()));
    }
    let mut asked = overlaid(kind, asked, line);
    asked.set("until", Value::Number(until));
    if until == 0.0 && asked.times() == Times::Automatic {
        // the start alone, not a thousand times
        asked.set("at", Value::Numbers(vec![0.0]));
    }
    if asked.words("outputs").is_empty() {
        asked.set("outputs", Value::Words(plan::usual_columns(equations)));
    }
    Ok(asked)
}

/// The motion of the file with these values in place of its own.
///
/// # Errors
/// Nobody says how long (C007).
pub fn with_values(machine: &Machine, values: &[(&'static str, Value)]) -> Result<Simulate, Failure> {
    let line = values.iter().fold(Asked::new(KIND.name), |line, (key, value)| line.with(key, value.clone()));
    let of_file = of_file(machine, &[KIND.name]).or_else(|| of_file(machine, MOTIONS)).cloned();
    let asked = merged(&KIND, &machine.equations, Given { written: None, of_file, line: &line, drawn: false })?;
    Ok(Simulate::of(&asked))
}

fn no_end(name: &str) -> Failure {
    Notice::new("C007", "how long shall the motion be?", "до какого момента считать движение?")
        .why(
            format!("the file has no study `{name}`, and no --until was given"),
            format!("в файле нет расчёта `{name}`, а ключ --until не задан"),
        )
        .help("add --until 10 (seconds), or a study to the file", "добавьте --until 10 (секунд) или расчёт в файл")
        .misuse()
}

/// A motion with the digits that a repetition confirms.
fn confirm(machine: &mut Machine, study: &Simulate, mut results: Results, watch: &mut Watch) -> Results {
    if let (false, Ok(start)) = (results.data.partial, machine.system.start()) {
        let mut options = options(study, watch);
        options.events = plan::events(&machine.model, &machine.equations);
        options.pushes = plan::pushes(&machine.model, &machine.equations);
        (analysis::made::CONFIRM)(&mut machine.system, &start, &mut options, &mut results.data);
        watch.lap(Lap::Run);
    }
    results
}

/// A motion with its plots, those of the file or one for each coordinate, and what contacts did.
pub fn drawn(machine: &Machine, study: &Simulate, data: Dataset) -> Results {
    let plots = if study.plots.is_empty() { figures::of_coordinates(&machine.equations) } else { study.plots.clone() };
    Results { data, plots, strips: Strips::Drawn, ..Results::default() }
}

/// A motion.
pub fn motion(machine: &mut Machine, study: &Simulate, watch: &mut Watch) -> Results {
    with_works(machine, study, &[], watch)
}

/// A motion; the integrals of `works`, outputs of the study that are powers, are compared with the energy.
pub fn with_works(machine: &mut Machine, study: &Simulate, works: &[String], watch: &mut Watch) -> Results {
    followed(machine, study, (works, Rows::Asked), watch)
}

/// How many rows a motion has that leaves its times open.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Rows {
    /// The usual number.
    Asked,
    /// As many as its plots need.
    Fitted,
}

fn followed(machine: &mut Machine, study: &Simulate, (works, rows): (&[String], Rows), watch: &mut Watch) -> Results {
    let mut options = options(study, watch);
    options.works = works.to_vec();
    if rows == Rows::Fitted && options.grid == Grid::Auto {
        options.grid = Grid::Fitted;
    }
    options.events = plan::events(&machine.model, &machine.equations);
    options.pushes = plan::pushes(&machine.model, &machine.equations);
    let outcome = match moving(&machine.equations).and_then(|()| machine.system.start()) {
        Ok(start) => (analysis::made::SIMULATE)(&mut machine.system, &start, options),
        Err(fault) => Outcome { dataset: Dataset::default(), fault: Some(fault) },
    };
    watch.lap(Lap::Run);
    finding(machine, study, outcome)
}

/// What a motion has found.
pub(crate) fn finding(machine: &Machine, study: &Simulate, outcome: Outcome) -> Results {
    let data = provenance::stamp(outcome.dataset, &machine.equations, &machine.model_hash);
    let own = json!({"until": study.until, "tolerance": study.tolerance, "method": study.method.name()});
    checked(Results {
        kind: KIND.name,
        stem: "motion",
        alone: Alone::Table,
        heading: report::Word::Simulation.text(),
        own: fields(own),
        trouble: outcome.fault.map(|fault| explained(fault, &machine.equations)),
        ..drawn(machine, study, data)
    })
}

/// S084 where no coordinate moves and no formula changes with time: every row would be the first.
///
/// # Errors
/// Nothing moves.
pub fn moving(equations: &Equations) -> Result<(), analysis::Fault> {
    let rests = equations.balances.iter().map(|b| b.rest);
    let outputs = equations.outputs.iter().map(|o| o.formula);
    let defined = equations.definitions.iter().map(|d| d.formula);
    let timed = |e| equations.graph.contains(e, |s| s == equations.time);
    match equations.coordinates.is_empty() && equations.auxiliaries.is_empty() && !rests.chain(outputs).chain(defined).any(timed) {
        true => Err(analysis::fault::nothing_moves()),
        false => Ok(()),
    }
}
