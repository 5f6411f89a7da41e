//! Whether the polynomial satisfies the equations between the nodes.
//!
//! At the nodes u' = f holds by construction. Halfway between them the defect d = u' - f is measured and turned into the error that it means,
//!
//! ```text
//! e = (1/(h mu) - J)^-1 d          mu the real eigenvalue of A: d h / s for slow states, J^-1 d for fast ones
//! ```
//!
//! so a force that acts only between two nodes is seen, and so is a guard that bends there.

use super::collocation::Collocation;
use super::nodes::Base;
use crate::System;

/// How far the error found between nodes may exceed the tolerance: derivative and interpolation multiply the truncation error of s
/// coefficients.
const SLACK: f64 = 100.0;

impl Collocation {
    /// Largest error between nodes beside what is allowed; none where f has no value.
    pub(super) fn between_nodes<S: System + ?Sized>(&mut self, system: &mut S, base: &Base<'_>, h: f64) -> Option<f64> {
        let mut worst: f64 = 0.0;
        let mut previous = 0.0;
        for i in 0..self.tableau.stages {
            let node = self.tableau.nodes[i];
            let tau = 0.5 * (previous + node) * h;
            previous = node;
            worst = worst.max(self.at(system, base, (tau, h))?);
        }
        Some(worst / SLACK)
    }

    fn at<S: System + ?Sized>(&mut self, system: &mut S, base: &Base<'_>, (tau, h): (f64, f64)) -> Option<f64> {
        let n = base.x.len();
        let mut defect = vec![0.0; n];
        for (k, d) in defect.iter_mut().enumerate() {
            let (z, slope) = crate::integrate::increment_and_slope(self.powers.row(k), tau);
            self.point[k] = base.x[k] + (z + base.low[k]);
            *d = slope;
        }
        system.expand(base.time(tau), &self.point, base.modes, 1).ok()?;
        self.counts.rates += 1;
        defect.iter_mut().enumerate().for_each(|(k, d)| *d -= system.state(k)[1]);
        self.newton.error_of(&self.tableau, h, &mut defect);
        let allowed = |k: usize| self.scales.tolerance * self.scales.of[k];
        let states = (0..n).fold(0.0, |m: f64, k| m.max(larger(defect[k].abs() / allowed(k))));
        let guards = (0..self.n_guards).fold(0.0, |m: f64, k| {
            let Some(&value) = system.guard(k).first() else { return m };
            let off = (crate::integrate::increment_and_slope(self.guard_powers.row(k), tau).0 + self.guard_powers.row(k)[0] - value).abs();
            m.max(larger(off / self.guard_allowance(k)))
        });
        Some(states.max(guards))
    }
}

/// What is no number is infinite.
fn larger(q: f64) -> f64 {
    if q.is_nan() { f64::INFINITY } else { q }
}
