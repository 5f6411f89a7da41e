//! A machine's program as a [`System`].

use std::sync::Arc;

use program::{Bound, Evaluator, Jets, Operation, Point, Program, Tape, passes};
use symbolic::{Equations, Text};

use crate::fault::Message;
use crate::{Fault, Guard, Mode, Powers, Quantity, System};

/// A program with parameters, seen by studies.
#[derive(Clone, Debug)]
pub struct Machine {
    states: Vec<Quantity>,
    outputs: Vec<Quantity>,
    guards: Vec<Guard>,
    /// Specialised for the parameters; [`Machine::new`] keeps the general tapes for what is asked rarely.
    bound: Bound,
    jets: Jets,
    observed: Evaluator,
    /// Which outputs the roots of `observed` are, and whether one of them needs q''.
    shown: Vec<usize>,
    needs_accelerations: bool,
    energy: Evaluator,
    second: Evaluator,
    places: Evaluator,
    statics: Evaluator,
    /// Of the last expansion.
    expanded: Switches,
    /// Of the last output.
    observing: Switches,
    accelerations: Vec<f64>,
}

/// Modes as the program has them.
#[derive(Clone, Debug, Default)]
struct Switches {
    modes: Vec<program::Mode>,
    /// Guards that decide something in these modes; others have no meaning.
    active: Vec<bool>,
    known: bool,
}

impl Switches {
    fn set(&mut self, modes: &[Mode], bound: &Bound) {
        let same = self.known && self.modes.iter().zip(modes).all(|(a, b)| *a == translated(*b));
        if !same {
            self.modes.clear();
            self.modes.extend(modes.iter().map(|m| translated(*m)));
            self.active = bound.active(&self.modes);
            self.known = true;
        }
    }
}

impl From<program::Fault> for Fault {
    fn from(fault: program::Fault) -> Fault {
        let message = Message { code: fault.code, what: fault.what.clone(), why: fault.why.clone(), help: fault.help.clone() };
        Fault::new(message).about(fault.expression)
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
                Guard { name: guard_names.get(i).cloned().unwrap_or_else(unnamed), ..Guard::default() }
            })
            .collect();
        for (guard, t) in bound.scheduled() {
            guards[guard].scheduled = Some(t);
        }
        let observed = bound.evaluator(&bound.program().outputs)?;
        Ok(Machine {
            states: states(equations, program),
            outputs: outputs(equations),
            jets: bound.jets(1),
            needs_accelerations: reads_accelerations(observed.tape()),
            observed,
            shown: (0..program.outputs.roots.len()).collect(),
            energy: bound.evaluator(&bound.program().energy)?,
            second: general.evaluator(&program.second)?,
            places: general.evaluator(&program.places)?,
            statics: general.evaluator(&program.statics)?,
            expanded: Switches::default(),
            observing: Switches::default(),
            accelerations: vec![0.0; program.coordinates],
            guards,
            bound,
        })
    }

    /// The state at the start as the model gives it.
    pub fn start(&self) -> Result<Vec<f64>, Fault> {
        Ok(self.bound.start()?)
    }
}

fn reads_accelerations(tape: &Tape) -> bool {
    tape.body.iter().any(|i| matches!(i.operation, Operation::Acceleration(_)))
}

fn translated(mode: Mode) -> program::Mode {
    match mode {
        Mode::Negative => program::Mode::Negative,
        Mode::Zero => program::Mode::Zero,
        Mode::Positive => program::Mode::Positive,
    }
}

/// Names as the program has them; units and labels from the equations.
fn states(equations: &Equations, program: &Program) -> Vec<Quantity> {
    let rate = |unit: &str| if unit == "1" { "1/s".to_owned() } else { format!("{unit}/s") };
    let coordinates = equations.coordinates.iter();
    let described = coordinates
        .clone()
        .map(|c| (c.unit.clone(), c.label.clone()))
        .chain(coordinates.map(|c| (rate(&c.unit), Text::default())))
        .chain(equations.auxiliaries.iter().map(|a| (a.unit.clone(), a.label.clone())));
    let quantity = |(name, (unit, label)): (&String, (String, Text))| Quantity {
        label,
        symbol: notation(equations, name),
        ..Quantity::new(name, &unit)
    };
    program.states.iter().zip(described).map(quantity).collect()
}

