//! What studies may see of a machine: each question of a [`System`] put to the program, in the modes asked for.

use std::sync::Arc;

use program::{ABREAST, Acting, Behind, Operation, Point, Tangent, passes};
use symbolic::connections::Law;
use words::Text;

use super::conditions::Conditions;
use super::meaning::{Refusal, reads_accelerations};
use super::switches::Switches;
use super::{Machine, touching};
use crate::system::{Bends, Corners, Layout, Motions};
use crate::{Blow, Fault, Guard, Mode, Powers, Quantity, Since, Supply, System, Tie, Touch};

impl System for Machine {
    fn states(&self) -> &[Quantity] {
        &self.states
    }
    fn n_coordinates(&self) -> usize {
        self.bound.program().coordinates
    }
    fn turns_freely(&self, i: usize) -> bool {
        self.turning.get(i) == Some(&true)
    }
    fn guards(&self) -> &[Guard] {
        &self.guards
    }
    fn outputs(&self) -> &[Quantity] {
        &self.outputs
    }

    fn state_of(&self, output: usize) -> Option<usize> {
        let tape = &self.bound.program().outputs;
        let root = tape.roots.get(output)?.register;
        let made = tape.instructions().find(|instruction| instruction.into == root)?;
        if let Operation::State(slot) = made.operation { Some(slot as usize) } else { None }
    }

    fn expand(&mut self, t: f64, x: &[f64], modes: &[Mode], order: usize) -> Result<(), Fault> {
        self.expanded.set(modes, &self.bound);
        let expanded = self.jets.expand(t, x, &self.expanded.modes, order);
        expanded.map_err(|fault| self.told(fault, x))
    }

    fn extend(&mut self, t: f64, x: &[f64], modes: &[Mode], order: usize) -> Result<(), Fault> {
        self.expanded.set(modes, &self.bound);
        let extended = self.jets.extend(t, x, &self.expanded.modes, order);
        extended.map_err(|fault| self.told(fault, x))
    }

    fn faithful(&mut self, h: f64, tolerance: f64) -> f64 {
        self.jets.faithful(h, tolerance)
    }

    fn holds_powers(&self) -> bool {
        self.jets.holds_powers()
    }

    fn rates(&mut self, t: f64, x: &[f64], modes: &[Mode], rates: &mut [f64]) -> bool {
        self.observing.set(modes, &self.bound);
        match self.bound.rates(t, x, &self.observing.modes) {
            Ok(values) if values.len() >= rates.len() => rates.copy_from_slice(&values[..rates.len()]),
            _ => return false,
        }
        true
    }

    fn state(&self, i: usize) -> &[f64] {
        self.jets.state(i)
    }

    fn guard(&self, i: usize) -> &[f64] {
        if self.expanded.active.get(i) == Some(&true) { self.jets.guard(i) } else { &[] }
    }

    fn slopes(&mut self, t: f64, x: &[f64], modes: &[Mode], rows: &mut Vec<f64>) -> Result<bool, Fault> {
        self.observing.set(modes, &self.bound);
        let tangent = self.tangent.get_or_insert_with(|| Box::new(Tangent::new(&self.bound)));
        let Switches { modes, active, .. } = &self.observing;
        let point = Point { time: t, states: x, modes: Some(modes), active: Some(active), ..Point::default() };
        rows.clear();
        match tangent.evaluate(&point) {
            Ok(slopes) => rows.extend_from_slice(slopes),
            Err(fault) => rows.extend_from_slice(&self.slopes_beside(t, x).ok_or(fault)?),
        }
        let active = &self.observing.active;
        let width = x.len() + 1;
        for (i, _) in active.iter().enumerate().filter(|(_, active)| !**active) {
            rows[(x.len() + i) * width..(x.len() + i + 1) * width].fill(0.0);
        }
        Ok(true)
    }

    fn observe(&mut self, t: f64, x: &[f64], modes: &[Mode], values: &mut [f64]) -> Result<(), Fault> {
        self.observing.set(modes, &self.bound);
        let open = match &self.imposed {
            Some(own) => {
                self.accelerations[..own.len()].copy_from_slice(own);
                None
            }
            None if self.needs_accelerations => self.solve_shared(t, x)?,
            None => None,
        };
        let Switches { modes, active, .. } = &self.observing;
        let point = Point { time: t, states: x, accelerations: &self.accelerations, modes: Some(modes), active: Some(active) };
        for (value, &i) in self.observed.evaluate(&point)?.iter().zip(&self.shown) {
            values[i] = *value;
        }
        open.map_or(Ok(()), |open| self.leave_open((t, x), &open, values))
    }

