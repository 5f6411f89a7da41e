//! `[[answers]]`: items that a student answers.

use super::cover::{Cover, constant, parameter};
use crate::fields;
use crate::formula::{EntryKind, Formula, Kind, Plain, display, is_identifier};
use crate::model::{AnswerDecl, AnswerUnit, AnswerValue, Tolerance};
use crate::reader::{Fields, Raw, Reader, short, string, wrong_type};
use crate::units::{Dimension, Unit, parse_number_or_quantity, parse_unit};
use std::ops::Range;
use toml::de::DeValue;
use words::{Notice, Text};

/// A right answer may be off by one hundredth.
const USUAL: Tolerance = Tolerance::Relative(0.01);

/// The items, in order; each is a name for the formulas behind it.
pub(super) fn read<'a>(reader: &mut Reader<'a>, top: &Fields<'a>, cover: &mut Cover) -> Vec<AnswerDecl> {
    let Some(value) = top.get("answers") else { return Vec::new() };
    let DeValue::Array(items) = value.get_ref() else {
        let fault = wrong_type(value.span(), "an array of tables", "массив таблиц", value.get_ref().type_str());
        reader.fault(fault.help("write [[answers]] with double brackets", "напишите [[answers]] в двойных скобках"));
        return Vec::new();
    };
    let mut found: Vec<AnswerDecl> = Vec::new();
    for item in items {
        let DeValue::Table(table) = item.get_ref() else {
            reader.fault(wrong_type(item.span(), "a table", "таблица", item.get_ref().type_str()));
            continue;
        };
        let fields = Fields::open(reader, &fields::variants::ANSWER, table, item.span(), "answers".to_owned());
        let Some(answer) = answer(reader, &fields, (&found, &mut *cover)) else { continue };
        found.push(answer);
    }
    found
}

fn answer<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>, (earlier, cover): (&[AnswerDecl], &mut Cover)) -> Option<AnswerDecl> {
    let (id, span) = fields.name(reader, "id")?;
    let id = id.trim().to_owned();
    if !fine(reader, &id, span, earlier) {
        return None;
    }
    let ask = fields.text(reader, "ask").unwrap_or_else(|| Text::same(&id));
    let unit = unit(reader, fields)?;
    let (value, value_span) = value(reader, fields, &unit)?;
    let tolerance = tolerance(reader, fields, &unit)?;
    let gives = fields.name(reader, "gives").and_then(|(name, span)| parameter(reader, name, span, cover));
    // a constant parameter of that name is what formulas mean
    let taken = matches!(reader.scope.get(&id).map(|e| e.kind), Some(EntryKind::Parameter(_)));
    let name = if taken { format!("answer {id}") } else { id.clone() };
    let symbol = cover.quantity(reader, &name, (&format!("answer {id}"), unit.dimension));
    Some(AnswerDecl { id, symbol, ask, value, unit, tolerance, gives, span: fields.span.clone(), value_span })
}

fn fine(reader: &mut Reader, id: &str, span: Range<usize>, earlier: &[AnswerDecl]) -> bool {
    let shown = short(id);
    let fault = if !is_identifier(id) {
        Notice::piece("M372", span, format!("`{shown}` cannot be an id"), format!("`{shown}` не может быть идентификатором ответа")).why(
            "an id is made of letters, digits and _, and begins with a letter",
            "идентификатор состоит из букв, цифр и _ и начинается с буквы",
        )
    } else if earlier.iter().any(|a| a.id == id) {
        Notice::piece("M372", span, format!("there are two answers `{shown}`"), format!("ответ `{shown}` задан дважды"))
    } else {
        return true;
    };
    reader.fault(fault);
    false
}

/// None with a finding when it is no unit.
fn unit<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>) -> Option<AnswerUnit> {
    let Some(value) = fields.get("unit") else {
        return Some(AnswerUnit { label: String::new(), factor: 1.0, dimension: Dimension::NONE });
    };
    let (unit, label) = reader.unit(value)?;
    let label = if label == "1" { String::new() } else { label };
    Some(AnswerUnit { label, factor: unit.factor.to_f64(), dimension: unit.dimension })
}

