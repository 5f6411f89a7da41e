//! One turn of the motion from a section back to it: its steps, the switches between them, the instant of return.

use super::listener::{Listener, Stage};
use crate::integrate::Step;
use crate::integrate::crossings::Switch;
use crate::integrate::crossings::roots::RootFinder;
use crate::integrate::taylor::{Flow, Options};
use crate::{Fault, Mode, Since, System};

/// Where a turn ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Section {
    /// State `state` less `drift` times t reaches `level`, moving in the direction `sign`; the `count`-th such crossing.
    Level {
        state: usize,
        level: f64,
        drift: f64,
        sign: f64,
        count: usize,
        /// Part of the level that is whole turns from the start.
        turn: f64,
    },
    /// After this time.
    Time(f64),
}

impl Section {
    /// The time after which it is.
    pub(super) fn time(self) -> Option<f64> {
        if let Section::Time(time) = self { Some(time) } else { None }
    }
}

/// A switch: the state on both sides of it.
#[derive(Clone, Debug)]
pub(super) struct Jump {
    /// Index of the step that ends in it.
    pub(super) after: usize,
    pub(super) t: f64,
    pub(super) before: Vec<f64>,
    pub(super) then: Vec<f64>,
    pub(super) modes: [Vec<Mode>; 2],
    pub(super) switches: Vec<Switch>,
}

/// A turn.
#[derive(Clone, Debug, Default)]
pub(super) struct Orbit {
    pub(super) steps: Vec<Step>,
    pub(super) jumps: Vec<Jump>,
    /// Duration.
    pub(super) period: f64,
    /// State and modes at the start and at the end.
    pub(super) first: Vec<f64>,
    pub(super) last: Vec<f64>,
    pub(super) modes: [Vec<Mode>; 2],
}

impl Orbit {
    /// Contacts and frictions, by guard, that hold all along the turn.
    pub(super) fn closed(&self) -> Vec<usize> {
        let [begin, end] = &self.modes;
        let holds = |modes: &[Mode], guard: usize| modes.get(guard) == Some(&Mode::Zero);
        let all = |guard: &usize| holds(begin, *guard) && holds(end, *guard) && self.steps.iter().all(|step| holds(&step.modes, *guard));
        (0..begin.len()).filter(all).collect()
    }

    /// Its start, from which conditions on rates count what they keep; `closed` as [`Orbit::closed`].
    pub(super) fn since<'a>(&'a self, closed: &'a [usize]) -> Since<'a> {
        Since { t: 0.0, x: &self.first, closed }
    }
}

/// A section passed within this share of the time so far of a switch is passed at the switch.
const TOGETHER: f64 = 1e-13;
/// Share of its time behind the end of a turn within which a switch belongs to it: some roundings of a phase.
const BEHIND: f64 = 64.0 * f64::EPSILON;
/// Instants that differ by less than this share of the period are one: a regime closes to 1e-10, and its switches happen as exactly.
pub(super) const ONE: f64 = 1e-10;
/// Most steps of a turn.
const STEPS: usize = 200_000;

/// When a turn is given up.
#[derive(Clone, Copy)]
pub(super) struct Limit<'a> {
    /// Longest time.
    pub(super) time: f64,
    /// Who listens.
    pub(super) listener: Listener<'a>,
}

