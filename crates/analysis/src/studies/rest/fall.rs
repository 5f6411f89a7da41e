//! Where a machine comes to rest that is let go beside a place: the motion without inertia, against a resistance in proportion to its masses.
//!
//! ```text
//! M q' = h(q)          (M/τ + C) δ = h, q ← q + δ, τ ← τ |h|/|h + ...|        until h = 0
//! ```
//!
//! With connections q moves along their surface: M, C, h are those of the motions that they allow, and every step is drawn back onto it.
//! Downhill all the way, so that an unstable place is not a place to stop at. *Source*: C. T. Kelley, D. E. Keyes, Convergence analysis of pseudo-transient
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

/// The place near which the way from q ends; none where it leads nowhere, and where conditions on rates restrain no places.
pub fn fall(machine: &mut LinearMachine, q: &[f64]) -> Option<Vec<f64>> {
    let mut here = Slope::at(machine, q)?;
    // a hundredth of its own time: a first step that every way can make
    let mut tau = 1e-2 * time(&here.along)?;
    let angles: Vec<bool> = machine.coordinates().iter().map(|c| c.unit == "rad").collect();
    let mut size = 0.0_f64;
    for _ in 0..STEPS {
        let step = here.step(tau);
        size = here.q.iter().zip(&angles).filter(|(_, angle)| !**angle).fold(size, |m, (q, _)| m.max(q.abs()));
        let longest = step.as_ref().map_or(f64::NAN, |s| longest(s, size, &angles));
        let Some(step) = step.filter(|_| longest <= LONGEST) else {
            tau *= 0.5;
            if tau < f64::MIN_POSITIVE {
                return None;
            }
            continue;
        };
        let next: Vec<f64> = here.q.iter().zip(&step).map(|(q, s)| q + s).collect();
        let there = Slope::at(machine, &next)?;
        if longest <= CLOSE && tau * rate(&there.along) > SLOW {
            return Some(there.q);
        }
        tau *= GROWTH;
        here = there;
    }
    None
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
