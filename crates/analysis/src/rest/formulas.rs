//! Expressions of a machine at rest.

use symbolic::{Derivation, Equations, Expr, Graph, SymbolId};

/// Formulas, and turn angles of prescribed speed at their start.
pub(crate) fn definitions(equations: &Equations) -> Vec<(SymbolId, Expr)> {
    let turned = equations.auxiliaries.iter().map(|a| (a.symbol, a.start));
    equations.definitions.iter().map(|d| (d.symbol, d.formula)).chain(turned).collect()
}

/// ∂/∂symbol, through the definitions too.
pub(crate) fn seeded(graph: &mut Graph, definitions: &[(SymbolId, Expr)], symbol: SymbolId) -> Derivation {
    let mut known = vec![(symbol, graph.one())];
    for (name, formula) in definitions {
        let inner = Derivation::new(known.iter().copied()).apply(graph, *formula);
        if !graph.is_zero(inner) {
            known.push((*name, inner));
        }
    }
    Derivation::new(known)
}

/// An expression with rates and accelerations zero.
pub(super) fn at_rest(equations: &Equations, graph: &mut Graph, e: Expr) -> Expr {
    let zero = graph.zero();
    let still = equations.coordinates.iter().flat_map(|c| [(c.symbols[1], zero), (c.symbols[2], zero)]);
    symbolic::Substitution::new(still.collect::<Vec<_>>()).apply(graph, e)
}
