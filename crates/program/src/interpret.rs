//! The interpreter: one tape, one state, plain floating-point numbers. The oracle for every other back-end.

use crate::general::General;
use crate::rounding;
use crate::solve::{self, Defect};
use crate::{By, Coefficient, DEPENDENT, Fault, Instruction, Mode, NOT_FINITE, Operation, Register, Singular, Tape, Unary};
use algebra::elementary;
use std::sync::Arc;
use words::Text;

/// A point at which a tape is evaluated. Inputs that the tape does not read may be empty.
#[derive(Clone, Copy, Debug, Default)]
pub struct Point<'a> {
    /// Time.
    pub time: f64,
    /// x = [q; q'; s].
    pub states: &'a [f64],
    /// q'', then all reactions (n + reactions values; [`crate::Program::spread`] fills them).
    pub accelerations: &'a [f64],
    /// Modes of the guards; `None` decides every switch by the value of its guard. A guard that is not a number makes its switch not a
    /// number, so that nothing is decided silently.
    pub modes: Option<&'a [Mode]>,
    /// Which of the modes hold ([`crate::Bound::active`]); the other guards are decided by value. All when absent.
    pub active: Option<&'a [bool]>,
}

/// A tape with its parameters and a register file.
#[derive(Clone, Debug)]
pub struct Evaluator {
    tape: Arc<Tape>,
    registers: Vec<f64>,
    roots: Vec<f64>,
    scratch: Scratch,
    /// Guards whose values follow from a system that they decide in.
    late: Vec<usize>,
}

/// A system by its first register, with the places of its matrix that are not empty.
type Pattern = (Register, Box<[(u32, Register)]>);

/// Memory of the systems.
#[derive(Clone, Debug, Default)]
struct Scratch {
    factor: solve::Factor,
    general: General,
    solution: Vec<f64>,
    /// Of all systems.
    patterns: Vec<Pattern>,
    /// Largest magnitude of each state so far, and how far the states may be off along a motion: where a mode ends, they stand beside the place where its guard
    /// vanishes, by rounding of what they have been and by the resolution of time.
    reach: Vec<f64>,
    off: Vec<f64>,
}

/// Rounding that a state has gathered, in units of its largest value.
const GATHERED: f64 = 16.0 * f64::EPSILON;
/// Resolution of time relative to it.
const INSTANT: f64 = 4.0 * f64::EPSILON;

impl Scratch {
    /// Notes the states of a point. Where modes are not given every sign is decided by value, and nothing is beside its place.
    fn note(&mut self, point: &Point) {
        let n = point.states.len();
        self.off.clear();
        if point.modes.is_none() {
            return;
        }
        self.reach.resize(n, 0.0);
        self.reach.iter_mut().zip(point.states).for_each(|(r, x)| *r = r.max(x.abs()));
        let moved = |i: usize| INSTANT * point.time.abs() * self.reach.get(i + n / 2).copied().unwrap_or(0.0);
        self.off.extend((0..n).map(|i| GATHERED * self.reach[i] + moved(i)));
    }
}

impl Evaluator {
    /// Binds parameters: runs the prologue.
    ///
    /// *Errors*: P008 for a wrong number of parameters. Values that are not finite are reported when a result depends on them.
    pub fn new(tape: &Arc<Tape>, parameters: &[f64]) -> Result<Evaluator, Fault> {
        if parameters.len() != tape.shape.parameters {
            let (have, want) = (parameters.len(), tape.shape.parameters);
            return Err(Fault::new("P008", &count(have, want, "parameters", "параметров")));
        }
        let mut evaluator = Evaluator {
            registers: vec![0.0; tape.registers()],
            roots: vec![0.0; tape.roots.len()],
            scratch: Scratch { patterns: patterns(tape), ..Scratch::default() },
            late: late(tape),
            tape: Arc::clone(tape),
        };
        let point = Point::default();
        for instruction in &tape.prologue {
            // a constant mass matrix has no place in a prologue, so nothing here can be singular
            let _ = execute(instruction, &mut evaluator.registers, &mut evaluator.scratch, (&point, parameters), tape);
        }
        Ok(evaluator)
    }

    /// The tape.
    pub fn tape(&self) -> &Arc<Tape> {
        &self.tape
    }
    /// Content of a register after the last evaluation; those of the prologue are always valid.
    pub fn value(&self, register: Register) -> f64 {
        self.registers[register.index()]
    }
    /// Value of a coefficient.
    pub fn coefficient(&self, c: Coefficient) -> f64 {
        c.among(&self.registers)
    }

