//! One node of the graph into operations.
//!
//! The value of an expression is kept as factor·rest with the factor over parameters only, as long as possible: factors meet in the
//! prologue, and a sum takes them as its coefficients. So `m l phi'^2 sin(phi)` costs the body two multiplications, and in a sum no
//! more. Division by a parameter becomes multiplication by a prologue value: x/m is x·(1/m), one rounding more than the division (an
//! error of at most 1.5 units in the last place instead of 0.5), and a x/m is x·(a/m), no more roundings than before.

use crate::builder::Builder;
use crate::{By, Coefficient, Mode, Operation, Register, Unary};
use rustc_hash::FxHashMap;
use symbolic::{Function, Rational};

/// Up to so many terms a scan is faster than a table.
const FEW: usize = 16;

/// The value of an expression.
#[derive(Clone, Copy, Debug)]
pub(super) enum Value {
    /// Over parameters only.
    Constant(Register),
    /// A body register.
    Plain(Register),
    /// prologue register · body register.
    Scaled(Register, Register),
}

impl Builder {
    /// Sorts a register into its class.
    pub(super) fn classify(&self, r: Register) -> Value {
        if self.is_constant(r) { Value::Constant(r) } else { Value::Plain(r) }
    }

    /// One register with the value.
    pub(super) fn whole(&mut self, value: Value) -> Register {
        match value {
            Value::Constant(r) | Value::Plain(r) => r,
            Value::Scaled(factor, r) => {
                let factor = self.coefficient(factor);
                self.linear(Coefficient::number(0.0), vec![(factor, r)])
            }
        }
    }

    fn scaled(&mut self, factor: Register, rest: Register) -> Value {
        match self.literal(factor) {
            Some(1.0) => self.classify(rest),
            Some(0.0) => Value::Constant(self.number(0.0)),
            _ if self.is_constant(rest) => Value::Constant(self.multiply(factor, rest)),
            _ => Value::Scaled(factor, rest),
        }
    }

    /// a·b.
    pub(super) fn times(&mut self, a: Value, b: Value) -> Value {
        self.product(1.0, &[(a, &Rational::ONE), (b, &Rational::ONE)])
    }

    /// constant + Σ factor·value. Terms with the same rest are collected, their factors added in the prologue.
    pub(super) fn sum(&mut self, constant: f64, items: &[(f64, Value)]) -> Value {
        let mut constants: Vec<(f64, Register)> = Vec::new();
        let mut groups: Vec<(Register, Vec<(f64, Register)>)> = Vec::new();
        let mut place: FxHashMap<Register, usize> = FxHashMap::default();
        let one = self.number(1.0);
        for (factor, value) in items {
            let (inner, rest) = match *value {
                Value::Constant(r) => {
                    constants.push((*factor, r));
                    continue;
                }
                Value::Plain(r) => (one, r),
                Value::Scaled(p, r) => (p, r),
            };
            let known = if items.len() > FEW { place.get(&rest).copied() } else { groups.iter().position(|g| g.0 == rest) };
            match known {
                Some(i) => groups[i].1.push((*factor, inner)),
                None => {
                    if items.len() > FEW {
                        place.insert(rest, groups.len());
                    }
                    groups.push((rest, vec![(*factor, inner)]));
                }
            }
        }
        let constant = self.constant_sum(constant, &constants);
        let mut terms: Vec<(Register, Register)> = Vec::with_capacity(groups.len());
        for (rest, factors) in groups {
            let factor = self.constant_sum(0.0, &factors);
            if self.literal(factor) != Some(0.0) {
                terms.push((factor, rest));
            }
        }
        match (&terms[..], self.literal(constant)) {
            ([], _) => Value::Constant(constant),
            ([(factor, rest)], Some(0.0)) => self.scaled(*factor, *rest),
            _ => {
                let terms = terms.iter().map(|(f, r)| (self.coefficient(*f), *r)).collect();
                let constant = self.coefficient(constant);
                Value::Plain(self.linear(constant, terms))
            }
        }
    }

