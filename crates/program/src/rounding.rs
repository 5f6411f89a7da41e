//! How far rounding can have moved the value of a register: running error analysis along a tape.
//!
//! A root of a difference that vanishes (the speed of an instantaneous centre, the depth of a contact at its first touch) is taken of a few units in
//! the last place, of either sign. Whether a negative radicand is rounding or a formula out of its domain is decided by this bound and not by a fixed
//! small number. Each operation moves the errors of its operands by its derivative and adds its own:
//!
//! ```text
//! e(a + b) = e_a + e_b + u |a + b|      e(a b) = |a| e_b + |b| e_a + u |a b|      e(f(a)) = |f'(a)| e_a + u |f(a)|
//! ```
//!
//! *Source*: N. J. Higham, Accuracy and Stability of Numerical Algorithms, section 3.3.

use crate::{Coefficient, Operation, Register, Tape, Unary};
use algebra::elementary;

/// Rounding of one operation; a few units, because libraries' functions have some.
const UNIT: f64 = 2.0 * f64::EPSILON;
/// Bound of the solution of a system relative to its largest component: the linear solve loses some digits.
const SOLVED: f64 = 1e4 * f64::EPSILON;
/// What it usually is.
const USUAL: f64 = 256.0 * f64::EPSILON;
/// Slack of the whole bound: states come from integration and assembly, which leave them a few units off.
const SLACK: f64 = 8.0;

/// The radicand in a register, zero when it is negative by no more than rounding and by what the states are off.
pub(crate) fn radicand((tape, states): (&Tape, &[f64]), registers: &[f64], register: Register) -> f64 {
    let value = registers[register.index()];
    if value >= 0.0 || value.is_nan() {
        return value;
    }
    let given = Given { states, ..Given::default() };
    let bound = SLACK * errors(tape, registers, register.index() + 1, &given)[register.index()];
    if -value <= bound { 0.0 } else { value }
}

/// Bound of the rounding in a register, whose value and those before it are known.
pub(crate) fn bound(tape: &Tape, registers: &[f64], register: Register) -> f64 {
    SLACK * errors(tape, registers, register.index() + 1, &Given::default())[register.index()]
}

/// How the solution of a system counts.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
enum Solved {
    /// Each component may be off by a share of the largest: a bound.
    #[default]
    Largest,
    /// The same by a smaller share: what rounding usually does.
    Usual,
}

/// Errors of what a tape is given, beyond their rounding to one number.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Given<'e> {
    solved: Solved,
    /// Of the states.
    pub(crate) states: &'e [f64],
    /// Of accelerations and reactions.
    pub(crate) accelerations: &'e [f64],
}

impl<'e> Given<'e> {
    /// States and accelerations with these errors, solutions of systems with their usual errors.
    pub(crate) fn usual(states: &'e [f64], accelerations: &'e [f64]) -> Given<'e> {
        Given { solved: Solved::Usual, states, accelerations }
    }
}

/// Rounding in all registers.
pub(crate) fn bounds(tape: &Tape, registers: &[f64], given: &Given) -> Vec<f64> {
    let mut errors = errors(tape, registers, registers.len(), given);
    errors.iter_mut().for_each(|e| *e *= SLACK);
    errors
}

/// Errors of the first `count` registers.
fn errors(tape: &Tape, registers: &[f64], count: usize, given: &Given) -> Vec<f64> {
    let mut errors = vec![0.0; count];
    for instruction in tape.instructions().take_while(|i| i.into.index() < count) {
        let first = instruction.into.index();
        let error = match instruction.operation {
            Operation::State(slot) => given.states.get(slot as usize).copied().unwrap_or(0.0),
            Operation::Acceleration(slot) => given.accelerations.get(slot as usize).copied().unwrap_or(0.0),
            Operation::Solve { ref matrix, ref right } | Operation::System { ref matrix, ref right, .. }
                if given.solved == Solved::Usual =>
            {
                let of = |r: Register| [registers[r.index()].abs(), errors[r.index()]];
                let share = share(matrix.iter().flatten().map(|r| of(*r))) + share(right.iter().map(|r| of(*r)));
                (USUAL + share) * (first..first + right.len()).fold(0.0, |m: f64, k| m.max(registers[k].abs()))
            }
            _ => error(&instruction.operation, first, registers, &errors),
        };
        for k in first..(first + instruction.operation.width()).min(errors.len()) {
            errors[k] = error + UNIT * registers[k].abs();
        }
    }
    errors
}

