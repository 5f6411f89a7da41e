//! The study `equilibrium`: places of rest, their stability, from guesses or all in a range of a coordinate.

use super::keys::GUESS;
use super::{Conclusion, Finds, Found, Given, Repeats, Results, Study, overlaid};
use crate::failure::Failure;
use crate::machine::{Machine, explained};
use crate::results::finite::checked;
use crate::results::{Alone, Rows, fields};
use crate::small;
use crate::watch::{Lap, Watch};
use crate::{plan, provenance};
use analysis::dataset::Column;
use analysis::linear::LinearMachine;
use analysis::rest::mean::Resting;
use analysis::studies::simulate::Outcome;
use analysis::{Dataset, System};
use mechanics::asked::{Asked, Key, Kind, Objection, Takes, Words};
use serde_json::{Map, Value, json};
use std::sync::Arc;
use symbolic::linear::About;
use symbolic::{Equations, SymbolId};
use words::{Language, Printed};

/// A coordinate between two values, SI.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Between {
    /// The coordinate.
    pub coordinate: SymbolId,
    /// Least value.
    pub from: f64,
    /// Largest value.
    pub to: f64,
}

impl Between {
    /// The range that is asked for.
    pub fn of(asked: &Asked) -> Option<Between> {
        let (named, ends) = (asked.coordinate("over")?, asked.numbers("range")?);
        let [from, to] = ends[..] else { return None };
        Some(Between { coordinate: named.symbol, from, to })
    }
}

/// A range of a coordinate by its index.
fn range(equations: &Equations, between: Between) -> Option<analysis::studies::equilibrium::Range> {
    let coordinate = equations.coordinates.iter().position(|c| c.symbols[0] == between.coordinate)?;
    Some(analysis::studies::equilibrium::Range { coordinate, from: between.from, to: between.to })
}

/// The study.
pub struct Rest;

/// Its name and its keys.
pub static KIND: Kind = Kind::new("equilibrium", ("Find positions of equilibrium", "Найти положения равновесия"))
    .keys(&[
        GUESS,
        Key::new(
            "over",
            Takes::Coordinate,
            (
                "a coordinate: all equilibria in a range of it are found",
                "координата, в диапазоне которой находятся все положения равновесия",
            ),
            "\"phi\"",
        )
        .option("Find all equilibria with this coordinate in a range", "Найти все положения равновесия с этой координатой в диапазоне")
        .needs("range"),
        Key::new(
            "range",
            Takes::RangeOf("over"),
            ("values of `over`, from and to", "границы значений `over`"),
            "[\"-180 deg\", \"180 deg\"]",
        )
        .option("The range: \"-180 deg,180 deg\"", "Диапазон: \"-180 deg,180 deg\"")
        .needs("over"),
    ])
    .check(|asked| match asked.get("over").is_some() && !asked.has("range") {
        true => vec![no_range("[\"-180 deg\", \"180 deg\"]")],
        false => Vec::new(),
    });

/// M006: what is gone over has no range.
pub fn no_range(example: &str) -> Objection {
    let russian = example.replace("rad/s", "рад/с");
    Objection::at("over", "M006", "`over` needs `range`", "к `over` нужен `range`")
        .help(format!("add range = {example}"), format!("добавьте range = {russian}"))
}

impl Study for Rest {
    fn kind(&self) -> &'static Kind {
        &KIND
    }
    fn wanted(&self) -> Words {
        ("find the positions of equilibrium", "найти положения равновесия и исследовать их устойчивость")
    }
    fn chapter(&self) -> &'static str {
        "equations"
    }
    fn finds(&self) -> Finds {
        Finds::Rest
    }
    fn concludes(&self, _: &Machine, results: &Results, _: Language) -> Vec<Conclusion> {
        let decided = |v: &f64| (!v.is_nan()).then_some(*v != 0.0);
        let stable = results.data.column("stable").map(|c| c.values.iter().map(decided).collect());
        stable.map(|stable| Conclusion::Rest { stable }).into_iter().collect()
    }
    fn run(&self, machine: &mut Machine, asked: &Asked, watch: &mut Watch) -> Found {
        Some(places(machine, asked.guess(), Between::of(asked), watch))
    }
    fn merge(&self, _: &Machine, given: Given) -> Result<Asked, Failure> {
        Ok(overlaid(&KIND, given.of_file.unwrap_or_else(|| Asked::new(KIND.name)), given.line))
    }
    fn repeats(&self) -> Repeats {
        Repeats::Rest
    }
}

/// Positions of equilibrium, from the start of the motion and from a guess, or all with a coordinate between two values.
pub fn places(machine: &mut Machine, guess: &[(SymbolId, f64)], over: Option<Between>, watch: &mut Watch) -> Results {
    let mut outcome = at_rest(machine, guess, over).unwrap_or_else(|fault| Outcome { dataset: Dataset::default(), fault: Some(fault) });
    let beside = if over.is_none() { small::beside::found(machine, &outcome.dataset) } else { Vec::new() };
    outcome.dataset.notes.extend(small::beside::notes(machine, &beside));
    watch.lap(Lap::Run);
    let mut own = fields(json!({"equilibria": listed(&outcome.dataset)}));
    if !beside.is_empty() {
        own.insert("beside".into(), small::beside::json(machine, &beside));
    }
    let data = provenance::stamp(outcome.dataset, &machine.equations, &machine.model_hash);
    checked(Results {
        kind: KIND.name,
        alone: Alone::Places,
        heading: report::Word::Equilibrium.text(),
        rows: Rows::Beside,
        own,
        data,
        trouble: outcome.fault.map(|fault| explained(fault, &machine.equations)),
        ..Results::default()
    })
}

