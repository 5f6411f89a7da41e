//! What a step may err, by state: the tolerance refers to the change of the state within the step, as in `taylor/length.rs`.
//!
//! ```text
//! A_i = max( max_tau |u_i(tau) - u_i(0)| ,  1e-8 max_j A_j over states of one unit ,  2^-52 |x_i| / tol ,  4 noise_i / tol )
//! ```
//!
//! noise_i is the rounding of f (`newton.rs`): large forces that cancel leave it in the rates of fast states.

use super::nodes::Stages;
use crate::integrate::step::UNIT_SHARE;

/// Multiple of the noise that the control does not look below.
const NOISY: f64 = 4.0;

/// A state that has decayed to this is zero: products of it with a tolerance (1e-15) stay above the smallest normal number, 2e-308.
pub(super) const NOTHING: f64 = 1e-280;

/// A_i with the groups of states that have one unit.
#[derive(Clone, Debug)]
pub(super) struct Scales {
    pub(super) tolerance: f64,
    group: Vec<usize>,
    largest: Vec<f64>,
    /// Rounding of f as an error of each state.
    pub(super) noise: Vec<f64>,
    /// A_i.
    pub(super) of: Vec<f64>,
}

impl Scales {
    pub(super) fn new(tolerance: f64, units: &[&str]) -> Scales {
        let first = |unit: &&str| units.iter().position(|u| u == unit).unwrap_or(0);
        let n = units.len();
        Scales { tolerance, group: units.iter().map(first).collect(), largest: vec![0.0; n], noise: vec![0.0; n], of: vec![0.0; n] }
    }

    /// A_i for the present stages.
    pub(super) fn measure(&mut self, x: &[f64], stages: &Stages) {
        self.largest.fill(0.0);
        for (k, change) in self.of.iter_mut().enumerate() {
            *change = stages.column(k).fold(0.0, |m: f64, z| m.max(z.abs()));
            let largest = &mut self.largest[self.group[k]];
            *largest = largest.max(*change);
        }
        for (k, scale) in self.of.iter_mut().enumerate() {
            let rounding = f64::EPSILON * x[k].abs() + NOISY * self.noise[k];
            *scale = scale.max(UNIT_SHARE * self.largest[self.group[k]]).max(rounding / self.tolerance).max(NOTHING);
        }
    }
}
