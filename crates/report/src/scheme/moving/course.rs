//! A moving picture as data: what moves how.

use crate::scheme::{P, Scheme};

/// The path of an origin, and a turn.
#[derive(Clone, Debug, Default)]
pub struct Track {
    /// The origin at each frame, pixels; empty for what stands still.
    pub at: Vec<P>,
    /// The angle at each frame, rad, counter-clockwise; empty for what does not turn.
    pub turn: Vec<f64>,
}

/// What the times of a motion are.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Clock {
    /// Symbol of the variable: `t`, `phi_1`.
    pub symbol: String,
    /// Its unit in SI, ASCII.
    pub unit: String,
    /// Whether the end joins the beginning.
    pub repeats: bool,
}

/// A moving picture.
#[derive(Clone, Debug)]
pub struct Moving {
    /// The scheme at the first frame.
    pub scheme: Scheme,
    /// The same behind it in grey: the place about which a shape swings.
    pub rest: bool,
    /// What the times are.
    pub clock: Clock,
    /// Times of the frames, SI, ascending.
    pub times: Vec<f64>,
    /// Tracks; the first is the ground.
    pub tracks: Vec<Track>,
    /// How items look at times, by their numbers.
    pub states: Vec<(usize, Vec<Stay>)>,
}

/// A look of an item for a while.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stay {
    /// Its beginning, SI.
    pub from: f64,
    /// Its end.
    pub to: f64,
    /// `open`, `sticks`, `slips`.
    pub look: &'static str,
}
