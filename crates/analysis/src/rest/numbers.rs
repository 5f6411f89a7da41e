//! Numbers of all symbols at a place of rest.

use std::collections::BTreeMap;

use algebra::double::Double;
use symbolic::equations::Parameter;
use symbolic::{Equations, Expr, SymbolId};

/// Values with rates, accelerations and time zero; a symbol without a value counts as zero.
#[derive(Clone, Debug)]
pub struct Numbers<'e> {
    equations: &'e Equations,
    values: BTreeMap<SymbolId, f64>,
    /// What values have below their last digits, where the place is known so; empty elsewhere.
    below: BTreeMap<SymbolId, f64>,
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
        let mut numbers = Numbers { equations, values, below: BTreeMap::new() };
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

    /// The same with what coordinates, and then reactions, have below their last digits; as it is where there is none of it.
    pub fn below(mut self, below: &[f64]) -> Numbers<'e> {
        if below.is_empty() {
            return self;
        }
        let equations = self.equations;
        let reactions = equations.reactions.iter().map(|r| r.symbol);
        let unknowns = equations.coordinates.iter().map(|c| c.symbols[0]).chain(reactions);
        self.below.extend(unknowns.zip(below.iter().copied()));
        let own = |p: &&Parameter| self.values.get(&p.symbol).is_some_and(|v| v.to_bits() == p.value.to_bits());
        let parameters: Vec<(SymbolId, f64)> = equations.parameters.iter().filter(own).map(|p| (p.symbol, p.rest)).collect();
        self.below.extend(parameters);
        for d in &equations.definitions {
            if let Some([high, low]) = self.double(d.formula).map(Double::parts) {
                self.values.insert(d.symbol, high);
                self.below.insert(d.symbol, low);
            }
        }
        self
    }

    fn double(&self, formula: Expr) -> Option<Double> {
        let of = |map: &BTreeMap<SymbolId, f64>, s: SymbolId| map.get(&s).copied().unwrap_or(0.0);
        Some(self.equations.graph.evaluate_double(&[formula], &|s| Some(Double::of(of(&self.values, s), of(&self.below, s))))?[0])
    }

    /// The same with more values: those of reactions.
    pub fn with(mut self, more: impl IntoIterator<Item = (SymbolId, f64)>) -> Numbers<'e> {
        self.values.extend(more);
        self
    }

    /// The value of an expression, zero where a few roundings of the coordinates and of the values given with [`Numbers::with`] make as much of it.
    pub fn settled(&self, formula: Expr) -> f64 {
        if !self.below.is_empty()
            && let Some(value) = self.double(formula)
        {
            return value.round();
        }
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
        let single = |list: &[Expr]| self.equations.graph.evaluate(list, &|s| self.values.get(&s).copied().unwrap_or(0.0));
        if self.below.is_empty() {
            return single(roots);
        }
        roots.iter().map(|e| self.double(*e).map_or_else(|| single(&[*e])[0], Double::round)).collect()
    }
}
