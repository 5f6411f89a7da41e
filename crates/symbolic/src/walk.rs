//! Walking the graph without recursion: deep expressions must not overflow the stack.

use crate::{Expr, Graph, Node, SymbolId};
use rustc_hash::FxHashMap;

impl Graph {
    /// Everything below `roots` (roots included) that `known` does not hold yet, operands before users.
    pub(crate) fn pending<V>(&self, roots: &[Expr], known: &FxHashMap<Expr, V>) -> Vec<Expr> {
        let mut seen = FxHashMap::default();
        let mut stack: Vec<Expr> = roots.to_vec();
        let mut found = Vec::new();
        while let Some(e) = stack.pop() {
            if known.contains_key(&e) || seen.insert(e, ()).is_some() {
                continue;
            }
            found.push(e);
            self.for_each_child(e, |c| stack.push(c));
        }
        // a node only refers to older nodes
        found.sort_unstable();
        found
    }

    /// Everything below `roots`, roots included, operands before users.
    pub fn reachable(&self, roots: &[Expr]) -> Vec<Expr> {
        self.pending::<()>(roots, &FxHashMap::default())
    }

    /// Calls `visit` for each direct operand.
    pub fn for_each_child(&self, e: Expr, mut visit: impl FnMut(Expr)) {
        match self.node(e) {
            Node::Number(_) | Node::Pi | Node::Symbol(_) => {}
            Node::Sum { terms: pairs, .. } | Node::Product { factors: pairs, .. } => pairs.iter().for_each(|p| visit(p.0)),
            Node::Power { base, exponent } => {
                visit(*base);
                visit(*exponent);
            }
            Node::Call { arguments, .. } => arguments.iter().for_each(|a| visit(*a)),
            Node::Switch { guard, then, otherwise, .. } => {
                visit(*guard);
                visit(*then);
                visit(*otherwise);
            }
        }
    }

    /// The symbols that occur below `roots`, in creation order.
    pub fn symbols_in(&self, roots: &[Expr]) -> Vec<SymbolId> {
        let mut found: Vec<SymbolId> = self.reachable(roots).into_iter().filter_map(|e| self.as_symbol(e)).collect();
        found.sort_unstable();
        found
    }

    /// Whether a symbol for which `wanted` holds occurs below `e`.
    pub fn contains(&self, e: Expr, wanted: impl Fn(SymbolId) -> bool) -> bool {
        self.reachable(&[e]).into_iter().any(|e| self.as_symbol(e).is_some_and(&wanted))
    }
}

/// Which of a chosen set of symbols occur in an expression; remembers its answers.
#[derive(Debug, Default)]
pub struct Occurrence {
    chosen: FxHashMap<SymbolId, u32>,
    memo: FxHashMap<Expr, Box<[u32]>>,
}

impl Occurrence {
    /// Looks for these symbols; answers are positions in `symbols`.
    pub fn new(symbols: &[SymbolId]) -> Occurrence {
        let chosen = symbols.iter().enumerate().map(|(i, s)| (*s, i as u32)).collect();
        Occurrence { chosen, memo: FxHashMap::default() }
    }

    /// Positions, ascending, of the chosen symbols that occur in `e`.
    pub fn of(&mut self, graph: &Graph, e: Expr) -> &[u32] {
        for e in graph.pending(&[e], &self.memo) {
            let mut found: Vec<u32> = Vec::new();
            if let Some(i) = graph.as_symbol(e).and_then(|s| self.chosen.get(&s)) {
                found.push(*i);
            }
            graph.for_each_child(e, |c| found.extend_from_slice(&self.memo[&c]));
            found.sort_unstable();
            found.dedup();
            self.memo.insert(e, found.into());
        }
        &self.memo[&e]
    }
}
