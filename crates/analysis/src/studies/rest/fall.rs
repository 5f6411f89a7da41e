//! Where a machine comes to rest that is let go beside a place: the motion without inertia, against a resistance in proportion to its masses.
//!
//! ```text
//! M q' = h(q)          (M/τ + C) δ = h, q ← q + δ, τ ← τ |h|/|h + ...|        until h = 0
//! ```
//!
//! With connections q moves along their surface: M, C, h are those of the motions that they allow, and every step is drawn back onto it.
//! Downhill all the way, so that an unstable place is not a place to stop at. A step is one along a smooth force only if the force behind it is the one that force and
//! stiffness before it foretell, and the stiffness has not changed by more than the forces: with f = h·δ, c = δ·Cδ before (0) and behind (1)
//!
//! ```text
//! |f₁ − f₀ + c₀| ≤ (|f₀| + |f₁|)/2,     |c₁ − c₀| ≤ |f₀| + |f₁|
//! ```
//!
//! Across a pole of the force, F/(d − x)ⁿ, one of both is missed at any length of the step: for odd n the first, since f turns round, for even n the second, since c does. So
//! steps towards a pole shrink with the distance from it and do not pass it. *Source*: C. T. Kelley, D. E. Keyes, Convergence analysis of pseudo-transient
//! continuation, SIAM J. Numer. Anal. 35 (1998) 508-523.

use crate::linear::{LinearMachine, Matrices, parts};
use algebra::cholesky::positive_definite;
use algebra::lu::Lu;

/// Steps at most.
const STEPS: usize = 4000;
/// Longest change in one step: of an angle, rad; of other coordinates relative to the largest value that one of them had.
const LONGEST: f64 = 0.02;
/// Growth of the step of time at most.
const GROWTH: f64 = 2.0;
/// Steps that are this small in the same measure end the way.
const CLOSE: f64 = 1e-9;
/// Steps of time, relative to the fastest motion, in which a machine that is let go on a slope would have moved further.
const SLOW: f64 = 1e3;

/// Steps above this, in the same measure, show how large forces are where nothing is singular.
const COARSE: f64 = 1e-4;
/// Forces more than so many times these, met where steps have become [`CLOSE`], are those of a pole, which grow by the ratio of both lengths at least; a force that jumps
/// is finite.
const JUMP: f64 = 1e4;

/// Where a way ends.
pub(super) enum Way {
    /// Near this place of rest.
    Rests(Vec<f64>),
    /// It leads nowhere, or conditions on rates restrain no places.
    Nowhere,
    /// In a pole of the forces, or where a formula ends: the machine is drawn in and does not come to rest.
    Singular,
}

/// The place near which the way from q ends; none where it leads nowhere or into a pole, and where conditions on rates restrain no places.
pub fn fall(machine: &mut LinearMachine, q: &[f64]) -> Option<Vec<f64>> {
    match way(machine, q) {
        Way::Rests(q) => Some(q),
        Way::Nowhere | Way::Singular => None,
    }
}

/// The way downhill from q.
pub(super) fn way(machine: &mut LinearMachine, q: &[f64]) -> Way {
    let Some(mut here) = Slope::at(machine, q) else { return Way::Nowhere };
    let Some(own) = time(&here.along) else { return Way::Nowhere };
    // a hundredth of its own time: a first step that every way can make
    let mut tau = 1e-2 * own;
    let mut usual = 0.0_f64;
    let angles: Vec<bool> = machine.coordinates().iter().map(|c| c.unit == "rad").collect();
    let mut size = 0.0_f64;
    for _ in 0..STEPS {
        let step = here.step(tau);
        size = here.q.iter().zip(&angles).filter(|(_, angle)| !**angle).fold(size, |m, (q, _)| m.max(q.abs()));
        let longest = step.as_ref().map_or(f64::NAN, |s| longest(s, size, &angles));
        let Some(step) = step.filter(|_| longest <= LONGEST) else {
            tau *= 0.5;
            if tau < f64::MIN_POSITIVE {
                return Way::Nowhere;
            }
            continue;
        };
        let next: Vec<f64> = here.q.iter().zip(&step).map(|(q, s)| q + s).collect();
        let there = Slope::at(machine, &next);
        if let Some(there) = &there
            && longest <= CLOSE
            // beside a pole only the stiffness behind the step is large
            && tau * rate(&there.along).min(rate(&here.along)) > SLOW
        {
            return Way::Rests(there.q.clone());
        }
        let Some(there) =
            there.filter(|there| follows(&here, there, &step) || longest <= CLOSE && jumps(&here, there, (&step, longest), usual))
        else {
            if longest <= CLOSE {
                return Way::Singular;
            }
            tau *= 0.5;
            continue;
        };
        if longest > COARSE {
            usual = usual.max((power(&here, &step) / longest).abs());
        }
        tau *= GROWTH;
        here = there;
    }
    Way::Nowhere
}