fn at_rest(machine: &mut Machine, guess: &[(SymbolId, f64)], over: Option<Between>) -> Result<Outcome, analysis::Fault> {
    let start = machine.system.start()?;
    let mut options = plan::guesses(&machine.equations, &start, guess);
    options.over = over.and_then(|between| range(&machine.equations, between));
    // with unknowns they have been used to find these
    if machine.model.unknowns.is_empty() {
        options.impending = crate::machine::unknowns::impending(&machine.model, &machine.equations);
    }
    let (mut outcome, below, timing, equations) = if analysis::studies::rest::report::is_free(&machine.equations) {
        let n = machine.equations.coordinates.len();
        let mut linear = LinearMachine::new(&Arc::new(machine.equations.clone()), About::Rest)?;
        let mut found = analysis::studies::equilibrium::find(&mut linear, &machine.system.states()[..n], &start[..n], &options);
        settle(&mut linear, &mut found.dataset);
        let below = placed(&mut linear, &found.dataset);
        (found, below, linear.timing(), machine.equations.clone())
    } else {
        let resting = Resting::new(&machine.equations)?;
        let parameters = numbers_of(resting.equations());
        let studied = analysis::studies::rest::report::Studied { rest: resting.equations(), motion: &machine.equations };
        let (found, below) = analysis::studies::rest::report::study(studied, &parameters, &start, &options);
        (found, below, resting.timing, resting.equations().clone())
    };
    let column = |name: &str| outcome.dataset.column(name).map(|c| c.values.clone()).unwrap_or_default();
    if let Some(fault) = crate::strands::pushing(machine, column) {
        return Err(fault);
    }
    crate::small::add_roots(machine, &mut outcome.dataset);
    analysis::rest::observed::add(&equations, (&numbers_of(&equations), &below), timing, &mut outcome.dataset);
    outcome.dataset.notes.extend(crate::small::timing_notes(timing));
    outcome.dataset.notes.extend(crate::small::unknown_notes(machine));
    Ok(outcome)
}

/// Brings multiple zeros of the force to their last digits.
fn settle(linear: &mut LinearMachine, data: &mut Dataset) {
    let Some(column) = data.columns.first_mut().filter(|_| linear.coordinates().len() == 1) else { return };
    for value in &mut column.values {
        *value = analysis::studies::rest::multiple::settled(linear, *value).unwrap_or(*value);
    }
}

/// What the coordinates of each place have below their last digits.
fn placed(linear: &mut LinearMachine, data: &Dataset) -> Vec<Vec<f64>> {
    let names: Vec<String> = linear.coordinates().iter().map(|q| q.name.clone()).collect();
    let columns: Vec<&Column> = names.iter().filter_map(|name| data.column(name)).collect();
    let rows = columns.first().map_or(0, |c| c.values.len());
    (0..rows).map(|row| linear.placed(&columns.iter().map(|c| c.values[row]).collect::<Vec<f64>>()).below).collect()
}

fn numbers_of(equations: &Equations) -> Vec<f64> {
    equations.parameters.iter().map(|p| p.value).collect()
}

/// `{coordinates: {phi: 0.1}, stable: true, residual: 1e-16, outputs: {N: 3}}` for each; `stable` is null where linearisation does not decide.
fn listed(data: &Dataset) -> Value {
    let n = data.columns.first().map_or(0, |c| c.values.len());
    // what is not there is null
    let at = |name: &str, row: usize| data.column(name).map_or(f64::NAN, |c| c.values[row]);
    // coordinates and reactions come first, then the residual, then what follows from them
    let first = data.columns.iter().position(|c| c.quantity.name == "residual").unwrap_or(data.columns.len());
    let values = |columns: &[Column], row: usize| -> Map<String, Value> {
        let own = columns.iter().filter(|c| !is_verdict(&c.quantity.name) && !is_reaction(&c.quantity.name));
        own.map(|c| (c.quantity.name.clone(), json!(c.values[row]))).collect()
    };
    let place = |row: usize| {
        let coordinates = values(&data.columns[..first], row);
        let stable = at("stable", row);
        let stable = if stable.is_nan() { Value::Null } else { json!(stable != 0.0) };
        let mut out = json!({"coordinates": coordinates, "stable": stable, "residual": at("residual", row)});
        let outputs = values(&data.columns[first..], row);
        if !outputs.is_empty() {
            out["outputs"] = json!(outputs);
        }
        let reactions = data.columns[..first].iter().filter(|c| is_reaction(&c.quantity.name));
        let reactions: Map<String, Value> = reactions.map(|c| (c.quantity.name.clone(), json!(c.values[row]))).collect();
        if !reactions.is_empty() {
            out["reactions"] = json!(reactions);
        }
        if data.column("growth").is_some() {
            let (growth, negative) = (at("growth", row), at("negative_directions", row));
            out["growth"] = json!(growth);
            out["negative_directions"] = json!(negative);
            out["stable_by_energy"] = if negative.is_nan() { Value::Null } else { json!(negative == 0.0) };
            // growth in 1/s: a double root at zero is split by rounding, and what grows in thirty years does not grow where nothing else says that it does
            let grows = growth > if at("stable", row) == 0.0 { 0.0 } else { 1e-9 };
            out["stable_by_eigenvalues"] = if growth.is_nan() { Value::Null } else { json!(!grows) };
        }
        out
    };
    (0..n).map(place).collect()
}

/// Columns of an equilibrium that are reactions: `force(AB)`.
fn is_reaction(name: &str) -> bool {
    name.contains('(')
}

/// Columns of an equilibrium that are no coordinates.
fn is_verdict(name: &str) -> bool {
    matches!(name, "residual" | "stable" | "growth" | "negative_directions")
}
