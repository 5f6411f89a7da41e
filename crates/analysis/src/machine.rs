//! A machine's program as a [`System`].

use std::sync::Arc;

mod bend;
mod bilateral;
mod conditions;
mod flows;
mod hidden;
mod impact;
mod impulses;
mod jolt;
mod known;
mod leap;
mod meaning;
mod open;
mod parts;
mod phases;
mod sharing;
mod solved;
mod strike;
mod supplied;
mod ties;
mod touches;
mod touching;

use program::lower::Selection;
use program::{ABREAST, Acting, Behind, Bound, Evaluator, Jets, Lanes, Operation, Point, Program, RESOLUTION, Tangent, passes};
use symbolic::Equations;
use symbolic::connections::Law;
use words::Text;

use crate::connections::{self, Assembly, assemble_with};
use crate::naming::configuration;
use crate::system::{Layout, Motions};
use crate::{Blow, Fault, Guard, Mode, Powers, Quantity, Supply, System, Tie, Touch};
use conditions::Conditions;
use flows::Flows;
use meaning::{Refusal, impulse, is_tie, kind, layout, outputs, placements, reads_accelerations, refused, rubbing, states};
use solved::Solved;

/// A program with parameters, seen by studies.
#[derive(Clone, Debug)]
pub struct Machine {
    states: Vec<Quantity>,
    /// Which coordinates only turn.
    turning: Vec<bool>,
    outputs: Vec<Quantity>,
    guards: Vec<Guard>,
    /// Specialised for the parameters; [`Machine::new`] keeps the general tapes for what is asked rarely.
    bound: Bound,
    jets: Jets,
    /// Made when slopes are first asked for.
    tangent: Option<Box<Tangent>>,
    /// The dynamics as an implicit step samples them, in the modes last asked for.
    acting: Option<Box<Acting>>,
    observed: Evaluator,
    /// Operations behind the outputs shown: in the tape of the forces, in that of the outputs, together. Made when first asked for.
    behind: Option<[Arc<Behind>; 3]>,
    /// q'' and reactions.
    forces: Evaluator,
    conditions: Option<Conditions>,
    /// Which outputs the roots of `observed` are, and whether one of them needs q'' or a reaction.
    shown: Vec<usize>,
    needs_accelerations: bool,
    /// q'' that outputs take in place of those of the equations.
    imposed: Option<Vec<f64>>,
    energy: Evaluator,
    flows: Flows,
    /// Contacts and frictions in numbers, and where each is among the roots.
    touches: Evaluator,
    touching: Vec<touching::Place>,
    second: Evaluator,
    released: Evaluator,
    /// The placements of bodies among its roots.
    placements: Evaluator,
    layout: Layout,
    /// Laws of friction and balances of released bodies, see [`program::LawRoots`].
    laws: Evaluator,
    /// Shares of all reactions in all balances.
    balances: Evaluator,
    /// What the entries of [`Blow::reactions`] are.
    impulses: Vec<Quantity>,
    /// What reactions can share a load.
    sharing: sharing::Sharing,
    places: Evaluator,
    statics: Evaluator,
    /// Of the last expansion.
    expanded: Switches,
    /// Of the last output.
    observing: Switches,
    /// q'', then all reactions.
    accelerations: Vec<f64>,
    /// The same at several places.
    abreast: Vec<Lanes>,
    solved: Solved,
    /// The guard of each dry friction, in the order of its power among the roots of `energy`.
    rubbing: Vec<Option<usize>>,
    /// Rows of `second` that hold with the reactions; none without reactions.
    balanced: Vec<usize>,
    /// State at the start, when it was assembled.
    start: Option<Vec<f64>>,
    /// For each output a reaction in it that is not unique.
    refused: Vec<Option<Refusal>>,
    /// Whether formulas of places have switches.
    is_bent: bool,
    /// Reactions that rigid bodies leave open all the time.
    undetermined: Vec<usize>,
    notes: Vec<Text>,
    /// What other numbers share; none where the program came from outside.
    lowered: Option<Lowered>,
}

/// What lowering made, whatever the numbers are.
#[derive(Clone, Debug)]
struct Lowered {
    /// Of assembly.
    conditions: Arc<Program>,
    /// What takes part in `program`.
    selection: Selection,
    program: Arc<Program>,
    /// Of its guards.
    names: Vec<Text>,
}