    /// The side that a choice took in the last evaluation; none when what decides is no number.
    pub(crate) fn decided(&self, by: By, point: &Point) -> Option<Mode> {
        decide(by, &self.registers, point, &self.tape).ok()
    }

    /// Bound of the rounding in a register after the last evaluation; states and time count as rounded once.
    pub(crate) fn rounding(&self, register: Register) -> f64 {
        rounding::bound(&self.tape, &self.registers, register)
    }

    /// Bounds of the rounding in all registers after the last evaluation, where the inputs are off by more than their own rounding.
    pub(crate) fn roundings(&self, given: &rounding::Given) -> Vec<f64> {
        rounding::bounds(&self.tape, &self.registers, given)
    }

    /// Bounds of the rounding in the roots after the last evaluation, in order: a root below its bound may be zero.
    pub fn root_roundings(&self) -> Vec<f64> {
        let bounds = rounding::bounds(&self.tape, &self.registers, &rounding::Given::default());
        self.tape.roots.iter().map(|root| bounds[root.register.index()]).collect()
    }

    /// Values of the roots at a point, in order.
    ///
    /// *Errors*: P008 for missing inputs, P005 or P009 for a mass matrix that is not positive, and for a root that is not finite the first operation that
    /// spoiled it.
    pub fn evaluate(&mut self, point: &Point) -> Result<&[f64], Fault> {
        self.run(point)?;
        for (value, root) in self.roots.iter_mut().zip(&self.tape.roots) {
            *value = self.registers[root.register.index()];
        }
        match self.roots.iter().position(|v| !v.is_finite()) {
            None => Ok(&self.roots),
            Some(i) => Err(self.blame(point, i)),
        }
    }

    /// The modes that guard values have at a point, outer guards deciding which branch feeds inner ones.
    pub(crate) fn modes(&mut self, point: &Point) -> Result<Vec<Mode>, Fault> {
        match self.run(&Point { modes: None, ..*point }) {
            // where all signs together leave reactions open, each is still known
            Err(fault) if fault.code != DEPENDENT => return Err(fault),
            _ => {}
        }
        Ok(self.tape.guards.iter().map(|r| r.map_or(Mode::Positive, |r| Mode::of(self.value(r)))).collect())
    }

    /// By value, a guard that follows from the solution is assumed positive first, and the equations are solved again until the signs agree.
    fn run(&mut self, point: &Point) -> Result<(), Fault> {
        self.check(point)?;
        if point.modes.is_some() || self.late.is_empty() {
            return self.pass(point);
        }
        let late = std::mem::take(&mut self.late);
        let registers: Vec<usize> = late.iter().filter_map(|g| self.tape.guards[*g]).map(Register::index).collect();
        registers.iter().for_each(|r| self.registers[*r] = 1.0);
        let signs = |e: &Evaluator| registers.iter().map(|r| Mode::of(e.registers[*r])).collect::<Vec<_>>();
        let mut result = Ok(());
        for _ in 0..=registers.len() {
            let before = signs(self);
            result = self.pass(point);
            if result.is_err() || signs(self) == before {
                break;
            }
        }
        self.late = late;
        result
    }

    fn pass(&mut self, point: &Point) -> Result<(), Fault> {
        self.scratch.note(point);
        let mut failed = None;
        for instruction in &self.tape.body {
            // a system without a solution leaves not-a-numbers, and what does not depend on it is still computed
            if let Err(fault) = execute(instruction, &mut self.registers, &mut self.scratch, (point, &[]), &self.tape) {
                failed = failed.or(Some(fault));
            }
        }
        failed.map_or(Ok(()), Err)
    }

    fn check(&self, point: &Point) -> Result<(), Fault> {
        let shape = &self.tape.shape;
        let modes = point.modes.map_or(shape.modes, <[Mode]>::len);
        for (have, want, en, ru) in [
            (point.states.len(), shape.states, "states", "состояний"),
            (point.accelerations.len(), shape.accelerations, "accelerations", "ускорений"),
            (modes, shape.modes, "modes", "режимов"),
        ] {
            if have < want {
                return Err(Fault::new("P008", &count(have, want, en, ru)));
            }
        }
        Ok(())
    }

