//! Value numbering: equal operations get one value; operations on literals are carried out at once.

use crate::{By, Coefficient, Instruction, Operation, Real, Register, Tape, Unary};
use algebra::elementary;
use rustc_hash::FxHashMap;
use symbolic::Expr;

/// A tape under construction. Values are registers in order of creation, both sections mixed; [`Builder::finish`] separates them.
#[derive(Default)]
pub(crate) struct Builder {
    instructions: Vec<Instruction>,
    /// Whether a register depends on parameters only.
    constant: Vec<bool>,
    /// The number that a register is known to hold.
    literal: Vec<Option<f64>>,
    seen: FxHashMap<Operation, Register>,
    /// The expression that is being lowered.
    pub(crate) origin: Option<Expr>,
}

impl Builder {
    /// Whether the value depends on parameters only.
    pub(crate) fn is_constant(&self, r: Register) -> bool {
        self.constant[r.index()]
    }

    /// The number that the value is known to be.
    pub(crate) fn literal(&self, r: Register) -> Option<f64> {
        self.literal[r.index()]
    }

    pub(crate) fn number(&mut self, value: f64) -> Register {
        // -0 and 0 are one constant
        self.push(Operation::Number(Real(value + 0.0)))
    }

    /// The register as a coefficient, as a literal when known.
    pub(crate) fn coefficient(&self, r: Register) -> Coefficient {
        self.literal(r).map_or(Coefficient::Register(r), Coefficient::number)
    }

    pub(crate) fn multiply(&mut self, a: Register, b: Register) -> Register {
        match (self.literal(a), self.literal(b)) {
            (Some(x), Some(y)) => self.number(x * y),
            (Some(1.0), _) => b,
            (_, Some(1.0)) => a,
            (Some(0.0), _) | (_, Some(0.0)) => self.number(0.0),
            _ if a == b => self.push(Operation::Square(a)),
            _ => self.push(Operation::Multiply(a.min(b), a.max(b))),
        }
    }

    pub(crate) fn divide(&mut self, a: Register, b: Register) -> Register {
        match (self.literal(a), self.literal(b)) {
            (Some(x), Some(y)) if y != 0.0 => self.number(x / y),
            (_, Some(1.0)) => a,
            _ => self.push(Operation::Divide(a, b)),
        }
    }

    pub(crate) fn unary(&mut self, f: Unary, a: Register) -> Register {
        match self.literal(a).map(|x| f.apply(x)) {
            Some(value) if value.is_finite() => self.number(value),
            _ => self.push(Operation::Unary(f, a)),
        }
    }

    pub(crate) fn power(&mut self, a: Register, p: Coefficient) -> Register {
        match (self.literal(a), p) {
            (Some(x), Coefficient::Number(p)) if elementary::pow(x, p.0).is_finite() => self.number(elementary::pow(x, p.0)),
            _ => self.push(Operation::Power(a, p)),
        }
    }

    /// a^n for n >= 1 by squarings: x^5 = x (x²)².
    pub(crate) fn whole_power(&mut self, a: Register, n: u64) -> Register {
        let (mut result, mut square, mut rest) = (None, a, n);
        loop {
            if rest & 1 == 1 {
                result = Some(result.map_or(square, |r| self.multiply(r, square)));
            }
            rest >>= 1;
            if rest == 0 {
                return result.unwrap_or(a);
            }
            square = self.multiply(square, square);
        }
    }

    /// sin a, cos a.
    pub(crate) fn sin_cos(&mut self, a: Register) -> (Register, Register) {
        if let Some(x) = self.literal(a) {
            return (self.number(elementary::sin(x)), self.number(elementary::cos(x)));
        }
        self.pair(Operation::SinCos(a))
    }

    /// sinh a, cosh a.
    pub(crate) fn sinh_cosh(&mut self, a: Register) -> (Register, Register) {
        self.pair(Operation::SinhCosh(a))
    }

    fn pair(&mut self, operation: Operation) -> (Register, Register) {
        let first = self.push(operation);
        (first, Register(first.0 + 1))
    }

    pub(crate) fn choose(&mut self, by: By, sides: [Register; 3]) -> Register {
        if sides[0] == sides[1] && sides[1] == sides[2] {
            return sides[0];
        }
        self.push(Operation::Choose { by, sides })
    }

