//! Curves of folds, period doublings, Hopf and torus points: fields of JSON, sentences and their picture.

use super::asked::{Beside, Branched, symbol, unit};
use super::phrases::{end_in_words, ends_in_words, name, state};
use crate::machine::Machine;
use crate::results::{Fact, Results};
use analysis::Quantity;
use analysis::dataset::Column;
use analysis::studies::continuation::{Crease, Diagram, Place, What};
use report::Figure;
use report::figure::{Axis, Kind, Mark, Pen, Series};
use serde_json::{Value, json};
use words::{Language, Text};

/// Puts the curves into results.
pub(super) fn tell(machine: &Machine, study: &Branched, diagram: &Diagram, results: &mut Results) {
    let Some(second) = &study.second else { return };
    let [from, to] = second.range;
    results.own.insert("second".into(), json!({"name": second.name, "unit": unit(machine, &second.name), "from": from, "to": to}));
    let points = |(k, crease): (usize, &Crease)| -> Vec<Value> {
        crease.curve.places.iter().map(|place| point(machine, (k, crease.what), place)).collect()
    };
    results.own.insert("folds".into(), diagram.creases.iter().enumerate().flat_map(points).collect());
    let special = |(k, crease): (usize, &Crease)| -> Vec<Value> {
        crease.curve.special.iter().map(|(_, special)| point(machine, (k, special.what), &special.place)).collect()
    };
    results.own.insert("cusps".into(), diagram.creases.iter().enumerate().flat_map(special).collect());
    let curve = |(k, crease): (usize, &Crease)| {
        let place = |place: Option<&Place>| place.map_or(Value::Null, |place| point(machine, (k, crease.what), place));
        let (first, last) = (place(crease.curve.places.first()), place(crease.curve.places.last()));
        let ends: Vec<Value> = crease.curve.ends.iter().flatten().map(|end| json!(end_in_words(machine, end).en)).collect();
        json!({"kind": crease.what.key(), "from": crease.from, "points": crease.curve.places.len(), "ends": ends, "first": first, "last": last})
    };
    results.own.insert("fold_curves".into(), diagram.creases.iter().enumerate().map(curve).collect());
    let met = diagram.creases.iter().flat_map(|crease| &crease.curve.special);
    for (k, (_, special)) in met.enumerate() {
        let what = name(special.what);
        let label = Text::new(format!("{}: {}", letter(k), what.en), format!("{}: {}", letter(k), what.ru));
        let [first, other] = Crease::plane(&special.place);
        let fact = Fact::new(&format!("cusp_{}", k + 1), &symbol(machine, &study.name), &unit(machine, &study.name), first, label);
        results.facts.push(fact.with_words(value(machine, &second.name, other)));
    }
    for (k, crease) in diagram.creases.iter().enumerate() {
        results.words.push(about(machine, (study, second), (k, crease)));
    }
    if diagram.creases.is_empty() && diagram.lone.is_empty() {
        results.words.push(Text::new(
            "There is no fold, period doubling, Hopf or torus point to follow over the second parameter.",
            "Складок, удвоений периода, точек Хопфа и рождения тора, которые можно проследить вдоль второго параметра, нет.",
        ));
    }
    for k in &diagram.lone {
        results.words.push(Text::new(
            format!("From point {} no curve over the second parameter was found.", k + 1),
            format!("От точки {} кривая вдоль второго параметра не найдена.", k + 1),
        ));
    }
}

/// Marks of special points of curves: A, B, ..., Z, A2, ...
fn letter(k: usize) -> String {
    let letter = char::from(b'A' + (k % 26) as u8);
    if k < 26 { letter.to_string() } else { format!("{letter}{}", k / 26 + 1) }
}

fn point(machine: &Machine, (curve, what): (usize, What), place: &Place) -> Value {
    let [parameter, second] = Crease::plane(place);
    let mut fields = state(machine, place);
    fields.insert("parameter".into(), json!(parameter));
    fields.insert("second".into(), json!(second));
    fields.insert("kind".into(), json!(what.key()));
    fields.insert("curve".into(), json!(curve));
    Value::Object(fields)
}

/// `F = 0.2 N`.
fn value(machine: &Machine, of: &str, value: f64) -> Text {
    let number = report::number::short(value, 8, Language::En);
    let unit = unit(machine, of);
    let written = |number: &str, language: Language| {
        let printed = if unit == "1" { String::new() } else { format!(" {}", report::unit::print(&unit, language)) };
        format!("{} = {number}{printed}", symbol(machine, of))
    };
    Text::new(written(&number, Language::En), written(&number.replace('.', ","), Language::Ru))
}

