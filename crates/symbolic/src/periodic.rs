//! Coordinates that only turn: a full turn changes nothing in the equations.

use crate::connections::Law;
use crate::{Equations, Expr, Function, Graph, Node, Rational, SymbolId};
use rustc_hash::FxHashSet;

impl Equations {
    /// For each coordinate whether the motion is the same after it has grown by 2π: it occurs in sines and cosines of whole multiples only.
    pub fn free_turns(&self) -> Vec<bool> {
        let held = otherwise(&self.graph, &self.dynamic_expressions());
        self.coordinates.iter().map(|c| !held.contains(&c.symbols[0])).collect()
    }

    /// Everything that the motion depends on.
    fn dynamic_expressions(&self) -> Vec<Expr> {
        let mut list: Vec<Expr> = self.mass.entries().to_vec();
        list.extend(self.force.iter().copied());
        list.extend(self.auxiliaries.iter().map(|a| a.rate));
        list.extend(self.definitions.iter().map(|d| d.formula));
        for c in &self.conditions {
            list.extend(c.place);
            list.extend([c.rate, c.remainder]);
            list.extend(c.columns.iter().map(|(_, e)| *e));
        }
        for r in &self.reactions {
            list.extend(r.forces.iter().chain(&r.released).map(|(_, e)| *e));
            match &r.law {
                Law::Contact { gap, restitution, tangential, .. } => list.extend([*gap, *restitution, *tangential]),
                Law::Friction(f) => {
                    list.extend([f.sliding, f.fixed]);
                    list.extend(f.kinetic);
                    for normal in f.components() {
                        list.push(normal.constant);
                        list.extend(normal.terms.iter().map(|(_, e)| *e));
                    }
                }
                Law::Ideal { .. } | Law::Rough { .. } | Law::Support | Law::Motor | Law::Place | Law::Transmission | Law::Tension => {}
            }
        }
        for b in &self.balances {
            list.push(b.rest);
            list.extend(b.columns.iter().map(|(_, e)| *e));
        }
        list
    }
}

/// The symbols that occur below `roots` otherwise than in sines and cosines of whole multiples.
fn otherwise(graph: &Graph, roots: &[Expr]) -> FxHashSet<SymbolId> {
    let mut found = FxHashSet::default();
    let mut seen: FxHashSet<Expr> = FxHashSet::default();
    let mut pending: Vec<Expr> = roots.to_vec();
    while let Some(e) = pending.pop() {
        if !seen.insert(e) {
            continue;
        }
        match graph.node(e) {
            Node::Number(_) | Node::Pi => {}
            Node::Symbol(s) => {
                found.insert(*s);
            }
            Node::Sum { terms: pairs, .. } => pending.extend(pairs.iter().map(|p| p.0)),
            Node::Product { factors, .. } => pending.extend(factors.iter().map(|p| p.0)),
            Node::Power { base, exponent } => pending.extend([*base, *exponent]),
            Node::Call { function, arguments } => {
                let turns = matches!(function, Function::Sin | Function::Cos);
                match arguments.first() {
                    Some(argument) if turns => pending.extend(beside(graph, *argument)),
                    _ => pending.extend(arguments.iter().copied()),
                }
            }
            Node::Switch { guard, then, otherwise, .. } => pending.extend([*guard, *then, *otherwise]),
        }
    }
    found
}

/// The parts of an angle without whole multiples of symbols.
fn beside(graph: &Graph, angle: Expr) -> Vec<Expr> {
    let whole = |e: Expr, factor: &Rational| match graph.node(e) {
        Node::Symbol(_) => factor.is_integer(),
        Node::Product { coefficient, factors } => match &factors[..] {
            [(base, power)] => graph.as_symbol(*base).is_some() && *power == Rational::ONE && (coefficient * factor).is_integer(),
            _ => false,
        },
        _ => false,
    };
    match graph.node(angle) {
        Node::Sum { terms, .. } => terms.iter().filter(|(e, f)| !whole(*e, f)).map(|(e, _)| *e).collect(),
        _ if whole(angle, &Rational::ONE) => Vec::new(),
        _ => vec![angle],
    }
}

#[cfg(test)]
mod tests {
    use super::otherwise;
    use crate::{Function, Graph, Rational};

    #[test]
    fn sines_of_whole_multiples_repeat_and_nothing_else() {
        let mut g = Graph::new();
        let (a, b) = (g.symbol_id("a", 0), g.symbol_id("b", 0));
        let repeats = |g: &Graph, roots: &[_], symbol| !otherwise(g, roots).contains(&symbol);
        let (x, y) = (g.symbol(a), g.symbol(b));
        let half = g.number(Rational::HALF);
        let two = g.int(2);
        let double = g.mul(two, x);
        let difference = g.sub(double, y);
        let sine = g.call(Function::Sin, &[difference]);
        assert!(repeats(&g, &[sine], a) && repeats(&g, &[sine], b));
        let halved = g.mul(half, x);
        let cosine = g.call(Function::Cos, &[halved]);
        assert!(!repeats(&g, &[cosine], a));
        let product = g.mul(x, y);
        let mixed = g.call(Function::Sin, &[product]);
        assert!(!repeats(&g, &[mixed], a));
        let outside = g.add(sine, x);
        assert!(!repeats(&g, &[outside], a) && repeats(&g, &[outside], b));
    }
}