    /// constant + Σ factor·value of values that depend on parameters only.
    pub(crate) fn constant_sum(&mut self, constant: f64, items: &[(f64, Register)]) -> Register {
        let mut known = constant;
        let mut terms: Vec<(Coefficient, Register)> = Vec::with_capacity(items.len());
        for (factor, r) in items {
            match self.literal(*r) {
                Some(value) => known += factor * value,
                None => terms.push((Coefficient::number(*factor), *r)),
            }
        }
        self.linear(Coefficient::number(known), terms)
    }

    /// constant + Σ coefficient·register; the registers of the terms are distinct.
    pub(crate) fn linear(&mut self, constant: Coefficient, mut terms: Vec<(Coefficient, Register)>) -> Register {
        let number = |c: Coefficient| if let Coefficient::Number(v) = c { Some(v.0) } else { None };
        terms.retain(|(c, _)| number(*c) != Some(0.0));
        match (number(constant), &terms[..]) {
            (Some(value), []) => return self.number(value),
            (None, []) => {
                if let Coefficient::Register(r) = constant {
                    return r;
                }
            }
            (Some(0.0), [(c, r)]) if number(*c) == Some(1.0) => return *r,
            _ => {}
        }
        self.push(Operation::Linear { constant, terms: terms.into() })
    }

    /// The value of an operation, shared with an equal one.
    pub(crate) fn push(&mut self, operation: Operation) -> Register {
        if let Some(&known) = self.seen.get(&operation) {
            return known;
        }
        let into = Register(self.constant.len() as u32);
        let mut constant = !matches!(operation, Operation::Time | Operation::State(_) | Operation::Acceleration(_))
            && !matches!(operation, Operation::Solve { .. } | Operation::System { .. } | Operation::Choose { by: By::Mode(_), .. });
        operation.operands(&mut |r| constant &= self.constant[r.index()]);
        let literal = if let Operation::Number(v) = operation { Some(v.0) } else { None };
        for _ in 0..operation.width() {
            self.constant.push(constant);
            self.literal.push(literal);
        }
        self.seen.insert(operation.clone(), into);
        self.instructions.push(Instruction { into, operation, origin: self.origin });
        into
    }

    /// Marks what the roots need; a guard counts when a choice that is needed goes by it, or when it bounds one that counts. The others are
    /// dropped from the tape.
    fn wanted(&self, tape: &mut Tape) -> Vec<bool> {
        let mut wanted = vec![false; self.constant.len()];
        let mut used = vec![false; tape.guards.len()];
        tape.roots.iter().for_each(|r| wanted[r.register.index()] = true);
        loop {
            for i in self.instructions.iter().rev() {
                if !(0..i.operation.width()).any(|k| wanted[i.into.index() + k]) {
                    continue;
                }
                i.operation.operands(&mut |r| wanted[r.index()] = true);
                if let Operation::Choose { by: By::Mode(g), .. } = i.operation {
                    used[g as usize] = true;
                }
            }
            tape.bounds.iter().for_each(|b| used[b.guard as usize] |= used[b.of as usize]);
            // the value of a guard may follow the choice that goes by it
            let mut again = false;
            for register in tape.guards.iter().zip(&used).filter(|(_, used)| **used).filter_map(|(guard, _)| *guard) {
                again |= !std::mem::replace(&mut wanted[register.index()], true);
            }
            if !again {
                break;
            }
        }
        tape.guards.iter_mut().zip(used).filter(|(_, used)| !used).for_each(|(guard, _)| *guard = None);
        wanted
    }

    /// Separates the sections, drops what no root needs, numbers the registers.
    pub(crate) fn finish(self, mut tape: Tape) -> Tape {
        let wanted = self.wanted(&mut tape);
        let mut names = vec![Register(0); self.constant.len()];
        let mut next = 0;
        for section in [true, false] {
            for i in self.instructions.iter().filter(|i| self.constant[i.into.index()] == section) {
                let width = i.operation.width();
                if !(0..width).any(|k| wanted[i.into.index() + k]) {
                    continue;
                }
                let into = Register(next);
                for k in 0..width {
                    names[i.into.index() + k] = Register(next);
                    next += 1;
                }
                let operation = i.operation.rename(&|r| names[r.index()]);
                let list = if section { &mut tape.prologue } else { &mut tape.body };
                list.push(Instruction { into, operation, origin: i.origin });
            }
        }
        tape.roots.iter_mut().for_each(|r| r.register = names[r.register.index()]);
        tape.guards.iter_mut().flatten().for_each(|r| *r = names[r.index()]);
        tape
    }
}
