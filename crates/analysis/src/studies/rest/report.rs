//! The study `equilibrium` of machines with connections: places of rest, how they are held, whether they are stable.
//!
//! With dry friction a machine rests in whole ranges. Its start counts as a place of rest when reactions within the limits of friction hold it there; further places
//! are those where it would rest without friction, of which friction makes neighbourhoods.

use std::collections::BTreeMap;
use std::sync::Arc;

use program::lower::{self, Inputs};
use program::{Evaluator, Point};
use symbolic::connections::Law;
use symbolic::linear::About;
use symbolic::{Equations, SymbolId};
use words::Text;

use super::degenerate::{Degenerate, degenerate, remark, rests_beside};
use super::stability::{free_directions, verdict, with_closed};
use super::{frictions, kinks, onesided};
use crate::audits;
use crate::dataset::{Audit, Column, Dataset, Missing};
use crate::linear::LinearMachine;
use crate::rest::admissible::Holds;
use crate::rest::limiting::limiting;
use crate::rest::newton::{RESIDUAL, balance, worst};
use crate::rest::places::{Place, places};
use crate::rest::search::{Equilibrium, Range, Searched, no_equilibrium, nothing_between};
use crate::rest::system::{Parts, RestSystem};
use crate::rest::unknowns::Impending;
use crate::rest::{closed_contacts, fault_of, hold, observed, path};
use crate::studies::modes::{Normalisation, modes};
use crate::studies::simulate::Outcome;
use crate::{Fault, Quantity};
use words::digits::number;

/// Remainder of the equations of statics that counts as none.
const RESTS: f64 = 1e-9;
/// Largest force of rest by the second derivation, relative to its terms.
const SECOND: f64 = 1e-9;

/// A place with what is known of it.
struct Row {
    place: Place,
    stable: Option<bool>,
    growth: f64,
    negative: f64,
    free: usize,
    /// Whether one of the free directions is seen to lead along places of rest.
    lies: bool,
    second: Option<f64>,
    degenerate: Option<Degenerate>,
    /// Whether a force has a kink there.
    kink: bool,
    /// Contacts (by reaction) that only touch there and keep small motions on one side.
    touching: Vec<usize>,
}

impl Row {
    /// A place of which nothing is decided.
    fn of(place: Place, second: Option<f64>) -> Row {
        let (growth, negative, touching) = (f64::NAN, f64::NAN, Vec::new());
        Row { place, stable: None, growth, negative, free: 0, lies: false, second, degenerate: None, kink: false, touching }
    }
}

/// What is studied: the equations of rest, and those of motion, whose rates small motions need.
#[derive(Clone, Copy)]
pub struct Studied<'e> {
    /// Loads by their means, rates zero.
    pub rest: &'e Equations,
    /// As they were derived.
    pub motion: &'e Equations,
}

/// Places of rest of a machine whose equations have conditions, contacts, frictions or no coordinates at all.
///
/// *Errors* beside what was found: S007 no place, S093 friction that is too weak, S062 a rope that would push.
///
/// With what coordinates and reactions of each place have below their last digits, where weak springs stand beside hard ones.
pub fn study(studied: Studied, parameters: &[f64], start: &[f64], options: &Equilibrium) -> (Outcome, Vec<Vec<f64>>) {
    let mut below = Vec::new();
    match attempt(studied, parameters, (start, options), &mut below) {
        Ok(outcome) => (outcome, below),
        Err(fault) => (Outcome { dataset: Dataset::default(), fault: Some(fault) }, below),
    }
}

