//! Numbers of rest as answers: reactions, forces in rods, moments and displacements of frames and trusses by their paths; their units, and what a number
//! that is zero is measured by.

use crate::observable::Observable;
use crate::results::Results;
use serde_json::Value;

/// The SI unit of a number of `statics` by its path: `forces.AB`, `reactions.A.y`, `rods.AB.M.2`, `nodes.C.turn`, `displacements.u1`.
pub fn unit(results: &Results, path: &str, displacement: &dyn Fn(&str) -> Option<String>) -> Option<String> {
    if results.kind != crate::statics::KIND.name {
        return None;
    }
    let mut steps = path.split('.');
    let table = steps.next()?;
    let name = steps.next()?;
    let unit = match (table, steps.next()) {
        ("forces", None) => "N",
        ("reactions" | "springs", Some("x" | "y")) => "N",
        ("reactions" | "springs", Some("turn")) => "N m",
        ("rods", Some("N" | "V" | "N_max" | "V_max")) => "N",
        ("rods", Some("M" | "M_max")) => "N m",
        ("rods", Some("s")) => "m",
        ("nodes", Some("x" | "y")) => "m",
        ("nodes", Some("turn")) => "rad",
        ("displacements", None) => return displacement(name),
        _ => return None,
    };
    Some(unit.to_owned())
}

/// The largest magnitude among the numbers of the same kind: reactions of the same unit, the same quantity of the other modes or rods; zero where there
/// is nothing to compare with.
pub fn size(results: &Results, path: &str) -> f64 {
    let fact = |name: &str| results.facts.iter().find(|f| f.quantity.name == name);
    if let Some(own) = fact(path) {
        return greatest(results.facts.iter().filter(|f| f.quantity.unit == own.quantity.unit).map(|f| f.value));
    }
    if results.own.get(path).is_some_and(|v| !v.is_object() && !v.is_array()) || Observable::field(path).of(results).is_err() {
        return 0.0;
    }
    let steps: Vec<&str> = path.split('.').collect();
    let Some(root) = results.own.get(steps[0]) else { return 0.0 };
    greatest(alike(root, &steps[1..]).into_iter())
}

/// The numbers at the end of a path with any name or place in its first step.
fn alike(root: &Value, steps: &[&str]) -> Vec<f64> {
    let Some((_, rest)) = steps.split_first() else { return root.as_f64().into_iter().collect() };
    let inside: Vec<&Value> = match root {
        Value::Array(list) => list.iter().collect(),
        Value::Object(map) => map.values().collect(),
        _ => Vec::new(),
    };
    // both components of a reaction are of one kind
    let both = [["x"], ["y"]];
    let paths: Vec<&[&str]> = if let ["x" | "y"] = rest { both.iter().map(|p| &p[..]).collect() } else { vec![rest] };
    inside.into_iter().flat_map(|v| paths.iter().filter_map(move |path| follow(v, path))).collect()
}

fn follow(root: &Value, steps: &[&str]) -> Option<f64> {
    let step = |at: &'_ Value, step: &&str| at.get(*step).or_else(|| at.get(step.parse::<usize>().ok()?)).cloned();
    steps.iter().try_fold(root.clone(), |at, s| step(&at, s))?.as_f64()
}

fn greatest(values: impl Iterator<Item = f64>) -> f64 {
    values.filter(|v| v.is_finite()).map(f64::abs).fold(0.0, f64::max)
}
