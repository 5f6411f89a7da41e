//! Adaptive Taylor integrator with dense output and exact events.
//!
//! One expansion per step gives the polynomials of the states, hence the step length (`length.rs`), the dense output ([`Step`]) and
//! polynomial event functions ([`crate::integrate::crossings::roots`]). The order starts from the tolerance and adapts to the motion. A step goes so:
//!
//! 1. length from the last two coefficients, and the order of the next expansion; never across a scheduled instant, which is hit exactly, and never
//!    across what an operation does beyond its polynomial ([`System::faithful`]);
//! 2. first sign change of a guard on the step shortens it;
//! 3. new state; the rates there, compared with the derivative of the old polynomials, measure the defect of the step: a step that relied on accidental
//!    zeros among the last coefficients is taken back and made shorter on the same series. The expansion that began with these rates is continued where the step
//!    is accepted, and is the next step's;
//! 4. at an event the modes are decided anew (`crate::integrate::events`).

mod accept;
mod flow;
mod implicit;
mod landing;
mod length;
mod options;
mod over;
mod passage;
mod switching;
mod turns;

use words::Text;

use super::Step;
use crate::integrate::crossings::roots::RootFinder;
use crate::{Fault, Mode, System, Tie};
use accept::Defect;
use algebra::sum::{Instant, two_sum};
use flow::{Crowd, Ending, extend_within_range};
use implicit::Implicit;
use length::Rule;
use over::Passage;
use passage::AWAY;

pub(crate) use accept::{DEFECT, ROUNDING as OF_RATES};
pub use flow::Flow;
pub(crate) use implicit::{Samples, is_smooth, note};
pub use length::{HIGHEST_ORDER, order_for};
pub(crate) use length::{ROUNDING, SEARCHES, groups, limits};
pub use options::{Check, Options, Work, check_tolerance};
pub(crate) use turns::MOST_TURNS;

fn check_start<S: System + ?Sized>(system: &S, t: f64, x: &[f64]) -> Result<(), Fault> {
    match system.states().iter().zip(x).find(|(_, value)| !value.is_finite()) {
        Some((state, _)) => Err(Fault::not_finite(&Text::same(&state.name), t)),
        None => Ok(()),
    }
}

