//! The study `modes`: natural frequencies, shapes, the frequency equation, modes followed along a parameter.

use crate::failure::in_words;
use crate::machine::Machine;
use crate::provenance;
use crate::results::{Alone, Body, Next, Results};
use crate::small::asked::{Modes as Study, ParameterRange, Scale};
use crate::small::equation::{self, FrequencyEquation};
use crate::small::formulas::{self, Written};
use crate::small::{Small, about_rest, about_start, contact_notes, timing_notes};
use crate::wording::Word as Say;
use analysis::dataset::{Column, Missing};
use analysis::fault::codes;
use analysis::linear::{Matrices, hidden_inertia};
use analysis::rest::search::accelerated;
use analysis::studies::modes::{self, Damping, Kind, Mode, Modes, Normalisation};
use analysis::studies::rest::branch::Change;
use analysis::studies::rest::degenerate::{Degenerate, degenerate, remark};
use analysis::studies::rest::kinks;
use analysis::studies::tracks::{self, Tracks};
use analysis::{Dataset, Fault, Quantity};
use mechanics::model::FrequencyVariable;
use report::formula::{Form, Printer};
use serde_json::{Map, Value, json};
use std::f64::consts::TAU;
use std::sync::Arc;
use words::{Language, Notice, Printed, Text};

/// The study.
pub const NAME: &str = "modes";

/// Modes at a place.
#[derive(Clone, Debug)]
pub struct Found {
    /// The unknown of the frequency equation; ω² without it.
    pub variable: Option<FrequencyVariable>,
    /// The linear machine and its place.
    pub small: Small,
    /// Numbers of M, B, C.
    pub matrices: Matrices,
    /// The modes.
    pub modes: Modes,
    /// The equations of small motions, while they are readable.
    pub written: Option<Written>,
    /// The frequency equation, where it exists.
    pub equation: Option<FrequencyEquation>,
    /// Modes along the parameter of the study.
    pub tracks: Option<Tracks>,
    /// What decides where the stiffness vanishes in a direction.
    pub degenerate: Option<Degenerate>,
    /// Whether a force has a kink at the place.
    pub kink: bool,
    /// Whether they are about the motion as it is at the start.
    pub about_start: bool,
    /// Which contacts are kept closed and which are left out.
    pub contacts: Vec<Text>,
    /// The highest oscillation that the coordinates of a frame hold, rad/s, when higher ones are left out.
    pub kept: Option<f64>,
}

/// Makes the study: one row per mode; along a parameter one row per value.
pub fn find(machine: &Machine, study: &Study) -> Results {
    let found = at_place(machine, study);
    let data = found.as_ref().map_or_else(|_| Dataset { partial: true, ..Dataset::default() }, dataset);
    let base = Results {
        kind: NAME,
        alone: Alone::Written { next: Next::Run },
        heading: Say::Modes.text(),
        own: to_json(found.as_ref().ok()),
        data: provenance::stamp(data, &machine.equations, &machine.model_hash),
        ..Results::default()
    };
    match found {
        Ok(found) => Results { body: Body::Own(Arc::new(found)), ..base },
        Err(fault) => Results { trouble: Some(Notice::from(fault)), ..base },
    }
}

/// The modes at the place that is meant.
///
/// # Errors
/// No equilibrium is found, or formulas have no value there.
pub fn at_place(machine: &Machine, study: &Study) -> Result<Found, Fault> {
    let small = if study.about_start { about_start(machine) } else { about_rest(machine, &study.guess).map_err(|f| explained(f, machine)) };
    small.and_then(|small| at(machine, study, small))
}

/// Where no place of rest is found because none is needed, the fault says so.
fn explained(fault: Fault, machine: &Machine) -> Fault {
    let needs_none = || about_start(machine).is_ok_and(|small| small.machine.same_everywhere());
    if fault.code == codes::NO_REST && needs_none() { accelerated() } else { fault }
}

