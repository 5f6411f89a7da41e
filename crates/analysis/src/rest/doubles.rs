//! The equations of rest with connections in twice the digits, see [`super::fine`].

use symbolic::{Equations, Expr, Graph, SymbolId};

/// The equations as expressions.
#[derive(Clone, Debug)]
pub(super) struct Whole {
    pub(super) graph: Graph,
    /// Rows, then their derivatives by each z.
    pub(super) list: Vec<Expr>,
    /// Rows that stand in `list` for each z.
    pub(super) count: usize,
    pub(super) definitions: Vec<(SymbolId, Expr)>,
    pub(super) z: Vec<SymbolId>,
    pub(super) zeros: Vec<SymbolId>,
    /// Parameters with the values of the file and what those have below their last digits.
    pub(super) parameters: Vec<(SymbolId, f64, f64)>,
    pub(super) coordinates: Vec<SymbolId>,
}

impl Whole {
    pub(super) fn new(equations: &Equations, graph: Graph, (list, count): (Vec<Expr>, usize), z: &[SymbolId]) -> Whole {
        let own = |p: &symbolic::equations::Parameter| (p.symbol, p.value, p.rest);
        let rates = equations.coordinates.iter().flat_map(|c| [c.symbols[1], c.symbols[2]]);
        // what a frame gives is rounded: a motion that it leaves free would have a stiffness
        let mounted = |s: &SymbolId| equations.mounted.as_ref().is_some_and(|m| m.numbers().contains(s));
        Whole {
            graph,
            list,
            count,
            definitions: super::formulas::definitions(equations),
            z: z.to_vec(),
            zeros: rates.chain([equations.time]).collect(),
            parameters: equations.parameters.iter().map(own).map(|p| if mounted(&p.0) { (p.0, f64::NAN, 0.0) } else { p }).collect(),
            coordinates: equations.coordinates.iter().map(|c| c.symbols[0]).collect(),
        }
    }
}
