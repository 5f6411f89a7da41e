//! Switches on the way: the first crossing inside a step, what is on its surface at the end, and when switches come too close.

use super::flow::{Ending, Flow};
use crate::integrate::Step;
use crate::integrate::crossings::roots::{CLEAR, clear_before, surely_no_root};
use crate::integrate::crossings::{BoundState, Change, opposite};
use crate::{Fault, GuardKind, Mode, System};
use algebra::elementary;

/// Switches in a row closer than [`CLOSE`] of the undisturbed step before they count as an accumulation.
const CROWD: u32 = 64;
// far closer than switches of a machine, far above the rounding of an instant
const CLOSE: f64 = 1e-9;

/// Share of the loads of the machine below which a normal force is rounding.
const NO_LOAD: f64 = 1e-13;

/// How far the last terms of a guard may exceed the tolerance. They are those of the states in nearly all guards and then much smaller.
const SLACK: f64 = 100.0;

/// Share of its distance to which a root is sharp: roots that are simple are known to some hundred times less.
const SHARP: f64 = 1e-11;

/// Share of the time below which two instants are one.
const INSTANT: f64 = 16.0 * f64::EPSILON;

/// The part of a step h on which the last four terms stay below the tolerance times the change.
fn convergent(c: &[f64], mut h: f64, tolerance: f64) -> f64 {
    let p = c.len().saturating_sub(1);
    if p < 8 || c[p - 3..].iter().all(|c_k| *c_k == 0.0) {
        return h;
    }
    for _ in 0..80 {
        let (mut power, mut change) = (1.0, f64::EPSILON * c[0].abs() / tolerance);
        let mut factor: f64 = 1.0;
        for (k, c_k) in c.iter().enumerate().skip(1) {
            power *= h;
            let term = c_k.abs() * power;
            if k <= p / 2 {
                change = f64::max(change, term);
            } else if k + 4 > p && (term > SLACK * tolerance * change || term.is_nan()) {
                let share = elementary::pow(tolerance * change / term, 1.0 / k as f64);
                // shorter for sure, and not by more than three decades at once
                factor = factor.min(if share.is_nan() { 1e-3 } else { share.clamp(1e-3, 0.95) });
            }
        }
        if factor == 1.0 {
            break;
        }
        h *= factor;
    }
    h
}

