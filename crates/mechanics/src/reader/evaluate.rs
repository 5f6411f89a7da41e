//! Machine numbers of constant expressions, to refuse what is not finite or not physical before anything is derived.

use crate::model::{Premise, Reliance};
use std::collections::BTreeSet;
use symbolic::{Expr, Graph, Node, SymbolId};

/// Values of expressions already asked for; symbols without a value are not a number.
#[derive(Default)]
pub(crate) struct Values {
    known: Vec<Option<f64>>,
    /// What was read off numbers.
    premises: BTreeSet<Premise>,
}

impl Values {
    /// Gives a symbol its value. Expressions that contain it must not have been asked for before.
    pub(crate) fn set(&mut self, graph: &mut Graph, symbol: SymbolId, value: f64) {
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

    /// Whether an expression is zero, or has lost digits, only because a product or power in it is smaller than the least machine number.
    pub(crate) fn underflows(&mut self, graph: &Graph, root: Expr) -> bool {
        if self.compute(graph, root).abs() >= f64::MIN_POSITIVE {
            return false;
        }
        let (mut stack, mut seen) = (vec![root], BTreeSet::new());
        while let Some(e) = stack.pop() {
            // a part that is large enough has lost nothing; terms that cancel are no loss either
            let small = |value: f64| value.abs() < f64::MIN_POSITIVE;
            if !seen.insert(e.index()) || !small(self.compute(graph, e)) && e != root {
                continue;
            }
            let value = |c: Expr, known: &mut Values| known.compute(graph, c);
            let lost = match graph.node(e) {
                Node::Number(r) => !r.is_zero(),
                Node::Product { coefficient, factors } => {
                    !coefficient.is_zero() && factors.iter().all(|(base, power)| value(*base, self) != 0.0 || power.is_negative())
                }
                Node::Power { base, .. } => value(*base, self) != 0.0,
                _ => false,
            };
            if lost && small(self.compute(graph, e)) {
                return true;
            }
            stack.extend(graph.children(e));
        }
        false
    }

    /// The value of an expression; the model rests on it.
    pub(crate) fn of(&mut self, graph: &Graph, root: Expr) -> f64 {
        self.relied(graph, root, Reliance::Value)
    }

    /// The value of an expression, of which the model takes no more than `reliance` says.
    pub(crate) fn relied(&mut self, graph: &Graph, formula: Expr, reliance: Reliance) -> f64 {
        self.premises.insert(Premise { formula, reliance });
        self.compute(graph, formula)
    }

    /// Exchanges what was read off numbers so far for another list of it.
    pub(crate) fn exchange(&mut self, premises: &mut BTreeSet<Premise>) {
        std::mem::swap(&mut self.premises, premises);
    }

    /// What was read off numbers that parameters decide.
    pub(crate) fn premises(&self, graph: &Graph) -> Vec<Premise> {
        self.premises.iter().copied().filter(|p| graph.as_number(p.formula).is_none()).collect()
    }

    fn compute(&mut self, graph: &Graph, root: Expr) -> f64 {
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
