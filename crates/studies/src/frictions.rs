//! The laws of dry friction as formulas: what each force is while it slides, and its limit at rest.

use report::formula::{Layout, Printer};
use symbolic::connections::{Friction, Law, Normal};
use symbolic::equations::Equality;
use symbolic::{Edge, Equations, Expr, Function, Graph, SymbolId};

/// Two lines a friction: λ = μ |N| sign v while it slides, |λ| ≤ μ₀ |N| while it sticks. Nothing when the equations are not shown.
pub fn laws(equations: &Equations, printer: &Printer) -> Vec<Layout> {
    if equations.textbook.is_err() {
        return Vec::new();
    }
    let mut graph = equations.graph.clone();
    let mut lines = Vec::new();
    for reaction in &equations.reactions {
        if let Law::Friction(friction) = &reaction.law {
            let [sliding, sticking] = law(equations, &mut graph, friction, reaction.symbol);
            lines.push(printer.equality_layout(&graph, sliding, None));
            lines.push(printer.at_most(&graph, sticking));
        }
    }
    lines
}

/// What the forces of frictions are while they slide, as far as that needs no other reaction.
pub(crate) fn sliding(equations: &Equations, graph: &mut Graph) -> Vec<(SymbolId, Expr)> {
    let mut found = Vec::new();
    for reaction in &equations.reactions {
        if let Law::Friction(friction) = &reaction.law {
            let [sliding, _] = law(equations, graph, friction, reaction.symbol);
            if !graph.contains(sliding.right, |s| equations.reactions.iter().any(|r| r.symbol == s)) {
                found.push((reaction.symbol, sliding.right));
            }
        }
    }
    found
}

fn law(equations: &Equations, graph: &mut Graph, friction: &Friction, symbol: SymbolId) -> [Equality; 2] {
    let size = pressure(equations, graph, friction);
    let [back, forth] = friction.kinetic.map(|e| graph.mul(e, size));
    let sliding = if back == forth {
        let sign = graph.call(Function::Sign, &[friction.sliding]);
        graph.mul(forth, sign)
    } else {
        let against = graph.neg(back);
        graph.switch(friction.sliding, Edge::Open, forth, against)
    };
    let force = graph.symbol(symbol);
    let limit = limit(equations, graph, friction);
    [Equality { left: force, right: sliding }, Equality { left: graph.call(Function::Abs, &[force]), right: limit }]
}

/// μ₀ |N|.
pub(crate) fn limit(equations: &Equations, graph: &mut Graph, friction: &Friction) -> Expr {
    let size = pressure(equations, graph, friction);
    graph.mul(friction.fixed, size)
}

/// |N|, one where the law is a force.
fn pressure(equations: &Equations, graph: &mut Graph, friction: &Friction) -> Expr {
    let parts: Vec<Expr> = friction.components().map(|normal| sum(equations, graph, normal)).collect();
    match parts[..] {
        [] => graph.one(),
        [only] => graph.call(Function::Abs, &[only]),
        _ => {
            let squares: Vec<Expr> = parts.iter().map(|e| graph.square(*e)).collect();
            let sum = graph.sum(&squares);
            graph.sqrt(sum)
        }
    }
}

fn sum(equations: &Equations, graph: &mut Graph, normal: &Normal) -> Expr {
    let mut terms = vec![normal.constant];
    for (k, factor) in &normal.terms {
        let symbol = graph.symbol(equations.reactions[*k].symbol);
        terms.push(graph.mul(*factor, symbol));
    }
    graph.sum(&terms)
}