    /// coefficient·Π base^exponent.
    pub(super) fn product(&mut self, coefficient: f64, items: &[(Value, &Rational)]) -> Value {
        let (mut top, mut bottom) = (Vec::new(), Vec::new());
        for (value, exponent) in items {
            self.factor(*value, exponent, &mut top, &mut bottom);
        }
        let first = self.number(coefficient);
        let mut outer = first;
        let split =
            |b: &Builder, list: Vec<Register>| -> (Vec<Register>, Vec<Register>) { list.into_iter().partition(|r| b.is_constant(*r)) };
        let (outer_top, mut top) = split(self, top);
        let (outer_bottom, mut bottom) = split(self, bottom);
        for r in outer_top {
            outer = self.multiply(outer, r);
        }
        if let Some(divisor) = self.chain(&outer_bottom) {
            outer = self.divide(outer, divisor);
        }
        top.sort_unstable();
        bottom.sort_unstable();
        let (top, bottom) = (self.chain(&top), self.chain(&bottom));
        match (top, bottom) {
            (None, None) => Value::Constant(outer),
            (Some(a), None) => self.scaled(outer, a),
            (a, Some(b)) => {
                let a = a.unwrap_or_else(|| self.number(1.0));
                let quotient = self.divide(a, b);
                self.scaled(outer, quotient)
            }
        }
    }

    fn chain(&mut self, items: &[Register]) -> Option<Register> {
        items.iter().copied().reduce(|a, b| self.multiply(a, b))
    }

    /// Sorts base^exponent into numerator and denominator.
    fn factor(&mut self, value: Value, exponent: &Rational, top: &mut Vec<Register>, bottom: &mut Vec<Register>) {
        let small = |r: &Rational| r.to_i64().filter(|n| n.unsigned_abs() <= 1024);
        let whole = small(exponent);
        let half = if whole.is_none() { small(&(exponent + exponent)) } else { None };
        let list = if exponent.is_negative() { bottom } else { top };
        match (whole, half, value) {
            (Some(n), _, Value::Scaled(factor, rest)) => {
                for r in [factor, rest] {
                    list.push(self.whole_power(r, n.unsigned_abs()));
                }
            }
            (Some(n), _, value) => {
                let base = self.whole(value);
                list.push(self.whole_power(base, n.unsigned_abs()));
            }
            // a root has no series at zero, and its cube hides how little the power misses there
            (None, Some(n), value) if n > 1 => {
                let base = self.whole(value);
                list.push(self.power(base, Coefficient::number(0.5 * n as f64)));
            }
            // x^(n/2) = (√x)^n
            (None, Some(n), value) => {
                let base = self.whole(value);
                let root = self.unary(Unary::SquareRoot, base);
                list.push(self.whole_power(root, n.unsigned_abs()));
            }
            (None, None, value) => {
                let base = self.whole(value);
                list.push(self.power(base, Coefficient::number(exponent.abs().to_f64())));
            }
        }
    }

    /// base^exponent with an exponent that is not a number: b^p for p over parameters only, else exp(p log b).
    pub(super) fn general_power(&mut self, base: Value, exponent: Value) -> Value {
        if let Value::Constant(p) = exponent {
            let (base, p) = (self.whole(base), self.coefficient(p));
            let power = self.power(base, p);
            return self.classify(power);
        }
        let base = self.whole(base);
        let log = self.unary(Unary::Log, base);
        let log = self.classify(log);
        let argument = self.times(exponent, log);
        let argument = self.whole(argument);
        let power = self.unary(Unary::Exp, argument);
        self.classify(power)
    }

    /// A smooth function.
    pub(super) fn function(&mut self, function: Function, arguments: &[Value]) -> Value {
        let x = self.whole(arguments[0]);
        let result = match function {
            Function::Sin => self.sin_cos(x).0,
            Function::Cos => self.sin_cos(x).1,
            Function::Sinh => self.sinh_cosh(x).0,
            Function::Cosh => self.sinh_cosh(x).1,
            Function::Tan => self.unary(Unary::Tan, x),
            Function::Asin => self.unary(Unary::Asin, x),
            Function::Acos => self.unary(Unary::Acos, x),
            Function::Atan => self.unary(Unary::Atan, x),
            Function::Tanh => self.unary(Unary::Tanh, x),
            Function::Asinh => self.unary(Unary::Asinh, x),
            Function::Acosh => self.unary(Unary::Acosh, x),
            Function::Atanh => self.unary(Unary::Atanh, x),
            Function::Log => self.unary(Unary::Log, x),
            Function::Atan2 => {
                let y = self.whole(arguments[1]);
                self.push(Operation::Atan2(x, y))
            }
            _ => self.unary(Unary::Exp, x),
        };
        self.classify(result)
    }

    /// sides[sign of what `by` names].
    pub(super) fn branch(&mut self, by: By, sides: [Value; 3]) -> Value {
        if let By::Value(r) = by
            && let Some(known) = self.literal(r).filter(|v| !v.is_nan())
        {
            return sides[Mode::of(known).side()];
        }
        let sides = sides.map(|v| self.whole(v));
        let chosen = self.choose(by, sides);
        self.classify(chosen)
    }
}
