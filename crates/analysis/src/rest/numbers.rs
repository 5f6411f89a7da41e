//! Numbers of all symbols at a place of rest.

use std::collections::BTreeMap;

use symbolic::{Equations, Expr, SymbolId};

/// Values with rates, accelerations and time zero; a symbol without a value counts as zero.
#[derive(Clone, Debug)]
pub struct Numbers<'e> {
    equations: &'e Equations,
    values: BTreeMap<SymbolId, f64>,
}

impl<'e> Numbers<'e> {
    /// At the coordinates `q`, with these numbers for the parameters.
    pub fn at_rest(equations: &'e Equations, parameters: &[f64], q: &[f64]) -> Numbers<'e> {
        let mut values: BTreeMap<SymbolId, f64> = equations.parameters.iter().map(|p| p.symbol).zip(parameters.iter().copied()).collect();
        values.extend(equations.coordinates.iter().map(|c| c.symbols[0]).zip(q.iter().copied()));
        let mut numbers = Numbers { equations, values };
        let formulas = equations.definitions.iter().map(|d| (d.symbol, d.formula));
        for (symbol, formula) in formulas.chain(equations.auxiliaries.iter().map(|a| (a.symbol, a.start))) {
            let value = numbers.evaluate(&[formula])[0];
            numbers.values.insert(symbol, value);
        }
        numbers
    }

    /// The same with more values: those of reactions.
    pub fn with(mut self, more: impl IntoIterator<Item = (SymbolId, f64)>) -> Numbers<'e> {
        self.values.extend(more);
        self
    }

    /// The values of expressions.
    pub fn evaluate(&self, roots: &[Expr]) -> Vec<f64> {
        self.equations.graph.evaluate(roots, &|s| self.values.get(&s).copied().unwrap_or(0.0))
    }
}
