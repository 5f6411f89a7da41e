//! A linearised machine in twice the digits: where weak springs stand beside hard ones, see [`super::graded`] and [`crate::rest::fine`].

use symbolic::{Equations, Expr, SymbolId};

use super::graded::has_weak_damper;
use super::machine::{LinearMachine, Place};
use super::matrices::Matrices;
use crate::Fault;
use crate::rest::fine::{self, Fine, Sought};
use crate::rest::places::Place as Rest;
use crate::rest::search::no_equilibrium;
use algebra::double::Double;

/// Left of the forces of a free motion beside what the numbers of the machine make of them: some hundred roundings.
const BALANCED_BY_NUMBERS: f64 = 1e-13;
impl LinearMachine {
    /// What C has below its last digits; none where it hangs on a place that is known in single digits only.
    pub(super) fn below(&self, stiffness: &[f64], place: &Place) -> Option<Vec<f64>> {
        let fine = self.doubles(self.linear.stiffness.entries(), place)?;
        Some(fine.iter().zip(stiffness).map(|(fine, single)| fine.less(Double::from(*single)).round()).collect())
    }

    /// What B has below its last digits, empty where no weak damper lies there; none where that is not known. The place counts as exact: forces of dampers are Σ b j jᵀ with directions j of the place, and one a rounding away has the same
    /// weak and hard parts in directions a rounding away.
    pub(super) fn damping_below(&self, damping: &[f64], place: &Place) -> Option<Vec<f64>> {
        let n = self.names.len();
        let here = |symbol: SymbolId| {
            let at = self.linear.coordinates.iter().position(|c| c[0] == symbol).filter(|_| place.below.is_empty())?;
            place.q.get(at).copied().filter(|_| at < n)
        };
        let fine = self.doubles_with(self.linear.damping.entries(), place, &here)?;
        let low: Vec<f64> = fine.iter().zip(damping).map(|(fine, single)| fine.less(Double::from(*single)).round()).collect();
        Some(if has_weak_damper(damping, &low, n) { low } else { Vec::new() })
    }

    /// Expressions of [`Linear::graph`] at a place of rest in twice the digits; none where one hangs on what is known in single digits only.
    pub(super) fn doubles(&self, list: &[Expr], place: &Place) -> Option<Vec<Double>> {
        self.doubles_with(list, place, &|_| None)
    }

    /// The same with numbers for further symbols, which go before those of the place.
    pub(super) fn doubles_with(&self, list: &[Expr], place: &Place, given: &dyn Fn(SymbolId) -> Option<f64>) -> Option<Vec<Double>> {
        let linear = &self.linear;
        let n = self.names.len();
        let resting = place.rates.iter().chain(&place.accelerations).all(|v| *v == 0.0);
        let number = |symbol: SymbolId| {
            if let Some(value) = given(symbol) {
                return Some(Double::from(value));
            }
            if let Some(i) = self.inputs.parameters.iter().position(|p| *p == symbol) {
                let own = &self.equations.parameters[i];
                // what a frame gives is rounded: a motion that it leaves free would have a stiffness
                if self.equations.mounted.as_ref().is_some_and(|mounted| mounted.numbers().contains(&symbol)) {
                    return None;
                }
                let rest = if own.value.to_bits() == self.values[i].to_bits() { own.rest } else { 0.0 };
                return Some(Double::of(self.values[i], rest));
            }
            if let Some(form) = linear.forms.iter().position(|f| f.mean == symbol) {
                return self.shapes.get(form).map(|shape| Double::from(shape.wave.mean));
            }
            if linear.coordinates.iter().any(|c| c[1] == symbol || c[2] == symbol) {
                return resting.then(Double::default);
            }
            let coordinate = linear.coordinates.iter().position(|c| c[0] == symbol).map(|i| (place.q[i], i));
            let multiplier = || linear.multipliers.iter().position(|m| *m == symbol);
            let (high, at) = coordinate.or_else(|| multiplier().map(|k| (place.multipliers.get(k).copied().unwrap_or(0.0), n + k)))?;
            place.below.get(at).map(|low| Double::of(high, *low))
        };
        let mut known: Vec<(SymbolId, Double)> = Vec::new();
        for (symbol, formula) in &linear.definitions {
            let value = |s: SymbolId| number(s).or_else(|| known.iter().find(|k| k.0 == s).map(|k| k.1));
            if let Some(found) = linear.graph.evaluate_double(&[*formula], &value) {
                known.push((*symbol, found[0]));
            }
        }
        let value = |s: SymbolId| number(s).or_else(|| known.iter().find(|k| k.0 == s).map(|k| k.1));
        linear.graph.evaluate_double(list, &value)
    }

