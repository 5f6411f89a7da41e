//! What is asked of a periodic regime, and what its multipliers are.

use algebra::elementary;

use super::listener::Listener;
use super::orbit::Limit;
use crate::marks::named::Named;
use crate::marks::pushes::Push;
use crate::studies::simulate::Grid;

/// What brings the motion back.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum Return {
    /// An angle that turns, otherwise the state that moves most.
    #[default]
    Automatic,
    /// This coordinate, rate or auxiliary state: a whole turn of an angle, or the same value in the same direction.
    State(String),
    /// A given period, s.
    Period(f64),
}

/// With how many starts a turn is sought.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Aim {
    /// One.
    #[default]
    Whole,
    /// Those of many parts together, where a turn magnifies one beyond all digits.
    Parts,
}

/// A formula of time and state.
pub type Formula<'a> = &'a dyn Fn(f64, &[f64]) -> f64;

/// Options of the study.
pub struct Periodic<'a> {
    /// What brings the motion back.
    pub by: Return,
    /// Formula of (t, state) that passes zero from below where the period is to begin; at the start's own section when absent.
    pub begin: Option<Formula<'a>>,
    /// Returns in one period; 1 unless the motion repeats only after several.
    pub returns: usize,
    /// Time simulated before the search, s: lets the motion come near its regime.
    pub settle: f64,
    /// Longest period searched, s.
    pub longest: f64,
    /// Relative tolerance of a step.
    pub tolerance: f64,
    /// Times of the result within the period.
    pub grid: Grid,
    /// Outputs by name; all when absent.
    pub outputs: Option<Vec<String>>,
    /// Formulas whose zeros are events.
    pub events: &'a [Named],
    /// Forces that must keep their sign, as in a simulation.
    pub pushes: &'a [Push],
    /// Told what the search does, and asked whether it is to end.
    pub listener: Listener<'a>,
    /// Seed of the audits.
    pub seed: u64,
    /// At how many equally spaced instants of the period the coefficients of the variational equations are wanted.
    pub coefficients: usize,
    /// With how many starts it is sought.
    pub aim: Aim,
}

impl Default for Periodic<'_> {
    fn default() -> Self {
        Periodic {
            by: Return::Automatic,
            begin: None,
            returns: 1,
            settle: 0.0,
            longest: 1e4,
            // the map of a turn is differentiated: it is followed as closely as numbers allow
            tolerance: 1e-14,
            grid: Grid::Auto,
            outputs: None,
            events: &[],
            pushes: &[],
            listener: Listener::default(),
            seed: 1,
            coefficients: 0,
            aim: Aim::Whole,
        }
    }
}

/// An eigenvalue of the fundamental matrix.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Multiplier {
    /// Real part.
    pub re: f64,
    /// Imaginary part.
    pub im: f64,
    /// Whether it belongs to a shift along the motion or another translation, and is 1 for that reason.
    pub trivial: bool,
    /// By how much it may be wrong.
    pub error: f64,
    /// ln of the magnitude, where only Liouville's formula knows it: the numbers themselves are then 0.
    pub log_abs: Option<f64>,
}

impl Multiplier {
    /// Magnitude.
    pub fn abs(&self) -> f64 {
        self.log_abs.map_or(elementary::hypot(self.re, self.im), elementary::exp)
    }
}

impl<'a> Periodic<'a> {
    pub(super) fn limit(&self) -> Limit<'a> {
        Limit { time: self.longest, listener: self.listener }
    }
}
