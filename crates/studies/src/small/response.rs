//! The study `response`: forced oscillations over the frequency of periodic loads.

mod found;
mod tell;

pub use found::{Deformed, Order, ResponseFound};
use tell::{columns, own_column, state, to_json};

use crate::failure::in_words;
use crate::machine::Machine;
use crate::plan;
use crate::provenance;
use crate::results::{Alone, Body, Next, Results};
use crate::small::asked::Response as Study;
use crate::small::remarks::{
    axis, bent_by_rates, by_itself, cut, doubtful, foreign, left_out, not_shown, not_straight, of_reactions, prescribed, reference,
    unstable,
};
use crate::small::source::{load_name, source};
use crate::small::strands::{self, Watched};
use crate::small::{Small, about_rest, contact_notes, timing_notes};
use crate::wording::Word as Say;
use algebra::arrange::Arrange;
use analysis::System;
use analysis::dataset::Audit;
use analysis::marks::pushes::Push;
use analysis::studies::extremes::{Antiresonance, Resonance, extremes};
use analysis::studies::limits::unrepeated;
use analysis::studies::modes::{Kind, Modes, Normalisation, modes};
use analysis::studies::response::{self as forced, Forced, Point, magnitude};
use analysis::studies::rest::branch::Branch;
use analysis::studies::rest::changes;
use analysis::studies::rest::{degenerate, kinks};
use analysis::studies::superposition::{self, Care, Superposed};
use analysis::studies::swings::judged;
use analysis::studies::tracks::tracks;
use analysis::{Dataset, Fault, Quantity};
use std::sync::Arc;
use symbolic::equations::Role;
use symbolic::{Expr, SymbolId};
use words::{Notice, Printed, Text};

/// The study.
pub const NAME: &str = "response";

/// Frequencies of an automatic grid.
const POINTS: usize = 401;
/// Points on each side of a natural frequency, in half-widths of the resonance.
const NEAR: [f64; 12] = [0.05, 0.1, 0.2, 0.35, 0.5, 0.75, 1.0, 1.5, 2.0, 3.0, 5.0, 8.0];

/// Orders of a waveform whose curves and resonances are shown.
const SHOWN: usize = 9;
/// Values along the frequencies at which stability is asked; its bounds are then located.
const TRACKED: usize = 101;
/// Largest residual of the superposed motion, relative to its terms.
const RESIDUAL: f64 = 1e-8;

/// Who draws the rods of the machine's frame at these points; nothing of a machine without one.
pub type Drawn = fn(&Machine, &[Point]) -> Vec<Deformed>;

/// Makes the study: a column for the frequency and five for each output.
pub fn find(machine: &Machine, study: &Study, drawn: Drawn) -> Results {
    let mut out = ResponseFound {
        study: study.clone(),
        outputs: Vec::new(),
        resonances: Vec::new(),
        antiresonances: Vec::new(),
        modes: None,
        own: None,
        orders: Vec::new(),
        main: 1.0,
        superposed: None,
        resonance_orders: Vec::new(),
        antiresonance_orders: Vec::new(),
        changes: Vec::new(),
        slack: Vec::new(),
        shapes: Vec::new(),
        deformed: Vec::new(),
        coordinates: Vec::new(),
        bodies: bodies(machine),
        load: Text::default(),
    };
    let small = match machine.equations.coordinates.is_empty() {
        true => Err(analysis::fault::nothing_moves()),
        false => about_rest(machine, &study.guess),
    };
    let mut data = Dataset::default();
    let found = small.and_then(|small| mounted(machine, study, small, (&mut out, &mut data)));
    out.deformed = drawn(machine, &out.shapes);
    let trouble = found.err().map(|fault| Notice::from(of_output(machine, study, fault)));
    data.partial |= trouble.is_some();
    Results {
        kind: NAME,
        alone: Alone::Written { next: Next::Numbers },
        heading: Say::Response.text(),
        own: to_json(NAME, &out),
        data: provenance::stamp(data, &machine.equations, &machine.model_hash),
        trouble,
        body: Body::Own(Arc::new(out)),
        ..Results::default()
    }
}

