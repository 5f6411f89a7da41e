//! Closed-form motion of a linear system, phase by phase.
//!
//! Between the scheduled switches of the loads the system is M q'' + B q' + C q = f(t) with constant matrices and an exponential polynomial
//! f ([`form`]); its motion is known ([`motion`]), and the state at a switch joins the phases. Beside it stands the numeric twin: the same
//! motion by [`super::simulate`], and the difference of both as a check.

mod cancelling;
pub mod constants;
mod course;
pub mod form;
pub mod load;
pub mod motion;
mod named;
mod obstacle;
pub mod oscillator;
mod phase;
pub(crate) mod phase_error;
mod pushes;
mod rest;
mod rounding;
mod value;
mod walk;

use super::simulate::{self, Grid, Outcome, Simulate};
use crate::audits::worse;
use crate::dataset::{Audit, Column, Dataset, Event};
use crate::marks::named::Named;
use crate::marks::pushes::Push;
use crate::{Fault, Quantity, System};
use algebra::arrange::Arrange;
use motion::Motion;
use phase::{Accelerations, modes};

pub use phase::Phase;
use symbolic::Equations;
use words::Text;
use words::digits::rounded;

/// Options of the study.
pub struct Transient<'a> {
    /// What the numeric twin is asked; its times and outputs are those of the result.
    pub twin: Simulate<'a>,
    /// Ends of the phases that the model names; switches of its formulas are found besides.
    pub ends: Vec<f64>,
    /// Small motions about the equilibrium next to the start, instead of a fault, when the system is not linear.
    pub linearise: bool,
    /// Strands that only pull and tracks that only push.
    pub pushes: Vec<Push>,
}

/// A result: the outcome and the phases.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Found {
    /// Columns over time, checks, what ended the study.
    pub outcome: Outcome,
    /// Phases with their constants.
    pub phases: Vec<Phase>,
}

/// Closed form and twin may differ by this share of the largest value of a column, or by the tolerance of every step of the twin: its phase runs off in
/// proportion to the time.
const TWIN: f64 = 1e-9;
/// The largest difference that confirms anything.
const TWIN_MOST: f64 = 1e-3;
/// Steps of the twin after which it is given up.
const TWIN_STEPS: f64 = 2e6;

/// The motion from `start` (q, q') at t = 0.
///
/// *Errors* beside what was found: see [`form::forms`] and [`Motion::new`]; options without meaning.
pub fn transient<S: System + ?Sized>(system: &mut S, equations: &Equations, start: &[f64], options: Transient<'_>) -> Found {
    let solved = solve(system, equations, start, &options);
    system.impose(None);
    match solved {
        Ok(mut solved) => {
            let until = solved.phases.last().map_or(options.twin.until, |p| p.end);
            twin(system, start, &mut solved, Simulate { until, events: Vec::new(), ..options.twin });
            Found { outcome: Outcome { dataset: solved.dataset, fault: None }, phases: solved.phases }
        }
        Err(fault) => {
            let dataset = Dataset { partial: true, ..Dataset::default() };
            Found { outcome: Outcome { dataset, fault: Some(fault) }, phases: Vec::new() }
        }
    }
}

/// The closed form.
struct Solved {
    dataset: Dataset,
    phases: Vec<Phase>,
    linearised: bool,
}

