//! Formulas with switches in the balances.

use symbolic::{Equations, Expr, Function, Node};

/// Whether what supports do in the balances depends on formulas with switches. Other formulas are analytic: what they make dependent on a stretch they make
/// dependent everywhere.
pub(crate) fn is_piecewise(equations: &Equations) -> bool {
    let graph = &equations.graph;
    let hidden = equations.reactions.iter().filter(|r| r.law.is_hidden());
    let own: Vec<Expr> = hidden.flat_map(|r| r.released.iter().map(|(_, e)| *e)).collect();
    if own.is_empty() {
        return false;
    }
    let mut roots = own;
    let mut known = 0;
    // names of formulas stand for them
    while roots.len() > known {
        known = roots.len();
        let symbols = graph.symbols_in(&roots);
        let named = equations.definitions.iter().filter(|d| symbols.contains(&d.symbol) && !roots.contains(&d.formula));
        let more: Vec<Expr> = named.map(|d| d.formula).collect();
        roots.extend(more);
    }
    let switches = |e: Expr| match graph.node(e) {
        Node::Switch { .. } => true,
        Node::Call { function, .. } => matches!(function, Function::Abs | Function::Sign | Function::Min | Function::Max),
        _ => false,
    };
    graph.reachable(&roots).into_iter().any(switches)
}
