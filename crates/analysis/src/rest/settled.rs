//! Rest of a machine with connections in twice the digits, see [`super::fine`].

use std::sync::Arc;

use symbolic::{Expr, SymbolId};

use super::doubles::Whole;
use super::fine::{self, Fine, Sought};
use super::system::RestSystem;
use crate::Fault;
use algebra::double::Double;

impl RestSystem {
    /// Forces and places at z with their derivatives, in twice the digits; none where one of them has none.
    fn in_doubles(&self, whole: &Whole, z: &[Double]) -> Option<fine::Rows> {
        let number = |symbol: SymbolId| {
            if let Some(j) = whole.z.iter().position(|own| *own == symbol) {
                return Some(z[j]);
            }
            if whole.zeros.contains(&symbol) {
                return Some(Double::default());
            }
            let i = whole.parameters.iter().position(|p| p.0 == symbol)?;
            let (_, value, rest) = whole.parameters[i];
            let now = self.parameters()[i];
            (!value.is_nan()).then(|| Double::of(now, if value.to_bits() == now.to_bits() { rest } else { 0.0 }))
        };
        let mut known: Vec<(SymbolId, Double)> = Vec::new();
        for (symbol, formula) in &whole.definitions {
            let value = |s: SymbolId| number(s).or_else(|| known.iter().find(|k| k.0 == s).map(|k| k.1));
            if let Some(found) = whole.graph.evaluate_double(&[*formula], &value) {
                known.push((*symbol, found[0]));
            }
        }
        let value = |s: SymbolId| number(s).or_else(|| known.iter().find(|k| k.0 == s).map(|k| k.1));
        let (n, m) = (self.n, self.n + self.conditions.len());
        let rows = |k: usize| whole.list[k * whole.count..k * whole.count + m].iter().copied();
        let list: Vec<Expr> = (0..=z.len()).flat_map(rows).collect();
        let found = whole.graph.evaluate_double(&list, &value)?;
        let mut values = found[..m].to_vec();
        let mut slopes: Vec<Double> = (0..m * z.len()).map(|p| found[(p % z.len() + 1) * m + p / z.len()]).collect();
        // J of the conditions on rates stands last among the rows of the machine
        let on_rates: Vec<usize> = (0..self.conditions.len()).filter(|c| self.rate_only[*c]).collect();
        let first = whole.count - on_rates.len() * n;
        for (slot, c) in on_rates.iter().enumerate() {
            let entries = &whole.list[first + slot * n..first + (slot + 1) * n];
            let same = entries.iter().all(|e| !whole.graph.contains(*e, |s| whole.coordinates.contains(&s)));
            let anchor = self.anchor()?;
            // its place is a sum only where J is the same everywhere
            let exact = self.leads_to_place(slot);
            if exact && !same {
                return None;
            }
            let row = whole.graph.evaluate_double(entries, &value)?;
            let away = |j: usize| z[j].less(Double::from(anchor[j]));
            let place = (0..n).fold(Double::default(), |sum, j| sum.plus(row[j], away(j)));
            // one that leads to no place holds it where it is
            values[n + c] = if exact { place } else { Double::default() };
            (0..n).for_each(|j| slopes[(n + c) * z.len() + j] = row[j]);
        }
        Some(fine::Rows { values, slopes })
    }

    /// z where weak springs stand beside hard ones: rounded, and what is below; none elsewhere.
    ///
    /// *Errors*: S007 where the weak forces find no rest.
    pub(crate) fn fine(&mut self, z: &[f64], found: Sought) -> Result<Option<[Vec<f64>; 2]>, Fault> {
        let rows = self.at(z)?;
        let all = || rows.forces.iter().chain(&rows.places);
        let slopes: Vec<f64> = all().flat_map(|r| r.slopes.iter().copied()).collect();
        let single = fine::single(&all().map(|r| r.value).collect::<Vec<f64>>(), &slopes, (z, self.n));
        if !found.asks(&single) {
            return Ok(None);
        }
        let whole = Arc::clone(&self.whole);
        match fine::settle(&|z| self.in_doubles(&whole, z), z, self.n) {
            Fine::Plain => Ok(None),
            Fine::Nowhere => Err(super::search::no_equilibrium()),
            // what nothing holds and the loads push on rests nowhere; where single digits took it for balanced they decide
            Fine::Rest(_, unheld) if found == Sought::Lost && !unheld.is_empty() => Err(super::search::no_equilibrium()),
            Fine::Rest(z, _) => {
                let (high, low): (Vec<f64>, Vec<f64>) = z.iter().map(|v| v.parts()).map(|[high, low]| (high, low)).unzip();
                Ok(Some([high, low]))
            }
        }
    }
}
