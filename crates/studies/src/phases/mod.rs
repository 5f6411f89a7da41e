//! The phases of a closed-form motion: as JSON here, as a written solution in [`steps`].

mod found;
mod principal;
mod setting;
pub mod steps;
mod tables;
mod writer;

pub use found::Phases;

use crate::results::{Results, Show, View};
use algebra::complex;
use analysis::studies::transient::Phase;
use analysis::studies::transient::constants::{Clock, Listed};
use analysis::studies::transient::load::Term;
use report::Block;
use serde_json::{Map, Value, json};

impl Show for Phases {
    /// The written solution phase by phase.
    fn blocks(&self, _: &Results, view: &View) -> Vec<Block> {
        steps::blocks(view.equations, self, view.language, view.width())
    }
}

/// `[{start, end, phase, case, resonance, constants: {C1, C2, D, epsilon, k, n, h, ...}, state_at_start: {phi, phi'}, state_at_end}]`.
///
/// `phase` says whether the loads keep their phase at the start of the phase or begin anew. With several degrees of freedom `modes` takes the
/// place of `constants`; where modes do not uncouple, `case` is `coupled`. The forced motion is `static`, plus D sin(pt + delta - epsilon) of
/// each of the `harmonics`, plus factor τ^power e^(rate τ) cos(frequency τ + phase) of each of `further`.
pub fn to_json(phases: &Phases) -> Value {
    phases.list.iter().map(|phase| one(phase, phases)).collect()
}

fn one(phase: &Phase, phases: &Phases) -> Value {
    let names = &phases.names;
    let mut out = Map::new();
    out.insert("start".into(), json!(phase.start));
    out.insert("end".into(), json!(phase.end));
    out.insert("phase".into(), json!(if phases.restarts(phase) { "restarts" } else { "keeps" }));
    let listed = phase.listed();
    match listed.as_slice() {
        [] => {
            out.insert("case".into(), json!("coupled"));
        }
        [only] if phase.form.n == 1 => out.extend(constants(only)),
        modes => {
            out.insert("case".into(), json!("modes"));
            let mode = |m: &Listed| {
                let shape: Map<String, Value> = names.iter().cloned().zip(m.mode.shape.iter().map(|s| json!(s))).collect();
                let mut own = constants(m);
                own.insert("shape".into(), json!(shape));
                own
            };
            out.insert("modes".into(), modes.iter().map(|m| Value::Object(mode(m))).collect());
        }
    }
    let state = |values: &[f64]| -> Map<String, Value> { names.iter().cloned().zip(values.iter().map(|v| json!(v))).collect() };
    out.insert("state_at_start".into(), json!(state(&phase.state_at_start)));
    out.insert("state_at_end".into(), json!(state(&phase.state_at_end)));
    Value::Object(out)
}

fn constants(listed: &Listed) -> Map<String, Value> {
    let object =
        |list: Vec<(&'static str, f64)>| -> Map<String, Value> { list.into_iter().map(|(k, v)| (k.to_owned(), json!(v))).collect() };
    let mut out = Map::new();
    out.insert("case".into(), json!(listed.constants.case.name()));
    out.insert("resonance".into(), json!(listed.constants.resonance));
    out.insert("constants".into(), json!(object(listed.named())));
    let clock = |c: Clock| if c == Clock::Phase { "tau" } else { "t" };
    let harmonics: Vec<Value> = listed
        .forcing
        .iter()
        .map(|f| {
            let mut one = object(f.named(listed.inertia, listed.mode.oscillator.k2));
            one.insert("time".into(), json!(clock(f.clock)));
            Value::Object(one)
        })
        .collect();
    out.insert("harmonics".into(), json!(harmonics));
    out.insert("further".into(), further(listed));
    out
}

/// Ramps, growth and resonance; what they leave constant is part of `static`.
fn further(listed: &Listed) -> Value {
    let load = listed.further();
    let terms = load.0.iter().filter(|t| t.rate.im >= 0.0 && (t.power > 0 || t.rate.re != 0.0 || t.rate.im != 0.0));
    let one = |t: &Term| {
        let (factor, phase) = if t.rate.im == 0.0 { (t.factor.re, 0.0) } else { (2.0 * complex::abs(t.factor), complex::arg(t.factor)) };
        json!({ "factor": factor, "power": t.power, "rate": t.rate.re, "frequency": t.rate.im, "phase": phase })
    };
    terms.map(one).collect()
}

/// Names of the coordinates, then of their rates.
pub fn state_names(equations: &symbolic::Equations) -> Vec<String> {
    let name = |primes: &str| {
        let primes = primes.to_owned();
        equations.coordinates.iter().map(move |c| format!("{}{primes}", equations.graph.symbol_info(c.symbols[0]).name))
    };
    name("").chain(name("'")).collect()
}