fn attempt(
    studied: Studied,
    parameters: &[f64],
    (start, options): (&[f64], &Equilibrium),
    below: &mut Vec<Vec<f64>>,
) -> Result<Outcome, Fault> {
    let equations = studied.rest;
    if let Some(refused) = crate::rest::faults::journal(equations) {
        return Err(refused);
    }
    if let Some(refused) = crate::rest::surfaces::moving(equations, parameters, &start[..equations.coordinates.len()])? {
        return Err(refused);
    }
    if let Some(range) = options.over.filter(|_| !options.impending.is_empty()) {
        return at_limits(equations, parameters, start, (range, &options.impending));
    }
    let n = equations.coordinates.len();
    let q = &start[..n];
    let mut notes = vec![crate::studies::equilibrium::rates_are_zero()];
    let rough = equations.reactions.iter().any(|r| matches!(r.law, Law::Friction(_)));
    let held = if rough || n == 0 { Some(held(equations, parameters, q)?) } else { None };
    let mut found = if n == 0 { Default::default() } else { places(equations, parameters, start, options)? };
    let stands = held.as_ref().is_some_and(Result::is_ok);
    if n > 0 && !stands && found.list.is_empty() && options.over.is_none() && options.guesses.iter().all(|g| g == q) {
        // nobody says where to look: as for small motions, at zero too
        let zero = Equilibrium { guesses: vec![vec![0.0; n]], ..options.clone() };
        found = places(equations, parameters, start, &zero)?;
    }
    notes.append(&mut found.notes);
    let searched = if found.open { Searched::Guessed } else { Searched::Whole };
    let mut rows = found.list.into_iter().map(|place| whole(studied, parameters, place)).collect::<Result<Vec<Row>, Fault>>()?;
    let shared = |r: &Row| observed::left_open(equations, &r.place.reactions, observed::Left::Shared);
    notes.extend(rows.iter().find_map(shared));
    let inside = options.over.is_none_or(|r| (r.from..=r.to).contains(&q[r.coordinate]));
    let mut fault = None;
    match held {
        Some(Ok((mut place, ranges))) if inside && !rows.iter().any(|r| close(&r.place.q, &place.q)) => {
            notes.extend(ranges);
            observed::complete(equations, (parameters, &place.q), &mut place.reactions);
            notes.extend(observed::left_open(equations, &place.reactions, observed::Left::Hidden));
            let second = second(equations, parameters, &place);
            rows.insert(0, Row::of(place, second));
            notes.extend(rough.then(held_by_friction));
        }
        Some(Err(why)) if rows.is_empty() => fault = Some(why),
        _ if rough && !rows.is_empty() => {
            let places: Vec<&Place> = rows.iter().map(|r| &r.place).collect();
            notes.push(frictions::remark(equations, parameters, &places));
        }
        _ => {}
    }
    if rows.is_empty() && fault.is_none() {
        fault = Some(match options.over {
            Some(r) => nothing_between(&name(equations, r.coordinate), (r.from, r.to), searched),
            None => nowhere(equations, parameters, q),
        });
    }
    let free = |lies: bool| rows.iter().any(|r| r.free > 0 && r.lies == lies);
    notes.extend(free(true).then(crate::studies::equilibrium::neutral));
    notes.extend(free(false).then(crate::studies::equilibrium::undecided));
    notes.extend(not_linear(equations, &rows));
    if n == 0 {
        notes.push(crate::studies::equilibrium::nothing_moves());
    }
    below.extend(rows.iter().map(|r| r.place.below.clone()));
    Ok(Outcome { dataset: dataset(equations, &rows, notes), fault })
}

/// A place with all its reactions, its stability, and without values that it does not determine.
fn whole(studied: Studied, parameters: &[f64], mut place: Place) -> Result<Row, Fault> {
    observed::complete_place(studied.rest, parameters, &mut place);
    observed::complete_turning(studied.motion, (parameters, &place.q), &mut place.reactions);
    let mut row = judged(studied, parameters, place)?;
    observed::open_shared(studied.rest, parameters, &mut row.place)?;
    Ok(row)
}

fn held_by_friction() -> Text {
    Text::new(
        "dry friction holds the machine at its start; the places of rest are not isolated",
        "в начальном положении машину удерживает сухое трение; положения покоя не изолированы",
    )
}

/// Limiting equilibria in a range.
fn at_limits(
    equations: &Equations,
    parameters: &[f64],
    start: &[f64],
    (range, impending): (Range, &[Impending]),
) -> Result<Outcome, Fault> {
    let mut notes = vec![crate::studies::equilibrium::rates_are_zero()];
    let mut rows = Vec::new();
    for q in limiting(equations, parameters, start, (range, impending))? {
        let (mut place, ranges) = held(equations, parameters, &q)??;
        notes.extend(ranges);
        observed::complete(equations, (parameters, &place.q), &mut place.reactions);
        let second = second(equations, parameters, &place);
        rows.push(Row::of(place, second));
    }
    let said = |(r, direction): &Impending, forward: &'static str, backward: &'static str| {
        format!("{} ({})", equations.reactions[*r].name, if *direction > 0.0 { forward } else { backward })
    };
    let list = |forward, backward| impending.iter().map(|i| said(i, forward, backward)).collect::<Vec<_>>().join(", ");
    notes.push(Text::new(
        format!(
            "limiting equilibria, ends of ranges in which dry friction holds the machine; about to slide: {}; sought from places all over the range",
            list("forward", "backward")
        ),
        format!(
            "предельные равновесия – границы областей, где машину удерживает сухое трение; готово начаться скольжение: {}; поиск из точек по всему диапазону",
            list("вперёд", "назад")
        ),
    ));
    Ok(Outcome { dataset: dataset(equations, &rows, notes), fault: None })
}