/// A fault of a formula, as that of the output that has no slope at the place of rest (a distance from it, an angle about it); others as they are.
fn of_output(machine: &Machine, study: &Study, fault: Fault) -> Fault {
    if !fault.code.starts_with('P') {
        return fault;
    }
    let Ok(mut small) = about_rest(machine, &study.guess) else { return fault };
    let (quantities, formulas) = observed(study, machine);
    let mut has_none = |formula: &symbolic::Expr| {
        let seen = small.machine.observer(std::slice::from_ref(formula), None).and_then(|o| small.machine.observe(&o, &small.place));
        seen.is_err()
    };
    match quantities.iter().zip(&formulas).find(|(_, formula)| has_none(formula)) {
        Some((quantity, _)) => analysis::fault::small::no_slope(&quantity.name, &fault),
        None => fault,
    }
}

/// Share of the highest kept frequency of a frame up to which its other shapes follow statically within a fraction of their static part,
/// 1/(1 - 0.5²) - 1 = 1/3; that of loads and named displacements is in the kept shapes.
const STATIC: f64 = 0.5;

/// Whether the frame's shapes reach as far as the frequencies asked for.
fn beyond(machine: &Machine, top: f64) -> Option<Audit> {
    let kept = machine.model.structure.as_ref()?.kept?;
    let name = Text::new(
        "highest frequency relative to that of the kept shapes of the frame",
        "наибольшая частота относительно частоты учтённых форм рамы",
    );
    Some(Audit::at_most("frame_modes", name, top / kept, STATIC))
}

/// The response, of the machine that has every number of its frame as a parameter where the frame follows the frequency.
fn mounted(machine: &Machine, study: &Study, small: Small, out: (&mut ResponseFound, &mut Dataset)) -> Result<(), Fault> {
    let followed = match machine.equations.mounted {
        Some(_) => {
            let mut probe = small.clone();
            let parameter = source(machine, study, &mut probe)?.1;
            let name = parameter.map(|p| probe.machine.parameters()[p].name.clone());
            name.map_or(Ok(None), |name| machine.followed(&name)).map_err(in_words)?
        }
        None => None,
    };
    match followed {
        Some(followed) => sweep(&followed, study, about_rest(&followed, &study.guess)?, out),
        None => sweep(machine, study, small, out),
    }
}

