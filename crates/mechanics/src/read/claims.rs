//! `[[claims]]`: published results. They may be wrong, also in their dimensions: that is a result and no error of the file.

use crate::fields;
use crate::formula::{Context, Depends, Entry, EntryKind, FREQUENCIES, Kind, check};
use crate::model::{ClaimDecl, ClaimInstant, ClaimKind};
use crate::reader::{Checked, Fields, Raw, Reader, wrong_type};
use crate::snippet::Snippet;
use crate::units::{Dimension, si_label, si_label_ru};
use algebra::elementary;
use std::f64::consts::TAU;
use std::ops::Range;
use symbolic::{Expr, SymbolId};
use toml::de::DeValue;
use words::{Notice, Severity, Text};

/// Relative deviation of an equation or formula that is the same: published coefficients are rarely rounded beyond six digits.
const USUAL: f64 = 1e-6;
/// Findings about dimensions.
const DIMENSIONAL: [&str; 3] = ["M024", "M025", "M026"];

/// The claims, in order.
pub(super) fn read<'a>(reader: &mut Reader<'a>, top: &Fields<'a>) -> Vec<ClaimDecl> {
    let Some(value) = top.get("claims") else { return Vec::new() };
    let DeValue::Array(items) = value.get_ref() else {
        reader.fault(
            wrong_type(value.span(), "an array of tables", "массив таблиц", value.get_ref().type_str())
                .help("write [[claims]] with double brackets", "напишите [[claims]] в двойных скобках"),
        );
        return Vec::new();
    };
    let mut found = Vec::new();
    for (i, item) in items.iter().enumerate() {
        let DeValue::Table(table) = item.get_ref() else {
            reader.fault(wrong_type(item.span(), "a table", "таблица", item.get_ref().type_str()));
            continue;
        };
        let fields = Fields::open(reader, &fields::claims::CLAIM, table, item.span(), "claims".to_owned());
        found.extend(claim(reader, &fields, i + 1));
    }
    found
}

/// What a claim compares, before its name and source are known.
struct Compared {
    kind: ClaimKind,
    tolerance: f64,
    unit: String,
    dimensions: Text,
}