/// No place of rest; ropes that are slack and contacts that stand open at the start are named, as a place with them closed may be meant.
fn nowhere(equations: &Equations, parameters: &[f64], q: &[f64]) -> Fault {
    let closed = closed_contacts(equations, q, parameters).unwrap_or_default();
    let open = |r: &usize| matches!(equations.reactions[*r].law, Law::Contact { .. }) && !closed.contains(r);
    let names: Vec<&str> = (0..equations.reactions.len()).filter(open).map(|r| equations.reactions[r].name.as_str()).collect();
    if names.is_empty() { no_equilibrium() } else { crate::rest::faults::with_open(&names.join(", ")) }
}

fn close(a: &[f64], b: &[f64]) -> bool {
    // one place found twice: Newton leaves far less, places apart differ by more
    a.iter().zip(b).all(|(a, b)| (a - b).abs() <= 1e-7 * (1.0 + a.abs().max(b.abs())))
}

fn name(equations: &Equations, coordinate: usize) -> String {
    equations.graph.symbol_info(equations.coordinates[coordinate].symbols[0]).name.clone()
}

/// A place that is held, with remarks on what is not unique; or why it is not.
type Held = Result<(Place, Vec<Text>), Fault>;

/// Whether the start is held by everything there is.
fn held(equations: &Equations, parameters: &[f64], q: &[f64]) -> Result<Held, Fault> {
    let closed = closed_contacts(equations, q, parameters)?;
    let mut system = RestSystem::new(equations, Parts::holding(equations, |r| closed.contains(&r)), parameters)?;
    let mut z = system.z(q);
    balance(&mut system, &mut z)?;
    let rows = system.at(&z)?;
    let hold = hold(equations, &system, &rows, &z);
    if hold.remainder > RESTS {
        return Ok(Err(no_equilibrium()));
    }
    let holds = hold.judge();
    if let Some(fault) = fault_of(equations, &system.reactions, &hold, &holds) {
        return Ok(Err(fault));
    }
    let Holds::Between(ranges) = holds else { return Ok(Err(no_equilibrium())) };
    let mut reactions = vec![Some(0.0); equations.reactions.len()];
    let mut notes = Vec::new();
    for (c, (least, most)) in ranges.iter().enumerate() {
        let r = system.reactions[c];
        reactions[r] = (least == most).then_some(*least);
        // what the coordinates hide follows from the balances of bodies, in which it has no range here
        let law = &equations.reactions[r].law;
        if least < most && law.is_reaction() && !law.is_hidden() {
            notes.push(between(&equations.reactions[r].name, [*least, *most], &equations.reactions[r].unit));
        }
    }
    for limit in &hold.limits {
        let (least, most) = ranges[limit.column];
        let normal = limit.normal.as_ref().map_or(1.0, |(c, terms)| c + terms.iter().map(|(k, f)| f * hold.some[*k]).sum::<f64>());
        let unique = limit.normal.as_ref().is_none_or(|(_, terms)| terms.iter().all(|(k, _)| hold.is_unique(*k)));
        if least == most && unique {
            let reaction = &equations.reactions[system.reactions[limit.column]];
            notes.push(at_most(&reaction.name, least, limit.coefficient * normal.abs(), &reaction.unit));
        }
    }
    let all: Vec<crate::rest::system::Row> = rows.forces.iter().chain(&rows.places).cloned().collect();
    let residual = worst(&all, &z);
    Ok(Ok((Place { q: q.to_vec(), reactions, closed, residual, below: Vec::new(), flat: None }, notes)))
}

