//! The exact periodic regime: the start that the motion comes back to, its period and its Floquet multipliers.
//!
//! A turn leads from a section (a coordinate has made its turn, or has returned to its value in the same direction, or a given period is over) back to
//! it: x -> P(x), up to translations that leave the motion the same (`symmetry.rs`). Newton's method solves P(x) = x with
//!
//! ```text
//! dP = (1 - f σᵀ/(σ·f)) Φ       Φ fundamental matrix of the turn ([`fundamental`]), f rates at its end, σ the state that defines the section
//! ```
//!
//! on the tangent space of all conditions of connections; far from the regime the map itself is iterated. The multipliers are the eigenvalues of Φ
//! on that space (`spectrum.rs`). For an autonomous machine one of them is 1 (a shift along the motion), which checks the whole computation, as does
//! Liouville's formula (`variation.rs`).
//! *Source*: A. H. Nayfeh, B. Balachandran, Applied Nonlinear Dynamics, 5.2, 7.4.

mod coefficients;
mod faults;
mod found;
mod fundamental;
mod happens;
mod listener;
mod multiple;
mod newton;
mod options;
mod orbit;
mod own;
mod pieces;
mod rest;
mod search;
mod shooting;
mod slopes;
mod spectrum;
mod square;
mod symmetry;
mod touched;
mod trial;
mod turns;
mod variation;
mod verdict;

pub use faults::section_of_forced;
pub(in crate::studies) use fundamental::Meeting;
pub use listener::{Listener, Stage};
pub use options::{Aim, Formula, Multiplier, Periodic, Return};
pub(in crate::studies) use pieces::{Look, Piece, piece};
pub(in crate::studies) use shooting::{Passage, Shooting, Turned, Varied, tangent_of};
pub(in crate::studies) use spectrum::{name_shift, named, of_family};
pub(in crate::studies) use variation::CORRECTS;
pub use verdict::NEUTRAL;

use crate::fault::codes;
use faults::{interrupted, never_passed, nothing_moves, unsettled};
use found::Found;
use fundamental::Blur;
use verdict::stable;
use words::Text;

use super::simulate::{self, Grid};
use crate::dataset::{Audit, Dataset};
use crate::integrate::taylor::check_tolerance;
use crate::{Fault, System};
use words::digits::rounded;

/// A periodic regime.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Regime {
    /// Period, s.
    pub period: f64,
    /// Largest first; none where the turn has no derivative by its start, or does not close.
    pub multipliers: Vec<Multiplier>,
    /// State at the start.
    pub start: Vec<f64>,
    /// What the states gain in a period: whole turns and drift.
    pub gain: Vec<f64>,
    /// Whether every multiplier that is not trivial lies inside the unit circle; none when one is on it, or they are not known.
    pub stable: Option<bool>,
    /// The least period is this part of `period`.
    pub parts: usize,
    /// The forces repeat so many times in `period`; 1 when time does not occur.
    pub forces: usize,
    /// The motion over one period.
    pub dataset: Dataset,
    /// ∂f/∂x at the instants that are asked for, row by row, SI; none where connections tie the states, or the motion switches.
    pub coefficients: Vec<Vec<f64>>,
    /// In how many parts the turn was sought: 1 unless it magnifies its start beyond all digits.
    pub pieces: usize,
    /// The states that have to come back, to which the multipliers belong: no translations, nothing that follows by connections.
    pub returning: Vec<usize>,
    /// Whether the motion from the given start comes to it by itself, without a correction.
    pub own: bool,
}

/// A regime, or why there is none, with what was found so far.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Outcome {
    /// The regime.
    pub regime: Regime,
    /// Why there is no more.
    pub fault: Option<Fault>,
}

/// Most returns tried when nobody says how many a period has.
const RETURNS: usize = 4;

/// Searches the periodic regime from the state `start` at t = 0.
///
/// *Errors*: S056 when there is nothing to move, S057 for a section of a forced machine, S041 when the motion does not come back or comes to rest, S042 when the search does not settle, S043 when a machine driven in time gets no
/// period or a wrong one, and every fault of a motion.
pub fn periodic<S: System + ?Sized>(system: &mut S, start: &[f64], options: &Periodic<'_>) -> Outcome {
    match search(system, start, options) {
        Ok(regime) => Outcome { regime, fault: None },
        Err(fault) => {
            Outcome { regime: Regime { dataset: Dataset { partial: true, ..Dataset::default() }, ..Regime::default() }, fault: Some(fault) }
        }
    }
}

