//! `[[study]]`.

use super::parameters::names;
use super::reader::{Fields, Reader, string, wrong_type};
use super::syntax::Value;
use crate::fault::{Fault, nearest};
use crate::fields;
use crate::formula::{Context, EntryKind, Kind};
use crate::model::{DEFAULT_TOLERANCE, Plot, Simulate, Study, StudyKind, Times};
use crate::units::Dimension;
use std::ops::Range;
use symbolic::{SymbolId, Text};
use toml::de::DeValue;

const KINDS: [&str; 3] = ["equations", "equilibrium", "simulate"];
/// More rows than this do not fit a useful result.
const MAX_ROWS: f64 = 1e7;

/// The studies, in order.
pub(super) fn read<'a>(reader: &mut Reader<'a>, top: &Fields<'a>) -> Vec<Study> {
    let Some(value) = top.get("study") else { return Vec::new() };
    let DeValue::Array(items) = value.get_ref() else {
        reader.fault(
            wrong_type(value.span(), "an array of tables", "массив таблиц", value.get_ref().type_str())
                .help("write [[study]] with double brackets", "напишите [[study]] в двойных скобках"),
        );
        return Vec::new();
    };
    let mut found = Vec::new();
    for item in items.iter() {
        let DeValue::Table(table) = item.get_ref() else {
            reader.fault(wrong_type(item.span(), "a table", "таблица", item.get_ref().type_str()));
            continue;
        };
        let fields = Fields::open(reader, &fields::STUDY, table, item.span(), "study".to_owned());
        if let Some(kind) = study(reader, &fields) {
            found.push(Study { kind, span: item.span() });
        }
    }
    found
}

fn study<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>) -> Option<StudyKind> {
    let (kind, span) = string(reader, fields.get("kind")?, "a string", "строка")?;
    match kind.as_str() {
        "equations" => {
            misplaced(reader, fields, &kind, &[]);
            Some(StudyKind::Equations)
        }
        "equilibrium" => {
            misplaced(reader, fields, &kind, &["guess"]);
            Some(StudyKind::Equilibrium { guess: guess(reader, fields) })
        }
        "simulate" => {
            misplaced(reader, fields, &kind, &["until", "every", "at", "tolerance", "outputs", "plot"]);
            simulate(reader, fields).map(StudyKind::Simulate)
        }
        _ => {
            let fault = Fault::new(
                "M064",
                span,
                format!("unknown study `{}`", super::reader::short(&kind)),
                format!("неизвестный расчёт `{}`", super::reader::short(&kind)),
            );
            let fault = match nearest(&kind, KINDS) {
                Some(near) => fault.help(format!("did you mean `{near}`?"), format!("может быть, `{near}`?")),
                None => fault.help(format!("known studies: {}", KINDS.join(", ")), format!("известные расчёты: {}", KINDS.join(", "))),
            };
            reader.fault(fault);
            None
        }
    }
}

/// Keys that belong to another kind of study.
fn misplaced<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>, kind: &str, own: &[&str]) {
    for key in ["until", "every", "at", "tolerance", "outputs", "plot", "guess"] {
        if !own.contains(&key) && fields.has(key) {
            reader.fault(Fault::new(
                "M005",
                fields.span_of(key),
                format!("`{key}` does not belong to the study `{kind}`"),
                format!("ключ `{key}` не относится к расчёту `{kind}`"),
            ));
        }
    }
}

