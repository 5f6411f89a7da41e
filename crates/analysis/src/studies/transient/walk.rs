//! Many states of one phase, at instants in any order: the joint exponential from the nearest place before.
//!
//! Places lie ‖A‖ h = 1 apart, each e^(A h) times the one before; from there
//!
//! ```text
//! e^(A d) z = Σ (A d)^k z / k!,      ‖A‖ d <= 1,      until a term no longer counts
//! ```
//!
//! costs some twenty products of the matrix with a vector, where the exponential itself costs as many with a matrix.
//! *Source*: A. H. Al-Mohy, N. J. Higham, Computing the action of the matrix exponential, SIAM J. Sci. Comput. 33 (2011).

use super::motion::{Joint, Motion};
use algebra::expm;

/// More places are not kept: a phase of so many periods of its fastest mode takes an exponential for each state.
const MOST: f64 = 200_000.0;
/// Terms of the sum; 1/40! is far below rounding.
const TERMS: usize = 40;

/// Places on the way through a phase.
pub(super) struct Walk<'m> {
    motion: &'m Motion,
    joint: Option<Places<'m>>,
}

struct Places<'m> {
    joint: &'m Joint,
    step: f64,
    states: Vec<Vec<f64>>,
}

impl<'m> Walk<'m> {
    /// Over [0, length].
    pub(super) fn new(motion: &'m Motion, length: f64) -> Walk<'m> {
        let joint = match motion {
            Motion::Exponential(joint) => Places::new(joint, length),
            Motion::Modes(_) => None,
        };
        Walk { motion, joint }
    }

    /// (q, q') at τ.
    pub(super) fn state(&self, tau: f64) -> Vec<f64> {
        match &self.joint {
            Some(places) => places.state(tau),
            None => self.motion.states(&[tau]).pop().unwrap_or_default(),
        }
    }
}

impl<'m> Places<'m> {
    fn new(joint: &'m Joint, length: f64) -> Option<Places<'m>> {
        let n = joint.size();
        let norm = (0..n).map(|j| (0..n).map(|i| joint.matrix()[i * n + j].abs()).sum::<f64>()).fold(0.0, f64::max);
        let step = 1.0 / norm;
        let count = length * norm;
        if !(step.is_finite() && (1.0..MOST).contains(&count)) {
            return None;
        }
        let whole = expm::exponential(joint.matrix(), n, step)?;
        let mut states = vec![joint.start().to_vec()];
        for _ in 0..count as usize {
            let next = times(&whole, states.last()?);
            states.push(next);
        }
        Some(Places { joint, step, states })
    }

    fn state(&self, tau: f64) -> Vec<f64> {
        let k = ((tau / self.step) as usize).min(self.states.len() - 1);
        let d = tau - k as f64 * self.step;
        let mut sum = self.states[k].clone();
        let mut term = sum.clone();
        for j in 1..=TERMS {
            term = times(self.joint.matrix(), &term);
            term.iter_mut().for_each(|v| *v *= d / j as f64);
            // below a hundredth of the last place nothing is added any more
            let counts = term.iter().zip(&sum).any(|(t, s)| t.abs() > 1e-18 * s.abs());
            sum.iter_mut().zip(&term).for_each(|(s, t)| *s += t);
            if !counts {
                break;
            }
        }
        self.joint.state_of(&sum)
    }
}

/// A row-major square matrix times a vector.
fn times(matrix: &[f64], z: &[f64]) -> Vec<f64> {
    matrix.chunks(z.len()).map(|row| row.iter().zip(z).map(|(a, z)| a * z).sum()).collect()
}