fn solve<S: System + ?Sized>(system: &mut S, equations: &Equations, start: &[f64], options: &Transient<'_>) -> Result<Solved, Fault> {
    let until = options.twin.until;
    let all = simulate::choose(system.outputs(), options.twin.outputs.as_deref())?;
    let mut times = times(&options.twin, all.len() + 1)?;
    let instants = instants(system, until, &options.ends);
    let rest = match form::forms(equations, &instants, None) {
        Err(_) if options.linearise => Some(rest::place(system, equations, start, &instants[..2])?),
        _ => None,
    };
    let mut phases = phases(equations, &start[..2 * system.n_coordinates()], &instants, &options.ends, rest.as_deref())?;
    let unknown = |i: usize| rest.is_some() && holds_reactions(equations, &system.outputs()[i].name);
    let (chosen, mut hidden): (Vec<usize>, Vec<usize>) = all.into_iter().partition(|i| !unknown(*i));
    let (events, unseen): (Vec<Named>, Vec<Named>) = options.twin.events.iter().cloned().partition(|e| !unknown(e.output));
    hidden.extend(unseen.iter().map(|e| e.output).filter(|i| !hidden.contains(i)).collect::<Vec<_>>());
    let marked = named::follow(system, &mut phases, &chosen, &events);
    if let Some((end, _)) = &marked.ended {
        times.retain(|t| t < end);
        times.push(*end);
    }
    let blurred = phase_error::check(&phases, times.iter().copied().fold(0.0, f64::max))?;
    let pulling = pushes::watch(system, &phases, &options.pushes)?;
    let mut dataset = table(system, &phases, &times, &chosen)?;
    dataset.notes.extend(without_line(system, &hidden));
    dataset.events.extend(marked.events);
    dataset.events.arrange_by(|a, b| a.t.total_cmp(&b.t));
    dataset.notes.extend(simulate::untraced(&marked.lost));
    dataset.notes.extend(marked.ended.map(|(_, told)| told));
    dataset.notes.extend(blurred);
    dataset.notes.extend(cancelling::check(&phases, times.iter().copied().fold(0.0, f64::max)));
    dataset.notes.extend(pulling);
    if let Some(q) = &rest {
        dataset.notes.push(linearised(system, q));
    }
    Ok(Solved { dataset, phases, linearised: rest.is_some() })
}

/// The start, the switches and the end.
fn instants<S: System + ?Sized>(system: &S, until: f64, ends: &[f64]) -> Vec<f64> {
    let scheduled: Vec<f64> = system.guards().iter().filter_map(|g| g.scheduled).collect();
    let silent = ends.iter().copied().filter(|e| !scheduled.iter().any(|s| same(*e, *s)));
    let mut instants: Vec<f64> = scheduled.iter().copied().chain(silent).collect();
    instants.retain(|t| *t > 0.0 && *t < until);
    instants.sort_by(f64::total_cmp);
    instants.dedup_by(|a, b| same(*a, *b));
    std::iter::once(0.0).chain(instants).chain([until]).collect()
}

/// A guard and the end of its phase are one instant, computed on two ways.
fn same(t: f64, s: f64) -> bool {
    (t - s).abs() <= 8.0 * f64::EPSILON * t.abs()
}

fn linearised<S: System + ?Sized>(system: &S, q: &[f64]) -> Text {
    let list = |language: fn(&Text) -> &str| -> String {
        let one = |(state, value): (&Quantity, &f64)| format!("{} = {}", state.symbol, language(&rounded(*value)));
        system.states().iter().zip(q).map(one).collect::<Vec<_>>().join(", ")
    };
    Text::new(
        format!("small motions about the equilibrium {}; products of motions and of loads with motions are dropped", list(|t| &t.en)),
        format!("малые движения около равновесия {}; произведения движений и произведения нагрузок на движения отброшены", list(|t| &t.ru)),
    )
}

/// The phases, joined at the switches.
fn phases(equations: &Equations, start: &[f64], instants: &[f64], ends: &[f64], rest: Option<&[f64]>) -> Result<Vec<Phase>, Fault> {
    let named = |t: f64| ends.iter().any(|e| same(t, *e));
    let forms = form::forms(equations, instants, rest)?;
    let mut found: Vec<Phase> = Vec::new();
    let mut state = start.to_vec();
    let mut i = 0;
    while i < forms.len() {
        // a switch of a formula that changes nothing in the equations is no phase
        let mut last = i;
        while last + 1 < forms.len() && forms[last + 1] == forms[i] && !named(instants[last + 1]) {
            last += 1;
        }
        let (begin, end) = (instants[i], instants[last + 1]);
        let motion = Motion::new(&forms[i], &state, begin)?;
        let state_at_end = motion.states(&[end - begin]).pop().unwrap_or_default();
        let accelerations = if rest.is_some() { Accelerations::OfForm } else { Accelerations::OfEquations };
        let form = forms[i].clone();
        let phase = Phase { start: begin, end, form, motion, state_at_start: state, state_at_end: state_at_end.clone(), accelerations };
        found.push(phase);
        state = state_at_end;
        i = last + 1;
    }
    Ok(found)
}