fn at(machine: &Machine, study: &Study, mut small: Small) -> Result<Found, Fault> {
    if machine.equations.coordinates.is_empty() {
        return Err(analysis::fault::nothing_moves());
    }
    // along a parameter a touching contact may press or leave
    if study.over.is_some() {
        small.two_sided()?;
    }
    let mut matrices = small.machine.at(&small.place)?;
    let names = small.machine.coordinates().to_vec();
    let degenerate = if study.about_start || small.touches() { None } else { degenerate(&mut small.machine, &small.place) };
    let kink = !study.about_start && kinks::is_kink(&mut small.machine, &small.place);
    if let Some(found) = &degenerate {
        found.settle(&mut matrices);
    }
    let mut modes = modes::modes(&matrices, &names, normalisation(study.scale))?;
    small.keep_two_sided(&mut modes)?;
    let equation = (!study.about_start && !small.touches() && modes.damping != Damping::General && matrices.jacobian.is_empty())
        .then(|| equation::find(machine, &small, study.variable.as_ref()))
        .flatten();
    let written = if study.about_start || small.touches() { None } else { formulas::write(&machine.equations, &small) };
    let over = if study.about_start { None } else { study.over.as_ref() };
    let tracks = match over {
        // a page shows the numbers of the file's own frame; those of another one are followed beside it
        Some(sweep) => Some(match machine.followed(&sweep.name).map_err(in_words)? {
            Some(followed) => along(&mut about_rest(&followed, &study.guess)?, sweep)?,
            None => along(&mut small, sweep)?,
        }),
        None => None,
    };
    let (about_start, kept) = (study.about_start, machine.model.structure.as_ref().and_then(|structure| structure.kept));
    let equation = equation.map(|e| e.0);
    let contacts = contact_notes(machine, &small);
    Ok(Found {
        contacts,
        variable: study.variable.clone(),
        small,
        matrices,
        modes,
        written,
        equation,
        tracks,
        degenerate,
        kink,
        about_start,
        kept,
    })
}

fn along(small: &mut Small, sweep: &ParameterRange) -> Result<Tracks, Fault> {
    let names: Vec<String> = small.machine.parameters().iter().map(|p| p.name.clone()).collect();
    let Some(parameter) = small.machine.parameter(&sweep.name) else {
        let what = Text::new(
            format!("`{}` is given by a formula, so it cannot be changed by itself", sweep.name),
            format!("величина `{}` задана формулой, менять её отдельно нельзя", sweep.name),
        );
        return Err(Fault::unknown(what, &names));
    };
    let own = small.machine.value(parameter);
    let mut branch = small.branch(parameter);
    let tracks = tracks::tracks(&mut small.machine, &mut branch, [sweep.from, sweep.to], sweep.points);
    branch.leave(&mut small.machine)?;
    small.machine.set(parameter, own)?;
    tracks
}

/// The scale of shapes.
pub fn normalisation(scale: Scale) -> Normalisation {
    match scale {
        Scale::Largest => Normalisation::Largest,
        Scale::First => Normalisation::First,
        Scale::Mass => Normalisation::Mass,
    }
}

fn dataset(found: &Found) -> Dataset {
    let mut data = match &found.tracks {
        Some(tracks) => tracks.data.clone(),
        None => {
            let mut data = Dataset { columns: columns(found), ..Dataset::default() };
            state(&mut data);
            data
        }
    };
    data.audits.extend(found.modes.audits.iter().cloned());
    data.notes.extend(found.modes.notes.iter().cloned());
    if found.modes.modes.is_empty() {
        data.notes.push(Text::new(
            "no small motion is left: the connections and the contacts that are closed hold every coordinate",
            "малых движений нет: связи и замкнутые контакты удерживают все координаты",
        ));
    }
    if found.small.place.rates.iter().any(|v| *v != 0.0) {
        data.notes.push(Text::new(
            "about the motion as it is at the start; the coefficients are those of that instant",
            "около движения в начальный момент; коэффициенты взяты в этот момент",
        ));
    }
    data.notes.extend(found.kept.and_then(|kept| left_out(found, kept)));
    data.notes.extend(remark(found.degenerate.iter()));
    data.notes.extend(found.kink.then(kinks::remark));
    data.notes.extend(hidden_inertia(&found.matrices));
    data.notes.extend(found.contacts.iter().cloned());
    data.notes.extend(timing_notes(timing(found)));
    data
}

/// Over the highest kept oscillation of a frame ω a mode is one of the whole frame as long as it lies below so many ω: the kept shapes hold what is slower. Beyond, what is
/// left over is a single shape, the static one of a named displacement, in place of many: a tenth or a quarter off.
const HELD: f64 = 1.1;

/// Modes that a frame of so few shapes does not have.
fn left_out(found: &Found, kept: f64) -> Option<Text> {
    let beyond = |(i, mode): (usize, &Mode)| (mode.omega > HELD * kept).then(|| (i + 1).to_string());
    let list: Vec<String> = found.modes.modes.iter().enumerate().filter_map(beyond).collect();
    let (numbers, omega) = (list.join(", "), words::digits::rounded(kept));
    (!list.is_empty()).then(|| {
        Text::new(
            format!(
                "modes {numbers} lie above the highest kept oscillation of the frame, ω = {} rad/s: they are not those of the whole frame and may be off by tens of per cent; give [structure] more `modes`",
                omega.en
            ),
            format!(
                "формы {numbers} лежат выше старшего учтённого колебания рамы, ω = {} рад/с: это не формы всей рамы, ошибка может составлять десятки процентов; увеличьте `modes` в [structure]",
                omega.ru
            ),
        )
    })
}

