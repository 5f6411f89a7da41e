//! The phases of a motion.

use analysis::studies::transient::Phase;

/// Phases of a motion, and the names of its state.
#[derive(Clone, Debug)]
pub struct Phases {
    /// In order of time.
    pub list: Vec<Phase>,
    /// Coordinates, then rates.
    pub names: Vec<String>,
    /// Instants at which the loads begin anew.
    pub restarts: Vec<f64>,
}

impl Phases {
    /// Whether the loads begin anew at the start of a phase.
    pub fn restarts(&self, phase: &Phase) -> bool {
        // the same instant by another sum of durations
        self.restarts.iter().any(|t| (t - phase.start).abs() <= 1e-12 * t.abs())
    }
}
