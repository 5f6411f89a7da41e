//! `[[claims]]`: published results laid against the machine.
//!
//! Formulas and equations are compared at random states by `analysis::studies::claims`, term by term; values are those of the motion, of the equilibrium
//! or of a mode. What differs is a result about the source, not a failed check of the run.

// a machine is laid out once: what it says when that fails may be large
#![allow(clippy::result_large_err)]

mod laid;
mod show;
mod spectrum;
mod terms;
mod values;
mod verdict;

use show::{Verdicts, to_json};

pub use verdict::Verdict;

use crate::machine::Machine;
use crate::provenance;
use crate::results::Body;
use crate::watch::Watch;
use crate::{Conclusion, Results, Rows};
use analysis::{Dataset, Fault, Quantity, dataset::Column};
use mechanics::model::ClaimKind;
use std::sync::Arc;
use words::Text;

/// What results of claims call themselves: they are no study of the table, since a file does not ask for them by `[[study]]`.
pub const KIND: &str = "claims";
/// The chapter of the written calculation that tells them.
pub const CHAPTER: &str = "verification";

/// What they allow to say at the end of a calculation.
pub fn concludes(results: &Results) -> Vec<Conclusion> {
    let verdicts = results.own.get(KIND).and_then(serde_json::Value::as_array).map(Vec::as_slice).unwrap_or_default();
    let refuted = verdicts.iter().filter(|v| v.get("ok").and_then(serde_json::Value::as_bool) != Some(true)).count();
    vec![Conclusion::Published { all: verdicts.len(), refuted }]
}

/// Lays every claim of the file against the machine; none when the file has none.
pub fn run(machine: &mut Machine, watch: &mut Watch) -> Option<Results> {
    if machine.model.claims.is_empty() {
        return None;
    }
    let claims = machine.model.claims.clone();
    let mut results = Results {
        kind: KIND, heading: Text::new("Published results", "Опубликованные результаты"), ..Results::default()
    };
    let mut verdicts: Vec<Verdict> = claims.iter().map(unjudged).collect();
    match laid::lay(machine) {
        Ok(mut laid) => {
            let refused: Vec<Option<Fault>> = (0..claims.len()).map(|i| laid.refusal(i)).collect();
            for (verdict, fault) in verdicts.iter_mut().zip(&refused) {
                fault.iter().for_each(|fault| verdict.words = coded(fault));
            }
            let judged: Vec<usize> = (0..claims.len()).filter(|i| refused[*i].is_none()).collect();
            let compared = |i: &usize| matches!(claims[*i].kind, ClaimKind::Equation { .. } | ClaimKind::Formula { .. });
            let rows = if judged.iter().any(compared) { terms::drawn(&mut laid) } else { Ok(Vec::new()) };
            for &i in &judged {
                let claim = &claims[i];
                match &claim.kind {
                    ClaimKind::Equation { .. } | ClaimKind::Formula { .. } => match &rows {
                        Ok(rows) => terms::judge(&mut laid, (i, claim), rows, &mut verdicts[i]),
                        Err(words) => verdicts[i].words = words.clone(),
                    },
                    ClaimKind::Frequency { mode, published } => {
                        values::frequency(machine, (*mode, *published), &mut verdicts[i], watch);
                    }
                    ClaimKind::FrequencyEquation { .. } => spectrum::judge(machine, claim, &mut verdicts[i], watch),
                    ClaimKind::Value { .. } => {}
                }
            }
            values::judge(machine, &mut laid, (&claims, &judged, &mut verdicts), watch);
        }
        Err(trouble) => results.trouble = Some(trouble),
    }
    for (claim, verdict) in claims.iter().zip(&mut verdicts) {
        verdict.ok &= claim.dimensions.en.is_empty();
        if !claim.dimensions.en.is_empty() {
            verdict.words = joined(&claim.dimensions, &verdict.words);
        }
    }
    let data = Dataset { columns: columns(&verdicts), ..Dataset::default() };
    results.data = provenance::stamp(data, &machine.equations, &machine.model_hash);
    results.rows = Rows::Hidden;
    results.own.insert(KIND.into(), to_json(&verdicts));
    results.words = verdicts.iter().filter(|v| !v.words.en.is_empty()).map(remark).collect();
    results.body = Body::Own(Arc::new(Verdicts(verdicts)));
    Some(results)
}

fn coded(fault: &Fault) -> Text {
    Text::new(format!("{} [{}]", fault.what.en, fault.code), format!("{} [{}]", fault.what.ru, fault.code))
}

fn remark(verdict: &Verdict) -> Text {
    let of = |name: &str, words: &str| format!("{name}: {words}.");
    Text::new(of(&verdict.name.en, &verdict.words.en), of(&verdict.name.ru, &verdict.words.ru))
}

fn unjudged(claim: &mechanics::model::ClaimDecl) -> Verdict {
    let (name, source, unit) = (claim.name.clone(), claim.source.clone(), claim.unit.clone());
    Verdict { name, source, unit, value: f64::NAN, published: f64::NAN, deviation: f64::NAN, ..Verdict::default() }
}

fn joined(first: &Text, second: &Text) -> Text {
    let both = |a: &str, b: &str| if b.is_empty() { a.to_owned() } else { format!("{a}; {b}") };
    Text::new(both(&first.en, &second.en), both(&first.ru, &second.ru))
}

/// Numbers for CSV, a row a claim.
fn columns(verdicts: &[Verdict]) -> Vec<Column> {
    let column = |name: &str, value: &dyn Fn(&Verdict) -> f64| Column {
        quantity: Quantity::new(name, "1"),
        values: verdicts.iter().map(value).collect(),
    };
    vec![
        column("value", &|v| v.value),
        column("published", &|v| v.published),
        column("deviation", &|v| v.deviation),
        column("ok", &|v| f64::from(u8::from(v.ok))),
    ]
}
