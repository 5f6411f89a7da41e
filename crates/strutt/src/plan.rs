//! What to simulate: the study of the file, changed by what the command line asks.

use crate::failure::Failure;
use crate::failure::Misuse;
use crate::watch::Watch;
use analysis::Dataset;
use analysis::marks::named::{Direction, Named};
use analysis::marks::pushes::Push;
use mechanics::Model;
use mechanics::derive::{event_output, push_output};
use mechanics::model::{DEFAULT_TOLERANCE, EventDecl, EventDirection, Method, Plot, Simulate, StudyKind, Times, Transient};
use symbolic::equations::Role;
use symbolic::{Equations, SymbolId};
use words::{Notice, nearest};

/// A step of the integrator spans about a radian of the quickest oscillation.
const POINTS_A_STEP: f64 = 4.0;

/// What the command line asks; absent means as the file says.
#[derive(Clone, Debug, Default)]
pub struct Wishes {
    /// End, s.
    pub until: Option<f64>,
    /// Relative tolerance.
    pub tolerance: Option<f64>,
    /// How it is integrated.
    pub method: Option<Method>,
    /// Times of the results.
    pub times: Option<Times>,
    /// Columns by name.
    pub outputs: Option<Vec<String>>,
}

/// The simulation to make.
///
/// # Errors
/// Nobody says how long (C007), or a column does not exist (C008).
pub fn simulation(model: &Model, equations: &Equations, wishes: Wishes) -> Result<Simulate, Failure> {
    let of_file = model.studies.iter().find_map(|s| match &s.kind {
        StudyKind::Simulate(study) | StudyKind::Inverse(study) => Some(study.clone()),
        _ => None,
    });
    motion(of_file, equations, wishes, "simulate")
}

/// The motion in closed form to find: the study `transient` of the file, otherwise its study `simulate`.
///
/// # Errors
/// As [`simulation`].
pub fn transient(model: &Model, equations: &Equations, wishes: Wishes) -> Result<Transient, Failure> {
    let own = model.studies.iter().find_map(|s| match &s.kind {
        StudyKind::Transient(study) => Some(study.clone()),
        _ => None,
    });
    let simulated = || {
        model.studies.iter().find_map(|s| match &s.kind {
            StudyKind::Simulate(study) | StudyKind::Inverse(study) => Some(study.clone()),
            _ => None,
        })
    };
    let linearise = own.as_ref().is_some_and(|study| study.linearise);
    let of_file = own.map(|study| study.motion).or_else(simulated);
    Ok(Transient { motion: motion(of_file, equations, wishes, "transient")?, linearise })
}

fn motion(of_file: Option<Simulate>, equations: &Equations, wishes: Wishes, name: &str) -> Result<Simulate, Failure> {
    let mut study = of_file.clone().unwrap_or_else(|| Simulate {
        until: 0.0,
        times: Times::Automatic,
        tolerance: DEFAULT_TOLERANCE,
        method: Method::default(),
        outputs: Vec::new(),
        plots: Vec::new(),
    });
    let last_asked = match &wishes.times {
        Some(Times::At(times)) => times.iter().copied().reduce(f64::max),
        _ => None,
    };
    study.until = match (wishes.until, of_file, last_asked) {
        (Some(until), ..) => until,
        (None, Some(file), last) => last.map_or(file.until, |t| t.max(file.until)),
        (None, None, Some(last)) => last,
        (None, None, None) => return Err(no_end(name)),
    };
    if wishes.times.is_none()
        && let Times::At(times) = &mut study.times
    {
        // a shorter run is not an error of the file
        times.retain(|t| *t <= study.until);
    }
    study.times = wishes.times.unwrap_or(study.times);
    if study.until == 0.0 && study.times == Times::Automatic {
        // the start alone, not a thousand times
        study.times = Times::At(vec![0.0]);
    }
    study.tolerance = wishes.tolerance.unwrap_or(study.tolerance);
    study.method = wishes.method.unwrap_or(study.method);
    match wishes.outputs {
        Some(names) => {
            names.iter().try_for_each(|name| known(name, equations))?;
            study.outputs = names;
        }
        None if study.outputs.is_empty() => study.outputs = usual_columns(equations),
        None => {}
    }
    Ok(study)
}

/// Coordinates, their rates, then the outputs of the file.
pub fn usual_columns(equations: &Equations) -> Vec<String> {
    let of = |role| equations.outputs.iter().filter(move |o| o.role == role).map(|o| o.name.clone());
    of(Role::Coordinate).chain(of(Role::Rate)).chain(of(Role::Named)).collect()
}

/// The study with every column that its plots need.
pub fn with_plots(study: &Simulate, equations: &Equations) -> Simulate {
    Simulate { outputs: columns_with_plots(&study.outputs, &study.plots, equations), ..study.clone() }
}

/// The wanted columns, or the usual ones, and every column that the plots need.
pub fn columns_with_plots(wanted: &[String], plots: &[Plot], equations: &Equations) -> Vec<String> {
    let mut columns = if wanted.is_empty() { usual_columns(equations) } else { wanted.to_vec() };
    let drawn = plots.iter().flat_map(|p| p.x.iter().chain(&p.y)).filter(|n| *n != "t");
    for name in drawn {
        if !columns.contains(name) {
            columns.push(name.clone());
        }
    }
    columns
}

