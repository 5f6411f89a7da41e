//! A machine's program as a [`crate::System`]: what it is made of; what is asked of it, in `system`.

use std::sync::Arc;

mod bend;
mod bilateral;
mod conditions;
mod flows;
mod hidden;
mod impact;
mod impulses;
mod integrals;
mod jolt;
mod kept;
mod known;
pub(crate) mod lanes;
mod leap;
mod likely;
mod meaning;
mod open;
mod parts;
mod phases;
mod shares;
mod sharing;
mod solved;
mod strike;
mod supplied;
mod switches;
mod system;
mod ties;
mod touches;
mod touching;

use program::lower::Selection;
use program::{Abreast, Acting, Behind, Bound, Evaluator, Jets, Lanes, Point, Program, RESOLUTION, Tangent};
use symbolic::Equations;
use words::Text;

use crate::connections::{self, Assembly, assemble_with};
use crate::naming::configuration;
use crate::system::Layout;
use crate::{Fault, Guard, Quantity};
use conditions::Conditions;
use flows::Flows;
use meaning::{Refusal, impulse, is_tie, kind, layout, outputs, placements, reads_accelerations, refused, rubbing, states};
use solved::Solved;
use switches::Switches;

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
    /// The same at several points at once, as soon as they are asked for and where that goes.
    placed: Option<Option<Abreast>>,
    layout: Layout,
    /// Laws of friction and balances of released bodies, see [`program::LawRoots`].
    laws: Evaluator,
    /// Shares of all reactions in all balances.
    balances: Evaluator,
    /// What the entries of [`crate::Blow::reactions`] are.
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
            placed: None,
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
    ///
    /// *Errors*: a start outside the domain of a formula.
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