    /// The first operation with finite operands and a result that is not, among those that root `i` depends on.
    fn blame(&self, point: &Point, i: usize) -> Fault {
        let root = &self.tape.roots[i];
        let mut wanted = vec![false; self.tape.registers()];
        wanted[root.register.index()] = true;
        let mut culprit = None;
        for instruction in self.tape.instructions().rev() {
            let outputs = instruction.into.index()..instruction.into.index() + instruction.operation.width();
            if !outputs.clone().any(|r| wanted[r]) {
                continue;
            }
            if let Operation::Choose { by, sides } = &instruction.operation {
                let next = decide(*by, &self.registers, point, &self.tape).map_or_else(|undecided| undecided, |mode| sides[mode.side()]);
                wanted[next.index()] = true;
                continue;
            }
            let mut sound = true;
            instruction.operation.operands(&mut |r| {
                wanted[r.index()] = true;
                sound &= self.registers[r.index()].is_finite();
            });
            if sound && outputs.clone().any(|r| !self.registers[r].is_finite()) {
                culprit = Some(instruction);
            }
        }
        let subject = Text::same(root.name.clone());
        match culprit {
            Some(instruction) => Fault::new(domain_code(&instruction.operation, &self.registers), &subject).at(instruction.origin),
            None => Fault::new(NOT_FINITE, &subject),
        }
    }
}

fn count(have: usize, want: usize, en: &str, ru: &str) -> Text {
    Text::new(format!("{have} {en} instead of {want}"), format!("{have} {ru} вместо {want}"))
}

/// Which rule an operation with finite operands and a result that is not broke.
pub(crate) fn domain_code(operation: &Operation, registers: &[f64]) -> &'static str {
    let at = |r: &Register| registers[r.index()];
    match operation {
        Operation::Divide(_, b) if at(b) == 0.0 => "P001",
        Operation::Power(a, _) if at(a) == 0.0 => "P001",
        Operation::Power(a, _) if at(a) < 0.0 => "P002",
        Operation::Unary(Unary::SquareRoot, _) => "P002",
        Operation::Unary(Unary::Log, _) => "P003",
        Operation::Unary(Unary::Asin | Unary::Acos | Unary::Acosh | Unary::Atanh, _) => "P004",
        // an input that is no number: a reaction that is not unique
        Operation::Acceleration(_) => "P014",
        _ => NOT_FINITE,
    }
}

/// Which side a choice takes, or the register that cannot decide because it holds no number.
fn decide(by: By, registers: &[f64], point: &Point, tape: &Tape) -> Result<Mode, Register> {
    let register = match (by, point.modes) {
        (By::Value(r), _) => r,
        (By::Mode(g), Some(modes)) if point.active.is_none_or(|a| a[g as usize]) => return Ok(modes[g as usize]),
        (By::Mode(g), _) => match tape.guards[g as usize] {
            Some(r) => r,
            None => return Ok(Mode::Positive),
        },
    };
    let value = registers[register.index()];
    if value.is_nan() { Err(register) } else { Ok(Mode::of(value)) }
}

/// One instruction. What can fail stands apart: the others are many and short.
#[inline(always)]
fn execute(
    instruction: &Instruction,
    registers: &mut [f64],
    scratch: &mut Scratch,
    (point, parameters): (&Point, &[f64]),
    tape: &Tape,
) -> Result<(), Fault> {
    match &instruction.operation {
        Operation::Solve { .. } | Operation::System { .. } => solve_system(instruction, registers, scratch, tape),
        _ => {
            registers[instruction.into.index()] = value(instruction, registers, (point, parameters), (tape, &scratch.off));
            Ok(())
        }
    }
}

