//! Energy at impacts: each one may lose energy, none may gain it. And the drift of conditions that projections removed.

use symbolic::Text;

use crate::dataset::Audit;

/// What rounding may add to an impact, relative to the energy that takes part.
const GAIN: f64 = 1e-9;

/// Collects energies before and after impacts.
#[derive(Clone, Debug, Default)]
pub struct ImpactEnergy {
    worst: f64,
    lost: f64,
    /// Largest kinetic energy before an impact.
    largest: f64,
    count: u64,
}

/// Share of the largest energy below which an impact is one of a dying sequence, and its gain rounding.
const DYING: f64 = 1e-6;

impl ImpactEnergy {
    /// Kinetic energies just before and after an impact, which moves nothing; returns the loss.
    pub fn record(&mut self, before: f64, after: f64) -> f64 {
        let lost = before - after;
        self.lost += lost;
        self.largest = self.largest.max(before);
        self.count += 1;
        if lost < 0.0 {
            self.worst = self.worst.max(-lost / before.max(DYING * self.largest));
        }
        lost
    }

    /// Sum of all losses, J.
    pub fn lost(&self) -> f64 {
        self.lost
    }

    /// The audit, or none without impacts.
    pub fn audit(&self) -> Option<Audit> {
        let name = Text::new(
            "impacts: largest gain of energy, relative to the kinetic energy",
            "удары: наибольший прирост энергии относительно кинетической",
        );
        (self.count > 0).then(|| Audit::at_most("impact_energy", name, self.worst, GAIN))
    }
}

/// The drift that projections removed; none when there was nothing to project.
pub fn drift(removed: f64, projections: u64, tolerance: f64) -> Option<Audit> {
    let name = Text::new("connections: largest drift removed, relative", "связи: наибольший устранённый уход, относительно");
    (projections > 0).then(|| Audit::at_most("connection_drift", name, removed, (1e3 * tolerance).max(1e-9)))
}
