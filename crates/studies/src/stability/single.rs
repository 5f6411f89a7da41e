//! Stability of the machine as it is.

use super::asked::{About, Stability};
use super::point::{self, Care, Point};
use super::reduction::Reduction;
use super::show::{Shown, Words};
use crate::machine::Machine;
use crate::periodic::{json_of, multiplier_words, shown};
use crate::provenance;
use crate::results::{Body, Fact, Results, Rows};
use crate::watch::Watch;
use analysis::dataset::Column;
use analysis::studies::stability::{Criterion, Exponent, Scalar};
use analysis::{Dataset, Quantity};
use mechanics::model::Plot;
use serde_json::{Value, json};
use std::f64::consts::TAU;
use std::sync::Arc;
use words::{Notice, Text};

/// Places of a turn.
const PLACES: usize = 37;
/// Values that differ less, relatively, are one: rounding of formulas.
const SAME: f64 = 1e-12;
/// Steps of the search of an extreme, each of which leaves the golden share of the interval: the last is one of 1e-9 of a turn.
const HALVINGS: usize = 40;
/// The golden share.
const GOLDEN: f64 = 0.618_033_988_749_894_8;
/// Harmonics of ψ in JSON.
const HARMONICS: usize = 6;

/// Fills in the results.
pub(super) fn single(machine: &mut Machine, study: &Stability, results: &mut Results, watch: &mut Watch) -> Result<(), Notice> {
    let reduction = match &study.about {
        About::Running { angle, .. } => Some(Reduction::of(machine, *angle)?),
        About::Motion(_) => None,
    };
    let point = point::at(machine, study, reduction.as_ref(), Care::Full, watch)?;
    let mut data = Dataset { audits: point.audits.clone(), notes: point.notes.clone(), ..Dataset::default() };
    if let Some(reduction) = &reduction {
        table(machine, study, reduction, &mut data)?;
        results.plots = ["J", "k", "psi"].map(|y| Plot { title: Text::default(), x: None, y: vec![y.into()] }).into();
    }
    results.data = provenance::stamp(data, &machine.equations, &machine.model_hash);
    results.rows = Rows::All;
    facts(results, &point);
    if let Some(reduction) = &reduction {
        let (start, _) = point::running(machine, study)?;
        results.facts.extend(largest(reduction, start));
    }
    results.own.extend(to_json(&point));
    results.words.push(Words(&point).verdict());
    results.words.extend(Words(&point).resonance());
    results.words.extend(Words(&point).tongue());
    results.words.extend(Words(&point).harmonics());
    results.body = Body::After(Arc::new(Shown { reduction, scalar: point.scalar }));
    Ok(())
}

/// J, k, f and ψ over a turn.
fn table(machine: &mut Machine, study: &Stability, reduction: &Reduction, data: &mut Dataset) -> Result<(), Notice> {
    let (start, speed) = point::running(machine, study)?;
    let count = study.points.unwrap_or(PLACES);
    let places: Vec<f64> = (0..count).map(|k| start + TAU * speed.signum() * k as f64 / (count - 1) as f64).collect();
    let values: Vec<[f64; 3]> = places.iter().map(|phi| reduction.at(*phi)).collect();
    let unit = |name: &str, machine: &Machine| {
        machine.model.coordinates.iter().find(|c| c.name == name).map_or("rad".into(), |c| c.units[0].clone())
    };
    let name = reduction.graph.symbol_info(reduction.angle).name.clone();
    let psi: Vec<f64> = values.iter().map(|[j, k, _]| k / j).collect();
    let root = |v: &f64| if *v >= 0.0 { v.sqrt() } else { f64::NAN };
    let frequencies: Vec<f64> = psi.iter().map(root).collect();
    let column = |name: &str, (symbol, unit): (&str, &str), label: Text, values: Vec<f64>| {
        let quantity = Quantity { symbol: symbol.into(), label, ..Quantity::new(name, unit) };
        Column { quantity, values }
    };
    data.axis = Some(0);
    let angle = unit(&name, machine);
    data.columns.push(column(&name, (&name, &angle), Text::new("position", "положение"), places));
    let inertia = Text::new("reduced inertia", "приведённый момент инерции");
    data.columns.push(column("J", ("J", "kg m^2"), inertia, values.iter().map(|v| v[0]).collect()));
    if frequencies.iter().all(|v| v.is_finite()) {
        let label = Text::new("natural frequency of the held position", "собственная частота в этом положении");
        data.columns.push(column("k", ("k", "rad/s"), label, frequencies.clone()));
        let label = Text::new("the same in hertz", "она же в герцах");
        data.columns.push(column("f", ("f", "Hz"), label, frequencies.iter().map(|k| k / TAU).collect()));
    }
    data.columns.push(column(
        "psi",
        ("ψ", "1/s^2"),
        Text::new("square of the natural frequency of the held position", "квадрат собственной частоты в этом положении"),
        psi,
    ));
    Ok(())
}