/// Follows the motion from x at t = 0 to the first of the sections; none when it reaches none before `limit`. Returns which one it was.
pub(super) fn follow<S: System + ?Sized>(
    system: &mut S,
    x: &[f64],
    sections: &[Section],
    limit: Limit<'_>,
    options: &Options,
) -> Result<Option<(Orbit, usize)>, Fault> {
    let mut flow = Flow::start(system, 0.0, x, options)?;
    let mut orbit = Orbit { first: flow.state().to_vec(), modes: [flow.modes().to_vec(), Vec::new()], ..Orbit::default() };
    let mut watched: Vec<Watched> = sections.iter().map(|s| Watched::new(*s, x)).collect();
    let timed = sections.iter().position(|s| matches!(s, Section::Time(_)));
    let end = match sections.first() {
        Some(Section::Time(t)) => *t,
        _ => limit.time,
    };
    while !flow.reached(end) && orbit.steps.len() < STEPS {
        if limit.listener.is_interrupted() {
            return Ok(None);
        }
        limit.listener.tell(Stage::Following(orbit.period));
        flow.advance(end)?;
        let mut step = flow.step().clone();
        let back = first_return(&step, &mut watched);
        let switched = !flow.switches().is_empty();
        // a section that is a switch: the turn ends behind it, as it began
        let at_switch = switched && back.is_some_and(|(tau, _)| step.length - tau <= TOGETHER * (step.length + orbit.period));
        if let Some((tau, which)) = back.filter(|_| !at_switch) {
            let at = step.instant(tau);
            step.shorten(tau);
            orbit.period = at.high;
            orbit.last = vec![0.0; x.len()];
            step.state_at(at.high, &mut orbit.last);
            orbit.modes[1] = step.modes.clone();
            orbit.steps.push(step);
            return Ok(Some((orbit, which)));
        }
        let mut before = vec![0.0; x.len()];
        step.state_at(step.end().high, &mut before);
        let modes = [step.modes.clone(), flow.modes().to_vec()];
        orbit.steps.push(step);
        orbit.period = flow.time();
        if switched {
            let (t, switches, then) = (flow.time(), flow.switches().to_vec(), flow.state().to_vec());
            orbit.jumps.push(Jump { after: orbit.steps.len() - 1, t, before, then, modes, switches });
        }
        if let Some((_, which)) = back {
            orbit.last = flow.state().to_vec();
            orbit.modes[1] = flow.modes().to_vec();
            return Ok(Some((orbit, which)));
        }
    }
    let Some(which) = timed.filter(|_| flow.reached(end)) else { return Ok(None) };
    orbit.period = end;
    (orbit.last, orbit.modes[1]) = (flow.state().to_vec(), flow.modes().to_vec());
    if flow.switches().is_empty() {
        switch_at_end(&mut flow, &mut orbit);
    }
    Ok(Some((orbit, which)))
}

/// A switch at the very end of the time, which rounding may put behind it: the turn ends behind what happens once in a period, as it began behind it.
fn switch_at_end<S: System + ?Sized>(flow: &mut Flow<'_, S>, orbit: &mut Orbit) {
    // a fault behind the end is none of the turn
    if flow.advance(orbit.period + BEHIND * orbit.period).is_err() || flow.switches().is_empty() {
        return;
    }
    let mut step = flow.step().clone();
    step.shorten(0.0);
    orbit.steps.push(step);
    let (t, switches, then) = (flow.time(), flow.switches().to_vec(), flow.state().to_vec());
    let modes = [std::mem::replace(&mut orbit.modes[1], flow.modes().to_vec()), flow.modes().to_vec()];
    let before = std::mem::replace(&mut orbit.last, then.clone());
    orbit.jumps.push(Jump { after: orbit.steps.len() - 1, t, before, then, modes, switches });
}

/// A section under watch.
struct Watched {
    section: Section,
    below: bool,
    left: usize,
    roots: RootFinder,
}

impl Watched {
    fn new(section: Section, x: &[f64]) -> Watched {
        let (below, left) = match section {
            Section::Level { state, level, sign, count, .. } => (sign * (x[state] - level) < 0.0, count),
            Section::Time(_) => (false, 1),
        };
        Watched { section, below, left, roots: RootFinder::default() }
    }

    /// tau in [0, length] at which the section is passed for the last time that is wanted.
    fn pass(&mut self, step: &Step) -> Option<f64> {
        let Section::Level { state, level, drift, sign, .. } = self.section else { return None };
        // sign (x - level - drift t) as a polynomial of the time within the step, from below to above at a passage
        let mut c: Vec<f64> = step.coefficients(state).iter().map(|c| sign * c).collect();
        c[0] = sign * ((step.start_value(state) - level) - drift * step.start.high);
        c[1] -= sign * drift;
        // a start on the section but for rounding
        if step.start.high == 0.0 && c[0].abs() <= 1e-13 * level.abs() {
            // the start itself, rounded
            (c[0], self.below) = (0.0, false);
        }
        let mut at = 0.0;
        // a start on the section, or a passage within rounding of the end of the step before
        let mut here = if self.below && c[0] >= 0.0 { Some(true) } else { None };
        if c[0] < 0.0 {
            self.below = true;
        }
        let mut on_surface = c[0] == 0.0;
        for _ in 0..CROSSINGS {
            if here.take() == Some(true) {
                self.below = false;
                self.left -= 1;
                if self.left == 0 {
                    return Some(at);
                }
                on_surface = true;
                c[0] = 0.0;
            }
            let side = if self.below { -1.0 } else { 1.0 };
            let tail = if on_surface { &c[1..] } else { &c[..] };
            let tau = self.roots.first_crossing(tail, step.length - at, side)?;
            at += tau;
            shift(&mut c, tau);
            c[0] = 0.0;
            on_surface = true;
            here = Some(self.below);
            self.below = !self.below;
        }
        None
    }
}

/// Most passages of a section within a step.
const CROSSINGS: usize = 64;

