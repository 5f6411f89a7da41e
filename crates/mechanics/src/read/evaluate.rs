//! Machine numbers of constant expressions, to refuse what is not finite or not physical before anything is derived.

use symbolic::{Expr, Function, Graph, Node, SymbolId};

/// Values of expressions already asked for; symbols without a value are not a number.
#[derive(Default)]
pub(super) struct Values {
    known: Vec<Option<f64>>,
}

impl Values {
    /// Gives a symbol its value. Expressions that contain it must not have been asked for before.
    pub(super) fn set(&mut self, graph: &mut Graph, symbol: SymbolId, value: f64) {
        let e = graph.symbol(symbol);
        self.put(e, value);
    }
    fn put(&mut self, e: Expr, value: f64) {
        if self.known.len() <= e.index() {
            self.known.resize(e.index() + 1, None);
        }
        self.known[e.index()] = Some(value);
    }
    fn get(&self, e: Expr) -> Option<f64> {
        self.known.get(e.index()).copied().flatten()
    }

    /// The value of an expression.
    pub(super) fn of(&mut self, graph: &Graph, root: Expr) -> f64 {
        let mut stack = vec![root];
        while let Some(&e) = stack.last() {
            if self.get(e).is_some() {
                stack.pop();
                continue;
            }
            let before = stack.len();
            stack.extend(graph.children(e).into_iter().filter(|c| self.get(*c).is_none()));
            if stack.len() == before {
                let value = self.node(graph, graph.node(e));
                self.put(e, value);
                stack.pop();
            }
        }
        self.get(root).unwrap_or(f64::NAN)
    }

    fn node(&self, graph: &Graph, node: &Node) -> f64 {
        let of = |e: &Expr| self.get(*e).unwrap_or(f64::NAN);
        match node {
            Node::Number(r) => r.to_f64(),
            Node::Pi => std::f64::consts::PI,
            Node::Symbol(_) => f64::NAN,
            Node::Sum { constant, terms } => terms.iter().fold(constant.to_f64(), |sum, (e, f)| sum + f.to_f64() * of(e)),
            Node::Product { coefficient, factors } => {
                factors.iter().fold(coefficient.to_f64(), |product, (e, power)| product * raise(of(e), power.to_f64()))
            }
            Node::Power { base, exponent } => of(base).powf(of(exponent)),
            Node::Call { function, arguments } => {
                let x = arguments.first().map_or(f64::NAN, of);
                let y = arguments.get(1).map_or(f64::NAN, of);
                call(*function, x, y)
            }
            Node::Switch { guard, strict, then, otherwise } => {
                let g = of(guard);
                if g.is_nan() {
                    return f64::NAN;
                }
                let _ = graph;
                if g > 0.0 || g == 0.0 && !strict { of(then) } else { of(otherwise) }
            }
        }
    }
}

fn raise(base: f64, power: f64) -> f64 {
    if power == 0.5 {
        base.sqrt()
    } else if power.fract() == 0.0 && power.abs() <= 64.0 {
        base.powi(power as i32)
    } else {
        base.powf(power)
    }
}

fn call(function: Function, x: f64, y: f64) -> f64 {
    match function {
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
        Function::Exp => x.exp(),
        Function::Log => x.ln(),
        Function::Abs => x.abs(),
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
