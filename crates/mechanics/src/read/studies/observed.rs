//! What is observed of a study that is repeated: numbers of results. A formula of the motion among them becomes a result of the machine.

use crate::asked::observed::{Observed, observed};
use crate::formula::{Context, EntryKind, Kind, is_identifier};
use crate::model::ObservedDecl;
use crate::reader::syntax::Value;
use crate::reader::{Reader, string};
use crate::snippet::Snippet;
use crate::units::{Dimension, si_label};

/// The texts, or one; all of them are read.
pub(super) fn read<'a>(reader: &mut Reader<'a>, value: &'a Value<'a>) -> Vec<String> {
    let items: Vec<&'a Value<'a>> = match value.get_ref().as_array() {
        Some(items) => items.iter().collect(),
        None => vec![value],
    };
    items.into_iter().filter_map(|item| one(reader, item)).collect()
}

fn one<'a>(reader: &mut Reader<'a>, value: &'a Value<'a>) -> Option<String> {
    let (text, _) = string(reader, value, "a name or a number of a result", "имя или число результата")?;
    let snippet = reader.snippet(value)?;
    note(reader, &snippet)?;
    Some(text.trim().to_owned())
}

/// Makes a result of the formula in it, if there is one.
pub(in crate::read) fn note<'a>(reader: &mut Reader<'a>, snippet: &Snippet<'a>) -> Option<Observed> {
    let found = match observed(&snippet.text) {
        Ok(found) => found,
        Err(fault) => {
            reader.report(snippet.diagnose(fault));
            return None;
        }
    };
    if found.word.is_none() || is_result(reader, &found.of) {
        return Some(found);
    }
    let raw = reader.raw_text(snippet.part(found.span.clone()));
    let checked = reader.value(&raw, &Context::OUTPUT, None);
    if !checked.good {
        return None;
    }
    let dimension = if let Kind::Known(dimension) = checked.kind { Some(dimension) } else { None };
    let symbol = reader.builder.graph.symbol_id(&format!("observed({})", found.of), 0);
    let span = raw.snippet.place().unwrap_or(0..0);
    let unit = si_label(&dimension.unwrap_or(Dimension::NONE));
    reader.observed.push(ObservedDecl { name: found.of.clone(), symbol, formula: checked.expr, unit, dimension, span });
    Some(found)
}

/// Whether a study may give this as a result without a formula: a result of the file, a coordinate or its rate, or a name that only a study knows.
fn is_result(reader: &Reader<'_>, of: &str) -> bool {
    let base = of.trim_end_matches('\'');
    let primes = of.len() - base.len();
    let plain = is_identifier(base);
    match reader.scope.get(base).map(|e| e.kind) {
        _ if reader.results.contains(of) || reader.observed.iter().any(|o| o.name == of) => true,
        Some(EntryKind::Coordinate(_)) => primes <= 1,
        Some(EntryKind::Parameter(_) | EntryKind::Output(_)) => false,
        None => plain && base != "t",
    }
}

/// The dimension of what is observed, as far as the machine decides it.
pub(in crate::read) fn dimension(reader: &Reader<'_>, text: &str) -> Option<Dimension> {
    let found = observed(text).ok()?;
    found.word?;
    let base = found.of.trim_end_matches('\'');
    let primes = found.of.len() - base.len();
    if let Some(formula) = reader.observed.iter().find(|o| o.name == found.of) {
        return formula.dimension;
    }
    let entry = reader.scope.get(base)?;
    let Kind::Known(dimension) = entry.dimension else { return None };
    match entry.kind {
        EntryKind::Coordinate(_) if primes == 1 => Some(dimension.per_time(1)),
        // a result may bear the name of a parameter and be something else
        EntryKind::Parameter(_) => None,
        _ => (primes == 0).then_some(dimension),
    }
}
