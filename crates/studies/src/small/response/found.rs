//! What a response has found.

use crate::small::asked::Response as Study;
use crate::small::strands::Slack;
use analysis::Quantity;
use analysis::studies::extremes::{Antiresonance, Resonance};
use analysis::studies::modes::Modes;
use analysis::studies::response::Point;
use analysis::studies::rest::branch::Change;
use analysis::studies::superposition::Superposed;
use words::Text;

/// An order with its motion at the frequency that the file gives, and its curve.
#[derive(Clone, Debug, Default)]
pub struct Order {
    /// Multiple of ω.
    pub order: f64,
    /// At the frequency that the file gives.
    pub own: Option<Point>,
    /// Along the grid; empty for high harmonics of a waveform.
    pub points: Vec<Point>,
}

/// The rods of a frame while the load is largest, as lines with breaks between rods.
#[derive(Clone, Debug)]
pub struct Deformed {
    /// Frequency of the load, rad/s.
    pub omega: f64,
    /// The rods as they are.
    pub straight: (Vec<f64>, Vec<f64>),
    /// Displaced and magnified.
    pub line: (Vec<f64>, Vec<f64>),
    /// How many times.
    pub factor: f64,
}

/// What the study found.
#[derive(Clone, Debug)]
pub struct ResponseFound {
    /// The study.
    pub study: Study,
    /// Names of the outputs.
    pub outputs: Vec<Quantity>,
    /// Peaks of each output.
    pub resonances: Vec<Resonance>,
    /// Zeros or least values of each output.
    pub antiresonances: Vec<Antiresonance>,
    /// Modes of the machine as the file has it.
    pub modes: Option<Modes>,
    /// The response at the frequency that the file gives, at the first order.
    pub own: Option<Point>,
    /// All orders of the load, when there are several.
    pub orders: Vec<Order>,
    /// Order that the main columns show.
    pub main: f64,
    /// All orders together at that frequency.
    pub superposed: Option<Superposed>,
    /// Order of each resonance.
    pub resonance_orders: Vec<f64>,
    /// Order of each antiresonance.
    pub antiresonance_orders: Vec<f64>,
    /// Where the place of rest changes along the frequency's parameter.
    pub changes: Vec<Change>,
    /// Strands that would have to push, tracks that would have to pull.
    pub slack: Vec<Slack>,
    /// Motions at the frequencies asked for.
    pub shapes: Vec<Point>,
    /// The rods of a frame at those frequencies.
    pub deformed: Vec<Deformed>,
    /// The coordinates.
    pub coordinates: Vec<Quantity>,
    /// Names of the bodies that each coordinate moves.
    pub bodies: Vec<Vec<String>>,
    /// Name of the load, or of the parameter that is its frequency.
    pub load: Text,
}
