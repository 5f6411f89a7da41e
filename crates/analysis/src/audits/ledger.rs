//! Energy ledger: E(t) - E(0) - W(t), W the work of everything that supplies or takes energy, integrated along the motion.
//!
//! ```text
//! W = ∫ (loads + drives - dissipated) dt + Σ energy that impacts take or give + Σ change of E by a switch while the state stands
//! value = max over t of |E - E(0) - W| / (max T, max |Π - Π(0)|, ∫ |loads| + |drives| + |dissipated| dt), or what passes through the damping,
//!         or what the single loads give by rounding
//! ```
//!
//! Powers are integrated over every step of the dense output by Gauss's rule with five points, exact to degree 9, which serves steps that end at events; where the
//! balance of a step does not close to its tolerance, with twelve, exact to degree 23: a step of order 26 over an oscillation is about 7 in the phase of its powers, of which that
//! rule misses 1e-16. Where it does not close then either the step is halved until the integral stands, so that what remains is the motion's and not the rule's. Accelerations are the
//! derivatives of the dense output. A step that ends beside the next one's start (a projection) counts as error. Nothing closes the ledger by itself: it
//! sees a drift that the power balance at an instant cannot.
//!
//! **Limit.** A step errs by at most about tol of its own change, and the changes of N steps add up to at most N times the scale: N tol, not below
//! 1e-9 where rounding rules, never above `MOST`, whatever tolerance was asked for.

use words::Text;

use super::damping::damping_alone;
use super::frontier::{FLOOR, Frontier};
use super::{LEAST, ROUNDED};
use crate::dataset::Audit;
use crate::integrate::Step;
use crate::system::Motions;
use crate::{Mode, Supply, System};
use algebra::gauss::{FIVE, TWELVE};
use algebra::sum::two_sum;
use program::ABREAST;

/// A motion whose energy is off by more than this is wrong at any tolerance.
const MOST: f64 = 1e-3;
/// Share of the tolerance, relative to what passed, below which a difference may be rounding.
const ROUGH: f64 = 0.03;
/// Halvings of a step.
const DEEPEST: u32 = 24;
/// Most parts of a step.
const PARTS: usize = 400;

/// Work over a part of a step: net, of all kinds without sign, and what the outputs asked for leave of the net one.
#[derive(Clone, Copy, Debug, Default)]
struct Work {
    net: f64,
    passed: f64,
    rest: f64,
}

/// A part of a step, and places in it with their weights.
type Points<'r> = ((f64, f64), &'r [(f64, f64)]);

/// The place of a point of a rule.
fn place((from, to): (f64, f64), u: f64) -> f64 {
    from + 0.5 * (to - from) * (1.0 + u)
}

/// The share of a point of a rule.
fn share((from, to): (f64, f64), weight: f64) -> f64 {
    0.5 * weight * (to - from)
}

impl Work {
    /// Adds the share of a point; `asked` are the powers asked for there.
    fn add(&mut self, p: &Supply, share: f64, asked: f64) {
        let net = p.loads + p.drives - p.dissipated;
        self.net += share * net;
        self.rest += share * (net - asked);
        self.passed += share * (p.loads.abs() + p.drives.abs() + p.dissipated.abs());
    }
}

/// Where a step has ended.
#[derive(Clone, Debug, Default)]
struct End {
    t: f64,
    x: Vec<f64>,
    modes: Vec<Mode>,
    /// T and Π there.
    energies: [f64; 2],
}

/// Keeps the ledger.
#[derive(Clone, Debug)]
pub struct Ledger {
    known: bool,
    /// Potential energy at the start.
    potential: Option<f64>,
    /// E - E(0) - W so far, high and low part.
    open: (f64, f64),
    passed: f64,
    kinetic: f64,
    range: f64,
    /// Rounding of the energies themselves.
    rounding: f64,
    found: Frontier,
    steps: u64,
    /// The end of the last step.
    last: Option<End>,
    impact: bool,
    tolerance: f64,
    x: Vec<f64>,
    rates: Vec<f64>,
    /// Outputs that are powers within the loads, and what they must have done: change of energy less the work of all others.
    powers: Vec<usize>,
    owed: f64,
    outputs: Vec<f64>,
    motions: Motions,
    /// Modes in which the system wants to be asked point by point.
    refused: Option<Vec<Mode>>,
}