/// What a response says.
#[expect(clippy::too_many_lines, reason = "in the order of its page")]
fn sweep(machine: &Machine, study: &Study, mut small: Small, (out, data): (&mut ResponseFound, &mut Dataset)) -> Result<(), Fault> {
    let names = small.machine.coordinates().to_vec();
    small.two_sided()?;
    let matrices = small.machine.at(&small.place)?;
    if small.machine.timing().driven {
        return Err(forced::through_connections());
    }
    let found = modes(&matrices, &names, Normalisation::Largest)?;
    let (source, parameter) = source(machine, study, &mut small)?;
    out.load = load_name(machine, study, &small, (&source, parameter));
    let (quantities, formulas) = observed(study, machine);
    refuse_open(machine, &quantities)?;
    let mut notes = remarks(machine, &small);
    notes.extend(degenerate::remark(degenerate::degenerate(&mut small.machine, &small.place).iter()));
    notes.extend(kinks::is_kink(&mut small.machine, &small.place).then(kinks::remark));
    notes.extend(analysis::linear::hidden_inertia(&matrices));
    let parameters = small.machine.parameters().to_vec();
    let own_value = parameter.map(|p| small.machine.value(p));
    let load = (source.clone(), parameter);
    let mut forced =
        Forced::new(&mut small.machine, (&small.place, &small.starts), source, parameter, &formulas)?.with_contacts(small.contacts.clone());
    let own = forced.own_frequency().filter(|w| *w > 0.0);
    let asked = grid(study, &found, own)?;
    forced.cover([asked[0], asked[asked.len() - 1]])?;
    let omegas = forced.reached(&asked)?;
    let main = forced.current();
    out.main = forced.components().get(main).map_or(1.0, |c| c.order);
    refer(&mut forced, own, &omegas)?;
    let points = over(&mut forced, &omegas)?;
    out.shapes = over(&mut forced, &study.shapes)?;
    out.own = own.map(|w| forced.at(out.main * w)).transpose()?;
    let (limit, curved) = beyond_small(&mut forced, out, &points)?;
    notes.extend(swinging(&mut forced, &quantities, (own, &omegas))?);
    notes.extend(parameter.and_then(|p| axis(&parameters[p], forced.multiple())));
    *data = Dataset { axis: Some(0), columns: columns(&omegas, &points, &quantities), notes, ..Dataset::default() };
    each_order(&mut forced, &found, &omegas, (own, quantities.len()), out)?;
    forced.choose(main);
    together(&mut forced, &omegas, own, &quantities, (out, data))?;
    if let Some(value) = own_value {
        forced.restore(value)?;
    }
    let branch = forced.branch().cloned();
    let places: Vec<Option<Vec<f64>>> = points.iter().map(|p| Some(p.place.clone())).collect();
    changes::add_columns(data, &places, &names);
    if let Some(branch) = &branch {
        out.changes = branch.changes();
        data.notes.extend(changes::notes(branch, &parameters[branch.parameter()], &names));
    }
    data.notes.extend(cut(asked.len(), &omegas));
    data.notes.extend(found.notes.iter().cloned());
    data.notes.push(reference(if forced.from_sine() { "sin" } else { "cos" }, if out.orders.is_empty() { "ωt" } else { "nωt" }));
    data.notes.extend(doubtful(points.iter().map(|p| p.doubt).fold(0.0, f64::max)));
    data.notes.extend(left_out(&forced.left_out));
    data.notes.extend(forced.timed().iter().map(|k| by_itself(&quantities[*k].name)));
    data.notes.extend(forced.bent_by_reactions().iter().map(|k| of_reactions(&quantities[*k].name)));
    data.notes.extend(forced.prescribed().iter().map(|k| prescribed(&quantities[*k].name)));
    data.notes.extend(limit);
    data.audits.extend(beyond(machine, out.main * omegas.iter().chain(&own).copied().fold(0.0, f64::max)));
    data.notes.extend(curved.iter().map(|(k, share)| not_straight(&quantities[*k].name, *share)));
    data.notes.extend(not_shown(study, &machine.equations));
    quantities.iter().for_each(|q| state(data, &q.name));
    if let Some(mut branch) = branch {
        data.notes.extend(growing(&mut small, &mut branch, &omegas)?);
    }
    let rest = (&small.place, small.starts.as_slice());
    let places = frequencies(out, &found, own, &omegas);
    let along = (ends(&omegas), places.as_slice());
    out.slack = strands::slack(&mut small.machine, rest, &pushes(machine), load.clone(), along)?;
    out.slack.extend(strands::touched(&mut small.machine, rest, small.contacts.as_ref(), load, along));
    data.notes.extend(out.slack.iter().map(|slack| slack.remark.clone()));
    (out.coordinates, out.outputs, out.modes) = (names, quantities, Some(found));
    Ok(())
}

/// What is to be said of the machine before any frequency.
fn remarks(machine: &Machine, small: &Small) -> Vec<Text> {
    let mut timing = small.machine.timing();
    // what oscillates with a factor that vanishes at rest does not; where it acts away from there, its size is told point by point
    let pulsates = || small.machine.pulsation(&small.place).map_or(true, |list| list.iter().flatten().any(|v| *v != 0.0));
    timing.varying = timing.varying && pulsates();
    let mut notes = contact_notes(machine, small);
    notes.extend(timing_notes(timing));
    match super::bent::remark(&machine.model) {
        Some(remark) => notes.push(remark),
        None if small.machine.timing().bent => notes.push(bent_by_rates()),
        None => {}
    }
    notes
}

