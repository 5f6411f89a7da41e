//! The rows of a table: values at the requested times inside the steps. Where their number follows from that of the steps, the steps wait.

use crate::interrupt::is_set;

use super::options::{Grid, Simulate, parts, requested, settled};
use super::run::{Run, Waiting, timed};
use crate::integrate::Step;
use crate::integrate::taylor::Flow;
use crate::{Fault, Mode, System};

/// Requested times between looks at the interrupt.
const ROWS: usize = 4096;

impl Run {
    /// Values at the requested times inside the last step; its end, or that of the motion, belongs to what follows.
    pub(super) fn sample<S: System + ?Sized>(
        &mut self,
        flow: &mut Flow<'_, S>,
        options: &Simulate<'_>,
        stop: Option<f64>,
    ) -> Result<(), Fault> {
        let steps = flow.work().steps;
        let (step, system) = flow.step_and_system();
        if let Some(trail) = &mut self.trail {
            trail.step(step, stop.unwrap_or(step.length));
        }
        let Some(waiting) = &mut self.waiting else { return self.rows(system, (step, stop), options) };
        waiting.push(Waiting { step: step.clone(), stop });
        if settled(steps) { self.settle_rows(flow, options) } else { Ok(()) }
    }

    /// Makes the rows of the steps that wait, as many as the steps so far ask for.
    pub(super) fn settle_rows<S: System + ?Sized>(&mut self, flow: &mut Flow<'_, S>, options: &Simulate<'_>) -> Result<(), Fault> {
        let Some(waiting) = self.waiting.take() else { return Ok(()) };
        let steps = flow.work().steps;
        if let Some(parts) = parts(steps) {
            let fitted =
                Simulate { grid: Grid::Every(options.until / parts as f64), memory: options.memory, ..Simulate::until(options.until) };
            self.times = requested(&fitted, self.outputs.len() + 1)?;
            self.table = vec![f64::NAN; self.times.len() * self.outputs.len()];
        }
        let (_, system) = flow.step_and_system();
        waiting.iter().try_for_each(|Waiting { step, stop }| self.rows(system, (step, *stop), options))
    }

    fn rows<S: System + ?Sized>(
        &mut self,
        system: &mut S,
        (step, stop): (&Step, Option<f64>),
        options: &Simulate<'_>,
    ) -> Result<(), Fault> {
        let end = stop.map_or_else(|| step.end(), |tau| step.instant(tau));
        while let Some(&(t, row)) = self.times.get(self.next) {
            if end.until(t) >= 0.0 {
                break;
            }
            let tau = step.start.until(t);
            step.state_at(t, &mut self.x);
            // conditions hold at what is shown too, not only at the ends of steps
            if !step.is_blind(tau) {
                system.project(t, &mut self.x, &step.modes)?;
            }
            match step.around_change_point(tau) {
                Some(around) => self.bridge(system, (step, around), t, row)?,
                None => self.fill(system, t, row, &step.modes)?,
            }
            self.next += 1;
            if self.next.is_multiple_of(ROWS) && is_set(options.interrupt) {
                break;
            }
        }
        Ok(())
    }

    pub(super) fn fill<S: System + ?Sized>(&mut self, system: &mut S, t: f64, row: usize, modes: &[Mode]) -> Result<(), Fault> {
        system.observe(t, &self.x, modes, &mut self.all).map_err(|fault| timed(fault, t))?;
        let n = self.chosen.len();
        for (cell, &i) in self.table[row * n..(row + 1) * n].iter_mut().zip(&self.chosen) {
            *cell = self.all[i];
        }
        self.extremes.offer_row(t, &self.table[row * n..(row + 1) * n]);
        Ok(())
    }
}
