//! Rows that fall into a change point.

use super::run::Run;
use crate::integrate::Step;
use crate::{Fault, System};

/// Where values around a change point are taken, in units of the stretch in which conditions are not closed.
const BRIDGE: [f64; 4] = [-2.0, -1.0, 1.0, 2.0];
/// Rounding of forces at these places, relative to their size.
const LIMIT: f64 = 1e-8;

impl Run {
    /// Values in a change point, where forces follow from no equation: the cubic through both sides.
    ///
    /// *Errors*: S059 for what grows towards the point instead of having a limit.
    pub(super) fn bridge<S: System + ?Sized>(
        &mut self,
        system: &mut S,
        (step, [to, around]): (&Step, [f64; 2]),
        t: f64,
        row: usize,
    ) -> Result<(), Fault> {
        let mut sides: Vec<Vec<f64>> = Vec::new();
        for node in BRIDGE {
            let tau = to + node * around;
            let at = step.instant(tau).high;
            step.state_after(tau, &mut self.x);
            system.project(at, &mut self.x, &step.modes)?;
            system.observe(at, &self.x, &step.modes, &mut self.all)?;
            sides.push(self.chosen.iter().map(|&i| self.all[i]).collect());
        }
        let place = (step.start.until(t) - to) / around;
        let n = self.chosen.len();
        let columns = (0..n).map(|k| [0, 1, 2, 3].map(|i: usize| sides[i][k]));
        for (k, column) in columns.enumerate() {
            let value = |i: usize| column[i];
            let (far, near) = ((value(3) - value(0)).abs(), (value(2) - value(1)).abs());
            let size = (0..4).map(|i| value(i).abs()).fold(0.0, f64::max);
            if near > 0.75 * far + LIMIT * size || !size.is_finite() {
                return Err(Fault::blind(&self.outputs[k].name, t));
            }
            self.table[row * n + k] = (0..4).map(|i| value(i) * lagrange(i, place)).sum();
        }
        self.extremes.offer_row(t, &self.table[row * n..(row + 1) * n]);
        Ok(())
    }
}

/// Weight of a node of [`BRIDGE`] in the cubic at `place`.
fn lagrange(i: usize, place: f64) -> f64 {
    let others = (0..4).filter(|k| *k != i);
    others.map(|k| (place - BRIDGE[k]) / (BRIDGE[i] - BRIDGE[k])).product()
}
