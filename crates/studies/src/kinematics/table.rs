//! Places as columns: coordinates, rates, outputs, transfer functions.

use super::asked::Kinematics;
use super::centres::Centres;
use algebra::arrange::Arrange;
use analysis::dataset::{Column, Extreme};
use analysis::studies::kinematics::{Observer, Place};
use analysis::{Dataset, Quantity};
use program::lower::Inputs;
use program::{Behind, Evaluator, Point};
use std::sync::Arc;
use symbolic::{Equations, Expr, SymbolId};
use words::Text;

/// An instantaneous centre farther than this is at infinity, m.
const FAR: f64 = 1e9;

/// Formulas over places, rates and accelerations, by the plain evaluator of the graph.
struct Formulas<'e> {
    equations: &'e Equations,
    constants: Vec<f64>,
}

impl<'e> Formulas<'e> {
    fn new(equations: &'e Equations) -> Self {
        let mut constants = vec![0.0; equations.graph.symbol_count()];
        equations.parameters.iter().for_each(|p| constants[p.symbol.index()] = p.value);
        Formulas { equations, constants }
    }

    /// At a place, driven at the uniform rate.
    fn values(&self, place: &Place, rate: f64, formulas: &[Expr]) -> Vec<f64> {
        let graph = &self.equations.graph;
        let mut values = self.constants.clone();
        values[self.equations.time.index()] = place.time;
        for (i, c) in self.equations.coordinates.iter().enumerate() {
            values[c.symbols[0].index()] = place.q[i];
            values[c.symbols[1].index()] = rate * place.first[i];
            values[c.symbols[2].index()] = rate * rate * place.second[i];
        }
        for (a, value) in self.equations.auxiliaries.iter().zip(&place.auxiliaries) {
            values[a.symbol.index()] = *value;
        }
        for d in &self.equations.definitions {
            values[d.symbol.index()] = graph.evaluate(&[d.formula], &|s| values[s.index()])[0];
        }
        graph.evaluate(formulas, &|s| values[s.index()])
    }

    /// The formulas as a tape over (q, q', q'', auxiliary states); none where that is not possible.
    fn tape(&self, formulas: &[Expr]) -> Option<(Evaluator, Arc<Behind>)> {
        let e = self.equations;
        let order = |k: usize| e.coordinates.iter().map(move |c| c.symbols[k]);
        let inputs = Inputs {
            parameters: e.parameters.iter().map(|p| p.symbol).collect(),
            time: Some(e.time),
            states: order(0).chain(order(1)).chain(order(2)).chain(e.auxiliaries.iter().map(|a| a.symbol)).collect(),
            definitions: e.definitions.iter().map(|d| (d.symbol, d.formula)).collect(),
            ..Inputs::default()
        };
        let roots: Vec<(String, Expr)> = formulas.iter().enumerate().map(|(k, f)| (format!("column {}", k + 1), *f)).collect();
        let tape = program::lower::expressions(&e.graph, "kinematics", &inputs, &roots).ok()?;
        let values: Vec<f64> = e.parameters.iter().map(|p| p.value).collect();
        let evaluator = Evaluator::new(&Arc::new(tape), &values).ok()?;
        let behind = Arc::new(Behind::new(&evaluator));
        Some((evaluator, behind))
    }

    /// Whether a formula is free of reactions, directly or through definitions.
    fn is_kinematic(&self, formula: Expr) -> bool {
        let reactions: Vec<SymbolId> = self.equations.reactions.iter().map(|r| r.symbol).collect();
        let mut all = vec![formula];
        let found = self.equations.graph.symbols_in(&all);
        all.extend(self.equations.definitions.iter().filter(|d| found.contains(&d.symbol)).map(|d| d.formula));
        !self.equations.graph.symbols_in(&all).iter().any(|s| reactions.contains(s))
    }
}