/// Modes as the program has them.
#[derive(Clone, Debug, Default)]
struct Switches {
    modes: Vec<Mode>,
    /// Guards that decide something in these modes; others have no meaning.
    active: Vec<bool>,
    known: bool,
}

impl Switches {
    fn set(&mut self, modes: &[Mode], bound: &Bound) {
        let same = self.known && self.modes == modes;
        if !same {
            self.modes.clear();
            self.modes.extend(modes);
            self.active = bound.active(&self.modes);
            self.known = true;
        }
    }
}

impl From<program::Fault> for Fault {
    fn from(fault: program::Fault) -> Fault {
        Fault::from(fault.notice.clone()).about(fault.expression)
    }
}

impl Machine {
    /// `parameters` in the order of the program; `guard_names` say what each guard of the program is, as the user wrote it.
    ///
    /// *Errors*: parameters outside the domain of a formula.
    pub fn new(equations: &Equations, program: &Arc<Program>, parameters: &[f64], guard_names: &[Text]) -> Result<Machine, Fault> {
        let general = Bound::new(program, parameters)?;
        let bound = general.specialised()?;
        let mut guards: Vec<Guard> = (0..program.guards.len())
            .map(|i| {
                let unnamed = || Text::new(format!("switch {}", i + 1), format!("переключатель {}", i + 1));
                let kind = kind(equations, program, i);
                let tie = is_tie(equations, &program.guards[i].kind);
                Guard { name: guard_names.get(i).cloned().unwrap_or_else(unnamed), kind, tie, scheduled: None }
            })
            .collect();
        for (guard, t) in bound.scheduled() {
            guards[guard].scheduled = Some(t);
        }
        let observed = bound.evaluator(&bound.program().outputs)?;
        Ok(Machine {
            states: states(equations, program),
            turning: equations.free_turns(),
            outputs: outputs(equations),
            jets: bound.jets(1),
            tangent: None,
            acting: None,
            needs_accelerations: reads_accelerations(observed.tape()),
            observed,
            behind: None,
            forces: bound.evaluator(&bound.program().forces)?,
            conditions: Conditions::new(equations, &bound)?,
            shown: (0..program.outputs.roots.len()).collect(),
            energy: bound.evaluator(&bound.program().energy)?,
            flows: Flows::new(equations, &bound)?,
            touches: general.evaluator(&program.touches)?,
            touching: touching::places(equations, program),
            second: general.evaluator(&program.second)?,
            released: general.evaluator(&program.released)?,
            placements: placements(equations, &general)?,
            layout: layout(equations),
            laws: bound.evaluator(&bound.program().laws)?,
            balances: bound.evaluator(&bound.program().balances)?,
            impulses: equations.reactions.iter().map(impulse).collect(),
            sharing: sharing::Sharing::new(equations, program),
            places: general.evaluator(&program.places)?,
            statics: general.evaluator(&program.statics)?,
            expanded: Switches::default(),
            observing: Switches::default(),
            accelerations: vec![0.0; program.coordinates + program.reactions],
            abreast: Vec::new(),
            imposed: None,
            solved: Solved::default(),
            guards,
            rubbing: rubbing(equations, program),
            balanced: if program.reactions > 0 { (0..equations.second.len()).collect() } else { Vec::new() },
            start: None,
            refused: vec![None; program.outputs.roots.len()],
            is_bent: connections::is_bent(equations),
            undetermined: Vec::new(),
            notes: Vec::new(),
            lowered: None,
            bound,
        })
    }

    /// Puts a machine together, with or without connections; `guard_names` gives the names of the guards of a program.
    ///
    /// *Errors*: those of [`connections::assemble`] and of [`Machine::new`], and a number of motors that does not match.
    pub fn assembled(equations: &Equations, parameters: &[f64], guard_names: &dyn Fn(&Program) -> Vec<Text>) -> Result<Machine, Fault> {
        let conditions = connections::conditions(equations)?;
        let assembly = assemble_with(&conditions, equations, parameters)?;
        let program = connections::selected(equations, &assembly.selection, &conditions)?;
        let lowered = Lowered { conditions, selection: assembly.selection.clone(), names: guard_names(&program), program };
        Machine::from_parts(lowered, equations, parameters, assembly)
    }

