//! Jumps of prescribed velocities: a table that starts at once, a shaft whose speed steps.
//!
//! With T = q'ᵀ M q'/2 + b(q, t)·q' + c the momenta p = M q' + b jump by the impulses of connections, contacts and frictions only, whatever drives the
//! prescribed motion gives:
//!
//! ```text
//! M (q'₊ - q'₋) = b₋ - b₊ + Σ forces Λ,     J q'₊ + change in time₊ = 0
//! ```
//!
//! So the jump is an impact with the generalized impulse b₋ - b₊ given beside. Positions stand still, hence M and J are the same on both sides.

use super::Machine;
use super::impact::Kick;
use super::leap::Leap;
use crate::{Blow, Fault, Mode, System};

/// Share of its size below which a change of momentum or rate is rounding.
const ROUNDING: f64 = 1e-12;
/// Around an event, in units of its time: where formulas that switch by value are on either side.
const BESIDE: f64 = 64.0 * f64::EPSILON;

/// Instants just before and after this one.
fn beside(t: f64) -> [f64; 2] {
    let gap = BESIDE * t.abs().max(f64::MIN_POSITIVE / BESIDE);
    [t - gap, t + gap]
}

/// Numbers of a machine at (t, x) in modes; none where they have no value.
type AtAnInstant = fn(&mut Machine, f64, &[f64], &[Mode]) -> Option<Vec<f64>>;

impl Machine {
    /// See [`System::jolt`].
    pub(super) fn jump(&mut self, t: f64, x: &mut [f64], modes: [&[Mode]; 2], closing: &[usize]) -> Result<Option<Blow>, Fault> {
        let [Some(before), Some(after)] = modes.map(|modes| self.carried(t, x, modes)) else { return Ok(None) };
        let kick: Vec<f64> = before.iter().zip(&after).map(|(b, a)| b - a).collect();
        let [earlier, later] = beside(t);
        let n = kick.len();
        let rates = x[n..2 * n].to_vec();
        let kicked = self.is_kicked((t, x), modes);
        let steps = match &mut self.conditions {
            Some(conditions) if !kicked => conditions.steps([earlier, later], x)?,
            _ => kicked,
        };
        let felt = self.leap_of_balances([earlier, later], x).is_some_and(|leap| leap.is_felt(ROUNDING));
        if !steps && !felt && !self.carries_more((t, x), modes) {
            return Ok(None);
        }
        let carried = self.balances_beside([earlier, later], x).map_or_else(Vec::new, |beside| beside.carried);
        let mut blow = match &mut self.conditions {
            Some(conditions) => {
                conditions.evaluate(later, x)?;
                conditions.struck((later, x), modes[0], closing, Some(Kick { impulses: &kick, carried: &carried }))?
            }
            None => self.kicked(t, x, modes[1], &kick)?,
        };
        let jump: Vec<f64> = rates.iter().zip(&x[n..2 * n]).map(|(before, after)| after - before).collect();
        self.hold([earlier, later], x, &jump, &mut blow);
        Ok(Some(blow))
    }

    /// Whether b jumps.
    fn is_kicked(&mut self, here: (f64, &[f64]), modes: [&[Mode]; 2]) -> bool {
        self.leap(here, modes, Machine::carried).is_some_and(|leap| leap.is_felt(ROUNDING))
    }

    /// Whether the energy of the prescribed motion alone jumps.
    fn carries_more(&mut self, here: (f64, &[f64]), modes: [&[Mode]; 2]) -> bool {
        let energy = |machine: &mut Machine, t: f64, x: &[f64], modes: &[Mode]| Some(vec![machine.kinetic(t, x, modes, &[])?]);
        self.leap(here, modes, energy).is_some_and(|leap| leap.is_felt(ROUNDING))
    }

    /// Values on both sides of an instant, each side with its modes.
    fn leap(&mut self, (t, x): (f64, &[f64]), modes: [&[Mode]; 2], values: AtAnInstant) -> Option<Leap> {
        let [earlier, later] = beside(t);
        let mut side = |times: [f64; 2], modes: &[Mode]| {
            let [near, far] = times.map(|t| values(self, t, x, modes));
            Some([near?, far?])
        };
        Some(Leap { before: side([t, earlier], modes[0])?, after: side([t, later], modes[1])? })
    }

    /// Rates after generalized impulses on a machine that nothing else acts on.
    fn kicked(&mut self, t: f64, x: &mut [f64], modes: &[Mode], kick: &[f64]) -> Result<Blow, Fault> {
        let undetermined = || Fault::undetermined_impact(t);
        let n = kick.len();
        let mass = self.mass(t, x, modes).ok_or_else(undetermined)?;
        let change = algebra::lu::Lu::new(&mass, n).solve(kick).ok_or_else(undetermined)?;
        x[n..2 * n].iter_mut().zip(change).for_each(|(v, d)| *v += d);
        Ok(Blow::default())
    }

    /// T with these rates.
    fn kinetic(&mut self, t: f64, x: &[f64], modes: &[Mode], rates: &[(usize, f64)]) -> Option<f64> {
        let n = self.n_coordinates();
        let mut y = x.to_vec();
        y[n..2 * n].fill(0.0);
        rates.iter().for_each(|(j, v)| y[n + j] += v);
        Some(self.energies(t, &y, modes)?[0])
    }

    /// b: momenta at q' = 0.
    fn carried(&mut self, t: f64, x: &[f64], modes: &[Mode]) -> Option<Vec<f64>> {
        (0..self.n_coordinates())
            .map(|j| Some(0.5 * (self.kinetic(t, x, modes, &[(j, 1.0)])? - self.kinetic(t, x, modes, &[(j, -1.0)])?)))
            .collect()
    }

    /// M, row by row: that of the equations where they have one, else from T, which is quadratic in the rates.
    pub(super) fn mass(&mut self, t: f64, x: &[f64], modes: &[Mode]) -> Option<Vec<f64>> {
        let n = self.n_coordinates();
        self.observing.set(modes, &self.bound);
        if let Some(mass) = self.bound.mass(t, x, &self.observing.modes) {
            return Some(mass);
        }
        let rest = self.kinetic(t, x, modes, &[])?;
        let alone = (0..n).map(|i| self.kinetic(t, x, modes, &[(i, 1.0)])).collect::<Option<Vec<f64>>>()?;
        let mut mass = vec![0.0; n * n];
        for i in 0..n {
            for j in 0..=i {
                let both = self.kinetic(t, x, modes, &[(i, 1.0), (j, 1.0)])?;
                mass[i * n + j] = both - alone[i] - alone[j] + rest;
                mass[j * n + i] = mass[i * n + j];
            }
        }
        Some(mass)
    }
}
