//! Ranges, frequencies and the unknown of a frequency equation.

use crate::formula::{Context, Depends, Entry, EntryKind, FREQUENCIES, Formula, Kind};
use crate::model::FrequencyVariable;
use crate::reader::syntax::Value;
use crate::reader::{Fields, Reader, short, wrong_type};
use crate::units::Dimension;
use std::f64::consts::TAU;
use std::ops::Range;
use symbolic::Rational;
use words::Notice;

/// `frequency_variable = { z = "m*l^3*k^2/(72*E*I)" }`.
pub(super) fn variable<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>, key: &'static str) -> Option<FrequencyVariable> {
    let rows = fields.rows(reader, key);
    let (name, _, value) = rows.first()?;
    let name = (*name).to_owned();
    let raw = reader.raw(value)?;
    let used: Vec<String> = raw.formula.as_ref().map(|f: &Formula| f.names().map(|(n, _)| n.to_owned()).collect()).unwrap_or_default();
    let free = FREQUENCIES.iter().find(|f| reader.scope.get(f).is_none() && used.iter().any(|u| u == *f));
    let Some(frequency) = free else {
        reader.fault(no_frequency(value.span()));
        return None;
    };
    let symbol = reader.builder.graph.symbol_id(frequency, 0);
    let entry = Entry { kind: EntryKind::Parameter(symbol), dimension: Kind::Known(Dimension::ANGULAR_RATE), depends: Depends::TIME };
    reader.scope.declare(frequency, entry);
    let checked = reader.value(&raw, &Context::TIME, None);
    if !checked.good {
        return None;
    }
    let graph = &mut reader.builder.graph;
    let omega = graph.symbol(symbol);
    let inverse = graph.pow(omega, &Rational::from(-2));
    let factor = graph.mul(checked.expr, inverse);
    if graph.contains(factor, |s| s == symbol) || graph.is_zero(factor) {
        reader.fault(no_frequency(value.span()));
        return None;
    }
    Some(FrequencyVariable { name, factor })
}

fn no_frequency(span: Range<usize>) -> Notice {
    Notice::piece("M091", span, "this is no multiple of the squared frequency", "это не квадрат частоты с множителем")
        .why(
            "the frequency is written k, or omega where k is the name of something else, and must occur squared",
            "частота обозначается k, а если имя k занято — omega, и входит в квадрате",
        )
        .help("write frequency_variable = { z = \"m*k^2/c\" }", "напишите frequency_variable = { z = \"m*k^2/c\" }")
}

/// Two values of what another key names, the first smaller. They stand for what is given to that name: periods are no radians there (M027), as they are none in
/// any other value of it; only an axis that is a frequency by nature ([`band`]) takes either.
pub(super) fn ascending<'a>(reader: &mut Reader<'a>, value: &'a Value<'a>, wanted: Option<&Dimension>) -> Option<[f64; 2]> {
    let [from, to] = range(reader, value, (wanted, Periods::Differ))?;
    if to <= from {
        reader.fault(descending(value.span(), [from, to]));
    }
    (to > from).then_some([from, to])
}

/// Two frequencies, the first smaller and not negative, rad/s.
pub(super) fn band<'a>(reader: &mut Reader<'a>, value: &'a Value<'a>) -> Option<[f64; 2]> {
    let [from, to] = range(reader, value, (Some(&Dimension::ANGULAR_RATE), Periods::Turn))?;
    if to <= from {
        reader.fault(descending(value.span(), [from, to]));
    } else if from < 0.0 {
        reader.fault(negative(value.span(), from));
    }
    Some([from, to])
}