impl Ledger {
    /// For a system with this many states. `powers` are outputs whose work is to be confirmed.
    pub fn new<S: System + ?Sized>(system: &S, tolerance: f64, powers: &[usize]) -> Ledger {
        let n_states = system.states().len();
        Ledger {
            powers: powers.to_vec(),
            owed: 0.0,
            outputs: vec![0.0; system.outputs().len()],
            motions: Motions::default(),
            refused: None,
            known: true,
            potential: None,
            open: (0.0, 0.0),
            passed: 0.0,
            kinetic: 0.0,
            range: 0.0,
            rounding: 0.0,
            found: Frontier::default(),
            steps: 0,
            last: None,
            impact: false,
            tolerance,
            x: vec![0.0; n_states],
            rates: vec![0.0; n_states],
        }
    }

    /// What an ensemble has found over so many steps.
    pub(crate) fn settle(&mut self, worst: f64, steps: u64) {
        self.found = Frontier::default();
        self.found.note(worst, 1.0);
        self.steps = steps;
    }

    /// The jump between the last step and the next is an impact: its energy is accounted for there.
    pub fn impact(&mut self) {
        self.impact = true;
    }

    /// Books a step up to `length`.
    pub fn look<S: System + ?Sized>(&mut self, step: &Step, system: &mut S, length: f64) {
        if self.known && length > 0.0 {
            self.known = self.book(step, system, length).is_some();
        }
    }

    fn book<S: System + ?Sized>(&mut self, step: &Step, system: &mut S, h: f64) -> Option<()> {
        step.state_after(0.0, &mut self.x);
        let mut end = self.last.take();
        let goes_on = |end: &&End| end.t == step.start.high && end.x == self.x && end.modes == step.modes;
        let before = match end.as_ref().filter(goes_on) {
            Some(end) => {
                self.impact = false;
                end.energies
            }
            None => {
                let before = self.energy(step, system, 0.0)?;
                self.between(step, system, end.as_ref(), before)?;
                before
            }
        };
        step.state_after(h, &mut self.x);
        let after = self.energy(step, system, h)?;
        let last = end.get_or_insert_default();
        (last.t, last.energies) = (step.instant(h).high, after);
        last.x.clone_from(&self.x);
        last.modes.clone_from(&step.modes);
        self.last = end;
        let change = (after[0] - before[0]) + (after[1] - before[1]);
        let moved = (after[0] - before[0]).abs() + (after[1] - before[1]).abs();
        let work = self.work(step, system, h, [change, moved])?;
        // what closes against its own terms needs no further scale: N such steps stay below a third of the limit
        let clear = (change - work.net).abs() <= 0.1 * self.tolerance * (work.passed + moved);
        let through = if clear { 0.0 } else { self.through(step, system, 0.5 * h) };
        self.passed += work.passed.max(through * h);
        self.add(change - work.net);
        self.owed += change - work.rest;
        self.steps += 1;
        Some(())
    }

    /// Work over a step by as many points as its balance needs, from the change of energy and what moved between its kinds.
    fn work<S: System + ?Sized>(&mut self, step: &Step, system: &mut S, h: f64, [change, moved]: [f64; 2]) -> Option<Work> {
        // what is asked for one by one must stand by itself
        let alone = self.powers.is_empty();
        let closes = |ledger: &Ledger, work: &Work| {
            let size = work.passed + moved;
            (change - work.net).abs() <= (0.1 * ledger.tolerance * size).max(4.0 * f64::EPSILON * ledger.rounding)
        };
        if alone {
            let work = self.gauss(step, system, (0.0, h), &FIVE)?;
            if closes(self, &work) {
                return Some(work);
            }
        }
        let work = self.gauss(step, system, (0.0, h), &TWELVE)?;
        if alone && closes(self, &work) { Some(work) } else { self.halved(step, system, h, work) }
    }

