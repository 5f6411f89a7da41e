//! What is looked at along each accepted step: named events, contacts that begin to pull, extremes, and the checks.

use words::Text;

use super::options::EVENTS;
use super::run::Run;
use crate::dataset::{ContactChange, Event};
use crate::integrate::Step;
use crate::integrate::taylor::Flow;
use crate::marks::Along;
use crate::marks::named::Happened;
use crate::marks::pushes::Beyond;
use crate::proxies::proxy::Source;
use crate::{Fault, System};

impl Run {
    /// Named events, extremes and checks along the last step. How far into the step the motion goes when an event ends it.
    pub(super) fn look<S: System + ?Sized>(&mut self, flow: &mut Flow<'_, S>) -> Option<f64> {
        let (step, system) = flow.step_and_system();
        let mut along = Along::new(step, system, step.length);
        let found = self.named.look(&mut along);
        self.look_at_pushes(&mut along);
        let stop = found.last().filter(|last| self.named.stops(last) && step.instant(last.tau).high > 0.0).cloned();
        for happened in &found {
            self.name_event(happened, &mut along);
        }
        let length = stop.as_ref().map_or(step.length, |stop| stop.tau);
        along.length = length;
        self.extremes.look(&mut along);
        if let Some(largest) = &mut self.rounding {
            let here = along.rounding(length);
            let of = |i: &usize| here.get(*i).copied().filter(|r| r.is_finite()).unwrap_or(0.0);
            largest.iter_mut().zip(&self.chosen).for_each(|(r, i)| *r = r.max(of(i)));
        } else {
            self.audit(step, system, length);
        }
        self.windows.look(step, system, length);
        self.shared.look(system, step);
        if let Some(stop) = &stop {
            self.ended = Some((step.instant(stop.tau).high, stop.event));
        }
        stop.map(|stop| stop.tau)
    }

    /// The checks of a step. A repetition goes without: it is compared with what they have judged.
    fn audit<S: System + ?Sized>(&mut self, step: &Step, system: &mut S, length: f64) {
        self.power.look(step, system);
        self.bodies.look(step, system);
        self.released.look(step, system);
        self.defect.look(step, system);
        self.ledger.look(step, system, length);
        self.friction.look(step, system, length);
        self.touches.look(step, system, length);
    }

    /// Lists where a contact that only pushes begins to pull.
    fn look_at_pushes<S: System + ?Sized>(&mut self, along: &mut Along<'_, S>) {
        for (i, tau) in self.pushes.look(along) {
            let push = &self.pushes.list()[i];
            let what = Text::new(
                format!("{}: the normal force becomes negative", push.label.en),
                format!("{}: нормальная реакция становится отрицательной", push.label.ru),
            );
            let (name, contact) = (push.name.clone(), push.label.en.rsplit(' ').next().unwrap_or_default().to_owned());
            self.list_inside((name, what), [1.0, -1.0], tau, along);
            if let Some(event) = self.events.last_mut() {
                event.contact = Some(ContactChange { contact, from: "pushes", to: "pulls", impulse: None, endless: false });
            }
        }
    }

    /// Lists contacts that only push and would have to pull in an impact.
    pub(super) fn list_pulled(&mut self, (t, pulled): (f64, Vec<usize>), states: &[Vec<f64>; 2], outputs: &[Vec<f64>; 2]) {
        for push in pulled.into_iter().map(|i| &self.pushes.list()[i]).filter(|push| push.beyond == Beyond::Noted) {
            let what = Text::new(
                format!("{}: the normal impulse is negative", push.label.en),
                format!("{}: нормальный импульс отрицателен", push.label.ru),
            );
            let contact = push.label.en.rsplit(' ').next().unwrap_or_default().to_owned();
            // before and behind the instant it pushes
            let contact = Some(ContactChange { contact, from: "pushes", to: "pushes", impulse: None, endless: false });
            let (states, outputs) = (states.clone(), outputs.clone());
            let name = push.name.clone();
            self.events.push(Event {
                t,
                name,
                what,
                guard: usize::MAX,
                sides: [1.0, -1.0],
                states,
                outputs,
                contact,
                impulses: Vec::new(),
            });
        }
    }

    /// Lists a named event with the outputs at its instant.
    fn name_event<S: System + ?Sized>(&mut self, happened: &Happened, along: &mut Along<'_, S>) {
        let name = self.named.events()[happened.event].name.clone();
        let (what, sides) = self.named.told(happened);
        self.list_inside((name, what), sides, happened.tau, along);
    }

    /// Lists an event inside a step.
    fn list_inside<S: System + ?Sized>(&mut self, (name, what): (String, Text), sides: [f64; 2], tau: f64, along: &mut Along<'_, S>) {
        if self.events.len() >= EVENTS {
            return;
        }
        let all = along.outputs(tau).to_vec();
        let outputs: Vec<f64> = self.chosen.iter().map(|&i| all[i]).collect();
        let state = along.whole_state(tau);
        let t = along.time(tau);
        let both = [outputs.clone(), outputs];
        let states = [state.clone(), state];
        self.events.push(Event { t, name, what, guard: usize::MAX, sides, states, outputs: both, contact: None, impulses: Vec::new() });
    }

    /// The last row, at the instant of the event that ends the motion.
    pub(super) fn end_inside<S: System + ?Sized>(&mut self, flow: &mut Flow<'_, S>, tau: f64) -> Result<(), Fault> {
        let (step, system) = flow.step_and_system();
        let t = step.instant(tau).high;
        step.state_after(tau, &mut self.x);
        let row = self.times.len();
        self.times.truncate(self.next);
        self.times.push((t, row));
        self.table.resize((row + 1) * self.chosen.len(), f64::NAN);
        self.next += 1;
        if let Some(around) = step.around_change_point(tau) {
            self.bridge(system, (step, around), t, row)?;
            let n = self.chosen.len();
            self.extremes.end(&self.table[row * n..(row + 1) * n]);
            return Ok(());
        }
        self.fill(system, t, row, &step.modes)?;
        self.close(system, t, &step.modes);
        Ok(())
    }
}
