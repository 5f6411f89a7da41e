//! Whether an implicit step hides something between its points of evaluation.
//!
//! The nodes of a step and the places halfway between them are blind to a force that begins and ends between two of them, and so is the Newton
//! iteration. What the values do not show, the operands do: the operations of the equations and of the guards in force are recorded at Chebyshev's
//! points of the step and judged as those behind an output are (`proxies/behind.rs`, docs/theory/marks.md), with the tolerance of the motion for the error of
//! their polynomials. States are known to a few tolerances inside a step, which a stiff force magnifies; that much of an operation is not looked at.

use super::collocation::Collocation;
use super::nodes::Base;
use crate::System;
use crate::proxies::behind::Look;

/// Error of the polynomials of operations, at least.
const ERROR: f64 = 1e-11;
/// Error of a state inside a step, in tolerances of its change.
const INSIDE: f64 = 10.0;

impl Collocation {
    /// Whether every operation is seen at the points of the step.
    pub(super) fn is_seen<S: System + ?Sized>(&mut self, system: &mut S, base: &Base<'_>, h: f64) -> bool {
        let Some(behind) = system.acting(base.modes) else { return true };
        let tolerance = self.scales.tolerance;
        let errors: Vec<f64> =
            self.scales.of.iter().zip(base.x).map(|(scale, x)| INSIDE * tolerance * scale + f64::EPSILON * x.abs()).collect();
        let n = self.points.n;
        let mut rows: Vec<Vec<f64>> = Vec::with_capacity(n + 1);
        let mut noise = vec![0.0_f64; behind.width()];
        let mut rounding = Vec::new();
        for j in 0..=n {
            let tau = self.points.u[j] * h;
            for k in 0..base.x.len() {
                let (z, _) = crate::integrate::increment_and_slope(self.powers.row(k), tau);
                self.point[k] = base.x[k] + (z + base.low[k]);
            }
            let mut row = Vec::with_capacity(behind.width());
            if system.act(base.time(tau), &self.point, base.modes, &mut row).is_err() {
                return false;
            }
            // rounding changes little along a step: its ends and its middle tell
            if j % (n / 2) == 0 {
                system.act_rounding(&errors, &mut rounding);
                noise.iter_mut().zip(&rounding).for_each(|(most, r)| *most = most.max(if r.is_finite() { *r } else { 0.0 }));
            }
            rows.push(row);
        }
        let mut look = Look::new(&self.points, &rows, &behind, 0, tolerance.max(ERROR));
        (0..behind.nodes.len()).all(|node| look.sees(node, &|place| noise[place]))
    }
}