fn value<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>, unit: &AnswerUnit) -> Option<(AnswerValue, Range<usize>)> {
    let text = |reader: &mut Reader<'a>, key: &'static str| fields.get(key).and_then(|v| string(reader, v, "a string", "строка"));
    let (of, at) = (text(reader, "of").map(|t| t.0.trim().to_owned()), text(reader, "at").map(|t| t.0.trim().to_owned()));
    match (text(reader, "value"), fields.raw(reader, "formula")) {
        (Some((text, span)), None) => Some((AnswerValue::Study { text: text.trim().to_owned(), of, at }, span)),
        (None, Some(raw)) if of.is_none() && at.is_none() => {
            let (value, kind) = constant(reader, &raw, Some(&unit.dimension))?;
            let factor = factor(reader, &raw, kind, unit);
            Some((AnswerValue::Formula { value, factor }, fields.span_of("formula")))
        }
        _ => {
            let fault = Notice::piece(
                "M373",
                fields.span.clone(),
                "an answer has either `value` or `formula`",
                "у ответа либо `value`, либо `formula`",
            )
            .why(
                "`value` is a number of a study, with `of` and `at`; `formula` is computed from parameters and answers above",
                "`value` — число из расчёта, к нему относятся `of` и `at`; `formula` вычисляется по параметрам и предыдущим ответам",
            );
            reader.fault(
                fault
                    .help("write value = \"modes.1.f\" or formula = \"2*pi/k\"", "напишите value = \"modes.1.f\" или formula = \"2*pi/k\""),
            );
            None
        }
    }
}

/// An angular rate in Hz is divided by 2 pi.
fn factor<'a>(reader: &mut Reader<'a>, raw: &Raw<'a>, kind: Kind, unit: &AnswerUnit) -> f64 {
    let Kind::Known(dimension) = kind else { return unit.factor };
    if let Some(factor) = crate::variants::turned(&dimension, unit) {
        return factor;
    }
    let whole = parse_unit(&unit.label).unwrap_or(Unit { dimension: unit.dimension, ..Unit::ONE });
    let (factor, fault) = display(&dimension, &whole, raw.formula.as_ref(), plain(reader, raw));
    if let Some(fault) = fault {
        let finding = raw.snippet.diagnose(fault);
        reader.report(finding);
    }
    factor
}

/// A value in 1/s made of times and numbers alone is one over a period.
fn plain(reader: &Reader, raw: &Raw) -> Plain {
    let of_times = |name: &str| matches!(reader.scope.get(name).map(|e| e.dimension), Some(Kind::Known(d)) if d.is_duration() || d.is_none() && !d.is_angular());
    let times = |f: &Formula| f.names().all(|(name, _)| of_times(name)) && f.has_units(Dimension::is_of_time);
    if raw.formula.as_ref().is_some_and(times) { Plain::Periods } else { Plain::Doubtful }
}

/// `2 %`, `0,01 м`, 0.02.
fn tolerance<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>, unit: &AnswerUnit) -> Option<Tolerance> {
    let Some(value) = fields.get("tolerance") else { return Some(USUAL) };
    let span = value.span();
    let text = match value.get_ref() {
        DeValue::String(text) => text.as_ref().to_owned(),
        DeValue::Float(x) => x.as_str().to_owned(),
        DeValue::Integer(x) => x.as_str().to_owned(),
        other => {
            reader.fault(wrong_type(span, "a share or a quantity", "доля или величина", other.type_str()));
            return None;
        }
    };
    let quantity = match parse_number_or_quantity(&text) {
        Ok(quantity) => quantity,
        Err(fault) => {
            reader.fault(Notice { place: words::Place::Piece(span), ..fault });
            return None;
        }
    };
    let (size, dimension) = (quantity.to_f64(), quantity.unit.dimension);
    let share = dimension.is_none() && !dimension.is_angular();
    if share && size > 0.0 && size <= 1.0 {
        return Some(Tolerance::Relative(size));
    }
    if !share && dimension.same(&unit.dimension) && size > 0.0 {
        return Some(Tolerance::Absolute(size));
    }
    let fault = Notice::piece(
        "M374",
        span,
        format!("`{}` is no tolerance of this answer", short(&text)),
        format!("`{}` не годится как допуск этого ответа", short(&text)),
    )
    .why(
        "a tolerance is a share of the value above 0 and up to 1, or a quantity of the dimension of the answer",
        "допуск — доля величины больше 0 и не больше 1 либо величина той же размерности, что и ответ",
    );
    reader.fault(fault.help("write tolerance = \"2 %\"", "напишите tolerance = \"2 %\""));
    None
}