    /// What passes through the damping alone, and what the rounding of the single loads makes of a power, W: where loads balance, their sum is nothing beside them.
    fn through<S: System + ?Sized>(&mut self, step: &Step, system: &mut S, tau: f64) -> f64 {
        let (t, n) = (step.instant(tau).high, system.n_coordinates());
        step.motion_after(tau, &mut self.x, &mut self.rates);
        let loads = system.powers(t, &self.x, &self.rates[n..2 * n], &step.modes).map_or(0.0, |p| p.through);
        damping_alone(system, t, &self.x, &step.modes).max(FLOOR * loads)
    }

    /// What happened since the end of the last step, where the state and the energies are those of the start of this one.
    fn between<S: System + ?Sized>(&mut self, step: &Step, system: &mut S, end: Option<&End>, now: [f64; 2]) -> Option<()> {
        let impact = std::mem::take(&mut self.impact);
        let Some(End { x, energies: before, .. }) = end.filter(|end| end.x != self.x || end.modes != step.modes) else { return Some(()) };
        // the same state under the new laws
        let middle = system.energies(step.start.high, x, &step.modes)?;
        let switched = (middle[0] - before[0]) + (middle[1] - before[1]);
        self.passed += switched.abs();
        let jump = (now[0] - middle[0]) + (now[1] - middle[1]);
        if impact {
            self.passed += jump.abs();
        } else {
            self.add(jump);
        }
        Some(())
    }

    fn add(&mut self, residual: f64) {
        let (high, low) = two_sum(self.open.0, residual);
        self.open = (high, self.open.1 + low);
        let scale = self.kinetic.max(self.range).max(self.passed).max(ROUNDED * f64::EPSILON / LEAST * self.rounding);
        let value = (self.open.0 + self.open.1).abs();
        self.found.note(value, scale);
    }

    /// T and Π of the state in hand; widens the scales.
    fn energy<S: System + ?Sized>(&mut self, step: &Step, system: &mut S, tau: f64) -> Option<[f64; 2]> {
        let [kinetic, potential] = system.energies(step.instant(tau).high, &self.x, &step.modes)?;
        let first = *self.potential.get_or_insert(potential);
        self.kinetic = self.kinetic.max(kinetic.abs());
        self.range = self.range.max((potential - first).abs());
        self.rounding = self.rounding.max(kinetic.abs() + potential.abs());
        Some([kinetic, potential])
    }

    fn gauss<S: System + ?Sized>(&mut self, step: &Step, system: &mut S, span: (f64, f64), rule: &[(f64, f64)]) -> Option<Work> {
        let mut work = Work::default();
        for points in rule.chunks(ABREAST) {
            if !self.goes_abreast(step) || !self.abreast(step, system, (span, points), &mut work) {
                self.one_by_one(step, system, (span, points), &mut work)?;
            }
        }
        Some(work)
    }

    /// Adds what some points of a rule give, one after the other.
    fn one_by_one<S: System + ?Sized>(&mut self, step: &Step, system: &mut S, (span, points): Points, work: &mut Work) -> Option<()> {
        let n = system.n_coordinates();
        for (u, weight) in points {
            let tau = place(span, *u);
            step.motion_after(tau, &mut self.x, &mut self.rates);
            let p: Supply = system.supply(step.instant(tau).high, &self.x, &self.rates[n..2 * n], &step.modes)?;
            let asked = self.asked(step, system, tau)?;
            work.add(&p, share(span, *weight), asked);
        }
        Some(())
    }

    /// Powers that are asked for are outputs, one by one; and what has been refused in these modes is not tried again.
    fn goes_abreast(&self, step: &Step) -> bool {
        self.powers.is_empty() && self.refused.as_ref() != Some(&step.modes)
    }

