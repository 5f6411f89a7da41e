//! What rests: equations of equilibrium of a machine with everything that can hold it, and their exact derivatives.
//!
//! With rates and accelerations zero and time 0, over z = (q, λ, u): coordinates, reactions, unknown parameters
//!
//! ```text
//! forces      h(q, u) + Σ_k forces_k(q) λ_k = 0      one for each coordinate
//! places      c(q, u) = 0                            one for each condition in force
//! balances    rest + Σ_k released_k λ_k = 0          displacements of released bodies, where all loads have a place
//! ```
//!
//! A homogeneous condition on rates has the place that its integral from the start gives ([`super::path`]); where it is not integrable (rolling in space, a
//! skate) it has none, and only places that rest already count. An inhomogeneous one (a circuit: R i = U) says what must hold at rest, and that is its place.

use std::sync::Arc;

use program::lower::{self, Inputs};
use program::{Evaluator, Point, Tape};
use symbolic::connections::Law;
use symbolic::{Derivation, Equations, Expr, Graph, SymbolId};

use super::doubles::Whole;
use super::formulas::{at_rest, definitions};
use super::path::Paths;
use super::sizes::Sizes;
use crate::Fault;

/// A row: its value and its derivatives by z.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Row {
    /// Value.
    pub value: f64,
    /// ∂/∂q, ∂/∂λ, ∂/∂u.
    pub slopes: Vec<f64>,
    /// Size of the terms that add up to it, beside what its slopes make of z: those that cancel, and a share of the machine's size.
    pub terms: f64,
    /// Whether it is a force or a moment: such rows are compared with the largest of them too, because all terms of one may vanish at rest.
    pub is_force: bool,
}

/// Bound of the rounding of a sum relative to its terms: a few units, with slack for several operations.
pub(crate) const ROUNDED: f64 = 16.0 * f64::EPSILON;

/// The equations at a z.
#[derive(Clone, Debug, Default)]
pub struct Rows {
    /// One for each coordinate.
    pub forces: Vec<Row>,
    /// One for each condition in force.
    pub places: Vec<Row>,
    /// Balances of released bodies.
    pub balances: Vec<Row>,
    /// Start values of the coordinates as functions of u.
    pub starts: Vec<Row>,
    /// Gap of each contact, in the order of [`RestSystem::contacts`].
    pub gaps: Vec<Row>,
    /// Static limit (or coefficient) and normal force (1 where none) of each friction, in the order of [`RestSystem::frictions`].
    pub limits: Vec<(Row, Row)>,
}

/// The equations as a tape.
#[derive(Clone, Debug)]
pub struct RestSystem {
    tape: Arc<Tape>,
    evaluator: Evaluator,
    values: Vec<f64>,
    /// Number of coordinates.
    pub n: usize,
    /// Reactions (by index in the equations) that λ consists of.
    pub reactions: Vec<usize>,
    /// Parameters (by index) that u consists of.
    pub unknowns: Vec<usize>,
    /// Conditions in force.
    pub conditions: Vec<usize>,
    /// Homogeneous conditions on rates among [`RestSystem::conditions`], by place in that list.
    pub rate_only: Vec<bool>,
    /// All contacts of the machine, by index of the reaction.
    pub contacts: Vec<usize>,
    /// All frictions of the machine, by index of the reaction.
    pub frictions: Vec<usize>,
    balances: usize,
    paths: Option<Paths>,
    sizes: Sizes,
    pub(super) whole: Arc<Whole>,
}

/// What takes part.
#[derive(Clone, Debug, Default)]
pub struct Parts {
    /// Reactions in force.
    pub reactions: Vec<usize>,
    /// Conditions in force.
    pub conditions: Vec<usize>,
    /// Parameters that are unknown.
    pub unknowns: Vec<usize>,
}

