//! Impacts at contacts, and when contacts that rebound ever less come to rest.
//!
//! Which contacts strike and what the rates are afterwards is the system's law ([`crate::System::impact`]).
//!
//! **Infinitely many impacts.** A contact that is hit again and again, by itself (a ball) or in turn with others (a block that rocks on two corners), meets
//! rates in a ratio r < 1, and so do the intervals: after an interval T the hits still to come end after
//!
//! ```text
//! remaining = T (r + r^2 + ...) = T r / (1 - r);      T r = -g1/g2 where the first flight begins, with the gap g1 tau + g2 tau^2 + ..., g2 < 0
//! ```
//!
//! When this, and every flight that begins now, is below [`REST`] of the time (or of the step that the motion would allow), the contacts close at once. A contact
//! closes by itself where its rates are rounding of those of the bodies that meet and shrink no more.

use crate::integrate::taylor::Flow;
use crate::system::Bends;
use crate::{Blow, Fault, GuardKind, Mode, System};
use std::sync::Arc;

use crate::integrate::crossings::{Hit, Impact, opposite};

/// Share of the time below which the impacts still to come are one instant.
const REST: f64 = 4e-15;
/// Share of the rate before below which a rate after is rounding.
const SILENT: f64 = 1e-12;
/// Rounding of sliding speeds after an impact, in units of the last place of the rates.
const STOPPED: f64 = 64.0 * f64::EPSILON;

/// Rounding of an instant, in units of the last place of the time: some of those of a step and of the search for a zero in it.
const AT_ONCE: f64 = 64.0 * f64::EPSILON;

/// Height of a flight that is rounding of the positions: some units of their last place, for the rate of the impact before it is that with which it began at most.
const FLOWN: f64 = 64.0 * f64::EPSILON;

/// Rounding of a gap, in units of the last place of the positions.
const MET: f64 = 8.0 * f64::EPSILON;

