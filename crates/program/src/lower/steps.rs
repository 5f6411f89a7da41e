//! Velocities that formulas of time prescribe and that a switch makes jump.
//!
//! ```text
//! ∂T/∂q'_j at q' = 0        what prescribed origins and turns give to the momentum of coordinate j
//! T at q' = 0               what they give to the energy of bodies that no coordinate moves along with them
//! carried by a balance      momentum of a released body at q' = 0: its supports feel it, though no coordinate may
//! rate of a condition       at q' = 0: what it wants of the motion
//! place of a condition      a surface that stands elsewhere afterwards has no rate that shows it; nor has a body
//! ```
//!
//! An acceleration does not show such a jump: between two constant speeds it is zero on both sides. So these velocities stand among the results of the
//! dynamics, which makes their switches guards at which the integrator stops.

use symbolic::{Equations, Expr, Graph, Substitution};

/// The velocities with switches, over a graph that has them.
pub(super) fn steps(equations: &Equations) -> Option<(Graph, Vec<Expr>)> {
    let switches = |graph: &Graph, e: Expr| {
        let mut roots = vec![e];
        // definitions use earlier ones only
        for d in equations.definitions.iter().rev() {
            if graph.contains(roots[0], |s| s == d.symbol) || roots[1..].iter().any(|r| graph.contains(*r, |s| s == d.symbol)) {
                roots.push(d.formula);
            }
        }
        graph.reachable(&roots).into_iter().any(|e| graph.node(e).switches())
    };
    let may = |e: Expr| switches(&equations.graph, e);
    let carried = || equations.balances.iter().filter_map(|balance| balance.carried);
    let bodies = equations.released.bodies.iter().flat_map(|b| b.center.iter().chain(b.rotation.iter().flatten()).copied());
    let placed = || equations.conditions.iter().filter_map(|c| c.place).chain(bodies.clone());
    if !may(equations.energy.kinetic) && !equations.conditions.iter().any(|c| may(c.rate)) && !carried().chain(placed()).any(may) {
        return None;
    }
    let mut graph = equations.graph.clone();
    let zero = graph.zero();
    let mut still = Substitution::new(equations.coordinates.iter().map(|c| (c.symbols[1], zero)));
    let mut list = Vec::new();
    for coordinate in &equations.coordinates {
        let momentum = graph.derivative(equations.energy.kinetic, coordinate.symbols[1]);
        list.push(still.apply(&mut graph, momentum));
    }
    list.push(still.apply(&mut graph, equations.energy.kinetic));
    for rate in equations.conditions.iter().map(|condition| condition.rate).chain(carried()) {
        list.push(still.apply(&mut graph, rate));
    }
    list.extend(placed());
    list.retain(|e| switches(&graph, *e));
    (!list.is_empty()).then_some((graph, list))
}