/// Largest error of these numbers relative to the largest of them: what a system makes of it in its solution, its condition apart.
fn share(numbers: impl Iterator<Item = [f64; 2]>) -> f64 {
    let [size, error] = numbers.fold([0.0_f64; 2], |[size, error], [v, e]| [size.max(v), error.max(e)]);
    if size > 0.0 { error / size } else { 0.0 }
}

/// What the operands' errors make in the result.
fn error(operation: &Operation, into: usize, registers: &[f64], errors: &[f64]) -> f64 {
    let (x, e) = (|r: &Register| registers[r.index()], |r: &Register| errors[r.index()]);
    match operation {
        Operation::Linear { constant, terms } => {
            let factor = |c: &Coefficient| c.among(registers);
            let start = UNIT * factor(constant).abs();
            terms.iter().fold(start, |sum, (c, r)| sum + factor(c).abs() * (e(r) + UNIT * x(r).abs()))
        }
        Operation::Multiply(a, b) => x(a).abs() * e(b) + x(b).abs() * e(a),
        Operation::Square(a) => 2.0 * x(a).abs() * e(a) + e(a) * e(a),
        Operation::Divide(a, b) => (e(a) + x(a).abs() * e(b) / x(b).abs()) / x(b).abs(),
        Operation::Power(a, p) => {
            let p = p.among(registers);
            if x(a) > e(a) { (p * registers[into] / x(a)).abs() * e(a) } else { elementary::pow(e(a), p) }
        }
        Operation::Unary(f, a) => unary(*f, x(a), e(a), registers[into]),
        Operation::Atan2(a, b) => (e(a) + e(b)) / elementary::hypot(x(a), x(b)),
        Operation::SinCos(a) => e(a),
        Operation::SinhCosh(a) => elementary::cosh(x(a)) * e(a),
        Operation::Choose { sides, .. } => {
            // the sides that were not taken say nothing: 10¹⁶ before a switch would hide 7 behind it
            let taken = |side: &&Register| x(side).to_bits() == registers[into].to_bits();
            let known = sides.iter().any(|side| taken(&side));
            let counted = sides.iter().filter(|side| !known || taken(side));
            counted.map(e).filter(|e| e.is_finite()).fold(0.0, f64::max)
        }
        Operation::Solve { right, .. } | Operation::System { right, .. } => {
            SOLVED * (into..into + right.len()).fold(0.0, |m: f64, k| m.max(registers[k].abs()))
        }
        _ => 0.0,
    }
}

fn unary(f: Unary, x: f64, e: f64, value: f64) -> f64 {
    match f {
        Unary::SquareRoot => (e / (2.0 * value)).min(e.sqrt()),
        Unary::Exp => value * e,
        Unary::Log => e / x.abs(),
        Unary::Tan => (1.0 + value * value) * e,
        Unary::Asin | Unary::Acos => (e / ((1.0 - x) * (1.0 + x)).abs().sqrt()).min(e.sqrt()),
        Unary::Atan | Unary::Tanh | Unary::Asinh => e,
        Unary::Acosh => (e / ((x - 1.0) * (x + 1.0)).abs().sqrt()).min((2.0 * e).sqrt()),
        Unary::Atanh => e / ((1.0 - x) * (1.0 + x)).abs(),
    }
}