/// Requested times, in the order of the rows.
fn times(options: &Simulate<'_>, columns: usize) -> Result<Vec<f64>, Fault> {
    simulate::check(options)?;
    let mut requested = simulate::requested(options, columns)?;
    requested.arrange_by_key(|(_, row)| *row);
    Ok(requested.into_iter().map(|(t, _)| t).collect())
}

/// The columns, evaluated on the closed form. At a switch the values after it are shown.
fn table<S: System + ?Sized>(system: &mut S, phases: &[Phase], times: &[f64], chosen: &[usize]) -> Result<Dataset, Fault> {
    let all = system.outputs().to_vec();
    system.show(chosen)?;
    let mut values = vec![0.0; all.len()];
    let mut rows: Vec<Vec<f64>> = vec![vec![f64::NAN; times.len()]; chosen.len()];
    let mut at = 0;
    each_row(phases, times, |row, x| {
        while phases.get(at + 1).is_some_and(|p| times[row] >= p.start) {
            at += 1;
        }
        let (phase, t) = (&phases[at], times[row]);
        let x: Vec<f64> = x.iter().copied().chain(phase.form.turns.iter().map(|turn| turn.at(t))).collect();
        let modes = modes(system, phase, t, &x);
        phase.accelerate(system, t, &x);
        system.observe(t, &x, &modes, &mut values)?;
        for (column, i) in rows.iter_mut().zip(chosen) {
            column[row] = crate::fault::finite(values[*i], &all[*i].name)?;
        }
        Ok(())
    })?;
    let time = Quantity { label: Text::new("time", "время"), ..Quantity::new("t", "s") };
    let mut columns = vec![Column { quantity: time, values: times.to_vec() }];
    columns.extend(chosen.iter().zip(rows).map(|(i, values)| Column { quantity: all[*i].clone(), values }));
    let (extremes, overall, lost) = course::course(system, phases, chosen, &columns);
    let notes = simulate::untraced(&lost).into_iter().collect();
    Ok(Dataset { axis: Some(0), columns, events: starts(system, phases, chosen), extremes, overall, notes, ..Dataset::default() })
}

/// Whether an output holds accelerations or reactions: of the whole equations at a place of small motions they belong to neither motion.
fn holds_reactions(equations: &Equations, name: &str) -> bool {
    let Some(output) = equations.outputs.iter().find(|o| o.name == name) else { return false };
    let reaction = |s: symbolic::SymbolId| equations.reactions.iter().any(|r| r.symbol == s);
    let mut known: Vec<symbolic::SymbolId> = Vec::new();
    for d in &equations.definitions {
        if equations.graph.contains(d.formula, |s| reaction(s) || known.contains(&s)) {
            known.push(d.symbol);
        }
    }
    equations.graph.contains(output.formula, |s| reaction(s) || known.contains(&s))
}

/// Names outputs that small motions do not give.
fn without_line<S: System + ?Sized>(system: &S, hidden: &[usize]) -> Option<Text> {
    let list = hidden.iter().map(|i| system.outputs()[*i].name.as_str()).collect::<Vec<_>>().join(", ");
    (!list.is_empty()).then(|| {
        Text::new(
            format!("not shown: {list}, over reactions, which the linearised motion does not give; `simulate` has them"),
            format!("не показаны {list}: зависят от реакций, которых линеаризованное движение не даёт; они есть в `simulate`"),
        )
    })
}