impl Parts {
    /// Everything that can hold the machine at rest: contacts for which `closed` says so, frictions, supports, motors, all ideal connections.
    pub fn holding(equations: &Equations, closed: impl Fn(usize) -> bool) -> Parts {
        let mut parts = Parts::default();
        for (r, reaction) in equations.reactions.iter().enumerate() {
            match &reaction.law {
                Law::Ideal { condition } => {
                    parts.reactions.push(r);
                    parts.conditions.push(*condition);
                }
                Law::Contact { condition, .. } if closed(r) => {
                    parts.reactions.push(r);
                    parts.conditions.push(*condition);
                }
                Law::Rough { condition, contact } if closed(*contact) => {
                    parts.reactions.push(r);
                    parts.conditions.push(*condition);
                }
                Law::Contact { .. } | Law::Rough { .. } => {}
                Law::Friction(_) | Law::Support | Law::Motor | Law::Place | Law::Transmission | Law::Tension => parts.reactions.push(r),
            }
        }
        parts.conditions.extend((0..equations.conditions.len()).filter(|c| equations.conditions[*c].reaction.is_none()));
        parts.conditions.sort_unstable();
        parts
    }

    /// The same without dry friction and without supports, whose reactions act on no coordinate.
    pub fn smooth(mut self, equations: &Equations) -> Parts {
        self.reactions.retain(|r| !matches!(equations.reactions[*r].law, Law::Friction(_)) && !equations.reactions[*r].law.is_hidden());
        self
    }
}

/// Roots in their order, in one list.
struct Roots {
    list: Vec<Expr>,
    rate_only: Vec<bool>,
    balances: usize,
}

impl RestSystem {
    /// The equations for these parts; `parameters` are the numbers of the machine.
    ///
    /// *Errors*: formulas outside their domain.
    pub fn new(equations: &Equations, parts: Parts, parameters: &[f64]) -> Result<RestSystem, Fault> {
        let mut graph = equations.graph.clone();
        let roots = roots(equations, &parts, &mut graph);
        let z = variables(equations, &parts);
        let mut list: Vec<(String, Expr)> = Vec::new();
        list.extend(roots.list.iter().enumerate().map(|(i, e)| (format!("rest {}", i + 1), *e)));
        let definitions = definitions(equations);
        for (j, symbol) in z.iter().enumerate() {
            let mut by = Derivation::through(&mut graph, &definitions, *symbol);
            for (i, e) in roots.list.iter().enumerate() {
                list.push((format!("rest {} by {}", i + 1, j + 1), by.apply(&mut graph, *e)));
            }
        }
        let n = equations.coordinates.len();
        let rates = equations.coordinates.iter().flat_map(|c| [c.symbols[1], c.symbols[2]]);
        let inputs = Inputs {
            parameters: equations.parameters.iter().map(|p| p.symbol).collect(),
            states: z[..n + parts.reactions.len()].to_vec(),
            zeros: rates.chain([equations.time]).collect(),
            definitions,
            ..Inputs::default()
        };
        let tape = Arc::new(lower::expressions(&graph, "rest", &inputs, &list)?);
        let whole = Whole::new(equations, graph, (list.into_iter().map(|(_, e)| e).collect(), roots.list.len()), &z);
        let of = |wanted: fn(&Law) -> bool| (0..equations.reactions.len()).filter(|r| wanted(&equations.reactions[*r].law)).collect();
        Ok(RestSystem {
            evaluator: Evaluator::new(&tape, parameters)?,
            values: parameters.to_vec(),
            tape,
            n,
            contacts: of(|law| matches!(law, Law::Contact { .. })),
            frictions: of(|law| matches!(law, Law::Friction(_))),
            reactions: parts.reactions,
            unknowns: parts.unknowns,
            conditions: parts.conditions,
            rate_only: roots.rate_only,
            balances: roots.balances,
            paths: None,
            sizes: Sizes::new(equations.coordinates.iter().map(|c| c.unit.as_str())),
            whole: Arc::new(whole),
        })
    }

    /// The same with the places of conditions on rates, counted from the start.
    ///
    /// *Errors*: a formula without a value at the start.
    pub fn anchored(mut self, equations: &Equations, start: &[f64]) -> Result<RestSystem, Fault> {
        let rates: Vec<usize> = (0..self.conditions.len()).filter(|c| self.rate_only[*c]).map(|c| self.conditions[c]).collect();
        if !rates.is_empty() {
            let placed: Vec<usize> = (0..self.conditions.len()).filter(|c| !self.rate_only[*c]).map(|c| self.conditions[c]).collect();
            self.paths = Some(Paths::new(equations, (&rates, &placed), &self.values, start)?);
        }
        Ok(self)
    }