/// The polynomial about tau.
fn shift(c: &mut [f64], tau: f64) {
    for i in 0..c.len() {
        for k in (i..c.len() - 1).rev() {
            c[k] += tau * c[k + 1];
        }
    }
}

/// First instant of the step at which a section has been passed as often as it should.
fn first_return(step: &Step, watched: &mut [Watched]) -> Option<(f64, usize)> {
    let mut first: Option<(f64, usize)> = None;
    for (which, w) in watched.iter_mut().enumerate() {
        if let Some(tau) = w.pass(step)
            && first.is_none_or(|(t, _)| tau < t)
        {
            first = Some((tau, which));
        }
    }
    first
}

impl Orbit {
    /// State at an instant of the turn.
    pub(super) fn state_at(&self, t: f64) -> Vec<f64> {
        let mut x = self.first.clone();
        let k = self.steps.partition_point(|s| s.end().high < t).min(self.steps.len().saturating_sub(1));
        if let Some(step) = self.steps.get(k) {
            step.state_at(t, &mut x);
        }
        x
    }

    /// To where the motion is followed so that it holds all that a period has: a switch at its very end may lie behind it by rounding.
    pub(super) fn end(&self) -> f64 {
        let last = self.steps.len().saturating_sub(1);
        let behind = self.jumps.last().is_some_and(|jump| jump.after == last && self.steps[last].length == 0.0);
        if behind { self.period + BEHIND * self.period } else { self.period }
    }

    /// The steps in which an instant lies: two where one ends and the next begins within rounding of it.
    pub(super) fn sides_at(&self, t: f64) -> impl Iterator<Item = &Step> {
        let within = ONE * self.period;
        self.steps.iter().filter(move |step| step.start.high - within <= t && t <= step.end().high + within)
    }

    /// Range of each state along the turn, seen from a frame that moves with these velocities, and its largest magnitude. Steps are looked at inside too: a body may
    /// slide from rest to rest in one of them.
    pub(super) fn ranges(&self, frame: &[f64]) -> Vec<(f64, f64)> {
        let mut ends = vec![(f64::INFINITY, f64::NEG_INFINITY); frame.len()];
        let mut see = |t: f64, x: &[f64]| {
            for ((low, high), (x, v)) in ends.iter_mut().zip(x.iter().zip(frame)) {
                let value = x - v * t;
                (*low, *high) = (low.min(value), high.max(value));
            }
        };
        let mut x = vec![0.0; self.first.len()];
        for step in &self.steps {
            for k in 0..SAMPLES {
                let t = step.instant(step.length * k as f64 / SAMPLES as f64).high;
                step.state_at(t, &mut x);
                see(t, &x);
            }
        }
        see(self.steps.last().map_or(0.0, |s| s.end().high), &self.last);
        ends.into_iter().map(|(low, high)| (high - low, low.abs().max(high.abs()))).collect()
    }

    /// Where a formula of (t, state) passes zero from below: instant and state.
    pub(super) fn first_zero(&self, formula: &dyn Fn(f64, &[f64]) -> f64) -> Option<(f64, Vec<f64>)> {
        let mut x = vec![0.0; self.first.len()];
        let mut value = |step: &Step, t: f64| {
            step.state_at(t, &mut x);
            (formula(t, &x), x.clone())
        };
        // where the motion sticks on the section, rounding decides the sign
        let mut largest = 0.0_f64;
        for step in &self.steps {
            for k in 0..=SAMPLES {
                let found = value(step, step.instant(step.length * k as f64 / SAMPLES as f64).high).0.abs();
                largest = largest.max(if found.is_finite() { found } else { 0.0 });
            }
        }
        let zero = -ON_SECTION * largest;
        let mut below = false;
        for step in &self.steps {
            let mut before = step.start.high;
            for k in 0..=SAMPLES {
                let t = step.instant(step.length * k as f64 / SAMPLES as f64).high;
                let (found, x) = value(step, t);
                if below && found >= zero {
                    if k == 0 {
                        return Some((t, x));
                    }
                    let (mut a, mut b) = (before, t);
                    for _ in 0..100 {
                        let middle = 0.5 * (a + b);
                        if value(step, middle).0 < 0.0 {
                            a = middle;
                        } else {
                            b = middle;
                        }
                    }
                    return Some((b, value(step, b).1));
                }
                below = found < zero;
                before = t;
            }
        }
        // the zero may be at the very start, which is also the end
        let (first, x) = value(self.steps.first()?, 0.0);
        (below && first >= zero).then_some((0.0, x))
    }
}

/// Share of its largest value within which a section's formula is zero.
const ON_SECTION: f64 = 1e-13;
/// Places within a step at which states and the formula of a section are looked at.
const SAMPLES: usize = 16;
