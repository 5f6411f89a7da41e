//! The machine as its connections and its derivation see it: places, velocities, actions, pathways, values that formulas ask for. This file is what all of
//! them share: the graph, the generalized coordinates, and the derivations d/dt, ∂/∂q, ∂/∂t.
//!
//! Time enters positions in a prescribed way through `t`, through parameters that are formulas of time, and through the turn angles of
//! frames with a prescribed rate. All three are one extra direction of motion, number n after the coordinates 0..n, with rate 1: a
//! velocity is Σ J_j q'_j + J_n. Lagrange's and Newton-Euler's formulas then need no terms of their own for moving constraints.

pub mod kinematics;
pub mod pathways;
pub mod places;
pub mod requests;
pub mod start;
mod turns;
mod vanish;
pub mod wrench;

use crate::model::{Axis, Class, Inertia, Model, Origin};
use algebra::arrange::Arrange;
use rustc_hash::{FxHashMap, FxHashSet};
use std::collections::BTreeMap;
use symbolic::{Derivation, Expr, Function, Graph, Node, Occurrence, Substitution, SymbolId, Textbook};

pub use crate::model::Found;

/// A vector in some axes.
pub type Vector = [Expr; 3];

/// Nonzero columns of a Jacobian: direction (coordinate number, or n for time) and column.
pub type Columns<T> = BTreeMap<usize, T>;

/// Whether anything leaves the plane.
pub fn is_spatial(model: &Model) -> bool {
    let graph = &model.graph;
    let off = |e: Expr| !graph.is_zero(e);
    let frames = model.frames.iter().any(|f| {
        let origin = matches!(f.origin, Origin::Vector(v) if off(v[2]));
        let axes = f.rotations.iter().any(|(a, _)| *a != Axis::Z) || f.spin.is_some_and(|(a, _)| a != Axis::Z);
        let center = f.mass.as_ref().is_some_and(|m| off(m.center[2]));
        let products = f.mass.as_ref().is_some_and(|m| matches!(m.inertia, Inertia::Tensor { yz, xz, .. } if off(yz) || off(xz)));
        origin || axes || center || products
    });
    frames
        || model.points.iter().any(|p| off(p.at[2]))
        || model.gravity.is_some_and(|g| off(g[2]))
        || model.elements.iter().flat_map(|e| e.law.leaves_plane()).any(off)
}

/// How many time derivatives of a formula of time may be met: positions are differentiated twice, outputs may add a few.
const HIGHEST_DERIVATIVE: u8 = 6;

/// A turn angle that follows a prescribed rate.
#[derive(Clone, Debug)]
pub struct Turn {
    /// The angle.
    pub symbol: SymbolId,
    /// Its rate.
    pub rate: Expr,
    /// Index of the frame that turns.
    pub frame: usize,
}

/// The workspace of a derivation.
#[derive(Debug)]
pub struct Scene<'m> {
    /// The machine.
    pub model: &'m Model,
    /// Owner of all expressions, grown from the model's.
    pub graph: Graph,
    /// q, q', q'' as expressions.
    pub q: Vec<[Expr; 3]>,
    /// Turn angles of frames with prescribed rate.
    pub turns: Vec<Turn>,
    /// Simplifier.
    pub textbook: Textbook,
    /// Coordinates whose place at the start is used: index, symbol of a place that is sought, name of an element that uses it.
    pub starts: Vec<(usize, Option<SymbolId>, String)>,
    /// Angles, origins and pathways with a limited domain.
    pub places: Vec<Expr>,
    /// Formulas whose numbers decided something.
    pub premises: Vec<Expr>,
    total: Derivation,
    explicit: Derivation,
    partial: Vec<Derivation>,
    occurrence: Occurrence,
    states: Substitution,
    /// Time derivatives of formulas of time: (name, primes) as a symbol and the parameter's position.
    time_symbols: FxHashMap<SymbolId, (usize, u8)>,
}

