//! Evaluation in machine numbers: the plain definition of what an expression means, the oracle for every faster way.

use crate::{Expr, Function, Graph, Node, SymbolId};
use rustc_hash::FxHashMap;

impl Graph {
    /// The values of `roots` when each symbol has the given value. Out-of-domain operations give the IEEE result (NaN or infinity).
    ///
    /// *Shapes*: as many numbers as roots.
    pub fn evaluate(&self, roots: &[Expr], value: &dyn Fn(SymbolId) -> f64) -> Vec<f64> {
        let mut known: FxHashMap<Expr, f64> = FxHashMap::default();
        for e in self.reachable(roots) {
            let v = self.evaluate_node(e, value, &|c| known[&c]);
            known.insert(e, v);
        }
        roots.iter().map(|r| known[r]).collect()
    }

    /// The value of one node when those of its operands are known.
    pub fn evaluate_node(&self, e: Expr, value: &dyn Fn(SymbolId) -> f64, known: &dyn Fn(Expr) -> f64) -> f64 {
        match self.node(e) {
            Node::Number(r) => r.to_f64(),
            Node::Pi => std::f64::consts::PI,
            Node::Symbol(s) => value(*s),
            Node::Sum { constant, terms } => terms.iter().fold(constant.to_f64(), |sum, (t, f)| sum + f.to_f64() * known(*t)),
            Node::Product { coefficient, factors } => {
                factors.iter().fold(coefficient.to_f64(), |p, (b, x)| p * rational_power(known(*b), x))
            }
            Node::Power { base, exponent } => known(*base).powf(known(*exponent)),
            Node::Call { function, arguments } => {
                let x = known(arguments[0]);
                function.value(x, arguments.get(1).map_or(0.0, |y| known(*y)))
            }
            Node::Switch { guard, strict, then, otherwise } => {
                let g = known(*guard);
                if g.is_nan() {
                    return f64::NAN;
                }
                known(if g > 0.0 || g == 0.0 && !strict { *then } else { *otherwise })
            }
        }
    }
}

/// x^exponent for an exact exponent.
fn rational_power(x: f64, exponent: &crate::Rational) -> f64 {
    match exponent.to_i64().and_then(|n| i32::try_from(n).ok()) {
        Some(n) => x.powi(n),
        None if exponent == &crate::Rational::HALF => x.sqrt(),
        None => x.powf(exponent.to_f64()),
    }
}

impl Function {
    /// The value at `x` (and `y` for functions of two arguments, in the order written).
    pub fn value(self, x: f64, y: f64) -> f64 {
        match self {
            Function::Sin => x.sin(),
            Function::Cos => x.cos(),
            Function::Tan => x.tan(),
            Function::Asin => x.asin(),
            Function::Acos => x.acos(),
            Function::Atan => x.atan(),
            Function::Atan2 => x.atan2(y),
            Function::Sinh => x.sinh(),
            Function::Cosh => x.cosh(),
            Function::Tanh => x.tanh(),
            Function::Asinh => x.asinh(),
            Function::Acosh => x.acosh(),
            Function::Atanh => x.atanh(),
            Function::Exp => x.exp(),
            Function::Log => x.ln(),
            Function::Abs => x.abs(),
            // sign 0 = 0, unlike f64::signum
            Function::Sign => {
                if x == 0.0 {
                    0.0
                } else {
                    x.signum()
                }
            }
            Function::Min => x.min(y),
            Function::Max => x.max(y),
        }
    }
}
