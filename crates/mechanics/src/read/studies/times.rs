//! Times and tolerances of a study.

use crate::formula::Context;
use crate::reader::syntax::Value;
use crate::reader::{Fields, Reader, wrong_type};
use crate::units::Dimension;
use words::Notice;
use words::digits::quantity;
use words::limits::TOLERANCES;

/// More rows than this do not fit a useful result.
const MAX_ROWS: f64 = 1e7;

/// A positive time.
pub(super) fn duration<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>, key: &'static str) -> Option<f64> {
    let value = fields.formula(reader, key, &Context::CONSTANT, Some(&Dimension::TIME))?;
    let number = reader.number(&value)?;
    if number <= 0.0 {
        reader.fault(Notice::piece(
            "M065",
            fields.span_of(key),
            format!("`{key}` is {}; it must be positive", quantity(number, "s").en),
            format!("`{key}` равно {}; должно быть положительным", quantity(number, "s").ru),
        ));
        return None;
    }
    Some(number)
}

/// A time that may be zero.
pub(super) fn waiting<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>, key: &'static str) -> Option<f64> {
    let value = fields.formula(reader, key, &Context::CONSTANT, Some(&Dimension::TIME))?;
    let number = reader.number(&value)?;
    if number < 0.0 {
        reader.fault(Notice::piece(
            "M065",
            fields.span_of(key),
            format!("`{key}` is {}; it must not be negative", quantity(number, "s").en),
            format!("`{key}` равно {}; отрицательным быть не может", quantity(number, "s").ru),
        ));
        return None;
    }
    Some(number)
}

pub(super) fn tolerance<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>, key: &'static str) -> Option<f64> {
    let value = fields.formula(reader, key, &Context::CONSTANT, Some(&Dimension::NONE))?;
    let number = reader.number(&value)?;
    if !TOLERANCES.contains(&number) {
        reader.fault(
            Notice::piece(
                "M065",
                fields.span_of(key),
                format!(
                    concat!(
                        "the tolerance is {:e}; it must lie between ",
                        words::finest_tolerance!(),
                        " and ",
                        words::coarsest_tolerance!()
                    ),
                    number
                ),
                format!(
                    concat!(
                        "допустимая погрешность {:e}; она должна лежать между ",
                        words::finest_tolerance!(),
                        " и ",
                        words::coarsest_tolerance!()
                    ),
                    number
                ),
            )
            .why("machine numbers carry 16 digits", "машинные числа несут 16 знаков"),
        );
    }
    Some(number)
}

/// A step of time; up to the end it makes not more rows than fit.
pub(super) fn step<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>, (key, until): (&'static str, Option<f64>)) -> Option<f64> {
    let step = duration(reader, fields, key)?;
    if let Some(rows) = until.map(|end| end / step).filter(|rows| *rows > MAX_ROWS) {
        reader.fault(
            Notice::piece(
                "M067",
                fields.span_of(key),
                format!("{rows:.0} rows of results; the limit is {MAX_ROWS:.0}"),
                format!("строк результата: {rows:.0}; предел {MAX_ROWS:.0}"),
            )
            .why("the table would not fit in memory", "таблица не поместится в память")
            .help("take a larger step", "возьмите больший шаг"),
        );
    }
    Some(step)
}

/// Ascending times up to the end.
pub(super) fn moments<'a>(reader: &mut Reader<'a>, value: &'a Value<'a>, until: Option<f64>) -> Vec<f64> {
    let Some(items) = value.get_ref().as_array() else {
        reader.fault(wrong_type(value.span(), "an array of times", "массив моментов времени", value.get_ref().type_str()));
        return Vec::new();
    };
    let mut found: Vec<f64> = Vec::new();
    for item in items.iter() {
        let Some(raw) = reader.raw(item) else { continue };
        let time = reader.value(&raw, &Context::CONSTANT, Some(&Dimension::TIME));
        let Some(t) = reader.number(&time) else { continue };
        if found.last().is_some_and(|last| t <= *last) || t < 0.0 {
            reader.fault(Notice::piece(
                "M065",
                item.span(),
                "times must ascend and not be negative",
                "моменты времени должны возрастать и быть неотрицательными",
            ));
            return found;
        }
        if until.is_some_and(|end| t > end) {
            reader.fault(
                Notice::piece(
                    "M065",
                    item.span(),
                    format!("{t} s lies after the end of the motion"),
                    format!("{t} с — позже конца движения"),
                )
                .help("enlarge `until`", "увеличьте `until`"),
            );
            return found;
        }
        found.push(t);
    }
    found
}
