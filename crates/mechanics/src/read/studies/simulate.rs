//! The study `simulate`.

use super::plot::plots;
use super::{duration, outputs, tolerance};
use crate::formula::Context;
use crate::model::{Method, Simulate, StudyKind, Times};
use crate::read::reader::{Fields, Reader, short, string, wrong_type};
use crate::read::syntax::Value;
use crate::units::Dimension;
use words::Notice;

/// More rows than this do not fit a useful result.
const MAX_ROWS: f64 = 1e7;

pub(super) fn read<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>) -> Option<StudyKind> {
    simulate(reader, fields, "simulate").map(StudyKind::Simulate)
}

pub(super) fn simulate<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>, kind: &str) -> Option<Simulate> {
    let until = duration(reader, fields, "until");
    if !fields.has("until") {
        let (en, ru) = (format!("the study {kind} lacks `until`"), format!("в расчёте {kind} не хватает `until`"));
        reader.fault(Notice::piece("M006", fields.span.clone(), en, ru).help("add until = \"30 s\"", "добавьте until = \"30 с\""));
    }
    let times = grid(reader, fields, until);
    let tolerance = tolerance(reader, fields);
    let method = method(reader, fields);
    let outputs = outputs(reader, fields);
    let plots = fields.get("plot").map(|v| plots(reader, v)).unwrap_or_default();
    Some(Simulate { until: until?, times, tolerance, method, outputs, plots })
}

fn method<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>) -> Method {
    let Some((word, span)) = fields.get("method").and_then(|v| string(reader, v, "a string", "строка")) else {
        return Method::default();
    };
    if let Some((method, _)) = Method::ALL.iter().find(|row| row.1 == word.as_str()) {
        return *method;
    }
    let (en, ru) = (format!("unknown method `{}`", short(&word)), format!("неизвестный метод `{}`", short(&word)));
    reader.fault(Notice::piece("M065", span, en, ru).help("auto, taylor or stiff", "auto, taylor или stiff"));
    Method::default()
}

/// `every` or `at`.
pub(super) fn grid<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>, until: Option<f64>) -> Times {
    if fields.has("every") && fields.has("at") {
        reader.fault(
            Notice::piece("M065", fields.span_of("at"), "both `every` and `at` are given", "заданы и `every`, и `at`")
                .help("keep one", "оставьте одно"),
        );
    }
    let every = duration(reader, fields, "every");
    if let (Some(until), Some(every)) = (until, every)
        && until / every > MAX_ROWS
    {
        reader.fault(
            Notice::piece(
                "M067",
                fields.span_of("every"),
                format!("{:.0} rows of results; the limit is {MAX_ROWS:.0}", until / every),
                format!("строк результата: {:.0}; предел {MAX_ROWS:.0}", until / every),
            )
            .why("the table would not fit in memory", "таблица не поместится в память")
            .help("take a larger step", "возьмите больший шаг"),
        );
    }
    match (fields.get("at"), every) {
        (Some(value), _) => Times::At(moments(reader, value, until)),
        (None, Some(step)) => Times::Every(step),
        (None, None) => Times::Automatic,
    }
}

fn moments<'a>(reader: &mut Reader<'a>, value: &'a Value<'a>, until: Option<f64>) -> Vec<f64> {
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
