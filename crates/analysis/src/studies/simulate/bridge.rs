//! Rows that fall into a change point, or beside it.

use super::run::Run;
use crate::integrate::Step;
use crate::marks::bridge::Bridge;
use crate::{Fault, System};

impl Run {
    /// Values around a change point, where forces have few digits, or follow from no equation.
    ///
    /// *Errors*: S059 in the point itself for what grows towards it instead of having a limit.
    pub(super) fn bridge<S: System + ?Sized>(
        &mut self,
        system: &mut S,
        (step, around): (&Step, [f64; 2]),
        t: f64,
        row: usize,
    ) -> Result<(), Fault> {
        let tau = step.start.until(t);
        let raw = match step.at_change_point(tau) {
            Some(_) => Vec::new(),
            None => system.observe(t, &self.x, &step.modes, &mut self.all).map_or(Vec::new(), |()| self.all.clone()),
        };
        let bridge = Bridge::new(around, |tau| {
            let at = step.instant(tau).high;
            step.state_after(tau, &mut self.x);
            system.project(at, &mut self.x, &step.modes)?;
            system.observe(at, &self.x, &step.modes, &mut self.all)?;
            Ok(self.all.clone())
        })?;
        let (beside, mut off) = (Bridge::beside(around), Vec::new());
        step.state_after(beside, &mut self.x);
        let errors: Vec<f64> = self.x.iter().map(|x| f64::EPSILON * x.abs()).collect();
        system.rounding((step.instant(beside).high, &self.x), &step.modes, &errors, &mut off);
        let bridge = bridge.within(off);
        let n = self.chosen.len();
        for (k, &i) in self.chosen.iter().enumerate() {
            let state = system.state_of(i).map(|state| step.value_after(state, tau));
            let value = state.or_else(|| bridge.value(i, tau)).or_else(|| raw.get(i).copied());
            self.table[row * n + k] = value.ok_or_else(|| Fault::blind(&self.outputs[k].name, t))?;
        }
        self.extremes.offer_row(t, &self.table[row * n..(row + 1) * n]);
        Ok(())
    }
}
