//! Evaluation in machine numbers: the plain definition of what an expression means, the oracle for every faster way.

use crate::{Edge, Expr, Function, Graph, Node, SymbolId};
use algebra::double::Double;
use algebra::elementary;
use rustc_hash::{FxBuildHasher, FxHashMap};

impl Graph {
    /// The values of `roots` when each symbol has the given value. Out-of-domain operations give the IEEE result (NaN or infinity).
    ///
    /// *Shapes*: as many numbers as roots.
    pub fn evaluate(&self, roots: &[Expr], value: &dyn Fn(SymbolId) -> f64) -> Vec<f64> {
        let order = self.reachable(roots);
        let mut known: FxHashMap<Expr, f64> = FxHashMap::with_capacity_and_hasher(order.len(), FxBuildHasher);
        for e in order {
            let v = self.evaluate_node(e, value, &|c| known[&c]);
            known.insert(e, v);
        }
        roots.iter().map(|r| known[r]).collect()
    }

    /// The values of `roots` in twice the digits; none where they need more than the four operations, or a symbol without such a value.
    pub fn evaluate_double(&self, roots: &[Expr], value: &dyn Fn(SymbolId) -> Option<Double>) -> Option<Vec<Double>> {
        let order = self.reachable(roots);
        let mut known: FxHashMap<Expr, Double> = FxHashMap::with_capacity_and_hasher(order.len(), FxBuildHasher);
        for e in order {
            let v = match self.node(e) {
                Node::Number(r) => r.to_double(),
                Node::Symbol(s) => value(*s)?,
                Node::Sum { constant, terms } => {
                    terms.iter().fold(constant.to_double(), |sum, (t, f)| sum.sum(f.to_double().times(known[t])))
                }
                Node::Product { coefficient, factors } => {
                    let mut product = coefficient.to_double();
                    for (base, exponent) in factors {
                        product = product.times(whole_power(known[base], exponent)?);
                    }
                    product
                }
                _ => return None,
            };
            known.insert(e, v);
        }
        Some(roots.iter().map(|r| known[r]).collect())
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
            Node::Power { base, exponent } => elementary::pow(known(*base), known(*exponent)),
            Node::Call { function, arguments } => {
                let x = known(arguments[0]);
                function.value(x, arguments.get(1).map_or(0.0, |y| known(*y)))
            }
            Node::Switch { guard, edge, then, otherwise } => {
                let g = known(*guard);
                if g.is_nan() {
                    return f64::NAN;
                }
                known(if g > 0.0 || g == 0.0 && *edge == Edge::Closed { *then } else { *otherwise })
            }
        }
    }
}

/// Largest exponent that is a repeated product.
const REPEATED: u64 = 16;

/// x^exponent for a small whole exponent.
fn whole_power(x: Double, exponent: &crate::Rational) -> Option<Double> {
    let n = exponent.to_i64().filter(|n| n.unsigned_abs() <= REPEATED)?;
    let power = (0..n.unsigned_abs()).fold(Double::from(1.0), |p, _| p.times(x));
    Some(if n < 0 { Double::from(1.0).over(power) } else { power })
}

/// x^exponent for an exact exponent.
fn rational_power(x: f64, exponent: &crate::Rational) -> f64 {
    match exponent.to_i64().and_then(|n| i32::try_from(n).ok()) {
        Some(n) => elementary::powi(x, n),
        None if exponent == &crate::Rational::HALF => x.sqrt(),
        None => elementary::pow(x, exponent.to_f64()),
    }
}

impl Function {
    /// The value at `x` (and `y` for functions of two arguments, in the order written).
    pub fn value(self, x: f64, y: f64) -> f64 {
        match self {
            Function::Sin => elementary::sin(x),
            Function::Cos => elementary::cos(x),
            Function::Tan => elementary::tan(x),
            Function::Asin => elementary::asin(x),
            Function::Acos => elementary::acos(x),
            Function::Atan => elementary::atan(x),
            Function::Atan2 => elementary::atan2(x, y),
            Function::Sinh => elementary::sinh(x),
            Function::Cosh => elementary::cosh(x),
            Function::Tanh => elementary::tanh(x),
            Function::Asinh => elementary::asinh(x),
            Function::Acosh => elementary::acosh(x),
            Function::Atanh => elementary::atanh(x),
            Function::Exp => elementary::exp(x),
            Function::Log => elementary::ln(x),
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