/// The value of an operation that cannot fail; a second one is put beside it.
#[inline(always)]
fn value(instruction: &Instruction, registers: &mut [f64], (point, parameters): (&Point, &[f64]), (tape, off): (&Tape, &[f64])) -> f64 {
    let into = instruction.into.index();
    let at = |r: &Register| registers[r.index()];
    match &instruction.operation {
        Operation::Number(v) => v.0,
        Operation::Parameter(slot) => parameters[*slot as usize],
        Operation::Time => point.time,
        Operation::State(slot) => point.states[*slot as usize],
        Operation::Acceleration(slot) => point.accelerations[*slot as usize],
        Operation::Linear { constant, terms } => {
            terms.iter().fold(constant.among(registers), |sum, (c, r)| sum + c.among(registers) * at(r))
        }
        Operation::Multiply(a, b) => at(a) * at(b),
        Operation::Square(a) => at(a) * at(a),
        Operation::Divide(a, b) => at(a) / at(b),
        Operation::Power(a, p) => elementary::pow(rounding::radicand((tape, off), registers, *a), p.among(registers)),
        Operation::Unary(Unary::SquareRoot, a) => rounding::radicand((tape, off), registers, *a).sqrt(),
        Operation::Unary(f, a) => f.apply(at(a)),
        Operation::Atan2(a, b) => elementary::atan2(at(a), at(b)),
        Operation::SinCos(a) => {
            let (s, c) = elementary::sin_cos(at(a));
            registers[into + 1] = c;
            s
        }
        Operation::SinhCosh(a) => {
            let x = at(a);
            registers[into + 1] = elementary::cosh(x);
            elementary::sinh(x)
        }
        Operation::Choose { by, sides } => decide(*by, registers, point, tape).map_or(f64::NAN, |mode| at(&sides[mode.side()])),
        Operation::Solve { .. } | Operation::System { .. } => f64::NAN,
    }
}

/// The solution of a system.
fn solve_system(instruction: &Instruction, registers: &mut [f64], scratch: &mut Scratch, tape: &Tape) -> Result<(), Fault> {
    let into = instruction.into.index();
    let at = |r: &Register| registers[r.index()];
    match &instruction.operation {
        Operation::Solve { matrix, right } => {
            let Scratch { factor, solution, .. } = scratch;
            factor.load(right.len(), matrix.iter().map(|r| r.map_or(0.0, |r| registers[r.index()])));
            factor.factor().map_err(|defect| defective(tape, instruction.into, defect))?;
            solution.clear();
            solution.extend(right.iter().map(at));
            factor.solve(solution);
            registers[into..into + solution.len()].copy_from_slice(solution);
        }
        Operation::System { right, spare, .. } => {
            let Scratch { general, solution, patterns, .. } = scratch;
            let places = patterns.iter().find(|(first, _)| *first == instruction.into).map_or(&[][..], |(_, places)| places);
            general.load((right.len(), spare.as_deref()), places.iter().map(|(place, r)| (*place, registers[r.index()])));
            if let Err(defect) = general.factor() {
                registers[into..into + right.len()].fill(f64::NAN);
                return Err(defective(tape, instruction.into, defect));
            }
            solution.clear();
            solution.extend(right.iter().map(at));
            general.solve_refined(solution);
            registers[into..into + solution.len()].copy_from_slice(solution);
        }
        _ => {}
    }
    Ok(())
}

/// P005, P009 or P013 naming the unknown, by the root that it is; `into` is the first register of the system.
pub(crate) fn defective(tape: &Tape, into: Register, defect: Defect) -> Fault {
    let (code, unknown) = match defect {
        Defect::Singular(pivot) => ("P005", pivot),
        Defect::Indefinite(pivot) => ("P009", pivot),
        Defect::Dependent { unknown, .. } => (DEPENDENT, unknown),
    };
    let register = Register(into.0 + unknown as u32);
    let name = tape.roots.iter().find(|root| root.register == register);
    let fault = Fault::about(code, name.map_or_else(|| format!("#{unknown}"), |root| root.name.clone()));
    let first = tape.body.iter().find(|i| matches!(i.operation, Operation::System { .. }));
    match defect {
        // the system of the supports comes second; its rows have no numbers
        Defect::Dependent { row, unknown } if first.is_some_and(|i| i.into == into) => fault.with(Singular { row, unknown }),
        _ => fault,
    }
}

fn patterns(tape: &Tape) -> Vec<Pattern> {
    let of = |i: &Instruction| match &i.operation {
        Operation::System { matrix, .. } => Some((i.into, places(matrix).collect())),
        _ => None,
    };
    tape.instructions().filter_map(of).collect()
}

/// The places of a matrix that are not empty.
pub(crate) fn places(matrix: &[Option<Register>]) -> impl Iterator<Item = (u32, Register)> + '_ {
    (0..).zip(matrix).filter_map(|(place, r)| r.map(|r| (place, r)))
}

/// Guards whose register comes after a choice by them.
fn late(tape: &Tape) -> Vec<usize> {
    let mut late = Vec::new();
    for i in &tape.body {
        if let Operation::Choose { by: By::Mode(g), .. } = i.operation
            && tape.guards[g as usize].is_some_and(|r| r > i.into)
            && !late.contains(&(g as usize))
        {
            late.push(g as usize);
        }
    }
    late
}
