//! A motion under way: its state and what is known of it. What it does next stands in the files beside this one and in `events`.

use super::implicit::Implicit;
use super::length::Rule;
use super::options::{Check, Work};
use super::over::Passage;
use crate::integrate::Step;
use crate::integrate::crossings::roots::RootFinder;
use crate::integrate::crossings::{Hit, Rival, Switch};
use crate::{Blow, Fault, GuardKind, Mode, System, Tie};
use algebra::sum::Instant;
use std::sync::Arc;

/// A motion under way.
pub struct Flow<'s, S: System + ?Sized> {
    pub(crate) system: &'s mut S,
    pub(super) rule: Rule,
    pub(crate) now: Instant,
    pub(crate) x: Vec<f64>,
    /// x + low is the state; low is what rounding would cut.
    pub(super) low: Vec<f64>,
    /// State before the last event; an impact changes rates.
    pub(crate) before: Vec<f64>,
    /// Modes before the last event.
    pub(crate) modes_before: Vec<Mode>,
    /// State after the impacts of an event, from which every trial of modes begins.
    pub(crate) base: Vec<f64>,
    /// Largest relative violation of conditions that a projection removed.
    pub(super) drift: f64,
    /// That of the step under trial.
    pub(super) removed: f64,
    /// The same by condition: largest violation and largest size along the motion.
    pub(super) drifts: Vec<[f64; 2]>,
    pub(crate) modes: Vec<Mode>,
    /// Guards that leave `Zero` in the present trial.
    pub(crate) leaving: Vec<bool>,
    /// Contacts that have just rebounded.
    pub(crate) rebounds: Vec<bool>,
    /// Whether prescribed velocities jump at this instant.
    pub(crate) jolted: bool,
    /// A closed contact is struck by its own surface at this instant, which rises behind a switch.
    pub(crate) risen: bool,
    /// The last impact at each contact.
    pub(crate) hits: Vec<Option<Hit>>,
    /// What the impact of the last event did.
    pub(crate) blow: Option<Arc<Blow>>,
    /// Guards that the event crossed, and the owners of crossed bounds; all where an impact or the start decides everything.
    pub(crate) fired: Vec<bool>,
    /// What is nothing at contacts and frictions, by guard; found where a law is violated, since the last event.
    pub(crate) ties: Vec<Tie>,
    /// Whether `ties` are those of the present state.
    pub(crate) weighed: bool,
    /// For a guard that has just been crossed: number of leading coefficients that vanish (multiplicity of its root at the step's start).
    pub(crate) deflation: Vec<usize>,
    /// Guards on their surface now.
    pub(crate) touched: Vec<bool>,
    /// The same as the event left it, before the trials of modes; and what was on its surface in one of them.
    pub(crate) grounded: Vec<bool>,
    pub(crate) met: Vec<bool>,
    /// sum |g_k| h^k of each guard when it was last expanded: what counts as small.
    pub(crate) guard_scale: Vec<f64>,
    /// The largest contact or normal force where modes were decided last.
    pub(crate) loads: f64,
    /// Rounding of each guard's value at the end of the last step; zero at the start.
    pub(crate) guard_noise: Vec<f64>,
    /// Expansion at the current point is in the system.
    pub(super) expanded: bool,
    pub(super) check: Check,
    /// Angles that only turn, by state.
    pub(super) freely: Vec<usize>,
    /// Whole fours of turns taken off each state.
    pub(super) turns: Vec<f64>,
    /// The state with its turns.
    pub(super) shown: Vec<f64>,
    pub(super) step: Step,
    pub(super) next_x: Vec<f64>,
    pub(super) next_low: Vec<f64>,
    pub(super) next_slope: Vec<f64>,
    /// Scratch for trials of modes.
    pub(super) trial: Step,
    pub(super) guess: f64,
    pub(super) span: f64,
    /// Length of an undisturbed step where modes were decided last.
    pub(crate) natural: f64,
    pub(crate) switches: Vec<Switch>,
    /// Another motion that obeys the laws where modes were decided at the end of the last step.
    pub(crate) rivals: Vec<Rival>,
    pub(super) crowd: Crowd,
    pub(super) implicit: Implicit,
    pub(super) passage: Passage,
    /// Defect per length of the last step where it was rounding of the system itself.
    pub(super) rough: Option<f64>,
    pub(crate) roots: RootFinder,
    pub(crate) work: Work,
}