/// The columns between the places of the table: formulas, then both transfer functions of each other coordinate. Instantaneous centres are left out: they
/// go to infinity and have no least or greatest place.
pub(super) struct Observing<'e> {
    formulas: Formulas<'e>,
    exprs: Vec<Expr>,
    /// The formulas once more, for what stands behind them.
    tape: Option<(Evaluator, Arc<Behind>)>,
    others: Vec<usize>,
    /// Which columns of the table they are.
    pub columns: Vec<usize>,
    rate: f64,
}

impl Observer for Observing<'_> {
    fn count(&self) -> usize {
        self.exprs.len() + 2 * self.others.len()
    }

    fn values(&mut self, place: &Place) -> Vec<f64> {
        let mut row: Vec<f64> = self.formulas.values(place, self.rate, &self.exprs);
        row.extend(self.others.iter().flat_map(|&i| [place.first[i], place.second[i]]));
        if let Some((evaluator, behind)) = &mut self.tape {
            let w = self.rate;
            let rates = place.first.iter().map(|b| w * b);
            let accelerations = place.second.iter().map(|c| w * w * c);
            let states: Vec<f64> =
                place.q.iter().copied().chain(rates).chain(accelerations).chain(place.auxiliaries.iter().copied()).collect();
            let point = Point { time: place.time, states: &states, ..Point::default() };
            // a result without a value is none of the record's business
            let _ = evaluator.evaluate(&point);
            behind.record(evaluator, &point, &mut row);
        }
        row
    }

    fn behind(&self) -> Arc<Behind> {
        self.tape.as_ref().map_or_else(Arc::default, |(_, behind)| Arc::clone(behind))
    }
}

/// The places as columns.
pub(super) struct Table<'t> {
    pub equations: &'t Equations,
    pub study: &'t Kinematics,
    pub over: usize,
    pub rate: f64,
    pub ways: &'t [f64],
    pub centres: &'t Centres,
}

