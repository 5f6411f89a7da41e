//! Natural oscillations of the structure of a model.

use super::compare::Level;
use super::equation;
use super::rayleigh::Reduced as Reduction;
use crate::frame::bind::{Bound, Factor, Numbers, bind};
use crate::small::asked::{Modes as Study, Scale};
pub use crate::small::modes::NAME;
use analysis::studies::structure_modes::{self, Modes, Normalise, StructureModes};
use mechanics::Model;
use mechanics::model;
use mechanics::structure::Structure;
use serde_json::{Map, Value, json};
use structures::reduced::{Condensation, Reduced};
use symbolic::Rational;
use words::Notice;

/// What was found, with the numbers it was found from.
#[derive(Clone, Debug)]
pub struct Found {
    /// The structure in numbers.
    pub bound: Bound,
    /// The modes.
    pub result: StructureModes,
    /// The frequency equation.
    pub equation: Option<String>,
    /// The user's variable in it.
    pub variable: Option<String>,
    /// The same with its factor.
    pub meaning: Option<model::FrequencyVariable>,
    /// Rods as one degree of freedom, by assumed shapes.
    pub rayleigh: Vec<Reduction>,
    /// The same frame at other levels of simplification.
    pub levels: Vec<Level>,
}

/// Options of the file.
pub fn options(structure: &Structure, study: &Study) -> Modes {
    let o = &structure.options;
    let normalise = match study.scale {
        Scale::Largest => Normalise::Largest,
        Scale::Mass => Normalise::Mass,
        Scale::First => Normalise::First,
    };
    let condensation = match o.condense {
        None => Condensation::Automatic,
        Some(true) => Condensation::Turns,
        Some(false) => Condensation::Massless,
    };
    Modes { count: o.modes.unwrap_or(10), normalise, condensation, continuum: o.continuum, accuracy: o.accuracy }
}

/// Natural oscillations.
///
/// # Errors
/// Mechanisms, loose nodes, no inertia.
pub fn find(model: &Model, structure: &Structure, study: &Study) -> Result<Found, Box<Notice>> {
    let bound = bind(model, structure);
    let options = options(structure, study);
    let result = structure_modes::modes(&bound.frame, bound.exact.as_ref(), &options).map_err(|f| Box::new(Notice::from(f)))?;
    let factor = |v: &model::FrequencyVariable| (v.name.clone(), Numbers::of(model).factor(v.factor));
    let variable: Option<(String, Factor)> = study.variable.as_ref().map(factor);
    let variable = variable.as_ref();
    let equation = match (&result.equation, &result.reduced) {
        (Some(coefficients), _) => equation::exact(coefficients, variable),
        (None, Some(reduced)) if reduced.n() <= 4 && result.modes.len() == reduced.n() => {
            let squares: Vec<f64> = result.modes.iter().map(|m| m.omega * m.omega).collect();
            Some(equation::decimal(&squares, variable))
        }
        _ => None,
    };
    let variable = variable.map(|v| v.0.clone());
    let rayleigh = super::rayleigh::all(model, structure);
    let shown = result.modes.len().min(3);
    let levels = if structure.options.compare { super::compare::levels(model, structure, shown) } else { Vec::new() };
    Ok(Found { bound, result, equation, meaning: study.variable.clone(), variable, rayleigh, levels })
}

/// The study's own fields of JSON.
pub fn fields(found: &Found) -> Map<String, Value> {
    let mut own = Map::new();
    let tau = 2.0 * std::f64::consts::PI;
    let result = &found.result;
    let mode = |m: &structure_modes::Mode| {
        let shape: Map<String, Value> = result.coordinates.iter().zip(&m.shape).map(|(q, v)| (q.name.clone(), json!(v))).collect();
        json!({"omega": m.omega, "f": m.omega / tau, "T": tau / m.omega, "damping_ratio": 0.0, "omega_d": m.omega, "kind": "oscillation",
            "shape": shape, "residual": m.residual, "modes_below": m.below})
    };
    own.insert("study".into(), json!(NAME));
    own.insert("coordinates".into(), result.coordinates.iter().map(|q| json!(q.name)).collect());
    own.insert("modes".into(), result.modes.iter().map(mode).collect());
    if let Some(exact) = &result.continuum {
        own.insert("continuum".into(), json!(exact));
    }
    if !found.rayleigh.is_empty() {
        let row = |r: &Reduction| {
            json!({"name": r.name, "rod": r.rod, "reduced_mass": r.mass, "share": r.share, "stiffness": r.stiffness, "lumped": r.lumped, "springs": r.springs,
                "omega": r.omega})
        };
        own.insert("rayleigh".into(), found.rayleigh.iter().map(row).collect());
    }
    if !found.levels.is_empty() {
        own.insert("levels".into(), found.levels.iter().map(|l| json!({"key": l.key, "omega": l.omega})).collect());
    }
    if let Some(equation) = &found.equation {
        own.insert("frequency_equation".into(), json!(equation));
    }
    if let Some(reduced) = &result.reduced {
        let list = [("mass", &reduced.mass), ("stiffness", &reduced.stiffness), ("flexibility", &reduced.flexibility)];
        let rows = |matrix: &[f64]| -> Value { matrix.chunks(reduced.n().max(1)).map(|row| json!(row)).collect() };
        let matrices: Map<String, Value> = list.into_iter().map(|(key, matrix)| (key.to_owned(), rows(matrix))).collect();
        own.insert("matrices".into(), Value::Object(matrices));
    }
    if let Some(exact) = &result.exact {
        own.insert("exact_matrices".into(), exact_matrices(exact));
    }
    own
}

fn exact_matrices(reduced: &Reduced<Rational>) -> Value {
    let rows = |m: &[Rational]| -> Value {
        m.chunks(reduced.n().max(1)).map(|r| r.iter().map(|v| json!(v.to_string())).collect::<Value>()).collect()
    };
    json!({"mass": rows(&reduced.mass), "stiffness": rows(&reduced.stiffness), "flexibility": rows(&reduced.flexibility)})
}
