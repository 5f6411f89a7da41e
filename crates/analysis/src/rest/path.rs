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
//! came there. Rolling on a circle in x, y and an angle is a gradient only for changes that keep to the circle: of such a condition the mixed derivatives agree on all pairs of
//! directions in which the conditions on places let the machine move, and its ways lie on their surface (`connections::surface`).

use std::sync::Arc;

use program::lower::{self, Inputs};
use program::{Evaluator, Point, Tape};
use symbolic::{Derivation, Equations, Expr, Graph};

use super::formulas::{at_rest, definitions};
use crate::Fault;
use crate::connections::surface::{Instant, Slopes, Ways};
use crate::connections::way::{integrals, sum};
use algebra::qr::{DEPENDENT, Qr};
use algebra::random::Random;
use algebra::vectors::norm;

/// Difference of mixed derivatives, relative to the largest, that counts as none.
const GRADIENT: f64 = 1e-9;
/// Places at which derivatives are compared, besides the start.
const LOOKS: usize = 4;
/// How far from the start these lie: radians, shares of a length.
const BESIDE: f64 = 0.3;

/// Where a condition on rates leads.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Leads {
    /// To a place that depends on the way.
    Anywhere,
    /// To the place that the straight way gives.
    Straight,
    /// To that of ways on which the conditions on places hold.
    Within,
}

/// Conditions on rates and the way from the start.
#[derive(Clone, Debug)]
pub(super) struct Paths {
    tape: Arc<Tape>,
    evaluator: Evaluator,
    n: usize,
    count: usize,
    /// Number of conditions on places.
    placed: usize,
    anchor: Vec<f64>,
    leads: Vec<Leads>,
}

impl Paths {
    /// Of these conditions on rates, beside those on places, with the start.
    ///
    /// *Errors*: a formula without a value at the start.
    pub(super) fn new(
        equations: &Equations,
        (conditions, placed): (&[usize], &[usize]),
        parameters: &[f64],
        start: &[f64],
    ) -> Result<Paths, Fault> {
        let n = equations.coordinates.len();
        let mut graph = equations.graph.clone();
        let mut roots = roots(equations, conditions, &mut graph);
        let zero = graph.zero();
        roots.extend(placed.iter().map(|c| equations.conditions[*c].place.unwrap_or(zero)));
        placed.iter().for_each(|c| roots.extend(levers(equations, *c, zero)));
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
        let (placed, anchor) = (placed.len(), start[..n].to_vec());
        let mut paths = Paths { tape, evaluator, n, count, placed, anchor, leads: Vec::new() };
        let straight = paths.gradients()?;
        let within = if straight.iter().all(|exact| *exact) { vec![false; count] } else { paths.gradients_within() };
        let lead = |(straight, within): (&bool, &bool)| match (straight, within) {
            (true, _) => Leads::Straight,
            (false, true) => Leads::Within,
            (false, false) => Leads::Anywhere,
        };
        paths.leads = straight.iter().zip(&within).map(lead).collect();
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

    /// Whether a condition, counted among those on rates, says where the machine can be.
    pub(super) fn leads_to_place(&self, slot: usize) -> bool {
        self.leads[slot] != Leads::Anywhere
    }

    /// The same of each of them.
    pub(super) fn exact(&self) -> impl Iterator<Item = bool> {
        self.leads.iter().map(|leads| *leads != Leads::Anywhere)
    }

    /// The start, then places around it.
    fn looked_at(&self, look: usize, random: &mut Random) -> Vec<f64> {
        let aside = |v: &f64, random: &mut Random| if look > 0 { BESIDE * random.between(-1.0, 1.0) * v.abs().max(1.0) } else { 0.0 };
        self.anchor.iter().map(|v| v + aside(v, random)).collect()
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
            let q = self.looked_at(look, &mut random);
            let values = match self.values(&q) {
                Ok(values) => values,
                Err(fault) if look == 0 => return Err(fault),
                Err(_) => continue,
            };
            let mixed = &values[count * n..count * n * (n + 1)];
            for (c, by) in mixed.chunks_exact((n * n).max(1)).enumerate() {
                let largest = by.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
                let agree = |p: usize| (by[p] - by[(p % n) * n + p / n]).abs() <= GRADIENT * largest;
                exact[c] &= (0..n * n).all(agree);
            }
        }
        Ok(exact)
    }