impl Table<'_> {
    pub fn columns(&self, places: &[Place], extremes: Vec<Extreme>) -> Dataset {
        let own = &self.equations.coordinates[self.over];
        let name = self.name(self.over);
        let axis = Quantity { symbol: self.symbol(&name), label: own.label.clone(), ..Quantity::new(&name, &own.unit) };
        let mut columns = vec![Column { quantity: axis, values: self.ways[..places.len()].to_vec() }];
        columns.extend(self.formulas(places));
        columns.extend(self.transfers(places));
        // in the order in which they were asked for
        if !self.study.outputs.is_empty() {
            let place = |c: &Column| self.study.outputs.iter().position(|o| *o == c.quantity.name);
            let mut chosen: Vec<usize> = (1..columns.len()).filter(|i| place(&columns[*i]).is_some()).collect();
            chosen.arrange_by_key(|i| place(&columns[*i]));
            let of = |(k, i): (usize, &usize)| extremes.iter().find(|e| e.column == *i).map(|e| Extreme { column: k + 1, ..e.clone() });
            let extremes = chosen.iter().enumerate().filter_map(of).collect();
            let columns = std::iter::once(0).chain(chosen.iter().copied()).map(|i| columns[i].clone()).collect();
            return Dataset { axis: Some(0), columns, extremes, ..Dataset::default() };
        }
        Dataset { axis: Some(0), columns, extremes, ..Dataset::default() }
    }

    /// The columns behind the axis, as functions of the place.
    pub fn observing(&self) -> Observing<'_> {
        let formulas = Formulas::new(self.equations);
        let chosen = self.chosen(&formulas);
        let bounded = |o: &symbolic::equations::Output| self.centres.shown(&o.name).is_none_or(|(name, _)| name.starts_with("omega("));
        let (places, exprs): (Vec<usize>, Vec<Expr>) =
            chosen.iter().enumerate().filter(|(_, o)| bounded(o)).map(|(i, o)| (i + 1, o.formula)).unzip();
        let others: Vec<usize> = (0..self.equations.coordinates.len()).filter(|i| *i != self.over).collect();
        let columns = places.into_iter().chain((0..2 * others.len()).map(|k| chosen.len() + 1 + k)).collect();
        Observing { tape: formulas.tape(&exprs), formulas, exprs, others, columns, rate: self.rate }
    }

    /// Outputs that are free of reactions.
    fn chosen(&self, formulas: &Formulas) -> Vec<&symbolic::equations::Output> {
        let lead = self.name(self.over);
        self.equations.outputs.iter().filter(|o| o.name != lead && formulas.is_kinematic(o.formula)).collect()
    }

    fn name(&self, i: usize) -> String {
        self.equations.graph.symbol_info(self.equations.coordinates[i].symbols[0]).name.clone()
    }

    fn symbol(&self, name: &str) -> String {
        self.equations.notation.iter().find(|(n, _)| n == name).map_or(name, |(_, s)| s.as_str()).to_owned()
    }

    /// Coordinates, rates, accelerations, the user's outputs and the instantaneous centres: all formulas free of reactions.
    fn formulas(&self, places: &[Place]) -> Vec<Column> {
        let formulas = Formulas::new(self.equations);
        let chosen = self.chosen(&formulas);
        let exprs: Vec<Expr> = chosen.iter().map(|o| o.formula).collect();
        let mut table: Vec<Vec<f64>> = vec![Vec::with_capacity(places.len()); exprs.len()];
        for place in places {
            let row = formulas.values(place, self.rate, &exprs);
            for ((column, output), v) in table.iter_mut().zip(&chosen).zip(row) {
                let far = self.centres.shown(&output.name).is_some() && (!v.is_finite() || v.abs() >= FAR);
                column.push(if far { f64::NAN } else { v });
            }
        }
        let quantity = |output: &symbolic::equations::Output| match self.centres.shown(&output.name) {
            Some((name, label)) => {
                let symbol = self.centres.symbol(&output.name).unwrap_or_else(|| name.clone());
                Quantity { label, symbol, ..Quantity::new(&name, &output.unit) }
            }
            None => {
                let symbol = self.equations.graph.symbol_info(output.symbol);
                let symbol = format!("{}{}", self.symbol(&symbol.name), "'".repeat(usize::from(symbol.primes)));
                let label = output.label.clone();
                Quantity { symbol, label, display: output.display.clone(), ..Quantity::new(&output.name, &output.unit) }
            }
        };
        chosen.into_iter().zip(table).map(|(output, values)| Column { quantity: quantity(output), values }).collect()
    }

    fn transfers(&self, places: &[Place]) -> Vec<Column> {
        let over = &self.equations.coordinates[self.over];
        let lead = self.name(self.over);
        let mut columns = Vec::new();
        for (i, coordinate) in self.equations.coordinates.iter().enumerate().filter(|(i, _)| *i != self.over) {
            let own = self.name(i);
            let per = |unit: &str, by: &str| if unit == by { "1".to_owned() } else { format!("{unit}/{by}") };
            let first = per(&coordinate.unit, &over.unit);
            let second = if first == "1" { format!("1/{}", over.unit) } else { format!("{first}^2") };
            let [q, s] = [&own, &lead].map(|name| self.symbol(name));
            let label = Text::new("transfer function, first order", "передаточная функция первого порядка");
            let quantity = Quantity { label, symbol: format!("d{q}/d{s}"), ..Quantity::new(&format!("d{own}/d{lead}"), &first) };
            columns.push(Column { quantity, values: places.iter().map(|p| p.first[i]).collect() });
            let label = Text::new("transfer function, second order", "передаточная функция второго порядка");
            let quantity = Quantity { label, symbol: format!("d²{q}/d{s}²"), ..Quantity::new(&format!("d2{own}/d{lead}2"), &second) };
            columns.push(Column { quantity, values: places.iter().map(|p| p.second[i]).collect() });
        }
        columns
    }
}
