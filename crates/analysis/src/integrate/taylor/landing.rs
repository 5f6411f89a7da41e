//! How the implicit method takes a step of a flow.

use super::flow::{Ending, Flow};
use crate::integrate::stiff::{Base, Collocation, Verdict};
use crate::{Fault, System};
use algebra::sum::Instant;

/// Part of the way to an instant up to which a step is cut in two equal ones.
const HALVES: f64 = 2.0;

/// Relative violation of conditions up to which a step may leave them, or a hundred tolerances.
const DRIFT: f64 = 1e-10;

/// Where an implicit step has ended.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Landing {
    Done,
    /// The equations have no value there.
    OutOfReach,
    /// The step has left the conditions of connections by too much: they are held by rounding only, which grows with its length.
    Drifts,
    /// A change point lies in it or beside its end: only a series leads over one (`passage.rs`).
    AtChangePoint,
}

impl<S: System + ?Sized> Flow<'_, S> {
    /// An implicit step towards `target`, of this length at most; false when none is worth its cost, and the Taylor step is to be taken.
    pub(super) fn advance_implicitly(&mut self, length: f64, target: f64) -> Result<bool, Fault> {
        let mut engine = self.implicit.take_engine()?;
        let done = self.step_and_land(&mut engine, length, target)?;
        let counts = engine.counts();
        (self.work.jacobians, self.work.factorisations) = (counts.jacobians, counts.factorisations);
        (self.work.newton, self.work.rates) = (counts.newton, counts.rates);
        self.work.stages = engine.degree();
        self.implicit.engine = Some(engine);
        if !done {
            self.implicit.refused();
            // the series is still the one of this point, but the system has been elsewhere
            self.expand_here()?;
            self.take_expansion();
            self.note_turns();
        }
        Ok(done)
    }

    /// Steps that hold, shorter and shorter until one keeps to the conditions of connections too.
    fn step_and_land(&mut self, engine: &mut Collocation, mut length: f64, target: f64) -> Result<bool, Fault> {
        while let Some((h, growth)) = self.try_lengths(engine, length, target) {
            match self.land(engine, (h, growth), target)? {
                Landing::Done => return Ok(true),
                Landing::Drifts if 0.5 * h >= self.implicit.least(self.guess) => length = 0.5 * h,
                Landing::Drifts | Landing::OutOfReach | Landing::AtChangePoint => return Ok(false),
            }
        }
        Ok(false)
    }

    /// The length of a step that holds, with the factor for the next.
    fn try_lengths(&mut self, engine: &mut Collocation, length: f64, target: f64) -> Option<(f64, f64)> {
        let limit = self.now.until(target);
        let least = self.implicit.least(self.guess).min(0.5 * limit);
        let mut h = if length < limit && HALVES * length > limit { 0.5 * limit } else { length };
        let mut first = true;
        while first || (h >= least && !self.vanishes(h)) {
            first = false;
            let base = Base { start: self.now, x: &self.x, low: &self.low, modes: &self.modes };
            match engine.attempt(self.system, &base, h) {
                Verdict::Holds(growth) => return Some((h, growth)),
                Verdict::Shorter(factor) => {
                    self.work.rejected += 1;
                    h *= factor;
                }
                Verdict::Impossible => {
                    self.implicit.impossible = true;
                    return None;
                }
            }
        }
        None
    }

    /// Takes the step that holds up to its end or to the first event in it.
    fn land(&mut self, engine: &mut Collocation, (h, growth): (f64, f64), target: f64) -> Result<Landing, Fault> {
        engine.give(&mut self.step, &self.x);
        if !self.stays_clear(h) {
            self.work.rejected += 1;
            return Ok(Landing::AtChangePoint);
        }
        let (length, ending) = self.shorten_to_event(h);
        let (full, whole) = (length >= self.now.until(target), length == h);
        self.evaluate(length);
        if ending == Ending::Plain && whole {
            // the stage itself has digits that the powers lose
            for (i, change) in engine.change().iter().enumerate() {
                (self.next_x[i], self.next_low[i]) = algebra::sum::two_sum(self.x[i], change + self.low[i]);
            }
        }
        let lands = if full && ending == Ending::Plain { Instant::at(target) } else { self.now.after(length) };
        if self.correct(lands, length).and_then(|()| self.probe(lands)).is_err() {
            self.work.rejected += 1;
            return Ok(Landing::OutOfReach);
        }
        if self.removed > DRIFT.max(100.0 * self.rule.tolerance) {
            self.work.rejected += 1;
            return Ok(Landing::Drifts);
        }
        if self.complete(lands, ending).is_err() {
            self.work.rejected += 1;
            return Ok(Landing::OutOfReach);
        }
        (self.step.length, self.step.ends) = (length, lands);
        self.work.implicit_steps += 1;
        // the next step continues this one where this one ends
        if whole {
            engine.keep()
        } else {
            engine.forget()
        }
        self.implicit.next = Some(h * growth);
        self.implicit.taken = 0;
        let arrived = self.arrive(lands, ending);
        if self.implicit.next.is_none() {
            engine.forget();
        }
        self.show_turns();
        arrived.map(|()| Landing::Done)
    }

    /// A Taylor step of the length found is accepted.
    pub(super) fn note_taylor_step(&mut self, lands: Instant) {
        self.work.orders += self.step.order as u64;
        self.work.highest_order = self.work.highest_order.max(self.step.order);
        self.implicit.sample(lands, &self.next_x);
        if let Some(engine) = &mut self.implicit.engine {
            engine.forget();
        }
    }
}
