//! What rounding makes of the rates and forces of contacts and frictions.
//!
//! Two blocks that slide on together with equal decelerations press each other with N = 0 for all time, and their gap has g'' = 0. Computed, both are a
//! few units in the last place of what cancels in them, of either sign, and a law that asks for N >= 0 or g'' >= 0 would refuse both states. What is
//! nothing follows from the terms that meet: with the rounding δ_i of the balance of coordinate i (running error analysis, all terms of the second
//! derivation at the accelerations and reactions found) and the change dq' of the rates under a unit impulse of the contact, conditions kept,
//!
//! ```text
//! δ(g'') = Σ |dq'_i| δ_i        δN = δ(g'') / (J dq')        δ(g') = units of Σ |J_i q'_i|
//! ```

use program::{Behind, Point};

use super::Machine;
use super::bilateral::Bilateral;
use super::conditions::{Conditions, Holds};
use crate::{Fault, Mode, Tie};
use algebra::lu::Lu;

/// Digits that the linear solve loses beyond the rounding of its terms.
const SOLVED: f64 = 16.0;
/// Rounding of a rate, in units of the last place of the terms that meet in it: chains of blows and the steps before them lose some digits.
pub(super) const RATE: f64 = 4096.0 * f64::EPSILON;

impl Machine {
    /// See [`crate::System::ties`].
    pub(super) fn rounding_of_contacts(&mut self, t: f64, x: &[f64], modes: &[Mode]) -> Option<Vec<(usize, Tie)>> {
        self.conditions.as_ref()?;
        let off = self.rounding_of_balances(t, x, modes)?;
        self.conditions.as_mut()?.ties(t, x, &off).ok()
    }

    /// See [`crate::System::rounding_of_accelerations`]: δ(q'') = Σ |dq'_i| δ_i over unit impulses on all coordinates.
    pub(super) fn accelerations_by_rounding(&mut self, t: f64, x: &[f64], modes: &[Mode]) -> Option<Vec<f64>> {
        let off = self.rounding_of_balances(t, x, modes)?;
        let n = off.len();
        let yields = self.yields(t, x, modes)?;
        let sum = |i: usize| SOLVED * yields.iter().zip(&off).map(|(change, e)| change[i].abs() * e).sum::<f64>();
        Some((0..n).map(sum).collect())
    }

    /// δ_i, rounding of the balance of each coordinate.
    fn rounding_of_balances(&mut self, t: f64, x: &[f64], modes: &[Mode]) -> Option<Vec<f64>> {
        self.observing.set(modes, &self.bound);
        self.solve_forces(t, x).ok()?;
        self.accelerations.iter_mut().filter(|r| !r.is_finite()).for_each(|r| *r = 0.0);
        self.second.evaluate(&Point { time: t, states: x, accelerations: &self.accelerations, ..Point::default() }).ok()?;
        let mut off = Behind::default().rounding(&self.second, &[], &[], &mut Vec::new());
        off.iter_mut().filter(|e| !e.is_finite()).for_each(|e| *e = 0.0);
        Some(off.get(..self.bound.program().coordinates)?.to_vec())
    }

    /// Change of the rates under a unit impulse on each coordinate, connections kept.
    fn yields(&mut self, t: f64, x: &[f64], modes: &[Mode]) -> Option<Vec<Vec<f64>>> {
        let n = self.bound.program().coordinates;
        let unit = |j: usize| (0..n).map(|i| if i == j { 1.0 } else { 0.0 }).collect::<Vec<f64>>();
        let Some(conditions) = &mut self.conditions else {
            let lu = Lu::new(&self.mass(t, x, modes)?, n);
            return (0..n).map(|j| lu.solve(&unit(j))).collect();
        };
        conditions.evaluate(t, x).ok()?;
        let bilateral = Bilateral::new(conditions, t).ok()?;
        let still = bilateral.unmoved();
        (0..n).map(|j| Some(bilateral.response(conditions, &unit(j), &still).ok()?.0)).collect()
    }
}

impl Conditions {
    /// `off`: rounding of the balance of each coordinate.
    fn ties(&mut self, t: f64, x: &[f64], off: &[f64]) -> Result<Vec<(usize, Tie)>, Fault> {
        self.evaluate(t, x)?;
        let bilateral = Bilateral::new(self, t)?;
        let still = bilateral.unmoved();
        let mut ties = Vec::new();
        for (k, row) in self.rows.iter().enumerate() {
            let (Some(reaction), Holds::Sticking(guard, _) | Holds::Closed(guard, _)) = (row.reaction, row.holds) else { continue };
            let (change, _) = bilateral.response(self, self.push(reaction), &still)?;
            let yields: f64 = self.column(k).iter().zip(&change).map(|(j, v)| j * v).sum();
            let acceleration = SOLVED * change.iter().zip(off).map(|(v, e)| v.abs() * e).sum::<f64>();
            let force = if yields > 0.0 { acceleration / yields } else { 0.0 };
            ties.push((guard, Tie { rate: RATE * self.rate_size(k, &x[self.n..2 * self.n]), acceleration, force }));
        }
        Ok(ties)
    }
}