/// A curve in a sentence.
fn about(machine: &Machine, (study, second): (&Branched, &Beside), (k, crease): (usize, &Crease)) -> Text {
    let ends = |i: usize| {
        let values = || crease.curve.places.iter().map(|place| Crease::plane(place)[i]);
        let short = |x: f64| report::number::short(x, 6, Language::En);
        [short(values().fold(f64::INFINITY, f64::min)), short(values().fold(f64::NEG_INFINITY, f64::max))]
    };
    let printed = |of: &str, language: Language| {
        let unit = unit(machine, of);
        if unit == "1" { String::new() } else { format!(" {}", report::unit::print(&unit, language)) }
    };
    let ([a, b], [c, d]) = (ends(0), ends(1));
    let (p, s) = (symbol(machine, &study.name), symbol(machine, &second.name));
    let why = ends_in_words(machine, &crease.curve.ends);
    let list = |pick: fn(&Text) -> &str| why.iter().map(pick).collect::<Vec<_>>().join("; ");
    let (en, ru) = match crease.what {
        What::Doubling => ("period doublings", "удвоений периода"),
        What::Hopf => ("Hopf points", "точек бифуркации Хопфа"),
        What::Torus => ("torus points", "точек рождения тора"),
        _ => ("folds", "складок"),
    };
    let comma = |text: &str| text.replace('.', ",");
    let (pu, su) = (printed(&study.name, Language::En), printed(&second.name, Language::En));
    let (pr, sr) = (printed(&study.name, Language::Ru), printed(&second.name, Language::Ru));
    Text::new(
        format!(
            "Curve {} of {en}, from point {}: {p} from {a} to {b}{pu}, {s} from {c} to {d}{su}. Where it ends: {}.",
            k + 1,
            crease.from + 1,
            list(|t| &t.en)
        ),
        format!(
            "Кривая {} {ru}, от точки {}: {p} от {} до {}{pr}, {s} от {} до {}{sr}. Где кончается: {}.",
            k + 1,
            crease.from + 1,
            comma(&a),
            comma(&b),
            comma(&c),
            comma(&d),
            list(|t| &t.ru)
        ),
    )
}

/// The plane of both parameters.
#[derive(Debug)]
pub(super) struct Chart {
    axes: [Quantity; 2],
    /// Kind and points of each curve.
    curves: Vec<(What, Vec<[f64; 2]>)>,
    marks: Vec<[f64; 2]>,
}

impl Chart {
    /// None without curves.
    pub(super) fn new(machine: &Machine, study: &Branched, diagram: &Diagram) -> Option<Chart> {
        let second = study.second.as_ref().filter(|_| !diagram.creases.is_empty())?;
        let axis = |name: &str| Quantity { symbol: symbol(machine, name), ..Quantity::new(name, &unit(machine, name)) };
        let points = |crease: &Crease| (crease.what, crease.curve.places.iter().map(Crease::plane).collect());
        let special = diagram.creases.iter().flat_map(|crease| &crease.curve.special);
        Some(Chart {
            axes: [axis(&study.name), axis(&second.name)],
            curves: diagram.creases.iter().map(points).collect(),
            marks: special.map(|(_, special)| Crease::plane(&special.place)).collect(),
        })
    }

    pub(super) fn figure(&self, language: Language) -> Figure {
        let axis = |i: usize| {
            let values = self.curves.iter().flat_map(|(_, points)| points.iter().map(move |p| p[i])).collect();
            Axis::of_columns(&[&Column { quantity: self.axes[i].clone(), values }])
        };
        let kinds = [
            (What::Fold, Text::new("folds", "складки")),
            (What::Doubling, Text::new("period doublings", "удвоения периода")),
            (What::Hopf, Text::new("Hopf points", "бифуркации Хопфа")),
            (What::Torus, Text::new("torus points", "рождение тора")),
        ];
        let there = |what: What| self.curves.iter().any(|(of, _)| *of == what);
        // what there is none of has no line in the legend
        let series = kinds.into_iter().filter(|(what, _)| there(*what)).map(|(what, label)| {
            let of = self.curves.iter().filter(|(of, _)| *of == what);
            let points: Vec<[f64; 2]> = of.flat_map(|(_, points)| points.iter().copied().chain([[f64::NAN; 2]])).collect();
            Series {
                name: self.axes[1].symbol.clone(),
                label: language.text(&label).into(),
                x: points.iter().map(|p| p[0]).collect(),
                y: points.iter().map(|p| p[1]).collect(),
                pen: Pen::Line,
            }
        });
        let [p, s] = [0, 1].map(|i| self.axes[i].symbol.clone());
        let title =
            language.pick(format!("Curves of special points over {p} and {s}"), format!("Кривые особых точек на плоскости {p}, {s}"));
        Figure {
            name: "folds".into(),
            title: title.into(),
            kind: Kind::Plane { equal: false },
            x: axis(0),
            y: axis(1),
            series: series.collect(),
            marks: self.marks.iter().enumerate().map(|(k, [x, y])| Mark::Point { x: *x, y: *y, label: letter(k) }).collect(),
            along: None,
            strip: Vec::new(),
            field: None,
        }
    }
}