fn search<S: System + ?Sized>(system: &mut S, start: &[f64], options: &Periodic<'_>) -> Result<Regime, Fault> {
    check_tolerance(options.tolerance)?;
    if system.states().is_empty() {
        return Err(nothing_moves());
    }
    let (found, parts) = sought(system, start, options)?;
    let joints = parts.as_ref().map_or_else(Vec::new, |parts| parts.joints.clone());
    let mut dataset = over_a_period(system, &found, joints, options)?;
    let closure = found.closure(system)?;
    let closes = closure.ok;
    if !closes {
        // what does not come back is no regime, whatever the section says
        return Err(unsettled(closure.value, newton::TURNS));
    }
    dataset.audits.insert(0, closure);
    let found = found.disturbed(system)?;
    let pieces = parts.as_ref().map_or(1, |parts| parts.joints.len() + 1);
    let multipliers = match parts {
        Some(parts) => Some(of_parts(parts, &mut dataset)),
        None if closes => multipliers(system, &found, options, &mut dataset)?,
        None => None,
    };
    if found.shrunk && multipliers.as_deref().is_some_and(rest::fades) {
        return Err(rest::at_rest());
    }
    let (parts, forces) = found.repeats(system)?;
    let coefficients = coefficients::along(system, &found, options.coefficients)?;
    let gain = found.orbit.last.iter().zip(&found.orbit.first).map(|(b, a)| b - a).collect();
    let period = found.orbit.period;
    let (returning, own) = (found.returning(None), found.own);
    if let (Return::Period(given), false) = (&options.by, found.is_driven()) {
        dataset.notes.push(own_period(*given, period));
    }
    Ok(Regime {
        period,
        stable: multipliers.as_deref().and_then(stable),
        multipliers: multipliers.unwrap_or_default(),
        start: found.orbit.first,
        gain,
        parts,
        forces,
        dataset,
        coefficients,
        pieces,
        returning,
        own,
    })
}

/// The motion over a period, with its events.
fn over_a_period<S: System + ?Sized>(
    system: &mut S,
    found: &Found<'_>,
    joints: Vec<(f64, Vec<f64>)>,
    options: &Periodic<'_>,
) -> Result<Dataset, Fault> {
    let plan = simulate::Simulate {
        grid: options.grid.clone(),
        outputs: options.outputs.clone(),
        events: happens::watched(options.events),
        pushes: options.pushes.to_vec(),
        tolerance: options.tolerance,
        interrupt: options.listener.interrupt,
        seed: options.seed,
        joints,
        ..simulate::Simulate::until(found.orbit.end())
    };
    let run = simulate::simulate(system, &found.orbit.first, plan);
    if let Some(fault) = run.fault {
        return Err(fault);
    }
    let mut dataset = run.dataset;
    happens::once_a_period(system, found, options.events, &mut dataset)?;
    Ok(dataset)
}

/// The turn, with its parts where they are asked for.
fn sought<'o, S: System + ?Sized>(
    system: &mut S,
    start: &[f64],
    options: &Periodic<'o>,
) -> Result<(Found<'o>, Option<multiple::Parts>), Fault> {
    match (options.aim, options.begin) {
        (Aim::Parts, None) => {
            let (found, parts) = multiple::solve(system, start, options)?.ok_or_else(|| unsettled(1.0, 0))?;
            Ok((found, Some(parts)))
        }
        // an instant of a formula may lie in any part
        (Aim::Parts, Some(_)) => Err(unsettled(1.0, 0)),
        (Aim::Whole, begin) => {
            let found = returned(system, start, options)?;
            Ok((if let Some(begin) = begin { begun(system, found, begin, options)? } else { found }, None))
        }
    }
}

/// The multipliers of a turn in parts, with its audits.
fn of_parts(parts: multiple::Parts, dataset: &mut Dataset) -> Vec<Multiplier> {
    let name = Text::new(
        "the motion from the start of each part comes to that of the next one: largest relative miss",
        "движение от начала каждого участка приходит в начало следующего: наибольшее относительное отклонение",
    );
    dataset.audits.insert(1, Audit::at_most("parts", name, parts.miss, newton::ENOUGH));
    dataset.audits.insert(1, liouville(parts.liouville));
    parts.multipliers
}

/// The audit of determinants.
fn liouville(off: f64) -> Audit {
    let name = Text::new(
        "Liouville's formula: determinant of the variations against the divergence",
        "формула Лиувилля: определитель решений в вариациях против дивергенции",
    );
    // determinant and divergence are integrated apart from one another to nine digits
    Audit::at_most("liouville", name, off, 1e-8)
}

