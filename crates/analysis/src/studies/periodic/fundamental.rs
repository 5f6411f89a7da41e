//! Fundamental matrix of a turn: how a small change of the start changes the end.
//!
//! Inside a step the end is the Taylor polynomial p(x, h), and its derivative by x is a central difference of fourth order in *frozen*
//! modes, where p is analytic. At a switch on the surface g = 0 the perturbed motion arrives later by dt = -(grad g · dx)/(dg/dt), and
//!
//! ```text
//! dx+ = D dx- + (D f- + D_t - f+) dt        saltation; D, D_t derivatives of what an impact does to the state, otherwise 1 and 0
//! ```
//!
//! *Source*: M. A. Aizerman, F. R. Gantmakher, Q. J. Mech. Appl. Math. 11 (1958); R. I. Leine, H. Nijmeijer, Dynamics and Bifurcations of
//! Non-Smooth Mechanical Systems, 7.

use super::orbit::{Jump, Orbit};
use crate::events::Switch;
use crate::taylor::Step;
use crate::{Fault, GuardKind, Mode, System};

/// Half width of the differences, in scales of the state: (1e-3)^4 of truncation against 1e-16/1e-3 of rounding.
const WIDTH: f64 = 1e-3;

/// Rows by state, one column per state.
#[derive(Clone, Debug)]
pub(super) struct Square {
    pub(super) n: usize,
    pub(super) values: Vec<f64>,
}

impl Square {
    pub(super) fn identity(n: usize) -> Square {
        Square { n, values: (0..n * n).map(|k| if k / n == k % n { 1.0 } else { 0.0 }).collect() }
    }
    pub(super) fn at(&self, i: usize, j: usize) -> f64 {
        self.values[i * self.n + j]
    }
    pub(super) fn times(&self, right: &Square) -> Square {
        let n = self.n;
        let entry = |k: usize| (0..n).map(|l| self.at(k / n, l) * right.at(l, k % n)).sum();
        Square { n, values: (0..n * n).map(entry).collect() }
    }
    pub(super) fn apply(&self, x: &[f64]) -> Vec<f64> {
        (0..self.n).map(|i| (0..self.n).map(|j| self.at(i, j) * x[j]).sum()).collect()
    }
}

/// Derivative of a vector function by every state: central differences of fourth order; row i = component i.
pub(crate) fn derivative(
    x: &[f64],
    scales: &[f64],
    mut value: impl FnMut(&[f64]) -> Result<Vec<f64>, Fault>,
) -> Result<Vec<Vec<f64>>, Fault> {
    let mut columns = Vec::with_capacity(x.len());
    for (j, scale) in scales.iter().enumerate().take(x.len()) {
        columns.push(along(x, j, *scale, &mut value)?);
    }
    let rows = columns.first().map_or(0, Vec::len);
    Ok((0..rows).map(|i| columns.iter().map(|c| c[i]).collect()).collect())
}

/// Derivative by state j; a smaller width where the function ends.
fn along(x: &[f64], j: usize, scale: f64, value: &mut impl FnMut(&[f64]) -> Result<Vec<f64>, Fault>) -> Result<Vec<f64>, Fault> {
    let mut width = WIDTH * scale;
    let mut place = x.to_vec();
    for tries in 0..3 {
        let mut at = |k: f64| {
            place[j] = x[j] + k * width;
            value(&place)
        };
        let values = at(-2.0).and_then(|a| Ok([a, at(-1.0)?, at(1.0)?, at(2.0)?]));
        match values {
            Ok([a, b, c, d]) => {
                let difference = |i: usize| (8.0 * (c[i] - b[i]) - (d[i] - a[i])) / (12.0 * width);
                return Ok((0..a.len()).map(difference).collect());
            }
            Err(fault) if tries == 2 => return Err(fault),
            Err(_) => width *= 1e-2,
        }
    }
    Ok(Vec::new())
}

/// Value at h of the polynomial with these coefficients.
fn polynomial(c: &[f64], h: f64) -> f64 {
    c.iter().rev().fold(0.0, |sum, c_k| sum * h + c_k)
}

/// Derivative of a step's end by its start.
fn of_step<S: System + ?Sized>(system: &mut S, step: &Step, n: usize, scales: &[f64]) -> Result<Square, Fault> {
    let x: Vec<f64> = (0..n).map(|i| step.coefficients(i)[0]).collect();
    let (t, h, order) = (step.start.high, step.length, step.order);
    let rows = derivative(&x, scales, |place| {
        system.expand(t, place, &step.modes, order)?;
        // the change only: the start itself would cost digits
        Ok((0..n).map(|i| polynomial(&system.state(i)[1..], h) * h).collect())
    })?;
    let mut matrix = Square { n, values: rows.concat() };
    (0..n).for_each(|i| matrix.values[i * n + i] += 1.0);
    Ok(matrix)
}

