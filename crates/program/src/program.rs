//! A machine's equations as tapes, and the same with numbers for the parameters.

use crate::{Construct, Evaluator, Fault, GuardOrigin, Instruction, Mode, Operation, Point, Tape, passes};
use std::ops::Range;
use std::sync::Arc;
use words::Text;

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
    pub guards: Vec<GuardOrigin>,
    /// Guard of kind `Sliding` or `Gap` by which each reaction goes, by reaction. Frictions with one sliding speed go by one guard.
    pub switches: Vec<Option<usize>>,
    /// Number of conditions in the equations, dropped ones included.
    pub conditions: usize,
    /// Number of contacts.
    pub contacts: usize,
    /// Number of dry frictions.
    pub frictions: usize,
    /// Balances (by index) among the rows of the dynamics: a friction is pressed by the force of a support.
    pub joined: Vec<usize>,
    /// All balances (by index) that take part.
    pub balanced: Vec<usize>,
    /// Reactions (by index) that follow from them, as many.
    pub hidden: Vec<usize>,
    /// Number of reactions in the equations, absent ones included: what `accelerations` of a [`Point`] hold behind the n values of q''.
    pub reactions: usize,
    /// Reactions (by index) that the dynamics solve for: roots 2n + s, 2n + s + 1, ... of [`Program::dynamics`].
    pub solved: Vec<usize>,
    /// How many of the conditions repeat others wherever the machine is.
    pub repeated: usize,
    /// Reactions (by index) that [`Program::forces`] gives: roots n, n + 1, ... The others are not unique.
    pub known: Vec<usize>,
    /// Names of the equations of the dynamics, for [`crate::Singular::row`]: kept conditions, motions, kept balances when they take part.
    pub rows: Vec<Text>,
    /// Names of their unknowns, for [`crate::Singular::unknown`]: q'', then `solved`.
    pub unknowns: Vec<String>,
    /// t, x, modes -> x' (one root per state), one root per reaction in `solved`, and the guard functions.
    pub dynamics: Arc<Tape>,
    /// t, x, modes -> q'' (n), then one root per reaction in `known`: those of supports included.
    pub forces: Arc<Tape>,
    /// t, x, q'' and all reactions, modes -> the outputs of the model, in order.
    pub outputs: Arc<Tape>,
    /// t, x, q'' and all reactions, modes -> T, Π, Φ, dissipated, dE/dt, loads, drives, what passes through ([`ENERGY`] names them), then the power
    /// that each dry friction takes, in the order of the reactions.
    pub energy: Arc<Tape>,
    /// t, x, q'' and all reactions, modes -> for each contact and friction, in the order of the reactions, what its law compares; see [`TouchRoots`].
    pub touches: Arc<Tape>,
    /// t, x, q'' and all reactions -> the residuals of the second derivation (motions, then balances), then the residuals
    /// M q'' - Σ forces λ - h of the first and Σ columns q'' - rest - Σ released λ of the balances. Switches go by value.
    pub second: Arc<Tape>,
    /// t, x, q'' and all reactions -> released bodies, in the order of `symbolic::connections::Released::expressions`. Switches go by value.
    pub released: Arc<Tape>,
    /// t, x -> what places the machine and has a value only within limits. Switches go by value.
    pub places: Arc<Tape>,
    /// t, x (rates ignored, taken as 0) -> h(q, 0, s, t), then its Jacobian ∂h/∂q row by row. Switches go by value.
    pub statics: Arc<Tape>,
    /// Whether velocities that formulas of time prescribe may jump: they stand behind the reactions among the roots of the dynamics.
    pub steps: bool,
    /// t, x -> all conditions and what assembly, projection and impacts need; [`Program::connection_roots`] says where. Switches go by value.
    pub connections: Arc<Tape>,
    /// t, x -> laws of friction in an impact; [`Program::law_roots`] says where. Switches go by value.
    pub laws: Arc<Tape>,
    /// t, x -> Σ released: balances x reactions, row by row. Switches go by value.
    pub balances: Arc<Tape>,
    /// parameters -> x at the start.
    pub start: Arc<Tape>,
}

