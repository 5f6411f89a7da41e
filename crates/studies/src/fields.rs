//! The fields of JSON that are not common to all studies.

use crate::pipeline::Finding;
use analysis::Dataset;
use analysis::dataset::Column;
use serde_json::{Map, Value, json};
use words::{Language, Notice};

/// The fields of a study that are not common to all.
pub fn own_fields(finding: &Finding) -> Map<String, Value> {
    let mut own = Map::new();
    match finding {
        Finding::Motion(study, ..) => {
            own.insert("study".into(), json!("simulate"));
            own.insert("until".into(), json!(study.until));
            own.insert("tolerance".into(), json!(study.tolerance));
            own.insert("method".into(), json!(study.method.name()));
        }
        Finding::Transient(study, _, phases, _) => {
            own.insert("study".into(), json!("transient"));
            own.insert("until".into(), json!(study.until));
            own.insert("phases".into(), crate::phases::to_json(phases));
        }
        Finding::Equilibrium(..) => {
            own.insert("study".into(), json!("equilibrium"));
            own.insert("equilibria".into(), equilibria(finding.data()));
        }
        Finding::Study(results) => own = results.fields(),
        Finding::Response(found) => own = crate::small::response::to_json(found),
        Finding::Modes(found) => own = crate::small::modes::to_json(found),
        Finding::Structure(found) => own = crate::structure::fields(found),
    }
    if let Some(trouble) = finding.trouble() {
        own.insert("fault".into(), trouble_to_json(trouble, Language::En));
    }
    own
}

/// `{coordinates: {phi: 0.1}, stable: true, residual: 1e-16, outputs: {N: 3}}` for each; `stable` is null where linearisation does not decide.
fn equilibria(data: &Dataset) -> Value {
    let n = data.columns.first().map_or(0, |c| c.values.len());
    // what is not there is null
    let at = |name: &str, row: usize| data.column(name).map_or(f64::NAN, |c| c.values[row]);
    // coordinates and reactions come first, then the residual, then what follows from them
    let first = data.columns.iter().position(|c| c.quantity.name == "residual").unwrap_or(data.columns.len());
    let listed = |columns: &[Column], row: usize| -> Map<String, Value> {
        let own = columns.iter().filter(|c| !is_verdict(&c.quantity.name) && !is_reaction(&c.quantity.name));
        own.map(|c| (c.quantity.name.clone(), json!(c.values[row]))).collect()
    };
    let place = |row: usize| {
        let coordinates = listed(&data.columns[..first], row);
        let stable = at("stable", row);
        let stable = if stable.is_nan() { Value::Null } else { json!(stable != 0.0) };
        let mut out = json!({"coordinates": coordinates, "stable": stable, "residual": at("residual", row)});
        let outputs = listed(&data.columns[first..], row);
        if !outputs.is_empty() {
            out["outputs"] = json!(outputs);
        }
        let reactions = data.columns[..first].iter().filter(|c| is_reaction(&c.quantity.name));
        let reactions: Map<String, Value> = reactions.map(|c| (c.quantity.name.clone(), json!(c.values[row]))).collect();
        if !reactions.is_empty() {
            out["reactions"] = json!(reactions);
        }
        if data.column("growth").is_some() {
            let (growth, negative) = (at("growth", row), at("negative_directions", row));
            out["growth"] = json!(growth);
            out["negative_directions"] = json!(negative);
            out["stable_by_energy"] = if negative.is_nan() { Value::Null } else { json!(negative == 0.0) };
            out["stable_by_eigenvalues"] = if growth.is_nan() { Value::Null } else { json!(growth <= 1e-9) };
        }
        out
    };
    (0..n).map(place).collect()
}

/// Columns of an equilibrium that are reactions: `force(AB)`.
fn is_reaction(name: &str) -> bool {
    name.contains('(')
}

/// Columns of an equilibrium that are no coordinates.
pub fn is_verdict(name: &str) -> bool {
    matches!(name, "residual" | "stable" | "growth" | "negative_directions")
}

/// A trouble as JSON.
pub fn trouble_to_json(trouble: &Notice, language: Language) -> Value {
    json!({"code": trouble.code, "severity": "error", "what": language.text(&trouble.what), "why": language.text(&trouble.why),
        "help": language.text(&trouble.help)})
}