fn claim<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>, number: usize) -> Option<ClaimDecl> {
    let name = fields.text(reader, "name");
    let source = fields.text(reader, "source").unwrap_or_default();
    let tolerance = fields.formula(reader, "tolerance", &Context::CONSTANT, Some(&Dimension::NONE)).and_then(|v| reader.number(&v));
    let given = |keys: &[&'static str]| keys.iter().all(|k| fields.has(k));
    let keys: &[&'static str] = &["equation", "of", "formula", "value", "at", "mode", "frequency", "unknown"];
    let only = |allowed: &[&str]| keys.iter().all(|k| allowed.contains(k) || !fields.has(k));
    let compared = match () {
        () if given(&["equation"]) && only(&["equation"]) => equation(reader, fields),
        () if given(&["of", "formula"]) && only(&["of", "formula"]) => formula(reader, fields),
        () if given(&["of", "value"]) && only(&["of", "value", "at"]) => value(reader, fields),
        () if given(&["mode", "value"]) && only(&["mode", "value"]) => frequency(reader, fields),
        () if given(&["frequency"]) && only(&["frequency", "unknown"]) => frequency_equation(reader, fields),
        () => {
            reader.fault(incomplete(fields));
            None
        }
    }?;
    Some(ClaimDecl {
        name: name.unwrap_or_else(|| Text::new(format!("claim {number}"), format!("утверждение {number}"))),
        source,
        kind: compared.kind,
        tolerance: tolerance.filter(|t| *t > 0.0).unwrap_or(compared.tolerance),
        stated: tolerance.is_some_and(|t| t > 0.0),
        unit: compared.unit,
        dimensions: compared.dimensions,
        span: fields.span.clone(),
    })
}

fn incomplete(fields: &Fields) -> Notice {
    Notice::piece(
        "M143",
        fields.span.clone(),
        "this claim compares nothing, or too much",
        "этот результат не с чем сравнить, либо ключей слишком много",
    )
    .why(
        "a claim is one of: an equation; a formula of something; a value of something; the value of a mode; a frequency equation",
        "результат — это одно из: уравнение; формула величины; значение величины; значение частоты с номером; частотное уравнение",
    )
    .help(
        "give `equation`; or `of` and `formula`; or `of` and `value` (and `at`); or `mode` and `value`; or `frequency`",
        "задайте `equation`; или `of` и `formula`; или `of` и `value` (и `at`); или `mode` и `value`; или `frequency`",
    )
}

fn equation<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>) -> Option<Compared> {
    let (sides, unit, dimensions) = sides(reader, fields, "equation")?;
    Some(Compared { kind: ClaimKind::Equation { left: sides[0], right: sides[1] }, tolerance: USUAL, unit, dimensions })
}

/// Both sides of an equation, their unit, what is wrong with their dimensions.
fn sides<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>, key: &'static str) -> Option<([Expr; 2], String, Text)> {
    let snippet = reader.snippet(fields.get(key)?)?;
    let sides: Vec<&str> = snippet.text.split('=').collect();
    let [left, right] = sides[..] else {
        let fault = Notice::piece("M144", snippet.all(), "an equation has two sides and one `=`", "у уравнения две части и один знак `=`")
            .help("write for example equation = \"m*x'' + c*x = 0\"", "напишите, например, equation = \"m*x'' + c*x = 0\"");
        reader.report(snippet.diagnose(fault));
        return None;
    };
    let (middle, end) = (left.len(), snippet.text.len());
    debug_assert!(middle + 1 + right.len() == end);
    let parts = [snippet.part(0..middle), snippet.part(middle + 1..end)];
    let mut dimensions = Text::default();
    let [left, right] = parts.map(|part| {
        let raw = reader.raw_text(part);
        lenient(reader, &raw, &mut dimensions)
    });
    if !left.good || !right.good {
        return None;
    }
    differ(&mut dimensions, [("the left side", "левая часть"), ("the right side", "правая часть")], [left.kind, right.kind]);
    Some(([left.expr, right.expr], label(left.kind), dimensions))
}

/// `frequency = "m*p^2 - c = 0"`: the frequency is k, or omega where k is taken, or what `unknown` says: a name, or `z = m*k^2/c`.
fn frequency_equation<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>) -> Option<Compared> {
    let unknown = fields.get("unknown").and_then(|v| reader.snippet(v));
    let (name, formula) = match &unknown {
        Some(snippet) => match snippet.text.split_once('=') {
            Some((name, _)) => (name.trim().to_owned(), Some(snippet.part(name.len() + 1..snippet.text.len()))),
            None => (snippet.text.trim().to_owned(), None),
        },
        None => (String::new(), None),
    };
    if unknown.is_some() && !crate::formula::is_identifier(&name) {
        let fault = Notice::piece("M143", fields.span_of("unknown"), "the unknown has no name", "у неизвестной нет имени");
        reader.fault(
            fault.help("write unknown = \"p\", or unknown = \"z = m*k^2/c\"", "напишите unknown = \"p\" или unknown = \"z = m*k^2/c\""),
        );
        return None;
    }
    let free = FREQUENCIES.iter().find(|f| reader.scope.get(f).is_none()).copied().unwrap_or("omega");
    let own = if formula.is_none() && unknown.is_some() { name.as_str() } else { free };
    let mut before = Vec::new();
    let frequency = covered(reader, (own, Kind::Known(Dimension::ANGULAR_RATE)), &mut before);
    let meaning = formula.map(|piece| {
        let raw = reader.raw_text(piece);
        reader.value(&raw, &Context::TIME, None)
    });
    let unknown = meaning.map(|m| (covered(reader, (&name, m.kind), &mut before), m));
    let found = sides(reader, fields, "frequency");
    before.into_iter().rev().for_each(|(name, entry)| reader.scope.uncover(&name, entry));
    let (sides, unit, dimensions) = found?;
    if unknown.as_ref().is_some_and(|(_, m)| !m.good) {
        return None;
    }
    let coordinates = reader.scope.coordinates();
    let graph = &reader.builder.graph;
    let letter = unknown.as_ref().map_or(frequency, |(s, _)| *s);
    let moves = |s: SymbolId| s != letter && coordinates.contains(&s);
    if sides.iter().any(|e| graph.contains(*e, moves)) || !sides.iter().any(|e| graph.contains(*e, |s| s == letter)) {
        reader.fault(no_frequency_equation(fields.span_of("frequency"), if unknown.is_some() { &name } else { own }));
        return None;
    }
    let unknown = unknown.map(|(s, m)| (s, m.expr));
    Some(Compared {
        kind: ClaimKind::FrequencyEquation { left: sides[0], right: sides[1], frequency, unknown },
        tolerance: USUAL,
        unit,
        dimensions,
    })
}