/// A parameter with a number, and its dimension.
pub(super) fn parameter(reader: &mut Reader, name: &str, span: Range<usize>) -> Option<Option<Dimension>> {
    if let Some(Entry { kind: EntryKind::Parameter(_), dimension, depends }) = reader.scope.get(name)
        && depends.is_constant()
    {
        return Some(if let Kind::Known(d) = dimension { Some(*d) } else { None });
    }
    let fault = Notice::piece("M092", span, format!("`{}` is not a parameter", short(name)), format!("`{}` — не параметр", short(name)))
        .why("what is changed step by step must be a constant parameter", "шаг за шагом можно менять только постоянный параметр");
    let fault = match reader.scope.nearest(name, reader.scope.names()) {
        Some(near) if near != name => fault.meant(name, near),
        _ => fault.help("name a row of [parameters]", "укажите имя из [parameters]"),
    };
    reader.fault(fault);
    None
}

fn descending(span: Range<usize>, [from, to]: [f64; 2]) -> Notice {
    let [a, b] = [from, to].map(words::digits::typed);
    Notice::piece(
        "M093",
        span,
        format!("a range ascends, and {} ... {} does not (SI)", a.en, b.en),
        format!("границы диапазона должны возрастать, а заданы {} ... {} (СИ)", a.ru, b.ru),
    )
    .help("write the smaller end first, then the larger one", "укажите сначала меньшую границу, затем большую")
}

fn negative(span: Range<usize>, from: f64) -> Notice {
    let a = words::digits::typed(from);
    Notice::piece(
        "M093",
        span,
        format!("frequencies are not negative, and the range begins at {} rad/s", a.en),
        format!("частоты неотрицательны, а диапазон начинается с {} рад/с", a.ru),
    )
    .help("begin at 0 or at a frequency above it", "начните с 0 или с положительной частоты")
}

/// Two quantities.
fn range<'a>(reader: &mut Reader<'a>, value: &'a Value<'a>, (wanted, periods): (Option<&Dimension>, Periods)) -> Option<[f64; 2]> {
    let list = quantities(reader, value, (wanted, periods));
    if let [from, to] = list[..] {
        return Some([from, to]);
    }
    let n = value.get_ref().as_array().map_or(0, |a| a.len());
    if n != 2 {
        reader.fault(
            Notice::piece("M093", value.span(), format!("a range has two ends, {n} given"), format!("у диапазона две границы, дано: {n}"))
                .help("write the smaller and the larger end: [from, to]", "укажите меньшую и большую границы: [от, до]"),
        );
    }
    None
}

/// What a count of periods is where radians are wanted.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Periods {
    /// An axis that is a frequency by nature: each period is a turn.
    Turn,
    /// A value of something that the file names: M027.
    Differ,
}

/// Quantities; periods per second become radians per second where these are wanted on an axis of frequencies.
pub(super) fn quantities<'a>(reader: &mut Reader<'a>, value: &'a Value<'a>, (wanted, periods): (Option<&Dimension>, Periods)) -> Vec<f64> {
    let Some(items) = value.get_ref().as_array() else {
        reader.fault(wrong_type(value.span(), "an array of quantities", "массив величин", value.get_ref().type_str()));
        return Vec::new();
    };
    let mut found = Vec::with_capacity(items.len());
    for item in items.iter() {
        let Some(raw) = reader.raw(item) else { continue };
        // how a turning is counted is looked at below: without the angle nothing is complained of here
        let turning = wanted.filter(|w| w.is_angular() || w.counts_periods());
        let plain = turning.map(Dimension::without_angle);
        let checked = reader.value(&raw, &Context::CONSTANT, plain.as_ref().or(wanted));
        let got = if let Kind::Known(d) = checked.kind { Some(d) } else { None };
        let fault = turning.zip(got).and_then(|(wanted, got)| crate::units::in_field(&got, wanted, raw.snippet.all()));
        if let Some(fault) = fault.filter(|_| periods == Periods::Differ) {
            reader.report(raw.snippet.diagnose(Notice { severity: words::Severity::Error, ..fault }));
            continue;
        }
        let turns = wanted.is_some_and(Dimension::is_angular) && got.is_some_and(|d| d.lacks_radians());
        let number = reader.number(&checked);
        found.extend(number.map(|v| if turns { TAU * v } else { v }));
    }
    found
}