fn guess<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>) -> Vec<(SymbolId, f64)> {
    let mut found = Vec::new();
    for (name, span, value) in fields.rows(reader, "guess") {
        let entry = reader.scope.get(name).map(|e| (e.kind, e.dimension));
        let Some((EntryKind::Coordinate(symbols), kind)) = entry else {
            let fault = Fault::new(
                "M013",
                span,
                format!("`{}` is not a coordinate", super::reader::short(name)),
                format!("`{}` — не координата", super::reader::short(name)),
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

fn simulate<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>) -> Option<Simulate> {
    let until = duration(reader, fields, "until");
    if !fields.has("until") {
        reader.fault(
            Fault::new("M006", fields.span.clone(), "the study simulate lacks `until`", "в расчёте simulate не хватает `until`")
                .help("add until = \"30 s\"", "добавьте until = \"30 с\""),
        );
    }
    if fields.has("every") && fields.has("at") {
        reader.fault(
            Fault::new("M065", fields.span_of("at"), "both `every` and `at` are given", "заданы и `every`, и `at`")
                .help("keep one", "оставьте одно"),
        );
    }
    let every = duration(reader, fields, "every");
    if let (Some(until), Some(every)) = (until, every)
        && until / every > MAX_ROWS
    {
        reader.fault(
            Fault::new(
                "M067",
                fields.span_of("every"),
                format!("{:.0} rows of results; the limit is {MAX_ROWS:.0}", until / every),
                format!("строк результата: {:.0}; предел {MAX_ROWS:.0}", until / every),
            )
            .why("the table would not fit in memory", "таблица не поместится в память")
            .help("take a larger step", "возьмите больший шаг"),
        );
    }
    let times = match (fields.get("at"), every) {
        (Some(value), _) => Times::At(moments(reader, value, until)),
        (None, Some(step)) => Times::Every(step),
        (None, None) => Times::Automatic,
    };
    let tolerance = tolerance(reader, fields);
    let outputs = fields.get("outputs").map(|v| names(reader, v)).unwrap_or_default();
    let outputs = outputs.into_iter().filter_map(|(n, span)| known(reader, n, span)).collect();
    let plots = fields.get("plot").map(|v| plots(reader, v)).unwrap_or_default();
    Some(Simulate { until: until?, times, tolerance, outputs, plots })
}

/// A positive time.
fn duration<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>, key: &'static str) -> Option<f64> {
    let value = fields.formula(reader, key, &Context::CONSTANT, Some(&Dimension::TIME))?;
    let number = reader.number(&value)?;
    if number <= 0.0 {
        reader.fault(Fault::new(
            "M065",
            fields.span_of(key),
            format!("`{key}` is {number} s; it must be positive"),
            format!("`{key}` равно {number} с; должно быть положительным"),
        ));
        return None;
    }
    Some(number)
}

fn tolerance<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>) -> f64 {
    let Some(value) = fields.formula(reader, "tolerance", &Context::CONSTANT, Some(&Dimension::NONE)) else { return DEFAULT_TOLERANCE };
    let Some(number) = reader.number(&value) else { return DEFAULT_TOLERANCE };
    if !(1e-16..=1e-2).contains(&number) {
        reader.fault(
            Fault::new(
                "M065",
                fields.span_of("tolerance"),
                format!("the tolerance is {number:e}; it must lie between 1e-16 and 1e-2"),
                format!("точность {number:e}; допустимо от 1e-16 до 1e-2"),
            )
            .why("machine numbers carry 16 digits", "машинные числа несут 16 знаков"),
        );
    }
    number
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
            reader.fault(Fault::new(
                "M065",
                item.span(),
                "times must ascend and not be negative",
                "моменты времени должны возрастать и быть неотрицательными",
            ));
            return found;
        }
        if until.is_some_and(|end| t > end) {
            reader.fault(
                Fault::new("M065", item.span(), format!("{t} s lies after the end of the motion"), format!("{t} с — позже конца движения"))
                    .help("enlarge `until`", "увеличьте `until`"),
            );
            return found;
        }
        found.push(t);
    }
    found
}

/// A name of a result: coordinate with primes, or output.
fn known(reader: &mut Reader, name: String, span: Range<usize>) -> Option<String> {
    let base = name.trim_end_matches('\'');
    let primes = name.len() - base.len();
    let fits = match reader.scope.get(base).map(|e| e.kind) {
        Some(EntryKind::Coordinate(_)) => primes <= 1,
        Some(EntryKind::Output(_)) => primes == 0,
        _ => false,
    };
    if fits {
        return Some(name);
    }
    let fault = Fault::new(
        "M066",
        span,
        format!("there is no result `{}`", super::reader::short(&name)),
        format!("нет результата `{}`", super::reader::short(&name)),
    )
    .why(
        "results are coordinates, their rates (phi') and the names in [outputs]",
        "результаты — это координаты, их скорости (phi') и имена из [outputs]",
    );
    let fault = match nearest(base, reader.scope.names()) {
        Some(near) if near != base => fault.help(format!("did you mean `{near}`?"), format!("может быть, `{near}`?")),
        _ => fault.help("add it to [outputs]", "добавьте её в [outputs]"),
    };
    reader.fault(fault);
    None
}

fn plots<'a>(reader: &mut Reader<'a>, value: &'a Value<'a>) -> Vec<Plot> {
    let Some(items) = value.get_ref().as_array() else {
        reader.fault(
            wrong_type(value.span(), "an array of plots", "массив графиков", value.get_ref().type_str())
                .help("write plot = [\"phi'\"]", "напишите plot = [\"phi'\"]"),
        );
        return Vec::new();
    };
    items.iter().filter_map(|item| plot(reader, item)).collect()
}

fn plot<'a>(reader: &mut Reader<'a>, item: &'a Value<'a>) -> Option<Plot> {
    let mut result = Plot { title: Text::default(), x: None, y: Vec::new() };
    let mut wanted = Vec::new();
    match item.get_ref() {
        DeValue::String(name) => wanted.push((name.as_ref().to_owned(), item.span())),
        DeValue::Array(_) => wanted = names(reader, item),
        DeValue::Table(table) => {
            let fields = Fields::open(reader, &fields::PLOT, table, item.span(), "plot".to_owned());
            result.title = fields.text(reader, "title").unwrap_or_default();
            let x = fields.name(reader, "x").filter(|(name, _)| name != "t");
            result.x = x.and_then(|(name, span)| known(reader, name, span));
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
    result.y = wanted.into_iter().filter_map(|(name, span)| known(reader, name, span)).collect();
    (!result.y.is_empty()).then_some(result)
}
