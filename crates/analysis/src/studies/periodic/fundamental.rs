//! Fundamental matrix of a turn: how a small change of the start changes the end.
//!
//! Between switches it solves the variational equations (`variation.rs`). At a switch on the surface g = 0 the perturbed motion arrives later by dt = -(grad g · dx)/(dg/dt), and
//!
//! ```text
//! dx+ = D dx- + (D f- + D_t - f+) dt        saltation; D, D_t derivatives of what an impact does to the state, otherwise 1 and 0
//! ```
//!
//! *Source*: M. A. Aizerman, F. R. Gantmakher, Q. J. Mech. Appl. Math. 11 (1958); R. I. Leine, H. Nijmeijer, Dynamics and Bifurcations of
//! Non-Smooth Mechanical Systems, 7.

use super::listener::Listener;
use super::orbit::{Jump, Orbit};
use super::slopes::{by_time, in_piece, slopes};
use super::square::Square;
use super::variation::{self, Care, Chain, Stretch};
use crate::integrate::crossings::{Change, Switch};
use crate::{Fault, GuardKind, Mode, System};
use algebra::elementary;
use words::Text;

/// How a change of the start changes the end of a turn.
#[derive(Clone, Debug)]
pub(super) struct Fundamental {
    /// Rows by state.
    pub(super) matrix: Square,
    /// ln |det|: ∫ tr A dt and what the switches add; none when a switch takes a direction away. For multipliers only.
    pub(super) log_determinant: Option<f64>,
    /// Whether a switch takes a direction away: the matrix has a zero multiplier then, exactly.
    pub(super) singular: bool,
    /// By how much Liouville's formula is missed; for multipliers only.
    pub(super) liouville: f64,
    /// What the matrix may err by, as a share of its largest entry.
    pub(super) doubt: f64,
    /// What leaves the derivative undefined.
    pub(super) blur: Blur,
}

/// Why a derivative by the start is one-sided or missing.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum Blur {
    /// It is not.
    #[default]
    None,
    /// A switch is only touched.
    Grazing,
    /// Two switches happen at once, and which comes first decides.
    Corner,
    /// Infinitely many impacts.
    Accumulation,
    /// Prescribed velocities jump.
    Jolt,
}

impl Blur {
    /// Why there are no multipliers, in words.
    pub(super) fn told(self) -> Option<Text> {
        match self {
            Blur::None => None,
            Blur::Grazing => Some(Text::new(
                "no multipliers: a switch is only touched (grazing), and the motion has no derivative by its start there",
                "мультипликаторов нет: поверхность переключения лишь затронута (касание), производной движения по началу там нет",
            )),
            Blur::Corner => Some(Text::new(
                "no multipliers: two switches happen at one instant, and which of them a neighbouring motion meets first decides",
                "мультипликаторов нет: два переключения происходят одновременно, и важно, которое из них соседнее движение встретит первым",
            )),
            Blur::Accumulation => Some(Text::new(
                "no multipliers: infinitely many impacts lie in the period",
                "мультипликаторов нет: в периоде бесконечно много ударов",
            )),
            Blur::Jolt => Some(Text::new(
                "no multipliers: prescribed velocities jump within the period",
                "мультипликаторов нет: в периоде заданные скорости изменяются скачком",
            )),
        }
    }
}

