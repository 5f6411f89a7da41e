//! Expressions of a machine at rest.

use symbolic::{Equations, Expr, Graph, SymbolId};

/// Formulas, and turn angles of prescribed speed at their start.
pub(crate) fn definitions(equations: &Equations) -> Vec<(SymbolId, Expr)> {
    let turned = equations.auxiliaries.iter().map(|a| (a.symbol, a.start));
    equations.definitions.iter().map(|d| (d.symbol, d.formula)).chain(turned).collect()
}

/// An expression with rates and accelerations zero.
pub(super) fn at_rest(equations: &Equations, graph: &mut Graph, e: Expr) -> Expr {
    let zero = graph.zero();
    let still = equations.coordinates.iter().flat_map(|c| [(c.symbols[1], zero), (c.symbols[2], zero)]);
    symbolic::Substitution::new(still.collect::<Vec<_>>()).apply(graph, e)
}