    /// The same on pairs of directions that the conditions on places allow, at the start and at places around it on which these hold.
    fn gradients_within(&mut self) -> Vec<bool> {
        let (n, count) = (self.n, self.count);
        let mut exact = vec![self.placed > 0; count];
        let mut looked = 0;
        let mut random = Random::new(31);
        for look in 0..=LOOKS {
            let q = self.looked_at(look, &mut random);
            let mut at = |instant: &Instant| self.slopes(instant);
            let Ok(((_, q), slopes)) = (Ways { at: &mut at }).onto(&(0.0, q)) else { continue };
            let Ok(values) = self.values(&q) else { continue };
            looked += 1;
            let free = Qr::alike(&slopes.gradients, self.placed, n, DEPENDENT).null_space();
            for (c, by) in values[count * n..count * n * (n + 1)].chunks_exact((n * n).max(1)).enumerate() {
                let largest = by.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
                let form = |u: &[f64], v: &[f64]| (0..n * n).map(|p| u[p / n] * by[p] * v[p % n]).sum::<f64>();
                let agree = |u: &Vec<f64>, v: &Vec<f64>| (form(u, v) - form(v, u)).abs() <= GRADIENT * largest * norm(u) * norm(v);
                exact[c] &= free.iter().enumerate().all(|(k, u)| free[..k].iter().all(|v| agree(u, v)));
            }
        }
        if looked > 0 { exact } else { vec![false; count] }
    }

    fn slopes(&mut self, (_, q): &Instant) -> Result<Slopes, Fault> {
        let (n, count, placed) = (self.n, self.count, self.placed);
        let values = self.values(q)?;
        let rows = values[..count * n].chunks_exact(n.max(1)).map(|row| [row, &[0.0]].concat()).collect();
        let places = &values[count * n * (n + 1)..];
        Ok(Slopes { rows, places: places[..placed].to_vec(), gradients: places[placed..].to_vec() })
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
        let within = if self.leads.contains(&Leads::Within) {
            let mut at = |instant: &Instant| self.slopes(instant);
            Ways { at: &mut at }.integrals(&(0.0, anchor), &(0.0, q.to_vec()))?
        } else {
            found.clone()
        };
        let of = |(slot, leads): (usize, &Leads)| if *leads == Leads::Within { within[slot][0] } else { found[slot][0] };
        Ok(self.leads.iter().enumerate().map(of).collect())
    }
}

/// J of a condition.
fn levers(equations: &Equations, condition: usize, zero: Expr) -> Vec<Expr> {
    let mut row = vec![zero; equations.coordinates.len()];
    equations.conditions[condition].columns.iter().for_each(|(j, e)| row[*j] = *e);
    row
}

/// J of each condition, then ∂J_i/∂q_j of each.
fn roots(equations: &Equations, conditions: &[usize], graph: &mut Graph) -> Vec<Expr> {
    let zero = graph.zero();
    let known = definitions(equations);
    let mut rows = Vec::new();
    conditions.iter().for_each(|c| rows.push(levers(equations, *c, zero)));
    let mut list = rows.concat();
    let mut by: Vec<symbolic::Derivation> = Vec::new();
    for coordinate in &equations.coordinates {
        by.push(Derivation::through(graph, &known, coordinate.symbols[0]));
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
    let placed: Vec<usize> = (0..equations.conditions.len()).filter(|c| equations.conditions[*c].place.is_some()).collect();
    Ok(rates.is_empty() || Paths::new(equations, (&rates, &placed), parameters, q)?.exact().all(|exact| exact))
}
