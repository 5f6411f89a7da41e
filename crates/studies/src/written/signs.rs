//! Signs that all motions of a calculation keep: the length √((4 − s)²) is written 4 − s where 4 − s stays positive.

use crate::Finds;
use crate::calculation::Calculation;
use crate::results::Results;
use report::formula::Sign;
use symbolic::{Equations, Expr, Graph, Node, SymbolId};

/// Rows of a motion that are looked at.
const ROWS: usize = 200;

/// Expressions under roots of squares with the sign that they have at all instants of all motions. Between two rows a value is not known: it must stay
/// farther from zero than it ever moves from one row to the next.
pub(super) fn kept(calculation: &Calculation) -> Vec<(Expr, Sign)> {
    let equations = &calculation.machine.equations;
    let known = |r: &&Results| matches!(calculation.machine.origin.studies.finds(r.kind), Finds::Motion | Finds::Drives | Finds::Regime);
    let motions: Vec<&Results> = calculation.results.iter().filter(known).collect();
    if motions.is_empty() || motions.iter().any(|motion| motion.trouble.is_some()) {
        return Vec::new();
    }
    let sized = sized(equations);
    sized.into_iter().filter_map(|e| Some((e, sign(equations, e, &motions)?))).collect()
}

/// What stands squared under a root.
fn sized(equations: &Equations) -> Vec<Expr> {
    let graph = &equations.graph;
    let sides = equations.textbook.iter().flatten().flat_map(|e| [e.left, e.right]);
    let conditions = equations.conditions.iter().flat_map(|c| [Some(c.rate), c.place]).flatten();
    let steps = equations.steps.iter().flat_map(|step| &step.formulas).map(|f| f.right);
    let roots: Vec<Expr> = sides.chain(conditions).chain(steps).collect();
    let mut found = Vec::new();
    for e in graph.reachable(&roots) {
        let Node::Product { factors, .. } = graph.node(e) else { continue };
        for (base, exponent) in factors.iter().filter(|(_, exponent)| !exponent.is_integer()) {
            if exponent.digits().1 == "2" {
                found.extend(squares(graph, *base));
            }
        }
    }
    found.sort();
    found.dedup();
    found
}

/// x of x².
fn squares(graph: &Graph, base: Expr) -> Vec<Expr> {
    let Node::Product { factors, .. } = graph.node(base) else { return Vec::new() };
    let even = |e: &symbolic::Rational| e.to_i64().is_some_and(|n| n % 2 == 0);
    if factors.iter().all(|(_, e)| even(e)) { factors.iter().map(|(b, _)| *b).collect() } else { Vec::new() }
}

/// The sign over all rows of all motions.
fn sign(equations: &Equations, e: Expr, motions: &[&Results]) -> Option<Sign> {
    let mut least = f64::INFINITY;
    let (mut step, mut sign) = (0.0_f64, None);
    for motion in motions {
        let mut before: Option<f64> = None;
        let rows = motion.data.columns.first().map_or(0, |column| column.values.len());
        // the guard knows how far apart the rows are
        for row in (0..rows).step_by((rows / ROWS).max(1)) {
            let value = equations.graph.evaluate(&[e], &|s| number(equations, motion, s, row))[0];
            if !value.is_finite() || value == 0.0 {
                return None;
            }
            let own = if value > 0.0 { Sign::Plus } else { Sign::Minus };
            if *sign.get_or_insert(own) != own {
                return None;
            }
            step = before.map_or(step, |b| step.max((value - b).abs()));
            least = least.min(value.abs());
            before = Some(value);
        }
    }
    sign.filter(|_| least > step)
}

/// The number of a symbol in a row; none for what is no parameter and no coordinate.
fn number(equations: &Equations, motion: &Results, symbol: SymbolId, row: usize) -> f64 {
    if let Some(p) = equations.parameters.iter().find(|p| p.symbol == symbol) {
        return p.value;
    }
    let info = equations.graph.symbol_info(symbol);
    let name = format!("{}{}", info.name, "'".repeat(usize::from(info.primes)));
    motion.data.column(&name).and_then(|column| column.values.get(row)).copied().unwrap_or(f64::NAN)
}