/// A turn that closes; a motion that repeats only after several returns is given them.
fn returned<'o, S: System + ?Sized>(system: &mut S, start: &[f64], options: &Periodic<'o>) -> Result<Found<'o>, Fault> {
    let first = newton::solve(system, start, options);
    if options.returns > 1 || !matches!(options.by, Return::Automatic) || !first.as_ref().is_err_and(|f| f.code == codes::NO_REGIME) {
        return first;
    }
    for returns in 2..=RETURNS {
        if interrupted(options) {
            break;
        }
        let more = Periodic { returns, begin: None, by: Return::Automatic, grid: Grid::Auto, outputs: None, ..*options };
        if let Ok(found) = newton::solve(system, start, &more) {
            return Ok(found);
        }
    }
    first
}

/// The same regime from where the formula passes zero from below.
fn begun<'o, S: System + ?Sized>(system: &mut S, found: Found<'o>, begin: Formula<'_>, options: &Periodic<'o>) -> Result<Found<'o>, Fault> {
    if found.is_driven() {
        return Err(section_of_forced());
    }
    let x = found.orbit.first_zero(begin).ok_or_else(never_passed)?;
    let mut x = found.at_time_zero(x);
    // where the section is passed at an impact, what rounding has left of a gap at zero is no penetration
    newton::tidy(&mut x, &found.scales);
    let again = Periodic { settle: 0.0, begin: None, by: options.by.clone(), grid: Grid::Auto, outputs: None, ..*options };
    // corrected once more; where the section lies on a switch or at rest, the correction may lead away from it
    match newton::solve(system, &x, &again) {
        // the same regime, corrected by what a section changes of it
        Ok(other) if other.away_from(&x) < 1e-6 && (other.orbit.period / found.orbit.period - 1.0).abs() < 1e-6 => {
            Ok(Found { own: found.own && other.own, ..other })
        }
        _ => found.shifted(system, &x, options),
    }
}

/// The multipliers with their audits; none where the turn has no derivative by its start.
fn multipliers<S: System + ?Sized>(
    system: &mut S,
    found: &Found<'_>,
    options: &Periodic<'_>,
    dataset: &mut Dataset,
) -> Result<Option<Vec<Multiplier>>, Fault> {
    let (turn, blur) = match found.turn(system) {
        Ok(found) => found,
        Err(fault) if fault.code == codes::NO_DERIVATIVE || fault.code == codes::NO_VARIATIONS => {
            dataset.notes.push(no_multipliers(&fault));
            return Ok(None);
        }
        Err(fault) => return Err(fault),
    };
    let blur = if blur == Blur::None && touched::is_touched(system, &found.orbit, &found.scales)? { Blur::Grazing } else { blur };
    if let Some(note) = blur.told() {
        dataset.notes.push(note);
        return Ok(None);
    }
    let spectrum = spectrum::spectrum(&turn, options.seed)?;
    let doubt = options.tolerance * spectrum.magnified.unwrap_or(0.0);
    if doubt > DOUBTED {
        dataset.notes.push(hardly_held(doubt));
    }
    if let Some(off) = spectrum.shift {
        let name = Text::new(
            "a shift along the motion has the multiplier 1: difference",
            "сдвиг вдоль движения имеет мультипликатор 1: отклонение",
        );
        // integrals of a turn by differences of rates carry eight digits
        dataset.audits.insert(1, Audit::at_most("trivial_multiplier", name, off, 1e-7));
    }
    dataset.audits.insert(1, liouville(turn.liouville));
    Ok(Some(spectrum.multipliers))
}

/// What a place of a regime may be off by, relative to what the states vary by, before that is told: nine digits are those that are shown and compared.
const DOUBTED: f64 = 1e-9;

/// A multiplier next to 1: what a turn errs by is magnified by 1/(1 - μ) in what closes.
fn hardly_held(doubt: f64) -> Text {
    let by = rounded(doubt);
    Text::new(
        format!(
            "a multiplier lies next to 1: errors of a turn are magnified, and the place of the regime is known to a share of {} only",
            by.en
        ),
        format!(
            "мультипликатор близок к 1: погрешность одного оборота усиливается, и положение режима известно лишь с относительной погрешностью {}",
            by.ru
        ),
    )
}

fn no_multipliers(fault: &Fault) -> Text {
    Text::new(
        format!("no multipliers: {} [{}]", fault.what.en, fault.code),
        format!("мультипликаторов нет: {} [{}]", fault.what.ru, fault.code),
    )
}

fn own_period(given: f64, period: f64) -> Text {
    let (g, p) = (rounded(given), rounded(period));
    Text::new(
        format!("time does not occur in the equations: the period is the motion's own, {} s, and the given {} s was not used", p.en, g.en),
        format!("время в уравнения не входит: период {} с — собственный период движения, заданные {} с не использованы", p.ru, g.ru),
    )
}
