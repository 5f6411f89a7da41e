//! A machine reduced to one coordinate: J(φ) q'' + B(φ) q' + K(φ) q = 0 about each position φ, as if springs were set so that it is one of equilibrium.
//!
//! ```text
//! J = M(φ),   K = -∂Q/∂φ at φ' = 0,   B = -∂Q/∂φ' at φ' = 0        Q all generalized forces
//! ```

use super::asked::{About, Stability};
use crate::machine::Machine;
use crate::machine::bind::Binding;
use symbolic::{Equations, Expr, Graph, Substitution, SymbolId};
use words::Notice;

/// The coefficients as formulas of φ, with the numbers of the machine.
#[derive(Clone, Debug)]
pub(super) struct Reduction {
    /// Owner of the formulas; it extends that of the equations of motion.
    pub(super) graph: Graph,
    /// φ.
    pub(super) angle: SymbolId,
    /// J, K, B.
    pub(super) formulas: [Expr; 3],
    /// All nodes below them, operands first.
    order: Vec<Expr>,
    values: Vec<f64>,
}

impl Reduction {
    /// *Errors*: S142.
    pub(super) fn of(machine: &Machine, angle: SymbolId) -> Result<Reduction, Notice> {
        let equations = &machine.equations;
        if equations.coordinates.len() != 1 || !equations.conditions.is_empty() || !equations.auxiliaries.is_empty() {
            return Err(refused(
                (
                    "the machine has more than one coordinate, or connections that tie it",
                    "у машины больше одной координаты, или координаты связаны",
                ),
                (
                    "describe the positions of all links by formulas of that coordinate, as asin(r/l*sin(phi))",
                    "задайте положения всех звеньев формулами от этой координаты, например asin(r/l*sin(phi))",
                ),
            ));
        }
        let mut graph = equations.graph.clone();
        let rate = equations.coordinates[0].symbols[1];
        let at_rest = graph.zero();
        let [inertia, force] = [equations.mass.get(0, 0), equations.force[0]].map(|e| equations.inlined(&mut graph, e));
        let slope = |symbol: SymbolId, graph: &mut Graph| {
            let derivative = graph.derivative(force, symbol);
            let turned = graph.neg(derivative);
            Substitution::new([(rate, at_rest)]).apply(graph, turned)
        };
        let formulas = [inertia, slope(angle, &mut graph), slope(rate, &mut graph)];
        if formulas.iter().any(|e| graph.contains(*e, |s| s == equations.time)) {
            return Err(refused(
                ("time occurs in the equations", "время входит в уравнения явно"),
                ("ask for the motion itself, with `period`", "исследуйте само движение, задав `period`"),
            ));
        }
        let order = graph.reachable(&formulas);
        let mut reduction = Reduction { graph, angle, formulas, order, values: Vec::new() };
        reduction.put(equations);
        Ok(reduction)
    }

    /// Takes over the numbers of the parameters.
    pub(super) fn put(&mut self, equations: &Equations) {
        self.values = vec![0.0; self.graph.symbol_count()];
        equations.parameters.iter().for_each(|p| self.values[p.symbol.index()] = p.value);
    }

    /// J, K, B at φ.
    pub(super) fn at(&self, phi: f64) -> [f64; 3] {
        let mut known = vec![0.0; self.graph.len()];
        let value = |s: SymbolId| if s == self.angle { phi } else { self.values[s.index()] };
        for e in &self.order {
            known[e.index()] = self.graph.evaluate_node(*e, &value, &|c| known[c.index()]);
        }
        self.formulas.map(|e| known[e.index()])
    }

    /// Whether nothing damps.
    pub(super) fn is_undamped(&self) -> bool {
        self.graph.is_zero(self.formulas[2])
    }
}

/// The reduction of a machine that was given other values, where the study has one.
///
/// *Errors*: S142.
pub(super) fn reduced(own: &mut Option<Reduction>, machine: &Machine, (study, binding): (&Stability, Binding)) -> Result<(), Notice> {
    if let About::Running { angle, .. } = &study.about {
        match own {
            Some(reduction) if binding == Binding::Numbers => reduction.put(&machine.equations),
            reduction => *reduction = Some(Reduction::of(machine, *angle)?),
        }
    }
    Ok(())
}

/// S142.
pub(super) fn refused(why: (&str, &str), help: (&str, &str)) -> Notice {
    Notice::new(
        "S142",
        "the machine is not reduced to one equation with periodic coefficients",
        "машина не приводится к одному уравнению с периодическими коэффициентами",
    )
    .why(why.0, why.1)
    .help(help.0, help.1)
}
