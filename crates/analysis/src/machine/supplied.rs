//! Energies, their rate and what supplies it, part by part.

use program::{ABREAST, Abreast, Lanes, Places, Point};

use super::Machine;
use super::flows::{part, reaction, roots};
use super::switches::Switches;
use crate::Mode;
use crate::system::{Motions, Supply};

impl Machine {
    /// See [`crate::System::supply`].
    pub(super) fn supply_with(&mut self, t: f64, x: &[f64], accelerations: &[f64], modes: &[Mode]) -> Option<Supply> {
        self.observing.set(modes, &self.bound);
        if self.reads_nothing(modes) {
            let n = self.bound.program().coordinates;
            self.accelerations[..n].copy_from_slice(&accelerations[..n]);
            self.accelerations[n..].fill(0.0);
        } else {
            self.take_accelerations(t, x, accelerations).ok()?;
        }
        let Switches { modes, active, .. } = &self.observing;
        let point = Point { time: t, states: x, accelerations: &self.accelerations, modes: Some(modes), active: Some(active) };
        let [loads, drives, dissipated] = *self.flows.supply.evaluate(&point).ok()? else { return None };
        Some(Supply { loads, drives, dissipated })
    }

    /// Whether the supply reads no reactions, or only those of open contacts, which are nothing.
    fn reads_nothing(&self, modes: &[Mode]) -> bool {
        self.flows.reads.iter().all(|guard| guard.is_some_and(|g| modes.get(g) == Some(&Mode::Positive)))
    }

    /// See [`crate::System::supplies`].
    pub(super) fn supplies_with(&mut self, motions: &Motions, modes: &[Mode], into: &mut [Supply; ABREAST]) -> bool {
        self.observing.set(modes, &self.bound);
        if self.flows.supplies.is_none() || !self.reads_nothing(modes) {
            return false;
        }
        let n = self.bound.program().coordinates;
        self.abreast.clear();
        self.abreast.extend_from_slice(&motions.rates[n..2 * n]);
        self.abreast.resize(self.accelerations.len(), [0.0; ABREAST]);
        let Switches { modes, active, .. } = &self.observing;
        let Motions { count, times, x, .. } = motions;
        let places = Places { count: *count, times, states: x, accelerations: &self.abreast, modes, active };
        let Some(supplies) = self.flows.supplies.as_mut().filter(|_| *count <= ABREAST) else { return false };
        if !supplies.evaluate(&places) {
            return false;
        }
        let [loads, drives, dissipated] = [0, 1, 2].map(|i| *supplies.root(i));
        // as after the last of them by itself
        let last = count.saturating_sub(1);
        self.accelerations.iter_mut().zip(&self.abreast).for_each(|(a, lanes)| *a = lanes[last]);
        for (lane, supply) in into.iter_mut().enumerate() {
            *supply = Supply { loads: loads[lane], drives: drives[lane], dissipated: dissipated[lane] };
        }
        true
    }

    /// See [`crate::System::placements_at`]; none where they have to be asked for one by one.
    pub(super) fn placements_abreast(&mut self, points: &[(f64, Vec<f64>)]) -> Option<Vec<Vec<f64>>> {
        let known = self.placed.get_or_insert_with(|| Abreast::new(&self.placements));
        let shape = &self.placements.tape().shape;
        let (placed, roots) = (known.as_mut()?, self.placements.tape().roots.len());
        let accelerations: Vec<Lanes> = self.accelerations.iter().map(|a| [*a; ABREAST]).collect();
        // no mode holds: all switches are decided by value
        let (modes, active) = (vec![Mode::Positive; shape.modes], vec![false; shape.modes]);
        let mut rows = Vec::with_capacity(points.len());
        let mut states = vec![[0.0; ABREAST]; shape.states];
        for group in points.chunks(ABREAST) {
            let last = group.len() - 1;
            let times = std::array::from_fn(|lane| group[lane.min(last)].0);
            for (i, lanes) in states.iter_mut().enumerate() {
                *lanes = std::array::from_fn(|lane| group[lane.min(last)].1.get(i).copied().unwrap_or(f64::NAN));
            }
            let places = Places {
                count: group.len(),
                times: &times,
                states: &states,
                accelerations: &accelerations,
                modes: &modes,
                active: &active,
            };
            if !placed.evaluate(&places) {
                return None;
            }
            rows.extend((0..group.len()).map(|lane| (0..roots).map(|i| placed.root(i)[lane]).collect()));
        }
        Some(rows)
    }

    /// See [`crate::System::energy_rate`].
    pub(super) fn rate_with(&mut self, t: f64, x: &[f64], accelerations: &[f64], modes: &[Mode]) -> Option<f64> {
        self.observing.set(modes, &self.bound);
        if self.flows.rate.is_none() {
            self.flows.rate = part(&self.bound, &roots(&["rate"])).ok();
        }
        let n = self.bound.program().coordinates;
        let reads = self.flows.rate.as_ref()?.tape().body.iter().any(|i| reaction(&i.operation, n).is_some());
        if reads {
            self.take_accelerations(t, x, accelerations).ok()?;
        } else {
            self.accelerations[..n].copy_from_slice(&accelerations[..n]);
            self.accelerations[n..].fill(0.0);
        }
        let Switches { modes, active, .. } = &self.observing;
        let point = Point { time: t, states: x, accelerations: &self.accelerations, modes: Some(modes), active: Some(active) };
        self.flows.rate.as_mut()?.evaluate(&point).ok()?.first().copied()
    }

    /// See [`crate::System::energies`].
    pub(super) fn levels(&mut self, t: f64, x: &[f64], modes: &[Mode]) -> Option<[f64; 2]> {
        self.observing.set(modes, &self.bound);
        // they read no accelerations
        self.accelerations.fill(0.0);
        let Switches { modes, active, .. } = &self.observing;
        let point = Point { time: t, states: x, accelerations: &self.accelerations, modes: Some(modes), active: Some(active) };
        let [kinetic, potential] = *self.flows.levels.evaluate(&point).ok()? else { return None };
        (kinetic.is_finite() && potential.is_finite()).then_some([kinetic, potential])
    }

    /// See [`crate::System::frictions`].
    pub(super) fn rubbed(&mut self, t: f64, x: &[f64], modes: &[Mode]) -> Option<Vec<Option<f64>>> {
        self.observing.set(modes, &self.bound);
        self.look_up_forces(t, x).ok()?;
        self.accelerations.iter_mut().filter(|r| r.is_nan()).for_each(|r| *r = 0.0);
        let Switches { modes: own, active, .. } = &self.observing;
        let point = Point { time: t, states: x, accelerations: &self.accelerations, modes: Some(own), active: Some(active) };
        let powers = self.flows.rubbed.evaluate(&point).ok()?;
        let slides = |guard: &Option<usize>| guard.is_none_or(|g| modes.get(g) != Some(&Mode::Zero));
        Some(self.rubbing.iter().zip(powers).map(|(guard, power)| slides(guard).then_some(*power)).collect())
    }
}
