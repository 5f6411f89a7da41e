//! The study `response`: forced oscillations over the frequency of a harmonic load.

use crate::failure::Trouble;
use crate::pipeline::Machine;
use crate::provenance;
use crate::small::{Small, about_rest, timing_notes};
use analysis::dataset::Column;
use analysis::studies::extremes::{Antiresonance, Resonance, extremes};
use analysis::studies::modes::{Complex, Kind, Modes, Normalisation, modes};
use analysis::studies::response::{self as forced, Forced, Point, Source, magnitude, phase};
use analysis::{Dataset, Fault, Quantity};
use mechanics::model::Response as Study;
use serde_json::{Map, Value, json};
use std::f64::consts::TAU;
use symbolic::equations::Role;
use symbolic::linear::HarmonicLoad;
use symbolic::{Equations, Expr, SymbolId, Text};

/// Frequencies of an automatic grid.
const POINTS: usize = 401;
/// Points on each side of a natural frequency, in half-widths of the resonance.
const NEAR: [f64; 12] = [0.05, 0.1, 0.2, 0.35, 0.5, 0.75, 1.0, 1.5, 2.0, 3.0, 5.0, 8.0];

/// What the study found.
#[derive(Clone, Debug)]
pub struct ResponseFound {
    /// The study.
    pub study: Study,
    /// A column for the frequency and five for each output.
    pub data: Dataset,
    /// What ended it early.
    pub trouble: Option<Trouble>,
    /// Names of the outputs.
    pub outputs: Vec<Quantity>,
    /// Peaks of each output.
    pub resonances: Vec<Resonance>,
    /// Zeros or least values of each output.
    pub antiresonances: Vec<Antiresonance>,
    /// Modes of the machine as the file has it.
    pub modes: Option<Modes>,
    /// The response at the frequency that the file gives.
    pub own: Option<Point>,
    /// Motions at the frequencies asked for.
    pub shapes: Vec<Point>,
    /// The coordinates.
    pub coordinates: Vec<Quantity>,
    /// Names of the bodies that each coordinate moves.
    pub bodies: Vec<Vec<String>>,
    /// Name of the load, or of the parameter that is its frequency.
    pub load: Text,
}

/// Makes the study.
pub fn find(machine: &Machine, study: &Study) -> ResponseFound {
    let mut out = ResponseFound {
        study: study.clone(),
        data: Dataset::default(),
        trouble: None,
        outputs: Vec::new(),
        resonances: Vec::new(),
        antiresonances: Vec::new(),
        modes: None,
        own: None,
        shapes: Vec::new(),
        coordinates: Vec::new(),
        bodies: bodies(machine),
        load: Text::default(),
    };
    if let Err(fault) = about_rest(machine, &study.guess).and_then(|small| sweep(machine, study, small, &mut out)) {
        out.data.partial = true;
        out.trouble = Some(Trouble::from(fault));
    }
    out.data = provenance::stamp(out.data, &machine.equations, &machine.model_hash);
    out
}

fn sweep(machine: &Machine, study: &Study, mut small: Small, out: &mut ResponseFound) -> Result<(), Fault> {
    let names = small.machine.coordinates().to_vec();
    let matrices = small.machine.at(&small.place)?;
    let found = modes(&matrices, &names, Normalisation::Largest)?;
    let (source, parameter) = source(study, &mut small)?;
    out.load = load_name(study, &small, &source, parameter);
    let (quantities, formulas) = observed(study, &machine.equations);
    let notes = timing_notes(&small.machine);
    let own_value = parameter.map(|p| small.machine.value(p));
    let mut forced = Forced::new(&mut small.machine, &small.place, source, parameter, &formulas)?;
    let own = forced.own_frequency()?.filter(|w| *w > 0.0);
    let omegas = grid(study, &found, own)?;
    forced.refer(own.unwrap_or(omegas[0]))?;
    let points = omegas.iter().map(|w| forced.at(*w)).collect::<Result<Vec<Point>, Fault>>()?;
    out.shapes = study.shapes.iter().map(|w| forced.at(*w)).collect::<Result<_, _>>()?;
    out.own = own.map(|w| forced.at(w)).transpose()?;
    (out.resonances, out.antiresonances) = extremes(&mut forced, &found, &points, quantities.len())?;
    if let Some(value) = own_value {
        forced.restore(value)?;
    }
    let from_sine = forced.from_sine();
    out.data = Dataset { axis: Some(0), columns: columns(&points, &quantities), notes, ..Dataset::default() };
    out.data.notes.extend(found.notes.iter().cloned());
    out.data.notes.push(reference(from_sine));
    out.coordinates = names;
    out.outputs = quantities;
    out.modes = Some(found);
    Ok(())
}