    /// The machine of the same equations with other numbers; `equations` hold them, too. What takes part in the equations may change with them, and only
    /// then they are lowered again.
    ///
    /// *Errors*: those of [`Machine::assembled`].
    pub fn bound(&self, equations: &Equations, parameters: &[f64], guard_names: &dyn Fn(&Program) -> Vec<Text>) -> Result<Machine, Fault> {
        let Some(lowered) = &self.lowered else { return Machine::assembled(equations, parameters, guard_names) };
        let assembly = assemble_with(&lowered.conditions, equations, parameters)?;
        let mut lowered = Lowered::clone(lowered);
        if assembly.selection != lowered.selection {
            lowered.program = connections::selected(equations, &assembly.selection, &lowered.conditions)?;
            lowered.names = guard_names(&lowered.program);
            lowered.selection = assembly.selection.clone();
        }
        Machine::from_parts(lowered, equations, parameters, assembly)
    }

    fn from_parts(lowered: Lowered, equations: &Equations, parameters: &[f64], assembly: Assembly) -> Result<Machine, Fault> {
        let program = &lowered.program;
        let mut machine = Machine::new(equations, program, parameters, &lowered.names)?;
        machine.refused = refused(equations, program, &assembly.undetermined);
        machine.undetermined.clone_from(&assembly.undetermined.open);
        machine.notes = assembly.notes;
        let n = equations.coordinates.len();
        machine.balanced.retain(|&i| i < n || assembly.selection.balances.get(i - n) == Some(&true));
        if let Some(conditions) = &mut machine.conditions {
            conditions.look_around(&assembly.start);
        }
        machine.start = Some(assembly.start);
        machine.lowered = Some(lowered);
        Ok(machine)
    }

    /// The state at the start: as assembled, or as the model gives it.
    pub fn start(&self) -> Result<Vec<f64>, Fault> {
        match &self.start {
            Some(start) => Ok(start.clone()),
            None => Ok(self.bound.start()?),
        }
    }

    /// Puts q'' and the reactions at (t, x), in the modes of `observing`, into `accelerations`; reactions that are not unique are not numbers.
    fn solve_forces(&mut self, t: f64, x: &[f64]) -> Result<(), Fault> {
        let Switches { modes, active, .. } = &self.observing;
        let point = Point { time: t, states: x, modes: Some(modes), active: Some(active), ..Point::default() };
        let roots = self.forces.evaluate(&point)?;
        self.bound.program().spread(roots, &mut self.accelerations);
        Ok(())
    }

    /// The same with given q''. A reaction that is not unique is one of those that hold the motion: that of a connection left out is zero.
    fn take_accelerations(&mut self, t: f64, x: &[f64], accelerations: &[f64]) -> Result<(), Fault> {
        let n = self.bound.program().coordinates;
        if self.accelerations.len() > n {
            self.look_up_forces(t, x)?;
            self.accelerations[n..].iter_mut().filter(|r| r.is_nan()).for_each(|r| *r = 0.0);
        }
        self.accelerations[..n].copy_from_slice(&accelerations[..n]);
        Ok(())
    }

    /// The slopes on the flow within the resolution of time, where they have no value at the state itself: the state of an event lies on either side of its
    /// surface, and a root or power of what is zero there may have none on the wrong one. In the modes of `observing`.
    fn slopes_beside(&self, t: f64, x: &[f64]) -> Option<Vec<f64>> {
        let Switches { modes, active, .. } = &self.observing;
        let (mut jets, mut tangent) = (self.jets.clone(), self.tangent.clone()?);
        jets.expand(t, x, modes, 1).ok()?;
        [-1.0, 1.0].into_iter().find_map(|side| {
            let dt = side * RESOLUTION * t.abs();
            let beside: Vec<f64> = x.iter().enumerate().map(|(i, x)| x + dt * jets.state(i)[1]).collect();
            let point = Point { time: t + dt, states: &beside, modes: Some(modes), active: Some(active), ..Point::default() };
            tangent.evaluate(&point).ok().map(<[f64]>::to_vec)
        })
    }

    /// What stands behind the outputs shown: in the tape of the forces, in that of the outputs, together by index of the output.
    fn operations(&mut self) -> [Arc<Behind>; 3] {
        if let Some(known) = &self.behind {
            return known.clone();
        }
        let outputs = Behind::new(&self.observed);
        let forces = if self.needs_accelerations && self.imposed.is_none() { Behind::new(&self.forces) } else { Behind::default() };
        let program = self.bound.program();
        let n = program.coordinates;
        let root = |i: usize| if i < n { Some(i) } else { program.known.iter().position(|r| *r == i - n).map(|k| n + k) };
        let mut whole = outputs.after(&forces, &root);
        let mut of = vec![Vec::new(); self.outputs.len()];
        whole.of.drain(..).zip(&self.shown).for_each(|(list, &i)| of[i] = list);
        whole.of = of;
        let made = [forces, outputs, whole].map(Arc::new);
        self.behind = Some(made.clone());
        made
    }

