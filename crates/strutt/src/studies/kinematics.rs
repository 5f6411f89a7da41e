//! The study `kinematics`: places, velocities and accelerations over a range of the driven coordinate, transfer functions, instantaneous centres.

use super::{Results, Rows};
use crate::pipeline::{self, Finding, Machine, explained};
use crate::provenance;
use crate::source::Source;
use crate::watch::Watch;
use crate::words::Word;
use analysis::dataset::Column;
use analysis::studies::kinematics::{Place, follow};
use analysis::{Dataset, Quantity};
use mechanics::model::{Kinematics, KinematicsEnd};
use serde_json::json;
use std::f64::consts::TAU;
use symbolic::{Equations, Expr, SymbolId, Text};

/// Runs the study.
pub fn run(machine: &mut Machine, study: &Kinematics, watch: &mut Watch) -> Finding {
    let mut results = Results {
        kind: "kinematics",
        heading: Text::new("Kinematics of the linkage", "Кинематика механизма"),
        rows: Rows::Summary,
        plots: study.plots.clone(),
        ..Results::default()
    };
    fill(machine, study, &mut results);
    watch.lap(Word::TimeRun);
    Finding::Study(Box::new(results))
}

fn fill(machine: &mut Machine, study: &Kinematics, results: &mut Results) {
    let start = match machine.system.start() {
        Ok(start) => start,
        Err(fault) => {
            results.data = pipeline::no_numbers(machine);
            results.trouble = Some(explained(fault, &machine.equations));
            return;
        }
    };
    let centred = with_centres(machine);
    let equations = centred.as_ref().map_or(&machine.equations, |m| &m.equations);
    let n = equations.coordinates.len();
    let index = |symbol: SymbolId| equations.coordinates.iter().position(|c| c.symbols[0] == symbol);
    let over = index(study.over).unwrap_or(0);
    let from = study.from.unwrap_or(start[over]);
    let to = match study.to {
        KinematicsEnd::At(to) => to,
        KinematicsEnd::Turns(turns) => from + TAU * turns,
    };
    let rate = study.rate.unwrap_or(if start[n + over] == 0.0 { 1.0 } else { start[n + over] });
    let last = study.points.max(2) - 1;
    let ways: Vec<f64> = (0..=last).map(|k| from + (to - from) * k as f64 / last as f64).collect();
    let with: Vec<(usize, Expr, Expr)> = driven_too(equations, study, &index);
    let formulas = Formulas::new(equations);
    let driven = |s: f64| {
        let mut q = vec![0.0; n];
        q[over] = s;
        let zero = vec![0.0; n];
        let mut all = vec![(over, s, 1.0)];
        for &(i, value, slope) in &with {
            let at = formulas.values(&q, &zero, &zero, &[value, slope]);
            all.push((i, at[0], at[1]));
        }
        all
    };
    let (places, fault) = follow(&mut machine.system, &start, &ways, &driven);
    let data = columns(equations, study, over, rate, &ways, &places, &formulas);
    results.data = provenance::stamp(data, &machine.equations, &machine.model_hash);
    results.own.insert("over".into(), json!(study.name));
    results.own.insert("rate".into(), json!(rate));
    if let Some(fault) = fault {
        results.data.partial = true;
        results.trouble = Some(explained(fault, &machine.equations));
    }
    if results.plots.is_empty() {
        let name = |i: usize| equations.graph.symbol_info(equations.coordinates[i].symbols[0]).name.clone();
        let y: Vec<String> = (0..n).filter(|&i| i != over).map(name).collect();
        results.plots = y.into_iter().map(|y| mechanics::model::Plot { title: Text::default(), x: None, y: vec![y] }).collect();
    }
}

/// The other driven coordinates with their derivatives by the first.
fn driven_too(equations: &Equations, study: &Kinematics, index: &dyn Fn(SymbolId) -> Option<usize>) -> Vec<(usize, Expr, Expr)> {
    let mut graph = equations.graph.clone();
    let slope = |graph: &mut symbolic::Graph, e: Expr| graph.derivative(e, study.over);
    study.with.iter().filter_map(|(symbol, e)| Some((index(*symbol)?, *e, slope(&mut graph, *e)))).collect()
}

/// The machine with the instantaneous centres of its bodies as outputs; none when they have none (in space, or formulas that do not read).
fn with_centres(machine: &Machine) -> Option<Machine> {
    let model = &machine.model;
    let mut text = machine.origin.source.text.clone();
    text.push('\n');
    let bodies: Vec<&str> = model.frames.iter().skip(1).map(|f| f.name.as_str()).filter(|name| name.is_ascii()).collect();
    for body in &bodies {
        text += &format!("\n[points.ic_{body}_]\non = \"{body}\"\nat = [\"0\", \"0\"]\n");
        text += &format!("\n[outputs.P_x_{body}]\nvalue = \"x(ic_{body}_) - vy(ic_{body}_)/omega({body})\"\n");
        text += &format!("\n[outputs.P_y_{body}]\nvalue = \"y(ic_{body}_) + vx(ic_{body}_)/omega({body})\"\n");
        text += &format!("\n[outputs.omega_{body}_]\nvalue = \"omega({body})\"\n");
    }
    let source = Source { path: machine.origin.source.path.clone(), text };
    pipeline::build(&source, &machine.origin.overrides, &mut Watch::default()).ok()
}