    /// Takes other numbers for the parameters, and another start.
    ///
    /// *Errors*: formulas outside their domain.
    pub fn set(&mut self, parameters: &[f64], start: &[f64]) -> Result<(), Fault> {
        self.values = parameters.to_vec();
        self.evaluator = Evaluator::new(&self.tape, &self.values)?;
        match &mut self.paths {
            Some(paths) => paths.set(parameters, start),
            None => Ok(()),
        }
    }

    /// Whether a condition on rates, counted among those alone, leads to a place.
    pub(super) fn leads_to_place(&self, slot: usize) -> bool {
        self.paths.as_ref().is_some_and(|p| p.leads_to_place(slot))
    }

    /// From where conditions on rates are counted.
    pub(super) fn anchor(&self) -> Option<&[f64]> {
        self.paths.as_ref().map(Paths::anchor)
    }

    /// Whether conditions on rates are counted from a start.
    pub fn has_paths(&self) -> bool {
        self.paths.is_some()
    }

    /// Conditions on rates that are not integrable, by index in the equations.
    pub fn wandering(&self) -> Vec<usize> {
        let rates = (0..self.conditions.len()).filter(|c| self.rate_only[*c]).map(|c| self.conditions[c]);
        let exact = self.paths.iter().flat_map(Paths::exact);
        rates.zip(exact).filter(|(_, exact)| !exact).map(|(c, _)| c).collect()
    }

    /// The sizes of the coordinates at a place.
    pub fn sizes(&self) -> &Sizes {
        &self.sizes
    }

    /// Number of components of z.
    pub fn width(&self) -> usize {
        self.n + self.reactions.len() + self.unknowns.len()
    }

    /// z for coordinates, with reactions zero and the unknowns as they stand.
    pub fn z(&self, q: &[f64]) -> Vec<f64> {
        let mut z = q[..self.n].to_vec();
        z.resize(self.n + self.reactions.len(), 0.0);
        z.extend(self.unknowns.iter().map(|u| self.values[*u]));
        z
    }

    /// The numbers of all parameters, unknowns as they were last evaluated.
    pub fn parameters(&self) -> &[f64] {
        &self.values
    }

    /// The equations at z.
    ///
    /// *Errors*: a formula has no finite value there.
    pub fn at(&mut self, z: &[f64]) -> Result<Rows, Fault> {
        let (n, k) = (self.n, self.reactions.len());
        let mut changed = false;
        for (u, value) in self.unknowns.iter().zip(&z[n + k..]) {
            changed |= self.values[*u] != *value;
            self.values[*u] = *value;
        }
        if changed {
            self.evaluator = Evaluator::new(&self.tape, &self.values)?;
        }
        let width = self.width();
        let values = self.evaluator.evaluate(&Point { states: &z[..n + k], ..Point::default() })?.to_vec();
        let count = values.len() / (width + 1);
        let roundings = self.evaluator.root_roundings();
        let row = |i: usize| {
            let slopes: Vec<f64> = (0..width).map(|j| values[count * (j + 1) + i]).collect();
            let terms = roundings[i] / ROUNDED + self.sizes.beside(&slopes[..n], &z[..n]);
            Row { value: values[i], slopes, terms, is_force: false }
        };
        let mut next = 0;
        let mut take = |how_many: usize| -> Vec<Row> {
            let rows = (next..next + how_many).map(row).collect();
            next += how_many;
            rows
        };
        let (mut forces, mut places, mut balances, starts) = (take(n), take(self.conditions.len()), take(self.balances), take(n));
        let gaps = take(self.contacts.len());
        let limits = (0..self.frictions.len()).map(|_| take(2)).map(|mut pair| (pair.remove(0), pair.remove(0))).collect();
        let jacobian = take(self.rate_only.iter().filter(|r| **r).count() * n);
        let integrals = match &mut self.paths {
            Some(paths) => paths.places(&z[..n])?,
            None => Vec::new(),
        };
        for (slot, c) in (0..places.len()).filter(|c| self.rate_only[*c]).enumerate() {
            (0..n).for_each(|j| places[c].slopes[j] = jacobian[slot * n + j].value);
            if self.paths.as_ref().is_some_and(|p| p.leads_to_place(slot)) {
                places[c].value = integrals[slot];
            }
        }
        forces.iter_mut().chain(&mut balances).for_each(|row| row.is_force = true);
        for (c, row) in places.iter_mut().enumerate() {
            // a place that is an integral has no terms of its own
            let made =
                if self.rate_only[c] { row.slopes[..n].iter().map(|s| s.abs()).sum() } else { self.sizes.made(&row.slopes[..n], &z[..n]) };
            row.terms += made;
        }
        let finite = forces.iter().chain(&places).chain(&balances).all(|r| r.value.is_finite() && r.slopes.iter().all(|s| s.is_finite()));
        if finite {
            Ok(Rows { forces, places, balances, starts, gaps, limits })
        } else {
            Err(Fault::not_finite(&words::Text::new("force of rest", "сила в покое"), 0.0))
        }
    }
}