/// Outputs, by number, with the share by which a motion bends them.
type Curved = Vec<(usize, f64)>;

/// Where oscillations are no small ones any more: limits that they pass, and outputs that they bend. At the frequency of the file, or where nothing is to be
/// said there, at the largest amplitude.
fn beyond_small(forced: &mut Forced, out: &ResponseFound, points: &[Point]) -> Result<(Vec<Text>, Curved), Fault> {
    let real = forced.has_size();
    let moves = |p: &&Point| p.coordinates.iter().any(|z| magnitude(*z) > 0.0) && p.coordinates.iter().all(|z| magnitude(*z).is_finite());
    let size = |p: &&Point| p.coordinates.iter().map(|z| magnitude(*z)).fold(0.0, f64::max);
    let largest = points.iter().filter(moves).max_by(|a, b| size(a).total_cmp(&size(b)));
    let (mut limit, mut curved) = (Vec::new(), Vec::new());
    for point in out.own.iter().filter(moves).chain(largest).filter(|_| real) {
        if limit.is_empty() {
            limit = forced.limits(point)?;
        }
        if curved.is_empty() {
            curved = forced.curved(point)?;
        }
    }
    Ok((limit, curved))
}

fn ends(omegas: &[f64]) -> [f64; 2] {
    [omegas[0], omegas[omegas.len() - 1]]
}

/// Frequencies at which something may be largest: those asked for, that of the file, resonances and natural ones.
fn frequencies(out: &ResponseFound, found: &Modes, own: Option<f64>, omegas: &[f64]) -> Vec<f64> {
    let peaks = out.resonances.iter().zip(&out.resonance_orders).map(|(r, order)| r.omega / order);
    let natural = found.modes.iter().map(|m| m.omega / out.main);
    omegas.iter().copied().chain(own).chain(peaks).chain(natural).collect()
}

/// What can only push.
fn pushes(machine: &Machine) -> Vec<Watched> {
    let known = |push: &Push| machine.system.refusal(push.output).is_none();
    let pushes = plan::pushes(&machine.model, &machine.equations).into_iter().filter(known);
    let both_ways = |push: Push| {
        let formula = machine.equations.outputs[push.output].formula;
        Watched { name: push.name.clone(), formula, kind: strands::Kind::BothWays(push) }
    };
    pushes.map(both_ways).collect()
}

/// Outputs that follow the motion by factors that oscillate in time, or depend on time in other ways than the loads do: at the frequency of the file, or in the middle
/// of the rows, since beside a resonance amplitudes grow that are small elsewhere.
fn swinging(forced: &mut Forced, outputs: &[Quantity], (own, omegas): (Option<f64>, &[f64])) -> Result<Vec<Text>, Fault> {
    if let Some(k) = forced.frozen().first() {
        return Err(unrepeated(&outputs[*k].name));
    }
    let rows = || omegas.iter().copied().filter(|w| *w > 0.0);
    let places: Vec<f64> = own.map_or_else(|| rows().collect(), |w| vec![w]);
    let mut notes = Vec::new();
    if forced.swings() && !places.is_empty() {
        let shares = places.iter().map(|omega| forced.swung(*omega)).collect::<Result<Vec<_>, _>>()?;
        for (k, output) in outputs.iter().enumerate() {
            let mut all: Vec<f64> = shares.iter().map(|row| row[k]).collect();
            all.sort_by(f64::total_cmp);
            notes.extend(judged(&output.name, all[all.len() / 2])?);
        }
    }
    // rates that belong to the loads follow ω, the others do not
    if let Some(omega) = rows().max_by(f64::total_cmp) {
        notes.extend(forced.foreign(omega)?.into_iter().map(|(k, rate)| foreign(&outputs[k].name, rate)));
    }
    Ok(notes)
}