/// Bodies with mass whose place or angle changes with each coordinate, directly or with what they stand on.
fn bodies(machine: &Machine) -> Vec<Vec<String>> {
    let model = &machine.model;
    let moves = |symbol: SymbolId| -> Vec<String> {
        let mut moved = vec![false; model.frames.len()];
        for (i, frame) in model.frames.iter().enumerate().skip(1) {
            let (own, at): (Vec<Expr>, bool) = match &frame.origin {
                mechanics::model::Origin::Vector(v) => (v.to_vec(), false),
                mechanics::model::Origin::Point(p) => {
                    let point = &model.points[p.index()];
                    (point.at.to_vec(), moved[point.on.index()])
                }
            };
            let formulas: Vec<Expr> = own.into_iter().chain(frame.rotations.iter().map(|r| r.1)).collect();
            moved[i] = at || moved[frame.on.index()] || model.graph.symbols_in(&formulas).contains(&symbol);
        }
        let heavy = model.frames.iter().zip(&moved).filter(|(f, m)| **m && f.mass.is_some());
        heavy.map(|(f, _)| f.name.clone()).collect()
    };
    model.coordinates.iter().map(|c| moves(c.symbols[0])).collect()
}

fn reference(from_sine: bool) -> Text {
    let wave = if from_sine { "sin ωt" } else { "cos ωt" };
    Text::new(
        format!("the load is {wave}; a motion is amplitude times {wave} shifted by the phase, negative when it lags"),
        format!("нагрузка меняется как {wave}; движение – амплитуда, умноженная на {wave} со сдвигом фазы, отрицательным при отставании"),
    )
}

/// The load and the parameter that is its frequency.
fn source(study: &Study, small: &mut Small) -> Result<(Source, Option<usize>), Fault> {
    let Some(name) = &study.load else {
        let loads = small.machine.linear().loads.clone();
        let (index, parameter) = choose(study, small, &loads)?;
        return Ok((Source::OfEquations(index), parameter));
    };
    if let Some(i) = small.machine.coordinates().iter().position(|q| q.name == *name) {
        return Ok((Source::Unit(i), None));
    }
    let equations = small.machine.equations().clone();
    let Some(applied) = equations.applied.iter().find(|a| a.name == *name) else {
        let mut names: Vec<String> = equations.applied.iter().map(|a| a.name.clone()).collect();
        names.extend(small.machine.coordinates().iter().map(|q| q.name.clone()));
        let what = Text::new(format!("there is no load `{name}`"), format!("нет нагрузки `{name}`"));
        return Err(Fault::unknown(what, &names));
    };
    let Some((mean, loads)) = small.machine.harmonics_of(&applied.forces) else { return Err(forced::without_load()) };
    if loads.is_empty() {
        // a constant force takes any frequency with its value as amplitude
        let sines = small.machine.zeros();
        return Ok((Source::Given { rate: None, parts: mean.into_iter().chain(sines).collect() }, None));
    }
    let (index, parameter) = choose(study, small, &loads)?;
    let load = &loads[index];
    Ok((Source::Given { rate: Some(load.rate), parts: load.cos.iter().chain(&load.sin).copied().collect() }, parameter))
}

/// Which of the loads is meant, and the parameter that sets its rate.
fn choose(study: &Study, small: &Small, loads: &[HarmonicLoad]) -> Result<(usize, Option<usize>), Fault> {
    if loads.is_empty() {
        return Err(forced::without_load());
    }
    let setting: Vec<Vec<usize>> = loads.iter().map(|l| parameters_of(small, l.rate)).collect();
    if let Some(name) = &study.frequency {
        let names: Vec<String> = small.machine.parameters().iter().map(|p| p.name.clone()).collect();
        let what = || Text::new(format!("no load has the frequency `{name}`"), format!("нет нагрузки с частотой `{name}`"));
        let Some(wanted) = small.machine.parameter(name) else { return Err(Fault::unknown(what(), &names)) };
        let Some(index) = setting.iter().position(|list| list.contains(&wanted)) else { return Err(Fault::unknown(what(), &names)) };
        return Ok((index, Some(wanted)));
    }
    let mut all: Vec<usize> = setting.iter().flatten().copied().collect();
    all.sort_unstable();
    all.dedup();
    match all[..] {
        [] => Ok((0, None)),
        [only] => Ok((setting.iter().position(|list| list.contains(&only)).unwrap_or(0), Some(only))),
        _ => Err(forced::ambiguous(&all.iter().map(|p| small.machine.parameters()[*p].name.clone()).collect::<Vec<_>>())),
    }
}