fn between(name: &str, ends: [f64; 2], unit: &str) -> Text {
    let end = |v: f64| if v.is_finite() { number(v) } else { Text::same(if v > 0.0 { "+∞" } else { "−∞" }) };
    let ([a, b], unit) = (ends.map(end), Text::unit(unit));
    Text::new(
        format!("{name} is not determined: any value between {} and {} {} holds the machine", a.en, b.en, unit.en),
        format!("{name} не определяется: машину удерживает любое значение от {} до {} {}", a.ru, b.ru, unit.ru),
    )
}

fn at_most(name: &str, value: f64, limit: f64, unit: &str) -> Text {
    let (v, l, unit) = (number(value), number(limit), Text::unit(unit));
    Text::new(
        format!("{name} = {} {2}, its limit is {} {2}", v.en, l.en, unit.en),
        format!("{name} = {} {2}, предельное значение {} {2}", v.ru, l.ru, unit.ru),
    )
}

/// What is to be said of places whose small motions are not linear.
fn not_linear(equations: &Equations, rows: &[Row]) -> Vec<Text> {
    let degenerate = remark(rows.iter().filter_map(|r| r.degenerate.as_ref()));
    let mut touching: Vec<usize> = rows.iter().flat_map(|r| r.touching.iter().copied()).collect();
    touching.sort_unstable();
    touching.dedup();
    let labels: Vec<&Text> = touching.iter().map(|r| &equations.reactions[*r].label).collect();
    let verdicts: Vec<Option<bool>> = rows.iter().filter(|r| !r.touching.is_empty()).map(|r| r.stable).collect();
    let touching = (!labels.is_empty()).then(|| onesided::remark(&labels, &verdicts));
    degenerate.into_iter().chain(rows.iter().any(|r| r.kink).then(kinks::remark)).chain(touching).collect()
}

fn judged(studied: Studied, parameters: &[f64], place: Place) -> Result<Row, Fault> {
    let equations = studied.rest;
    let second = second(equations, parameters, &place);
    let mut row = Row::of(place, second);
    // a condition that is no surface (a skate, a circuit among the connections) has no small motions of this kind
    let strange = !path::all_places(equations, parameters, &row.place.q)?;
    let standing = onesided::standing(equations, parameters, &row.place)?;
    // what only touches holds no small motion
    let held = if standing.touching.is_empty() { &row.place.closed } else { &standing.pressing };
    let closed = with_closed(studied.motion, held);
    let Ok(mut linear) = LinearMachine::new(&Arc::new(closed), About::Rest) else { return Ok(row) };
    let at = linear.about(&row.place, equations);
    let Ok(matrices) = linear.at(&at) else { return Ok(row) };
    let along = matrices.allowed().map_or(matrices.clone(), |(z, k)| matrices.reduced(&z, k));
    if !matrices.drift.is_empty() {
        return Ok(on_rates(row, &matrices, linear.coordinates()));
    }
    row.free = if along.n == 0 { 0 } else { free_directions(&along) };
    if along.n == 0 {
        // the connections leave no motion: isolated, without roots
        (row.stable, row.negative) = (Some(true), 0.0);
        return Ok(row);
    }
    if !standing.touching.is_empty() {
        let open = strange || kinks::is_kink(&mut linear, &at);
        row.stable = if open { None } else { onesided::verdict(&mut linear, &at, &standing.touching) };
        (row.touching, row.free) = (standing.touching.into_iter().map(|(r, _)| r).collect(), 0);
        return Ok(row);
    }
    let names = linear.coordinates().to_vec();
    let found = modes(&matrices, &names, Normalisation::Largest).ok();
    let growth = found.as_ref().map_or(0.0, |f| f.modes.iter().fold(f64::NEG_INFINITY, |g, m| g.max(m.root.0)));
    if let Some(found) = found.as_ref().filter(|f| !f.modes.is_empty()) {
        row.growth = growth;
        row.negative = found.undamped.iter().filter(|w| w.is_nan()).count() as f64;
    }
    row.stable = if strange { None } else { verdict(&along, found.as_ref().map_or(&[][..], |f| &f.modes)) };
    row.degenerate = if strange { None } else { degenerate(&mut linear, &at) };
    if kinks::is_kink(&mut linear, &at) {
        (row.stable, row.growth, row.negative, row.kink) = (None, f64::NAN, f64::NAN, true);
        row.degenerate = None;
    } else if let Some(found) = &row.degenerate {
        (row.stable, row.growth, row.negative) = (found.stable, f64::NAN, f64::NAN);
        // the place is isolated in these
        row.free = row.free.saturating_sub(found.directions());
    }
    row.lies = row.free > 0 && rests_beside(&mut linear, &at);
    if row.kink && !row.lies {
        row.free = 0;
    }
    Ok(row)
}

