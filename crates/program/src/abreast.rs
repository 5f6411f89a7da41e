//! The interpreter for several points of one tape at once.
//!
//! A check that integrates along a step asks for the same tape at many points that do not depend on one another. Register by register each operation is done for all of them:
//! it is looked up once, and its loop over the points is what vector registers are for. Each point sees the operations of [`Evaluator`] in their order, so that its
//! results have the same bits, on every processor.
//!
//! Not every tape goes this way. Systems have pivots that differ from point to point, and a root or power near zero depends on the points that came before it.

use crate::{By, Coefficient, Evaluator, Instruction, Mode, Operation, Register, Tape, Unary};
use algebra::elementary;
use std::sync::Arc;

/// Points evaluated at once.
pub const ABREAST: usize = 8;

/// One number for each of [`ABREAST`] points.
pub type Lanes = [f64; ABREAST];

/// Points at which a tape is evaluated at once. Inputs that the tape does not read may be empty.
#[derive(Clone, Copy, Debug)]
pub struct Places<'a> {
    /// How many of the points are asked for, the first ones.
    pub count: usize,
    /// Time.
    pub times: &'a Lanes,
    /// x = [q; q'; s], by state.
    pub states: &'a [Lanes],
    /// q'', then all reactions.
    pub accelerations: &'a [Lanes],
    /// Modes of the guards, the same at all points.
    pub modes: &'a [Mode],
    /// Which of the modes hold ([`crate::Bound::active`]); the other guards are decided by value.
    pub active: &'a [bool],
}

/// A tape with its parameters and registers for several points.
#[derive(Clone, Debug)]
pub struct Abreast {
    tape: Arc<Tape>,
    constants: Vec<f64>,
    registers: Vec<Lanes>,
}

impl Abreast {
    /// With the parameters of an evaluator; none where the tape has an operation that has to be done point by point.
    pub fn new(evaluator: &Evaluator) -> Option<Abreast> {
        let tape = evaluator.tape();
        if !tape.body.iter().all(|instruction| goes_abreast(&instruction.operation)) {
            return None;
        }
        let constants: Vec<f64> = (0..tape.constants()).map(|r| evaluator.value(Register(r as u32))).collect();
        let mut registers = vec![[0.0; ABREAST]; tape.registers()];
        registers.iter_mut().zip(&constants).for_each(|(lanes, value)| *lanes = [*value; ABREAST]);
        Some(Abreast { tape: Arc::clone(tape), constants, registers })
    }

    /// Evaluates all roots at the points, bit for bit as [`Evaluator::evaluate`] does at each; false when a root is not finite at one of them, or inputs are missing: who then asks
    /// for the points one by one is told what is wrong.
    #[must_use]
    pub fn evaluate(&mut self, places: &Places) -> bool {
        let shape = &self.tape.shape;
        let enough = places.states.len() >= shape.states && places.accelerations.len() >= shape.accelerations;
        if !enough || places.modes.len() < shape.modes || places.active.len() < shape.modes {
            return false;
        }
        for instruction in &self.tape.body {
            execute(instruction, &mut self.registers, (places, &self.constants), &self.tape.guards);
        }
        let count = places.count.min(ABREAST);
        self.tape.roots.iter().all(|root| self.registers[root.register.index()][..count].iter().all(|value| value.is_finite()))
    }

    /// Values of a root at the points of the last evaluation.
    pub fn root(&self, i: usize) -> &Lanes {
        &self.registers[self.tape.roots[i].register.index()]
    }
}

fn goes_abreast(operation: &Operation) -> bool {
    !matches!(
        operation,
        Operation::Solve { .. }
            | Operation::System { .. }
            | Operation::Power(..)
            | Operation::Unary(Unary::SquareRoot, _)
            | Operation::Parameter(_)
    )
}

/// One instruction at all points.
#[inline(always)]
fn execute(instruction: &Instruction, registers: &mut [Lanes], (places, constants): (&Places, &[f64]), guards: &[Option<Register>]) {
    let into = instruction.into.index();
    let at = |r: &Register| registers[r.index()];
    let count = places.count;
    let result = match &instruction.operation {
        Operation::Number(v) => [v.0; ABREAST],
        Operation::Time => *places.times,
        Operation::State(slot) => places.states[*slot as usize],
        Operation::Acceleration(slot) => places.accelerations[*slot as usize],
        Operation::Linear { constant, terms } => linear(*constant, terms, registers, constants),
        Operation::Multiply(a, b) => pairs(&at(a), &at(b), |a, b| a * b),
        Operation::Square(a) => at(a).map(|a| a * a),
        Operation::Divide(a, b) => pairs(&at(a), &at(b), |a, b| a / b),
        Operation::Unary(f, a) => few(&at(a), count, |x| f.apply(x)),
        Operation::Atan2(a, b) => {
            let (y, x) = (at(a), at(b));
            std::array::from_fn(|lane| if lane < count { elementary::atan2(y[lane], x[lane]) } else { 0.0 })
        }
        Operation::SinCos(a) => {
            let (mut sines, mut cosines) = ([0.0; ABREAST], [0.0; ABREAST]);
            for (lane, x) in at(a).iter().enumerate().take(count) {
                (sines[lane], cosines[lane]) = elementary::sin_cos(*x);
            }
            registers[into + 1] = cosines;
            sines
        }
        Operation::SinhCosh(a) => {
            let x = at(a);
            registers[into + 1] = few(&x, count, elementary::cosh);
            few(&x, count, elementary::sinh)
        }
        Operation::Choose { by, sides } => chosen((*by, sides), registers, places, guards),
        // refused by `Abreast::new`
        _ => [f64::NAN; ABREAST],
    };
    registers[into] = result;
}

#[inline(always)]
fn pairs(a: &Lanes, b: &Lanes, f: impl Fn(f64, f64) -> f64) -> Lanes {
    std::array::from_fn(|lane| f(a[lane], b[lane]))
}

/// A function that costs much: at the points that are asked for.
#[inline(always)]
fn few(x: &Lanes, count: usize, f: impl Fn(f64) -> f64) -> Lanes {
    std::array::from_fn(|lane| if lane < count { f(x[lane]) } else { 0.0 })
}

#[inline(always)]
fn linear(constant: Coefficient, terms: &[(Coefficient, Register)], registers: &[Lanes], constants: &[f64]) -> Lanes {
    let mut sum = [constant.among(constants); ABREAST];
    for (c, r) in terms {
        let (c, x) = (c.among(constants), &registers[r.index()]);
        for lane in 0..ABREAST {
            sum[lane] += c * x[lane];
        }
    }
    sum
}

/// The side that each point takes; not a number where what decides is none.
fn chosen((by, sides): (By, &[Register; 3]), registers: &[Lanes], places: &Places, guards: &[Option<Register>]) -> Lanes {
    let side = |mode: Mode| registers[sides[mode.side()].index()];
    let decides = match by {
        By::Value(r) => Some(r),
        By::Mode(g) if places.active[g as usize] => return side(places.modes[g as usize]),
        By::Mode(g) => guards[g as usize],
    };
    let Some(decides) = decides else { return side(Mode::Positive) };
    let values = registers[decides.index()];
    std::array::from_fn(|lane| if values[lane].is_nan() { f64::NAN } else { side(Mode::of(values[lane]))[lane] })
}