impl<'s, S: System + ?Sized> Flow<'s, S> {
    /// Prepares the motion from a state; modes are decided from the flow itself.
    ///
    /// *Errors*: tolerance out of range, a start that is not finite or singular, a start on a switch from which no mode leads away.
    pub fn start(system: &'s mut S, t: f64, x: &[f64], options: &Options) -> Result<Flow<'s, S>, Fault> {
        check_tolerance(options.tolerance)?;
        check_start(system, t, x)?;
        let (n_x, n_g) = (x.len(), system.guards().len());
        let units: Vec<&str> = system.states().iter().map(|q| q.unit.as_str()).collect();
        let mut rule = Rule::new(options.tolerance, options.order, &units);
        let implicit = Implicit::new(options, &units, n_g);
        rule.note_reach(x);
        let mut flow = Flow {
            system,
            rule,
            now: Instant::at(t),
            x: x.to_vec(),
            low: vec![0.0; n_x],
            before: x.to_vec(),
            modes_before: vec![Mode::Zero; n_g],
            base: x.to_vec(),
            drift: 0.0,
            removed: 0.0,
            drifts: Vec::new(),
            modes: vec![Mode::Zero; n_g],
            leaving: vec![false; n_g],
            rebounds: vec![false; n_g],
            jolted: false,
            risen: false,
            hits: vec![None; n_g],
            blow: None,
            fired: vec![true; n_g],
            ties: vec![Tie::default(); n_g],
            weighed: false,
            deflation: vec![0; n_g],
            touched: vec![false; n_g],
            grounded: vec![false; n_g],
            met: vec![false; n_g],
            guard_scale: vec![0.0; n_g],
            guard_noise: vec![0.0; n_g],
            loads: 0.0,
            expanded: false,
            check: options.check,
            freely: Vec::new(),
            turns: Vec::new(),
            shown: Vec::new(),
            step: Step { low: vec![0.0; n_x], modes: vec![Mode::Zero; n_g], ..Step::default() },
            next_x: vec![0.0; n_x],
            next_low: vec![0.0; n_x],
            next_slope: vec![0.0; n_x],
            trial: Step::default(),
            guess: f64::INFINITY,
            span: if options.span > 0.0 { options.span } else { 1.0 },
            natural: 0.0,
            switches: Vec::new(),
            rivals: Vec::new(),
            crowd: Crowd::default(),
            implicit,
            passage: Passage::default(),
            rough: None,
            roots: RootFinder::default(),
            work: Work::default(),
        };
        flow.begin()?;
        Ok(flow)
    }

    fn begin(&mut self) -> Result<(), Fault> {
        self.watch_turns();
        self.take_turns_off();
        self.decide_at_start()?;
        self.show_turns();
        (self.expanded, self.crowd.last) = (true, self.now);
        Ok(())
    }

    /// One step towards `end`, at most to it. Afterwards [`Flow::step`] is the dense output and [`Flow::switches`] what happened at its end.
    ///
    /// *Errors*: what stops the motion, with the state where it does.
    pub fn advance(&mut self, end: f64) -> Result<(), Fault> {
        self.advance_plainly(end).map_err(|fault| self.explained(fault))
    }

    fn advance_plainly(&mut self, end: f64) -> Result<(), Fault> {
        self.switches.clear();
        self.rivals.clear();
        self.take_turns_off();
        if !self.expanded {
            self.expand_here()?;
        }
        self.take_expansion();
        self.note_turns();
        let (target, limit) = self.target(end);
        let mut h = self.rule.length(&self.step.states, self.guess, limit);
        self.guess = h;
        if let Some(length) = self.implicit.proposal(h, limit, &self.deflation)
            && self.advance_implicitly(length, target)?
        {
            return Ok(());
        }
        h = self.believed(h, limit)?;
        let mut defect = Defect::after(self.rough);
        if self.system.holds_powers() {
            self.rule.rescale(&self.step.states, h);
            defect = Defect::of_held_powers();
        }
        // a switch may lie so near to the target that only rounding is left between them
        let rounding = limit > 0.0 && limit <= 4.0 * f64::EPSILON * target.abs();
        loop {
            if !(rounding && h >= limit) {
                self.check_length(h)?;
            }
            let (length, ending) = self.shorten_to_event(h);
            let full = length >= limit;
            let event = ending == Ending::Event;
            self.refuse_switch_in_passage(event.then_some(length))?;
            self.evaluate(length);
            if !full && !event && self.ends_near(length) {
                h *= AWAY;
                continue;
            }
            let finite = self.next_x.iter().all(|x| x.is_finite());
            let lands = self.now.after(length);
            // what rounding leaves up to the target is no step
            let there = lands.until(target).abs() <= 4.0 * f64::EPSILON * target.abs();
            let full = full || there;
            // an event within rounding of the end is at the end: a step of one unit of the last place behind it would hold nothing but rounding
            let lands = if full && !event || there && target == end { Instant::at(target) } else { lands };
            let probe = if !finite { Err(self.not_finite()) } else { self.correct(lands, length).and_then(|()| self.probe(lands)) };
            let passes = probe.is_ok() && (event || self.passes(length) != Some(false));
            if !passes && let Some(shorter) = self.give_up_passage() {
                h = shorter?;
                continue;
            }
            if let Err(fault) = probe {
                h = self.take_back(h, 0.25, Some(fault))?;
            } else if self.passes(length).is_none() && !defect.accept(self.defect(length), length, self.rule.tolerance) {
                h = self.take_back(h, 0.5, None)?;
            } else if let Err(fault) = self.complete(lands, ending) {
                h = self.take_back(h, 0.25, Some(fault))?;
            } else if ending == Ending::Plain && self.passed_a_switch(length) {
                h = self.take_back(length, 0.5, None)?;
            } else {
                self.rough = defect.stayed;
                return self.accept(length, lands, ending);
            }
        }
    }

    /// The part of a length over which all polynomials stand for what they are of.
    fn believed(&mut self, h: f64, limit: f64) -> Result<f64, Fault> {
        if h < limit {
            self.rule.adapt(&self.step.states);
        }
        let trusted = self.trusted(&self.step, h);
        let faithful = self.faithful(trusted);
        self.clear(faithful, limit)
    }

    /// A Taylor step of the length found is taken.
    fn accept(&mut self, length: f64, lands: Instant, ending: Ending) -> Result<(), Fault> {
        if ending == Ending::Plain && self.passes(length).is_some() && self.mark_wrong_sides() {
            self.refuse_switch_in_passage(Some(length))?;
        }
        (self.step.length, self.step.ends) = (length, lands);
        self.note_passage(length);
        self.note_taylor_step(lands);
        let arrived = self.arrive(lands, ending);
        self.show_turns();
        arrived
    }

    /// The part of a step on which every operation does what its polynomial says. What it cuts says nothing about the length of the next step.
    fn faithful(&mut self, h: f64) -> f64 {
        if self.check == Check::Ends {
            return h;
        }
        let shorter = self.system.faithful(h, self.rule.tolerance);
        self.work.shortened += u64::from(shorter < h);
        shorter
    }

    pub(crate) fn expand_here(&mut self) -> Result<(), Fault> {
        self.work.expansions += 1;
        extend_within_range(self.system, &mut self.rule, (self.now.high, &self.x), &self.modes)
    }

    fn take_expansion(&mut self) {
        self.step.start = self.now;
        (self.step.length, self.step.ends) = (0.0, self.now);
        self.step.modes.copy_from_slice(&self.modes);
        self.step.low.copy_from_slice(&self.low);
        self.step.take(&*self.system, self.x.len(), self.modes.len(), self.rule.order);
    }

    /// Next instant that must be hit, and the way to it.
    fn target(&self, end: f64) -> (f64, f64) {
        let mut target = end;
        for guard in self.system.guards() {
            if let Some(t) = guard.scheduled
                && self.now.until(t) > 0.0
                && t < target
            {
                target = t;
            }
        }
        (target, self.now.until(target).max(0.0))
    }

    /// Next state, and the slopes of the polynomials there.
    fn evaluate(&mut self, h: f64) {
        self.step.increments_and_slopes(h, &mut self.next_x, &mut self.next_slope);
        for i in 0..self.x.len() {
            (self.next_x[i], self.next_low[i]) = two_sum(self.x[i], self.next_x[i] + self.low[i]);
        }
    }

    /// Moves the next state onto the conditions of the present modes.
    fn correct(&mut self, at: Instant, length: f64) -> Result<(), Fault> {
        self.base.copy_from_slice(&self.next_x);
        self.removed = 0.0;
        if self.ends_blind(length) {
            return Ok(());
        }
        let drift = self.system.project(at.high, &mut self.next_x, &self.modes)?;
        if self.is_near_change_point() {
            self.system.polish(at.high, &mut self.next_x, &self.modes)?;
        }
        self.removed = drift;
        if drift > 0.0 || self.is_near_change_point() {
            for i in 0..self.base.len() {
                if self.next_x[i] != self.base[i] {
                    self.next_low[i] = 0.0;
                }
            }
        }
        Ok(())
    }

    /// Moves the state onto the conditions of the present trial of modes. What it removes is no drift: a contact has just closed.
    pub(crate) fn project_here(&mut self) -> Result<(), Fault> {
        self.system.project(self.now.high, &mut self.x, &self.modes)?;
        for i in 0..self.x.len() {
            if self.x[i] != self.before[i] {
                self.low[i] = 0.0;
            }
        }
        Ok(())
    }

    /// Moves to the end of the step and decides the modes there.
    fn arrive(&mut self, at: Instant, ending: Ending) -> Result<(), Fault> {
        self.now = at;
        std::mem::swap(&mut self.x, &mut self.next_x);
        std::mem::swap(&mut self.low, &mut self.next_low);
        let event = ending == Ending::Event;
        if event {
            self.rule.fade_reach();
        }
        self.rule.note_reach(&self.x);
        self.deflation.fill(0);
        self.work.projections += u64::from(self.removed > 0.0);
        self.drift = self.drift.max(self.removed);
        let found = self.system.drifts();
        self.drifts.resize(found.len(), [0.0; 2]);
        for (most, now) in self.drifts.iter_mut().zip(found) {
            *most = [most[0].max(now[0]), most[1].max(now[1])];
        }
        self.work.steps += 1;
        self.expanded = !event;
        let scheduled = self.mark_scheduled();
        let wrong = !event && self.mark_wrong_sides();
        if !(event || scheduled || wrong) {
            return Ok(());
        }
        self.remember_guard_scales();
        self.expanded = false;
        self.implicit.interrupt();
        self.decide()?;
        self.expanded = true;
        self.watch_crowd()
    }

    /// Length of an undisturbed step from the last expansion and the scales of the guards in it.
    pub(crate) fn measure(&mut self) -> Result<(), Fault> {
        self.trial.take(&*self.system, self.x.len(), self.modes.len(), self.rule.order);
        let limit = if self.natural > 0.0 { self.natural.max(self.span) } else { self.span };
        self.natural = self.rule.length(&self.trial.states, self.guess, limit);
        self.natural = self.trusted(&self.trial, self.natural);
        if self.natural.is_nan() || self.natural <= 0.0 {
            let i = (0..self.x.len()).find(|&i| !self.trial.coefficients(i).iter().all(|c| c.is_finite())).unwrap_or(0);
            return Err(Fault::not_finite(&Text::same(&self.system.states()[i].name), self.now.high));
        }
        self.loads = self.largest_load(|i| self.trial.guards.row(i), self.natural);
        for (i, scale) in self.guard_scale.iter_mut().enumerate() {
            *scale = scale.max(crate::integrate::crossings::size(self.trial.guards.row(i), self.natural));
        }
        Ok(())
    }
}