    fn is_shared(&self, output: usize) -> Option<&[usize]> {
        self.sharing.seen.get(&output).map(|guards| &guards[..])
    }

    fn moves_otherwise(&mut self, t: f64, x: &[f64], modes: &[Mode]) -> bool {
        self.observing.set(modes, &self.bound);
        self.imposed.is_none() && self.shares_move(t, x).unwrap_or(false)
    }

    fn show(&mut self, wanted: &[usize]) -> Result<(), Fault> {
        if self.shown == wanted {
            return Ok(());
        }
        let outputs = Arc::new(passes::select(&self.bound.program().outputs, wanted));
        let outputs = Arc::new(passes::specialise(&outputs, self.bound.parameters())?);
        self.observed = self.bound.evaluator(&outputs)?;
        self.needs_accelerations = reads_accelerations(&outputs);
        self.shown = wanted.to_vec();
        self.behind = None;
        Ok(())
    }

    fn impose(&mut self, accelerations: Option<&[f64]>) {
        if self.imposed.is_some() != accelerations.is_some() {
            self.behind = None;
        }
        self.imposed = accelerations.map(<[f64]>::to_vec);
    }

    fn behind(&mut self) -> Arc<Behind> {
        let [_, _, whole] = self.operations();
        whole
    }

    fn sample(&mut self, t: f64, x: &[f64], modes: &[Mode], row: &mut Vec<f64>) -> Result<(), Fault> {
        row.clear();
        row.resize(self.outputs.len(), 0.0);
        self.observe(t, x, modes, row)?;
        let [forces, outputs, _] = self.operations();
        let Switches { modes, active, .. } = &self.observing;
        let point = Point { time: t, states: x, accelerations: &self.accelerations, modes: Some(modes), active: Some(active) };
        forces.record(&self.forces, &point, row);
        outputs.record(&self.observed, &point, row);
        Ok(())
    }

    fn rounding(&mut self, (t, x): (f64, &[f64]), modes: &[Mode], errors: &[f64], row: &mut Vec<f64>) {
        row.clear();
        let mut values = vec![0.0; self.outputs.len()];
        if self.observe(t, x, modes, &mut values).is_err() {
            return;
        }
        let [forces, outputs, _] = self.operations();
        row.resize(self.outputs.len(), 0.0);
        let mut given = Vec::new();
        if self.needs_accelerations {
            let roots = forces.rounding(&self.forces, errors, &[], row);
            self.bound.program().spread(&roots, &mut given);
        }
        let found = outputs.rounding(&self.observed, errors, &given, row);
        for (error, &i) in found.iter().zip(&self.shown) {
            row[i] = *error;
        }
    }

    fn acting(&mut self, modes: &[Mode]) -> Option<Arc<Behind>> {
        self.observing.set(modes, &self.bound);
        let modes = &self.observing.modes;
        if !self.acting.as_ref().is_some_and(|acting| acting.is_of(modes)) {
            self.acting = Some(Box::new(Acting::new(&self.bound, modes)));
        }
        self.acting.as_ref().map(|acting| Arc::clone(acting.behind()))
    }

    fn act(&mut self, t: f64, x: &[f64], modes: &[Mode], row: &mut Vec<f64>) -> Result<(), Fault> {
        self.observing.set(modes, &self.bound);
        row.clear();
        let Switches { modes, active, .. } = &self.observing;
        let point = Point { time: t, states: x, modes: Some(modes), active: Some(active), ..Point::default() };
        self.acting.as_mut().map_or(Ok(()), |acting| Ok(acting.record(&point, row)?))
    }

    fn act_rounding(&mut self, errors: &[f64], row: &mut Vec<f64>) {
        row.clear();
        self.acting.iter().for_each(|acting| acting.rounding(errors, row));
    }