    /// A fault of the equations at a state, with the configuration where it is that of one.
    fn told(&self, fault: program::Fault, x: &[f64]) -> Fault {
        if fault.singular.is_some() { self.singular(fault.into(), x) } else { fault.into() }
    }

    fn singular(&self, fault: Fault, x: &[f64]) -> Fault {
        let places = self.states.iter().zip(x).take(self.bound.program().coordinates);
        fault.in_configuration(&configuration(places))
    }
}

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

    fn momenta(&mut self, t: f64, x: &[f64], change: &[f64], impulses: &[f64]) -> Option<Vec<[f64; 2]>> {
        if self.balanced.is_empty() {
            return None;
        }
        let inputs = [change, impulses].concat();
        let point = Point { time: t, states: x, accelerations: &inputs, ..Point::default() };
        touching::linear(&mut self.second, &point, change.len())
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

    fn layout(&self) -> Layout {
        self.layout.clone()
    }

    fn project(&mut self, t: f64, x: &mut [f64], modes: &[Mode]) -> Result<f64, Fault> {
        if self.conditions.is_none() {
            return Ok(0.0);
        }
        let t = if self.bound.program().steps { self.side_of(t, x, modes) } else { t };
        self.conditions.as_mut().map_or(Ok(0.0), |conditions| conditions.project(t, x, modes))
    }

    fn margin(&mut self, t: f64, x: &[f64]) -> Option<f64> {
        self.conditions.as_mut()?.margin(t, x)
    }

    fn reaches(&mut self, t: f64, x: &[f64]) -> Vec<(usize, [f64; 2])> {
        self.conditions.as_mut().and_then(|conditions| conditions.reaches(t, x)).unwrap_or_default()
    }

    fn polish(&mut self, t: f64, x: &mut [f64], modes: &[Mode]) -> Result<(), Fault> {
        match &mut self.conditions {
            Some(conditions) => conditions.polish(t, x, modes),
            None => Ok(()),
        }
    }

    fn margins(&self) -> usize {
        self.conditions.as_ref().map_or(0, Conditions::margins)
    }

    fn drifts(&self) -> &[[f64; 2]] {
        self.conditions.as_ref().map_or(&[], Conditions::drifts)
    }

    fn repeats(&mut self, t: f64, x: &[f64], modes: &[Mode]) -> Result<usize, Fault> {
        self.conditions.as_mut().map_or(Ok(0), |conditions| conditions.repeats(t, x, modes))
    }

    fn impact(&mut self, t: f64, x: &mut [f64], modes: &[Mode], closing: &[usize]) -> Result<Blow, Fault> {
        if self.conditions.is_none() {
            return Ok(Blow::default());
        }
        // a surface with a kink at this instant has the rate of the side on which it is met
        let t = if self.bound.program().steps { self.side_of(t, x, modes) } else { t };
        let Some(conditions) = &mut self.conditions else { return Ok(Blow::default()) };
        let n = self.bound.program().coordinates;
        let rates = x[n..2 * n].to_vec();
        let mut blow = conditions.impact(t, x, modes, closing)?;
        let jump: Vec<f64> = rates.iter().zip(&x[n..2 * n]).map(|(before, after)| after - before).collect();
        self.hold([t, t], x, &jump, &mut blow);
        Ok(blow)
    }

    fn impulses(&self) -> &[Quantity] {
        &self.impulses
    }

    fn bend(&mut self, t: f64, x: &[f64], modes: [&[Mode]; 2]) -> Result<Vec<usize>, Fault> {
        if self.is_bent { self.pass_bend((t, x), modes) } else { Ok(Vec::new()) }
    }

    fn jolt(&mut self, t: f64, x: &mut [f64], modes: [&[Mode]; 2], closing: &[usize]) -> Result<Option<Blow>, Fault> {
        if self.bound.program().steps { self.jump(t, x, modes, closing) } else { Ok(None) }
    }

    fn ties(&mut self, t: f64, x: &[f64], modes: &[Mode]) -> Vec<(usize, Tie)> {
        self.rounding_of_contacts(t, x, modes).unwrap_or_default()
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
