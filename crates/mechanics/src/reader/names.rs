//! Names of bodies and lists of names under a key.

use super::fields::Fields;
use super::state::Reader;
use super::syntax::Value;
use super::values::string;
use super::wording::wrong_type;
use crate::formula::Place;
use crate::model::FrameId;
use std::ops::Range;
use toml::de::DeValue;
use words::Notice;

/// A frame or body named under a key; ground without it and after a fault.
pub(crate) fn frame_named<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>, key: &'static str) -> FrameId {
    fields.name(reader, key).and_then(|(name, span)| frame_by_name(reader, &name, span)).unwrap_or(FrameId::GROUND)
}

/// The frame of that name, or a finding.
pub(crate) fn frame_by_name(reader: &mut Reader, name: &str, span: Range<usize>) -> Option<FrameId> {
    match reader.scope.place(name) {
        Some(Place::Frame(f)) => Some(f),
        Some(Place::Point(_)) => {
            reader.fault(Notice::piece(
                "M014",
                span,
                format!("`{name}` is a point; a frame or body is needed here"),
                format!("`{name}` — точка, а здесь нужно тело или система отсчёта"),
            ));
            None
        }
        None => {
            let fault = reader.scope.unknown_place(name, span);
            reader.fault(fault);
            None
        }
    }
}

/// Two names under a key.
pub(crate) fn two_names<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>, key: &'static str) -> Option<[(String, Range<usize>); 2]> {
    let value = fields.get(key)?;
    let found = names(reader, value);
    let count = found.len();
    match <[_; 2]>::try_from(found) {
        Ok(pair) => Some(pair),
        Err(_) => {
            if value.get_ref().as_array().is_some_and(|a| a.len() == count) {
                reader.fault(Notice::piece(
                    "M008",
                    value.span(),
                    format!("two names are needed, {count} given"),
                    format!("нужны два имени, дано: {count}"),
                ));
            }
            None
        }
    }
}

/// A string list; findings for anything else in it.
pub(crate) fn names<'a>(reader: &mut Reader<'a>, value: &'a Value<'a>) -> Vec<(String, Range<usize>)> {
    match value.get_ref() {
        DeValue::Array(items) => items.iter().filter_map(|v| string(reader, v, "a name in quotes", "имя в кавычках")).collect(),
        other => {
            reader.fault(wrong_type(value.span(), "an array of names", "массив имён", other.type_str()));
            Vec::new()
        }
    }
}
