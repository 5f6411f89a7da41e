//! The place of rest near another one, for parameters that change: what small motions along a parameter are taken about.

use symbolic::{Equations, SymbolId};

use super::fine::Sought;
use super::mean::Resting;
use super::newton::{RESIDUAL, balance, solve, worst};
use super::places::{draw, is_noise, rest_rows, tangents_of};
use super::search::no_equilibrium;
use super::system::{Parts, RestSystem};
use crate::Fault;
use crate::connections::assemble;
use algebra::lu::Lu;
use algebra::vectors::{dot, norm};

/// Remainder of the equations where a place rests as it is, when Newton's method makes it no better.
const RESTS: f64 = 1e-12;

/// Equations of rest with lasting connections; contacts and dry friction are left out.
#[derive(Clone, Debug)]
pub struct Near {
    resting: Resting,
    system: RestSystem,
}

/// A place.
pub struct Found {
    /// Coordinates.
    pub q: Vec<f64>,
    /// The reactions by their symbols.
    pub reactions: Vec<(SymbolId, f64)>,
    /// What coordinates and reactions have below their last digits, where weak springs stand beside hard ones; else empty.
    pub below: Vec<f64>,
}

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

    fn set(&mut self, parameters: &[f64]) -> Result<(), Fault> {
        let values = self.resting.values(parameters)?;
        let start = if self.system.has_paths() { assemble(self.resting.equations(), &values)?.start } else { Vec::new() };
        self.system.set(&values, &start)
    }

    /// The place nearest to q that the connections allow, with the reactions that balance best there.
    ///
    /// *Errors*: S007 where none is found.
    pub fn drawn(&mut self, parameters: &[f64], q: &[f64]) -> Result<Found, Fault> {
        self.set(parameters)?;
        let mut place = q.to_vec();
        draw(&mut self.system, &mut place, None).ok_or_else(no_equilibrium)?;
        let mut z = self.system.z(&place);
        balance(&mut self.system, &mut z)?;
        Ok(self.found(&z, &[]))
    }

    fn found(&self, z: &[f64], below: &[f64]) -> Found {
        let n = self.system.n;
        let symbol = |r: &usize| self.resting.equations().reactions[*r].symbol;
        let reactions = self.system.reactions.iter().map(symbol).zip(z[n..].iter().copied()).collect();
        Found { q: z[..n].to_vec(), reactions, below: below.to_vec() }
    }

    /// The place of rest near q for these parameters.
    ///
    /// *Errors*: S007 when Newton's method finds none.
    pub fn settle(&mut self, parameters: &[f64], q: &[f64]) -> Result<Found, Fault> {
        self.set(parameters)?;
        let mut z = self.system.z(q);
        balance(&mut self.system, &mut z)?;
        let rows = self.system.at(&z)?;
        let remainder = worst(&rest_rows(&rows, &z), &z);
        if remainder > 0.0 {
            let free: Vec<usize> = (0..self.system.width()).collect();
            let mut better = z.clone();
            match solve(&mut self.system, &mut better, &free, &rest_rows)? {
                Some(_) => z = better,
                None if remainder <= RESTS => {}
                None => match self.along(q) {
                    Some(found) => z = found,
                    None => {
                        return self
                            .system
                            .fine(&better, Sought::Lost)?
                            .map(|[z, below]| self.found(&z, &below))
                            .ok_or_else(no_equilibrium);
                    }
                },
            }
        }
        let [mut z, mut below] = match self.system.fine(&z, Sought::Found)? {
            Some([z, below]) => [z, below],
            None => [z, Vec::new()],
        };
        let (rows, n) = (self.system.at(&z)?, self.system.n);
        let sizes = self.system.sizes().at(&[&z[..n]]);
        for c in (0..self.system.reactions.len()).filter(|c| is_noise(&rows, &z, &sizes, n + c)).collect::<Vec<_>>() {
            z[n + c] = 0.0;
            below.get_mut(n + c).into_iter().for_each(|low| *low = 0.0);
        }
        Ok(self.found(&z, &below))
    }

    /// Newton's method along the surface of the connections, from a guess near a place of rest.
    ///
    /// Beside a dead position reactions are as 1/u with the distance u, and in (q, λ) the method converges only where the conditions hold to u³. On the surface
    /// nothing grows: y along it follows from Zᵀ(C + Σ λ ∂²c) Z y = Zᵀ h, and every place is drawn back.
    fn along(&mut self, q: &[f64]) -> Option<Vec<f64>> {
        let n = self.system.n;
        let (mut q, mut before) = (q.to_vec(), f64::INFINITY);
        for _ in 0..ALONG {
            draw(&mut self.system, &mut q, None)?;
            let mut z = self.system.z(&q);
            balance(&mut self.system, &mut z).ok()?;
            let rows = self.system.at(&z).ok()?;
            let basis = tangents_of(&rows, n);
            let k = basis.len();
            let turned: Vec<Vec<f64>> = basis.iter().map(|t| rows.forces.iter().map(|r| dot(&r.slopes[..n], t)).collect()).collect();
            let matrix: Vec<f64> = (0..k * k).map(|p| -dot(&basis[p / k], &turned[p % k])).collect();
            let force: Vec<f64> = rows.forces.iter().map(|r| r.value).collect();
            let right: Vec<f64> = basis.iter().map(|t| dot(t, &force)).collect();
            let y = if k == 0 { Vec::new() } else { Lu::new(&matrix, k).solve(&right)? };
            let length = norm(&y);
            // some ten units of the last place of the state
            let standing = length <= 1e-14 * norm(&q) || length >= before;
            if standing && worst(&rest_rows(&rows, &z), &z) <= RESIDUAL {
                return Some(z);
            }
            if length >= before || !length.is_finite() {
                return None;
            }
            q.iter_mut().enumerate().for_each(|(i, q)| *q += basis.iter().zip(&y).map(|(t, y)| t[i] * y).sum::<f64>());
            before = length;
        }
        None
    }
}

/// Steps along the surface.
const ALONG: usize = 30;