impl<'m> Scene<'m> {
    /// Prepares the derivations for a model.
    pub fn new(model: &'m Model) -> Scene<'m> {
        let mut graph = model.graph.clone();
        let q: Vec<[Expr; 3]> = model.coordinates.iter().map(|c| c.symbols.map(|s| graph.symbol(s))).collect();
        let turns = name_turns(model, &mut graph);
        let mut time_symbols = FxHashMap::default();
        let mut explicit_seeds = vec![(model.time, graph.one())];
        for (i, parameter) in model.parameters.iter().enumerate().filter(|(_, p)| p.class == Class::Time) {
            time_symbols.insert(parameter.symbol, (i, 0));
            let mut of = parameter.symbol;
            for primes in 1..=HIGHEST_DERIVATIVE {
                let next = graph.symbol_id(&parameter.name, primes);
                time_symbols.insert(next, (i, primes));
                explicit_seeds.push((of, graph.symbol(next)));
                of = next;
            }
        }
        explicit_seeds.extend(turns.iter().map(|t| (t.symbol, t.rate)));
        let mut total_seeds = explicit_seeds.clone();
        for (c, q) in model.coordinates.iter().zip(&q) {
            total_seeds.extend([(c.symbols[0], q[1]), (c.symbols[1], q[2])]);
        }
        let coordinates: Vec<SymbolId> = model.coordinates.iter().map(|c| c.symbols[0]).collect();
        let partial = coordinates.iter().map(|s| Derivation::partial(&mut graph, *s)).collect();
        let states = state_formulas(model, &mut graph);
        let textbook = textbook(model, &mut graph);
        Scene {
            model,
            q,
            turns,
            textbook,
            starts: Vec::new(),
            places: Vec::new(),
            premises: Vec::new(),
            total: Derivation::new(total_seeds),
            explicit: Derivation::new(explicit_seeds),
            partial,
            occurrence: Occurrence::new(&coordinates),
            states,
            time_symbols,
            graph,
        }
    }

    /// Number of coordinates; also the number of the time direction.
    pub fn n(&self) -> usize {
        self.q.len()
    }

    /// Replaces parameters that depend on the motion by their formulas.
    pub fn open(&mut self, e: Expr) -> Expr {
        self.states.apply(&mut self.graph, e)
    }
    /// Opens every component.
    pub fn open_vector(&mut self, v: Vector) -> Vector {
        v.map(|e| self.open(e))
    }

    /// Notes what must have a value wherever the machine goes, if there is a place where it has none.
    pub fn must_exist(&mut self, e: Expr) {
        let limited = |e: Expr| match self.graph.node(e) {
            Node::Call { function, .. } => {
                matches!(function, Function::Asin | Function::Acos | Function::Acosh | Function::Atanh | Function::Log)
            }
            Node::Product { factors, .. } => factors.iter().any(|(_, exponent)| !exponent.is_integer()),
            Node::Power { .. } => true,
            _ => false,
        };
        if !self.places.contains(&e) && self.graph.reachable(&[e]).into_iter().any(limited) {
            self.places.push(e);
        }
    }

    /// de/dt along the motion.
    pub fn total(&mut self, e: Expr) -> Expr {
        self.total.apply(&mut self.graph, e)
    }
    /// d/dt of every component.
    pub fn total_vector(&mut self, v: Vector) -> Vector {
        v.map(|e| self.total(e))
    }
    /// The derivative in a direction: ∂/∂q_j, or the prescribed change in time for j = n.
    pub fn along(&mut self, e: Expr, direction: usize) -> Expr {
        match self.partial.get_mut(direction) {
            Some(partial) => partial.apply(&mut self.graph, e),
            None => self.explicit.apply(&mut self.graph, e),
        }
    }
    /// ∂e/∂q'_j.
    pub fn by_rate(&mut self, e: Expr, coordinate: usize) -> Expr {
        let rate = self.model.coordinates[coordinate].symbols[1];
        self.graph.derivative(e, rate)
    }
    /// Directions in which `e` may change: coordinates that occur in it, then time.
    pub fn directions(&mut self, e: Expr) -> Vec<usize> {
        let mut found: Vec<usize> = self.occurrence.of(&self.graph, e).iter().map(|i| *i as usize).collect();
        let n = self.n();
        let change = self.along(e, n);
        if !self.graph.is_zero(change) {
            found.push(n);
        }
        found
    }
    /// The nonzero derivatives of `e` in all directions.
    pub fn gradient(&mut self, e: Expr) -> Columns<Expr> {
        let directions = self.directions(e);
        let mut columns = Columns::new();
        for j in directions {
            let d = self.along(e, j);
            if !self.graph.is_zero(d) {
                columns.insert(j, d);
            }
        }
        columns
    }
    /// Σ columns·rates: the rate of a quantity with this gradient.
    pub fn rate_of(&mut self, gradient: &Columns<Expr>) -> Expr {
        let terms: Vec<Expr> = gradient
            .iter()
            .map(|(j, d)| {
                let rate = self.rate(*j);
                self.graph.mul(*d, rate)
            })
            .collect();
        self.graph.sum(&terms)
    }
    /// q'_j, or 1 for the time direction.
    pub fn rate(&mut self, direction: usize) -> Expr {
        match self.q.get(direction) {
            Some(q) => q[1],
            None => self.graph.one(),
        }
    }

    /// Textbook form.
    pub fn tidy(&mut self, e: Expr) -> Expr {
        self.textbook.tidy(&mut self.graph, e)
    }

    /// Textbook form, or the expanded one where that is shorter.
    pub fn shortest(&mut self, e: Expr) -> Expr {
        self.textbook.shortest(&mut self.graph, e)
    }

    /// a·b.
    pub fn dot(&mut self, a: &Vector, b: &Vector) -> Expr {
        let terms: Vec<Expr> = (0..3).map(|i| self.graph.mul(a[i], b[i])).collect();
        self.graph.sum(&terms)
    }
    /// a × b.
    pub fn cross(&mut self, a: &Vector, b: &Vector) -> Vector {
        let mut component = |i: usize, j: usize| {
            let (p, m) = (self.graph.mul(a[i], b[j]), self.graph.mul(a[j], b[i]));
            self.graph.sub(p, m)
        };
        [component(1, 2), component(2, 0), component(0, 1)]
    }
    /// a + b.
    pub fn plus(&mut self, a: &Vector, b: &Vector) -> Vector {
        [0, 1, 2].map(|i| self.graph.add(a[i], b[i]))
    }
    /// a - b.
    pub fn minus(&mut self, a: &Vector, b: &Vector) -> Vector {
        [0, 1, 2].map(|i| self.graph.sub(a[i], b[i]))
    }
    /// The zero vector.
    pub fn zero_vector(&mut self) -> Vector {
        [self.graph.zero(); 3]
    }

    /// Formulas for all formulas of time, and their derivatives, that occur below `roots`: (symbol, formula, parameter, primes), each
    /// using earlier ones only. Parameters without primes are always listed.
    pub fn time_formulas(&mut self, roots: &[Expr]) -> Vec<(SymbolId, Expr, usize, u8)> {
        let mut wanted: FxHashSet<SymbolId> = FxHashSet::default();
        let mut found = Vec::new();
        let mut pending: Vec<SymbolId> = self.graph.symbols_in(roots);
        while let Some(symbol) = pending.pop() {
            let Some(&(i, primes)) = self.time_symbols.get(&symbol) else { continue };
            if primes == 0 || !wanted.insert(symbol) {
                continue;
            }
            let n = self.n();
            let mut formula = self.model.parameters[i].value.expr();
            for _ in 0..primes {
                formula = self.along(formula, n);
            }
            pending.extend(self.graph.symbols_in(&[formula]));
            found.push((symbol, formula, i, primes));
        }
        // fewer primes first, then in the order of the parameters: a formula with k primes uses formulas with at most k primes, and
        // among those with k only of earlier parameters
        found.arrange_by_key(|(_, _, i, primes)| (*primes, *i));
        found
    }
}

impl Scene<'_> {
    /// What stands for the place of a coordinate at the start in a formula of the element `user`: its given value, a parameter that assembly finds, or 0.
    pub fn place_at_start(&mut self, coordinate: usize, user: &str) -> Expr {
        let declared = &self.model.coordinates[coordinate];
        if declared.given[0] || self.model.connections.is_empty() {
            return declared.start;
        }
        let known = self.starts.iter().find(|(j, ..)| *j == coordinate).map(|(_, symbol, _)| *symbol);
        let symbol = known.unwrap_or_else(|| {
            let symbol = declared.guessed[0].then(|| self.graph.symbol_id(&free_name(self.model, &declared.name), 0));
            self.starts.push((coordinate, symbol, user.to_owned()));
            symbol
        });
        symbol.map_or(declared.start, |s| self.graph.symbol(s))
    }
}

