//! One attempt at an implicit step.

use super::dense::{Dense, ahead};
use super::newton::{Newton, Outcome};
use super::nodes::{Base, Counts, Stages};
use super::radau::{Tableau, stages};
use super::scales::Scales;
use crate::integrate::Step;
use crate::integrate::series::Series;
use crate::proxies::points::Points;
use crate::{Fault, Jacobian, System};

/// What an attempt has shown.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Verdict {
    /// The step holds; the next may be longer by this factor.
    Holds(f64),
    /// It must be shorter, by this factor.
    Shorter(f64),
    /// The system gives no Jacobian.
    Impossible,
}

/// Degree of the polynomials through what operations do on a step.
const LOOKED_AT: usize = 16;
/// Most by which a step may exceed the one before.
const GROWTH: f64 = 8.0;
/// Part of the admissible step that is taken.
const SAFETY: f64 = 0.9;
/// How far the coefficients of a guard may exceed the tolerance.
const GUARD_SLACK: f64 = 100.0;
/// Share of its distance from zero by which a guard may be wrong that changes little.
const FAR: f64 = 0.01;

/// The implicit method with its memory.
#[derive(Clone, Debug)]
pub(crate) struct Collocation {
    pub(super) tableau: Tableau,
    pub(super) newton: Newton,
    pub(super) scales: Scales,
    stages: Stages,
    /// Polynomials of x - x(0) and of the guards by powers of tau.
    pub(super) powers: Series,
    pub(super) guard_powers: Series,
    pub(super) n_guards: usize,
    dense: Dense,
    /// Of the step before, when this one continues it.
    last: Option<Dense>,
    guards: Dense,
    /// Guards at the nodes, node by node; rows of guards that decide nothing are empty.
    guard_values: Vec<f64>,
    guard_scales: Vec<f64>,
    guard_noise: Vec<f64>,
    guard_active: Vec<bool>,
    /// Defect of the guards at the last attempt of this step: what does not fall with h is rounding.
    stubborn: Option<f64>,
    pub(super) point: Vec<f64>,
    /// Where the operations are looked at.
    pub(super) points: Points,
    pub(super) counts: Counts,
}

impl Collocation {
    /// *Errors*: S023, never for the numbers of stages in use.
    pub(crate) fn new(tolerance: f64, units: &[&str], n_guards: usize) -> Result<Collocation, Fault> {
        let (s, n) = (stages(tolerance), units.len());
        Ok(Collocation {
            tableau: Tableau::new(s)?,
            newton: Newton::new(s, n),
            scales: Scales::new(tolerance, units),
            stages: Stages::new(s, n),
            powers: Series::default(),
            guard_powers: Series::default(),
            n_guards,
            dense: Dense::new(n, s),
            last: None,
            guards: Dense::new(n_guards, s),
            guard_values: vec![0.0; (s + 1) * n_guards],
            guard_scales: vec![0.0; n_guards],
            guard_noise: vec![0.0; n_guards],
            guard_active: vec![false; n_guards],
            stubborn: None,
            point: vec![0.0; n],
            points: Points::new(LOOKED_AT),
            counts: Counts::default(),
        })
    }

    /// Degree of the polynomials.
    pub(crate) fn degree(&self) -> usize {
        self.tableau.stages
    }
    pub(crate) fn counts(&self) -> &Counts {
        &self.counts
    }
    /// Writes its polynomials, from the state x on, into a step.
    pub(crate) fn give(&self, step: &mut Step, x: &[f64]) {
        step.order = self.degree();
        step.implicit = true;
        step.states.clone_from(&self.powers);
        x.iter().enumerate().for_each(|(k, x)| step.states.set_first(k, *x));
        step.guards.clone_from(&self.guard_powers);
    }
    /// x at the end minus x at the start.
    pub(crate) fn change(&self) -> &[f64] {
        self.stages.row(self.tableau.stages - 1)
    }
    /// The next step continues the one that has just been found.
    pub(crate) fn keep(&mut self) {
        self.last = Some(self.dense.clone());
        self.stubborn = None;
    }
    /// The next step does not.
    pub(crate) fn forget(&mut self) {
        self.last = None;
        self.stubborn = None;
    }

    /// A step of length h.
    pub(crate) fn attempt<S: System + ?Sized>(&mut self, system: &mut S, base: &Base<'_>, h: f64) -> Verdict {
        self.predict(h);
        match self.linearise(system, base, h) {
            Ok(Jacobian::Given) => {}
            Ok(Jacobian::Absent) => return Verdict::Impossible,
            Err(_) => return Verdict::Shorter(0.25),
        }
        if !self.newton.factor(&self.tableau, h, &mut self.counts) {
            return Verdict::Shorter(0.25);
        }
        let (mut stages, mut scales) = (std::mem::take(&mut self.stages), self.scales.clone());
        let outcome = self.newton.solve(system, base, (&self.tableau, h), (&mut stages, &mut scales, &mut self.counts));
        (self.stages, self.scales) = (stages, scales);
        if outcome == Outcome::Failed {
            return Verdict::Shorter(0.4);
        }
        for k in 0..base.x.len() {
            self.dense.fill(k, &self.tableau, 0.0, self.stages.column(k));
        }
        self.dense.h = h;
        let growth = SAFETY * self.dense.growth(&self.scales);
        if growth.is_nan() || growth < SAFETY {
            return Verdict::Shorter(if growth.is_nan() { 0.1 } else { growth.clamp(0.1, SAFETY) });
        }
        self.write_powers(h);
        if let Some(verdict) = self.inspect(system, base, h) {
            return verdict;
        }
        if self.is_seen(system, base, h) { Verdict::Holds(growth.min(GROWTH)) } else { Verdict::Shorter(0.5) }
    }

