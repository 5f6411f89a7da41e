//! Newton-Euler balance of every body along the motion, with the reactions that were computed.
//!
//! The second derivation writes each balance over accelerations and reactions, by other formulas than those which gave the reactions. Accelerations
//! are the derivatives of the dense output, reactions those of the same state. Each residual is compared with the terms that cancel in it; the limit
//! is that of the power balance, for the same reason. In uniform motion a balance may hold nothing but rounding: the least size is 1e-4 of the terms
//! with the accelerations that change the rates by themselves within a step.

use words::Text;

use super::frontier::Frontier;
use super::sampling::Sampling;
use crate::System;
use crate::dataset::Audit;
use crate::integrate::Step;

/// Share of the inertia forces that double the rates within a step below which a balance is rounding.
const SMALL: f64 = 1e-4;
/// Share of its own terms, a hundredth of the least limit, up to which a residual is in order whatever else may be a size.
const CLEAR: f64 = 1e-11;
/// Share by which states are moved to see what their rounding does, and roundings of a state by which a balance may miss.
const NUDGE: f64 = 1.0 / (1u64 << 40) as f64;
const ROUNDINGS: f64 = 8.0;
/// Samples before every second one is dropped.
const SAMPLES: u64 = 16;

/// Collects the residual along a motion.
#[derive(Clone, Debug)]
pub struct BodyBalance {
    found: Frontier,
    /// Largest term of all balances so far.
    strongest: f64,
    /// Largest terms of each row so far: a balance in which all terms vanish for an instant has its own size all the same.
    largest: Vec<f64>,
    sampling: Sampling,
    x: Vec<f64>,
    rates: Vec<f64>,
}

impl BodyBalance {
    /// For a system with this many states.
    pub fn new(n_states: usize) -> BodyBalance {
        BodyBalance {
            found: Frontier::default(),
            strongest: 0.0,
            largest: Vec::new(),
            sampling: Sampling::new(SAMPLES),
            x: vec![0.0; n_states],
            rates: vec![0.0; n_states],
        }
    }

    /// Counts a step that would not be looked at; false where it is to be looked at.
    pub(crate) fn passes_over(&mut self) -> bool {
        self.sampling.passes_over()
    }

    /// Looks at the middle of a step; at every one of the first 16, then at every second, fourth, ...
    pub fn look<S: System + ?Sized>(&mut self, step: &Step, system: &mut S) {
        if !self.sampling.takes() || step.length == 0.0 {
            return;
        }
        let t = step.instant(step.beside_change_point(0.5 * step.length)).high;
        step.motion_after(step.start.until(t), &mut self.x, &mut self.rates);
        let n = system.n_coordinates();
        let Some(rows) = system.balances(t, &self.x, &self.rates[n..2 * n], &step.modes) else {
            self.sampling.give_up();
            return;
        };
        self.largest.resize(rows.len(), 0.0);
        for ([_, size], largest) in rows.iter().zip(&mut self.largest) {
            *largest = largest.max(*size);
            self.strongest = self.strongest.max(*size);
        }
        let own = |([_, size], largest): (&[f64; 2], &f64)| size.max(super::PASSING * *largest);
        let clear = rows.iter().zip(&self.largest).all(|(row, largest)| row[0].abs() <= CLEAR * own((row, largest)));
        // what closes against its own terms needs no further size
        let inertia = if clear { Vec::new() } else { self.inertia(t, step, system) };
        let rounding = if clear { Vec::new() } else { self.rounding(t, step, (&rows, system)) };
        for (i, (row, largest)) in rows.iter().zip(&self.largest).enumerate() {
            let least = inertia.get(i).map_or(0.0, |row| SMALL * row[1]);
            let off = (row[0].abs() - rounding.get(i).unwrap_or(&0.0)).max(0.0);
            self.found.note(off, own((row, largest)).max(least));
        }
        // a body at the far end of a chain carries what rounding leaves of the forces before it
        self.found.whole(self.strongest);
        self.sampling.note();
    }

    /// What rounding of the state leaves in each balance. A spring that carries the weight may stand in it with the deviation from rest alone, which is a difference
    /// of lengths and has no digits where the machine rests.
    fn rounding<S: System + ?Sized>(&mut self, t: f64, step: &Step, (rows, system): (&[[f64; 2]], &mut S)) -> Vec<f64> {
        let (n, kept) = (system.n_coordinates(), self.x.clone());
        // neighbours the other way: differences of states have the rounding of both
        for (i, x) in self.x.iter_mut().enumerate() {
            *x *= if i.is_multiple_of(2) { 1.0 + NUDGE } else { 1.0 - NUDGE };
        }
        step.rate_at(t, &mut self.rates);
        let nudged = system.balances(t, &self.x, &self.rates[n..2 * n], &step.modes).unwrap_or_default();
        self.x = kept;
        rows.iter().zip(&nudged).map(|(a, b)| ROUNDINGS * (f64::EPSILON / NUDGE) * (a[0] - b[0]).abs()).collect()
    }

    /// The balances with the accelerations that change the rates by themselves within the step.
    fn inertia<S: System + ?Sized>(&mut self, t: f64, step: &Step, system: &mut S) -> Vec<[f64; 2]> {
        let n = system.n_coordinates();
        for i in 0..n {
            self.rates[n + i] = self.x[n + i] / step.length;
        }
        system.balances(t, &self.x, &self.rates[n..2 * n], &step.modes).unwrap_or_default()
    }

    /// The audit, or none when the system has no reactions or no second derivation.
    pub fn audit(&self, tolerance: f64) -> Option<Audit> {
        let name = Text::new(
            "Newton-Euler balance of every body with its reactions: largest relative residual",
            "уравнения Ньютона-Эйлера для каждого тела с его реакциями: наибольшая относительная невязка",
        );
        self.sampling.has_seen().then(|| Audit::at_most("body_balance", name, self.found.worst(), super::limit(tolerance)))
    }
}
