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

    /// The values of `roots` in twice the digits; none where a symbol has no such value, or where the result is no number.
    pub fn evaluate_double(&self, roots: &[Expr], value: &dyn Fn(SymbolId) -> Option<Double>) -> Option<Vec<Double>> {
        let order = self.reachable(roots);
        let mut known: FxHashMap<Expr, Double> = FxHashMap::with_capacity_and_hasher(order.len(), FxBuildHasher);
        for e in order {
            let v = self.double_node(e, value, &|c| known[&c])?;
            known.insert(e, v);
        }
        let found: Vec<Double> = roots.iter().map(|r| known[r]).collect();
        found.iter().all(|v| v.round().is_finite()).then_some(found)
    }

    fn double_node(&self, e: Expr, value: &dyn Fn(SymbolId) -> Option<Double>, known: &dyn Fn(Expr) -> Double) -> Option<Double> {
        Some(match self.node(e) {
            Node::Number(r) => r.to_double(),
            Node::Pi => Double::pi(),
            Node::Symbol(s) => value(*s)?,
            Node::Sum { constant, terms } => terms.iter().fold(constant.to_double(), |sum, (t, f)| sum.sum(f.to_double().times(known(*t)))),
            Node::Product { coefficient, factors } => {
                factors.iter().fold(coefficient.to_double(), |p, (b, x)| p.times(exact_power(known(*b), x)))
            }
            Node::Power { base, exponent } => known(*base).pow(known(*exponent)),
            Node::Call { function, arguments } => {
                function.double(known(arguments[0]), arguments.get(1).map_or(Double::default(), |y| known(*y)))
            }
            Node::Switch { guard, edge, then, otherwise } => {
                let g = known(*guard).round();
                if g.is_nan() {
                    return None;
                }
                known(if g > 0.0 || g == 0.0 && *edge == Edge::Closed { *then } else { *otherwise })
            }
        })
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

/// x^exponent for an exact exponent, in twice the digits.
fn exact_power(x: Double, exponent: &crate::Rational) -> Double {
    let whole = |x: Double, n: i64| {
        let power = (0..n.unsigned_abs()).fold(Double::from(1.0), |p, _| p.times(x));
        if n < 0 { Double::from(1.0).over(power) } else { power }
    };
    let twice = exponent + exponent;
    match (exponent.to_i64(), twice.to_i64()) {
        (Some(n), _) if n.unsigned_abs() <= REPEATED => whole(x, n),
        (Some(n), _) => {
            let size = x.abs().pow(exponent.to_double());
            if n % 2 != 0 && x.round() < 0.0 { size.negated() } else { size }
        }
        (None, Some(n)) if n.unsigned_abs() <= REPEATED && x.round() >= 0.0 => whole(x.root(), n),
        _ => x.pow(exponent.to_double()),
    }
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
    /// The value in twice the digits.
    fn double(self, x: Double, y: Double) -> Double {
        let smaller = x.less(y).round() <= 0.0;
        match self {
            Function::Sin => x.sin_cos().0,
            Function::Cos => x.sin_cos().1,
            Function::Tan => {
                let (s, c) = x.sin_cos();
                s.over(c)
            }
            Function::Asin => x.asin(),
            Function::Acos => x.acos(),
            Function::Atan => x.atan(),
            Function::Atan2 => x.atan2(y),
            Function::Sinh => x.sinh_cosh().0,
            Function::Cosh => x.sinh_cosh().1,
            Function::Tanh => {
                let (s, c) = x.sinh_cosh();
                s.over(c)
            }
            Function::Asinh => x.asinh(),
            Function::Acosh => x.acosh(),
            Function::Atanh => x.atanh(),
            Function::Exp => x.exp(),
            Function::Log => x.ln(),
            Function::Abs => x.abs(),
            Function::Sign => Double::from(Function::Sign.value(x.round(), 0.0)),
            Function::Min => {
                if smaller {
                    x
                } else {
                    y
                }
            }
            Function::Max => {
                if smaller {
                    y
                } else {
                    x
                }
            }
        }
    }

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

#[cfg(test)]
mod tests {
    use super::*;

    /// Every function in twice the digits is, rounded, the one in single digits.
    #[test]
    fn twice_the_digits_are_the_same_functions() {
        for (function, name) in Function::ALL {
            for (x, y) in [(0.3, 0.7), (0.9, -0.2), (-0.4, -0.8), (0.0, 1.0)] {
                let x = if matches!(function, Function::Acosh) { 1.5 + x } else { x };
                let x = if matches!(function, Function::Log) { 1.5 + x } else { x };
                let (found, single) = (function.double(Double::from(x), Double::from(y)).round(), function.value(x, y));
                // two units of the last place
                assert!((found - single).abs() <= 2.0 * f64::EPSILON * single.abs(), "{name}({x}, {y}): {found:?} {single:?}");
            }
        }
    }
}