/// Gives a name another meaning for one claim.
fn covered(reader: &mut Reader, (name, dimension): (&str, Kind), before: &mut Vec<(String, Option<Entry>)>) -> SymbolId {
    let symbol = reader.letter(name);
    let entry = Entry { kind: EntryKind::Parameter(symbol), dimension, depends: Depends::TIME };
    before.push((name.to_owned(), reader.scope.cover(name, entry)));
    symbol
}

fn no_frequency_equation(span: Range<usize>, unknown: &str) -> Notice {
    Notice::piece("M144", span, "this is no frequency equation", "это не частотное уравнение")
        .why(
            format!("it has the unknown `{unknown}`, parameters and numbers, and no coordinates"),
            format!("в него входят неизвестная `{unknown}`, параметры и числа, но не координаты"),
        )
        .help(
            "write for example frequency = \"m*k^2 - c = 0\"; another letter: unknown = \"p\"",
            "напишите, например, frequency = \"m*k^2 - c = 0\"; другая буква: unknown = \"p\"",
        )
}

fn formula<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>) -> Option<Compared> {
    let of = fields.formula(reader, "of", &Context::OUTPUT, None).filter(|v| v.good)?;
    let raw = fields.raw(reader, "formula")?;
    let mut dimensions = Text::default();
    let published = lenient(reader, &raw, &mut dimensions);
    if !published.good {
        return None;
    }
    differ(&mut dimensions, [("the quantity", "величина"), ("the published formula", "опубликованная формула")], [of.kind, published.kind]);
    let kind = ClaimKind::Formula { of: of.expr, formula: published.expr };
    Some(Compared { kind, tolerance: USUAL, unit: label(of.kind), dimensions })
}

fn value<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>) -> Option<Compared> {
    let of = fields.formula(reader, "of", &Context::OUTPUT, None).filter(|v| v.good)?;
    let (published, tolerance, kind) = number(reader, fields)?;
    let at = instant(reader, fields)?;
    let mut dimensions = Text::default();
    differ(&mut dimensions, [("the quantity", "величина"), ("the published value", "опубликованное значение")], [of.kind, kind]);
    Some(Compared { kind: ClaimKind::Value { of: of.expr, published, at }, tolerance, unit: label(of.kind), dimensions })
}

fn frequency<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>) -> Option<Compared> {
    let mode = fields.formula(reader, "mode", &Context::CONSTANT, Some(&Dimension::NONE)).and_then(|v| reader.number(&v))?;
    if !(mode >= 1.0 && mode.fract() == 0.0 && mode <= 1e6) {
        let fault = Notice::piece("M143", fields.span_of("mode"), "modes are counted from 1", "номера форм считаются с 1");
        reader.fault(fault);
        return None;
    }
    let (published, tolerance, kind) = number(reader, fields)?;
    let periods = matches!(kind, Kind::Known(d) if d.lacks_radians());
    let mut dimensions = Text::default();
    let words = [("a frequency", "частота"), ("the published value", "опубликованное значение")];
    differ(&mut dimensions, words, [Kind::Known(Dimension::ANGULAR_RATE), kind]);
    let published = if periods { TAU * published } else { published };
    let kind = ClaimKind::Frequency { mode: mode as usize, published };
    Some(Compared { kind, tolerance, unit: "rad/s".to_owned(), dimensions })
}