/// The verdict where conditions on rates restrain no places: by the roots alone, of which those at zero leave it open.
fn on_rates(mut row: Row, matrices: &crate::linear::Matrices, names: &[Quantity]) -> Row {
    let Ok(found) = modes(matrices, names, Normalisation::Largest) else { return row };
    let growth = found.modes.iter().fold(f64::NEG_INFINITY, |g, m| g.max(m.root.0));
    row.growth = if found.zeros > 0 { growth.max(0.0) } else { growth };
    row.stable = match () {
        () if growth > 0.0 => Some(false),
        () if found.zeros == 0 && growth < 0.0 => Some(true),
        () => None,
    };
    row
}

/// The second derivation at rest: its largest residual relative to the terms of the first; none where an open reaction leaves nothing to compare, and without any force.
fn second(equations: &Equations, parameters: &[f64], place: &Place) -> Option<f64> {
    let n = equations.coordinates.len();
    let mut values: BTreeMap<SymbolId, f64> = equations.parameters.iter().map(|p| p.symbol).zip(parameters.iter().copied()).collect();
    values.extend(equations.coordinates.iter().map(|c| c.symbols[0]).zip(place.q.iter().copied()));
    let acting = || equations.reactions.iter().zip(&place.reactions).filter(|(r, _)| !r.law.is_hidden());
    let known: Vec<(SymbolId, f64)> = acting().filter_map(|(r, v)| v.map(|v| (r.symbol, v))).collect();
    if known.len() < acting().count() {
        return None;
    }
    values.extend(known);
    let graph = &equations.graph;
    for (symbol, formula) in
        equations.definitions.iter().map(|d| (d.symbol, d.formula)).chain(equations.auxiliaries.iter().map(|a| (a.symbol, a.start)))
    {
        let value = graph.evaluate(&[formula], &|s| values.get(&s).copied().unwrap_or(0.0))[0];
        values.insert(symbol, value);
    }
    let at = |roots: &[symbolic::Expr]| graph.evaluate(roots, &|s| values.get(&s).copied().unwrap_or(0.0));
    let residuals = at(&equations.second[..n.min(equations.second.len())]);
    let mut sizes = terms(equations, &values);
    for (reaction, value) in equations.reactions.iter().zip(&place.reactions) {
        let list: Vec<symbolic::Expr> = reaction.forces.iter().map(|(_, e)| *e).collect();
        for ((j, _), e) in reaction.forces.iter().zip(at(&list)) {
            sizes[*j] = sizes[*j].max((e * value.unwrap_or(0.0)).abs());
        }
    }
    let largest = audits::worst(sizes.iter().copied());
    // as in the audits of motions: terms that pass through zero together
    let of = |(r, s): (&f64, &f64)| if *r == 0.0 { 0.0 } else { r.abs() / s.max(1e-3 * largest).max(f64::MIN_POSITIVE) };
    (largest != 0.0).then(|| audits::worst(residuals.iter().zip(&sizes).map(of)))
}

/// The size of the terms that add up to each force of rest, which cancel there: the bound of their rounding over the rounding of one operation.
fn terms(equations: &Equations, values: &BTreeMap<SymbolId, f64>) -> Vec<f64> {
    let graph = &equations.graph;
    let symbols = graph.symbols_in(&equations.force);
    let states: Vec<f64> = symbols.iter().map(|s| values.get(s).copied().unwrap_or(0.0)).collect();
    let named: Vec<(String, symbolic::Expr)> = equations.force.iter().enumerate().map(|(i, e)| (format!("force {}", i + 1), *e)).collect();
    let inputs = Inputs { states: symbols, ..Inputs::default() };
    let found = lower::expressions(graph, "forces of rest", &inputs, &named).map(std::sync::Arc::new).and_then(|tape| {
        let mut evaluator = Evaluator::new(&tape, &[])?;
        evaluator.evaluate(&Point { states: &states, ..Point::default() })?;
        Ok(evaluator.root_roundings().iter().map(|bound| bound / f64::EPSILON).collect())
    });
    let own = || graph.evaluate(&equations.force, &|s| values.get(&s).copied().unwrap_or(0.0)).iter().map(|h| h.abs()).collect();
    found.unwrap_or_else(|_| own())
}