fn outputs(equations: &Equations) -> Vec<Quantity> {
    let quantity = |o: &symbolic::equations::Output| {
        let info = equations.graph.symbol_info(o.symbol);
        let symbol = notation(equations, &format!("{}{}", info.name, "'".repeat(usize::from(info.primes))));
        Quantity { name: o.name.clone(), symbol, unit: o.unit.clone(), label: o.label.clone(), display: o.display.clone() }
    };
    equations.outputs.iter().map(quantity).collect()
}

/// The user's symbol of a name, primes kept: `phi1'` is `φ_в'` where the file says so.
pub(crate) fn notation(equations: &Equations, name: &str) -> String {
    let bare = name.trim_end_matches('\'');
    let shown = equations.notation.iter().find(|(n, _)| n == bare).map_or(bare, |(_, symbol)| symbol);
    format!("{shown}{}", &name[bare.len()..])
}

impl System for Machine {
    fn states(&self) -> &[Quantity] {
        &self.states
    }
    fn n_coordinates(&self) -> usize {
        self.accelerations.len()
    }
    fn guards(&self) -> &[Guard] {
        &self.guards
    }
    fn outputs(&self) -> &[Quantity] {
        &self.outputs
    }

    fn expand(&mut self, t: f64, x: &[f64], modes: &[Mode], order: usize) -> Result<(), Fault> {
        self.expanded.set(modes, &self.bound);
        Ok(self.jets.expand(t, x, &self.expanded.modes, order)?)
    }

    fn state(&self, i: usize) -> &[f64] {
        self.jets.state(i)
    }

    fn guard(&self, i: usize) -> &[f64] {
        if self.expanded.active.get(i) == Some(&true) { self.jets.guard(i) } else { &[] }
    }

    fn observe(&mut self, t: f64, x: &[f64], modes: &[Mode], values: &mut [f64]) -> Result<(), Fault> {
        self.observing.set(modes, &self.bound);
        let Switches { modes, active, .. } = &self.observing;
        if self.needs_accelerations {
            let n = self.accelerations.len();
            let rates = self.bound.rates(t, x, modes)?;
            self.accelerations.copy_from_slice(&rates[n..2 * n]);
        }
        let point = Point { time: t, states: x, accelerations: &self.accelerations, modes: Some(modes), active: Some(active) };
        for (value, &i) in self.observed.evaluate(&point)?.iter().zip(&self.shown) {
            values[i] = *value;
        }
        Ok(())
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
        Ok(())
    }

    fn modes_by_value(&mut self, t: f64, x: &[f64]) -> Option<Vec<Mode>> {
        let modes = self.bound.modes(t, x).ok()?;
        let back = |m: program::Mode| match m {
            program::Mode::Negative => Mode::Negative,
            program::Mode::Zero => Mode::Zero,
            program::Mode::Positive => Mode::Positive,
        };
        Some(modes.into_iter().map(back).collect())
    }

    fn powers(&mut self, t: f64, x: &[f64], accelerations: &[f64], modes: &[Mode]) -> Option<Powers> {
        self.observing.set(modes, &self.bound);
        let Switches { modes, active, .. } = &self.observing;
        let point = Point { time: t, states: x, accelerations, modes: Some(modes), active: Some(active) };
        // the order is that of program::ENERGY
        let [_, _, _, dissipated, rate, loads, drives] = *self.energy.evaluate(&point).ok()? else { return None };
        Some(Powers { rate, loads, drives, dissipated })
    }

    fn placed(&mut self, t: f64, x: &[f64]) -> Result<(), Fault> {
        if !self.places.tape().roots.is_empty() {
            self.places.evaluate(&Point { time: t, states: x, accelerations: &self.accelerations, ..Point::default() })?;
        }
        Ok(())
    }

    fn second(&mut self, t: f64, x: &[f64], accelerations: &[f64], _modes: &[Mode], residuals: &mut [f64]) -> bool {
        let point = Point { time: t, states: x, accelerations, ..Point::default() };
        let Ok(values) = self.second.evaluate(&point) else { return false };
        if residuals.is_empty() || values.len() < residuals.len() {
            return false;
        }
        residuals.copy_from_slice(&values[..residuals.len()]);
        true
    }

    fn statics(&mut self, x: &[f64], forces: &mut [f64], derivatives: &mut [f64]) -> Result<(), Fault> {
        let values = self.statics.evaluate(&Point { states: x, ..Point::default() })?;
        let (h, jacobian) = values.split_at(forces.len());
        forces.copy_from_slice(h);
        derivatives.copy_from_slice(&jacobian[..derivatives.len()]);
        Ok(())
    }
}
