//! Machine numbers of constant expressions, to refuse what is not finite or not physical before anything is derived.

use symbolic::{Expr, Graph, SymbolId};

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
                let value = graph.evaluate_node(e, &|_| f64::NAN, &|c| self.get(c).unwrap_or(f64::NAN));
                self.put(e, value);
                stack.pop();
            }
        }
        self.get(root).unwrap_or(f64::NAN)
    }
}