/// h·δ.
fn power(at: &Slope, step: &[f64]) -> f64 {
    at.along.force.iter().zip(step).map(|(h, s)| h * s).sum()
}

/// δ·Cδ.
fn bent(at: &Slope, step: &[f64]) -> f64 {
    let n = step.len();
    let row = |i: usize| (0..n).map(|j| at.along.stiffness[i * n + j] * step[j]).sum::<f64>();
    (0..n).map(|i| step[i] * row(i)).sum()
}

/// Whether the force behind a step is the one foretold. Along connections, whose free directions differ from place to place, it is not asked.
fn follows(here: &Slope, there: &Slope, step: &[f64]) -> bool {
    if here.basis.is_some() || there.basis.is_some() {
        return true;
    }
    let (before, behind) = (power(here, step), power(there, step));
    let (c, next) = (bent(here, step), bent(there, step));
    let size = before.abs() + behind.abs();
    (behind - before + c).abs() <= 0.5 * size && (next - c).abs() <= size
}

/// Whether the forces beside a step that is all but none are finite ones, beside those that are usual on the way.
fn jumps(here: &Slope, there: &Slope, (step, longest): (&[f64], f64), usual: f64) -> bool {
    let largest = power(here, step).abs().max(power(there, step).abs());
    usual == 0.0 || largest <= JUMP * usual * longest
}

/// A place on the surface of the connections, with the matrices along it.
pub(super) struct Slope {
    pub(super) q: Vec<f64>,
    pub(super) along: Matrices,
    /// Basis of the motions along the surface, row by row; none where all coordinates are free.
    pub(super) basis: Option<Vec<f64>>,
    /// The stiffness of all coordinates.
    pub(super) whole: Vec<f64>,
}

impl Slope {
    pub(super) fn at(machine: &mut LinearMachine, q: &[f64]) -> Option<Slope> {
        let place = machine.drawn(q).ok()?;
        let found = machine.at(&place).ok()?;
        if !found.drift.is_empty() {
            return None;
        }
        let whole = found.stiffness.clone();
        Some(match found.allowed() {
            Some((z, k)) => Slope { q: place.q, along: found.reduced(&z, k), basis: Some(z), whole },
            None => Slope { q: place.q, along: found, basis: None, whole },
        })
    }

    /// The change of the coordinates in a step of time; none beyond the step at which the way would turn uphill.
    fn step(&self, tau: f64) -> Option<Vec<f64>> {
        let k = self.along.n;
        if k == 0 {
            return None;
        }
        let resistance = resistance(&self.along);
        let matrix: Vec<f64> = (0..k * k).map(|p| resistance[p] / tau + self.along.stiffness[p]).collect();
        let downhill = positive_definite(&parts(&matrix, k).0, k) == Some(true);
        let along = Lu::new(&matrix, k).solve(&self.along.force).filter(|_| downhill)?;
        Some(match &self.basis {
            Some(z) => z.chunks(k).map(|row| row.iter().zip(&along).map(|(z, y)| z * y).sum()).collect(),
            None => along,
        })
    }
}

/// The longest change, angles in rad, others relative to a size.
fn longest(step: &[f64], size: f64, angles: &[bool]) -> f64 {
    let unit = |angle: bool| if angle || size == 0.0 { 1.0 } else { size };
    step.iter().zip(angles).map(|(s, angle)| s.abs() / unit(*angle)).fold(0.0, f64::max)
}

/// M, with a share of its largest entry where a coordinate moves no mass.
fn resistance(m: &Matrices) -> Vec<f64> {
    let n = m.n;
    let largest = (0..n).fold(0.0_f64, |l, i| l.max(m.mass[i * n + i]));
    let mut out = m.mass.clone();
    // some mass, so that the way has a direction there; where it ends does not depend on it
    let least = if largest > 0.0 { 1e-3 * largest } else { 1.0 };
    for entry in (0..n).map(|i| i * n + i) {
        if out[entry] <= 0.0 {
            out[entry] = least;
        }
    }
    out
}

/// Largest rate of the way, 1/s²: |C| over the masses.
fn rate(m: &Matrices) -> f64 {
    let (n, mass) = (m.n, resistance(m));
    (0..n).map(|i| (0..n).map(|j| m.stiffness[i * n + j].abs()).sum::<f64>() / mass[i * n + i]).fold(0.0, f64::max)
}

fn time(m: &Matrices) -> Option<f64> {
    let rate = rate(m);
    (rate > 0.0 && rate.is_finite()).then(|| rate.recip())
}
