//! Values set on the command line: `--set name=quantity`.
//!
//! A name is a parameter (its value is replaced, also when it was a formula), a coordinate (its start), or a coordinate with a prime
//! (its rate). Bare numbers are SI, and refused where the file uses another unit.

use super::phases::{self, Schedule};
use super::raw::{RawCoordinate, RawParameter};
use crate::reader::Reader;
use std::collections::HashSet;
use words::{Notice, Place};

/// Splits `name=quantity`; `index` is its number on the command line.
///
/// # Errors
/// When there is no `=` or no name.
pub fn split(text: &str, index: usize) -> Result<(String, String), Box<Notice>> {
    match text.split_once('=') {
        Some((name, value)) if !name.trim().is_empty() => Ok((name.trim().to_owned(), value.to_owned())),
        _ => Err(Box::new(Notice {
            place: Place::Override { index, text: text.to_owned(), span: 0..text.len() },
            ..Notice::new("M068", "expected name=quantity", "ожидается имя=величина")
                .help("for example --set m=30g", "например --set m=30г")
        })),
    }
}

/// Reports overrides of names that are no parameter, coordinate or rate.
pub(super) fn check_names(reader: &mut Reader, coordinates: &[RawCoordinate], parameters: &[RawParameter], schedule: &Schedule) {
    if reader.overrides.is_empty() {
        return;
    }
    let mut known: Vec<String> = parameters.iter().map(|p| p.name.clone()).collect();
    known.extend((!schedule.is_empty()).then(|| phases::READING.to_owned()));
    known.extend(coordinates.iter().flat_map(|c| [c.name.clone(), format!("{}'", c.name)]));
    let set: HashSet<&str> = known.iter().map(String::as_str).collect();
    let mut findings = Vec::new();
    for (name, snippet) in &reader.overrides {
        if set.contains(name.trim()) {
            continue;
        }
        let span = 0..name.len();
        let fault = Notice::piece(
            "M068",
            span.clone(),
            format!("the model has no parameter or coordinate `{}`", name.trim()),
            format!("в модели нет параметра или координаты `{}`", name.trim()),
        );
        let fault = match reader.scope.nearest(name.trim(), known.iter().map(String::as_str)) {
            Some(near) => fault.meant(name.trim(), near),
            None => fault.help(
                "a name is a parameter, a coordinate for its start, or phi' for a rate",
                "имя — это параметр, координата (её начальное значение) или phi' (начальная скорость)",
            ),
        };
        let mut diagnostic = snippet.diagnose(fault);
        if let Place::Override { span: place, .. } = &mut diagnostic.place {
            *place = span;
        }
        findings.push(diagnostic);
    }
    for finding in findings {
        reader.report(finding);
    }
}
