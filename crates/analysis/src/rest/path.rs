//! Conditions that are given in rates only, as conditions on places.
//!
//! Σ J_j(q) q_j' = 0 says where the machine can be if J is a gradient, ∂J_i/∂q_j = ∂J_j/∂q_i (a slider through its first place, rolling in the plane, gears):
//! then along every way from the start
//!
//! ```text
//! c(q) = ∫ Σ J_j(q₀ + s (q - q₀)) (q_j - q₀_j) ds over s = 0 ... 1,        ∂c/∂q = J
//! ```
//!
//! A condition whose J is no gradient (a skate, rolling in space) leads to different places along different ways: where the machine rests depends on how it
//! came there.

use std::sync::Arc;

use program::lower::{self, Inputs};
use program::{Evaluator, Point, Tape};
use symbolic::{Equations, Expr, Graph};

use super::formulas::{at_rest, definitions, seeded};
use crate::Fault;
use crate::connections::way::{integrals, sum};
use algebra::random::Random;

/// Difference of mixed derivatives, relative to the largest, that counts as none.
const GRADIENT: f64 = 1e-9;
/// Places at which derivatives are compared, besides the start.
const LOOKS: usize = 4;
/// Conditions on rates and the way from the start.
#[derive(Clone, Debug)]
pub(super) struct Paths {
    tape: Arc<Tape>,
    evaluator: Evaluator,
    n: usize,
    count: usize,
    anchor: Vec<f64>,
    /// Which of the conditions have a place.
    pub exact: Vec<bool>,
}

impl Paths {
    /// Of these conditions, with the start.
    ///
    /// *Errors*: a formula without a value at the start.
    pub(super) fn new(equations: &Equations, conditions: &[usize], parameters: &[f64], start: &[f64]) -> Result<Paths, Fault> {
        let n = equations.coordinates.len();
        let mut graph = equations.graph.clone();
        let roots = roots(equations, conditions, &mut graph);
        let named: Vec<(String, Expr)> = roots.iter().enumerate().map(|(i, e)| (format!("path {}", i + 1), *e)).collect();
        let rates = equations.coordinates.iter().flat_map(|c| [c.symbols[1], c.symbols[2]]);
        let inputs = Inputs {
            parameters: equations.parameters.iter().map(|p| p.symbol).collect(),
            states: equations.coordinates.iter().map(|c| c.symbols[0]).collect(),
            zeros: rates.chain([equations.time]).collect(),
            definitions: definitions(equations),
            ..Inputs::default()
        };
        let tape = Arc::new(lower::expressions(&graph, "paths", &inputs, &named)?);
        let evaluator = Evaluator::new(&tape, parameters)?;
        let count = conditions.len();
        let mut paths = Paths { tape, evaluator, n, count, anchor: start[..n].to_vec(), exact: vec![true; count] };
        paths.exact = paths.gradients()?;
        Ok(paths)
    }

    /// Takes other numbers and another start.
    ///
    /// *Errors*: formulas outside their domain.
    pub(super) fn set(&mut self, parameters: &[f64], start: &[f64]) -> Result<(), Fault> {
        self.evaluator = Evaluator::new(&self.tape, parameters)?;
        self.anchor = start[..self.n].to_vec();
        Ok(())
    }

    /// The start.
    pub(super) fn anchor(&self) -> &[f64] {
        &self.anchor
    }

    fn values(&mut self, q: &[f64]) -> Result<Vec<f64>, Fault> {
        Ok(self.evaluator.evaluate(&Point { states: q, ..Point::default() })?.to_vec())
    }

    /// Which J are gradients: mixed derivatives agree at the start and around it.
    fn gradients(&mut self) -> Result<Vec<bool>, Fault> {
        let (n, count) = (self.n, self.count);
        let mut exact = vec![true; count];
        let mut random = Random::new(29);
        for look in 0..=LOOKS {
            let mut q = self.anchor.clone();
            if look > 0 {
                q.iter_mut().for_each(|v| *v += random.between(-0.3, 0.3) * v.abs().max(1.0));
            }
            let values = match self.values(&q) {
                Ok(values) => values,
                Err(fault) if look == 0 => return Err(fault),
                Err(_) => continue,
            };
            let (_, mixed) = values.split_at(count * n);
            for (c, by) in mixed.chunks_exact(n * n).enumerate() {
                let largest = by.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
                let agree = |p: usize| (by[p] - by[(p % n) * n + p / n]).abs() <= GRADIENT * largest;
                exact[c] &= (0..n * n).all(agree);
            }
        }
        Ok(exact)
    }

    /// c(q) of each condition.
    ///
    /// *Errors*: a formula without a value on the way from the start, or one that no panel resolves.
    pub(super) fn places(&mut self, q: &[f64]) -> Result<Vec<f64>, Fault> {
        let way: Vec<f64> = q.iter().zip(&self.anchor).map(|(a, b)| a - b).collect();
        if way.iter().all(|d| *d == 0.0) {
            return Ok(vec![0.0; self.count]);
        }
        let (n, count, anchor) = (self.n, self.count, self.anchor.clone());
        let found = integrals(0.0, |s| {
            let at: Vec<f64> = anchor.iter().zip(&way).map(|(a, d)| a + s * d).collect();
            let values = self.values(&at)?;
            Ok(values.chunks_exact(n.max(1)).take(count).map(|row| sum(row.iter().zip(&way).map(|(j, d)| j * d))).collect())
        })?;
        Ok(found.iter().map(|[value, _]| *value).collect())
    }
}

/// J of each condition, then ∂J_i/∂q_j of each.
fn roots(equations: &Equations, conditions: &[usize], graph: &mut Graph) -> Vec<Expr> {
    let n = equations.coordinates.len();
    let zero = graph.zero();
    let known = definitions(equations);
    let mut rows = Vec::new();
    for c in conditions {
        let mut row = vec![zero; n];
        equations.conditions[*c].columns.iter().for_each(|(j, e)| row[*j] = *e);
        rows.push(row);
    }
    let mut list = rows.concat();
    let mut by: Vec<symbolic::Derivation> = Vec::new();
    for coordinate in &equations.coordinates {
        by.push(seeded(graph, &known, coordinate.symbols[0]));
    }
    for row in &rows {
        for e in row {
            for derivation in &mut by {
                list.push(derivation.apply(graph, *e));
            }
        }
    }
    list
}

/// Whether all conditions say where the machine can be: given as places, or in homogeneous rates that are gradients.
///
/// *Errors*: a formula without a value at `q`.
pub fn all_places(equations: &Equations, parameters: &[f64], q: &[f64]) -> Result<bool, Fault> {
    let mut graph = equations.graph.clone();
    let rates: Vec<usize> = (0..equations.conditions.len()).filter(|c| equations.conditions[*c].place.is_none()).collect();
    let homogeneous = |c: &usize| {
        let rest = at_rest(equations, &mut graph, equations.conditions[*c].rate);
        graph.is_zero(rest)
    };
    if !rates.iter().all(homogeneous) {
        return Ok(false);
    }
    Ok(rates.is_empty() || Paths::new(equations, &rates, parameters, q)?.exact.iter().all(|e| *e))
}
