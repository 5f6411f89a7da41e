//! The study `equilibrium`.

use crate::formula::{Context, EntryKind, Kind};
use crate::model::{Between, StudyKind};
use crate::read::reader::{Fields, Reader};
use symbolic::SymbolId;
use words::Notice;

pub(super) fn read<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>) -> Option<StudyKind> {
    let over = between(reader, fields);
    Some(StudyKind::Equilibrium { guess: guess(reader, fields), over })
}

/// `over` and `range`.
fn between<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>) -> Option<Between> {
    let (name, span) = fields.name(reader, "over")?;
    let Some((EntryKind::Coordinate(symbols), kind)) = reader.scope.get(&name).map(|e| (e.kind, e.dimension)) else {
        let fault = super::no_coordinate(reader, &name, span);
        reader.fault(fault);
        return None;
    };
    let wanted = if let Kind::Known(d) = kind { Some(d) } else { None };
    let Some(value) = fields.get("range") else {
        reader.fault(
            Notice::piece("M006", span, "`over` needs `range`", "к `over` нужен `range`")
                .help("add range = [\"-180 deg\", \"180 deg\"]", "добавьте range = [\"-180 deg\", \"180 deg\"]"),
        );
        return None;
    };
    let [from, to] = super::linear::range(reader, value, wanted.as_ref())?;
    if to <= from {
        reader.fault(super::linear::bad_range(value.span(), from, to));
        return None;
    }
    Some(Between { coordinate: symbols[0], from, to })
}

pub(super) fn guess<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>) -> Vec<(SymbolId, f64)> {
    let mut found = Vec::new();
    for (name, span, value) in fields.rows(reader, "guess") {
        let entry = reader.scope.get(name).map(|e| (e.kind, e.dimension));
        let Some((EntryKind::Coordinate(symbols), kind)) = entry else {
            let fault = super::no_coordinate(reader, name, span);
            reader.fault(fault);
            continue;
        };
        let wanted = match kind {
            Kind::Known(d) => Some(d),
            _ => None,
        };
        if let Some(raw) = reader.raw(value) {
            let guess = reader.value(&raw, &Context::CONSTANT, wanted.as_ref());
            found.extend(reader.number(&guess).map(|v| (symbols[0], v)));
        }
    }
    found
}
