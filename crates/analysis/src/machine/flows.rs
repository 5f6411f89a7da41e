//! Parts of the tape of energies, each by itself: an audit that asks for one at many points of a step does not pay for the others.

use std::sync::Arc;

use program::{Bound, ENERGY, Evaluator, Operation, Point, passes};
use symbolic::Equations;
use symbolic::connections::Law;

use super::{Machine, Switches};
use crate::system::Supply;
use crate::{Fault, Mode};

/// The parts.
#[derive(Clone, Debug)]
pub(super) struct Flows {
    /// T and Π.
    levels: Evaluator,
    /// Loads, drives, dissipated.
    supply: Evaluator,
    /// For each reaction that the supply reads the guard of its contact; none for any other reaction. Reactions cost a solution of the equations, unless
    /// they are those of open contacts, which are nothing.
    reads: Vec<Option<usize>>,
    /// The power that each dry friction takes.
    rubbed: Evaluator,
    /// dE/dt, made when it is asked for.
    rate: Option<Evaluator>,
}

/// The tape of energies with some of its roots.
fn part(bound: &Bound, roots: &[usize]) -> Result<Evaluator, Fault> {
    let tape = passes::specialise(&Arc::new(passes::select(&bound.program().energy, roots)), bound.parameters())?;
    Ok(bound.evaluator(&Arc::new(tape))?)
}

/// Places of named powers among the roots.
fn roots(names: &[&str]) -> Vec<usize> {
    names.iter().filter_map(|n| ENERGY.iter().position(|e| e == n)).collect()
}

/// The slot of a reaction that an operation reads, among all reactions.
fn reaction(operation: &Operation, coordinates: usize) -> Option<usize> {
    match operation {
        Operation::Acceleration(slot) => (*slot as usize).checked_sub(coordinates),
        _ => None,
    }
}

impl Flows {
    /// *Errors*: P020 when a pass broke a tape.
    pub(super) fn new(equations: &Equations, bound: &Bound) -> Result<Flows, Fault> {
        let supply = part(bound, &roots(&["loads", "drives", "dissipated"]))?;
        let contact = |r: usize| match equations.reactions[r].law {
            Law::Contact { .. } => bound.program().switches[r],
            _ => None,
        };
        let n = bound.program().coordinates;
        let reads = supply.tape().body.iter().filter_map(|i| reaction(&i.operation, n)).map(contact).collect();
        let frictions: Vec<usize> = (ENERGY.len()..bound.program().energy.roots.len()).collect();
        let (levels, rubbed) = (part(bound, &roots(&["kinetic", "potential"]))?, part(bound, &frictions)?);
        Ok(Flows { levels, supply, reads, rubbed, rate: None })
    }
}

impl Machine {
    /// See [`crate::System::supply`].
    pub(super) fn supply_with(&mut self, t: f64, x: &[f64], accelerations: &[f64], modes: &[Mode]) -> Option<Supply> {
        self.observing.set(modes, &self.bound);
        let open = |guard: &Option<usize>| guard.is_some_and(|g| modes.get(g) == Some(&Mode::Positive));
        if self.flows.reads.iter().all(open) {
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
