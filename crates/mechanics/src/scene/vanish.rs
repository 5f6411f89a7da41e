//! Whether an expression is zero everywhere.
//!
//! The textbook form sees most zeros; some it cannot see, cos(asin z)² + z² - 1 and the like. Such an expression is an analytic function, and an analytic
//! function that vanishes at random points for random parameters vanishes everywhere. At each point its value is compared with the size of the terms
//! that meet in it. A point at which numbers no longer show what the expression depends on tells nothing: far from its step tanh is 1 to all digits,
//! and 1 - tanh² is a zero of the numbers alone. Where every point is such a one, the expression is not taken for zero.

use super::{Scene, Vector};
use crate::model::{ParameterDecl, ParameterValue};
use algebra::elementary;
use algebra::random::Random;
use algebra::vectors::{Basis, norm};
use rustc_hash::FxHashMap;
use symbolic::{Expr, Graph, Node, SymbolId};

/// Points that must show the zero.
const POINTS: usize = 5;
/// Points tried; outside its domain an expression shows nothing.
const TRIALS: u64 = 40;
/// Rounding, relative to the terms that meet.
const ROUNDING: f64 = 1e-10;
/// Share of its argument by which a function is tried: it must answer by more than rounding.
const NUDGE: f64 = 1e-3;

impl Scene<'_> {
    /// Whether an expression is zero for all states, times and parameters.
    pub fn vanishes(&mut self, e: Expr) -> bool {
        let e = self.tidy(e);
        if self.graph.is_zero(e) {
            return true;
        }
        if self.graph.as_number(e).is_some() || !has_hidden_zero(&self.graph, e) {
            return false;
        }
        let mut seen = 0;
        for trial in 0..TRIALS {
            let point = self.random_point(trial);
            let at = self.sight(&[e], &point)[0];
            if !at.value.is_finite() || !at.size.is_finite() || at.size == 0.0 {
                continue;
            }
            if at.value.abs() > ROUNDING * at.size {
                return false;
            }
            seen += usize::from(!at.blind);
            if seen == POINTS {
                return true;
            }
        }
        false
    }

    /// Dimension of the space that vectors span, in most positions.
    pub fn rank(&mut self, vectors: &[Vector]) -> usize {
        let components: Vec<Expr> = vectors.iter().flatten().copied().collect();
        // analytic vectors have at almost every point the rank that they have in most
        let enough = if is_analytic(&self.graph, &components) { POINTS } else { usize::MAX };
        let whole = vectors.len().min(3);
        let (mut most, mut seen) = (0, 0);
        for trial in 0..TRIALS {
            if most == whole || seen == enough {
                break;
            }
            let point = self.random_point(trial);
            let found = self.sight(&components, &point);
            let values: Vec<f64> = found.iter().map(|at| at.value).collect();
            if values.iter().all(|v| v.is_finite()) {
                most = most.max(span(&values));
                seen += usize::from(found.iter().all(|at| !at.blind));
            }
        }
        most
    }

    /// Values of constant expressions with the numbers of the model; not a number where one is missing. The derivation rests on them.
    pub fn at_numbers<const N: usize>(&mut self, expressions: [Expr; N]) -> [f64; N] {
        self.premises.extend(expressions);
        let point = self.point(&mut || 0.0);
        let has_number = |p: &ParameterDecl| p.number.is_some() || matches!(p.value, ParameterValue::Formula(_));
        let open = |s: SymbolId| self.model.unknowns.contains(&s) || self.model.parameters.iter().any(|p| p.symbol == s && !has_number(p));
        let value = |s: SymbolId| point.get(&s).copied().filter(|_| !open(s)).unwrap_or(f64::NAN);
        let values = self.graph.evaluate(&expressions, &value);
        std::array::from_fn(|i| values[i])
    }

    /// Values of all symbols: near the start of the model, parameters near their numbers.
    fn random_point(&self, trial: u64) -> FxHashMap<SymbolId, f64> {
        let mut random = Random::new(trial.wrapping_mul(0x9e37_79b9_7f4a_7c15) ^ 0x5bd1_e995);
        self.point(&mut || random.between(-1.0, 1.0))
    }

    fn point(&self, random: &mut dyn FnMut() -> f64) -> FxHashMap<SymbolId, f64> {
        let model = self.model;
        let mut point: FxHashMap<SymbolId, f64> = FxHashMap::default();
        point.insert(model.time, 0.5 + 0.4 * random());
        for turn in &self.turns {
            point.insert(turn.symbol, 3.0 * random());
        }
        for c in &model.coordinates {
            let start = self.graph.evaluate(&[c.start], &|s| near(model, s)).first().copied().unwrap_or(0.0);
            let size = if start.is_finite() && start != 0.0 && c.units[0] != "rad" { start.abs() } else { 1.0 };
            let start = if start.is_finite() { start } else { 0.0 };
            point.insert(c.symbols[0], start + size * random());
            point.insert(c.symbols[1], random());
            point.insert(c.symbols[2], random());
        }
        for (j, symbol, _) in &self.starts {
            let place = point.get(&model.coordinates[*j].symbols[0]).copied().unwrap_or(0.0);
            point.extend(symbol.map(|s| (s, place + random())));
        }
        for p in &model.parameters {
            let value = match (p.value, p.number) {
                (ParameterValue::Formula(formula), _) => {
                    self.graph.evaluate(&[formula], &|s| point.get(&s).copied().unwrap_or(f64::NAN))[0]
                }
                (_, Some(number)) if number != 0.0 => number * (1.0 + 0.2 * random()),
                _ => random(),
            };
            point.insert(p.symbol, value);
        }
        point
    }
}

