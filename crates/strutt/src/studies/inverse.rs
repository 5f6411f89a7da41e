//! The study `inverse`: a motion that `[motions]` prescribe, with the work of the motors that realise it.

use super::{Fact, Results, Rows};
use crate::pipeline::{self, Finding, Machine};
use crate::plan;
use crate::watch::Watch;
use analysis::studies::simulate::{Grid, Simulate as Options, simulate};
use mechanics::model::Simulate;
use serde_json::{Map, json};
use symbolic::connections::Law;
use symbolic::equations::{Output, Role};
use symbolic::{Equations, Text};

/// Panels and nodes of Gauss's rule for the work.
const PANELS: usize = 500;
const NODES: [(f64, f64); 3] = [
    (-0.774_596_669_241_483_4, 0.555_555_555_555_555_6),
    (0.0, 0.888_888_888_888_888_8),
    (0.774_596_669_241_483_4, 0.555_555_555_555_555_6),
];

/// Runs the study.
pub fn run(machine: &mut Machine, study: &Simulate, watch: &mut Watch) -> Finding {
    let study = plan::with_plots(study, &machine.equations);
    let finding = pipeline::simulate(machine, &study, watch);
    let trouble = finding.trouble().cloned();
    let mut results = Results {
        kind: "inverse",
        heading: Text::new("Inverse dynamics", "Обратная задача динамики"),
        rows: Rows::Summary,
        plots: study.plots.clone(),
        data: finding.data().clone(),
        ..Results::default()
    };
    if trouble.is_none() {
        work(machine, study.until, &mut results);
    }
    results.own.insert("until".into(), json!(study.until));
    results.trouble = trouble;
    Finding::Study(Box::new(results))
}

/// Adds the work of every motor over the run.
fn work(machine: &Machine, until: f64, results: &mut Results) {
    let (equations, names) = with_powers(&machine.equations);
    if names.is_empty() || until <= 0.0 {
        return;
    }
    let Ok(mut system) = pipeline::lower(&equations) else { return };
    let Ok(start) = system.start() else { return };
    let width = until / PANELS as f64;
    let node = |k: usize| width * ((k / 3) as f64 + 0.5 * (1.0 + NODES[k % 3].0));
    let times: Vec<f64> = (0..3 * PANELS).map(node).collect();
    let options = Options { grid: Grid::At(times), outputs: Some(names.iter().map(|n| n.0.clone()).collect()), ..Options::until(until) };
    let outcome = simulate(&mut system, &start, options);
    if outcome.fault.is_some() {
        return;
    }
    let mut all = Map::new();
    for (output, motor) in &names {
        let Some(column) = outcome.dataset.column(output) else { continue };
        let sum: f64 = column.values.iter().enumerate().map(|(k, p)| 0.5 * width * NODES[k % 3].1 * p).sum();
        let label = Text::new(format!("work of {motor} over the motion"), format!("работа {motor} за время движения"));
        results.facts.push(Fact::new(&format!("work({motor})"), "A", "J", sum, label));
        all.insert(motor.clone(), json!(sum));
    }
    let total: f64 = all.values().filter_map(serde_json::Value::as_f64).sum();
    let label = Text::new("work of all motors", "работа всех двигателей");
    results.facts.push(Fact::new("work_total", "A", "J", total, label));
    results.own.insert("work".into(), json!(all));
}

/// The equations with the power of every motor as an output, λ Σ (∂Q/∂λ)_j q'_j; names of output and motor.
fn with_powers(equations: &Equations) -> (Equations, Vec<(String, String)>) {
    let mut equations = equations.clone();
    let mut names = Vec::new();
    for k in 0..equations.reactions.len() {
        if !matches!(equations.reactions[k].law, Law::Motor) {
            continue;
        }
        let (symbol, name) = (equations.reactions[k].symbol, equations.reactions[k].name.clone());
        let forces = equations.reactions[k].forces.clone();
        let mut terms = Vec::new();
        for (j, e) in forces {
            let rate = equations.graph.symbol(equations.coordinates[j].symbols[1]);
            terms.push(equations.graph.mul(e, rate));
        }
        let speed = equations.graph.sum(&terms);
        let force = equations.graph.symbol(symbol);
        let formula = equations.graph.mul(force, speed);
        let output = format!("power of {name}");
        let id = equations.graph.symbol_id(&format!("power_of_{k}"), 0);
        equations.outputs.push(Output {
            name: output.clone(),
            symbol: id,
            unit: "W".into(),
            display: None,
            label: Text::default(),
            role: Role::Named,
            formula,
        });
        names.push((output, name));
    }
    (equations, names)
}