/// `x_0`, or longer where the file has that name.
fn free_name(model: &Model, coordinate: &str) -> String {
    let taken: FxHashSet<&str> = (model.parameters.iter().map(|p| p.name.as_str()))
        .chain(model.coordinates.iter().map(|c| c.name.as_str()))
        .chain(model.outputs.iter().map(|o| o.name.as_str()))
        .collect();
    let mut name = format!("{coordinate}_0");
    while taken.contains(name.as_str()) {
        name.push('0');
    }
    name
}

/// Names the turn angles: psi for a single one, else psi_frame.
fn name_turns(model: &Model, graph: &mut Graph) -> Vec<Turn> {
    let taken: FxHashSet<&str> = (model.parameters.iter().map(|p| p.name.as_str()))
        .chain(model.coordinates.iter().map(|c| c.name.as_str()))
        .chain(model.outputs.iter().map(|o| o.name.as_str()))
        .collect();
    let spinning: Vec<usize> = (0..model.frames.len()).filter(|i| model.frames[*i].spin.is_some()).collect();
    let mut turns = Vec::new();
    for frame in &spinning {
        let Some((_, rate)) = model.frames[*frame].spin else { continue };
        let mut name = if spinning.len() == 1 { "psi".to_owned() } else { format!("psi_{}", model.frames[*frame].name) };
        while taken.contains(name.as_str()) {
            name = if name == "psi" { format!("psi_{}", model.frames[*frame].name) } else { format!("{name}_turn") };
        }
        turns.push(Turn { symbol: graph.symbol_id(&name, 0), rate, frame: *frame });
    }
    turns
}

/// Formulas over coordinates and rates, each with the earlier ones put in.
fn state_formulas(model: &Model, graph: &mut Graph) -> Substitution {
    let mut map: Vec<(SymbolId, Expr)> = Vec::new();
    for parameter in model.parameters.iter().filter(|p| p.class == Class::State) {
        let formula = Substitution::new(map.iter().copied()).apply(graph, parameter.value.expr());
        map.push((parameter.symbol, formula));
    }
    Substitution::new(map)
}

/// Constants of the textbook form, and the user's names for sums of constants.
fn textbook(model: &Model, graph: &mut Graph) -> Textbook {
    let constants = model.parameters.iter().filter(|p| p.class == Class::Constant);
    let names: Vec<(SymbolId, Expr)> = constants.clone().map(|p| (p.symbol, p.value.expr())).collect();
    Textbook::new(graph, constants.map(|p| p.symbol), &names)
}