    /// The stages from the step before; zero without one.
    fn predict(&mut self, h: f64) {
        let Some(last) = &self.last else {
            self.stages.values.fill(0.0);
            return;
        };
        let values = ahead(&self.tableau, h / last.h);
        for k in 0..self.point.len() {
            for (i, z) in last.beyond(k, self.tableau.stages - 1, &values).into_iter().enumerate() {
                self.stages.row_mut(i)[k] = z;
            }
        }
    }

    /// The Jacobian in the middle of the step as predicted, or at its start where it has no value there.
    fn linearise<S: System + ?Sized>(&mut self, system: &mut S, base: &Base<'_>, h: f64) -> Result<Jacobian, Fault> {
        let middle = self.tableau.stages / 2;
        base.state(self.stages.row(middle), &mut self.point);
        let t = base.time(self.tableau.nodes[middle] * h);
        self.counts.jacobians += 1;
        let there = system.jacobian(t, &self.point, base.modes, &mut self.newton.jacobian);
        there.or_else(|_| {
            self.counts.jacobians += 1;
            system.jacobian(base.start.high, base.x, base.modes, &mut self.newton.jacobian)
        })
    }

    fn write_powers(&mut self, h: f64) {
        let width = self.tableau.stages + 1;
        let mut row = vec![0.0; width];
        self.powers.reset(width);
        for k in 0..self.point.len() {
            self.tableau.to_powers(self.dense.row(k), h, &mut row);
            self.powers.push(&row);
        }
    }

    /// Guards, and equations between the nodes. None when all is well.
    fn inspect<S: System + ?Sized>(&mut self, system: &mut S, base: &Base<'_>, h: f64) -> Option<Verdict> {
        let guards = match self.follow_guards(system, base, h) {
            Some(excess) => excess,
            None => return Some(Verdict::Shorter(0.4)),
        };
        let Some(between) = self.between_nodes(system, base, h) else { return Some(Verdict::Shorter(0.4)) };
        let excess = between.max(guards);
        if excess <= 1.0 {
            return None;
        }
        // truncation falls fast with h; what stays is rounding of the guards' own forces
        let stubborn = self.stubborn.is_some_and(|before| excess > 0.25 * before);
        self.stubborn = Some(excess);
        (!stubborn).then_some(Verdict::Shorter(0.5))
    }

    /// Polynomials of the guards; how far their last coefficients exceed what is allowed. None where they have no value.
    fn follow_guards<S: System + ?Sized>(&mut self, system: &mut S, base: &Base<'_>, h: f64) -> Option<f64> {
        let width = self.tableau.stages + 1;
        self.guard_powers.reset(width);
        if self.n_guards == 0 {
            return Some(0.0);
        }
        for i in 0..width {
            let zero = vec![0.0; base.x.len()];
            let (tau, change) = if i == 0 { (0.0, &zero[..]) } else { (self.tableau.nodes[i - 1] * h, self.stages.row(i - 1)) };
            base.state(change, &mut self.point);
            system.expand(base.time(tau), &self.point, base.modes, 1).ok()?;
            for k in 0..self.n_guards {
                let value = system.guard(k).first();
                self.guard_active[k] = value.is_some();
                self.guard_values[i * self.n_guards + k] = value.copied().unwrap_or(0.0);
                // an instant is known to its rounding
                let slope = system.guard(k).get(1).copied().unwrap_or(0.0);
                let before = if i == 0 { 0.0 } else { self.guard_noise[k] };
                self.guard_noise[k] = before.max(f64::EPSILON * (slope * base.start.high).abs());
            }
        }
        let mut worst: f64 = 0.0;
        let mut row = vec![0.0; width];
        for k in 0..self.n_guards {
            let values = |i: usize| self.guard_values[i * self.n_guards + k];
            let first = values(0);
            self.guard_scales[k] = (1..width).fold(0.0, |m: f64, i| m.max((values(i) - first).abs()));
            let rounding = f64::EPSILON * first.abs() + self.guard_noise[k];
            let nearest = (0..width).fold(f64::INFINITY, |m: f64, i| m.min(values(i).abs()));
            // far from its surface beside its change within the step: only that it stays there matters
            let far = if nearest > 2.0 * self.guard_scales[k] { FAR * nearest / GUARD_SLACK } else { 0.0 };
            self.guard_scales[k] = self.guard_scales[k].max(rounding.max(far) / self.scales.tolerance);
            self.guards.fill(k, &self.tableau, first, (1..width).map(values));
            let last = self.guards.row(k)[width - 2..].iter().fold(0.0, |m: f64, a| m.max(a.abs()));
            worst = worst.max(if self.guard_active[k] { last / self.guard_allowance(k) } else { 0.0 });
            self.tableau.to_powers(self.guards.row(k), h, &mut row);
            self.guard_powers.push(if self.guard_active[k] { &row } else { &[] });
        }
        Some(worst / GUARD_SLACK)
    }

    pub(super) fn guard_allowance(&self, k: usize) -> f64 {
        (self.scales.tolerance * self.guard_scales[k]).max(f64::MIN_POSITIVE)
    }
}