fn near(model: &crate::model::Model, symbol: SymbolId) -> f64 {
    model.parameters.iter().find(|p| p.symbol == symbol).and_then(|p| p.number).unwrap_or(f64::NAN)
}

/// Whether the textbook form may miss a zero: sums with roots or inverse functions in them, and no switch, on one side of which it might vanish alone.
fn has_hidden_zero(graph: &Graph, e: Expr) -> bool {
    let sums = |e: &Expr| matches!(graph.node(*e), Node::Sum { .. });
    graph.reachable(&[e]).iter().any(sums) && is_analytic(graph, &[e])
}

/// Whether nothing switches below these expressions.
fn is_analytic(graph: &Graph, roots: &[Expr]) -> bool {
    !graph.reachable(roots).iter().any(|e| graph.node(*e).switches())
}

/// What the numbers of one point show of an expression.
#[derive(Clone, Copy)]
struct Sight {
    value: f64,
    /// Sum of the magnitudes of what it is the sum of.
    size: f64,
    /// Whether it changes with the state or with time.
    varies: bool,
    /// Whether something that changes is lost in the rounding of what it is added to, or of the function of which it is the argument.
    blind: bool,
}

impl Scene<'_> {
    /// What the numbers of a point show of some expressions.
    fn sight(&self, roots: &[Expr], point: &FxHashMap<SymbolId, f64>) -> Vec<Sight> {
        let graph = &self.graph;
        let fixed = |s: SymbolId| self.model.parameters.iter().any(|p| p.symbol == s);
        let mut known: FxHashMap<Expr, Sight> = FxHashMap::default();
        for e in graph.reachable(roots) {
            let at = |nudge: f64| graph.evaluate_node(e, &|s| point.get(&s).copied().unwrap_or(f64::NAN), &|c| nudge * known[&c].value);
            let value = at(1.0);
            let below = graph.children(e);
            let varies = match graph.node(e) {
                Node::Symbol(s) => !fixed(*s),
                _ => below.iter().any(|c| known[c].varies),
            };
            let mut size = value.abs();
            let mut blind = below.iter().any(|c| known[c].blind);
            match graph.node(e) {
                Node::Sum { constant, terms } => {
                    let sizes = || terms.iter().map(|(t, f)| (known[t], f.to_f64().abs() * known[t].size));
                    size = sizes().fold(constant.to_f64().abs(), |sum, (_, size)| sum + size);
                    blind |= sizes().any(|(term, part)| term.varies && part < ROUNDING * size);
                }
                Node::Product { coefficient, factors } => {
                    size = factors.iter().fold(coefficient.to_f64().abs(), |p, (b, x)| {
                        // a denominator is as small as it is; what is added up in it does not make the quotient larger
                        p * if x.to_f64() > 0.0 {
                            elementary::pow(known[b].size, x.to_f64())
                        } else {
                            elementary::pow(known[b].value.abs(), x.to_f64())
                        }
                    });
                }
                // two arguments that are nudged together may leave the value as it was
                Node::Call { .. } => blind |= below.len() == 1 && varies && (at(1.0 + NUDGE) - value).abs() < ROUNDING * size,
                _ => {}
            }
            known.insert(e, Sight { value, size, varies, blind });
        }
        roots.iter().map(|e| known[e]).collect()
    }
}

/// Rank of vectors of three components, one after another.
fn span(values: &[f64]) -> usize {
    // what is left of a dependent vector of three numbers is rounding, 1e-15; directions of bodies differ by more than a nanoradian
    const NOTHING: f64 = 1e-9;
    let mut basis = Basis::default();
    values.chunks_exact(3).filter(|vector| basis.takes(vector, NOTHING * norm(vector))).count()
}
