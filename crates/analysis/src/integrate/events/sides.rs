//! The side of its surface on which the flow of a trial keeps a guard.
//!
//! A guard away from its surface has the sign of its value, a guard on its surface the sign of its first Taylor coefficient that does not vanish.
//! What follows depends on the role:
//!
//! | role | mode | kept | else it wants |
//! |---|---|---|---|
//! | normal force | sign | its value has that sign, or vanishes | the sign of its value |
//! | switch | any | side of the flow; `Zero` when all coefficients vanish (sign(v) of a body that rests without force) | that side |
//! | friction | sticks | both limits are not negative and do not become so | to slide in the direction of the exceeded limit |
//! | friction | slides | the flow leaves the surface in the direction of sliding | to stick |
//! | contact | closed | the force is not negative and does not become so | to open |
//! | contact | open | the gap opens | to close |

use crate::integrate::taylor::Flow;
use crate::{Fault, GuardKind, Mode, System, Tie};

use crate::integrate::crossings::opposite;
use crate::integrate::crossings::{BoundState, REACHED, SIGNIFICANT_LEAVING, STILL, judge_bound, leading_term, size};

/// Share of the guard's change within a step below which a Taylor coefficient is rounding. Were it taken for more, the mode would be corrected by a
/// second switch that share of a step later.
const SIGNIFICANT: f64 = 1e-15;
/// A limit of a friction below this share of both: a force of more than twice the static limit would be needed. Nearer cases are judged exactly,
/// after the state has been moved onto the conditions.
const TORN: f64 = 0.25;
/// Share of the loads of the machine that stands for the size of a force that nearly vanishes: it is their difference.
const OTHERS: f64 = 0.1;
/// Share of its scale above which a switch that should be on its surface has jumped away from it: its formula switches itself.
const JUMPED: f64 = 1e-9;
/// Share of positions and rates above which what others should hold moves.
const LOOSE: f64 = 1e-9;
/// Rounding of a guard at the start, in units of the last place of the states that meet in it.
const START: f64 = 64.0 * f64::EPSILON;

/// The same of a contact: what has lain on a moving table or hung on a rope for many periods, and what is given to twelve digits, lies on it.
const LAID: f64 = 4096.0 * f64::EPSILON;

/// How much larger than value and state the change of a guard over a step may be and still count for its rounding.
const FAR: f64 = 1e3;

/// Largest share of what a guard does that counts as its rounding.
const PLAUSIBLE: f64 = 1e-6;