fn dataset(equations: &Equations, rows: &[Row], notes: Vec<Text>) -> Dataset {
    let column = |quantity: Quantity, of: &dyn Fn(&Row) -> f64| Column { quantity, values: rows.iter().map(of).collect() };
    let labelled = |name: &str, unit: &str, label: Text| Quantity { label, ..Quantity::new(name, unit) };
    let mut columns = Vec::new();
    for (j, c) in equations.coordinates.iter().enumerate() {
        let quantity = Quantity { label: c.label.clone(), ..Quantity::new(&name(equations, j), &c.unit) };
        columns.push(column(quantity, &|r| r.place.q[j]));
    }
    for (k, reaction) in equations.reactions.iter().enumerate().filter(|(_, r)| r.law.is_reaction()) {
        let symbol = equations.graph.symbol_info(reaction.symbol).name.clone();
        let quantity = Quantity { symbol, ..labelled(&reaction.name, &reaction.unit, reaction.label.clone()) };
        columns.push(column(quantity, &|r| r.place.reactions[k].unwrap_or(f64::NAN)));
    }
    let label = Text::new("largest relative force", "наибольшая относительная сила");
    columns.push(column(labelled("residual", "1", label), &|r| r.place.residual));
    // without coordinates there is no stability
    let columns_of_motion = if equations.coordinates.is_empty() { Vec::new() } else { verdicts(rows) };
    columns.extend(columns_of_motion);
    let first = Text::new("equilibrium: largest relative force", "равновесие: наибольшая относительная сила");
    let other = Text::new(
        "equilibrium by the second derivation: largest relative force",
        "равновесие по второму выводу: наибольшая относительная сила",
    );
    let mut list = Vec::new();
    if !rows.is_empty() {
        list.push(Audit::at_most("equilibrium", first, audits::worst(rows.iter().map(|r| r.place.residual)), RESIDUAL));
    }
    // loads that the second derivation has in a form without a mean leave nothing to compare
    let seconds: Vec<f64> = rows.iter().filter_map(|r| r.second).collect();
    if !seconds.is_empty() && (!equations.second.is_empty() || equations.force.is_empty()) {
        list.push(Audit::at_most("equilibrium_second", other, audits::worst(seconds), SECOND));
    }
    let mut data = Dataset { columns, notes, audits: list, ..Dataset::default() };
    let open = Text::new("not determined by the equations of rest", "уравнениями покоя не определяется");
    equations.reactions.iter().for_each(|r| data.state(&r.name, Missing::Absent, open.clone()));
    crate::studies::equilibrium::state(&mut data);
    data
}

/// Verdict on stability, growth, directions in which the energy falls.
fn verdicts(rows: &[Row]) -> Vec<Column> {
    let column = |name: &str, unit: &str, label: Text, of: &dyn Fn(&Row) -> f64| {
        let quantity = Quantity { label, ..Quantity::new(name, unit) };
        Column { quantity, values: rows.iter().map(of).collect() }
    };
    let stable = |r: &Row| r.stable.map_or(f64::NAN, |s| f64::from(u8::from(s)));
    let growth = Text::new("largest real part of a root", "наибольшая вещественная часть корня");
    let growth = column("growth", "1/s", growth, &|r| r.growth);
    let negative = Text::new("directions in which the potential energy falls", "направлений убывания потенциальной энергии");
    vec![
        column("stable", "1", Text::new("1 stable, 0 unstable", "1 устойчиво, 0 неустойчиво"), &stable),
        Column { quantity: Quantity { symbol: "lambda".into(), ..growth.quantity }, ..growth },
        column("negative_directions", "1", negative, &|r| r.negative),
    ]
}

/// A machine that no reaction and no condition touches.
pub fn is_free(equations: &Equations) -> bool {
    equations.reactions.is_empty() && equations.conditions.is_empty()
}