/// The fundamental matrix of a turn.
pub(super) fn of_orbit<S: System + ?Sized>(
    system: &mut S,
    orbit: &Orbit,
    scales: &[f64],
    (care, listener): (Care, Listener<'_>),
) -> Result<Fundamental, Fault> {
    let balanced = variation::balanced(system, orbit, scales);
    let mut chain = Chain::new(orbit.first.len());
    let (mut log_determinant, mut liouville, mut blur) = (Some(0.0), 0.0, Blur::None);
    let (mut from, mut singular) = (0, false);
    for jump in orbit.jumps.iter().map(Some).chain([None]) {
        let to = jump.map_or(orbit.steps.len(), |j| j.after + 1);
        // a change of modes without a switch parts the motion too
        for steps in orbit.steps[from..to].chunk_by(|a, b| a.modes == b.modes) {
            let stretch = Stretch { steps, scales: &balanced, period: orbit.period, care, listener };
            let varied = variation::vary(system, &stretch, &mut chain)?;
            log_determinant = log_determinant.map(|l| l + varied.divergence);
            liouville += varied.liouville;
        }
        from = to;
        let Some(jump) = jump else { break };
        match saltation(system, jump, (scales, orbit.period))? {
            Saltation::Matrix { map: mut scaled, mut terms, error } => {
                scaled.scale(&balanced);
                terms.scale(&balanced);
                let size = scaled.determinant().abs();
                // a column in which everything cancels has a length of rounding: what met in it tells
                let takes = size.is_nan() || size <= SINGULAR * terms.hadamard();
                singular |= takes;
                log_determinant = log_determinant.filter(|_| !takes).map(|l| l + elementary::ln(size));
                let error = error * scaled.norm();
                chain.push(scaled, error);
            }
            Saltation::Undefined(undefined) => blur = undefined,
        }
    }
    let (doubt, mut matrix) = (chain.doubt(), chain.whole);
    matrix.unscale(&balanced);
    Ok(Fundamental { matrix, log_determinant, singular, liouville, doubt, blur })
}

/// Rates of the state in given modes.
pub(super) fn rates<S: System + ?Sized>(system: &mut S, t: f64, x: &[f64], modes: &[Mode]) -> Result<Vec<f64>, Fault> {
    system.expand(t, x, modes, 1)?;
    Ok((0..x.len()).map(|i| system.state(i)[1]).collect())
}

/// Derivative of the state after a switch by the state before it.
enum Saltation {
    /// The matrix, the magnitudes of the terms that met in its entries, and the share of them by which it may err.
    Matrix {
        map: Square,
        terms: Square,
        error: f64,
    },
    Undefined(Blur),
}

/// A determinant of a switch below this share of what its terms could make is zero.
const SINGULAR: f64 = 1e-12;
/// A guard is on its surface when it is below this share of its range.
const CAUSE: f64 = 1e-7;
/// Scales of a state that it passes in a period at most: what is carried along with the frame of the motion stands still in it, and has no scale of its own.
const QUICKEST: f64 = 1e4;
/// Share of its terms to which a guard is zero where it is met.
const ROUNDED: f64 = 4.0 * f64::EPSILON;
/// Surfaces whose normals differ by more than this are two.
const PARALLEL: f64 = 1e-7;

fn saltation<S: System + ?Sized>(system: &mut S, jump: &Jump, (scales, period): (&[f64], f64)) -> Result<Saltation, Fault> {
    let n = jump.before.len();
    if jump.switches.iter().any(|s| matches!(s.change, Change::Rests { .. })) {
        return Ok(Saltation::Undefined(Blur::Accumulation));
    }
    if jump.switches.iter().any(|s| s.change == Change::Jolt) {
        return Ok(Saltation::Undefined(Blur::Jolt));
    }
    let closing: Vec<usize> = jump.switches.iter().filter(|s| closes(system, s)).map(|s| s.guard).collect();
    let Some((map, map_rate)) = reset(system, jump, &closing, (scales, period))? else { return Ok(Saltation::Undefined(Blur::Corner)) };
    let surfaces: Vec<usize> = jump.switches.iter().filter_map(|s| surface(system, s)).collect();
    let modes = &jump.modes[0];
    let mut rows = Vec::new();
    slopes(system, (jump.t, &jump.before), modes, scales, &mut rows)?;
    let before = rates(system, jump.t, &jump.before, modes)?;
    system.expand(jump.t, &jump.before, modes, 2)?;
    let values: Vec<[f64; 2]> = surfaces.iter().map(|s| [0, 2].map(|k| system.guard(*s).get(k).copied().unwrap_or(0.0))).collect();
    let after = rates(system, jump.t, &jump.then, &jump.modes[1])?;
    let quick = |(f, s): (&f64, &f64)| (f / s).abs().min(QUICKEST / period);
    let fastest = before.iter().zip(scales).map(quick).fold(0.0, f64::max);
    // instant of the switch by the state before it: dt = -(grad g . dx)/(dg/dt)
    let mut later: Option<Vec<f64>> = None;
    let mut error: f64 = 0.0;
    for (surface, [value, bend]) in surfaces.into_iter().zip(values) {
        let row = &rows[(n + surface) * (n + 1)..(n + surface + 1) * (n + 1)];
        let size: f64 = row[..n].iter().zip(scales).map(|(g, s)| (g * s).abs()).sum();
        if size == 0.0 || value.abs() > CAUSE * size {
            // an instant that does not depend on the state, or a change that another surface has caused
            continue;
        }
        let speed = row[n] + row[..n].iter().zip(&before).map(|(g, f)| g * f).sum::<f64>();
        // the section is touched: the instant has no derivative
        if speed.is_nan() || speed.abs() <= 1e-9 * size * fastest {
            return Ok(Saltation::Undefined(Blur::Grazing));
        }
        // where a guard is rounding is when it is met rounding over its rate, and the rate changes by its bend meanwhile
        error = error.max(2.0 * bend.abs() * ROUNDED * size / (speed * speed));
        let own: Vec<f64> = row[..n].iter().map(|g| -g / speed).collect();
        let differs = |other: &Vec<f64>| {
            let entries = own.iter().zip(other).zip(scales);
            let (off, whole) = entries.fold((0.0, 0.0), |(off, whole), ((a, b), s)| (off + ((a - b) * s).abs(), whole + (a * s).abs()));
            off > PARALLEL * whole
        };
        if later.as_ref().is_some_and(differs) {
            return Ok(Saltation::Undefined(Blur::Corner));
        }
        later.get_or_insert(own);
    }
    let mut terms = map.clone();
    terms.values.iter_mut().for_each(|v| *v = v.abs());
    let Some(later) = later else { return Ok(Saltation::Matrix { map, terms, error }) };
    let carried = map.apply(&before);
    let mut matrix = map;
    for i in 0..n {
        let jump_of_rate = carried[i] + map_rate[i] - after[i];
        let met = carried[i].abs() + map_rate[i].abs() + after[i].abs();
        for (j, dt) in later.iter().enumerate() {
            matrix.values[i * n + j] += jump_of_rate * dt;
            terms.values[i * n + j] += met * dt.abs();
        }
    }
    Ok(Saltation::Matrix { map: matrix, terms, error })
}

fn closes<S: System + ?Sized>(system: &S, switch: &Switch) -> bool {
    matches!(system.guards()[switch.guard].kind, GuardKind::Contact { .. }) && switch.before == Mode::Positive
}

/// The guard whose zero is the instant of a switch; none for instants that are fixed beforehand.
fn surface<S: System + ?Sized>(system: &S, switch: &Switch) -> Option<usize> {
    let guard = &system.guards()[switch.guard];
    if guard.scheduled.is_some() {
        return None;
    }
    let leaves_zero = switch.before == Mode::Zero && switch.after != Mode::Zero;
    match &guard.kind {
        GuardKind::Friction { limits, .. } if leaves_zero => {
            let exits = |i: &&usize| matches!(system.guards()[**i].kind, GuardKind::Bound { exit, .. } if exit == switch.after);
            limits.iter().find(exits).copied()
        }
        GuardKind::Contact { force } if leaves_zero => Some(*force),
        GuardKind::Bound { .. } => None,
        _ => Some(switch.guard),
    }
}

/// How a guard is met.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::studies) struct Meeting {
    /// Its number.
    pub(in crate::studies) guard: usize,
    /// Magnitude of its rate, in its unit per second.
    pub(in crate::studies) rate: f64,
    /// What it changes by where the states do by their scales; 0 of a switch of time alone.
    pub(in crate::studies) felt: f64,
    /// By what share of itself the rate changes where the states do by a share of their scales, per that share: it is the root of how far the guard is passed.
    pub(in crate::studies) unsure: f64,
}

