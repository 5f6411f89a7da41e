//! The blows of one instant: which contacts take part, what Newton's law asks of them, and what is left when none closes any more.
//!
//! **Closed** is a contact that was closed before the instant, and one whose rate is rounding of the terms that meet in it: both signs of such a rate mean
//! zero. With `impacts = "together"` the set of a blow is every contact that closes or is closed; in sequence those that close fastest.

use symbolic::connections::{Impacts, Rebound};
use words::Text;

use super::ties::RATE;
use crate::fault::contacts::Gaining;
use crate::system::BlowWork;
use crate::{Blow, Fault, SingleBlow};

/// Share of the largest rate below which a closing rate is rounding.
pub(crate) const SILENT: f64 = 1e-13;
/// Contacts whose closing rates differ by less than this share strike together.
const TIE: f64 = 1e-9;
/// Most blows in one instant.
const MOST: usize = 20_000;
/// Most blows of one instant that are handed on one by one.
const TOLD: usize = 256;
/// Work of a blow on the bodies, relative to the terms that meet in it, that rounding makes.
const GAIN: f64 = 1e-9;

/// A contact or a friction that takes part.
pub(super) struct Unit {
    pub(super) guard: usize,
    pub(super) row: usize,
    pub(super) reaction: usize,
    pub(super) law: Law,
    pub(super) name: Text,
    /// Rounding of its rate.
    pub(super) rounding: f64,
}

pub(super) enum Law {
    Contact {
        restitution: f64,
        rebound: Rebound,
    },
    /// Coefficients while sliding and at rest, factors of the reactions in both components of the normal force, tangential restitution of the contact
    /// that presses.
    Friction {
        kinetic: f64,
        fixed: f64,
        normal: [Vec<(usize, f64)>; 2],
        restitution: f64,
    },
    /// No slip at the contact of the same guard.
    Rough,
}

/// What a blow must reach: a contact at least this rate, or no more than this impulse; a friction this rate, if its limit allows.
#[derive(Clone, Copy, Debug)]
pub(super) struct Goal {
    pub rate: f64,
    /// `rate` less the present one.
    pub change: f64,
    pub impulse: f64,
}

/// Components of a normal impulse.
pub(super) type Pressure = [f64; 2];

/// Units, their coupling and their rates.
pub(super) struct Strike {
    pub(super) units: Vec<Unit>,
    /// G, row by row.
    pub(super) coupling: Vec<f64>,
    /// Normal impulse of each friction by the impulse of each unit; zero rows for contacts.
    pub(super) pressure: Vec<Pressure>,
    /// dq' by unit.
    pub(super) responses: Vec<Vec<f64>>,
    pub(super) rates: Vec<f64>,
    /// Rounding of each rate, by the terms that have met in it.
    pub(super) noise: Vec<f64>,
    pub(super) impulses: Vec<f64>,
    /// Rate of each unit at the start of the instant, with the largest change it has had.
    pub(super) sizes: Vec<f64>,
    /// Normal impulse of each friction that the jump of prescribed velocities gives by itself; spent with the first blow.
    pub(super) carried: Vec<Pressure>,
    /// Impulses after each blow.
    pub(super) blows: Vec<Vec<f64>>,
    pub(super) phased: bool,
    /// Work of all impulses so far.
    pub(super) work: BlowWork,
}

pub(super) fn pressure(unit: &Unit, reactions: &[f64]) -> Pressure {
    match &unit.law {
        Law::Contact { .. } | Law::Rough => [0.0; 2],
        Law::Friction { normal, .. } => normal.each_ref().map(|terms| terms.iter().map(|(k, factor)| factor * reactions[*k]).sum()),
    }
}

impl Strike {
    pub(super) fn is_contact(&self, i: usize) -> bool {
        matches!(self.units[i].law, Law::Contact { .. })
    }

