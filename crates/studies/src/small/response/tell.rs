//! A response in columns and fields of JSON.

use super::found::{Order, ResponseFound};
use crate::small::modes::changes_json;
use crate::small::strands::Slack;
use analysis::dataset::{Column, Missing};
use analysis::studies::extremes::{Antiresonance, Resonance};
use analysis::studies::modes::Complex;
use analysis::studies::response::{Point, magnitude, phase};
use analysis::studies::superposition::{self, Superposed};
use analysis::{Dataset, Quantity};
use serde_json::{Map, Value, json};
use std::f64::consts::TAU;
use words::Text;

/// ω, f, then amplitude, phase, real and imaginary part and dynamic coefficient of each output.
pub(super) fn columns(omegas: &[f64], points: &[Point], outputs: &[Quantity]) -> Vec<Column> {
    let column = |name: String, symbol: String, unit: &str, label: Text, values: Vec<f64>| Column {
        quantity: Quantity { name, symbol, unit: unit.into(), label, display: None },
        values,
    };
    let omega = Text::new("frequency of the load", "частота нагрузки");
    let mut list = vec![
        column("omega".into(), "omega".into(), "rad/s", omega.clone(), omegas.to_vec()),
        column("f".into(), "f".into(), "Hz", omega, omegas.iter().map(|w| w / TAU).collect()),
    ];
    for (k, q) in outputs.iter().enumerate() {
        let of = |pick: fn(Complex) -> f64| points.iter().map(|p| pick(p.outputs[k])).collect::<Vec<f64>>();
        let named = |en: &str, ru: &str| Text::new(format!("{en} of {}", q.name), format!("{ru} {}", q.name));
        let mut push = |tail: &str, unit: &str, label: Text, values: Vec<f64>| {
            list.push(column(format!("{}_{tail}", q.name), format!("{}_{tail}", q.symbol), unit, label, values));
        };
        push("amplitude", &q.unit, named("amplitude", "амплитуда"), of(magnitude));
        push("phase", "rad", named("phase", "фаза"), of(phase));
        push("re", &q.unit, named("real part", "вещественная часть"), of(|z| z.0));
        push("im", &q.unit, named("imaginary part", "мнимая часть"), of(|z| z.1));
        let gain: Vec<f64> = points.iter().map(|p| coefficient(p, k)).collect();
        if points.iter().any(|p| magnitude(p.still[k]) > 0.0 && magnitude(p.still[k]).is_finite()) {
            push("gain", "1", named("dynamic coefficient", "динамический коэффициент"), gain);
        }
    }
    list
}

/// |X| over what the load does statically; none where that is nothing or beyond all bounds.
fn coefficient(p: &Point, k: usize) -> f64 {
    let still = magnitude(p.still[k]);
    if still > 0.0 && still.is_finite() { magnitude(p.outputs[k]) / still } else { f64::NAN }
}

/// Says what the values of the columns of an output mean that are no finite numbers.
pub(super) fn state(data: &mut Dataset, output: &str) {
    let infinite = Text::new(
        "infinite: a natural frequency without damping, excited by the load",
        "бесконечна: собственная частота без затухания, возбуждаемая нагрузкой",
    );
    let phase = Text::new("no phase where the amplitude is zero or infinite", "фазы нет: амплитуда равна нулю или бесконечна");
    let still = Text::new(
        "no dynamic coefficient: statically the load moves this nothing at all, or without bound, or it contains a prescribed motion or the load itself",
        "коэффициента динамичности нет: статически нагрузка эту величину не меняет или меняет неограниченно, либо в неё входит само заданное движение или сама нагрузка",
    );
    let sum = Text::new(
        "no largest value over a period: no common period, an infinite amplitude, or an output that is not linear in reactions",
        "наибольшего за период значения нет: нет общего периода, амплитуда бесконечна или величина нелинейно зависит от реакций",
    );
    let names: Vec<String> = data.columns.iter().map(|c| c.quantity.name.clone()).collect();
    for name in names {
        match name.strip_prefix(output).and_then(|rest| rest.strip_prefix('_')) {
            Some("phase") => data.state(&name, Missing::Absent, phase.clone()),
            Some("gain") => {
                data.state(&name, Missing::Absent, still.clone());
                data.state(&name, Missing::Unbounded, infinite.clone());
            }
            Some("largest") => {
                data.state(&name, Missing::Absent, sum.clone());
                data.state(&name, Missing::Unbounded, infinite.clone());
            }
            Some(tail) if matches!(tail, "re" | "im") || tail.starts_with("amplitude") => {
                data.state(&name, Missing::Unbounded, infinite.clone());
            }
            _ => {}
        }
    }
}