/// What stands at the end of a step.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Ending {
    Event,
    Plain,
}

/// Expansion at (t, x), of a lower order where coefficients overflow: those of a damping of 1e13 1/s do at order 25. What the system has of it is continued.
pub(super) fn extend_within_range<S: System + ?Sized>(
    system: &mut S,
    rule: &mut Rule,
    (t, x): (f64, &[f64]),
    modes: &[Mode],
) -> Result<(), Fault> {
    loop {
        match system.extend(t, x, modes, rule.order) {
            Err(fault) if fault.is_overflow() && rule.lower() => {}
            outcome => return outcome,
        }
    }
}

/// Watches for switches that accumulate.
#[derive(Clone, Debug, Default)]
pub(super) struct Crowd {
    pub(super) last: Instant,
    pub(super) close: u32,
}

impl<'s, S: System + ?Sized> Flow<'s, S> {
    /// The system, for another motion.
    pub fn release(self) -> &'s mut S {
        self.system
    }
}

impl<S: System + ?Sized> Flow<'_, S> {
    /// Whether `t` has been reached.
    pub fn reached(&self, t: f64) -> bool {
        self.now.until(t) <= 0.0
    }
    /// Current instant.
    pub fn time(&self) -> f64 {
        self.now.high
    }
    /// Current state.
    pub fn state(&self) -> &[f64] {
        &self.shown
    }
    /// State just before the last event; differs from [`Flow::state`] in the rates after an impact.
    pub fn state_before(&self) -> Vec<f64> {
        self.with_turns(&self.before)
    }
    /// Modes just before the last event.
    pub fn modes_before(&self) -> &[Mode] {
        &self.modes_before
    }
    /// The modes in which its contacts struck: a surface that rises behind a switch strikes with the rates of the other side.
    pub fn modes_struck(&self) -> Vec<Mode> {
        let turned = |i: usize| self.risen && self.system.guards()[i].kind == GuardKind::Switch;
        (0..self.modes.len()).map(|i| if turned(i) { self.modes[i] } else { self.modes_before[i] }).collect()
    }
    /// What the impact of the last event did, if there was one.
    pub fn blow(&self) -> Option<&Arc<Blow>> {
        self.blow.as_ref()
    }
    /// Largest relative violation of the conditions of connections that was removed by projection. A condition is compared with the largest terms that
    /// meet in it along the motion: a start all but at the origin has no size of its own.
    pub fn drift(&self) -> f64 {
        if self.drifts.is_empty() {
            return self.drift;
        }
        self.drifts.iter().filter(|d| d[0] > 0.0).map(|[off, size]| off / size).fold(0.0, f64::max)
    }
    /// Current modes.
    pub fn modes(&self) -> &[Mode] {
        &self.modes
    }
    /// The last accepted step.
    pub fn step(&self) -> &Step {
        &self.step
    }
    /// Changes of mode at the end of the last step (or at the start, before the first step).
    pub fn switches(&self) -> &[Switch] {
        &self.switches
    }

    /// What frictions would do in another motion that obeys the laws, where modes were decided at the end of the last step; empty where none was found.
    pub fn rivals(&self) -> &[Rival] {
        &self.rivals
    }

    pub(crate) fn low(&self) -> &[f64] {
        &self.low
    }

    pub(crate) fn put_low(&mut self, low: &[f64]) {
        self.low.copy_from_slice(low);
    }

    /// Counts on from the work of another motion.
    pub(crate) fn count_from(&mut self, work: Work) {
        self.work = work;
    }
    /// Work done.
    pub fn work(&self) -> &Work {
        &self.work
    }
    /// Order of the next expansion.
    pub fn order(&self) -> usize {
        self.rule.order
    }
    /// The system, for outputs. Its last expansion belongs to the flow.
    pub fn system(&mut self) -> &mut S {
        self.system
    }

    /// The last accepted step and the system, to evaluate outputs along the step.
    pub fn step_and_system(&mut self) -> (&Step, &mut S) {
        (&self.step, self.system)
    }
}