fn variables(equations: &Equations, parts: &Parts) -> Vec<SymbolId> {
    let q = equations.coordinates.iter().map(|c| c.symbols[0]);
    let reactions = parts.reactions.iter().map(|r| equations.reactions[*r].symbol);
    q.chain(reactions).chain(parts.unknowns.iter().map(|u| equations.parameters[*u].symbol)).collect()
}

fn roots(equations: &Equations, parts: &Parts, graph: &mut Graph) -> Roots {
    let n = equations.coordinates.len();
    let zero = graph.zero();
    let acting = |graph: &mut Graph, r: usize, e: Expr| {
        let symbol = graph.symbol(equations.reactions[r].symbol);
        graph.mul(e, symbol)
    };
    let mut list = equations.force.clone();
    for &r in &parts.reactions {
        for (j, e) in &equations.reactions[r].forces {
            let term = acting(graph, r, *e);
            list[*j] = graph.add(list[*j], term);
        }
    }
    let mut rate_only = Vec::new();
    for &c in &parts.conditions {
        let condition = &equations.conditions[c];
        let still = condition.place.is_none().then(|| at_rest(equations, graph, condition.rate));
        rate_only.push(still.is_some_and(|e| graph.is_zero(e)));
        list.push(condition.place.or(still).unwrap_or(zero));
    }
    let rows: Vec<usize> = if needs_balances(equations) { (0..equations.balances.len()).collect() } else { Vec::new() };
    for &b in &rows {
        let mut terms = vec![equations.balances[b].rest];
        for &r in &parts.reactions {
            for (_, e) in equations.reactions[r].released.iter().filter(|(row, _)| *row == b) {
                terms.push(acting(graph, r, *e));
            }
        }
        list.push(graph.sum(&terms));
    }
    list.extend(equations.coordinates.iter().map(|c| c.start));
    let laws = |wanted: fn(&Law) -> bool| equations.reactions.iter().map(|r| &r.law).filter(move |law| wanted(law));
    for law in laws(|law| matches!(law, Law::Contact { .. })) {
        if let Law::Contact { gap, .. } = law {
            list.push(*gap);
        }
    }
    for law in laws(|law| matches!(law, Law::Friction(_))) {
        if let Law::Friction(friction) = law {
            list.push(friction.fixed);
            let normal = match &friction.normal {
                None => graph.one(),
                Some(normal) => {
                    let mut terms = vec![normal.constant];
                    for (r, e) in normal.terms.iter().filter(|(r, _)| parts.reactions.contains(r)) {
                        terms.push(acting(graph, *r, *e));
                    }
                    graph.sum(&terms)
                }
            };
            list.push(normal);
        }
    }
    for (c, _) in parts.conditions.iter().zip(&rate_only).filter(|(_, only)| **only) {
        let mut row = vec![zero; n];
        equations.conditions[*c].columns.iter().for_each(|(j, e)| row[*j] = *e);
        list.extend(row);
    }
    Roots { list, rate_only, balances: rows.len() }
}

/// Balances repeat what the coordinates say; they are needed where there are none, or where a support presses a friction.
fn needs_balances(equations: &Equations) -> bool {
    let is_support = |r: &usize| matches!(equations.reactions[*r].law, Law::Support);
    let pressed = |law: &Law| match law {
        Law::Friction(friction) => friction.components().flat_map(|n| &n.terms).any(|(r, _)| is_support(r)),
        _ => false,
    };
    equations.coordinates.is_empty() || equations.reactions.iter().any(|r| pressed(&r.law))
}
