//! Formulas with switches in the balances.

use symbolic::{Equations, Expr, Function, Node};

/// Whether what supports do in the balances depends on formulas with switches. Other formulas are analytic: what they make dependent on a stretch they make
/// dependent everywhere.
pub(crate) fn is_piecewise(equations: &Equations) -> bool {
    let hidden = equations.reactions.iter().filter(|r| r.law.is_hidden());
    is_switched(equations, hidden.flat_map(|r| r.released.iter().map(|(_, e)| *e)).collect(), &SWITCHES)
}

/// Whether formulas that place bodies, that connections hold or that store energy, have switches.
pub(crate) fn is_bent(equations: &Equations) -> bool {
    let conditions = equations.conditions.iter().flat_map(|c| c.place.into_iter().chain([c.rate]));
    let bodies = equations.released.bodies.iter().flat_map(|b| b.center.iter().chain(b.rotation.iter().flatten()).copied());
    is_switched(equations, conditions.chain(bodies).chain([equations.energy.kinetic, equations.energy.potential]).collect(), &STEPS)
}

/// Functions with kinks.
const SWITCHES: [Function; 4] = [Function::Abs, Function::Sign, Function::Min, Function::Max];
/// The same with the one that falls by a turn at its cut.
const STEPS: [Function; 5] = [Function::Abs, Function::Sign, Function::Min, Function::Max, Function::Atan2];

fn is_switched(equations: &Equations, mut roots: Vec<Expr>, switching: &[Function]) -> bool {
    let graph = &equations.graph;
    if roots.is_empty() {
        return false;
    }
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
        Node::Call { function, .. } => switching.contains(function),
        _ => false,
    };
    graph.reachable(&roots).into_iter().any(switches)
}
