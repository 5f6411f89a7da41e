//! What a command gave, and claims held against it.

use crate::claim::{Claim, When, Which};
use crate::motion::{motion, no_column};
use crate::printed::equations;
use analysis::Dataset;
use studies::Results;
use studies::phases::Phases;
use studies::pipeline::Machine;
use words::Notice;

/// What a command gave.
pub enum Outcome {
    Findings(Vec<Notice>),
    Trouble { code: &'static str, what: String },
    Machine(Box<Machine>),
    Motion { times: Vec<f64>, data: Dataset },
    Rest(Dataset),
    Fields { own: serde_json::Value, data: Dataset },
    Section(Box<mechanics::section::Section>),
    Closed { times: Vec<f64>, data: Dataset, phases: Phases },
    Study(Box<Results>),
}

impl Outcome {
    /// Ended early.
    pub fn ended(trouble: &Notice) -> Outcome {
        Outcome::Trouble { code: trouble.code, what: trouble.what.en.clone() }
    }

    pub fn check(&self, claim: &Claim, model: &str) -> Result<(), String> {
        match (self, claim) {
            (Outcome::Findings(diagnostics), Claim::Error { code, line, only }) => findings(model, diagnostics, code, *line, *only),
            (Outcome::Machine(machine), Claim::Warning { code, line }) => findings(model, &machine.warnings, code, *line, false),
            (Outcome::Findings(list), Claim::Help { code, text }) => help(list, code, text),
            (Outcome::Machine(machine), Claim::Help { code, text }) => help(&machine.warnings, code, text),
            (Outcome::Machine(machine), Claim::Warnings(count)) => {
                let found: Vec<String> = machine.warnings.iter().map(|d| format!("{}: {}", d.code, d.what.en)).collect();
                if found.len() == *count { Ok(()) } else { Err(format!("{} warnings: {}", found.len(), found.join("; "))) }
            }
            (Outcome::Trouble { code, what }, Claim::Fails { code: expected, text })
                if code == expected && what.contains(text.as_str()) =>
            {
                Ok(())
            }
            (Outcome::Fields { own, .. }, Claim::Rest { name, expected, tolerance }) => {
                let found = json_field(own, name)?.as_f64().unwrap_or(f64::NAN);
                tolerance.check(name, found, *expected)
            }
            (Outcome::Fields { own, .. }, Claim::Field { path, text }) => says(&json_field(own, path)?, path, text),
            (Outcome::Fields { data, .. }, claim) => motion(&[], data, claim),
            (Outcome::Motion { times, data }, claim) => motion(times, data, claim),
            (Outcome::Closed { phases, .. }, Claim::PhaseConstant { phase, key, expected, tolerance }) => {
                tolerance.check(key, constant_of(phases, *phase, key)?, *expected)
            }
            (Outcome::Closed { phases, .. }, Claim::PhaseCase { phase, case }) => case_of(phases, *phase, case),
            (Outcome::Closed { times, data, .. }, claim) => motion(times, data, claim),
            (Outcome::Machine(machine), claim) => equations(machine, claim),
            (Outcome::Section(section), Claim::Rest { name, expected, tolerance }) => {
                let found = studies::sections::property(section, name).ok_or_else(|| format!("no property `{name}`"))?;
                tolerance.check(name, found, *expected)
            }
            (Outcome::Study(results), claim) => study_claim(results, claim),
            (Outcome::Rest(data), claim @ (Claim::Audit { .. } | Claim::AuditFails(_) | Claim::AuditsOk)) => motion(&[], data, claim),
            (Outcome::Rest(data), Claim::Open(name)) => {
                let column = data.column(name).ok_or_else(|| no_column(data, name))?;
                let open = |v: &f64| v.is_nan() && data.explains(name, *v);
                let all = !column.values.is_empty() && column.values.iter().all(open);
                if all { Ok(()) } else { Err(format!("{name}: {:?}, or nothing says why it is empty", column.values)) }
            }
            (Outcome::Rest(data), Claim::Rest { name, expected, tolerance }) => {
                let column = data.column(name).ok_or_else(|| no_column(data, name))?;
                // several equilibria may be found; the claim is about the nearest
                let distance = |v: &f64| (v - expected).abs();
                let found = column.values.iter().copied().min_by(|a, b| distance(a).total_cmp(&distance(b)));
                tolerance.check(name, found.unwrap_or(f64::NAN), *expected)
            }
            (other, _) => Err(format!("does not hold: {}", other.summary())),
        }
    }