/// Where the roots of [`Program::connections`] are; n coordinates, m conditions (dropped ones included), c contacts in the order of their reactions.
/// A machine without conditions and reactions has none.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct ConnectionRoots {
    /// m: value of each condition's place, 0 for one on rates only.
    pub places: Range<usize>,
    /// m: its rate.
    pub rates: Range<usize>,
    /// m n: ∂rate/∂q', row by row.
    pub jacobian: Range<usize>,
    /// n(n+1)/2: lower triangle of M, row by row.
    pub mass: Range<usize>,
    /// c: gaps of contacts.
    pub gaps: Range<usize>,
    /// 2 c: coefficients of restitution of each contact, normal and tangential.
    pub restitutions: Range<usize>,
    /// reactions x n: generalized forces per unit of each reaction, row by row.
    pub forces: Range<usize>,
}

/// Where the roots of [`Program::laws`] are.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct LawRoots {
    /// frictions x (2 + 2 reactions): kinetic friction at this sliding speed, static limit, then the factor of each reaction in the normal force, and in
    /// its second component.
    pub frictions: Range<usize>,
    /// balances that take part x (n + reactions + 1): inertia coefficients of q'', the share of each reaction, the momentum that prescribed motions give.
    pub balances: Range<usize>,
}

/// The roots of [`Program::touches`] for one contact or friction, by place. Sizes are sums of the squares of the terms that meet.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum TouchRoots {
    /// Gap of a contact; normal force of a friction, 1 where its magnitudes are forces.
    Leading,
    /// Size of the terms of its place.
    PlaceSize,
    /// Rate of the gap, sliding speed.
    Rate,
    /// Size of the terms of the rate.
    RateSize,
    /// Derivative of the rate with the accelerations given.
    Acceleration,
    /// Size of its terms.
    AccelerationSize,
    /// Magnitude of a friction that slides back, in units of the normal force; 0 for contacts, as what follows.
    Back,
    /// Magnitude of one that slides forth.
    Forth,
    /// Largest magnitude at rest.
    Fixed,
    /// Coefficient of restitution of a contact; of a friction the tangential one of the first contact that presses it.
    Restitution,
    /// Second component of a normal force, at right angles to the first.
    Across,
}

impl TouchRoots {
    /// How many there are.
    pub const WIDTH: usize = 11;
}

/// Names of the roots of [`Program::energy`].
pub const ENERGY: [&str; 8] = ["kinetic", "potential", "dissipation", "dissipated", "rate", "loads", "drives", "through"];

impl Program {
    /// Where the roots of [`Program::connections`] are.
    pub fn connection_roots(&self) -> ConnectionRoots {
        let (n, m, c) = (self.connected_coordinates(), self.conditions, self.contacts);
        let [places, rates, jacobian, mass, gaps, restitutions, forces] =
            consecutive([m, m, m * n, n * (n + 1) / 2, c, 2 * c, self.reactions * n]);
        ConnectionRoots { places, rates, jacobian, mass, gaps, restitutions, forces }
    }
    /// Where the roots of [`Program::laws`] are.
    pub fn law_roots(&self) -> LawRoots {
        let (n, r) = (self.coordinates, self.reactions);
        let [frictions, balances] = consecutive([self.frictions * (2 + 2 * r), self.balanced.len() * (n + r + 1)]);
        LawRoots { frictions, balances }
    }
    fn connected_coordinates(&self) -> usize {
        if self.conditions + self.reactions > 0 { self.coordinates } else { 0 }
    }
    /// The inputs `accelerations` of outputs, energy and the second derivation, from the roots of [`Program::forces`]: q'', then every
    /// reaction at its own index, not-a-number where it is not unique.
    pub fn spread(&self, roots: &[f64], accelerations: &mut Vec<f64>) {
        let n = self.coordinates.min(roots.len());
        accelerations.clear();
        accelerations.extend_from_slice(&roots[..n]);
        accelerations.resize(self.coordinates + self.reactions, f64::NAN);
        for (reaction, value) in self.known.iter().zip(&roots[n..]) {
            if let Some(slot) = accelerations.get_mut(self.coordinates + reaction) {
                *slot = *value;
            }
        }
    }
}

