//! Power balance along the motion: dE/dt = loads + drives - dissipated.
//!
//! The accelerations in dE/dt are the derivatives of the dense output's velocities, not the solution of M q'' = h: so the integrator is
//! tested together with the equations. The derivative of a polynomial of order p multiplies its truncation error by at most p, hence the limit
//! 1e3 tol (p <= 40, 25 in reserve), and 1e-9 where rounding rules. A wrong term of the equations shows as 1e-3 and more.
//!
//! Compared with: the powers that cancel, |q'·M q''| + |rest of dE/dt| + |loads| + |drives| + |dissipated|, in the middle or at the end of the step, the power of damping
//! alone, and, where the machine is momentarily at
//! rest and all of them vanish, a thousandth of their largest sum so far. In uniform motion there is no power at all, and the acceleration is the
//! rounding of velocities over the step h. A force that fades (a saturation) leaves powers smaller than the error that the step was allowed, tol of the
//! change of a rate within it: that change over h, as an acceleration, is a scale too. The least scale is the power that changes q'·M q' by 1e-4 of itself within a step.
//!
//! **Rounding.** At rest the powers of weights, springs and drives cancel, and what is left of them is the rounding of the single ones, Σ_kj |Q_kj q'_j| and Σ |m a_k v_k|, and of the
//! places, Σ_ij |∂x''_i/∂q_j q_j| as a power. No scale is so small that 64 units in the last place of these two would meet the limit: a machine that rests to 1e-16, or
//! moves by 1e-9 about its rest, is not blamed, and an error of the equations there is still seen, as it is far above rounding.

use words::Text;

use super::damping::{damping_alone, places_alone};
use super::frontier::{FLOOR, Frontier};
use super::sampling::Sampling;
use crate::dataset::Audit;
use crate::integrate::Step;
use crate::{Powers, System};

/// Share of the powers of an instant, a hundredth of the least limit, up to which a residual is in order whatever else may be a scale.
const CLEAR: f64 = 1e-11;
/// Share of q'·M q' within a step below which a power is rounding of the velocities.
const SMALL: f64 = 1e-4;
/// Samples before every second one is dropped.
const SAMPLES: u64 = 64;

/// Collects the residual along a motion.
#[derive(Clone, Debug)]
pub struct PowerBalance {
    found: Frontier,
    largest: f64,
    sampling: Sampling,
    x: Vec<f64>,
    rates: Vec<f64>,
}

impl PowerBalance {
    /// For a system with this many states.
    pub fn new(n_states: usize) -> PowerBalance {
        PowerBalance {
            found: Frontier::default(),
            largest: 0.0,
            sampling: Sampling::new(SAMPLES),
            x: vec![0.0; n_states],
            rates: vec![0.0; n_states],
        }
    }

    /// Counts a step that would not be looked at; false where it is to be looked at.
    pub(crate) fn passes_over(&mut self) -> bool {
        self.sampling.passes_over()
    }

    /// Looks at the middle of a step; at every one of the first 64, then at every second, fourth, ...
    pub fn look<S: System + ?Sized>(&mut self, step: &Step, system: &mut S) {
        if !self.sampling.takes() {
            return;
        }
        let t = step.instant(step.beside_change_point(0.5 * step.length)).high;
        step.motion_after(step.start.until(t), &mut self.x, &mut self.rates);
        let n = system.n_coordinates();
        let accelerations = &self.rates[n..2 * n];
        let Some(p) = system.powers(t, &self.x, accelerations, &step.modes) else {
            self.sampling.give_up();
            return;
        };
        self.rates.fill(0.0);
        let Some(still) = system.powers(t, &self.x, &self.rates[n..2 * n], &step.modes) else { return };
        let scale = (p.rate - still.rate).abs() + still.rate.abs() + p.loads.abs() + p.drives.abs() + p.dissipated.abs();
        self.largest = self.largest.max(scale);
        let scale = scale.max(super::PASSING * self.largest);
        let residual = (p.rate - (p.loads + p.drives - p.dissipated)).abs();
        // what closes against the powers of the instant needs no further scale
        let scale = if residual <= CLEAR * scale { scale } else { scale.max(self.further((t, step), system, [&p, &still])) };
        self.found.note(residual, scale);
        self.found.whole(self.largest);
        self.sampling.note();
    }

    /// The scales that count where a residual is not clear: powers at the end of the step, of damping alone, of the changes within the step, and of rounding.
    fn further<S: System + ?Sized>(&mut self, (t, step): (f64, &Step), system: &mut S, [p, still]: [&Powers; 2]) -> f64 {
        let n = system.n_coordinates();
        for i in 0..n {
            self.rates[n + i] = self.x[n + i] / step.length;
        }
        let within = step.instant(step.length).high;
        let scale = self.size_at(within, step, system).max(damping_alone(system, t, &self.x, &step.modes));
        let change = system.powers(t, &self.x, &self.rates[n..2 * n], &step.modes).map_or(0.0, |p| (p.rate - still.rate).abs());
        let local = self.local(step, system, t, still.rate);
        let rounded = FLOOR * (p.through + places_alone(system, t, &self.x, &step.modes));
        scale.max(SMALL * change).max(local).max(rounded)
    }

    /// How large the powers are that meet at an instant of a step, the inertial one left aside: where a motion breaks loose within a step, its middle
    /// is known to the tolerance of the whole.
    fn size_at<S: System + ?Sized>(&mut self, t: f64, step: &Step, system: &mut S) -> f64 {
        let mut x = vec![0.0; self.x.len()];
        step.state_at(t, &mut x);
        let still = vec![0.0; system.n_coordinates()];
        system.powers(t, &x, &still, &step.modes).map_or(0.0, |p| p.rate.abs() + p.loads.abs() + p.drives.abs() + p.dissipated.abs())
    }

    /// The power that the largest change of the rates within the step would need: what the step's error is measured by.
    fn local<S: System + ?Sized>(&mut self, step: &Step, system: &mut S, t: f64, still: f64) -> f64 {
        let n = system.n_coordinates();
        for i in 0..n {
            let (mut power, mut change) = (1.0, 0.0_f64);
            for c in &step.coefficients(n + i)[1..] {
                power *= step.length;
                change = change.max(c.abs() * power);
            }
            self.rates[n + i] = change.copysign(self.x[n + i]) / step.length;
        }
        system.powers(t, &self.x, &self.rates[n..2 * n], &step.modes).map_or(0.0, |p| (p.rate - still).abs())
    }

    /// The audit, or none when the system has no energies or did not move.
    pub fn audit(&self, tolerance: f64) -> Option<Audit> {
        let name = Text::new(
            "power balance dE/dt = supplied − dissipated: largest relative residual",
            "баланс мощностей dE/dt = подведённая − рассеянная: наибольшая относительная невязка",
        );
        self.sampling.has_seen().then(|| Audit::at_most("power_balance", name, self.found.worst(), super::limit(tolerance)))
    }
}