/// The beginnings of all phases but the first, with the outputs on both sides.
fn starts<S: System + ?Sized>(system: &mut S, phases: &[Phase], chosen: &[usize]) -> Vec<Event> {
    let mut found = Vec::new();
    for (i, pair) in phases.windows(2).enumerate() {
        let before = named::values(system, &pair[0], chosen, pair[0].end - pair[0].start);
        let after = named::values(system, &pair[1], chosen, 0.0);
        found.push(Event {
            t: pair[1].start,
            what: Text::new(format!("phase {} begins", i + 2), format!("начало этапа {}", i + 2)),
            states: [before.0, after.0],
            outputs: [before.1, after.1],
            ..Event::default()
        });
    }
    found
}

/// Visits the closed form at the given times in ascending order: row of the time, state (q, q'). At a switch the later phase is meant.
fn each_row(phases: &[Phase], times: &[f64], mut visit: impl FnMut(usize, &[f64]) -> Result<(), Fault>) -> Result<(), Fault> {
    let mut order: Vec<usize> = (0..times.len()).collect();
    order.arrange_by(|a, b| times[*a].total_cmp(&times[*b]));
    for (k, phase) in phases.iter().enumerate() {
        let later = phases.get(k + 1).map_or(f64::INFINITY, |p| p.start);
        let own: Vec<usize> = order.iter().copied().filter(|i| times[*i] >= phase.start && times[*i] < later).collect();
        let taus: Vec<f64> = own.iter().map(|i| times[*i] - phase.start).collect();
        for (row, x) in own.into_iter().zip(phase.motion.states(&taus)) {
            visit(row, &x)?;
        }
    }
    Ok(())
}

/// The same motion by integration: its checks, and the largest difference of a coordinate or rate, relative to the largest value of its kind; a
/// check where both solve one system, a remark where the closed form is that of small motions.
fn twin<S: System + ?Sized>(system: &mut S, start: &[f64], solved: &mut Solved, mut options: Simulate<'_>) {
    let Solved { dataset, phases, linearised } = solved;
    let states: Vec<Quantity> = system.states()[..2 * system.n_coordinates()].to_vec();
    options.outputs = Some(states.iter().map(|q| q.name.clone()).collect());
    options.most_steps = options.most_steps.min(TWIN_STEPS);
    let times = dataset.columns[0].values.clone();
    options.grid = Grid::At(times.clone());
    let tolerance = options.tolerance;
    let outcome = simulate::simulate(system, start, options);
    if outcome.fault.is_some() || outcome.dataset.partial {
        dataset.notes.push(Text::new(
            "the motion was not integrated numerically for comparison: that would take too many steps",
            "численное интегрирование для сравнения не выполнено: потребовалось бы слишком много шагов",
        ));
        dataset.audits.push(rounding::audit(phases, times.iter().copied().fold(0.0, f64::max)));
        return;
    }
    let largest = |v: &[f64]| v.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
    let numeric = &outcome.dataset.columns[1..];
    // a coordinate that stays at rest is rounding only: the others of its unit set the scale
    let size = |unit: &str| numeric.iter().filter(|c| c.quantity.unit == unit).map(|c| largest(&c.values)).fold(0.0, f64::max);
    let sizes: Vec<f64> = numeric.iter().map(|c| size(&c.quantity.unit)).collect();
    let mut worst = 0.0_f64;
    each_row(phases, &times, |row, x| {
        for ((value, column), size) in x.iter().zip(numeric).zip(&sizes) {
            let difference = (value - column.values[row]).abs();
            if difference != 0.0 {
                worst = worse(worst, difference / size);
            }
        }
        Ok(())
    })
    .ok();
    let name =
        Text::new("closed form against integration: largest difference", "замкнутое решение и интегрирование: наибольшее расхождение");
    let steps = outcome.dataset.counter("steps").unwrap_or(0.0);
    dataset.audits = outcome.dataset.audits;
    if *linearised {
        let share = rounded(worst);
        dataset.notes.push(Text::new(
            format!("largest difference from the nonlinear motion: {} of the largest value", share.en),
            format!("наибольшее отличие от нелинейного движения: {} от наибольшего значения", share.ru),
        ));
    } else {
        dataset.audits.push(Audit::at_most("closed_form", name, worst, (steps * tolerance).clamp(TWIN, TWIN_MOST)));
    }
    dataset.counters = outcome.dataset.counters;
}
