//! Where all frames are along a trail of states: the formulas of the derivation on a tape.

use super::numbers::{Instant, Pose};
use super::sketch::pathways;
use crate::machine::Machine;
use analysis::dataset::Trail;
use mechanics::Places;
use mechanics::model::{Class, FrameId};
use program::lower::Inputs;
use program::{Evaluator, Point};
use std::collections::BTreeMap;
use std::sync::Arc;
use symbolic::{Expr, SymbolId};

/// A machine along its motion.
#[derive(Debug)]
pub struct Course {
    /// Values of the axis.
    pub times: Vec<f64>,
    /// The first state.
    pub instants: Vec<Instant>,
    /// By state and frame.
    pub frames: Vec<Vec<Pose>>,
    /// Values of pathways by what they belong to, by state.
    pub pathways: BTreeMap<String, Vec<f64>>,
}

impl Course {
    /// Evaluates a trail; none where a place has no value. What the trail does not name stays as it is at the start.
    pub fn new(machine: &Machine, trail: &Trail) -> Option<Course> {
        let mut places = Places::new(&machine.model);
        let mut roots: Vec<Expr> = Vec::new();
        for i in 0..machine.model.frames.len() {
            let (origin, rotation) = places.frame(FrameId(i));
            roots.extend(origin);
            roots.extend(rotation.into_iter().flatten());
        }
        let mut names = Vec::new();
        for (act, pathway) in pathways(machine) {
            if let Some(value) = places.pathway(pathway) {
                names.push(act.path);
                roots.push(value);
            }
        }
        let mut tape = tape(machine, &places, &roots)?;
        let start = Instant::start(machine);
        let column = columns(machine, trail);
        let mut course = Course { times: Vec::new(), instants: Vec::new(), frames: Vec::new(), pathways: BTreeMap::new() };
        for (k, time) in trail.times.iter().enumerate() {
            let instant = at(&start, trail.row(k), (&column, *time));
            let states: Vec<f64> = instant.q.iter().chain(&instant.rates).chain(&instant.turned).copied().collect();
            let values = tape.evaluate(&Point { time: instant.t, states: &states, ..Point::default() }).ok()?;
            course.take(values, machine.model.frames.len(), &names);
            course.times.push(*time);
            if k == 0 {
                course.instants.push(instant);
            }
        }
        (!course.times.is_empty()).then_some(course)
    }

    fn take(&mut self, values: &[f64], n_frames: usize, names: &[String]) {
        let vector = |at: usize| [values[at], values[at + 1], values[at + 2]];
        let pose = |i: usize| Pose { origin: vector(12 * i), rotation: [3, 6, 9].map(|k| vector(12 * i + k)) };
        self.frames.push((0..n_frames).map(pose).collect());
        for (name, value) in names.iter().zip(&values[12 * n_frames..]) {
            self.pathways.entry(name.clone()).or_default().push(*value);
        }
    }
}

/// Which column of a trail a coordinate, a rate, a turn angle and the time is.
struct Columns {
    q: Vec<Option<usize>>,
    rates: Vec<Option<usize>>,
    turned: Vec<Option<usize>>,
    time: Option<usize>,
}

fn columns(machine: &Machine, trail: &Trail) -> Columns {
    let find = |name: &str| trail.names.iter().position(|n| n == name);
    let names = || machine.model.coordinates.iter().map(|c| c.name.as_str());
    let turned = machine.equations.auxiliaries.iter().map(|a| find(&machine.equations.graph.symbol_info(a.symbol).name));
    Columns {
        q: names().map(find).collect(),
        rates: names().map(|n| find(&format!("{n}'"))).collect(),
        turned: turned.collect(),
        time: find("t"),
    }
}

fn at(start: &Instant, row: &[f64], (column, time): (&Columns, f64)) -> Instant {
    let pick = |known: &[f64], columns: &[Option<usize>]| -> Vec<f64> {
        known.iter().zip(columns).map(|(v, c)| c.map_or(*v, |i| row[i])).collect()
    };
    Instant {
        q: pick(&start.q, &column.q),
        rates: pick(&start.rates, &column.rates),
        turned: pick(&start.turned, &column.turned),
        t: column.time.map_or(time, |i| row[i]),
    }
}

/// The formulas over (q, q', turn angles) and time.
fn tape(machine: &Machine, places: &Places, roots: &[Expr]) -> Option<Evaluator> {
    let (model, equations) = (&machine.model, &machine.equations);
    let mut parameters: Vec<(SymbolId, f64)> = equations.parameters.iter().map(|p| (p.symbol, p.value)).collect();
    let mut definitions: Vec<(SymbolId, Expr)> = Vec::new();
    for p in &model.parameters {
        match p.number {
            _ if parameters.iter().any(|(s, _)| *s == p.symbol) => {}
            _ if p.class != Class::Constant => definitions.push((p.symbol, p.value.expr())),
            Some(number) => parameters.push((p.symbol, number)),
            None => {}
        }
    }
    // the equations know symbols that no place can have
    let count = places.graph().symbol_count();
    parameters.retain(|p| p.0.index() < count);
    let order = |k: usize| model.coordinates.iter().map(move |c| c.symbols[k]);
    let inputs = Inputs {
        parameters: parameters.iter().map(|p| p.0).collect(),
        time: Some(model.time),
        states: order(0).chain(order(1)).chain(equations.auxiliaries.iter().map(|a| a.symbol)).collect(),
        definitions,
        ..Inputs::default()
    };
    let named: Vec<(String, Expr)> = roots.iter().enumerate().map(|(k, e)| (format!("place {}", k + 1), *e)).collect();
    let tape = program::lower::expressions(places.graph(), "places", &inputs, &named).ok()?;
    let values: Vec<f64> = parameters.iter().map(|p| p.1).collect();
    Evaluator::new(&Arc::new(tape), &values).ok()
}