impl<S: System + ?Sized> Flow<'_, S> {
    /// The step up to the first sign change of a guard; marks the guards that change there. It ends before one that rounding of the guard's terms blurs: seen
    /// from nearby its root is sharper.
    pub(super) fn shorten_to_event(&mut self, h: f64) -> (f64, Ending) {
        self.touched.fill(false);
        self.weighed = false;
        let (mut first, mut whose, mut clear) = (f64::INFINITY, 0, f64::INFINITY);
        for i in 0..self.modes.len() {
            let Some(tau) = self.crossing(i, h) else { continue };
            clear = self.clear_before(i, tau).map_or(clear, |place| place.min(clear));
            if tau < first {
                (first, whose) = (tau, i);
            }
        }
        if first > h {
            return (h, Ending::Plain);
        }
        if clear < first {
            return (clear, Ending::Plain);
        }
        // what lies within rounding of the first root happens together with it
        let together = first + 4.0 * f64::EPSILON * self.now.high.abs() + 1e-14 * h;
        for i in 0..self.modes.len() {
            self.touched[i] = i == whose || self.crossing(i, together.min(h)).is_some();
        }
        (first, Ending::Event)
    }

    /// The step on which the polynomials of the guards can be trusted. Where the motion is a polynomial (free flight) the step is as long as the run,
    /// but a guard like the slack of a rope, l - sqrt(x² + y²), is none.
    pub(super) fn trusted(&self, step: &Step, h: f64) -> f64 {
        let scheduled = |i: usize| self.system.guards()[i].scheduled.is_some();
        // the gap of a closed contact and the slip of a friction that holds are zero: their polynomials are rounding, and nobody asks for their roots
        let kept = |i: usize| matches!(self.system.guards()[i].kind, GuardKind::Contact { .. } | GuardKind::Friction { .. });
        let holds = |i: usize| self.modes[i] == Mode::Zero && kept(i);
        (0..self.modes.len())
            .filter(|i| !scheduled(*i) && !holds(*i))
            .fold(h, |h, i| convergent(step.guards.row(i), h, self.rule.tolerance))
    }

    pub(super) fn crossing(&mut self, i: usize, h: f64) -> Option<f64> {
        if let GuardKind::Bound { of, .. } = self.system.guards()[i].kind {
            return if self.modes[of] == Mode::Zero { self.bound_crossing(i, h) } else { None };
        }
        let mode = self.modes[i];
        if mode == Mode::Zero || self.system.guards()[i].scheduled.is_some() || self.decides_nothing(i) {
            return None;
        }
        if self.is_no_load(i, h) {
            return None;
        }
        let c = self.step.guards.row(i).get(self.deflation[i]..).unwrap_or_default();
        let vanishes = c.iter().all(|c_k| *c_k == 0.0);
        if vanishes || surely_no_root(c, h) { None } else { self.roots.first_crossing(c, h, mode.sign()) }
    }

    /// Where a guard stands clear of its rounding before a root that this rounding blurs: a root of higher order, or one of two that are close.
    fn clear_before(&self, i: usize, root: f64) -> Option<f64> {
        if !matches!(self.system.guards()[i].kind, GuardKind::Switch | GuardKind::Contact { .. } | GuardKind::Friction { .. }) {
            return None;
        }
        let c = self.step.guards.row(i).get(self.deflation[i]..)?;
        clear_before(c, root, (SHARP * root).max(INSTANT * self.now.high.abs()))
    }

    /// Whether a switch has changed its sign by more than rounding in a step whose polynomial of it has none: what a tolerance leaves out of a quantity that grows
    /// over many decades is more than the quantity where the step begins.
    pub(super) fn passed_a_switch(&self, length: f64) -> bool {
        let clearly = |i: usize| {
            let value = self.system.guard(i).first().copied().unwrap_or(0.0);
            value.abs() > CLEAR * crate::integrate::crossings::size(self.step.guards.row(i), length)
        };
        let own = |i: &usize| self.modes[*i] != Mode::Zero && self.system.guards()[*i].kind == GuardKind::Switch;
        length > INSTANT * self.now.high.abs() && (0..self.modes.len()).filter(own).any(|i| self.is_on_wrong_side(i) && clearly(i))
    }

    /// A normal force that is rounding of the others.
    fn is_no_load(&self, i: usize, h: f64) -> bool {
        matches!(self.system.guards()[i].kind, GuardKind::Normal { .. })
            && crate::integrate::crossings::size(self.step.guards.row(i), h) <= NO_LOAD * self.loads
    }

    /// A friction that nothing presses, and what the integrator alone sets.
    fn decides_nothing(&self, i: usize) -> bool {
        match self.system.guards()[i].kind {
            GuardKind::Share { .. } | GuardKind::Side { .. } => true,
            GuardKind::Friction { .. } => self.is_off(i),
            _ => false,
        }
    }

    /// Where a bound becomes negative. One that has just been reached is judged by where it goes.
    fn bound_crossing(&mut self, i: usize, h: f64) -> Option<f64> {
        let found = self.bound_crossing_as_known(i, h)?;
        // a violation counts when it is more than the rounding of what meets in the force
        if self.weigh_once(i) { self.bound_crossing_as_known(i, h) } else { Some(found) }
    }

    fn bound_crossing_as_known(&mut self, i: usize, h: f64) -> Option<f64> {
        let c = self.step.guards.row(i);
        let deflation = match self.judge(i, c, h) {
            BoundState::Kept => 0,
            BoundState::Rises(k) => k,
            BoundState::Rests => return None,
            BoundState::Crossed => return Some(0.0),
        };
        let c = &self.step.guards.row(i)[deflation..];
        if surely_no_root(c, h) { None } else { self.roots.first_crossing(c, h, 1.0) }
    }

    /// Marks guards whose scheduled instant is now.
    pub(super) fn mark_scheduled(&mut self) -> bool {
        let mut any = false;
        for (i, guard) in self.system.guards().iter().enumerate() {
            if guard.scheduled == Some(self.now.high) && self.now.low == 0.0 {
                self.touched[i] = true;
                any = true;
            }
        }
        any
    }

    /// What counts as small for a guard: its terms in the last step. A guard that stands still keeps its scale.
    pub(super) fn remember_guard_scales(&mut self) {
        for i in 0..self.modes.len() {
            let size = crate::integrate::crossings::size(self.step.guards.row(i), self.step.length);
            let kept = if self.modes[i] == Mode::Zero { self.guard_scale[i] } else { 0.0 };
            self.guard_scale[i] = size.max(kept);
            self.guard_noise[i] = 8.0 * f64::EPSILON * size;
        }
    }

    /// Marks guards whose sign contradicts their mode: they have been crossed within rounding of the step's end.
    pub(super) fn mark_wrong_sides(&mut self) -> bool {
        let mut wrong = false;
        self.weighed = false;
        for i in 0..self.modes.len() {
            let is_wrong = self.is_on_wrong_side(i) && (!self.weigh_once(i) || self.is_on_wrong_side(i));
            self.touched[i] |= is_wrong;
            wrong |= is_wrong;
        }
        wrong
    }

    pub(super) fn is_on_wrong_side(&self, i: usize) -> bool {
        let g = self.system.guard(i);
        let Some(&value) = g.first() else { return false };
        let guard = &self.system.guards()[i];
        if guard.scheduled.is_some() {
            return false;
        }
        match guard.kind {
            GuardKind::Bound { of, .. } => return self.modes[of] == Mode::Zero && self.judge(i, g, self.guess) == BoundState::Crossed,
            GuardKind::Friction { .. } | GuardKind::Contact { .. } if self.modes[i] == Mode::Zero => return false,
            _ if self.decides_nothing(i) => return false,
            GuardKind::Normal { .. } => {
                return self.modes[i] == opposite(Mode::of(value)) && value.abs() > self.guard_noise[i].max(NO_LOAD * self.loads);
            }
            _ => {}
        }
        match self.modes[i] {
            Mode::Zero => crate::integrate::crossings::size(g, self.guess) > crate::integrate::crossings::STILL * self.guard_scale[i],
            mode => value * mode.sign() < 0.0,
        }
    }

    pub(super) fn watch_crowd(&mut self) -> Result<(), Fault> {
        let gap = self.crowd.last.until(self.now.high);
        self.crowd.last = self.now;
        // impacts end by their own rule
        let impact = self.switches.iter().any(|s| s.change != Change::Mode);
        // what has died out below the tolerance lets steps be as long as they like
        if gap > CLOSE * self.natural.min(self.span) || impact {
            self.crowd.close = 0;
            return Ok(());
        }
        self.crowd.close += 1;
        if self.crowd.close < CROWD {
            return Ok(());
        }
        let guard = self.switches.last().map(|s| s.guard).or_else(|| self.touched.iter().position(|&t| t)).unwrap_or(0);
        Err(Fault::accumulation(&self.system.guards()[guard].name, self.now.high))
    }
}