/// The fields of the study in JSON.
pub(super) fn to_json(study: &str, found: &ResponseFound) -> Map<String, Value> {
    let mut own = Map::new();
    own.insert("study".into(), json!(study));
    // a label is for readers, programs know the load by its name
    let name = found.study.load.as_ref().filter(|name| found.load.en.ends_with(&format!("({name})")));
    own.insert("load".into(), json!(name.unwrap_or(&found.load.en)));
    let name = |k: usize| found.outputs.get(k).map_or("", |q| q.name.as_str());
    let resonance = |(r, order): (&Resonance, &f64)| {
        json!({"output": name(r.output), "order": order, "omega": r.omega / order, "f": r.omega / order / TAU, "load_omega": r.omega, "amplitude": r.amplitude, "phase": r.phase,
            "dynamic_coefficient": r.gain, "mode": r.mode.map(|m| m + 1), "quality_factor": r.quality, "half_power": r.half_power})
    };
    own.insert("resonances".into(), found.resonances.iter().zip(&found.resonance_orders).map(resonance).collect());
    let anti = |(a, order): (&Antiresonance, &f64)| {
        let absorbs: Vec<Value> = a
            .absorbs
            .iter()
            .map(|(i, share)| json!({"coordinate": found.coordinates.get(*i).map(|q| q.name.clone()), "energy_share": share, "bodies": found.bodies.get(*i)}))
            .collect();
        json!({"output": name(a.output), "order": order, "omega": a.omega / order, "f": a.omega / order / TAU, "load_omega": a.omega, "amplitude": a.amplitude, "zero": a.exact, "absorbed_by": absorbs})
    };
    own.insert("antiresonances".into(), found.antiresonances.iter().zip(&found.antiresonance_orders).map(anti).collect());
    if let Some(modes) = &found.modes {
        let one = |m: &analysis::studies::modes::Mode| {
            let quality = if m.ratio == 0.0 { Value::Null } else { json!(0.5 / m.ratio) };
            json!({"omega": m.omega, "omega_d": m.damped, "damping_ratio": m.ratio, "quality_factor": quality, "kind": m.kind.key()})
        };
        own.insert("modes".into(), modes.modes.iter().map(one).collect());
    }
    own.insert("at_frequency".into(), found.own.as_ref().map_or(Value::Null, |p| point(found, p)));
    own.insert("orders".into(), found.orders.iter().map(|o| order_json(found, o)).collect());
    own.insert("superposed".into(), found.superposed.as_ref().map_or(Value::Null, |s| superposed_json(found, s)));
    if !found.changes.is_empty() {
        own.insert("changes".into(), json!(changes_json(&found.changes)));
    }
    let slack = |s: &Slack| s.bands.iter().map(|[from, to]| json!({"of": s.name, "from": from, "to": to})).collect::<Vec<_>>();
    own.insert("slack".into(), json!(found.slack.iter().filter(|s| s.contact.is_none()).flat_map(slack).collect::<Vec<_>>()));
    let touching = |s: &Slack| {
        s.contact.map(
            |(change, level)| json!({"of": s.name, "change": change, "bands": s.bands, "load_share": level.share, "omega": level.omega}),
        )
    };
    own.insert("touching".into(), found.slack.iter().filter_map(touching).collect());
    own.insert("shapes".into(), found.shapes.iter().map(|p| point(found, p)).collect());
    own
}

fn order_json(found: &ResponseFound, order: &Order) -> Value {
    let mut value = order.own.as_ref().map_or_else(|| json!({}), |p| point(found, p));
    value["order"] = json!(order.order);
    value
}

/// Static part, extremes and their instants over a period.
fn superposed_json(found: &ResponseFound, s: &Superposed) -> Value {
    let one = |r: &superposition::Range| {
        let value = |v: (f64, f64)| json!({"value": v.0, "t": v.1, "phase": v.1 * s.omega});
        json!({"mean": r.mean, "max": value(r.max), "min": value(r.min), "largest": value(r.largest)})
    };
    let outputs: Map<String, Value> = found.outputs.iter().zip(&s.outputs).map(|(q, r)| (q.name.clone(), one(r))).collect();
    json!({"omega": s.omega, "period": s.period, "outputs": outputs, "residual": s.residual})
}

/// One frequency: outputs and the deformed shape.
fn point(found: &ResponseFound, p: &Point) -> Value {
    let complex = |z: Complex| json!({"amplitude": magnitude(z), "phase": phase(z), "re": z.0, "im": z.1});
    let outputs: Map<String, Value> = found
        .outputs
        .iter()
        .enumerate()
        .map(|(k, q)| {
            let mut value = complex(p.outputs[k]);
            value["static"] = json!(magnitude(p.still[k]));
            value["dynamic_coefficient"] = json!(coefficient(p, k));
            (q.name.clone(), value)
        })
        .collect();
    let shape: Map<String, Value> = found.coordinates.iter().zip(&p.coordinates).map(|(q, z)| (q.name.clone(), complex(*z))).collect();
    let place: Map<String, Value> = found.coordinates.iter().zip(&p.place).map(|(q, v)| (q.name.clone(), json!(v))).collect();
    json!({"omega": p.omega, "f": p.omega / TAU, "outputs": outputs, "shape": shape, "equilibrium": place})
}

pub(super) fn own_column(q: &Quantity, tail: &str, label: Text, values: Vec<f64>) -> Column {
    let quantity =
        Quantity { name: format!("{}_{tail}", q.name), symbol: format!("{}_{tail}", q.symbol), unit: q.unit.clone(), label, display: None };
    Column { quantity, values }
}
