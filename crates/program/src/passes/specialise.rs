//! Specialisation: a tape for one set of parameters.
//!
//! Every value of the prologue becomes a literal, and the body is numbered anew with the rules of lowering: 0·x = 0, 1·x = x, c·x is a scaling
//! instead of a product, x + 0 = x, equal values are one. What no root needs any more is dropped. A parameter that happens to be zero (an
//! eccentricity, a damping) then costs nothing, neither its products nor the sines of an angle that only it multiplies.
//!
//! The motion is the same up to rounding: constants are added in another order. At a state where a factor of such a zero is not finite
//! the specialised tape has the limit 0 where the original has no value.

use crate::builder::Builder;
use crate::verify::verified;
use crate::{By, Coefficient, Evaluator, Fault, Mode, Operation, Register, Tape};
use std::sync::Arc;

/// Whole exponents up to this are multiplied out.
const WHOLE: f64 = 1024.0;

/// The tape with these numbers for its parameters; it still takes (and ignores) a list of parameters of the same length.
///
/// A tape with a constant that is not finite is returned as it is, so that the fault is reported by the operation that caused it.
///
/// *Errors*: P008 for a wrong number of parameters.
pub fn specialise(tape: &Arc<Tape>, parameters: &[f64]) -> Result<Tape, Fault> {
    let evaluator = Evaluator::new(tape, parameters)?;
    let constants: Vec<f64> = (0..tape.constants()).map(|r| evaluator.value(Register(r as u32))).collect();
    if constants.iter().any(|value| !value.is_finite()) {
        return Ok(Tape::clone(tape));
    }
    let needed = needed(tape);
    let mut rewriting =
        Rewriting { builder: Builder::default(), names: vec![Register(0); tape.registers()], constants, places: Vec::new() };
    for i in (0..rewriting.constants.len()).filter(|i| needed[*i]) {
        rewriting.names[i] = rewriting.builder.number(rewriting.constants[i]);
    }
    for instruction in &tape.body {
        let (into, width) = (instruction.into.index(), instruction.operation.width());
        if !needed[into..into + width].contains(&true) {
            continue;
        }
        rewriting.builder.origin = instruction.origin;
        let [first, second] = rewriting.operation(&instruction.operation);
        rewriting.names[into] = first;
        rewriting.names[into + 1..into + width].iter_mut().enumerate().for_each(|(k, name)| *name = Register(second.0 + k as u32));
    }
    let mut result = Tape {
        name: tape.name.clone(),
        shape: tape.shape,
        prologue: Vec::new(),
        body: Vec::new(),
        guards: tape.guards.clone(),
        bounds: tape.bounds.clone(),
        roots: tape.roots.clone(),
    };
    result.roots.iter_mut().for_each(|r| r.register = rewriting.name(r.register));
    result.guards.iter_mut().flatten().for_each(|r| *r = rewriting.name(*r));
    verified(rewriting.builder.finish(result))
}

/// What roots and guards follow from.
fn needed(tape: &Tape) -> Vec<bool> {
    let mut needed = vec![false; tape.registers()];
    let ends = tape.roots.iter().map(|root| root.register).chain(tape.guards.iter().flatten().copied());
    ends.for_each(|r| needed[r.index()] = true);
    for instruction in tape.body.iter().rev() {
        let into = instruction.into.index();
        if needed[into..into + instruction.operation.width()].contains(&true) {
            instruction.operation.operands(&mut |r| needed[r.index()] = true);
        }
    }
    needed
}

/// The same tape with only these of its roots, in this order, before dead code is dropped by [`specialise`].
pub fn select(tape: &Tape, roots: &[usize]) -> Tape {
    let roots = roots.iter().filter_map(|&i| tape.roots.get(i).cloned()).collect();
    Tape { roots, ..tape.clone() }
}

struct Rewriting {
    builder: Builder,
    /// New register of each old one.
    names: Vec<Register>,
    constants: Vec<f64>,
    /// Where a register stands among the terms of a sum, if it does.
    places: Vec<usize>,
}

impl Rewriting {
    fn name(&self, r: Register) -> Register {
        self.names[r.index()]
    }

    fn number(&self, c: Coefficient) -> f64 {
        match c {
            Coefficient::Number(value) => value.0,
            Coefficient::Register(r) => self.constants[r.index()],
        }
    }

