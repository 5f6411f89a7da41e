//! The data of the interactive figures as compact JSON: shown units, about seven digits, at most [`POINTS`] points a curve.

use crate::figure::{Axis, Figure, Kind, Mark, Pen, decimate, style};
use crate::symbol;
use crate::wording::Word;
use serde_json::{Value, json};
use words::Language;

/// Points of a curve that a page keeps at least and at most, as long as all of its curves have no more than so many.
const POINTS: [usize; 2] = [4000, 20_000];
const MOST_NUMBERS: usize = 240_000;
/// Significant digits that a page keeps.
const DIGITS: usize = 7;
/// Curve colours on a dark ground: the same hues, lighter.
const DARK: [&str; 6] = ["#4aa8e0", "#f0803c", "#2fc296", "#e39cc6", "#f0b429", "#9ad4f5"];

/// Words that the script prints.
const WORDS: &[(&str, Word)] = &[
    ("help", Word::PlotHelp),
    ("reset", Word::ResetZoom),
    ("log", Word::LogAxis),
    ("rows", Word::RowsOf),
    ("noPositive", Word::NoPositive),
    ("theme", Word::Theme),
];

/// JSON of all figures of a page.
pub(super) fn write(figures: &[&Figure], language: Language) -> String {
    let words: serde_json::Map<String, Value> = WORDS.iter().map(|(key, word)| ((*key).into(), language.word(*word).into())).collect();
    let curves = figures.iter().map(|f| f.series.len()).sum::<usize>().max(1);
    let most = (MOST_NUMBERS / curves).clamp(POINTS[0], POINTS[1]);
    let figures: Vec<Value> = figures.iter().map(|f| figure(f, most, language)).collect();
    json!({"mark": language.decimal_mark().to_string(), "words": words, "figures": figures}).to_string()
}

fn figure(figure: &Figure, most: usize, language: Language) -> Value {
    let (size_x, size_y) = (figure.x.scale.size, figure.y.scale.size);
    let curves = figure.kind == Kind::Curves;
    let shared = curves && figure.series.windows(2).all(|w| w[0].x == w[1].x);
    let joint = if shared { joint_points(figure, most) } else { Vec::new() };
    let series: Vec<Value> = figure
        .series
        .iter()
        .enumerate()
        .map(|(i, s)| {
            let kept = match (shared, curves) {
                (true, _) => joint.clone(),
                (_, true) => decimate::buckets(&s.x, &[&s.y], most / 3),
                _ => decimate::plane(&s.x, &s.y, most / 2, most),
            };
            let (colour, dash) = style(i);
            let mut one = json!({
                "html": symbol::mathml(&s.name, language), "name": symbol::plain(&s.name, language), "label": s.label, "unit": figure.y.unit(i, language),
                "colour": [colour, DARK[i % DARK.len()]], "dash": dash,
                "t": figure.along.as_ref().map(|(axis, t)| rounded(t, &kept, axis.scale.size)),
                "x": if shared && i > 0 { Value::Null } else { rounded(&s.x, &kept, size_x) },
                "y": rounded(&s.y, &kept, size_y),
            });
            if s.pen == Pen::Dots {
                one["dots"] = true.into();
            }
            one
        })
        .collect();
    json!({
        "name": figure.name, "title": figure.title.plain(language),
        "plane": !curves, "equal": figure.kind == Kind::Plane { equal: true },
        "x": axis(&figure.x, language), "y": axis(&figure.y, language),
        "along": figure.along.as_ref().map(|(t, _)| axis(t, language)),
        "series": series,
        "marks": figure.marks.iter().map(|m| mark(m, size_x, size_y)).collect::<Vec<_>>(),
        "strip": figure.strip.iter().map(|h| json!([round(h.from / size_x), round(h.to / size_x), h.what])).collect::<Vec<_>>(),
    })
}

/// Points kept by curves that share x: few enough that the extremes of all of them fit.
fn joint_points(figure: &Figure, most: usize) -> Vec<usize> {
    let Some(first) = figure.series.first() else { return Vec::new() };
    let ys: Vec<&[f64]> = figure.series.iter().map(|s| s.y.as_slice()).collect();
    decimate::buckets(&first.x, &ys, (most / (1 + 2 * ys.len())).max(300))
}

fn axis(axis: &Axis, language: Language) -> Value {
    let symbol = axis.symbols.first().map_or(String::new(), |name| symbol::mathml(name, language));
    let name = axis.symbols.first().map_or("", String::as_str);
    json!({"name": name, "size": axis.scale.size, "symbol": symbol, "html": axis.html(language), "text": axis.plain(language), "unit": axis.scale.print(language), "log": axis.log})
}

fn mark(mark: &Mark, size_x: f64, size_y: f64) -> Value {
    match mark {
        Mark::Vertical { x, label } => json!([round(x / size_x), null, label]),
        Mark::Horizontal { y, label } => json!([null, round(y / size_y), label]),
        Mark::Point { x, y, label } => json!([round(x / size_x), round(y / size_y), label]),
    }
}

fn rounded(values: &[f64], kept: &[usize], size: f64) -> Value {
    kept.iter().map(|&i| round(values.get(i).copied().unwrap_or(f64::NAN) / size)).collect()
}

/// A number with few digits; whole numbers without `.0`; `null` for what JSON cannot hold.
fn round(x: f64) -> Value {
    if !x.is_finite() {
        return Value::Null;
    }
    let decimals = DIGITS - 1;
    let short: f64 = format!("{x:.decimals$e}").parse().unwrap_or(x);
    if short.fract() == 0.0 && short.abs() < 1e9 { json!(short as i64) } else { json!(short) }
}
