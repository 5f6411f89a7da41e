//! Contacts and frictions as their laws see them, for audits: what the laws compare, and the sizes of the terms that meet in it.
//!
//! Nothing here goes by the mode of the contact or friction that it describes: both magnitudes of a friction are given, for either way of sliding, and sizes
//! are sums of squares, as an absolute value would go by that mode.

use super::expressions::{GuardTable, Inputs, Lowering, Switches};
use super::inputs::over_reactions;
use crate::{Fault, Tape, TouchRoots};
use std::borrow::Cow;
use symbolic::connections::{Condition, Friction, Law, Normal};
use symbolic::{Equations, Expr, Graph};

/// In the order of [`TouchRoots`].
const WIDTH: usize = TouchRoots::WIDTH;

/// The tape over t, x, q'' and all reactions: [`TouchRoots::WIDTH`] roots for each contact and friction, in the order of the reactions.
pub(super) fn touches(equations: &Equations, guards: &GuardTable) -> Result<Tape, Fault> {
    let mut graph = Cow::Borrowed(&equations.graph);
    let mut roots: Vec<(String, Expr)> = Vec::new();
    for reaction in &equations.reactions {
        let own = match &reaction.law {
            Law::Contact { condition, gap, restitution, .. } => {
                contact(graph.to_mut(), equations, (&equations.conditions[*condition], *gap, *restitution))
            }
            Law::Friction(friction) => self::friction(graph.to_mut(), equations, friction),
            _ => continue,
        };
        roots.extend(own.into_iter().map(|e| (format!("law of {}", reaction.name), e)));
    }
    let inputs: Inputs = over_reactions(equations);
    Lowering::new(&graph, &inputs, Switches::Known(guards)).tape("touches", &roots)
}

fn contact(graph: &mut Graph, equations: &Equations, (condition, gap, restitution): (&Condition, Expr, Expr)) -> [Expr; WIDTH] {
    let zero = graph.zero();
    let [rate, acceleration] = motion(graph, equations, condition);
    let place = place_size(graph, equations, condition);
    [gap, place, rate[0], rate[1], acceleration[0], acceleration[1], zero, zero, zero, restitution, zero]
}

/// The normal force is 1 where the magnitudes are forces.
fn friction(graph: &mut Graph, equations: &Equations, friction: &Friction) -> [Expr; WIDTH] {
    let condition = &equations.conditions[friction.condition];
    let [rate, acceleration] = motion(graph, equations, condition);
    let [normal, across] = [&friction.normal, &friction.across].map(|own| own.as_ref().map(|own| pressure(graph, equations, own)));
    let normal = normal.unwrap_or_else(|| graph.one());
    let across = across.unwrap_or_else(|| graph.zero());
    let place = place_size(graph, equations, condition);
    let [back, forth] = friction.kinetic;
    let restitution = tangential(graph, equations, friction);
    [normal, place, friction.sliding, rate[1], acceleration[0], acceleration[1], back, forth, friction.fixed, restitution, across]
}

/// A component of a normal force.
fn pressure(graph: &mut Graph, equations: &Equations, normal: &Normal) -> Expr {
    let mut terms = vec![normal.constant];
    for (k, factor) in &normal.terms {
        let force = graph.symbol(equations.reactions[*k].symbol);
        terms.push(graph.mul(*factor, force));
    }
    graph.sum(&terms)
}

/// Tangential restitution of the first contact that presses.
fn tangential(graph: &mut Graph, equations: &Equations, friction: &Friction) -> Expr {
    let terms = friction.normal.as_ref().map_or(&[][..], |normal| &normal.terms);
    let of = |(k, _): &(usize, Expr)| match equations.reactions[*k].law {
        Law::Contact { tangential, .. } => Some(tangential),
        _ => None,
    };
    terms.iter().find_map(of).unwrap_or_else(|| graph.zero())
}

/// Rate and J q'' + remainder, each with the sum of the squares of its terms.
fn motion(graph: &mut Graph, equations: &Equations, condition: &Condition) -> [[Expr; 2]; 2] {
    let mut terms = vec![condition.remainder];
    let (mut sizes, mut moved) = (Vec::new(), Vec::new());
    for (j, lever) in &condition.columns {
        let [_, rate, acceleration] = equations.coordinates[*j].symbols.map(|s| graph.symbol(s));
        let term = graph.mul(*lever, acceleration);
        terms.push(term);
        sizes.push(graph.square(term));
        let term = graph.mul(*lever, rate);
        moved.push(graph.square(term));
    }
    sizes.push(graph.square(condition.remainder));
    [[condition.rate, graph.sum(&moved)], [graph.sum(&terms), graph.sum(&sizes)]]
}

/// Squares of the terms that meet in a place: levers times lengths, or times one radian.
fn place_size(graph: &mut Graph, equations: &Equations, condition: &Condition) -> Expr {
    let mut sizes = Vec::new();
    for (j, lever) in &condition.columns {
        let coordinate = &equations.coordinates[*j];
        let place = if coordinate.unit == "rad" { graph.one() } else { graph.symbol(coordinate.symbols[0]) };
        let term = graph.mul(*lever, place);
        sizes.push(graph.square(term));
    }
    graph.sum(&sizes)
}