    /// The same at once, bit for bit; false where the system has to be asked point by point.
    fn abreast<S: System + ?Sized>(&mut self, step: &Step, system: &mut S, (span, points): Points, work: &mut Work) -> bool {
        let mut taus = [0.0; ABREAST];
        taus.iter_mut().zip(points).for_each(|(tau, (u, _))| *tau = place(span, *u));
        step.motions_after(&taus[..points.len()], &mut self.motions);
        let mut supplies = [Supply::default(); ABREAST];
        if !system.supplies(&self.motions, &step.modes, &mut supplies) {
            self.refused = Some(step.modes.clone());
            return false;
        }
        points.iter().zip(&supplies).for_each(|((_, weight), p)| work.add(p, share(span, *weight), 0.0));
        true
    }

    /// Sum of the powers asked for, where the state is that of tau.
    fn asked<S: System + ?Sized>(&mut self, step: &Step, system: &mut S, tau: f64) -> Option<f64> {
        if self.powers.is_empty() {
            return Some(0.0);
        }
        system.observe(step.instant(tau).high, &self.x, &step.modes, &mut self.outputs).ok()?;
        Some(self.powers.iter().map(|i| self.outputs[*i]).sum())
    }

    /// The integral by halving, each part until two halves agree with it.
    fn halved<S: System + ?Sized>(&mut self, step: &Step, system: &mut S, h: f64, whole: Work) -> Option<Work> {
        let mut sum = Work::default();
        let mut open = vec![(0.0, h, whole, 0_u32, f64::INFINITY)];
        let mut parts = 0;
        while let Some((from, to, coarse, depth, before)) = open.pop() {
            let middle = 0.5 * (from + to);
            let left = self.gauss(step, system, (from, middle), &TWELVE)?;
            let right = self.gauss(step, system, (middle, to), &TWELVE)?;
            let off = (left.net + right.net - coarse.net).abs().max((left.rest + right.rest - coarse.rest).abs());
            parts += 1;
            // a thousandth of what the motion itself may be wrong by, or rounding of the powers
            let enough = off <= 1e-3 * self.tolerance * (whole.passed + sum.passed) || off <= 4.0 * f64::EPSILON * self.rounding;
            // what does not fall with the part is rounding of the powers, as long as it is little
            let rounding = off > 0.25 * before && off <= ROUGH * self.tolerance * (whole.passed + sum.passed);
            if enough || rounding || depth >= DEEPEST || parts > PARTS {
                sum.net += left.net + right.net;
                sum.passed += left.passed + right.passed;
                sum.rest += left.rest + right.rest;
            } else {
                open.push((middle, to, right, depth + 1, off));
                open.push((from, middle, left, depth + 1, off));
            }
        }
        Some(sum)
    }

    /// The audit; none when the system has no energies or did not move in time.
    pub fn audit(&self) -> Option<Audit> {
        let name = Text::new(
            "energy ledger: largest |E − E(0) − work| relative to the energy that passed",
            "баланс энергии: наибольшее |E − E(0) − работа| относительно прошедшей энергии",
        );
        let limit = (self.steps as f64 * self.tolerance).clamp(LEAST, MOST);
        (self.known && self.steps > 0).then(|| Audit::at_most("energy_ledger", name, self.found.worst(), limit))
    }

    /// Whether the work of the outputs asked for, found another way, is what the energy and all other works leave.
    pub fn confirmed(&self, work: f64) -> Audit {
        let name = Text::new(
            "work of the motors: change of energy less the work of everything else, relative to the energy that passed",
            "работа двигателей: изменение энергии за вычетом работы всего остального, относительно прошедшей энергии",
        );
        let scale = self.kinetic.max(self.range).max(self.passed).max(ROUNDED * f64::EPSILON / LEAST * self.rounding);
        let off = (work - self.owed).abs();
        let limit = (self.steps as f64 * self.tolerance).clamp(LEAST, MOST);
        Audit::at_most("work", name, if off == 0.0 { 0.0 } else { off / scale }, limit)
    }

    /// Whether energies have no value along the motion, so that there is no ledger.
    pub fn is_unknown(&self) -> bool {
        !self.known
    }
}
