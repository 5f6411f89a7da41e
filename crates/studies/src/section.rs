//! Formulas of a study evaluated along a motion: over time, coordinates, rates, auxiliary states, parameters and definitions.

use symbolic::{Equations, Expr};

/// A function of (t, state) from a formula of the model.
pub fn of_state(equations: &Equations, formula: Expr) -> impl Fn(f64, &[f64]) -> f64 + '_ {
    let graph = &equations.graph;
    let mut constants = vec![0.0; graph.symbol_count()];
    equations.parameters.iter().for_each(|p| constants[p.symbol.index()] = p.value);
    let n = equations.coordinates.len();
    move |t, x| {
        let mut values = constants.clone();
        values[equations.time.index()] = t;
        for (i, c) in equations.coordinates.iter().enumerate() {
            values[c.symbols[0].index()] = x[i];
            values[c.symbols[1].index()] = x[n + i];
        }
        for (k, a) in equations.auxiliaries.iter().enumerate() {
            values[a.symbol.index()] = x[2 * n + k];
        }
        for d in &equations.definitions {
            values[d.symbol.index()] = graph.evaluate(&[d.formula], &|s| values[s.index()])[0];
        }
        graph.evaluate(&[formula], &|s| values[s.index()])[0]
    }
}