    fn refusal(&self, output: usize) -> Option<Fault> {
        let Refusal { reaction, open } = self.refused[output].as_ref()?;
        let output = &self.outputs[output].name;
        Some(match open {
            Some(open) if matches!(open.law, Law::Transmission) => {
                Fault::reaction_without_transmission(output, reaction, (&open.name, &open.label))
            }
            Some(open) if matches!(open.law, Law::Tension) => Fault::reaction_without_tension(output, reaction, (&open.name, &open.label)),
            Some(open) => Fault::reaction_without_place(output, reaction, &open.name),
            None => Fault::open_reaction(output, reaction),
        })
    }

    fn notes(&self) -> &[Text] {
        &self.notes
    }

    fn modes_by_value(&mut self, t: f64, x: &[f64]) -> Option<Vec<Mode>> {
        let modes = self.bound.modes(t, x).ok()?;
        Some(modes)
    }

    fn sides(&mut self, t: f64, x: &[f64]) -> Option<Vec<Mode>> {
        self.modes_by_value(t, x)
    }

    fn powers(&mut self, t: f64, x: &[f64], accelerations: &[f64], modes: &[Mode]) -> Option<Powers> {
        self.observing.set(modes, &self.bound);
        self.take_accelerations(t, x, accelerations).ok()?;
        let Switches { modes, active, .. } = &self.observing;
        let point = Point { time: t, states: x, accelerations: &self.accelerations, modes: Some(modes), active: Some(active) };
        // the order is that of program::ENERGY
        let [_, _, _, dissipated, rate, loads, drives, through, ..] = *self.energy.evaluate(&point).ok()? else { return None };
        Some(Powers { rate, loads, drives, dissipated, through })
    }

    fn placed(&mut self, t: f64, x: &[f64]) -> Result<(), Fault> {
        if !self.places.tape().roots.is_empty() {
            self.places.evaluate(&Point { time: t, states: x, accelerations: &self.accelerations, ..Point::default() })?;
        }
        Ok(())
    }

    fn second(&mut self, (t, x): (f64, &[f64]), accelerations: &[f64], modes: &[Mode], residuals: &mut [f64]) -> bool {
        self.observing.set(modes, &self.bound);
        if self.take_accelerations(t, x, accelerations).is_err() {
            return false;
        }
        let point = Point { time: t, states: x, accelerations: &self.accelerations, ..Point::default() };
        let Ok(values) = self.second.evaluate(&point) else { return false };
        if residuals.is_empty() || values.len() < residuals.len() {
            return false;
        }
        residuals.copy_from_slice(&values[..residuals.len()]);
        true
    }

    fn supply(&mut self, t: f64, x: &[f64], accelerations: &[f64], modes: &[Mode]) -> Option<Supply> {
        self.supply_with(t, x, accelerations, modes)
    }

    fn supplies(&mut self, motions: &Motions, modes: &[Mode], into: &mut [Supply; ABREAST]) -> bool {
        self.supplies_with(motions, modes, into)
    }

    fn energy_rate(&mut self, t: f64, x: &[f64], accelerations: &[f64], modes: &[Mode]) -> Option<f64> {
        self.rate_with(t, x, accelerations, modes)
    }

    fn energies(&mut self, t: f64, x: &[f64], modes: &[Mode]) -> Option<[f64; 2]> {
        self.levels(t, x, modes)
    }

    fn n_frictions(&self) -> usize {
        self.rubbing.len()
    }

    fn frictions(&mut self, t: f64, x: &[f64], modes: &[Mode]) -> Option<Vec<Option<f64>>> {
        self.rubbed(t, x, modes)
    }

    fn touches(&mut self, t: f64, x: &[f64], accelerations: &[f64], modes: &[Mode]) -> Option<Vec<Touch>> {
        if self.touching.is_empty() {
            return None;
        }
        self.observing.set(modes, &self.bound);
        self.look_up_forces(t, x).ok()?;
        let n = self.bound.program().coordinates;
        let mut inputs = std::mem::take(&mut self.accelerations);
        inputs[..n].copy_from_slice(&accelerations[..n]);
        let found = self.touches_with((t, x), &inputs, &[]);
        self.accelerations = inputs;
        found
    }

