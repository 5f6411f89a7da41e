//! The reduced machine at an angle: J, dJ/dφ and M of a uniform turn from the rates of its energy.

use super::faults::no_energies;
use super::turn::Cycle;
use crate::integrate::Step;
use crate::marks::bridge::Bridge;
use crate::{Fault, Mode, System};

/// Rounding of a sum of moments, relative to its terms.
pub(super) const ROUNDING: f64 = 32.0 * f64::EPSILON;
/// Change of the inertia with the angle, as a share of it, that is rounding of accelerations: beside a change point they have some eleven digits.
const FLAT: f64 = 1e-11;

/// What the machine is at an angle.
pub(super) struct Reduced {
    pub(super) inertia: f64,
    pub(super) slope: f64,
    pub(super) moment: f64,
    /// Sum of the moments that meet in it, without signs.
    pub(super) terms: f64,
    /// The part of the moment that comes from no potential, and the same sum of it.
    pub(super) driven: f64,
    pub(super) fed: f64,
    /// dφ/dt of the motion that led here.
    pub(super) rate: f64,
}

/// The machine, and the same with its shaft held to the uniform rate. What dry friction takes hangs on normal forces, and these on accelerations: those of
/// the uniform motion, not those that the loads would give a free shaft.
pub(super) struct Pair<'p, S: ?Sized> {
    pub(super) own: &'p mut S,
    pub(super) uniform: Option<&'p mut S>,
    /// Where the guards of the machine stand among those of the motion that leads.
    pub(super) shared: Vec<usize>,
}

impl<S: System + ?Sized> Pair<'_, S> {
    /// Modes of the machine where those of the motion that leads are these.
    fn own_modes(&self, modes: &[Mode]) -> Vec<Mode> {
        self.shared.iter().map(|&at| modes[at]).collect()
    }

    /// Power of the loads less the dissipated one, that at the accelerations of the uniform motion; and dE/dt.
    pub(super) fn power(&mut self, t: f64, x: &[f64], accelerations: &[f64], modes: &[Mode]) -> Result<Power, Fault> {
        let own_modes = self.own_modes(modes);
        let own = self.own.supply(t, x, accelerations, &own_modes).ok_or_else(no_energies)?;
        let dissipated = match &mut self.uniform {
            Some(uniform) => uniform.supply(t, x, accelerations, modes).ok_or_else(no_energies)?.dissipated,
            None => own.dissipated,
        };
        Ok(Power { loads: own.loads, dissipated, rate: self.rate(t, x, accelerations, modes)? })
    }

    /// Potential energy at tau in a step.
    pub(super) fn potential(&mut self, step: &Step, tau: f64, options: &Cycle) -> Result<Potential, Fault> {
        let t = step.instant(tau).high;
        let mut x = vec![0.0; self.own.states().len()];
        step.state_at(t, &mut x);
        let [_, energy] = self.energies(t, &x, &step.modes).ok_or_else(no_energies)?;
        let Reduced { moment, driven, .. } = reduced(self, step, tau, options)?;
        // the angle of the end is known to the rounding of the way there
        Ok(Potential { energy, known: ROUNDING * (energy.abs() + ((moment - driven) * options.range).abs()) })
    }

    /// Kinetic and potential energy.
    pub(super) fn energies(&mut self, t: f64, x: &[f64], modes: &[Mode]) -> Option<[f64; 2]> {
        let modes = self.own_modes(modes);
        self.own.energies(t, x, &modes)
    }

    /// dE/dt.
    pub(super) fn rate(&mut self, t: f64, x: &[f64], accelerations: &[f64], modes: &[Mode]) -> Result<f64, Fault> {
        let modes = self.own_modes(modes);
        self.own.energy_rate(t, x, accelerations, &modes).ok_or_else(no_energies)
    }
}

/// Powers, W.
pub(super) struct Power {
    pub(super) loads: f64,
    pub(super) dissipated: f64,
    pub(super) rate: f64,
}

