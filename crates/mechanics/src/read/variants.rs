//! `[variants]`: a table of values, one row a variant. The table itself may be another file, which the command line reads.

use crate::fields;
use crate::formula::EntryKind;
use crate::model::{VariantTable, Variants};
use crate::reader::names::names;
use crate::reader::{Fields, Reader, short};
use std::ops::Range;
use words::Notice;

pub(super) fn read<'a>(reader: &mut Reader<'a>, top: &Fields<'a>) -> Option<Variants> {
    let value = top.get("variants")?;
    let Some(table) = value.get_ref().as_table() else {
        let fault = crate::reader::wrong_type(value.span(), "a table", "таблица", value.get_ref().type_str());
        reader.fault(fault.help("write [variants] and table = \"variants.csv\"", "напишите [variants] и table = \"variants.csv\""));
        return None;
    };
    let span = value.span();
    let fields = Fields::open(reader, &fields::VARIANTS, table, span.clone(), "variants".to_owned());
    let (file, inside) = (fields.name(reader, "table"), fields.name(reader, "rows"));
    let table = match (file, inside) {
        (Some((file, _)), None) => VariantTable::File(file),
        (None, Some((text, _))) => VariantTable::Text(text),
        _ => {
            let (en, ru) = ("[variants] needs either `table` or `rows`", "в [variants] нужно либо `table`, либо `rows`");
            reader.fault(Notice::piece("M089", span, en, ru).help("write table = \"variants.csv\"", "напишите table = \"variants.csv\""));
            return None;
        }
    };
    let key = fields.name(reader, "key").map(|(name, _)| name.trim().to_owned());
    let columns = fields.get("columns").map(|v| names(reader, v));
    let columns = columns.map(|list| list.into_iter().filter_map(|(name, span)| known(reader, name, span)).collect());
    let number = fields.name(reader, "number").and_then(|(name, span)| parameter(reader, name, span));
    Some(Variants { table, key, columns, number, span })
}

/// A parameter, a coordinate (its start), or a coordinate with a prime (its rate).
fn known(reader: &mut Reader, name: String, span: Range<usize>) -> Option<String> {
    let name = name.trim().to_owned();
    let base = name.strip_suffix('\'').unwrap_or(&name);
    let fits = match reader.scope.get(base).map(|e| e.kind) {
        Some(EntryKind::Coordinate(_)) => true,
        Some(EntryKind::Parameter(_)) => base == name,
        _ => false,
    };
    if !fits {
        let fault = unknown(reader, &name, span);
        reader.fault(fault);
    }
    fits.then_some(name)
}

fn parameter(reader: &mut Reader, name: String, span: Range<usize>) -> Option<String> {
    let name = name.trim().to_owned();
    if matches!(reader.scope.get(&name).map(|e| e.kind), Some(EntryKind::Parameter(_))) {
        return Some(name);
    }
    let fault = unknown(reader, &name, span);
    reader.fault(fault);
    None
}

fn unknown(reader: &Reader, name: &str, span: Range<usize>) -> Notice {
    let shown = short(name);
    let (en, ru) = (format!("no parameter or coordinate is called `{shown}`"), format!("нет параметра или координаты `{shown}`"));
    let fault = Notice::piece("M089", span, en, ru);
    match reader.scope.nearest(name, reader.scope.names()) {
        Some(near) => fault.meant(name, near),
        None => fault,
    }
}
