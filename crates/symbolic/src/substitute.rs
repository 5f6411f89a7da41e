//! Replacing symbols by expressions.

use crate::{Expr, Graph, Node, Rational, SymbolId};
use rustc_hash::FxHashMap;

/// A replacement of symbols; remembers its results, so apply one to many expressions.
#[derive(Debug, Default)]
pub struct Substitution {
    map: FxHashMap<SymbolId, Expr>,
    memo: FxHashMap<Expr, Expr>,
}

impl Substitution {
    /// Replaces each symbol by its expression; replacements are not searched again.
    pub fn new(map: impl IntoIterator<Item = (SymbolId, Expr)>) -> Substitution {
        Substitution { map: map.into_iter().collect(), memo: FxHashMap::default() }
    }
    /// Whether there is nothing to replace.
    pub fn is_empty(&self) -> bool {
        self.map.is_empty()
    }
    /// `e` with the symbols replaced.
    pub fn apply(&mut self, graph: &mut Graph, e: Expr) -> Expr {
        if self.map.is_empty() {
            return e;
        }
        for e in graph.pending(&[e], &self.memo) {
            let replaced = match graph.node(e) {
                Node::Symbol(s) => self.map.get(s).copied().unwrap_or(e),
                _ => graph.rebuild(e, |child| self.memo[&child]),
            };
            self.memo.insert(e, replaced);
        }
        self.memo[&e]
    }
}

impl Graph {
    /// `e` with each direct operand replaced; `e` itself when none changes.
    pub fn rebuild(&mut self, e: Expr, replace: impl Fn(Expr) -> Expr) -> Expr {
        if self.children(e).iter().all(|c| replace(*c) == *c) {
            return e;
        }
        let pairs = |pairs: &[(Expr, Rational)]| pairs.iter().map(|(c, r)| (replace(*c), r.clone())).collect::<Vec<_>>();
        match self.node(e).clone() {
            Node::Number(_) | Node::Pi | Node::Symbol(_) => e,
            Node::Sum { constant, terms } => self.linear(constant, &pairs(&terms)),
            Node::Product { coefficient, factors } => self.monomial(coefficient, &pairs(&factors)),
            Node::Power { base, exponent } => self.power(replace(base), replace(exponent)),
            Node::Call { function, arguments } => {
                let arguments: Vec<Expr> = arguments.iter().map(|a| replace(*a)).collect();
                self.call(function, &arguments)
            }
            Node::Switch { guard, edge, then, otherwise } => self.switch(replace(guard), edge, replace(then), replace(otherwise)),
        }
    }
}
