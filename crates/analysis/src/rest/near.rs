//! The place of rest near another one, for parameters that change: what small motions along a parameter are taken about.

use symbolic::{Equations, SymbolId};

use super::mean::Resting;
use super::newton::{balance, solve, worst};
use super::places::rest_rows;
use super::search::no_equilibrium;
use super::system::{Parts, RestSystem};
use crate::Fault;
use crate::connections::assemble;

/// Remainder of the equations where a place rests as it is, when Newton's method makes it no better.
const RESTS: f64 = 1e-12;

/// Equations of rest with lasting connections; contacts and dry friction are left out.
#[derive(Clone, Debug)]
pub struct Near {
    resting: Resting,
    system: RestSystem,
}

/// Coordinates, and the reactions by their symbols.
pub type Found = (Vec<f64>, Vec<(SymbolId, f64)>);

impl Near {
    /// Of equations of motion whose connections last.
    ///
    /// *Errors*: formulas outside their domain; a start that cannot be assembled where connections are given in rates.
    pub fn new(equations: &Equations) -> Result<Near, Fault> {
        let resting = Resting::new(equations)?;
        let values: Vec<f64> = resting.equations().parameters.iter().map(|p| p.value).collect();
        let parts = Parts::holding(resting.equations(), |_| false).smooth(resting.equations());
        let mut system = RestSystem::new(resting.equations(), parts, &values)?;
        if system.rate_only.contains(&true) {
            let start = assemble(resting.equations(), &values)?.start;
            system = system.anchored(resting.equations(), &start)?;
        }
        Ok(Near { resting, system })
    }

    /// The place of rest near q for these parameters.
    ///
    /// *Errors*: S007 when Newton's method finds none.
    pub fn settle(&mut self, parameters: &[f64], q: &[f64]) -> Result<Found, Fault> {
        let values = self.resting.values(parameters)?;
        let start = if self.system.has_paths() { assemble(self.resting.equations(), &values)?.start } else { Vec::new() };
        self.system.set(&values, &start)?;
        let n = self.system.n;
        let mut z = self.system.z(q);
        balance(&mut self.system, &mut z)?;
        let rows = self.system.at(&z)?;
        let remainder = worst(&rest_rows(&rows, &z), &z, n);
        if remainder > 0.0 {
            let free: Vec<usize> = (0..self.system.width()).collect();
            let mut better = z.clone();
            match solve(&mut self.system, &mut better, &free, &rest_rows)? {
                Some(_) => z = better,
                None if remainder <= RESTS => {}
                None => return Err(no_equilibrium()),
            }
        }
        let symbol = |r: &usize| self.resting.equations().reactions[*r].symbol;
        let reactions = self.system.reactions.iter().map(symbol).zip(z[n..].iter().copied()).collect();
        Ok((z[..n].to_vec(), reactions))
    }
}
