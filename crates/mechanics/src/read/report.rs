//! `[report]`.

use crate::fields;
use crate::model::{Depth, Front, Report};
use crate::reader::names::names;
use crate::reader::{Fields, Reader, short, wrong_type};
use std::ops::Range;
use words::Notice;

/// Depths as the file names them.
const DEPTHS: [&str; 2] = ["full", "short"];

pub(super) fn read<'a>(reader: &mut Reader<'a>, top: &Fields<'a>) -> Report {
    let Some(value) = top.get("report") else { return Report::default() };
    let Some(table) = value.get_ref().as_table() else {
        reader.fault(wrong_type(value.span(), "a table", "таблица", value.get_ref().type_str()));
        return Report::default();
    };
    let fields = Fields::open(reader, &fields::REPORT, table, value.span(), "report".to_owned());
    let parts = fields.get("sections").map(|value| names(reader, value));
    let parts = parts.map(|list| list.into_iter().filter_map(|word| known(reader, word, &fields::PARTS)).collect());
    let depth = fields.name(reader, "depth").and_then(|word| known(reader, word, &DEPTHS));
    let depth = if depth.as_deref() == Some("short") { Depth::Short } else { Depth::Full };
    Report { front: front(reader, &fields), parts, depth }
}

fn front<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>) -> Option<Front> {
    let mut text = |key| fields.text(reader, key).unwrap_or_default();
    let front = Front {
        organisation: text("organisation"),
        department: text("department"),
        kind: text("kind"),
        discipline: text("discipline"),
        student: text("student"),
        group: text("group"),
        teacher: text("teacher"),
        city: text("city"),
        year: fields.name(reader, "year").map(|(year, _)| year).unwrap_or_default(),
    };
    (front != Front::default()).then_some(front)
}

/// One of the words that are allowed (M364).
fn known(reader: &mut Reader, (word, span): (String, Range<usize>), allowed: &[&str]) -> Option<String> {
    let word = word.trim().to_owned();
    if allowed.contains(&word.as_str()) {
        return Some(word);
    }
    let shown = short(&word);
    let (en, ru) = (format!("the written calculation knows no `{shown}`"), format!("в записанном расчёте нет `{shown}`"));
    let list = allowed.join(", ");
    let fault = Notice::piece("M364", span, en, ru).help(format!("one of: {list}"), format!("одно из слов: {list}"));
    let near = words::nearest(&word, allowed.iter().copied());
    reader.fault(match near {
        Some(near) => fault.meant(&word, near),
        None => fault,
    });
    None
}