/// Formulas over places, rates and accelerations, by the plain evaluator of the graph.
struct Formulas<'e> {
    equations: &'e Equations,
    constants: Vec<f64>,
}

impl<'e> Formulas<'e> {
    fn new(equations: &'e Equations) -> Self {
        let mut constants = vec![0.0; equations.graph.symbol_count()];
        equations.parameters.iter().for_each(|p| constants[p.symbol.index()] = p.value);
        Formulas { equations, constants }
    }

    fn values(&self, q: &[f64], rates: &[f64], accelerations: &[f64], formulas: &[Expr]) -> Vec<f64> {
        let graph = &self.equations.graph;
        let mut values = self.constants.clone();
        for (i, c) in self.equations.coordinates.iter().enumerate() {
            values[c.symbols[0].index()] = q[i];
            values[c.symbols[1].index()] = rates[i];
            values[c.symbols[2].index()] = accelerations[i];
        }
        for d in &self.equations.definitions {
            values[d.symbol.index()] = graph.evaluate(&[d.formula], &|s| values[s.index()])[0];
        }
        graph.evaluate(formulas, &|s| values[s.index()])
    }

    /// Whether a formula is free of reactions, directly or through definitions.
    fn is_kinematic(&self, formula: Expr) -> bool {
        let reactions: Vec<SymbolId> = self.equations.reactions.iter().map(|r| r.symbol).collect();
        let mut all = vec![formula];
        let found = self.equations.graph.symbols_in(&all);
        all.extend(self.equations.definitions.iter().filter(|d| found.contains(&d.symbol)).map(|d| d.formula));
        !self.equations.graph.symbols_in(&all).iter().any(|s| reactions.contains(s))
    }
}

fn columns(
    equations: &Equations,
    study: &Kinematics,
    over: usize,
    rate: f64,
    ways: &[f64],
    places: &[Place],
    formulas: &Formulas<'_>,
) -> Dataset {
    let graph = &equations.graph;
    let name = |i: usize| graph.symbol_info(equations.coordinates[i].symbols[0]).name.clone();
    let shown = |n: &str| equations.notation.iter().find(|(name, _)| name == n).map_or(n, |(_, s)| s.as_str()).to_owned();
    let wanted = |n: &str| study.outputs.is_empty() || study.outputs.iter().any(|w| w == n);
    let count = places.len();
    let mut columns = Vec::new();
    let own = &equations.coordinates[over];
    let axis = Quantity { symbol: shown(&name(over)), label: own.label.clone(), ..Quantity::new(&name(over), &own.unit) };
    columns.push(Column { quantity: axis, values: ways[..count].to_vec() });
    let chosen: Vec<_> = equations
        .outputs
        .iter()
        .filter(|o| o.name != name(over) && formulas.is_kinematic(o.formula))
        .filter(|o| wanted(&o.name) || o.name.starts_with("P_") || o.name.starts_with("omega_") && o.name.ends_with('_'))
        .collect();
    let exprs: Vec<Expr> = chosen.iter().map(|o| o.formula).collect();
    let mut table: Vec<Vec<f64>> = vec![Vec::with_capacity(count); exprs.len()];
    for place in places {
        let rates: Vec<f64> = place.first.iter().map(|b| b * rate).collect();
        let accelerations: Vec<f64> = place.second.iter().map(|c| c * rate * rate).collect();
        let row = formulas.values(&place.q, &rates, &accelerations, &exprs);
        // an instantaneous centre at infinity is no number
        table.iter_mut().zip(row).for_each(|(column, v)| column.push(if v.is_finite() && v.abs() < 1e9 { v } else { f64::NAN }));
    }
    for (output, values) in chosen.iter().zip(table) {
        let symbol = graph.symbol_info(output.symbol);
        let symbol = format!("{}{}", shown(&symbol.name), "'".repeat(usize::from(symbol.primes)));
        let label = match output.name.strip_prefix("P_") {
            Some(rest) if output.label.en.is_empty() => {
                let (axis, body) = rest.split_at(1);
                let body = body.trim_start_matches('_');
                Text::new(
                    format!("instantaneous centre of velocity of {body}, {axis}"),
                    format!("мгновенный центр скоростей {body}, {axis}"),
                )
            }
            _ => output.label.clone(),
        };
        let quantity = Quantity { symbol, label, display: output.display.clone(), ..Quantity::new(&output.name, &output.unit) };
        columns.push(Column { quantity, values });
    }
    for (i, coordinate) in equations.coordinates.iter().enumerate().filter(|(i, _)| *i != over) {
        let unit = if coordinate.unit == own.unit { "1".to_owned() } else { format!("{}/{}", coordinate.unit, own.unit) };
        let label = Text::new("transfer function, first order", "передаточная функция первого порядка");
        let first = Quantity { label, ..Quantity::new(&format!("d{}/d{}", name(i), name(over)), &unit) };
        let label = Text::new("transfer function, second order", "передаточная функция второго порядка");
        let second = Quantity { label, ..Quantity::new(&format!("d2{}/d{}2", name(i), name(over)), &unit) };
        columns.push(Column { quantity: first, values: places.iter().map(|p| p.first[i]).collect() });
        columns.push(Column { quantity: second, values: places.iter().map(|p| p.second[i]).collect() });
    }
    Dataset { axis: Some(0), columns, ..Dataset::default() }
}
