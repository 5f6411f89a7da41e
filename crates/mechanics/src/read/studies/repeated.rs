//! What a study is repeated over, and which study that is.

use crate::asked::Kinds;
use crate::formula::{EntryKind, Formula, Kind};
use crate::model::SweepRange;
use crate::read::parameters::without_unit;
use crate::read::ranges;
use crate::reader::syntax::Value;
use crate::reader::{Fields, Reader, short, string};
use crate::units::Dimension;
use std::ops::Range;
use words::Notice;

/// The name of a kind of study that may be repeated.
pub(super) fn kind<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>, (key, kinds): (&'static str, &Kinds)) -> Option<String> {
    let (kind, span) = fields.name(reader, key)?;
    if kinds.repeated.contains(&kind.as_str()) {
        return Some(kind);
    }
    let shown = short(&kind);
    let fault = Notice::piece("M064", span, format!("no study `{shown}` can be repeated"), format!("расчёт `{shown}` повторять нельзя"));
    let list = kinds.repeated.join(", ");
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
    read(reader, value, ranges::parse)
}

/// A parameter, a start or a starting rate between two values.
pub(super) fn stretch<'a>(reader: &mut Reader<'a>, value: &'a Value<'a>) -> Option<SweepRange> {
    string(reader, value, "a string such as \"m=2 g..60 g\"", "строка вида \"m=2 г..60 г\"")?;
    read(reader, value, ranges::stretch)
}

fn read<'a>(reader: &mut Reader<'a>, value: &'a Value<'a>, parse: fn(&str) -> Result<ranges::Range, Notice>) -> Option<SweepRange> {
    let snippet = reader.snippet(value)?;
    let range = match parse(&snippet.text) {
        Ok(range) => range,
        Err(fault) => {
            reader.report(snippet.diagnose(fault));
            return None;
        }
    };
    let Some(wanted) = given(reader, &range.name) else {
        let base = range.name.trim_end_matches('\'');
        let fault = ranges::unknown_name(&range.name, range.named.clone(), reader.scope.nearest(base, reader.scope.names()));
        reader.report(snippet.diagnose(fault));
        return None;
    };
    if let Err(fault) =
        range.fits(&known(wanted).unwrap_or(range.dimensions.first().copied().unwrap_or(Dimension::NONE)), reader.scaled.get(&range.name))
    {
        reader.report(snippet.diagnose(fault));
        return None;
    }
    Some(SweepRange { name: range.name, values: range.values })
}

/// The kind of a parameter, of the start of a coordinate or of that of its rate: what may be given another value.
fn given(reader: &Reader<'_>, name: &str) -> Option<Kind> {
    let base = name.trim_end_matches('\'');
    let primes = name.len() - base.len();
    match reader.scope.get(base).map(|e| (e.kind, e.dimension)) {
        Some((EntryKind::Parameter(_), kind)) if primes == 0 => Some(kind),
        Some((EntryKind::Coordinate(_), Kind::Known(d))) if primes <= 1 => Some(Kind::Known(if primes == 1 { d.per_time(1) } else { d })),
        Some((EntryKind::Coordinate(_), kind)) if primes <= 1 => Some(kind),
        _ => None,
    }
}

/// The dimension of what may be given another value.
pub(super) fn dimension(reader: &Reader<'_>, name: &str) -> Option<Dimension> {
    given(reader, name).and_then(known)
}

/// Whether a name is that of something that may be given another value.
pub(super) fn changed(reader: &mut Reader<'_>, name: &str, span: Range<usize>) -> Option<()> {
    if given(reader, name).is_none() {
        let near = reader.scope.nearest(name.trim_end_matches('\''), reader.scope.names());
        let fault = ranges::unknown_name(name, span, near);
        reader.fault(fault);
        return None;
    }
    Some(())
}

/// Whether all values have a unit where the file uses another one than that of SI.
pub(super) fn with_units<'a>(reader: &mut Reader<'a>, value: &'a Value<'a>, name: &str) -> bool {
    let Some(unit) = reader.scaled.get(name).cloned() else { return true };
    for item in value.get_ref().as_array().into_iter().flatten() {
        let Some(raw) = reader.raw(item) else { return false };
        if raw.formula.as_ref().is_some_and(Formula::is_bare_number) {
            let finding = raw.snippet.diagnose(without_unit(raw.snippet.all(), (name, &unit), &raw.snippet.text));
            reader.report(finding);
            return false;
        }
    }
    true
}

fn known(kind: Kind) -> Option<Dimension> {
    match kind {
        Kind::Known(d) => Some(d),
        _ => None,
    }
}