    /// The mean forces at rest and their derivatives by the coordinates in twice the digits.
    fn statics_in_doubles(&self, q: &[Double]) -> Option<fine::Rows> {
        let n = self.names.len();
        let (high, below): (Vec<f64>, Vec<f64>) = q.iter().map(|v| v.parts()).map(|[high, low]| (high, low)).unzip();
        let place = Place { below, ..Place::rest(&high) };
        let list: Vec<Expr> = self.linear.force.iter().chain(self.linear.stiffness.entries()).copied().collect();
        let values = self.doubles(&list, &place)?;
        let slopes = values[n..].iter().map(|c| c.negated()).collect();
        Some(fine::Rows { values: values[..n].to_vec(), slopes })
    }

    /// Expressions of the graph at a place of rest of the only coordinate; none where they hang on what is known in single digits only.
    pub fn series_at(&self, list: &[Expr], q: Double) -> Option<Vec<Double>> {
        let [high, low] = q.parts();
        self.doubles(list, &Place { below: vec![low], ..Place::rest(&[high]) })
    }

    /// A place at rest with the digits below its own, where weak springs stand beside hard ones.
    pub fn placed(&mut self, q: &[f64]) -> Place {
        let found = if self.linear.conditions.is_empty() { self.fine_rest(q, Sought::Found).ok().flatten() } else { None };
        found.unwrap_or_else(|| Place::rest(q))
    }

    /// Whether what is left of a free motion's forces is rounding of the numbers of the machine: Σ |p ∂/∂p| over its parameters.
    fn is_rounding(&mut self, place: &Place, unheld: &fine::Unheld) -> bool {
        let n = self.names.len();
        let all: Vec<usize> = (0..self.parameters.len()).collect();
        let Ok(values) = self.forces_by(&all).and_then(|prepared| self.values(&prepared, place)) else { return false };
        let along = |row: &[f64]| -> f64 { row.iter().zip(&unheld.rows).map(|(f, w)| f * w).sum() };
        let terms: f64 = values[n..].chunks(n.max(1)).take(all.len()).enumerate().map(|(p, row)| (along(row) * self.values[p]).abs()).sum();
        unheld.left.abs() <= BALANCED_BY_NUMBERS * terms
    }

    /// The place of rest next to one that single digits give, or to where it is sought, where weak springs stand beside hard ones.
    ///
    /// *Errors*: S007 where the weak forces find no rest.
    pub(crate) fn fine_rest(&mut self, q: &[f64], sought: Sought) -> Result<Option<Place>, Fault> {
        let n = self.names.len();
        let at = Place::rest(q);
        let Matrices { stiffness, force, .. } = self.at(&at)?;
        let slopes: Vec<f64> = stiffness.iter().map(|c| -c).collect();
        if !sought.asks(&fine::single(&force, &slopes, (q, n))) {
            return Ok(None);
        }
        let found = fine::settle(&|q| self.statics_in_doubles(q), q, n);
        let (z, unheld) = match found {
            Fine::Plain => return Ok(None),
            Fine::Nowhere => return Err(no_equilibrium()),
            Fine::Rest(z, unheld) => (z, unheld),
        };
        let (q, below): (Vec<f64>, Vec<f64>) = z.iter().map(|v| v.parts()).map(|[high, low]| (high, low)).unzip();
        let place = Place { below, ..Place::rest(&q) };
        match unheld.iter().all(|u| self.is_rounding(&place, u)) {
            true => Ok(Some(place)),
            false => Err(no_equilibrium()),
        }
    }

    /// A place of rest of these equations as one of small motions.
    pub fn about(&self, place: &Rest, equations: &Equations) -> Place {
        let n = place.q.len();
        let multipliers = &self.linear.multipliers;
        let index = |symbol: &SymbolId| equations.reactions.iter().position(|r| r.symbol == *symbol);
        let of = |symbol: &SymbolId| index(symbol).and_then(|r| place.reactions[r]).unwrap_or(0.0);
        let low = |symbol: &SymbolId| index(symbol).and_then(|r| place.below.get(n + r)).copied().unwrap_or(0.0);
        let below = match place.below.is_empty() {
            true => Vec::new(),
            false => place.below[..n].iter().copied().chain(multipliers.iter().map(low)).collect(),
        };
        Place { multipliers: multipliers.iter().map(of).collect(), below, ..Place::rest(&place.q) }
    }
}
