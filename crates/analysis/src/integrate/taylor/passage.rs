//! Past change points: positions in which the conditions depend on one another for an instant, as those of parallel cranks do where cranks and coupler
//! lie in line.
//!
//! Several ways of assembly meet there, with different tangents. Rates that do not vanish choose one, and along it the motion is analytic; but at the point
//! itself the system for accelerations and reactions is singular, and beside it digits are lost in proportion to the distance. Let μ be the margin of the
//! conditions ([`System::margin`]), which passes zero like the distance.
//!
//! 1. No step ends where μ is small: before the point steps are shortened.
//! 2. From there one step leads to the other side. Its polynomials are cut at their least terms (rounding makes the terms k grow like 1/distance^k), the end is
//!    closed on its own side, and the equations must hold there. Otherwise the point is approached more closely and the passage tried again.
//! 3. What does not pass is refused with the position: rates that vanish there, loads that switch there, motions that really end.
//!
//! A singularity that is none, only near to one, has no zero of μ and is resolved by short steps as any other motion.

use super::flow::Flow;
use super::over::{Over, Passage};
use crate::fault::codes;
use crate::integrate::step;
use crate::{Fault, System};
use algebra::elementary;

/// Share of the best margin that a step should leave at its end.
const CLEAR: f64 = 0.05;
/// The same, of its start: a motion that stays near a change point has no better.
const OWN: f64 = 0.5;
/// The same behind a change point.
const LANDS: f64 = 0.2;
/// Share of the best margin that counts as zero. Lengths that agree to 14 digits leave about 1e-7.
const ZERO: f64 = 1e-6;
/// Share below which a state is not closed and no forces are taken from it.
const BLIND: f64 = 1e-3;
/// A series is looked at up to this multiple of the length that its terms allow: cut at its least term it still leads.
const AHEAD: f64 = 2.5;
const LOOKS: usize = 20;
/// Where in a step margins are asked for, and below which share of the best margin closely.
const COARSE_LOOKS: [f64; 3] = [0.25, 0.5, 0.75];
const CLOSE_LOOKS: [f64; 12] = [0.015, 0.03, 0.06, 0.125, 0.25, 0.375, 0.5, 0.625, 0.75, 0.875, 0.94, 0.97];
const FINE: f64 = 0.3;
/// Error of a passage relative to the change within it: from afar, near to the point, and very near. It is mostly across the way, where closing removes it.
const ERRORS: [f64; 3] = [1e-11, 2e-10, 1e-9];
/// Shares of the best margin between them.
const NEARNESS: [f64; 2] = [0.3, 0.012];
/// Share of a step that is not left for another one.
const REST: f64 = 1e-6;
/// What is left of a step that would end near a change point.
pub(super) const AWAY: f64 = 0.7;
/// Share of its rates below which a machine stands still: a rate that should vanish where energy is used up has the root of rounding.
const STILL: f64 = 1e-6;
/// Rounding of the first terms.
const NOISE: f64 = 4.0 * f64::EPSILON;
/// How far the rates behind it may be from the equations, in these errors.
const DEFECT: f64 = 1e3;
/// Change of the fastest rate within the distance of the singularity, as a share of it: 1/2 at the end of a reach, where q - q* goes like a square root; on
/// the way into a change point it vanishes with the distance.
const RUNAWAY: f64 = 0.2;
/// Ratio of margins at four places, thirds apart, below which there is no zero between: beside one, two of them are at least as 2 to 1.
const FLAT: f64 = 1.1;
/// Share of its own margin that an implicit step keeps where the margin is less than [`FINE`] of the best: in a narrow place, not on the way to a change point.
const NARROW: f64 = 0.95;
/// The least of three margins beside the larger of its neighbours: with a zero between, it is at most a third of it; the rest is for their bend.
const DIP: f64 = 0.6;
const GOLDEN: f64 = 0.381_966_011_250_105;
/// Halvings and golden sections.
const SECTIONS: usize = 48;