/// Phases count from the load at the frequency of the file, or where that has no hold on the machine, at one along the range.
fn refer(forced: &mut Forced, own: Option<f64>, omegas: &[f64]) -> Result<(), Fault> {
    let along = [omegas[0], omegas[omegas.len() / 2], omegas[omegas.len() - 1]];
    let mut first = None;
    for omega in own.into_iter().chain(along) {
        match forced.refer(omega) {
            Ok(()) => return Ok(()),
            Err(fault) => drop(first.get_or_insert(fault)),
        }
    }
    first.map_or(Ok(()), Err)
}

/// Where a free motion grows along the frequencies: no amplitude is ever reached there.
fn growing(small: &mut Small, branch: &mut Branch, omegas: &[f64]) -> Result<Option<Text>, Fault> {
    let ends = [omegas[0], omegas[omegas.len() - 1]];
    let parameter = branch.parameter();
    let own = small.machine.value(parameter);
    let mut at = |value: f64| -> Result<_, Fault> {
        let place = branch.place(&mut small.machine, value)?;
        small.machine.at(place.as_ref().unwrap_or(&small.place)).map(|m| [m.mass, m.damping, m.stiffness])
    };
    let first = at(ends[0])?;
    let changes = at(ends[1])? != first || at(0.5 * (ends[0] + ends[1]))? != first;
    let found = match changes && ends[1] > ends[0] {
        true => tracks(&mut small.machine, branch, ends, TRACKED).ok(),
        false => None,
    };
    small.machine.set(parameter, own)?;
    Ok(found.filter(|t| !t.unstable.is_empty()).map(|t| unstable(&t)))
}

/// The chosen order along frequencies ω.
fn over(forced: &mut Forced, omegas: &[f64]) -> Result<Vec<Point>, Fault> {
    let order = forced.components().get(forced.current()).map_or(1.0, |c| c.order);
    omegas.iter().map(|w| forced.at(order * w)).collect()
}

/// Curves, resonances and antiresonances of every order; of a waveform, of its first harmonics.
fn each_order(
    forced: &mut Forced,
    found: &Modes,
    omegas: &[f64],
    (own, outputs): (Option<f64>, usize),
    out: &mut ResponseFound,
) -> Result<(), Fault> {
    let orders: Vec<f64> = forced.components().iter().map(|c| c.order).collect();
    let endless = forced.endless();
    for (i, order) in orders.iter().enumerate() {
        forced.choose(i);
        let own = own.map(|w| forced.at(order * w)).transpose()?;
        let shown = !endless || i < SHOWN;
        let points = if shown { over(forced, omegas)? } else { Vec::new() };
        if shown {
            let (high, low) = extremes(forced, found, &points, outputs)?;
            out.resonance_orders.extend(high.iter().map(|_| *order));
            out.antiresonance_orders.extend(low.iter().map(|_| *order));
            out.resonances.extend(high);
            out.antiresonances.extend(low);
        }
        if orders.len() > 1 {
            out.orders.push(Order { order: *order, own, points });
        }
    }
    // output after output, as they are asked for
    let mut high: Vec<(f64, Resonance)> = out.resonance_orders.drain(..).zip(out.resonances.drain(..)).collect();
    high.arrange_by_key(|(_, r)| r.output);
    (out.resonance_orders, out.resonances) = high.into_iter().unzip();
    let mut low: Vec<(f64, Antiresonance)> = out.antiresonance_orders.drain(..).zip(out.antiresonances.drain(..)).collect();
    low.arrange_by_key(|(_, a)| a.output);
    (out.antiresonance_orders, out.antiresonances) = low.into_iter().unzip();
    Ok(())
}

