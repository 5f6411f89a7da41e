//! The study `equilibrium`.

use crate::fault::Fault;
use crate::formula::{Context, EntryKind, Kind};
use crate::model::StudyKind;
use crate::read::reader::{Fields, Reader};
use symbolic::SymbolId;

pub(super) fn read<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>) -> Option<StudyKind> {
    Some(StudyKind::Equilibrium { guess: guess(reader, fields) })
}

pub(super) fn guess<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>) -> Vec<(SymbolId, f64)> {
    let mut found = Vec::new();
    for (name, span, value) in fields.rows(reader, "guess") {
        let entry = reader.scope.get(name).map(|e| (e.kind, e.dimension));
        let Some((EntryKind::Coordinate(symbols), kind)) = entry else {
            let fault = Fault::new(
                "M013",
                span,
                format!("`{}` is not a coordinate", crate::read::reader::short(name)),
                format!("`{}` — не координата", crate::read::reader::short(name)),
            );
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
