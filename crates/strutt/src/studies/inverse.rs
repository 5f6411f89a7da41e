//! The study `inverse`: forces and torques that realise prescribed motions, their powers and work.

use super::{Fact, Results};
use crate::finite::checked;
use crate::pipeline::{self, Finding, Machine};
use crate::plan;
use crate::watch::Watch;
use analysis::Dataset;
use mechanics::model::{Simulate, Times};
use serde_json::json;
use symbolic::Text;
use symbolic::equations::Role;

/// Panels between events, and the nodes and weights of Gauss and Legendre on -1 ... 1 (8 points: exact for degree 15).
const PANELS: usize = 40;
const GAUSS: [(f64, f64); 4] = [
    (0.183_434_642_495_649_8, 0.362_683_783_378_362),
    (0.525_532_409_916_329, 0.313_706_645_877_887_27),
    (0.796_666_477_413_626_7, 0.222_381_034_453_374_48),
    (0.960_289_856_497_536_3, 0.101_228_536_290_376_26),
];

/// Makes the study.
pub fn run(machine: &mut Machine, study: &Simulate, watch: &mut Watch) -> Finding {
    let study = plan::with_plots(study, &machine.equations);
    let Finding::Motion(_, data, trouble) = pipeline::simulate(machine, &study, watch) else {
        return Finding::Study(Box::new(Results { kind: "inverse", heading: heading(), ..Results::default() }));
    };
    let (facts, work) = if trouble.is_none() { works(machine, &study, &data) } else { Default::default() };
    let mut results =
        Results { kind: "inverse", heading: heading(), facts, data, plots: study.plots.clone(), trouble, ..Results::default() };
    results.own.insert("until".into(), json!(study.until));
    results.own.insert("tolerance".into(), json!(study.tolerance));
    results.own.insert("work".into(), work);
    checked(Finding::Study(Box::new(results)))
}

fn heading() -> Text {
    Text::new("Inverse dynamics", "Обратная задача динамики")
}

/// Work of each motor: its power integrated piece by piece between events.
fn works(machine: &mut Machine, study: &Simulate, data: &Dataset) -> (Vec<Fact>, serde_json::Value) {
    let powers: Vec<(String, String, Text)> = machine
        .equations
        .outputs
        .iter()
        .filter(|o| o.role == Role::Power)
        .map(|o| (o.name.clone(), o.name.trim_start_matches("power(").trim_end_matches(')').to_owned(), o.label.clone()))
        .collect();
    let nodes = nodes(study.until, data.events.iter().map(|e| e.t));
    if powers.is_empty() || nodes.is_empty() {
        return Default::default();
    }
    let again = Simulate {
        times: Times::At(nodes.iter().map(|n| n.0).collect()),
        outputs: powers.iter().map(|p| p.0.clone()).collect(),
        plots: Vec::new(),
        ..study.clone()
    };
    let Finding::Motion(_, table, None) = pipeline::simulate(machine, &again, &mut Watch::default()) else { return Default::default() };
    let mut own = serde_json::Map::new();
    let mut facts = Vec::new();
    for (name, motor, label) in powers {
        let Some(column) = table.columns.iter().find(|c| c.quantity.name == name) else { continue };
        let work: f64 = column.values.iter().zip(&nodes).map(|(power, (_, weight))| power * weight).sum();
        let meaning = Text::new(format!("work; {}", label.en), format!("работа; {}", label.ru));
        facts.push(Fact::new(&format!("work({motor})"), &format!("A_{motor}"), "J", work, meaning));
        own.insert(motor, json!(work));
    }
    (facts, own.into())
}

/// Instants and weights of the quadrature over 0 ... end.
fn nodes(end: f64, events: impl Iterator<Item = f64>) -> Vec<(f64, f64)> {
    let mut borders = vec![0.0];
    borders.extend(events.filter(|t| *t > 0.0 && *t < end));
    borders.push(end);
    borders.sort_by(f64::total_cmp);
    borders.dedup();
    let mut nodes = Vec::new();
    for pair in borders.windows(2) {
        let half = 0.5 * (pair[1] - pair[0]) / PANELS as f64;
        for panel in 0..PANELS {
            let middle = pair[0] + half * (2 * panel + 1) as f64;
            for side in [-1.0, 1.0] {
                nodes.extend(GAUSS.iter().map(|(x, w)| (middle + side * half * x, half * w)));
            }
        }
    }
    nodes.sort_by(|a, b| a.0.total_cmp(&b.0));
    nodes
}