    fn struck(&mut self, t: f64, x: &[f64], impulses: &[f64], modes: &[Mode]) -> Option<Vec<Touch>> {
        self.observing.set(modes, &self.bound);
        let mut inputs = vec![0.0; self.accelerations.len()];
        let idle = self.normals((t, x), &inputs)?;
        let n = self.bound.program().coordinates;
        let reactions = &mut inputs[n..];
        reactions.copy_from_slice(impulses.get(..reactions.len())?);
        self.touches_with((t, x), &inputs, &idle)
    }

    fn impulse_powers(&mut self, t: f64, x: &[f64], modes: &[Mode], impulses: &[f64]) -> Option<Vec<f64>> {
        self.powers_of(t, x, modes, impulses)
    }

    fn open_impulses(&mut self, t: f64, x: &[f64], modes: &[Mode], blow: &Blow) -> Result<Vec<Vec<f64>>, Fault> {
        self.open_under(t, x, modes, blow)
    }

    fn momenta(&mut self, t: f64, x: &[f64], jump: [&[f64]; 2], modes: &[Mode]) -> Option<Vec<[f64; 2]>> {
        if self.balanced.is_empty() {
            return None;
        }
        self.observing.set(modes, &self.bound);
        let Switches { modes, active, .. } = &self.observing;
        let inputs = jump.concat();
        let point = Point { time: t, states: x, accelerations: &inputs, modes: Some(modes), active: Some(active) };
        touching::linear(&mut self.second, &point, jump[0].len())
    }

    fn balances(&mut self, t: f64, x: &[f64], accelerations: &[f64], modes: &[Mode]) -> Option<Vec<[f64; 2]>> {
        let rows = self.balanced.clone();
        if rows.is_empty() {
            return None;
        }
        self.observing.set(modes, &self.bound);
        self.take_accelerations(t, x, accelerations).ok()?;
        let inputs = self.accelerations.clone();
        let mut residual = |inputs: &[f64]| -> Option<Vec<f64>> {
            let values = self.second.evaluate(&Point { time: t, states: x, accelerations: inputs, ..Point::default() }).ok()?;
            rows.iter().map(|&i| values.get(i).copied()).collect()
        };
        // linear in accelerations and reactions: each term by its own
        let whole = residual(&inputs)?;
        let mut trial = vec![0.0; inputs.len()];
        let constant = residual(&trial)?;
        let mut out: Vec<[f64; 2]> = whole.iter().zip(&constant).map(|(r, c)| [*r, c.abs()]).collect();
        for (k, input) in inputs.iter().enumerate().filter(|(_, input)| **input != 0.0) {
            trial[k] = *input;
            let term = residual(&trial)?;
            trial[k] = 0.0;
            out.iter_mut().zip(&term).zip(&constant).for_each(|((row, t), c)| row[1] += (t - c).abs());
        }
        Some(out)
    }

    fn released(&mut self, t: f64, x: &[f64], accelerations: &[f64], modes: &[Mode]) -> Option<Vec<f64>> {
        if self.layout.wrenches + self.layout.along == 0 {
            return None;
        }
        self.observing.set(modes, &self.bound);
        self.take_accelerations(t, x, accelerations).ok()?;
        let point = Point { time: t, states: x, accelerations: &self.accelerations, ..Point::default() };
        Some(self.released.evaluate(&point).ok()?.to_vec())
    }

    fn placements(&mut self, t: f64, x: &[f64]) -> Option<Vec<f64>> {
        let point = Point { time: t, states: x, accelerations: &self.accelerations, ..Point::default() };
        Some(self.placements.evaluate(&point).ok()?.to_vec())
    }

    fn placements_at(&mut self, points: &[(f64, Vec<f64>)]) -> Option<Vec<Vec<f64>>> {
        self.placements_abreast(points).or_else(|| points.iter().map(|(t, x)| self.placements(*t, x)).collect())
    }

    fn layout(&self) -> Layout {
        self.layout.clone()
    }

    fn project(&mut self, t: f64, x: &mut [f64], modes: &[Mode]) -> Result<f64, Fault> {
        self.conditions.as_mut().map_or(Ok(0.0), |conditions| conditions.project(t, x, (modes, &self.bound)))
    }

    fn rejoin(&mut self, t: f64, x: &mut [f64], modes: &[Mode], from: Since<'_>) -> Result<f64, Fault> {
        self.conditions.as_mut().map_or(Ok(0.0), |conditions| conditions.rejoin((t, x), (modes, &self.bound), from))
    }

