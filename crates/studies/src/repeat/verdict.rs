//! Whether what a repeated study found is stable.

use crate::Results;
use serde_json::Value;

/// What makes small disturbances grow, by the frequency at which its tongue opens; none where nothing grows, or it has no name.
pub(super) fn resonance(results: &Results) -> Option<String> {
    results.own.get("resonance")?.get("name")?.as_str().map(str::to_owned)
}

/// The verdict of a regime (`stable`), of small disturbances (`verdict`), or of the only place of rest; none where the study gives none, or cannot decide.
pub(super) fn verdict(results: &Results) -> Option<bool> {
    match (results.own.get("stable"), results.own.get("verdict").and_then(Value::as_str)) {
        (Some(Value::Bool(stable)), _) => Some(*stable),
        (_, Some("stable")) => Some(true),
        (_, Some("unstable")) => Some(false),
        _ => match results.data.column("stable").map(|column| column.values.as_slice()) {
            Some([only]) if only.is_finite() => Some(*only != 0.0),
            _ => None,
        },
    }
}

/// Whether it is a regime of a family, and not the one from the given start.
pub(super) fn is_other(results: &Results) -> bool {
    let says = |key: &str| results.own.get(key).and_then(Value::as_bool);
    says("one_of_a_family") == Some(true) && says("from_start") == Some(false)
}