/// The guards whose zero is the instant of a jump.
pub(super) fn met<S: System + ?Sized>(system: &mut S, jump: &Jump, scales: &[f64]) -> Result<Vec<Meeting>, Fault> {
    let n = jump.before.len();
    let surfaces: Vec<usize> = jump.switches.iter().filter_map(|s| surface(system, s)).collect();
    let mut rows = Vec::new();
    slopes(system, (jump.t, &jump.before), &jump.modes[0], scales, &mut rows)?;
    system.expand(jump.t, &jump.before, &jump.modes[0], 2)?;
    let meeting = |guard: usize| {
        let (rate, bend) = system.guard(guard).get(1).zip(system.guard(guard).get(2))?;
        let row = &rows[(n + guard) * (n + 1)..][..n];
        let size: f64 = row.iter().zip(scales).map(|(g, s)| (g * s).abs()).sum();
        Some(Meeting { guard, rate: rate.abs(), felt: size, unsure: 2.0 * bend.abs() * size / (rate * rate) })
    };
    Ok(surfaces.into_iter().filter_map(meeting).collect())
}

/// What an impact does to the state, linearised: derivative by the state and by time; none where something else would happen right beside it.
fn reset<S: System + ?Sized>(
    system: &mut S,
    jump: &Jump,
    closing: &[usize],
    (scales, period): (&[f64], f64),
) -> Result<Option<(Square, Vec<f64>)>, Fault> {
    let n = jump.before.len();
    // what changes by rounding does not jump
    let moved = jump.before.iter().zip(&jump.then).zip(scales).any(|((a, b), s)| (a - b).abs() > 1e-9 * s);
    if closing.is_empty() || !moved {
        return Ok(Some((Square::identity(n), vec![0.0; n])));
    }
    let mut hit = |t: f64, x: &[f64]| {
        let mut x = x.to_vec();
        system.impact(t, &mut x, &jump.modes[0], closing)?;
        Ok(x)
    };
    let Some(rows) = in_piece(&jump.before, scales, |x| hit(jump.t, x))? else { return Ok(None) };
    let rates = by_time(jump.t, period, |t| hit(t, &jump.before))?;
    Ok(Some((Square { n, values: rows.concat() }, rates)))
}