/// How time was treated; what has rate zero for these numbers does not oscillate.
fn timing(found: &Found) -> symbolic::linear::Timing {
    let mut timing = found.small.machine.timing();
    let pulsates = || found.small.machine.pulsation(&found.small.place).map_or(true, |list| list.iter().flatten().any(|v| *v != 0.0));
    timing.varying = timing.varying && (found.tracks.is_some() || pulsates());
    timing
}

/// Says what is absent in the table of modes.
fn state(data: &mut Dataset) {
    let none = Text::new("a motion without oscillation has no period", "у движения без колебаний периода нет");
    data.state("T", Missing::Absent, none);
    let ratio = Text::new(
        "no damping ratio: the motion is free or grows without oscillation",
        "относительного затухания нет: движение свободно или растёт без колебаний",
    );
    data.state("damping_ratio", Missing::Absent, ratio);
    let decrement = Text::new("no decrement without oscillation", "без колебаний декремента нет");
    data.state("decrement", Missing::Absent, decrement);
}

/// The table of modes.
pub fn columns(found: &Found) -> Vec<Column> {
    let modes = &found.modes.modes;
    let column = |name: &str, unit: &str, en: &str, ru: &str, values: Vec<f64>| Column {
        quantity: Quantity { label: Text::new(en, ru), ..Quantity::new(name, unit) },
        values,
    };
    let over = |a: f64, b: f64| if b == 0.0 { f64::NAN } else { a / b };
    let mut list = vec![
        column("mode", "1", "number", "номер", (1..=modes.len()).map(|i| i as f64).collect()),
        column("omega", "rad/s", "natural frequency", "собственная частота", modes.iter().map(|m| m.omega).collect()),
        column("f", "Hz", "natural frequency", "собственная частота", modes.iter().map(|m| m.omega / TAU).collect()),
        column("T", "s", "period", "период", modes.iter().map(|m| over(TAU, m.omega)).collect()),
        column("damping_ratio", "1", "damping ratio", "относительное затухание", modes.iter().map(|m| m.ratio).collect()),
    ];
    if found.modes.damping != Damping::None {
        let decrement = modes.iter().map(|m| m.decrement().unwrap_or(f64::NAN)).collect();
        list.push(column(
            "omega_d",
            "rad/s",
            "frequency with damping",
            "частота с учётом затухания",
            modes.iter().map(|m| m.damped).collect(),
        ));
        list.push(column("decrement", "1", "logarithmic decrement", "логарифмический декремент", decrement));
    }
    if modes.iter().any(|m| m.root.0 != 0.0) {
        list.push(column("growth", "1/s", "real part of the root", "вещественная часть корня", modes.iter().map(|m| m.root.0).collect()));
    }
    let complex = is_complex(&found.modes);
    for (i, q) in found.small.machine.coordinates().iter().enumerate() {
        list.push(Column { quantity: Quantity { unit: "1".into(), ..q.clone() }, values: modes.iter().map(|m| m.shape[i].0).collect() });
        if complex {
            let quantity = Quantity { name: format!("{}_im", q.name), symbol: format!("{}_im", q.symbol), unit: "1".into(), ..q.clone() };
            list.push(Column { quantity, values: modes.iter().map(|m| m.shape[i].1).collect() });
        }
    }
    list
}

/// Whether shapes have phases.
pub fn is_complex(modes: &Modes) -> bool {
    modes.modes.iter().any(|m| m.shape.iter().any(|z| z.1 != 0.0))
}

/// Whether the equilibrium is stable: none where free motions leave it open.
pub fn stability(modes: &Modes, degenerate: Option<&Degenerate>) -> Option<bool> {
    match () {
        () if degenerate.is_some() => degenerate.and_then(|d| d.stable),
        () if modes.modes.iter().any(modes::Mode::grows) => Some(false),
        () if modes.modes.iter().any(|m| m.kind == Kind::RigidBody) || modes.zeros > 0 => None,
        () => Some(true),
    }
}

