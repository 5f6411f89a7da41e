//! A machine's equations as tapes, and the same with numbers for the parameters.

use crate::{Evaluator, Fault, Guard, Jets, Mode, Point, Tape, passes};
use std::sync::Arc;

/// Everything the studies evaluate, lowered from one [`symbolic::Equations`].
///
/// States are ordered x = [q; q'; s]. Modes and guards are numbered alike in all tapes.
#[derive(Clone, Debug)]
pub struct Program {
    /// Number of coordinates q.
    pub coordinates: usize,
    /// Number of auxiliary states s.
    pub auxiliaries: usize,
    /// Names of the states, `phi`, `phi'`, then auxiliary ones.
    pub states: Vec<String>,
    /// Names of the parameters, in the order of their slots.
    pub parameters: Vec<String>,
    /// Values of the parameters as the model gives them.
    pub values: Vec<f64>,
    /// The switching functions.
    pub guards: Vec<Guard>,
    /// t, x, modes -> x' (one root per state) and the guard functions.
    pub dynamics: Arc<Tape>,
    /// t, x, q'', modes -> the outputs of the model, in order.
    pub outputs: Arc<Tape>,
    /// t, x, q'', modes -> T, Π, Φ, dissipated, dE/dt, loads, drives ([`ENERGY`] names them).
    pub energy: Arc<Tape>,
    /// t, x, q'' -> n residuals of the second derivation, then n residuals M q'' - h of the first. Switches go by value.
    pub second: Arc<Tape>,
    /// t, x -> what places the machine and has a value only within limits. Switches go by value.
    pub places: Arc<Tape>,
    /// t, x (rates ignored, taken as 0) -> h(q, 0, s, t), then its Jacobian ∂h/∂q row by row. Switches go by value.
    pub statics: Arc<Tape>,
    /// parameters -> x at the start.
    pub start: Arc<Tape>,
}

/// Names of the roots of [`Program::energy`].
pub const ENERGY: [&str; 7] = ["kinetic", "potential", "dissipation", "dissipated", "rate", "loads", "drives"];

/// A program with numbers for its parameters: the prologue of the dynamics has been run.
///
/// Its methods serve studies that ask now and then; loops keep an [`Evaluator`] or [`Jets`] of their own.
#[derive(Clone, Debug)]
pub struct Bound {
    pub(crate) program: Arc<Program>,
    pub(crate) parameters: Vec<f64>,
    pub(crate) dynamics: Evaluator,
}

impl Bound {
    /// Puts numbers in; `parameters` in the order of [`Program::parameters`].
    ///
    /// *Errors*: P008 for a wrong number of values; a domain error in a formula over parameters that the motion depends on.
    pub fn new(program: &Arc<Program>, parameters: &[f64]) -> Result<Bound, Fault> {
        let dynamics = Evaluator::new(&program.dynamics, parameters)?;
        Ok(Bound { program: Arc::clone(program), parameters: parameters.to_vec(), dynamics })
    }
    /// The same with every tape rewritten for these numbers by [`passes::specialise`]: faster, equal up to rounding.
    ///
    /// *Errors*: P020 when the pass broke a tape.
    pub fn specialised(&self) -> Result<Bound, Fault> {
        let tape = |tape: &Arc<Tape>| passes::specialise(tape, &self.parameters).map(Arc::new);
        let p = &self.program;
        let program =
            Arc::new(Program { dynamics: tape(&p.dynamics)?, outputs: tape(&p.outputs)?, energy: tape(&p.energy)?, ..Program::clone(p) });
        Bound::new(&program, &self.parameters)
    }
    /// The program.
    pub fn program(&self) -> &Arc<Program> {
        &self.program
    }
    /// The numbers.
    pub fn parameters(&self) -> &[f64] {
        &self.parameters
    }
    /// Length of x.
    pub fn dimension(&self) -> usize {
        self.program.dynamics.roots.len()
    }
    /// An evaluator of one of the program's tapes with these parameters.
    pub fn evaluator(&self, tape: &Arc<Tape>) -> Result<Evaluator, Fault> {
        Evaluator::new(tape, &self.parameters)
    }
    /// A Taylor expander of the dynamics for orders up to `order`.
    pub fn jets(&self, order: usize) -> Jets {
        Jets::new(self, order)
    }
    /// x at the start.
    pub fn start(&self) -> Result<Vec<f64>, Fault> {
        let mut start = self.evaluator(&self.program.start)?;
        Ok(start.evaluate(&Point::default())?.to_vec())
    }
    /// x' at a state, by the interpreter.
    pub fn rates(&mut self, time: f64, states: &[f64], modes: &[Mode]) -> Result<&[f64], Fault> {
        self.dynamics.evaluate(&Point { time, states, modes: Some(modes), ..Point::default() })
    }
    /// The modes that the guard values at a state have. A guard that is not a number there (its branch is not active) is `Positive`.
    pub fn modes(&mut self, time: f64, states: &[f64]) -> Result<Vec<Mode>, Fault> {
        self.dynamics.modes(&Point { time, states, ..Point::default() })
    }
    /// Which guards matter in these modes: those that decide something on the way to x'. A crossing of another guard changes nothing.
    pub fn active(&self, modes: &[Mode]) -> Vec<bool> {
        crate::guard::active(&self.dynamics, modes)
    }
    /// Guards that depend on nothing but time, affinely, with the time of their only zero: the integrator lands there exactly.
    ///
    /// Sorted by time. A guard that never vanishes is absent.
    pub fn scheduled(&self) -> Vec<(usize, f64)> {
        crate::guard::scheduled(&self.dynamics)
    }
}