impl<S: System + ?Sized> Flow<'_, S> {
    /// The length of the step so that it does not end near a change point; prepares a passage where it leads over one.
    ///
    /// *Errors*: S058 a change point that cannot be passed.
    pub(super) fn clear(&mut self, h: f64, limit: f64) -> Result<f64, Fault> {
        self.passage.over = None;
        self.step.change = None;
        let Some(here) = self.margin(0.0) else { return Ok(h) };
        let best = self.passage.best.max(here);
        (self.passage.here, self.passage.best, self.passage.least) = (here, best, here);
        if here < BLIND * best {
            return Err(self.at_change_point(0.0));
        }
        let behind = self.behind(h);
        if behind < h && here < FINE * best {
            self.step.change = Some([-behind, 0.0]);
        }
        // a rest of rounding would be no step
        let h = if behind < (1.0 - REST) * limit { h.min(behind) } else { h };
        let floor = (CLEAR * best).min(OWN * here);
        let end = self.margin(h).unwrap_or(0.0);
        self.passage.least = here.min(end);
        let near = if end < floor { self.nearest(h) } else { self.dip(h, end).or_else(|| self.beyond(h, end)) };
        let Some(Near { to, margin }) = near else { return Ok(h) };
        if margin > ZERO * best {
            // not met by the series from here, or none: nearer to it the series tells
            return Ok(h.min(OWN * to));
        }
        if self.rests_at(to, h) {
            return Err(self.at_change_point(to));
        }
        if let Some(out) = self.over([h, 2.0 * to, 1.5 * to, 1.25 * to], to, limit) {
            return Ok(out);
        }
        // the motion or its phase ends before it
        if limit < to && limit <= h {
            return Ok(h);
        }
        let before = self.before(to)?;
        Ok(if to > AHEAD * h { before.min(h) } else { before })
    }

    /// Whether an implicit step of this length, whose polynomials the step has, keeps clear of change points all along. Collocation does not see one between its
    /// nodes, and the other way of assembly satisfies all equations as well: there the series takes over.
    pub(super) fn stays_clear(&mut self, h: f64) -> bool {
        (self.passage.over, self.step.change) = (None, None);
        let Some(here) = self.margin(0.0) else { return true };
        let margins: Vec<f64> = (0..=LOOKS).map(|k| self.margin(h * k as f64 / LOOKS as f64).unwrap_or(0.0)).collect();
        let best = margins.iter().fold(self.passage.best, |m, margin| m.max(*margin));
        // what a step has off the connections between its nodes the forces there have over the margin
        let floor = (FINE * best).min(NARROW * here);
        let mut least = here.min(margins[LOOKS]);
        for k in 0..=LOOKS {
            let (before, after) = (k.saturating_sub(1), (k + 1).min(LOOKS));
            let beside = margins[before].max(margins[after]);
            let inside = before < k && k < after && margins[k] <= margins[before].min(margins[after]) && margins[k] < DIP * beside;
            // at an end there may be one between it and its only neighbour
            let at_end = (k == before || k == after) && margins[k] < FINE * best;
            if inside || at_end {
                least = least.min(self.lowest(h * before as f64 / LOOKS as f64, h * after as f64 / LOOKS as f64).1);
            }
        }
        (self.passage.here, self.passage.best, self.passage.least) = (here, best, least);
        least >= floor
    }

    /// The first of these lengths with which a step leads over the change point at `to` with the least error that one of them can have.
    fn over(&mut self, lengths: [f64; 4], to: f64, limit: f64) -> Option<f64> {
        let Passage { here, best, .. } = self.passage;
        let floor = (CLEAR * best).min(LANDS * here);
        let mut lands =
            |out: &f64| *out >= 1.2 * to && *out <= limit.min(3.0 * to) && self.margin(*out).is_some_and(|margin| margin >= floor);
        let lengths: Vec<f64> = lengths.into_iter().filter(&mut lands).collect();
        let nearness = NEARNESS.iter().filter(|share| here < **share * best).count();
        let tries = ERRORS[..=nearness].iter().flat_map(|wanted| lengths.iter().map(|out| (*wanted, *out)));
        tries.collect::<Vec<_>>().into_iter().find(|(wanted, out)| self.prepare(to, *out, [*wanted, ERRORS[nearness]])).map(|(_, out)| out)
    }

    /// Distance of the last change point behind. At the start of a motion it is looked for.
    fn behind(&mut self, h: f64) -> f64 {
        if self.passage.behind.is_none() {
            let found = if h.is_finite() { self.zero_behind(h) } else { f64::INFINITY };
            self.passage.behind = Some(self.now.after(-found.min(f64::MAX)));
        }
        self.passage.behind.map_or(f64::INFINITY, |at| -self.now.until(at.high) - at.low)
    }

    /// How far the last zero of the margin is behind, infinite where there is none.
    fn zero_behind(&mut self, h: f64) -> f64 {
        let Some([from, to]) = self.valley(-h).filter(|valley| !self.is_flat(*valley)) else { return f64::INFINITY };
        let (to, margin) = self.lowest(from, to);
        if margin <= ZERO * self.passage.best { -to } else { f64::INFINITY }
    }

    /// Whether the margin all but stands between two lengths. One that passes zero there does not: it falls and rises like the distance, and of four
    /// places two lie on one side of the zero.
    fn is_flat(&mut self, [from, to]: [f64; 2]) -> bool {
        let third = (to - from) / 3.0;
        let margins = [from, from + third, to - third, to].map(|tau| self.margin(tau).unwrap_or(0.0));
        let (low, high) = margins.iter().fold((f64::INFINITY, 0.0_f64), |(l, h), m| (l.min(*m), h.max(*m)));
        high <= FLAT * low
    }

    /// Whether all rates vanish in the change point, beside those on the way: then nothing decides how the motion goes on.
    fn rests_at(&self, to: f64, h: f64) -> bool {
        let rate = |i: usize, tau: f64| step::slope(self.step.states.row(i), tau).abs();
        let n = self.system.n_coordinates();
        let fastest = |i: usize| rate(i, 0.0).max(rate(i, h.min(2.0 * to)));
        let most = (0..n).map(fastest).fold(0.0, f64::max);
        (0..n).filter(|i| fastest(*i) > STILL * STILL * most).all(|i| rate(i, to) <= STILL * fastest(i))
    }

    /// A step that ends before the change point.
    fn before(&mut self, to: f64) -> Result<f64, Fault> {
        let Passage { here, best, .. } = self.passage;
        if OWN * here <= BLIND * best {
            return Err(self.at_change_point(to));
        }
        self.step.change = Some([to, 0.0]);
        // the margin falls nearly like the distance
        let left = (CLEAR * best / here).min(OWN);
        Ok(to * (1.0 - left))
    }

    /// The least margin ahead, or behind for a negative length; none where it only falls or rises.
    fn nearest(&mut self, h: f64) -> Option<Near> {
        let [from, to] = self.valley(h)?;
        let (to, margin) = self.lowest(from, to);
        Some(Near { to, margin })
    }

    /// Two lengths between which the margin has a least value; the first such ones.
    fn valley(&mut self, h: f64) -> Option<[f64; 2]> {
        let step = AHEAD * h / LOOKS as f64;
        let margins: Vec<f64> = (0..=LOOKS).map(|k| self.margin(k as f64 * step).unwrap_or(0.0)).collect();
        let lowest = (1..LOOKS).find(|&k| margins[k] <= margins[k - 1] && margins[k] <= margins[k + 1] && margins[k] < margins[0])?;
        Some([(lowest as f64 - 1.0) * step, (lowest as f64 + 1.0) * step])
    }

    /// A zero of the margin beyond a step that the rounding of forces has made short, where the margin falls towards it: there the places still lead over it.
    fn beyond(&mut self, h: f64, end: f64) -> Option<Near> {
        let Passage { here, best, .. } = self.passage;
        let zero = h * here / (here - end);
        let falls = here < FINE * best && end < here && zero.is_finite();
        falls.then(|| self.nearest(zero)).flatten().filter(|near| near.margin <= ZERO * best)
    }

    /// The least margin inside a step that ends clear of it, where it falls to less than half of that at the ends.
    fn dip(&mut self, h: f64, end: f64) -> Option<Near> {
        let (here, near) = (self.passage.here, FINE * self.passage.best);
        let looks: &[f64] = match self.system.margins() {
            _ if here < near || end < near => &CLOSE_LOOKS,
            0 => return None,
            _ => &COARSE_LOOKS,
        };
        let margins: Vec<f64> = looks.iter().map(|share| self.margin(share * h).unwrap_or(0.0)).collect();
        let before = |k: usize| k.checked_sub(1).map_or(here, |k| margins[k]);
        let after = |k: usize| margins.get(k + 1).copied().unwrap_or(end);
        let is_dip = |k: &usize| margins[*k] < 0.5 * here.max(end) && margins[*k] <= before(*k).min(after(*k));
        let lowest = (0..looks.len()).find(is_dip)?;
        let from = lowest.checked_sub(1).map_or(0.0, |k| looks[k]);
        let (to, margin) = self.lowest(from * h, looks.get(lowest + 1).unwrap_or(&1.0) * h);
        Some(Near { to, margin })
    }

    /// Place and value of the least margin between two lengths, by golden sections.
    fn lowest(&mut self, mut from: f64, mut to: f64) -> (f64, f64) {
        let mut inner = [from + GOLDEN * (to - from), to - GOLDEN * (to - from)];
        let mut values = inner.map(|tau| self.margin(tau).unwrap_or(f64::INFINITY));
        for _ in 0..SECTIONS {
            if values[0] <= values[1] {
                to = inner[1];
                (inner[1], values[1]) = (inner[0], values[0]);
                inner[0] = from + GOLDEN * (to - from);
                values[0] = self.margin(inner[0]).unwrap_or(f64::INFINITY);
            } else {
                from = inner[0];
                (inner[0], values[0]) = (inner[1], values[1]);
                inner[1] = to - GOLDEN * (to - from);
                values[1] = self.margin(inner[1]).unwrap_or(f64::INFINITY);
            }
        }
        if values[0] <= values[1] { (inner[0], values[0]) } else { (inner[1], values[1]) }
    }

    /// Margin at `tau` after the start of the step, along its polynomials cut at their least terms.
    fn margin(&mut self, tau: f64) -> Option<f64> {
        // the terms of collocation are those of one polynomial, none of them less sure than another
        let sure = if self.step.implicit { None } else { self.terms(tau, f64::INFINITY) };
        let last = sure.map_or(usize::MAX, |(last, _)| last);
        for i in 0..self.x.len() {
            let c = self.step.states.row(i);
            self.next_x[i] = c[0] + step::increment(&c[..=last.min(c.len() - 1)], tau);
        }
        self.system.margin(self.now.after(tau).high, &self.next_x)
    }

    /// The index of the least pair of terms, relative to the change of the states of one unit, and its size. The reactions have a pole at a change point, at the
    /// distance `pole`; terms of the motion are what is left of theirs, and known to their rounding only.
    fn terms(&self, tau: f64, pole: f64) -> Option<(usize, f64)> {
        let p = self.step.order;
        if tau == 0.0 || p < 4 {
            return None;
        }
        let changes = self.changes(tau);
        let mut sizes: Vec<f64> = (0..=p).map(|k| NOISE * elementary::powi((tau / pole).abs(), k as i32)).collect();
        let powers: Vec<f64> = std::iter::successors(Some(1.0), |power| Some(power * tau.abs())).take(p + 1).collect();
        for (i, change) in changes.iter().enumerate().filter(|(_, change)| **change > 0.0) {
            for ((size, c), power) in sizes.iter_mut().zip(self.step.states.row(i)).zip(&powers) {
                *size = size.max(c.abs() * power / change);
            }
        }
        let pair = |k: usize| sizes[k].max(sizes[k + 1]);
        (3..p).min_by(|a, b| pair(*a).total_cmp(&pair(*b))).map(|k| (k + 1, pair(k)))
    }

    /// Change of each state within a length: the largest first terms among the states of one unit.
    fn changes(&self, tau: f64) -> Vec<f64> {
        let own = |i: usize| {
            let c = self.step.states.row(i);
            (1..c.len().min(4)).map(|k| c[k].abs() * elementary::powi(tau.abs(), k as i32)).fold(0.0, f64::max)
        };
        let mut own: Vec<f64> = (0..self.x.len()).map(own).collect();
        // a rate by what it moves: uniform motions have no change of their own
        let n = self.system.n_coordinates();
        (0..n).for_each(|i| own[n + i] = own[n + i].max(own[i] / tau.abs()));
        let groups = self.rule.groups();
        let mut largest = vec![0.0_f64; own.len()];
        groups.iter().zip(&own).for_each(|(group, own)| largest[*group] = largest[*group].max(*own));
        groups.iter().map(|group| largest[*group]).collect()
    }

    /// Cuts the series for a step to `out` over the change point at `to`; false where they have too few digits for this error.
    fn prepare(&mut self, to: f64, out: f64, [wanted, error]: [f64; 2]) -> bool {
        let [wanted, error] = [wanted, error].map(|e| self.rule.tolerance.max(e));
        let pole = to.min(self.behind(out));
        let Some((last, size)) = self.terms(out, pole) else { return false };
        if size.is_nan() || size > wanted {
            return false;
        }
        let changes = self.changes(out);
        let whole = [self.step.states.clone(), self.step.guards.clone()];
        self.step.states.cut(last);
        self.step.guards.cut(last);
        self.passage.over = Some(Over { to, whole, error, changes });
        let Passage { here, best, .. } = self.passage;
        self.passage.least = 0.0;
        self.step.change = Some([to, (BLIND * best / here).min(0.5) * to]);
        true
    }

    /// A guard that changes at this length of a step, close to the change point that it leads over: its modes cannot be decided there.
    ///
    /// *Errors*: S058.
    pub(super) fn refuse_switch_in_passage(&self, length: Option<f64>) -> Result<(), Fault> {
        match (&self.passage.over, length) {
            (Some(over), Some(length)) if length > (1.0 - CLEAR) * over.to => Err(self.at_change_point(over.to)),
            _ => Ok(()),
        }
    }

    /// Whether a step that leads over no change point ends near one all the same: it was shortened since its length was found, or its last terms say another
    /// end than those that could be believed.
    pub(super) fn ends_near(&mut self, length: f64) -> bool {
        let Passage { here, best, .. } = self.passage;
        let t = self.now.after(length).high;
        let near = |margin: f64| margin < 0.5 * (CLEAR * best).min(OWN * here);
        self.passage.over.is_none() && best > 0.0 && self.system.margin(t, &self.next_x).is_some_and(near)
    }

    /// Keeps the instant of a change point that has been passed.
    pub(super) fn note_passage(&mut self, length: f64) {
        if let Some(over) = self.passage.over.take().filter(|over| over.to < length) {
            self.passage.behind = Some(self.step.instant(over.to));
        }
    }

    /// Whether the present step leads over a change point that is near, and whether its end satisfies the equations then.
    pub(super) fn passes(&self, h: f64) -> Option<bool> {
        let over = self.passage.over.as_ref()?;
        let off = |i: usize| h * (self.next_slope[i] - self.system.state(i)[1]).abs();
        Some((0..self.x.len()).all(|i| off(i) <= DEFECT * over.error * over.changes[i]))
    }

    /// Gives up a passage: the length of a step towards the change point.
    ///
    /// *Errors*: S058 where it is reached.
    pub(super) fn give_up_passage(&mut self) -> Option<Result<f64, Fault>> {
        let Over { to, whole, .. } = self.passage.over.take()?;
        let [states, guards] = whole;
        (self.step.states, self.step.guards, self.step.change) = (states, guards, None);
        self.work.rejected += 1;
        self.rule.restore(self.step.order);
        Some(self.before(to))
    }

    /// Whether the step comes so near to a change point that places and rates need all their digits.
    pub(super) fn is_near_change_point(&self) -> bool {
        self.passage.least < FINE * self.passage.best
    }

    /// Whether the end of the step, at its length, is too near to a change point to be closed.
    pub(super) fn ends_blind(&self, length: f64) -> bool {
        self.step.change.is_some_and(|[to, around]| (length - to).abs() <= around)
    }

    /// A fault beside a change point is that of the change point.
    pub(super) fn explained(&self, fault: Fault) -> Fault {
        let Passage { best, least, .. } = self.passage;
        let of_the_position = [codes::UNDERFLOW, codes::APART, codes::CONTRADICTION, program::DEPENDENT].contains(&fault.code);
        if of_the_position && least < BLIND * best { self.at_change_point(0.0) } else { fault }
    }

    /// Whether the rates grow without bound towards the singularity that ends the convergence of the series.
    fn runs_out(&self) -> bool {
        let (n, p) = (self.system.n_coordinates(), self.step.order);
        let rate = |i: &usize| self.step.states.row(*i)[1].abs();
        let Some(i) = (0..n).filter(|_| p > 4).max_by(|a, b| rate(a).total_cmp(&rate(b))) else { return false };
        let c = self.step.states.row(i);
        let distance = (c[p - 1] / c[p]).abs();
        2.0 * c[2].abs() * distance > RUNAWAY * c[1].abs()
    }

    /// The fault of a change point; of the end of a reach, where rates grow without bound.
    fn at_change_point(&self, to: f64) -> Fault {
        if self.runs_out() {
            return self.underflow();
        }
        let place = |i: usize| {
            let c = self.step.states.row(i);
            c[0] + step::increment(c, to)
        };
        let x: Vec<f64> = (0..self.system.n_coordinates()).map(place).collect();
        let places = crate::naming::configuration(self.system.states().iter().zip(&x));
        Fault::change_point(&places, self.now.after(to).high)
    }
}

/// A least margin ahead.
struct Near {
    /// How far it is.
    to: f64,
    /// The margin itself.
    margin: f64,
}
