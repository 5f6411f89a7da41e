//! The study `equilibrium`: places of rest, their stability, from guesses or all in a range of a coordinate.

use super::keys::GUESS;
use super::{Alone, Found, Given, Repeats, Study, overlaid};
use crate::failure::Failure;
use crate::finite::checked;
use crate::pipeline::{Finding, Machine, explained};
use crate::watch::{Lap, Watch};
use crate::{plan, provenance};
use analysis::linear::LinearMachine;
use analysis::rest::mean::Resting;
use analysis::studies::simulate::Outcome;
use analysis::{Dataset, System};
use mechanics::asked::{Asked, Key, Kind, Objection, Takes};
use std::sync::Arc;
use symbolic::linear::About;
use symbolic::{Equations, SymbolId};

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

/// The study.
pub struct Rest;

static KIND: Kind = Kind::new("equilibrium", ("Find positions of equilibrium", "Найти положения равновесия"))
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
    fn run(&self, machine: &mut Machine, asked: &Asked, watch: &mut Watch) -> Found {
        Some(places(machine, asked.guess(), Between::of(asked), watch))
    }
    fn merge(&self, _: &Machine, given: Given) -> Result<Asked, Failure> {
        Ok(overlaid(given.of_file.unwrap_or_else(|| Asked::new("equilibrium")), given.line))
    }
    fn alone(&self) -> Alone {
        Alone::Places
    }
    fn repeats(&self) -> Repeats {
        Repeats::Rest
    }
}

/// Positions of equilibrium, from the start of the motion and from a guess, or all with a coordinate between two values.
pub fn places(machine: &mut Machine, guess: &[(SymbolId, f64)], over: Option<Between>, watch: &mut Watch) -> Finding {
    let outcome = at_rest(machine, guess, over).unwrap_or_else(|fault| Outcome { dataset: Dataset::default(), fault: Some(fault) });
    watch.lap(Lap::Run);
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
        let n = machine.equations.coordinates.len();
        let mut linear = LinearMachine::new(&Arc::new(machine.equations.clone()), About::Rest)?;
        let found = analysis::studies::equilibrium::find(&mut linear, &machine.system.states()[..n], &start[..n], &options);
        (found, linear.timing(), machine.equations.clone())
    } else {
        let resting = Resting::new(&machine.equations)?;
        let parameters = numbers_of(resting.equations());
        let studied = analysis::rest::report::Studied { rest: resting.equations(), motion: &machine.equations };
        (analysis::rest::report::study(studied, &parameters, &start, &options), resting.timing, resting.equations().clone())
    };
    let column = |name: &str| outcome.dataset.column(name).map(|c| c.values.clone()).unwrap_or_default();
    if let Some(fault) = crate::strands::pushing(machine, column) {
        return Err(fault);
    }
    crate::small::add_roots(machine, &mut outcome.dataset);
    analysis::rest::observed::add(&equations, &numbers_of(&equations), timing, &mut outcome.dataset);
    outcome.dataset.notes.extend(crate::small::timing_notes(timing));
    outcome.dataset.notes.extend(crate::small::unknown_notes(machine));
    Ok(outcome)
}

fn numbers_of(equations: &Equations) -> Vec<f64> {
    equations.parameters.iter().map(|p| p.value).collect()
}