/// All orders together: columns of their amplitudes and of the largest value, the motion over a period at the frequency of the file.
fn together(
    forced: &mut Forced,
    omegas: &[f64],
    own: Option<f64>,
    quantities: &[Quantity],
    (out, data): (&mut ResponseFound, &mut Dataset),
) -> Result<(), Fault> {
    out.superposed = own.map(|w| superposition::superpose(forced, w, Care::Number)).transpose()?.flatten();
    if let Some(superposed) = out.superposed.as_ref().filter(|s| s.residual.is_finite()) {
        let name = Text::new(
            "response: residual of the equations of motion over a period",
            "вынужденные колебания: невязка уравнений движения за период",
        );
        data.audits.push(Audit::at_most("superposition", name, superposed.residual, RESIDUAL));
    }
    if out.orders.is_empty() {
        return Ok(());
    }
    let list: Vec<f64> = out.orders.iter().map(|o| o.order).collect();
    if superposition::common(&list).is_none() {
        data.notes.push(Text::new(
            "the frequencies of the loads have no common period: each has its own amplitudes, and there is no largest value over a period",
            "частоты нагрузок несоизмеримы, общего периода нет: для каждой даны свои амплитуды, наибольшего значения за период не существует",
        ));
    }
    let curves: Vec<Option<Superposed>> =
        omegas.iter().map(|w| superposition::superpose(forced, *w, Care::Curve)).collect::<Result<_, _>>()?;
    for (k, q) in quantities.iter().enumerate() {
        for order in out.orders.iter().filter(|o| !o.points.is_empty() && o.order != out.main) {
            let values = order.points.iter().map(|p| magnitude(p.outputs[k])).collect();
            let name = order_name(order.order);
            let label = Text::new(format!("amplitude of {} at the order {name}", q.name), format!("амплитуда {} порядка {name}", q.name));
            data.columns.push(own_column(q, &format!("amplitude_{name}"), label, values));
        }
        let largest = curves.iter().map(|s| s.as_ref().map_or(f64::NAN, |s| s.outputs[k].largest.0)).collect();
        let label = Text::new(
            format!("largest distance of {} from its mean over a period", q.name),
            format!("наибольшее за период отклонение {} от среднего", q.name),
        );
        data.columns.push(own_column(q, "largest", label, largest));
    }
    Ok(())
}

fn order_name(order: f64) -> String {
    if order == order.round() { format!("{order}") } else { format!("{}", (order * 1e6).round() / 1e6) }
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

/// The outputs wanted: those named, else the coordinates.
fn observed(study: &Study, machine: &Machine) -> (Vec<Quantity>, Vec<Expr>) {
    let equations = &machine.equations;
    let displaced = |name: &str| machine.model.structure.as_ref().is_some_and(|s| s.displacements.iter().any(|d| d.name == name));
    let wanted = |o: &&symbolic::equations::Output| match &study.outputs[..] {
        // displacements of a frame are wanted whether they are coordinates or follow
        [] => matches!(o.role, Role::Coordinate) || displaced(&o.name),
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
        list.arrange_by_key(|o| study.outputs.iter().position(|n| *n == o.name));
    }
    (list.iter().map(|o| quantity(o)).collect(), list.iter().map(|o| o.formula).collect())
}

/// *Errors*: S019, S087, S090 for an output over a reaction that is not unique.
fn refuse_open(machine: &Machine, quantities: &[Quantity]) -> Result<(), Fault> {
    let outputs = machine.system.outputs();
    let asked = |name: &str| outputs.iter().position(|o| o.name == name);
    let refused = quantities.iter().filter_map(|q| asked(&q.name)).find_map(|i| machine.system.refusal(i));
    refused.map_or(Ok(()), Err)
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
        () if study.log => from * algebra::elementary::pow(to / from, share(k)),
        () => from + (to - from) * share(k),
    };
    let mut list: Vec<f64> = (0..points).map(place).collect();
    if study.points.is_none() {
        for m in found.modes.iter().filter(|m| m.kind == Kind::Oscillation) {
            // without damping a peak is drawn as wide as one of a thousandth
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
