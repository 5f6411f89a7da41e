//! `plot = [...]` of a study.

use super::names::known;
use crate::fields;
use crate::model::Plot;
use crate::reader::names::names;
use crate::reader::syntax::Value;
use crate::reader::{Fields, Reader, string, wrong_type};
use std::ops::Range;
use toml::de::DeValue;
use words::Text;

/// What the horizontal axis is when nothing is said, and which names may be drawn.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Axis {
    /// Time; names are results of a motion.
    Time,
    /// What the study goes over; it may have results of its own, which only the study knows.
    Over,
}

/// Plots of a study.
pub(super) fn plots<'a>(reader: &mut Reader<'a>, value: &'a Value<'a>, axis: Axis) -> Vec<Plot> {
    let Some(items) = value.get_ref().as_array() else {
        reader.fault(
            wrong_type(value.span(), "an array of plots", "массив графиков", value.get_ref().type_str())
                .help("write plot = [\"phi'\"]", "напишите plot = [\"phi'\"]"),
        );
        return Vec::new();
    };
    items.iter().filter_map(|item| plot(reader, item, axis)).collect()
}

fn plot<'a>(reader: &mut Reader<'a>, item: &'a Value<'a>, axis: Axis) -> Option<Plot> {
    let mut result = Plot { title: Text::default(), x: None, y: Vec::new() };
    let mut wanted = Vec::new();
    match item.get_ref() {
        DeValue::String(name) => wanted.push((name.as_ref().to_owned(), item.span())),
        DeValue::Array(_) => wanted = names(reader, item),
        DeValue::Table(table) => {
            let fields = Fields::open(reader, &fields::PLOT, table, item.span(), "plot".to_owned());
            result.title = fields.text(reader, "title").unwrap_or_default();
            let x = fields.name(reader, "x").filter(|(name, _)| name != "t");
            result.x = x.and_then(|(name, span)| drawn(reader, axis, name, span));
            wanted = match fields.get("y") {
                Some(v) if v.get_ref().as_str().is_some() => string(reader, v, "a name", "имя").into_iter().collect(),
                Some(v) => names(reader, v),
                None => Vec::new(),
            };
        }
        other => {
            reader.fault(wrong_type(
                item.span(),
                "a name, an array of names or { x, y, title }",
                "имя, массив имён или { x, y, title }",
                other.type_str(),
            ));
            return None;
        }
    }
    result.y = wanted.into_iter().filter_map(|(name, span)| drawn(reader, axis, name, span)).collect();
    (!result.y.is_empty()).then_some(result)
}

fn drawn(reader: &mut Reader, axis: Axis, name: String, span: Range<usize>) -> Option<String> {
    match axis {
        Axis::Time => known(reader, name, span),
        Axis::Over => Some(name),
    }
}