    /// The new registers of an operation's first two results; more follow the second.
    fn operation(&mut self, operation: &Operation) -> [Register; 2] {
        let one = match operation {
            Operation::Linear { constant, terms } => {
                let terms: Vec<(f64, Register)> = terms.iter().map(|(c, r)| (self.number(*c), self.name(*r))).collect();
                let constant = self.number(*constant);
                self.linear(constant, &terms)
            }
            Operation::Multiply(a, b) => self.multiply(self.name(*a), self.name(*b)),
            Operation::Square(a) => self.multiply(self.name(*a), self.name(*a)),
            Operation::Divide(a, b) => self.divide(self.name(*a), self.name(*b)),
            Operation::Power(a, p) => self.power(self.name(*a), self.number(*p)),
            Operation::Unary(f, a) => self.builder.unary(*f, self.name(*a)),
            Operation::SinCos(a) => {
                let (sine, cosine) = self.builder.sin_cos(self.name(*a));
                return [sine, cosine];
            }
            Operation::Choose { by, sides } => self.choose(*by, sides),
            Operation::Solve { matrix, right } => {
                let (matrix, right) = self.system(matrix, right);
                self.builder.push(Operation::Solve { matrix, right })
            }
            Operation::System { matrix, right, spare } => {
                let (matrix, right) = self.system(matrix, right);
                self.builder.push(Operation::System { matrix, right, spare: spare.clone() })
            }
            other => self.builder.push(other.rename(&|r| self.names[r.index()])),
        };
        [one, Register(one.0 + 1)]
    }

    /// Entries that are zero for these parameters are left out.
    fn system(&self, matrix: &[Option<Register>], right: &[Register]) -> (Box<[Option<Register>]>, Box<[Register]>) {
        let entry = |r: &Option<Register>| r.map(|r| self.name(r)).filter(|r| self.builder.literal(*r) != Some(0.0));
        (matrix.iter().map(entry).collect(), right.iter().map(|r| self.name(*r)).collect())
    }

    /// constant + Σ c·r with literals added to the constant and equal registers collected.
    fn linear(&mut self, constant: f64, terms: &[(f64, Register)]) -> Register {
        let mut known = constant;
        let mut kept: Vec<(f64, Register)> = Vec::with_capacity(terms.len());
        for &(c, r) in terms {
            if let Some(value) = self.builder.literal(r) {
                known += c * value;
                continue;
            }
            if self.places.len() <= r.index() {
                self.places.resize(r.index() + 1, 0);
            }
            let place = &mut self.places[r.index()];
            match kept.get_mut(*place).filter(|term| term.1 == r) {
                Some(term) => term.0 += c,
                None => {
                    *place = kept.len();
                    kept.push((c, r));
                }
            }
        }
        let terms = kept.into_iter().map(|(c, r)| (Coefficient::number(c), r)).collect();
        self.builder.linear(Coefficient::number(known + 0.0), terms)
    }

    fn multiply(&mut self, a: Register, b: Register) -> Register {
        match (self.builder.literal(a), self.builder.literal(b)) {
            (Some(c), None) => self.linear(0.0, &[(c, b)]),
            (None, Some(c)) => self.linear(0.0, &[(c, a)]),
            _ => self.builder.multiply(a, b),
        }
    }

    fn divide(&mut self, a: Register, b: Register) -> Register {
        if self.builder.literal(a) == Some(0.0) && self.builder.literal(b) != Some(0.0) {
            return self.builder.number(0.0);
        }
        self.builder.divide(a, b)
    }

    /// Whole exponents by multiplication: that has a Taylor series at 0 too.
    fn power(&mut self, a: Register, p: f64) -> Register {
        if p == 0.0 {
            return self.builder.number(1.0);
        }
        if p.fract() != 0.0 || p.abs() > WHOLE {
            return self.builder.power(a, Coefficient::number(p));
        }
        let power = self.builder.whole_power(a, p.abs() as u64);
        let one = self.builder.number(1.0);
        if p > 0.0 { power } else { self.builder.divide(one, power) }
    }

    fn choose(&mut self, by: By, sides: &[Register; 3]) -> Register {
        let sides = sides.map(|r| self.name(r));
        match by {
            By::Value(r) => match self.builder.literal(self.name(r)) {
                Some(value) => sides[Mode::of(value).side()],
                None => self.builder.choose(By::Value(self.name(r)), sides),
            },
            By::Mode(_) => self.builder.choose(by, sides),
        }
    }
}