/// The reduced machine at tau in a step. Where a change point is passed the accelerations follow from no equation, and what is smooth there from both sides.
pub(super) fn reduced<S: System + ?Sized>(machine: &mut Pair<'_, S>, step: &Step, tau: f64, options: &Cycle) -> Result<Reduced, Fault> {
    let Some(around) = step.around_change_point(tau) else { return plainly(machine, step, tau, options) };
    let row = |r: Reduced| vec![r.inertia, r.slope, r.moment, r.terms, r.driven, r.fed];
    let bridge = Bridge::new(around, |tau| plainly(machine, step, tau, options).map(row))?;
    let rate = step.value_after(machine.own.n_coordinates() + options.angle, tau);
    let value = |column: usize| bridge.value(column, tau).ok_or_else(no_energies);
    let [inertia, slope, moment, terms, driven, fed] = [value(0)?, value(1)?, value(2)?, value(3)?, value(4)?, value(5)?];
    Ok(Reduced { inertia, slope, moment, terms, driven, fed, rate })
}

fn plainly<S: System + ?Sized>(machine: &mut Pair<'_, S>, step: &Step, tau: f64, options: &Cycle) -> Result<Reduced, Fault> {
    let (n, j, w) = (machine.own.n_coordinates(), options.angle, options.rate);
    let t = step.instant(tau).high;
    let n_x = machine.own.states().len();
    let (mut x, mut slope) = (vec![0.0; n_x], vec![0.0; n_x]);
    step.state_at(t, &mut x);
    step.rate_at(t, &mut slope);
    let rate = x[n + j];
    let b: Vec<f64> = (0..n).map(|i| x[n + i] / rate).collect();
    let c: Vec<f64> = (0..n).map(|i| (slope[n + i] - b[i] * slope[n + j]) / (rate * rate)).collect();
    let at = |w: f64| {
        let mut x = x.clone();
        (0..n).for_each(|i| x[n + i] = b[i] * w);
        x
    };
    let scaled = |factor: f64| c.iter().map(|c| c * factor).collect::<Vec<f64>>();
    let (turning, quicker) = (at(w), at(2.0 * w));
    let uniform = machine.power(t, &turning, &scaled(w * w), &step.modes)?;
    let double = machine.rate(t, &quicker, &scaled(4.0 * w * w), &step.modes)?;
    let still = machine.rate(t, &turning, &vec![0.0; n], &step.modes)?;
    // dE/dt is linear in the accelerations: those of a quick shaft are as large as its centripetal ones, beside which one radian per second squared would be rounding
    let push = (w * w).max(1.0);
    let accelerations: Vec<f64> = b.iter().map(|b| b * push).collect();
    let pushed = machine.rate(t, &turning, &accelerations, &step.modes)?;
    // dE/dt = A w + B w³: the cubic part is that of the kinetic energy, B = ½ J'
    let kinetic = (double - 2.0 * uniform.rate) / 6.0;
    let potential = uniform.rate - kinetic;
    let terms = (uniform.loads.abs() + uniform.dissipated.abs() + potential.abs() + kinetic.abs()) / w.abs();
    let moment = (uniform.loads - uniform.dissipated - potential) / w;
    let fed = (uniform.loads.abs() + uniform.dissipated.abs()) / w.abs();
    let driven = (uniform.loads - uniform.dissipated) / w;
    let (inertia, slope) = ((pushed - still) / (w * push), 2.0 * kinetic / (w * w * w));
    Ok(Reduced {
        inertia,
        // of an inertia that does not change what accelerations err by is left
        slope: if slope.abs() <= FLAT * inertia.abs() { 0.0 } else { slope },
        moment: if moment.abs() <= ROUNDING * terms { 0.0 } else { moment },
        terms,
        driven: if driven.abs() <= ROUNDING * fed { 0.0 } else { driven },
        fed,
        rate,
    })
}

/// A potential energy, and its rounding.
#[derive(Clone, Copy, Default)]
pub(super) struct Potential {
    pub(super) energy: f64,
    pub(super) known: f64,
}

/// What a potential gains, zero where rounding is left of it.
pub(super) fn gained(from: Potential, to: Potential) -> f64 {
    let gain = to.energy - from.energy;
    if gain.abs() <= from.known.max(to.known) { 0.0 } else { gain }
}