    /// The sign of the work that a positive impulse does on a positive rate: that of a contact drives, that of a friction resists, also where its rate is prescribed and no impulse changes it.
    fn side(&self, i: usize) -> f64 {
        match self.units[i].law {
            Law::Contact { .. } => 1.0,
            Law::Friction { .. } => -1.0,
            Law::Rough => self.coupling[i * self.units.len() + i].signum(),
        }
    }

    fn contacts(&self) -> Vec<usize> {
        (0..self.units.len()).filter(|&i| self.is_contact(i)).collect()
    }

    pub(super) fn follow(&mut self, law: Impacts, t: f64) -> Result<(), Fault> {
        let contacts = self.contacts();
        let scale = contacts.iter().fold(0.0_f64, |m, &i| m.max(self.rates[i].abs()));
        self.sizes.clone_from(&self.rates.iter().map(|u| u.abs()).collect());
        self.rub(t)?;
        for _ in 0..MOST {
            let worst = contacts.iter().fold(0.0_f64, |m, &i| m.min(self.rates[i]));
            if worst >= -SILENT * scale {
                if !self.roll_on(t)? {
                    return Ok(());
                }
                self.tell();
                continue;
            }
            let most = |i: usize| match law {
                Impacts::InSequence => (1.0 - TIE) * worst,
                Impacts::Together => self.noise[i].max(SILENT * scale),
            };
            let taking: Vec<usize> = contacts.iter().copied().filter(|&i| self.rates[i] <= most(i)).collect();
            self.strike(&taking, t)?;
            self.tell();
        }
        Err(Fault::endless_impacts(t))
    }

    /// Frictions that a jump of prescribed velocities presses, before anything strikes: what carries a machine gives them its impulse.
    fn rub(&mut self, t: f64) -> Result<(), Fault> {
        let count = self.units.len();
        let size = |p: &Pressure| algebra::elementary::hypot(p[0], p[1]);
        let largest = self.carried.iter().map(size).fold(0.0, f64::max);
        let mut set: Vec<usize> = (0..count).filter(|&i| size(&self.carried[i]) > RATE * largest).collect();
        while let Some(i) = (0..count).find(|&i| !set.contains(&i) && set.iter().any(|&j| self.pressure[i * count + j] != [0.0; 2])) {
            set.push(i);
        }
        if set.is_empty() {
            return Ok(());
        }
        let goal: Vec<Goal> = set.iter().map(|&i| self.by_newton(i)).collect();
        let Some(impulses) = self.solve(&set, &goal) else { return Err(Fault::undetermined_impact(t)) };
        self.reach((&set, &goal), &impulses);
        self.carried.fill([0.0; 2]);
        self.tell();
        Ok(())
    }

    fn tell(&mut self) {
        if self.blows.len() < TOLD {
            self.blows.push(self.impulses.clone());
        }
    }

    /// One blow at these contacts, with what slides or is rough there.
    fn strike(&mut self, taking: &[usize], t: f64) -> Result<(), Fault> {
        let set = self.set(taking);
        let before = [self.rates.clone(), self.impulses.clone()];
        let by_phases = taking.iter().any(|&i| matches!(self.units[i].law, Law::Contact { rebound: Rebound::Poisson, .. }));
        self.phased |= by_phases;
        if by_phases {
            self.strike_by_phases(taking, &set, t)?;
        } else {
            let goal: Vec<Goal> = set.iter().map(|&i| self.by_newton(i)).collect();
            let Some(impulses) = self.solve(&set, &goal) else { return Err(Fault::undetermined_impact(t)) };
            self.reach((&set, &goal), &impulses);
        }
        self.refuse_gain(taking, &set, &before)
    }