/// The fundamental matrix, and whether a switch left it undefined (grazing).
pub(super) fn of_orbit<S: System + ?Sized>(system: &mut S, orbit: &Orbit, scales: &[f64]) -> Result<(Square, bool), Fault> {
    let n = orbit.first.len();
    let mut total = Square::identity(n);
    let mut jumps = orbit.jumps.iter().peekable();
    let mut grazing = false;
    for (k, step) in orbit.steps.iter().enumerate() {
        total = of_step(system, step, n, scales)?.times(&total);
        while let Some(jump) = jumps.next_if(|j| j.after == k) {
            match saltation(system, jump, scales)? {
                Some(matrix) => total = matrix.times(&total),
                None => grazing = true,
            }
        }
    }
    Ok((total, grazing))
}

/// Rates of the state in given modes.
pub(super) fn rates<S: System + ?Sized>(system: &mut S, t: f64, x: &[f64], modes: &[Mode]) -> Result<Vec<f64>, Fault> {
    system.expand(t, x, modes, 1)?;
    Ok((0..x.len()).map(|i| system.state(i)[1]).collect())
}

/// Derivative of the state after a switch by the state before it; none when the switch is grazing.
fn saltation<S: System + ?Sized>(system: &mut S, jump: &Jump, scales: &[f64]) -> Result<Option<Square>, Fault> {
    let n = jump.before.len();
    let closing: Vec<usize> = jump.switches.iter().filter(|s| closes(system, s)).map(|s| s.guard).collect();
    let (map, map_rate) = reset(system, jump, &closing, scales)?;
    let Some(surface) = jump.switches.iter().find_map(|s| surface(system, s)) else { return Ok(Some(map)) };
    let modes = &jump.modes[0];
    let guard = |system: &mut S, x: &[f64]| {
        system.expand(jump.t, x, modes, 1)?;
        let g = system.guard(surface);
        Ok::<[f64; 2], Fault>([g.first().copied().unwrap_or(0.0), g.get(1).copied().unwrap_or(0.0)])
    };
    let speed = guard(system, &jump.before)?[1];
    let gradient = derivative(&jump.before, scales, |x| Ok(vec![guard(system, x)?[0]]))?.concat();
    let size: f64 = gradient.iter().zip(scales).map(|(g, s)| (g * s).abs()).sum();
    let before = rates(system, jump.t, &jump.before, modes)?;
    let after = rates(system, jump.t, &jump.then, &jump.modes[1])?;
    if gradient.iter().all(|g| *g == 0.0) {
        // an instant that does not depend on the state
        return Ok(Some(map));
    }
    let fastest = before.iter().zip(scales).map(|(f, s)| (f / s).abs()).fold(0.0, f64::max);
    if speed.abs() <= 1e-9 * size * fastest {
        return Ok(None);
    }
    let carried = map.apply(&before);
    let mut matrix = map;
    for i in 0..n {
        let jump_of_rate = carried[i] + map_rate[i] - after[i];
        for (entry, slope) in matrix.values[i * n..(i + 1) * n].iter_mut().zip(&gradient) {
            *entry -= jump_of_rate * slope / speed;
        }
    }
    Ok(Some(matrix))
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
        GuardKind::Friction { limits } if leaves_zero => {
            let exits = |i: &&usize| matches!(system.guards()[**i].kind, GuardKind::Bound { exit, .. } if exit == switch.after);
            limits.iter().find(exits).copied()
        }
        GuardKind::Contact { force } if leaves_zero => Some(*force),
        GuardKind::Bound { .. } => None,
        _ => Some(switch.guard),
    }
}

/// What an impact does to the state, linearised: derivative by the state and by time.
fn reset<S: System + ?Sized>(system: &mut S, jump: &Jump, closing: &[usize], scales: &[f64]) -> Result<(Square, Vec<f64>), Fault> {
    let n = jump.before.len();
    let moved = jump.before.iter().zip(&jump.then).zip(scales).any(|((a, b), s)| (a - b).abs() > 1e-9 * s);
    if closing.is_empty() || !moved {
        return Ok((Square::identity(n), vec![0.0; n]));
    }
    let mut hit = |t: f64, x: &[f64]| {
        let mut x = x.to_vec();
        system.impact(t, &mut x, &jump.modes[0], closing)?;
        Ok(x)
    };
    let rows = derivative(&jump.before, scales, |x| hit(jump.t, x))?;
    let h = 1e-6 * (1.0 + jump.t.abs());
    let (early, late) = (hit(jump.t - h, &jump.before)?, hit(jump.t + h, &jump.before)?);
    let by_time = early.iter().zip(&late).map(|(a, b)| (b - a) / (2.0 * h)).collect();
    Ok((Square { n, values: rows.concat() }, by_time))
}