/// Parameters that a rate depends on, through definitions too.
fn parameters_of(small: &Small, rate: Expr) -> Vec<usize> {
    let linear = small.machine.linear();
    let equations = small.machine.equations();
    let mut open: Vec<SymbolId> = linear.graph.symbols_in(&[rate]);
    let mut found = Vec::new();
    while let Some(symbol) = open.pop() {
        if let Some(i) = equations.parameters.iter().position(|p| p.symbol == symbol) {
            found.push(i);
        } else if let Some((_, formula)) = linear.definitions.iter().find(|(s, _)| *s == symbol) {
            open.extend(linear.graph.symbols_in(&[*formula]));
        }
    }
    found.sort_unstable();
    found.dedup();
    found
}

fn load_name(study: &Study, small: &Small, source: &Source, parameter: Option<usize>) -> Text {
    let frequency = parameter.map(|p| small.machine.parameters()[p].name.clone());
    match (source, &study.load, frequency) {
        (Source::Unit(_), Some(name), _) => Text::new(format!("unit load on {name}"), format!("единичная нагрузка по {name}")),
        (_, Some(name), _) => Text::same(name.clone()),
        (_, None, Some(p)) => Text::new(format!("the loads of frequency {p}"), format!("нагрузки частоты {p}")),
        (_, None, None) => Text::new("the harmonic load", "гармоническая нагрузка"),
    }
}

/// The outputs wanted: those named, else the coordinates and the user's outputs.
fn observed(study: &Study, equations: &Equations) -> (Vec<Quantity>, Vec<Expr>) {
    let wanted = |o: &&symbolic::equations::Output| match &study.outputs[..] {
        [] => matches!(o.role, Role::Coordinate),
        names => names.contains(&o.name),
    };
    let quantity = |o: &symbolic::equations::Output| {
        let info = equations.graph.symbol_info(o.symbol);
        let bare = equations.notation.iter().find(|(n, _)| *n == info.name).map_or(&info.name, |(_, s)| s);
        let symbol = format!("{bare}{}", "'".repeat(usize::from(info.primes)));
        Quantity { name: o.name.clone(), symbol, unit: o.unit.clone(), label: o.label.clone(), display: o.display.clone() }
    };
    let mut list: Vec<&symbolic::equations::Output> = equations.outputs.iter().filter(wanted).collect();
    // the order asked for
    if !study.outputs.is_empty() {
        list.sort_by_key(|o| study.outputs.iter().position(|n| *n == o.name));
    }
    (list.iter().map(|o| quantity(o)).collect(), list.iter().map(|o| o.formula).collect())
}

/// Equidistant frequencies; without a wish for their number also more of them about the natural frequencies.
fn grid(study: &Study, found: &Modes, own: Option<f64>) -> Result<Vec<f64>, Fault> {
    let natural: Vec<f64> = found.modes.iter().filter(|m| m.kind != Kind::RigidBody && m.omega > 0.0).map(|m| m.omega).collect();
    let (low, high) = natural.iter().copied().chain(own).fold((f64::INFINITY, 0.0_f64), |(l, h), w| (l.min(w), h.max(w)));
    let (low, high) = if high > 0.0 { (low, high) } else { (1.0, 1.0) };
    let points = study.points.unwrap_or(POINTS);
    let [from, to] = study.range.unwrap_or(if study.log { [0.1 * low, 10.0 * high] } else { [0.01 * low.min(high), 2.0 * high] });
    if !(from >= 0.0 && to > from) || (study.log && from == 0.0) {
        return Err(forced::bad_range(from, to));
    }
    let share = |k: usize| k as f64 / (points - 1).max(1) as f64;
    let place = |k: usize| match () {
        () if k == 0 => from,
        () if k + 1 == points => to,
        () if study.log => from * (to / from).powf(share(k)),
        () => from + (to - from) * share(k),
    };
    let mut list: Vec<f64> = (0..points).map(place).collect();
    if study.points.is_none() {
        for m in found.modes.iter().filter(|m| m.kind == Kind::Oscillation) {
            let half = m.omega * m.ratio.abs().max(1e-3);
            list.extend(NEAR.iter().flat_map(|s| [m.damped - s * half, m.damped + s * half]));
        }
        list.extend(own);
        list.retain(|w| (from..=to).contains(w));
        list.sort_by(f64::total_cmp);
        list.dedup();
    }
    Ok(list)
}