/// The fields of the study in JSON.
fn to_json(found: Option<&Found>) -> Map<String, Value> {
    let mut own = Map::new();
    own.insert("study".into(), json!(NAME));
    let Some(f) = found else {
        own.insert("modes".into(), json!([]));
        return own;
    };
    let names = f.small.machine.coordinates();
    own.insert("modes".into(), f.modes.modes.iter().map(|m| mode(m, names, &f.modes)).collect());
    own.insert("frequency_equation".into(), json!(f.equation.as_ref().map(|e| e.text.clone())));
    if let Some(e) = &f.equation {
        let digits = |r: &symbolic::Rational| {
            let (top, bottom) = r.digits();
            if bottom == "1" { top } else { format!("{top}/{bottom}") }
        };
        let list: Vec<String> = e.coefficients.iter().map(digits).collect();
        own.insert("frequency_coefficients".into(), json!({"variable": e.variable, "ascending": list}));
    }
    if let Some(written) = &f.written {
        let printer = Printer::of(f.small.machine.equations(), Language::En);
        let print = |(i, e): (usize, &symbolic::equations::Equality)| printer.equality(&written.graph, *e, Some(i), Form::Text);
        let list: Vec<String> = written.equations.iter().enumerate().map(print).collect();
        own.insert("small_motion".into(), json!(list));
    }
    let place: Map<String, Value> = names.iter().zip(&f.small.place.q).map(|(q, v)| (q.name.clone(), json!(v))).collect();
    own.insert("equilibrium".into(), Value::Object(place));
    own.insert("stable".into(), json!(if f.kink { None } else { stability(&f.modes, f.degenerate.as_ref()) }));
    let damping = match f.modes.damping {
        Damping::None => "none",
        Damping::Classical => "classical",
        Damping::General => "general",
    };
    own.insert("damping".into(), json!(damping));
    own.insert("gyroscopic".into(), json!(f.modes.gyroscopic));
    own.insert("circulatory".into(), json!(f.modes.circulatory));
    if !f.matrices.drift.is_empty() {
        own.insert("zero_roots".into(), json!(f.modes.zeros));
    }
    own.insert("undamped".into(), json!(f.modes.undamped));
    let rows = |a: &[f64]| a.chunks(f.matrices.n.max(1)).map(<[f64]>::to_vec).collect::<Vec<_>>();
    let m = &f.matrices;
    own.insert("matrices".into(), json!({"mass": rows(&m.mass), "damping": rows(&m.damping), "stiffness": rows(&m.stiffness)}));
    if let Some(tracks) = &f.tracks {
        own.insert("tracks".into(), tracks_json(tracks, names));
    }
    own
}

fn mode(m: &modes::Mode, names: &[Quantity], all: &modes::Modes) -> Value {
    let part = |pick: fn(&(f64, f64)) -> f64| -> Map<String, Value> {
        names.iter().zip(&m.shape).map(|(q, z)| (q.name.clone(), json!(pick(z)))).collect()
    };
    let period = if m.omega > 0.0 { json!(TAU / m.omega) } else { Value::Null };
    let mut out = json!({
        "omega": m.omega, "f": m.omega / TAU, "T": period, "damping_ratio": m.ratio, "decrement": m.decrement(), "quality_factor": if m.ratio == 0.0 { Value::Null } else { json!(0.5 / m.ratio) },
        "omega_d": m.damped, "root": [m.root.0, m.root.1], "kind": m.kind.key(), "shape": part(|z| z.0),
    });
    if is_complex(all) {
        out["shape_imag"] = Value::Object(part(|z| z.1));
    }
    out
}

fn tracks_json(tracks: &Tracks, names: &[Quantity]) -> Value {
    let place =
        |q: &Vec<f64>| -> Value { names.iter().zip(q).map(|(n, v)| (n.name.clone(), json!(v))).collect::<Map<String, Value>>().into() };
    let places: Vec<Option<Value>> = tracks.places.iter().map(|p| p.as_ref().map(place)).collect();
    let critical: Vec<Value> = tracks.critical.iter().map(|c| json!({"mode": c.mode + 1, "value": c.value, "order": c.order})).collect();
    json!({"parameter": tracks.parameter, "values": tracks.values, "omega": tracks.omega, "omega_d": tracks.damped,
        "damping_ratio": tracks.ratio, "orders": tracks.orders, "critical": critical,
        "unstable_from": tracks.unstable_from, "unstable": tracks.unstable, "equilibrium": places,
        "changes": changes_json(&tracks.changes)})
}

/// Where the place of rest that is followed changes.
pub fn changes_json(changes: &[Change]) -> Vec<Value> {
    let one = |c: &Change| {
        let mut value = json!({"value": c.value, "upwards": c.upwards, "event": c.event.key()});
        if !(c.closes.is_empty() && c.opens.is_empty()) {
            (value["closes"], value["opens"]) = (json!(c.closes), json!(c.opens));
        }
        value
    };
    changes.iter().map(one).collect()
}