    fn summary(&self) -> String {
        match self {
            Outcome::Findings(diagnostics) => {
                let list: Vec<String> = diagnostics.iter().map(|d| format!("{}: {}", d.code, d.what.en)).collect();
                format!("the model has findings: {}", list.join("; "))
            }
            Outcome::Trouble { code, what } => format!("ended with {code}: {what}"),
            Outcome::Machine(_) => "the model is accepted".into(),
            Outcome::Motion { .. } => "the motion was computed".into(),
            Outcome::Fields { .. } => "the study was made".into(),
            Outcome::Section(_) => "the section was computed".into(),
            Outcome::Closed { .. } => "the closed form was found".into(),
            Outcome::Rest(_) => "an equilibrium was found".into(),
            Outcome::Study(results) => format!("the study {} was made", results.kind),
        }
    }
}

/// Values of a study's column at the places of its axis.
fn study_claim(results: &Results, claim: &Claim) -> Result<(), String> {
    let data = &results.data;
    if let Claim::Extreme { name, which: which @ (Which::Least | Which::Greatest), expected, tolerance } = claim {
        // statics names the ends of what friction leaves open as facts of their own
        let word = if matches!(which, Which::Least) { "least" } else { "greatest" };
        if let Ok(found) = field(results, &format!("{word} {name}")) {
            return tolerance.check(name, found, *expected);
        }
    }
    match claim {
        Claim::Field { path, text } => says(&json_field(&results.fields().into(), path)?, path, text),
        Claim::Rest { name, expected, tolerance } => tolerance.check(name, field(results, name)?, *expected),
        Claim::Value { name, when, expected, tolerance } => {
            let axis = data.axis.and_then(|i| data.columns.get(i)).ok_or("the study has no axis")?;
            let values = &data.column(name).ok_or_else(|| no_column(data, name))?.values;
            let last = axis.values.len().checked_sub(1).ok_or("the study has no rows")?;
            let range = (axis.values[last] - axis.values[0]).abs();
            let row = match when {
                When::End => last,
                When::At(x) => {
                    // the same value of the axis: rounding of a grid
                    let near = |v: &f64| (v - x).abs() <= 1e-12 * range.max(x.abs());
                    axis.values.iter().position(near).ok_or_else(|| format!("no row at {x}"))?
                }
            };
            tolerance.check(name, values[row], *expected)
        }
        claim => motion(&[], data, claim),
    }
}

/// A number of a study: `period`, `multipliers.1.abs`.
fn field(results: &Results, path: &str) -> Result<f64, String> {
    let fields = serde_json::Value::Object(results.fields());
    let whole = fields.get(path).cloned();
    let found = whole.or_else(|| {
        path.split('.').try_fold(fields.clone(), |at, key| match key.parse::<usize>() {
            Ok(i) => at.get(i).cloned(),
            Err(_) => at.get(key).cloned(),
        })
    });
    let names = || fields.as_object().map(|o| o.keys().cloned().collect::<Vec<_>>().join(", ")).unwrap_or_default();
    found.and_then(|v| v.as_f64()).ok_or_else(|| format!("no number `{path}`; there are {}", names()))
}

/// Whether a field is this text.
fn says(found: &serde_json::Value, path: &str, text: &str) -> Result<(), String> {
    let found = found.as_str().map_or_else(|| found.to_string(), str::to_owned);
    if found == text { Ok(()) } else { Err(format!("{path} is {found}")) }
}

/// The field at a path: `modes[1].shape.phi`, counted from 1; `length(modes)` is a number of entries.
fn json_field(own: &serde_json::Value, path: &str) -> Result<serde_json::Value, String> {
    if let Some(inner) = path.strip_prefix("length(").and_then(|p| p.strip_suffix(')')) {
        return Ok(json_field(own, inner)?.as_array().map_or(0, Vec::len).into());
    }
    let mut at = own;
    for step in path.split(['.', '[']) {
        let next = match step.strip_suffix(']') {
            Some(index) => index.parse::<usize>().ok().and_then(|i| at.get(i.wrapping_sub(1))),
            None => at.get(step),
        };
        at = next.ok_or_else(|| format!("no field `{path}` (at `{step}`)"))?;
    }
    Ok(at.clone())
}

/// A constant of a phase as the JSON of the study names it; of the first mode when there are several.
fn constant_of(phases: &Phases, number: usize, key: &str) -> Result<f64, String> {
    let phase = phases.list.get(number.wrapping_sub(1)).ok_or_else(|| format!("there are {} phases", phases.list.len()))?;
    match key {
        "start" => return Ok(phase.start),
        "end" => return Ok(phase.end),
        _ => {}
    }
    let (mode, key) = key.split_once('.').map_or((1, key), |(mode, key)| (mode.parse().unwrap_or(1), key));
    let listed = phase.listed();
    let mode = listed.get(mode - 1).ok_or_else(|| format!("there are {} modes", listed.len()))?;
    let named = mode.named();
    let found = named.iter().find(|(name, _)| *name == key).map(|(_, value)| *value);
    found.ok_or_else(|| format!("constants: {}", named.iter().map(|n| n.0).collect::<Vec<_>>().join(", ")))
}

fn case_of(phases: &Phases, number: usize, case: &str) -> Result<(), String> {
    let phase = phases.list.get(number.wrapping_sub(1)).ok_or_else(|| format!("there are {} phases", phases.list.len()))?;
    let listed = phase.listed();
    let name = listed.first().map_or("coupled", |l| if l.constants.resonance { "resonance" } else { l.constants.case.name() });
    if name == case { Ok(()) } else { Err(format!("the case is {name}")) }
}

fn help(diagnostics: &[Notice], code: &str, text: &str) -> Result<(), String> {
    let helps: Vec<&str> = diagnostics.iter().filter(|d| d.code == code).map(|d| d.help.en.as_str()).collect();
    if helps.iter().any(|h| h.contains(text)) { Ok(()) } else { Err(format!("helps: {}", helps.join("; "))) }
}

fn findings(model: &str, diagnostics: &[Notice], code: &str, line: Option<usize>, only: bool) -> Result<(), String> {
    let line_of = |d: &Notice| d.span().map(|s| model[..s.start].matches('\n').count() + 1);
    let found: Vec<String> = diagnostics.iter().map(|d| format!("{} in line {}", d.code, line_of(d).unwrap_or(0))).collect();
    let fits = |d: &Notice| d.code == code && line.is_none_or(|l| line_of(d) == Some(l));
    let holds = diagnostics.iter().any(fits) && (!only || diagnostics.iter().all(fits));
    match &found[..] {
        _ if holds => Ok(()),
        [] => Err("nothing was found".into()),
        list => Err(format!("found {}", list.join(", "))),
    }
}