    /// Refuses a blow that gives energy. What it is compared with are the terms of its work.
    fn refuse_gain(&self, taking: &[usize], set: &[usize], [rates, impulses]: &[Vec<f64>; 2]) -> Result<(), Fault> {
        let (mut gain, mut size) = (0.0, 0.0);
        for &i in set {
            let given = self.impulses[i] - impulses[i];
            gain += 0.5 * self.side(i) * given * (rates[i] + self.rates[i]);
            size += 0.5 * given.abs() * (GAIN * (rates[i].abs() + self.rates[i].abs()) + 2.0 * self.units[i].rounding);
        }
        if gain <= size {
            return Ok(());
        }
        let rubs = set.iter().any(|&i| matches!(self.units[i].law, Law::Friction { .. }) && self.impulses[i] != impulses[i]);
        let phases = |i: usize| matches!(self.units[i].law, Law::Contact { rebound: Rebound::Poisson, .. });
        let cause = match taking {
            _ if taking.iter().all(|&i| phases(i)) => Gaining::Otherwise,
            [_] if !rubs => Gaining::Otherwise,
            _ if rubs => Gaining::Friction,
            _ => Gaining::Several,
        };
        let names: Vec<&Text> = taking.iter().map(|&i| &self.units[i].name).collect();
        Err(Fault::energetic_impact(&names, gain, cause))
    }

    /// What is rough at contacts that stay closed stops slipping, once no contact closes any more; whether something did slip.
    fn roll_on(&mut self, t: f64) -> Result<bool, Fault> {
        let still = |i: usize| self.rates[i].abs() <= SILENT * self.sizes[i];
        let contact = |guard: usize| (0..self.units.len()).find(|&i| self.is_contact(i) && self.units[i].guard == guard);
        let slips = |i: &usize| matches!(self.units[*i].law, Law::Rough) && contact(self.units[*i].guard).is_some_and(still);
        let rough: Vec<usize> = (0..self.units.len()).filter(slips).collect();
        if rough.iter().all(|&i| still(i)) {
            return Ok(false);
        }
        let closed: Vec<usize> = self.contacts().into_iter().filter(|&i| still(i)).collect();
        let others = self.set(&closed).into_iter().filter(|i| !rough.contains(i)).collect::<Vec<_>>();
        let set: Vec<usize> = others.into_iter().chain(rough).collect();
        let goal: Vec<Goal> = set.iter().map(|&i| Goal { rate: 0.0, change: -self.rates[i], impulse: 0.0 }).collect();
        let Some(impulses) = self.solve(&set, &goal) else { return Err(Fault::undetermined_impact(t)) };
        self.reach((&set, &goal), &impulses);
        Ok(true)
    }

    /// Units of a blow: the contacts, frictions that they press, what is rough at them.
    fn set(&self, taking: &[usize]) -> Vec<usize> {
        let count = self.units.len();
        let presses = |i: usize| taking.iter().any(|&j| self.pressure[i * count + j] != [0.0; 2]);
        let struck = |guard: usize| taking.iter().any(|&j| self.units[j].guard == guard);
        let others = (0..count).filter(|&i| match self.units[i].law {
            Law::Contact { .. } => false,
            Law::Friction { .. } => presses(i),
            Law::Rough => struck(self.units[i].guard),
        });
        taking.iter().copied().chain(others).collect()
    }

    /// What Newton's law asks of a unit.
    fn by_newton(&self, i: usize) -> Goal {
        let restitution = match self.units[i].law {
            Law::Contact { restitution, .. } | Law::Friction { restitution, .. } => restitution,
            Law::Rough => 0.0,
        };
        // 0 - 0 is +0
        Goal { rate: 0.0 - restitution * self.rates[i], change: -(1.0 + restitution) * self.rates[i], impulse: 0.0 }
    }

    /// Adds impulses of a set. What has reached its goal within rounding has reached it.
    pub(super) fn reach(&mut self, (set, goal): (&[usize], &[Goal]), impulses: &[f64]) {
        let before = self.rates.clone();
        self.take(set, impulses);
        for (&i, goal) in set.iter().zip(goal) {
            if (self.rates[i] - goal.rate).abs() <= self.noise[i] {
                self.rates[i] = goal.rate;
            }
        }
        self.book((set, impulses), &before);
    }

