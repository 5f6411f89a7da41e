//! The study `statics` for models of bodies: all reactions at rest in the start position, and which motion would be free.

use super::{Fact, Results, Rows};
use crate::failure::Trouble;
use crate::pipeline::{self, Finding, Machine, explained};
use crate::provenance;
use crate::watch::Watch;
use crate::words::Word;
use analysis::studies::kinematics::freedoms;
use analysis::studies::simulate::{Grid, Simulate as Options, simulate};
use analysis::{Dataset, Mode, System};
use serde_json::{Value, json};
use symbolic::equations::{Output, Role};
use symbolic::{Equations, Text};

/// Accelerations of a machine at rest relative to what gravity gives, m/s² or rad/s².
const STILL: f64 = 1e-9;

/// Runs the study.
pub fn run(machine: &mut Machine, watch: &mut Watch) -> Finding {
    if let Some(finding) = crate::structure::statics(machine) {
        return finding;
    }
    let mut results = Results {
        kind: "statics",
        heading: Text::new("Statics", "Статика"),
        rows: Rows::Hidden,
        data: pipeline::no_numbers(machine),
        ..Results::default()
    };
    results.trouble = fill(machine, &mut results).err();
    watch.lap(Word::TimeRun);
    Finding::Study(Box::new(results))
}

fn fill(machine: &Machine, results: &mut Results) -> Result<(), Trouble> {
    let (equations, names) = with_reactions(&machine.equations);
    let mut system = pipeline::lower(&equations).map_err(|fault| explained(fault, &equations))?;
    let mut x = system.start().map_err(|fault| explained(fault, &equations))?;
    let n = equations.coordinates.len();
    x[n..2 * n].fill(0.0);
    let accelerations: Vec<String> = equations.outputs.iter().filter(|o| o.role == Role::Acceleration).map(|o| o.name.clone()).collect();
    let outputs: Vec<String> = names.iter().chain(&accelerations).cloned().collect();
    let options = Options { grid: Grid::At(vec![0.0]), outputs: Some(outputs), ..Options::until(0.0) };
    let outcome = simulate(&mut system, &x, options);
    if let Some(fault) = outcome.fault {
        return Err(explained(fault, &equations));
    }
    let value = |data: &Dataset, name: &str| data.column(name).and_then(|c| c.values.first().copied()).unwrap_or(f64::NAN);
    let modes = vec![Mode::Zero; system.guards().len()];
    let free = freedoms(&mut system, &x, &modes).map_err(|fault| explained(fault, &equations))?;
    results.own.insert("degrees_of_freedom".into(), json!(free.len()));
    let moving = accelerations.iter().map(|name| value(&outcome.dataset, name).abs()).fold(0.0, f64::max);
    let words: Vec<String> = free.iter().map(|(_, direction)| in_words(&equations, direction)).collect();
    if moving > STILL {
        let list = words.join("; ");
        return Err(Trouble::new(
            "S040",
            format!("not at rest: a mechanism with {} degrees of freedom; it moves along {list}", free.len()),
            format!("не в покое: механизм с числом степеней свободы {}; он движется так: {list}", free.len()),
        )
        .why("the loads are not balanced in the start position", "в начальном положении нагрузки не уравновешены")
        .help("add a support, or find the equilibrium first", "добавьте опору или сначала найдите положение равновесия"));
    }
    if !free.is_empty() {
        let list = words.join("; ");
        results.words.push(Text::new(
            format!("In equilibrium, but a mechanism with {} degrees of freedom: free along {list}.", free.len()),
            format!("Равновесие, но это механизм с числом степеней свободы {}: свободно движение {list}.", free.len()),
        ));
    }
    let mut list: Vec<Value> = Vec::new();
    for (name, reaction) in names.iter().zip(&equations.reactions) {
        let found = value(&outcome.dataset, name);
        results.facts.push(Fact::new(&reaction.name, &reaction.name, &reaction.unit, found, reaction.label.clone()));
        list.push(json!({"name": reaction.name, "value": found, "unit": reaction.unit}));
    }
    results.own.insert("reactions".into(), json!(list));
    let mut data = outcome.dataset.clone();
    data.columns.retain(|c| names.contains(&c.quantity.name));
    data.axis = None;
    results.data = provenance::stamp(data, &machine.equations, &machine.model_hash);
    Ok(())
}

/// The components of a direction that are not zero.
fn in_words(equations: &Equations, direction: &[f64]) -> String {
    let name = |i: usize| equations.graph.symbol_info(equations.coordinates[i].symbols[0]).name.clone();
    let parts = direction.iter().enumerate().filter(|(_, d)| d.abs() > 1e-6);
    parts.map(|(i, d)| format!("{}: {}", name(i), report::number::short(*d, 3, report::Language::En))).collect::<Vec<_>>().join(", ")
}

/// The equations with every reaction as an output; names of the outputs.
fn with_reactions(equations: &Equations) -> (Equations, Vec<String>) {
    let mut equations = equations.clone();
    let mut names = Vec::new();
    for reaction in equations.reactions.clone() {
        let name = format!("reaction {}", reaction.name);
        let formula = equations.graph.symbol(reaction.symbol);
        equations.outputs.push(Output {
            name: name.clone(),
            symbol: reaction.symbol,
            unit: reaction.unit.clone(),
            display: None,
            label: reaction.label.clone(),
            role: Role::Named,
            formula,
        });
        names.push(name);
    }
    (equations, names)
}