/// The same study with more times, when the file leaves the times open and the motion is too quick for the usual 1001.
pub fn finer(study: &Simulate, data: &Dataset) -> Option<Simulate> {
    let rows = POINTS_A_STEP * data.counter("steps")?;
    if study.times != Times::Automatic || data.partial || rows <= 1000.0 {
        return None;
    }
    let parts = [2000.0, 5000.0, 10_000.0].into_iter().find(|parts| *parts >= rows).unwrap_or(20_000.0);
    Some(Simulate { times: Times::Every(study.until / parts), ..study.clone() })
}

/// Whether every column that is asked for exists.
///
/// # Errors
/// A column that does not (C008).
pub fn known_columns(names: &[String], equations: &Equations) -> Result<(), Failure> {
    names.iter().try_for_each(|name| known(name, equations))
}

/// Whether the model offers an output.
///
/// # Errors
/// It does not (C008).
pub fn known(name: &str, equations: &Equations) -> Result<(), Failure> {
    let names = || equations.outputs.iter().filter(|o| o.role != Role::Event).map(|o| o.name.as_str());
    if names().any(|n| n == name) {
        return Ok(());
    }
    let trouble = Notice::new("C008", format!("there is no output `{name}`"), format!("нет выходной величины `{name}`"));
    let list = names().take(60).collect::<Vec<_>>().join(", ");
    let trouble = trouble.why(format!("the model offers: {list}"), format!("в модели есть: {list}"));
    Err(match nearest(name, names()) {
        Some(near) => trouble.help(format!("did you mean `{near}`?"), format!("может быть, `{near}`?")),
        None => trouble.help(
            "correct the name, or define it in [outputs] of the model file",
            "исправьте имя или определите величину в [outputs] файла модели",
        ),
    }
    .misuse())
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

/// The options that the integrator gets.
pub fn options<'a>(study: &Simulate, watch: &'a mut Watch) -> analysis::studies::simulate::Simulate<'a> {
    use analysis::studies::simulate::{Grid, Simulate as Options};
    let grid = match &study.times {
        Times::Automatic => Grid::Auto,
        Times::Every(step) => Grid::Every(*step),
        Times::At(times) => Grid::At(times.clone()),
    };
    let progress = watch.progress.as_mut().map(|p| &mut **p as &mut dyn FnMut(f64));
    Options {
        grid,
        tolerance: study.tolerance,
        method: analysis::stiff::Method::named(study.method.name()).unwrap_or_default(),
        outputs: Some(study.outputs.clone()),
        interrupt: watch.interrupt,
        tolerance_halving: watch.halve_tolerance,
        check: watch.check,
        progress,
        ..Options::until(study.until)
    }
}

/// The named events of the file, by the outputs that hold their formulas.
pub fn events(model: &Model, equations: &Equations) -> Vec<Named> {
    let named = |event: &EventDecl| {
        let holder = event_output(&event.name);
        let output = equations.outputs.iter().position(|o| o.name == holder)?;
        let direction = match event.direction {
            EventDirection::Rising => Direction::Rising,
            EventDirection::Falling => Direction::Falling,
            EventDirection::Both => Direction::Both,
        };
        Some(Named { name: event.name.clone(), output, direction, stop: event.stop })
    };
    model.events.iter().filter_map(named).collect()
}

/// Normal forces that only push, among the outputs.
pub fn pushes(model: &Model, equations: &Equations) -> Vec<Push> {
    let watched = |name: &str| {
        let holder = push_output(name);
        let output = equations.outputs.iter().position(|o| o.name == holder)?;
        Some(Push { name: format!("normal({name})"), label: equations.outputs[output].label.clone(), output })
    };
    model.connections.iter().filter_map(|c| watched(&c.name)).collect()
}

/// A range of a coordinate by its index.
pub fn range(equations: &Equations, between: mechanics::model::Between) -> Option<analysis::studies::equilibrium::Range> {
    let coordinate = equations.coordinates.iter().position(|c| c.symbols[0] == between.coordinate)?;
    Some(analysis::studies::equilibrium::Range { coordinate, from: between.from, to: between.to })
}

/// The start of the motion with some coordinates replaced, as a place to search from.
pub fn guesses(equations: &Equations, start: &[f64], guess: &[(SymbolId, f64)]) -> analysis::studies::equilibrium::Equilibrium {
    let mut place = start[..equations.coordinates.len().min(start.len())].to_vec();
    for (q, coordinate) in place.iter_mut().zip(&equations.coordinates) {
        if let Some((_, value)) = guess.iter().find(|(symbol, _)| *symbol == coordinate.symbols[0]) {
            *q = *value;
        }
    }
    let guesses = if guess.is_empty() { Vec::new() } else { vec![place] };
    analysis::studies::equilibrium::Equilibrium { guesses, ..Default::default() }
}
