//! Friction never does positive work: at every instant force times sliding speed takes energy, each friction for itself.
//!
//! The power is λ v with the sliding speed of the friction's own geometry, over sliding steps at the points of the energy ledger's kind (both ends left
//! out, where v vanishes). A friction that drives what it should brake (a branch taken with the wrong sign, a normal force that went negative) shows as
//! its full power. Relative to the largest power of that friction so far, and to the rounding of the largest of the machine.

use words::Text;

use super::frontier::Frontier;
use crate::System;
use crate::dataset::Audit;
use crate::integrate::Step;

/// Rounding of a speed beside the terms that meet in it.
const LIMIT: f64 = 1e-9;
const PLACES: [f64; 3] = [0.1, 0.5, 0.9];

/// Collects the powers of frictions.
#[derive(Clone, Debug, Default)]
pub struct FrictionWork {
    /// Largest |power| of each friction.
    largest: Vec<f64>,
    found: Frontier,
    slid: bool,
}

impl FrictionWork {
    /// Looks at a step up to `length`.
    pub fn look<S: System + ?Sized>(&mut self, step: &Step, system: &mut S, length: f64) {
        if system.n_frictions() == 0 || length <= 0.0 {
            return;
        }
        self.largest.resize(system.n_frictions(), 0.0);
        let mut x = vec![0.0; system.states().len()];
        for place in PLACES {
            step.state_after(place * length, &mut x);
            let powers = system.frictions(step.instant(place * length).high, &x, &step.modes).unwrap_or_default();
            for (largest, power) in self.largest.iter_mut().zip(powers) {
                let Some(power) = power else { continue };
                self.slid = true;
                *largest = largest.max(power.abs());
                self.found.note(-power, *largest);
            }
        }
    }

    /// The audit, or none when nothing slid.
    pub fn audit(&self) -> Option<Audit> {
        let name = Text::new(
            "dry friction: largest power it supplies, relative to what it takes",
            "сухое трение: наибольшая подведённая им мощность относительно отбираемой",
        );
        self.slid.then(|| Audit::at_most("friction_work", name, self.found.worst(), LIMIT))
    }
}