pub(crate) fn consecutive<const N: usize>(sizes: [usize; N]) -> [Range<usize>; N] {
    let mut end = 0;
    sizes.map(|size| {
        end += size;
        end - size..end
    })
}

/// A program with numbers for its parameters: the prologue of the dynamics has been run.
///
/// Its methods serve studies that ask now and then; loops keep an [`Evaluator`] or [`crate::Jets`] of their own.
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
        let program = Arc::new(Program {
            dynamics: tape(&p.dynamics)?,
            forces: tape(&p.forces)?,
            outputs: tape(&p.outputs)?,
            energy: tape(&p.energy)?,
            connections: tape(&p.connections)?,
            ..Program::clone(p)
        });
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
        self.program.states.len()
    }
    /// An evaluator of one of the program's tapes with these parameters.
    ///
    /// *Errors*: parameters outside the domain of a formula.
    pub fn evaluator(&self, tape: &Arc<Tape>) -> Result<Evaluator, Fault> {
        Evaluator::new(tape, &self.parameters)
    }
    /// x at the start.
    ///
    /// *Errors*: a start outside the domain of a formula.
    pub fn start(&self) -> Result<Vec<f64>, Fault> {
        let mut start = self.evaluator(&self.program.start)?;
        Ok(start.evaluate(&Point::default())?.to_vec())
    }
    /// x' at a state, then the reactions of [`Program::solved`], by the interpreter.
    ///
    /// *Errors*: a state outside the domain of a formula, singular equations.
    pub fn rates(&mut self, time: f64, states: &[f64], modes: &[Mode]) -> Result<&[f64], Fault> {
        self.dynamics.evaluate(&Point { time, states, modes: Some(modes), ..Point::default() })
    }
    /// M at a state, row by row; none where the motion is not solved from a mass matrix alone, or has no value.
    pub fn mass(&mut self, time: f64, states: &[f64], modes: &[Mode]) -> Option<Vec<f64>> {
        let n = self.program.coordinates;
        self.dynamics.evaluate(&Point { time, states, modes: Some(modes), ..Point::default() }).ok()?;
        let solve = |i: &Instruction| matches!(&i.operation, Operation::Solve { right, .. } if right.len() == n);
        let Operation::Solve { matrix, .. } = &self.dynamics.tape().body.iter().find(|i| solve(i))?.operation else { return None };
        let mut mass = vec![0.0; n * n];
        let mut packed = matrix.iter();
        for i in 0..n {
            for j in 0..=i {
                let entry = packed.next()?.map_or(0.0, |register| self.dynamics.value(register));
                (mass[i * n + j], mass[j * n + i]) = (entry, entry);
            }
        }
        Some(mass)
    }
    /// The modes that the guard values at a state have. A guard that is not a number there (its branch is not active) is `Positive`.
    ///
    /// A friction sticks where its sliding speed is exactly zero, a contact is closed where its gap is not positive. Whether the limits hold and
    /// the contact force pushes is not decided here: their modes are the signs of their values in the modes returned.
    ///
    /// *Errors*: a state outside the domain of a formula.
    pub fn modes(&mut self, time: f64, states: &[f64]) -> Result<Vec<Mode>, Fault> {
        let mut modes = self.dynamics.modes(&Point { time, states, ..Point::default() })?;
        for (mode, guard) in modes.iter_mut().zip(&self.program.guards) {
            if matches!(guard.kind, Construct::Gap { .. }) && *mode == Mode::Negative {
                *mode = Mode::Zero;
            }
        }
        Ok(modes)
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
