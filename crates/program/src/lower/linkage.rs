//! The conditions of connections with further driven coordinates, as one tape: what a linkage is followed by.

use super::equations::sparse;
use super::expressions::{Lowering, Switches};
use super::inputs::over_states;
use crate::program::consecutive;
use crate::{Fault, Tape};
use std::ops::Range;
use symbolic::connections::Condition;
use symbolic::{Equations, Expr, Graph};

/// Formulas of a driven coordinate over the leading one s: value d(s), d'(s), d''(s).
pub type Drive = [Expr; 3];

/// Where the roots of a linkage's tape are; n coordinates, m conditions, k drives, a auxiliary states, g gaps.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct LinkageRoots {
    /// m: places, 0 for conditions on rates only.
    pub places: Range<usize>,
    /// m: rates at the given q'.
    pub rates: Range<usize>,
    /// m n: ∂rate/∂q', row by row.
    pub jacobian: Range<usize>,
    /// m: d(rate)/dt without the terms with q''.
    pub remainders: Range<usize>,
    /// 3 k: value and derivatives of each drive.
    pub drives: Range<usize>,
    /// a: rates of the auxiliary states.
    pub auxiliaries: Range<usize>,
    /// g: the gaps.
    pub gaps: Range<usize>,
}

/// Lowers `conditions`, `drives` and `gaps`, whose expressions stand in `graph` (that of the equations, possibly with more nodes). Inputs t, x;
/// switches go by value.
///
/// *Errors*: P010 for a symbol without a meaning.
pub fn linkage(
    equations: &Equations,
    graph: &Graph,
    conditions: &[&Condition],
    drives: &[Drive],
    gaps: &[Expr],
) -> Result<(Tape, LinkageRoots), Fault> {
    let mut graph = graph.clone();
    let zero = graph.zero();
    let n = equations.coordinates.len();
    let mut formulas: Vec<Expr> = conditions.iter().map(|c| c.place.unwrap_or(zero)).collect();
    formulas.extend(conditions.iter().map(|c| c.rate));
    formulas.extend(conditions.iter().flat_map(|c| sparse(&c.columns, n, zero)));
    formulas.extend(conditions.iter().map(|c| c.remainder));
    formulas.extend(drives.iter().flatten());
    formulas.extend(equations.auxiliaries.iter().map(|a| a.rate));
    formulas.extend(gaps);
    let m = conditions.len();
    let [places, rates, jacobian, remainders, drives, auxiliaries, gaps] =
        consecutive([m, m, m * n, m, 3 * drives.len(), equations.auxiliaries.len(), gaps.len()]);
    let roots: Vec<(String, Expr)> = formulas.into_iter().enumerate().map(|(i, e)| (format!("linkage {}", i + 1), e)).collect();
    let tape = Lowering::new(&graph, &over_states(equations), Switches::Value).tape("linkage", &roots)?;
    Ok((tape, LinkageRoots { places, rates, jacobian, remainders, drives, auxiliaries, gaps }))
}
