//! Numbers of all symbols at a place of rest.

use std::collections::BTreeMap;

use symbolic::{Equations, Expr, SymbolId};

/// Values with rates, accelerations and time zero; a symbol without a value counts as zero.
#[derive(Clone, Debug)]
pub struct Numbers<'e> {
    equations: &'e Equations,
    values: BTreeMap<SymbolId, f64>,
}

/// Share by which a number is moved to see what it does.
const PROBE: f64 = 1e-6;
/// Rounding of the numbers that a value follows from, relative.
const ROUNDED: f64 = 4.0 * f64::EPSILON;

impl<'e> Numbers<'e> {
    /// At the coordinates `q`, with these numbers for the parameters.
    pub fn at_rest(equations: &'e Equations, parameters: &[f64], q: &[f64]) -> Numbers<'e> {
        Numbers::at(equations, (parameters, q), 0.0)
    }

    /// The same at a later time, by which auxiliaries have gone on at the rates that they have at the start.
    pub fn at(equations: &'e Equations, (parameters, q): (&[f64], &[f64]), time: f64) -> Numbers<'e> {
        let mut values: BTreeMap<SymbolId, f64> = equations.parameters.iter().map(|p| p.symbol).zip(parameters.iter().copied()).collect();
        values.extend(equations.coordinates.iter().map(|c| c.symbols[0]).zip(q.iter().copied()));
        values.insert(equations.time, time);
        let mut numbers = Numbers { equations, values };
        // rates of auxiliaries may hold definitions, and definitions auxiliaries
        for _ in 0..2 {
            for a in &equations.auxiliaries {
                let turned = if time == 0.0 { 0.0 } else { numbers.evaluate(&[a.rate])[0] * time };
                let start = numbers.evaluate(&[a.start])[0];
                numbers.values.insert(a.symbol, start + turned);
            }
            for (symbol, formula) in equations.definitions.iter().map(|d| (d.symbol, d.formula)) {
                let value = numbers.evaluate(&[formula])[0];
                numbers.values.insert(symbol, value);
            }
        }
        numbers
    }

    /// The same with more values: those of reactions.
    pub fn with(mut self, more: impl IntoIterator<Item = (SymbolId, f64)>) -> Numbers<'e> {
        self.values.extend(more);
        self
    }

    /// The value of an expression, zero where a few roundings of the coordinates and of the values given with [`Numbers::with`] make as much of it.
    pub fn settled(&self, formula: Expr) -> f64 {
        let value = self.evaluate(&[formula])[0];
        if value == 0.0 || !value.is_finite() {
            return value;
        }
        let graph = &self.equations.graph;
        let parameter = |s: &SymbolId| self.equations.parameters.iter().any(|p| p.symbol == *s);
        let moved = graph.symbols_in(&[formula]).into_iter().filter(|s| !parameter(s));
        let slope = |s: SymbolId| {
            let own = self.values.get(&s).copied().unwrap_or(0.0);
            let there =
                graph.evaluate(&[formula], &|t| if t == s { own * (1.0 + PROBE) } else { self.values.get(&t).copied().unwrap_or(0.0) });
            (there[0] - value).abs() / PROBE
        };
        let terms: f64 = moved.map(slope).filter(|s| s.is_finite()).sum();
        if value.abs() <= ROUNDED * terms { 0.0 } else { value }
    }

    /// The values of expressions.
    pub fn evaluate(&self, roots: &[Expr]) -> Vec<f64> {
        self.equations.graph.evaluate(roots, &|s| self.values.get(&s).copied().unwrap_or(0.0))
    }
}