impl<S: System + ?Sized> Flow<'_, S> {
    pub(super) fn has_contacts(&self) -> bool {
        self.system.guards().iter().any(|g| matches!(g.kind, GuardKind::Friction { .. } | GuardKind::Contact { .. }))
    }

    /// Sides of frictions and contacts at the start, by the values of the last expansion; the other guards are left to the search.
    pub(super) fn sides_at_start(&mut self) -> Result<(), Fault> {
        let n = self.system.n_coordinates();
        let largest = |part: &[f64]| part.iter().fold(0.0, |m: f64, x| m.max(x.abs()));
        let all = [largest(&self.x[..n]), largest(&self.x[n..2 * n])];
        let known = self.system.reaches(self.now.high, &self.x);
        for i in 0..self.modes.len() {
            let [places, rates] = known.iter().find(|(guard, _)| *guard == i).map_or(all, |(_, sizes)| *sizes);
            let guard = &self.system.guards()[i];
            let (around, contact) = match guard.kind {
                GuardKind::Friction { .. } => (rates, false),
                GuardKind::Contact { .. } => (places, true),
                _ => continue,
            };
            let value = self.system.guard(i).first().copied().unwrap_or(0.0);
            // over a long run a free flight leads anywhere: what meets in the value itself is of its own size, or of that of the state
            let own = value.abs().max(around);
            let reach = if own > 0.0 { self.guard_scale[i].min(FAR * own) } else { self.guard_scale[i] };
            let noise = (START * reach.max(around)).max(if contact { LAID * around } else { 0.0 });
            self.guard_noise[i] = noise;
            self.touched[i] = value.abs() <= noise;
            self.modes[i] = if self.touched[i] && !contact { Mode::Zero } else { Mode::of(value) };
            if contact && value < -noise {
                let fault = if guard.tie { Fault::too_short } else { Fault::penetrates };
                return Err(fault(&guard.name, value, self.now.high));
            }
            if contact && self.touched[i] {
                // closed, unless an impact or the flow opens it
                let rate = self.system.guard(i).get(1).copied().unwrap_or(0.0);
                self.modes[i] = if rate.abs() <= (START * reach.max(rates)).max(LAID * rates) { Mode::Zero } else { Mode::Positive };
            }
        }
        self.free_unloaded();
        Ok(())
    }

    /// A friction that nothing presses holds nothing, though its point may stand: two of them could repeat each other in a blow elsewhere.
    fn free_unloaded(&mut self) {
        for i in 0..self.modes.len() {
            if self.modes[i] == Mode::Zero && self.is_off(i) {
                self.modes[i] = Mode::Positive;
                self.touched[i] = false;
            }
        }
    }

    /// The mode that the flow of the last expansion asks for.
    pub(super) fn wanted(&mut self, i: usize) -> Mode {
        match self.system.guards()[i].kind {
            GuardKind::Switch => self.wanted_switch(i),
            GuardKind::Bound { .. } => Mode::Positive,
            GuardKind::Normal { .. } => self.wanted_normal(i),
            GuardKind::Share { .. } | GuardKind::Side { .. } => self.modes[i],
            GuardKind::Friction { .. } if self.is_off(i) => self.wanted_unloaded(i),
            GuardKind::Friction { limits, .. } if self.modes[i] == Mode::Zero => self.wanted_sticking(limits),
            GuardKind::Friction { .. } => self.wanted_leaving(i),
            GuardKind::Contact { force } if self.modes[i] == Mode::Zero => self.wanted_closed(force),
            GuardKind::Contact { .. } => self.wanted_leaving(i),
        }
    }

    /// The present modes with the signs that the normal forces of the last expansion have.
    pub(super) fn signed(&self) -> Vec<Mode> {
        let normal = |i: usize| matches!(self.system.guards()[i].kind, GuardKind::Normal { .. });
        (0..self.modes.len()).map(|i| if normal(i) { self.wanted_normal(i) } else { self.modes[i] }).collect()
    }

    /// The sign that a normal force has in the present trial; the present one where there is none.
    fn wanted_normal(&self, i: usize) -> Mode {
        match self.near_zero(i) {
            Near::Away(mode) | Near::Leads(_, mode) => mode,
            Near::Rests if self.modes[i] == Mode::Zero => Mode::Positive,
            Near::Rests => self.modes[i],
        }
    }

    /// Whether a normal force is there, or about to be.
    pub(super) fn presses(&self, i: usize) -> bool {
        !matches!(self.near_zero(i), Near::Rests)
    }

    /// Where a normal force stands and goes. One whose crossing has just been located is zero but for the rounding of that instant.
    fn near_zero(&self, i: usize) -> Near {
        let g = self.system.guard(i);
        let Some(&value) = g.first() else { return Near::Rests };
        let scale = self.guard_scale[i].max(OTHERS * self.loads);
        if value.abs() > if self.touched[i] { JUMPED } else { REACHED } * scale {
            return Near::Away(Mode::of(value));
        }
        let change = size(&g[1..], self.natural) * self.natural;
        if change <= STILL * scale {
            return Near::Rests;
        }
        leading_term(g, self.natural, SIGNIFICANT_LEAVING).map_or(Near::Rests, |(k, mode)| Near::Leads(k, mode))
    }

    /// Number of leading coefficients of a guard that are zero but for rounding where the motion goes on in the present modes.
    pub(super) fn roots_here(&self, i: usize) -> usize {
        let guard = &self.system.guards()[i];
        if matches!(guard.kind, GuardKind::Normal { .. }) {
            return match self.near_zero(i) {
                Near::Leads(k, mode) if mode == self.modes[i] => k,
                Near::Rests => self.system.guard(i).len(),
                _ => 0,
            };
        }
        let searched = guard.scheduled.is_none() && !matches!(guard.kind, GuardKind::Bound { .. }) && !self.is_off(i);
        let deflates = self.touched[i] && self.modes[i] != Mode::Zero && searched;
        if deflates { self.leading(i).map_or(0, |(k, _)| k) } else { 0 }
    }

    /// The modes that the flow of the last expansion asks for. What violates a law counts when it is more than rounding.
    pub(super) fn wishes(&mut self) -> Vec<Mode> {
        let wanted: Vec<Mode> = (0..self.modes.len()).map(|i| self.wanted(i)).collect();
        if wanted == self.modes || !self.has_contacts() {
            return wanted;
        }
        self.weigh();
        (0..self.modes.len()).map(|i| self.wanted(i)).collect()
    }

    /// What is nothing at the contacts and frictions of the present state and modes.
    fn weigh(&mut self) {
        for (i, tie) in self.system.ties(self.now.high, &self.x, &self.modes) {
            if !self.is_rounding(i, tie) {
                continue;
            }
            let own = &mut self.ties[i];
            *own =
                Tie { rate: own.rate.max(tie.rate), acceleration: own.acceleration.max(tie.acceleration), force: own.force.max(tie.force) };
        }
    }

    /// Whether a tie is small beside what the guard does, or beside the positions and rates that meet in one that has never moved. Where a condition has no
    /// direction (a slider in its dead centre) its force, and all that is computed from it, has no digits.
    fn is_rounding(&self, i: usize, tie: Tie) -> bool {
        let g = self.system.guard(i);
        let change = g.get(1..).map_or(0.0, |rest| size(rest, self.natural) * self.natural);
        let effect = match self.system.guards()[i].kind {
            GuardKind::Contact { .. } => 0.5 * tie.acceleration * self.natural * self.natural,
            _ => tie.acceleration * self.natural,
        };
        effect <= PLAUSIBLE * self.guard_scale[i].max(change).max(self.reach())
    }

    /// The same for the owner of a bound; whether more counts as nothing now. What is nothing is found for all at once.
    pub(crate) fn weigh_once(&mut self, bound: usize) -> bool {
        let GuardKind::Bound { of, .. } = self.system.guards()[bound].kind else { return false };
        if std::mem::replace(&mut self.weighed, true) {
            return false;
        }
        let before = self.ties[of].force;
        self.weigh();
        self.ties[of].force > before
    }

    /// A friction without a load goes by its speed alone.
    fn wanted_unloaded(&self, i: usize) -> Mode {
        match self.system.guard(i).first().map(|v| Mode::of(*v)) {
            Some(Mode::Zero) | None if self.modes[i] == Mode::Zero => Mode::Positive,
            Some(Mode::Zero) | None => self.modes[i],
            Some(mode) => mode,
        }
    }

    /// Whether a contact or friction that others should carry moves all the same.
    pub(super) fn is_loose(&self, i: usize) -> bool {
        let GuardKind::Share { of } = self.system.guards()[i].kind else { return false };
        if self.modes[i] == Mode::Positive || self.modes[of] != Mode::Zero {
            return false;
        }
        let g = self.system.guard(of);
        size(g, self.natural) > LOOSE * self.guard_scale[of].max(self.reach())
    }

    /// How large positions and rates are, for what cancels between them.
    fn reach(&self) -> f64 {
        let n = self.system.n_coordinates();
        self.x[..2 * n].iter().fold(0.0, |m: f64, x| m.max(x.abs()))
    }

    fn wanted_switch(&mut self, i: usize) -> Mode {
        let g = self.system.guard(i);
        let Some(&value) = g.first() else { return self.modes[i] };
        if let Some(t) = self.system.guards()[i].scheduled {
            let slope = Mode::of(g.get(1).copied().unwrap_or(0.0));
            return if self.now.until(t) > 0.0 { opposite(slope) } else { slope };
        }
        if !self.touched[i] {
            if value.abs() > self.guard_noise[i] {
                return Mode::of(value);
            }
            self.touched[i] = true;
        }
        if value.abs() > JUMPED * self.guard_scale[i] {
            return Mode::of(value);
        }
        self.leading(i).map_or(Mode::Zero, |(_, mode)| mode)
    }

    /// Of two exceeded limits (a static limit that is negative) the further one decides.
    fn wanted_sticking(&self, limits: [usize; 2]) -> Mode {
        let judged = limits.map(|b| self.judge(b, self.system.guard(b), self.natural));
        let value = |b: usize| self.system.guard(b).first().copied().unwrap_or(0.0);
        let crossed = match judged.map(|state| state == BoundState::Crossed) {
            [false, false] => return Mode::Zero,
            [true, false] => limits[0],
            [false, true] => limits[1],
            [true, true] if value(limits[1]) < value(limits[0]) => limits[1],
            [true, true] => limits[0],
        };
        self.exit_of(crossed)
    }

    /// The modes without the frictions that no force of their size can hold, none when all can. At a dead centre the sliding speed vanishes although
    /// the machine runs on: J is zero there, and rates moved onto J q' = 0 would stop it at once. So this is judged before the state is moved.
    pub(super) fn torn_off(&mut self) -> Result<Option<Vec<Mode>>, Fault> {
        let sticking = |(guard, mode): (&crate::Guard, &Mode)| match guard.kind {
            GuardKind::Friction { limits, .. } if *mode == Mode::Zero => Some(limits),
            _ => None,
        };
        let limits: Vec<Option<[usize; 2]>> = self.system.guards().iter().zip(&self.modes).map(sticking).collect();
        if limits.iter().all(Option::is_none) {
            return Ok(None);
        }
        self.system.expand(self.now.high, &self.x, &self.modes, 1)?;
        let mut wanted = self.signed();
        if wanted != self.modes {
            return Ok(Some(wanted));
        }
        let mut weighed = false;
        for (i, bounds) in limits.iter().enumerate() {
            let Some(bounds) = bounds else { continue };
            let Some(bound) = self.tearing(i, *bounds) else { continue };
            // once for all: the state and the modes are the same
            if !weighed {
                self.weigh();
                weighed = true;
            }
            if self.tearing(i, *bounds).is_some() {
                wanted[i] = self.exit_of(bound);
            }
        }
        Ok((wanted != self.modes).then_some(wanted))
    }

    /// The limit that no force of the size of both can keep.
    fn tearing(&self, i: usize, bounds: [usize; 2]) -> Option<usize> {
        let [back, forth] = bounds.map(|b| self.system.guard(b).first().copied().unwrap_or(0.0));
        let (least, bound) = if back < forth { (back, bounds[0]) } else { (forth, bounds[1]) };
        let nothing = (REACHED * OTHERS * self.loads).max(self.ties[i].force);
        (least < -TORN * (back.abs() + forth.abs()) && least < -nothing).then_some(bound)
    }

    fn wanted_closed(&self, force: usize) -> Mode {
        match self.judge(force, self.system.guard(force), self.natural) {
            BoundState::Crossed => self.exit_of(force),
            _ => Mode::Zero,
        }
    }

    fn exit_of(&self, bound: usize) -> Mode {
        match self.system.guards()[bound].kind {
            GuardKind::Bound { exit, .. } => exit,
            _ => Mode::Positive,
        }
    }

    /// A friction that slides, a contact that is open.
    fn wanted_leaving(&mut self, i: usize) -> Mode {
        let contact = matches!(self.system.guards()[i].kind, GuardKind::Contact { .. });
        let Some(&value) = self.system.guard(i).first() else { return self.modes[i] };
        if !self.touched[i] {
            // a contact never penetrates: what lies below the surface by rounding is on it
            if value.abs() > self.guard_noise[i] && !(contact && value < 0.0) {
                return Mode::of(value);
            }
            self.touched[i] = true;
        }
        match self.leading(i) {
            Some((_, mode)) if mode == self.modes[i] => mode,
            _ => Mode::Zero,
        }
    }

    /// State of bound `b` with these coefficients over a step h.
    pub(in crate::integrate) fn judge(&self, b: usize, g: &[f64], h: f64) -> BoundState {
        judge_bound(g, h, self.bound_scale(b, g, h))
    }

    /// Both limits of a friction together are twice its static limit. A contact force is compared with the largest it has had. Neither is told from the
    /// rounding of the other loads of the machine.
    fn bound_scale(&self, b: usize, g: &[f64], h: f64) -> f64 {
        let GuardKind::Bound { of, .. } = self.system.guards()[b].kind else { return 0.0 };
        let value = |i: usize| self.system.guard(i).first().map_or(0.0, |v| v.abs());
        let own = match self.system.guards()[of].kind {
            GuardKind::Friction { limits: [a, b], .. } => value(a) + value(b),
            _ => self.guard_scale[b].max(size(g, h)),
        };
        own.max(OTHERS * self.loads).max(self.ties[of].force / REACHED)
    }

    /// The largest contact or normal force in the trial whose guards these are, over a step h.
    pub(crate) fn largest_load<'g>(&self, guards: impl Fn(usize) -> &'g [f64], h: f64) -> f64 {
        let kinds = self.system.guards();
        let is_load = |i: &usize| match kinds[*i].kind {
            GuardKind::Normal { .. } => true,
            GuardKind::Bound { of, .. } => matches!(kinds[of].kind, GuardKind::Contact { .. }),
            _ => false,
        };
        (0..kinds.len()).filter(is_load).map(|i| size(guards(i), h)).filter(|s| s.is_finite()).fold(0.0, f64::max)
    }

    /// Order and sign of the first coefficient, after the constant one, that does not vanish.
    pub(super) fn leading(&self, i: usize) -> Option<(usize, Mode)> {
        let g = self.system.guard(i);
        let h = self.natural;
        // the rate after an impact is known, however small it is
        if self.rebounds[i] && g.get(1).is_some_and(|rate| *rate > 0.0) {
            return Some((1, Mode::Positive));
        }
        let known = self.without_ties(i, g);
        let g = known.as_deref().unwrap_or(g);
        let change = size(g.get(1..)?, h) * h;
        // what a crossed limit lets go moves, however little: its scale is that of trials in which it moved the other way
        let still = if self.leaving[i] { 0.0 } else { STILL * self.guard_scale[i] };
        if change <= still {
            return None;
        }
        leading_term(g, h, if self.leaving[i] { SIGNIFICANT_LEAVING } else { SIGNIFICANT })
    }

    /// The coefficients without the rate and the acceleration where these are nothing; none where there is nothing to leave out.
    fn without_ties(&self, i: usize, g: &[f64]) -> Option<Vec<f64>> {
        let Tie { rate, acceleration, .. } = self.ties[i];
        let known = match self.system.guards()[i].kind {
            GuardKind::Contact { .. } => [rate, 0.5 * acceleration],
            GuardKind::Friction { .. } => [acceleration, 0.0],
            _ => return None,
        };
        let first = known.iter().zip(g.get(1..)?).take_while(|(nothing, g)| **g != 0.0 && g.abs() <= **nothing).count();
        (first > 0).then(|| g.iter().enumerate().map(|(k, g)| if (1..=first).contains(&k) { 0.0 } else { *g }).collect())
    }
}

/// Where a normal force stands and goes.
enum Near {
    /// It has this sign.
    Away(Mode),
    /// It vanishes, and takes the sign of the coefficient of this order.
    Leads(usize, Mode),
    /// It vanishes and stays so.
    Rests,
}