/// The published value in SI, the relative size of half of its last digit, its dimension.
fn number<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>) -> Option<(f64, f64, Kind)> {
    let raw = fields.raw(reader, "value")?;
    let checked = reader.value(&raw, &Context::CONSTANT, None);
    let value = reader.number(&checked)?;
    let literal = raw.formula.as_ref().is_some_and(crate::formula::Formula::is_literal);
    let half = if literal { half_digit(&raw.snippet) } else { None };
    Some((value, half.unwrap_or(USUAL), checked.kind))
}

/// Half a unit of the last written digit, relative to the number: 0.5/2656.
fn half_digit(snippet: &Snippet) -> Option<f64> {
    let text = snippet.text.trim().trim_start_matches(['+', '-', '−']).replace(',', ".");
    let end = text.find(|c: char| !(c.is_ascii_digit() || c == '.')).unwrap_or(text.len());
    let digits = &text[..end];
    let number: f64 = digits.parse().ok().filter(|n| *n > 0.0)?;
    let decimals = digits.split_once('.').map_or(0, |(_, after)| after.len());
    Some(0.5 * elementary::powi(10f64, -i32::try_from(decimals).ok()?) / number)
}

fn instant<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>) -> Option<ClaimInstant> {
    let Some(value) = fields.get("at") else { return Some(ClaimInstant::At(0.0)) };
    match value.get_ref().as_str().map(str::trim) {
        Some("equilibrium") => return Some(ClaimInstant::Rest),
        Some("start") => return Some(ClaimInstant::At(0.0)),
        _ => {}
    }
    let time = fields.formula(reader, "at", &Context::CONSTANT, Some(&Dimension::TIME)).and_then(|v| reader.number(&v))?;
    if time < 0.0 {
        reader.fault(Notice::piece("M143", fields.span_of("at"), "the motion begins at t = 0", "движение начинается при t = 0"));
        return None;
    }
    Some(ClaimInstant::At(time))
}

/// A published formula. What is wrong with its dimensions is noted; any other fault is one of the file.
fn lenient<'a>(reader: &mut Reader<'a>, raw: &Raw<'a>, dimensions: &mut Text) -> Checked {
    let Some(formula) = &raw.formula else { return reader.nothing() };
    let checked = check(formula, &reader.scope, &Context::OUTPUT);
    let errors = || checked.faults.iter().filter(|f| f.severity == Severity::Error);
    let dimensional = errors().next().is_some() && errors().all(|f| DIMENSIONAL.contains(&f.code));
    if !dimensional {
        return reader.value(raw, &Context::OUTPUT, None);
    }
    if let Some(first) = errors().next()
        && dimensions.en.is_empty()
    {
        *dimensions = first.what.clone();
    }
    match crate::formula::lower(formula, &reader.scope, &mut reader.builder) {
        Ok(expr) => Checked { expr, kind: Kind::Unknown, depends: checked.depends, good: true },
        Err(fault) => {
            reader.report(raw.snippet.diagnose(fault));
            reader.nothing()
        }
    }
}

/// Notes that two sides differ in dimension.
fn differ(dimensions: &mut Text, words: [(&str, &str); 2], kinds: [Kind; 2]) {
    let [Kind::Known(a), Kind::Known(b)] = kinds else { return };
    if a.same(&b) || !dimensions.en.is_empty() {
        return;
    }
    let [(first, first_ru), (second, second_ru)] = words;
    *dimensions = Text::new(
        format!("{first} is in {}, {second} in {}", si_label(&a), si_label(&b)),
        format!("{first_ru} имеет размерность {}, {second_ru} — {}", si_label_ru(&a), si_label_ru(&b)),
    );
}

fn label(kind: Kind) -> String {
    match kind {
        Kind::Known(d) => si_label(&d),
        _ => String::new(),
    }
}