    fn kept(&mut self, t: f64, x: &[f64], modes: &[Mode], from: Since<'_>) -> Result<Vec<f64>, Fault> {
        self.conditions.as_mut().map_or_else(|| Ok(Vec::new()), |conditions| conditions.kept_at((t, x), (modes, &self.bound), from))
    }

    fn margin(&mut self, t: f64, x: &[f64]) -> Option<f64> {
        self.conditions.as_mut()?.margin(t, x)
    }

    fn reaches(&mut self, t: f64, x: &[f64]) -> Vec<(usize, [f64; 2])> {
        self.conditions.as_mut().and_then(|conditions| conditions.reaches(t, x)).unwrap_or_default()
    }

    fn polish(&mut self, t: f64, x: &mut [f64], modes: &[Mode]) -> Result<(), Fault> {
        match &mut self.conditions {
            Some(conditions) => conditions.polish(t, x, (modes, &self.bound)),
            None => Ok(()),
        }
    }

    fn is_tied(&self) -> bool {
        self.conditions.is_some()
    }

    fn margins(&self) -> usize {
        self.conditions.as_ref().map_or(0, Conditions::margins)
    }

    fn drifts(&self) -> &[[f64; 2]] {
        self.conditions.as_ref().map_or(&[], Conditions::drifts)
    }

    fn repeats(&mut self, t: f64, x: &[f64], modes: &[Mode]) -> Result<usize, Fault> {
        self.conditions.as_mut().map_or(Ok(0), |conditions| conditions.repeats(t, x, (modes, &self.bound)))
    }

    fn shares(&mut self, t: f64, x: &[f64], modes: &[Mode], relieved: &[usize]) -> Option<Corners> {
        self.shares_of_load((t, x), modes, relieved)
    }

    fn likely(&mut self, t: f64, x: &[f64], modes: &[Mode]) -> Option<Vec<(usize, Mode)>> {
        self.likely_modes((t, x), modes)
    }

    fn impact(&mut self, t: f64, x: &mut [f64], modes: &[Mode], closing: &[usize]) -> Result<Blow, Fault> {
        let Some(conditions) = &mut self.conditions else { return Ok(Blow::default()) };
        let n = self.bound.program().coordinates;
        let rates = x[n..2 * n].to_vec();
        let mut blow = conditions.impact((t, x), (modes, &self.bound), closing)?;
        let jump: Vec<f64> = rates.iter().zip(&x[n..2 * n]).map(|(before, after)| after - before).collect();
        self.hold([t, t], x, &jump, &mut blow);
        Ok(blow)
    }

    fn impulses(&self) -> &[Quantity] {
        &self.impulses
    }

    fn bend(&mut self, t: f64, x: &[f64], modes: [&[Mode]; 2]) -> Result<Bends, Fault> {
        if self.is_bent { self.pass_bend((t, x), modes) } else { Ok(Bends::default()) }
    }

    fn jolt(&mut self, t: f64, x: &mut [f64], modes: [&[Mode]; 2], closing: &[usize]) -> Result<Option<Blow>, Fault> {
        if self.bound.program().steps { self.jump(t, x, modes, closing) } else { Ok(None) }
    }

    fn ties(&mut self, t: f64, x: &[f64], modes: &[Mode]) -> Vec<(usize, Tie)> {
        self.rounding_of_contacts(t, x, modes).unwrap_or_default()
    }

    fn rounding_of_gaps(&mut self, t: f64, x: &[f64]) -> Vec<(usize, f64)> {
        self.conditions.as_mut().map_or_else(Vec::new, |conditions| conditions.rounding_of_gaps(t, x))
    }

    fn rounding_of_accelerations(&mut self, t: f64, x: &[f64], modes: &[Mode]) -> Vec<f64> {
        self.accelerations_by_rounding(t, x, modes).unwrap_or_default()
    }

    fn statics(&mut self, x: &[f64], forces: &mut [f64], derivatives: &mut [f64]) -> Result<(), Fault> {
        let values = self.statics.evaluate(&Point { states: x, ..Point::default() })?;
        let (h, jacobian) = values.split_at(forces.len());
        forces.copy_from_slice(h);
        derivatives.copy_from_slice(&jacobian[..derivatives.len()]);
        Ok(())
    }
}