/// The largest reduced inertia of a turn and its place, sought between places; none where it is the same everywhere.
fn largest(reduction: &Reduction, start: f64) -> Vec<Fact> {
    let inertia = |phi: f64| reduction.at(phi)[0];
    let step = TAU / PLACES as f64;
    let places: Vec<f64> = (0..PLACES).map(|k| start + step * k as f64).collect();
    let values: Vec<f64> = places.iter().map(|phi| inertia(*phi)).collect();
    let least = values.iter().copied().fold(f64::INFINITY, f64::min);
    let top = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    // of two alike the first
    let Some(k) = values.iter().position(|v| top - v <= SAME * top).filter(|_| top - least > SAME * top) else { return Vec::new() };
    let (mut low, mut high) = (places[k] - step, places[k] + step);
    for _ in 0..HALVINGS {
        let (a, b) = (high - GOLDEN * (high - low), low + GOLDEN * (high - low));
        if inertia(a) < inertia(b) { low = a } else { high = b }
    }
    let place = 0.5 * (low + high);
    let label = Text::new("largest reduced inertia of a turn", "наибольший за оборот приведённый момент инерции");
    let at = Text::new("position in which it is largest", "положение, в котором он наибольший");
    let turned = (place - start).rem_euclid(TAU);
    vec![Fact::new("J_max", "J_max", "kg m^2", inertia(place), label), Fact::new("phi_J_max", "φ_J", "rad", start + turned, at)]
}

fn facts(results: &mut Results, point: &Point) {
    let text = Text::new;
    let mut fact =
        |name: &str, symbol: &str, unit: &str, value: f64, label: Text| results.facts.push(Fact::new(name, symbol, unit, value, label));
    fact("period", "T", "s", point.period, text("period of the coefficients", "период коэффициентов"));
    if let Some(growth) = point.growth {
        fact("growth", "σ", "1/s", growth, text("greatest growth of a disturbance", "наибольший показатель роста возмущений"));
    }
    if let Some(scalar) = &point.scalar {
        fact("d", "d", "1", scalar.d(), text("of Mathieu's equation", "коэффициент уравнения Матьё"));
        fact("e", "e", "1", scalar.e(), text("of Mathieu's equation", "коэффициент уравнения Матьё"));
        if let Some(depth) = scalar.depth() {
            fact("mu", "μ", "1", depth, text("depth of the modulation", "глубина модуляции"));
        }
        if scalar.decay != 0.0 {
            fact("eta", "η", "1", scalar.eta(), text("damping 2h/ω", "сопротивление 2h/ω"));
        }
        let label = text("trace of the monodromy matrix of Hill's equation", "след матрицы монодромии уравнения Хилла");
        fact("trace", "tr M", "1", scalar.trace(), label);
        let label = text("the same of Mathieu's equation", "то же для уравнения Матьё");
        fact("trace_of_mathieu", "tr M_M", "1", scalar.trace_of_mathieu(), label);
    }
    for (k, m) in point.multipliers.iter().enumerate() {
        let label = Text::new(format!("multiplier {}", k + 1), format!("мультипликатор {}", k + 1));
        let fact = Fact::new(&format!("multiplier_{}", k + 1), &format!("mu_{}", k + 1), "1", shown(m), label);
        results.facts.push(fact.with_words(multiplier_words(m)));
    }
}

fn to_json(point: &Point) -> serde_json::Map<String, Value> {
    let exponent =
        |s: &Option<Exponent>| s.map_or(Value::Null, |s| json!({"growth": s.growth, "frequency": s.frequency, "error": s.error}));
    let mut own = crate::results::fields(json!({
        "multipliers": point.multipliers.iter().map(json_of).collect::<Vec<_>>(),
        "exponents": point.exponents.iter().map(exponent).collect::<Vec<_>>(),
        "verdict": point.verdict.key(),
        "liouville": point.liouville,
    }));
    if let Some(scalar) = &point.scalar {
        own.extend(of_scalar(scalar));
    }
    if let Some(r) = &point.resonance {
        let value = json!({"kind": r.tongue.key(), "order": r.order, "frequencies": r.frequencies, "forcing": r.forcing, "detuning": r.detuning, "name": r.name()});
        own.insert("resonance".into(), value);
    }
    own
}

/// Mathieu's form and the three verdicts.
pub(super) fn of_scalar(scalar: &Scalar) -> serde_json::Map<String, Value> {
    let verdicts: serde_json::Map<String, Value> =
        Criterion::ALL.iter().map(|by| (by.key().to_owned(), json!(scalar.verdict(*by).key()))).collect();
    let harmonics = scalar.harmonics();
    crate::results::fields(json!({
        "tongue": scalar.tongue(),
        "mathieu": {"d": scalar.d(), "e": scalar.e(), "mu": scalar.depth(), "eta": scalar.eta(), "verdict": scalar.verdict(Criterion::Mathieu).key()},
        "verdicts": verdicts,
        "harmonics": harmonics[..harmonics.len().min(HARMONICS)],
    }))
}