/// ω, f, then amplitude, phase, real and imaginary part and dynamic coefficient of each output.
fn columns(points: &[Point], outputs: &[Quantity]) -> Vec<Column> {
    let column = |name: String, symbol: String, unit: &str, label: Text, values: Vec<f64>| Column {
        quantity: Quantity { name, symbol, unit: unit.into(), label, display: None },
        values,
    };
    let omega = Text::new("frequency of the load", "частота нагрузки");
    let mut list = vec![
        column("omega".into(), "omega".into(), "rad/s", omega.clone(), points.iter().map(|p| p.omega).collect()),
        column("f".into(), "f".into(), "1/s", omega, points.iter().map(|p| p.omega / TAU).collect()),
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
        let gain: Vec<f64> = points.iter().map(|p| magnitude(p.outputs[k]) / magnitude(p.still[k])).collect();
        if points.iter().any(|p| magnitude(p.still[k]) > 0.0 && magnitude(p.still[k]).is_finite()) {
            push("gain", "1", named("dynamic coefficient", "динамический коэффициент"), gain);
        }
    }
    list
}

/// The fields of the study in JSON.
pub fn to_json(found: &ResponseFound) -> Map<String, Value> {
    let mut own = Map::new();
    own.insert("study".into(), json!("response"));
    own.insert("load".into(), json!(found.load.en));
    let name = |k: usize| found.outputs.get(k).map_or("", |q| q.name.as_str());
    let resonance = |r: &Resonance| {
        json!({"output": name(r.output), "omega": r.omega, "f": r.omega / TAU, "amplitude": r.amplitude, "phase": r.phase,
            "dynamic_coefficient": r.gain, "mode": r.mode.map(|m| m + 1), "quality_factor": r.quality, "half_power": r.half_power})
    };
    own.insert("resonances".into(), found.resonances.iter().map(resonance).collect());
    let anti = |a: &Antiresonance| {
        let absorbs: Vec<Value> = a
            .absorbs
            .iter()
            .map(|(i, share)| json!({"coordinate": found.coordinates.get(*i).map(|q| q.name.clone()), "energy_share": share, "bodies": found.bodies.get(*i)}))
            .collect();
        json!({"output": name(a.output), "omega": a.omega, "f": a.omega / TAU, "amplitude": a.amplitude, "zero": a.exact, "absorbed_by": absorbs})
    };
    own.insert("antiresonances".into(), found.antiresonances.iter().map(anti).collect());
    if let Some(modes) = &found.modes {
        let one = |m: &analysis::studies::modes::Mode| {
            let quality = if m.ratio == 0.0 { Value::Null } else { json!(0.5 / m.ratio) };
            json!({"omega": m.omega, "omega_d": m.damped, "damping_ratio": m.ratio, "quality_factor": quality, "kind": m.kind.key()})
        };
        own.insert("modes".into(), modes.modes.iter().map(one).collect());
    }
    own.insert("at_frequency".into(), found.own.as_ref().map_or(Value::Null, |p| point(found, p)));
    own.insert("shapes".into(), found.shapes.iter().map(|p| point(found, p)).collect());
    own
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
            value["dynamic_coefficient"] = json!(magnitude(p.outputs[k]) / magnitude(p.still[k]));
            (q.name.clone(), value)
        })
        .collect();
    let shape: Map<String, Value> = found.coordinates.iter().zip(&p.coordinates).map(|(q, z)| (q.name.clone(), complex(*z))).collect();
    json!({"omega": p.omega, "f": p.omega / TAU, "outputs": outputs, "shape": shape})
}
