//! What a study is repeated over, and which study that is.

use crate::asked::Kinds;
use crate::formula::{EntryKind, Kind};
use crate::model::SweepRange;
use crate::read::ranges;
use crate::reader::names::names;
use crate::reader::syntax::Value;
use crate::reader::{Fields, Reader, short, string};
use crate::units::Dimension;
use words::Notice;

/// Names, or one.
pub(super) fn one_or_many<'a>(reader: &mut Reader<'a>, value: &'a Value<'a>) -> Vec<String> {
    if value.get_ref().as_str().is_some() {
        return string(reader, value, "a name", "имя").map(|(name, _)| vec![name]).unwrap_or_default();
    }
    names(reader, value).into_iter().map(|(name, _)| name).collect()
}

/// The name of a kind of study that may be repeated.
pub(super) fn kind<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>, (key, kinds): (&'static str, &Kinds)) -> Option<String> {
    let (kind, span) = fields.name(reader, key)?;
    let list: Vec<&str> = kinds.list.iter().filter(|kind| kind.repeatable).map(|kind| kind.name).collect();
    if list.contains(&kind.as_str()) {
        return Some(kind);
    }
    let shown = short(&kind);
    let fault = Notice::piece("M064", span, format!("no study `{shown}` can be repeated"), format!("расчёт `{shown}` повторять нельзя"));
    let list = list.join(", ");
    reader.fault(fault.help(format!("studies to repeat: {list}"), format!("повторять можно: {list}")));
    None
}

/// Values of parameters, starts and starting rates.
pub(super) fn ranges<'a>(reader: &mut Reader<'a>, value: &'a Value<'a>) -> Vec<SweepRange> {
    match value.get_ref().as_array() {
        Some(items) => items.iter().filter_map(|item| range(reader, item)).collect(),
        None => range(reader, value).into_iter().collect(),
    }
}

fn range<'a>(reader: &mut Reader<'a>, value: &'a Value<'a>) -> Option<SweepRange> {
    string(reader, value, "a string such as \"v=linspace(1 m/s, 3 m/s, 21)\"", "строка вида \"v=linspace(1 м/с, 3 м/с, 21)\"")?;
    let snippet = reader.snippet(value)?;
    let range = match ranges::parse(&snippet.text) {
        Ok(range) => range,
        Err(fault) => {
            reader.report(snippet.diagnose(fault));
            return None;
        }
    };
    let base = range.name.trim_end_matches('\'');
    let primes = range.name.len() - base.len();
    let wanted = match reader.scope.get(base).map(|e| (e.kind, e.dimension)) {
        Some((EntryKind::Parameter(_), kind)) if primes == 0 => kind,
        Some((EntryKind::Coordinate(_), Kind::Known(d))) if primes <= 1 => Kind::Known(if primes == 1 { d.per_time(1) } else { d }),
        Some((EntryKind::Coordinate(_), kind)) if primes <= 1 => kind,
        _ => {
            let fault = ranges::unknown_name(&range, reader.scope.nearest(base, reader.scope.names()));
            reader.report(snippet.diagnose(fault));
            return None;
        }
    };
    if let Err(fault) = range.fits(&known(wanted).unwrap_or(range.dimension.unwrap_or(Dimension::NONE)), reader.scaled.get(&range.name)) {
        reader.report(snippet.diagnose(fault));
        return None;
    }
    Some(SweepRange { name: range.name, values: range.values })
}

fn known(kind: Kind) -> Option<Dimension> {
    match kind {
        Kind::Known(d) => Some(d),
        _ => None,
    }
}