    /// Books the work of impulses that took the rates from those before to the present ones.
    pub(super) fn book(&mut self, (set, impulses): (&[usize], &[f64]), before: &[f64]) {
        for (&i, p) in set.iter().zip(impulses) {
            let (was, is) = (before[i], self.rates[i]);
            self.work.done += 0.5 * self.side(i) * p * (was + is);
            self.work.met += 0.5 * p.abs() * (was.abs() + is.abs());
            self.work.rounding += p.abs() * self.noise[i];
        }
    }

    /// Adds impulses of a set.
    pub(super) fn take(&mut self, set: &[usize], impulses: &[f64]) {
        let count = self.units.len();
        for (i, rate) in self.rates.iter_mut().enumerate() {
            let terms = || set.iter().zip(impulses).map(|(&j, p)| self.coupling[i * count + j] * p);
            let change: f64 = terms().sum();
            self.sizes[i] = self.sizes[i].max(change.abs());
            self.noise[i] = self.noise[i].max(RATE * terms().map(f64::abs).sum::<f64>());
            *rate += change;
        }
        set.iter().zip(impulses).for_each(|(&j, p)| self.impulses[j] += p);
    }

    /// Rates q' by these impulses from the rates at the start.
    pub(super) fn move_on(&self, impulses: &[f64], start: &[f64], rates: &mut [f64]) {
        for (i, rate) in rates.iter_mut().enumerate() {
            let change: f64 = self.responses.iter().zip(impulses).map(|(r, p)| r[i] * p).sum();
            *rate = start[i] + change;
        }
    }

    /// The blows one by one, from the rates at the start, with the impulses of all reactions by that of each unit; none where there is one alone.
    pub(super) fn blows_from(&self, start: &[f64], reactions: &[Vec<f64>]) -> Vec<SingleBlow> {
        if self.blows.len() < 2 {
            return Vec::new();
        }
        let mut told = Vec::with_capacity(self.blows.len());
        let mut before = vec![0.0; self.units.len()];
        for impulses in &self.blows {
            let own: Vec<f64> = impulses.iter().zip(&before).map(|(p, b)| p - b).collect();
            let mut rates = start.to_vec();
            self.move_on(impulses, start, &mut rates);
            let whole = (0..reactions[0].len()).map(|r| reactions.iter().zip(&own).map(|(row, p)| row[r] * p).sum()).collect();
            told.push(SingleBlow { rates, reactions: whole });
            before.clone_from(impulses);
        }
        told
    }

    pub(super) fn blow(&self, before: &[f64]) -> Blow {
        let units = || self.units.iter().enumerate().filter(|(_, unit)| !matches!(unit.law, Law::Rough));
        // a rate that the law makes zero is solved to thirteen digits
        let stops = |i: usize| self.impulses[i] != 0.0 && self.rates[i].abs() <= 1e-12 * self.sizes[i];
        Blow {
            rates: units().map(|(i, unit)| (unit.guard, [before[i], self.rates[i]])).collect(),
            impulses: units().map(|(i, unit)| (unit.guard, self.impulses[i])).filter(|(_, p)| *p != 0.0).collect(),
            stuck: units().filter(|(i, _)| !self.is_contact(*i) && stops(*i)).map(|(_, unit)| unit.guard).collect(),
            phased: self.phased,
            silent: units().filter(|(i, _)| self.is_silent(*i, before[*i])).map(|(_, unit)| unit.guard).collect(),
            work: Some(self.work),
            ..Blow::default()
        }
    }

    /// Whether what happened to a unit is rounding: of the rates that meet in its own, and of the largest impulse of the instant. In the metric of the kinetic
    /// energy an impulse has the size Λ √G, and what it changes at a unit with G_ii is at most √G_ii times that.
    fn is_silent(&self, i: usize, before: f64) -> bool {
        let count = self.units.len();
        let own = |j: usize| self.coupling[j * count + j].abs();
        let largest = (0..count).fold(0.0_f64, |m, j| m.max(self.impulses[j].abs() * own(j).sqrt()));
        let rounding = self.units[i].rounding.max(RATE * own(i).sqrt() * largest);
        before.abs().max(self.rates[i].abs()).max(self.impulses[i].abs() * own(i)) <= rounding
    }
}
