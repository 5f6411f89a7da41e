//! Energy at impacts: each one may lose energy, none may gain it. And the drift of conditions that projections removed.
//!
//! What strikes may itself move in a prescribed way (a table), and then its drive does work. With w a velocity that keeps every surface's own motion,
//! u = J (q' - w) are the rates of the gaps and, since M Δq' = Jᵀ p,
//!
//! ```text
//! loss = (q'₋ - w)ᵀ M (q'₋ - w)/2 - (q'₊ - w)ᵀ M (q'₊ - w)/2 = -Σ p (u₋ + u₊)/2        whatever w of these is taken
//! ```
//!
//! so the energies are those relative to the surfaces, and a table at rest is the case w = 0. The right side has all its digits where a grain strikes a heavy
//! machine; the left one, which has lost them there, is its check.

use words::Text;

use super::worse;
use crate::dataset::Audit;
use crate::system::BlowWork;
use crate::{Mode, System};

/// What rounding may add to an impact, relative to the energy that takes part.
const GAIN: f64 = 1e-9;

/// Rounding of an energy, which is a difference of three (see [`relative`]).
const ROUNDING: f64 = 64.0 * f64::EPSILON;

/// Share of the rounding of a work, which bounds what long chains of blows make of it, below which it is none.
const NOTHING: f64 = 1.0 / 64.0;

/// Collects energies before and after impacts, and the works of impulses.
#[derive(Clone, Debug, Default)]
pub struct ImpactEnergy {
    worst: f64,
    lost: f64,
    /// Largest energy that took part in an impact.
    largest: f64,
    count: u64,
    /// Largest difference of a work from the change of the kinetic energies, relative to these; none where they were never compared.
    off: Option<f64>,
    /// Largest of these energies.
    energy: f64,
}

/// Share of the largest energy below which an impact is one of a dying sequence, and its gain rounding.
const DYING: f64 = 1e-6;

impl ImpactEnergy {
    /// Kinetic energies relative to the surfaces just before and after an impact; returns the loss.
    pub fn record(&mut self, [before, after]: [f64; 2]) -> f64 {
        let lost = before - after;
        self.note(lost, before, 0.0);
        // what is left of two energies that are equal
        if lost.abs() <= ROUNDING * before.max(after) { 0.0 } else { lost }
    }

    /// The work of the impulses; returns the loss. `energies` as in [`ImpactEnergy::record`], where they are known.
    pub fn record_work(&mut self, work: BlowWork, energies: Option<[f64; 2]>) -> f64 {
        let lost = if work.done.abs() <= NOTHING * work.rounding { 0.0 } else { -work.done };
        self.note(lost, work.met, work.rounding);
        if let Some([before, after]) = energies {
            self.energy = self.energy.max(before).max(after);
            let size = before.max(after).max(DYING * self.energy);
            // a slow blow on a fast surface: its rate is a difference of speeds, and rounded like these
            let off = worse((before - after - lost).abs() - work.rounding, 0.0);
            self.off = Some(worse(self.off.unwrap_or(0.0), if off == 0.0 { 0.0 } else { off / size }));
        }
        lost
    }

    fn note(&mut self, lost: f64, size: f64, rounding: f64) {
        self.lost += lost;
        self.largest = self.largest.max(size);
        self.count += 1;
        if lost < -rounding {
            self.worst = self.worst.max((-lost - rounding) / size.max(DYING * self.largest));
        }
    }

    /// Sum of all losses, J.
    pub fn lost(&self) -> f64 {
        self.lost
    }

    /// The audit, or none without impacts.
    pub fn audit(&self) -> Option<Audit> {
        let (en, ru) = (
            "impacts: largest gain of energy, relative to the kinetic energy",
            "удары: наибольший прирост энергии относительно кинетической",
        );
        let name = if self.worst <= GAIN {
            Text::new(en, ru)
        } else {
            // what Newton's restitution does with friction in eccentric impacts
            Text::new(
                format!("{en}; at stops with friction law = \"poisson\" does not gain"),
                format!("{ru}; у упоров с трением закон law = \"poisson\" прироста не даёт"),
            )
        };
        (self.count > 0).then(|| Audit::at_most("impact_energy", name, self.worst, GAIN))
    }

    /// The check of the losses by the kinetic energies; none where they were never compared.
    pub fn audit_of_work(&self) -> Option<Audit> {
        let name = Text::new(
            "impacts: largest difference of the energy lost by impulses from that by kinetic energies, relative to these",
            "удары: наибольшее отличие потери энергии по импульсам от потери по кинетическим энергиям, относительно этих энергий",
        );
        Some(Audit::at_most("impact_work", name, self.off?, GAIN))
    }
}

/// Kinetic energies (q' - w)ᵀ M (q' - w)/2 relative to what is struck, before and after; w are the rates in `surface`. T may have parts linear in q' and
/// free of it (prescribed motions): T(v) + T(-v) - 2 T(0) = vᵀ M v leaves them out.
pub fn relative<S: System + ?Sized>(system: &mut S, t: f64, states: [&[f64]; 2], surface: &[f64], modes: &[Mode]) -> Option<[f64; 2]> {
    let n = system.n_coordinates();
    let mut y = surface.to_vec();
    let mut square = |x: &[f64]| -> Option<f64> {
        y.copy_from_slice(x);
        let mut energy = |factor: f64| -> Option<f64> {
            (n..2 * n).for_each(|i| y[i] = factor * (x[i] - surface[i]));
            Some(system.energies(t, &y, modes)?[0])
        };
        Some(0.5 * (energy(1.0)? + energy(-1.0)?) - energy(0.0)?)
    };
    Some([square(states[0])?, square(states[1])?])
}

/// The drift that projections removed; none when there was nothing to project.
pub fn drift(removed: f64, projections: u64, tolerance: f64) -> Option<Audit> {
    let name = Text::new("connections: largest drift removed, relative", "связи: наибольший устранённый уход, относительно");
    (projections > 0).then(|| Audit::at_most("connection_drift", name, removed, super::limit(tolerance)))
}