impl<S: System + ?Sized> Flow<'_, S> {
    /// Impacts of this instant; sets the first trial of the modes of all contacts on their surfaces, and of all frictions when rates have changed. The
    /// last expansion belongs to the present state.
    pub(super) fn collide(&mut self) -> Result<Vec<Impact>, Fault> {
        self.rebounds.fill(false);
        self.blow = None;
        self.jolted = false;
        let gone = self.let_go()?;
        let on: Vec<usize> = (0..self.modes.len())
            .filter(|&i| self.is_contact(i) && !gone.contains(&i) && (self.touched[i] || self.modes[i] == Mode::Zero || self.is_met(i)))
            .collect();
        // behind a switch at which a surface rises its rates are those of the other side
        let sides = if self.risen { self.flipped() } else { None };
        if let Some(after) = &sides {
            self.system.expand(self.now.high, &self.x, after, 1)?;
        }
        // what is closed has no rate, whatever the sign of its rounding
        let before: Vec<f64> = on.iter().map(|&i| if self.modes[i] == Mode::Zero { 0.0 } else { self.gap_rate(i) }).collect();
        if let Some(impacts) = self.jolt(&on, &before)? {
            return Ok(impacts);
        }
        let closing = |(i, rate): (&usize, &f64)| self.modes[*i] != Mode::Zero && *rate < 0.0;
        if !on.iter().zip(&before).any(closing) {
            self.close_touched(&on);
            return Ok(Vec::new());
        }
        let sides = sides.as_deref().unwrap_or(&self.modes);
        let blow = self.system.impact(self.now.high, &mut self.x, sides, &on).map_err(|f| f.during(self.now.high))?;
        self.system.expand(self.now.high, &self.x, sides, 1)?;
        let impacts = self.struck((&on, &before), &blow);
        self.blow = Some(Arc::new(blow));
        Ok(impacts)
    }

    /// The modes behind the switches that were reached; none where none was.
    fn flipped(&self) -> Option<Vec<Mode>> {
        let flips = |i: &usize| self.touched[*i] && self.system.guards()[*i].kind == GuardKind::Switch && self.modes[*i] != Mode::Zero;
        let mut after = self.modes.clone();
        (0..self.modes.len()).filter(flips).for_each(|i| after[i] = opposite(after[i]));
        (after != self.modes).then_some(after)
    }

    /// Opens contacts whose surface falls away, and gives them; one whose surface rises is open and met.
    ///
    /// *Errors*: S137, S138, S139 what jumps otherwise.
    fn let_go(&mut self) -> Result<Vec<usize>, Fault> {
        self.risen = false;
        let Some(after) = self.flipped() else { return Ok(Vec::new()) };
        let Bends { opens, strikes } = self.system.bend(self.now.high, &self.x, [&self.modes, &after])?;
        for &i in opens.iter().chain(&strikes) {
            self.modes[i] = Mode::Positive;
            self.touched[i] = strikes.contains(&i);
        }
        self.risen = !strikes.is_empty();
        Ok(opens)
    }

    /// Impacts by a jump of prescribed velocities; none when no switch that was reached makes one.
    fn jolt(&mut self, on: &[usize], before: &[f64]) -> Result<Option<Vec<Impact>>, Fault> {
        let Some(after) = self.flipped() else { return Ok(None) };
        let Some(blow) = self.system.jolt(self.now.high, &mut self.x, [&self.modes, &after], on).map_err(|f| f.during(self.now.high))?
        else {
            return Ok(None);
        };
        self.jolted = true;
        self.system.expand(self.now.high, &self.x, &after, 1)?;
        let impacts = self.struck((on, before), &blow);
        self.blow = Some(Arc::new(blow));
        Ok(Some(impacts))
    }

    /// Modes and impacts after a blow, by the last expansion.
    fn struck(&mut self, (on, before): (&[usize], &[f64]), blow: &Blow) -> Vec<Impact> {
        let told = |i: usize| blow.rates.iter().find(|(guard, _)| *guard == i).map(|(_, rates)| *rates);
        let rates: Vec<f64> = on.iter().map(|&i| told(i).map_or_else(|| self.gap_rate(i), |[_, after]| after)).collect();
        let n = self.system.n_coordinates();
        // where a surface jumps, contacts elsewhere have no rate to compare with
        let fastest = if self.jolted { self.x[n..2 * n].iter().fold(0.0_f64, |m, v| m.max(v.abs())) } else { 0.0 };
        let scale = before.iter().chain(&rates).fold(fastest, |m, r| m.max(r.abs()));
        let mut impacts = Vec::new();
        for ((&i, &rate), &after) in on.iter().zip(before).zip(&rates) {
            // a chain of blows is followed down to this
            self.ties[i].rate = SILENT * scale;
            let was_open = self.modes[i] != Mode::Zero;
            self.rebounds[i] = after > SILENT * scale && !self.stalls(i, [rate, after]);
            self.modes[i] = if self.rebounds[i] { Mode::Positive } else { Mode::Zero };
            self.touched[i] = true;
            let impulse = blow.impulses.iter().find(|(guard, _)| *guard == i).map(|(_, p)| *p);
            let struck = was_open || self.rebounds[i] || self.jolted;
            if was_open && rate < 0.0 || impulse.is_some() && struck {
                let after = if self.rebounds[i] { after } else { 0.0 };
                // a jump of the surface itself is not in the expansion before it
                let rate = told(i).filter(|_| self.jolted).map_or(rate, |[before, _]| before);
                let silent = blow.silent.contains(&i);
                impacts.push(Impact { guard: i, rates: [rate, after], impulse: impulse.unwrap_or(0.0), silent });
            }
        }
        self.slide_on(&blow.stuck);
        impacts
    }

    /// Whether a rebound is rounding of the rates of the bodies that meet, and no smaller than the last one: the next would be the same.
    fn stalls(&self, i: usize, [before, after]: [f64; 2]) -> bool {
        after <= self.rounding_of_rates() && self.hits[i].is_some_and(|hit| before <= hit.rate)
    }

    /// Below this a difference of rates is their rounding.
    fn rounding_of_rates(&self) -> f64 {
        let n = self.system.n_coordinates();
        STOPPED * self.x[n..2 * n].iter().fold(0.0_f64, |m, v| m.max(v.abs()))
    }

    /// Modes of the frictions by the rates after an impact.
    fn slide_on(&mut self, stuck: &[usize]) {
        let rounding = self.rounding_of_rates();
        for i in 0..self.modes.len() {
            if !matches!(self.system.guards()[i].kind, GuardKind::Friction { .. }) {
                continue;
            }
            let Some(&speed) = self.system.guard(i).first() else { continue };
            let stands = stuck.contains(&i) || speed.abs() <= rounding;
            self.touched[i] = stands;
            self.modes[i] = if stands { Mode::Zero } else { Mode::of(speed) };
        }
    }

    /// Whether the value of a guard is rounding.
    pub(super) fn is_on_surface(&self, i: usize) -> bool {
        self.system.guard(i).first().is_some_and(|value| value.abs() <= self.guard_noise[i])
    }

    /// Whether a gap is zero, or negative by no more than the rounding of the positions that meet in it, which a gap that has been small for a whole step no
    /// longer shows. And whether it is positive by no more and will be zero within the rounding of the time: of what strikes at one instant by symmetry nothing is first.
    fn is_met(&self, i: usize) -> bool {
        let places = self.x[..self.system.n_coordinates()].iter().fold(0.0_f64, |m, x| m.max(x.abs()));
        let within = self.now.high.abs().max(self.natural) * AT_ONCE;
        let near = |value: f64| value.abs() <= MET * places && (value < 0.0 || value <= -self.gap_rate(i) * within);
        self.is_on_surface(i) || self.system.guard(i).first().is_some_and(|value| near(*value))
    }

    pub(super) fn is_contact(&self, i: usize) -> bool {
        matches!(self.system.guards()[i].kind, GuardKind::Contact { .. })
    }

    fn gap_rate(&self, i: usize) -> f64 {
        self.system.guard(i).get(1).copied().unwrap_or(0.0)
    }

    /// A touched contact without a closing rate: closed, unless the flow opens it.
    fn close_touched(&mut self, on: &[usize]) {
        for &i in on {
            let opens = self.gap_rate(i) > SILENT * self.guard_scale[i];
            if self.modes[i] != Mode::Zero && !opens {
                self.modes[i] = Mode::Zero;
            }
        }
    }

    /// Closes the contacts whose impacts will be over within rounding of the time: guard and instant of their end.
    pub(super) fn come_to_rest(&mut self, impacts: &[Impact]) -> Result<Vec<(usize, f64)>, Fault> {
        let resolution = REST * self.now.high.abs().max(self.natural);
        let flights: Vec<(usize, f64)> = (0..self.modes.len()).filter_map(|i| self.flight(i)).collect();
        let longest = flights.iter().fold(0.0_f64, |m, flight| m.max(flight.1));
        let mut remaining = f64::INFINITY;
        for impact in impacts {
            let own = flights.iter().find(|flight| flight.0 == impact.guard).map(|flight| flight.1);
            remaining = remaining.min(self.remaining(impact, own.unwrap_or(longest)));
            self.hits[impact.guard] = Some(Hit { at: self.now, rate: impact.rates[0] });
        }
        if flights.is_empty() || longest > resolution || remaining > resolution {
            return Ok(Vec::new());
        }
        let limit = self.now.after(remaining).high;
        for (i, _) in &flights {
            self.modes[*i] = Mode::Zero;
            self.rebounds[*i] = false;
        }
        self.search()?;
        Ok(flights.into_iter().map(|(i, _)| (i, limit)).collect())
    }

    /// Whether a contact closes without an impact because the flight from its last one is rounding of the time or of the positions: what happens in that flight (a friction that reverses and
    /// sticks) ends impacts that would follow one another without end.
    pub(super) fn dies_away(&self, i: usize) -> bool {
        if !self.is_contact(i) || self.modes_before[i] != Mode::Positive || self.modes[i] != Mode::Zero {
            return false;
        }
        let Some(hit) = self.hits[i] else { return false };
        let flown = hit.at.until(self.now.high) + self.now.low;
        let places = self.x[..self.system.n_coordinates()].iter().fold(0.0_f64, |m, x| m.max(x.abs()));
        flown <= AT_ONCE * self.now.high.abs().max(self.natural) || hit.rate.abs() * flown <= FLOWN * places
    }

    /// Time until the impacts that follow this one are over, infinite where they do not shrink; `flight` is the time to the next.
    fn remaining(&self, impact: &Impact, flight: f64) -> f64 {
        let [before, after] = impact.rates;
        let (interval, ratio) = match self.hits[impact.guard] {
            Some(hit) => (hit.at.until(self.now.high) + self.now.low, before / hit.rate),
            None => (0.0, after / -before),
        };
        if !(0.0..1.0).contains(&ratio) {
            return f64::INFINITY;
        }
        if interval > 0.0 { interval * ratio / (1.0 - ratio) } else { flight / (1.0 - ratio) }
    }

    /// Time until a contact that opens now closes again, when its own motion brings it back.
    fn flight(&self, i: usize) -> Option<(usize, f64)> {
        if !self.is_contact(i) || self.modes[i] != Mode::Positive || !self.touched[i] {
            return None;
        }
        let [_, g1, g2, ..] = self.system.guard(i) else { return None };
        (*g1 > 0.0 && *g2 < 0.0).then(|| (i, -g1 / g2))
    }
}
