//! What carries an item: tracks of a moving picture by their numbers, of which 0 is the ground.

use super::ink::P;

/// What carries the anchors of an item.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Rides {
    /// The track of the first anchor.
    pub at: usize,
    /// The track of the second one.
    pub to: usize,
    /// The track with which it turns.
    pub turn: usize,
    /// The points of a way, where not all of them are carried by `at`.
    pub path: Vec<Via>,
    /// How a belt or chain runs: the track of a wheel on `at`, its radius.
    pub runs: Option<(usize, f64)>,
}

/// A point of a way.
#[derive(Clone, Debug, PartialEq)]
pub struct Via {
    /// What carries it.
    pub track: usize,
    /// The drum on which the way ends, if it does.
    pub drum: Option<Drum>,
}

/// A drum that a thread leaves along a tangent.
#[derive(Clone, Debug, PartialEq)]
pub struct Drum {
    /// Its centre.
    pub center: P,
    /// Its radius.
    pub radius: f64,
    /// 1 when it winds in turning counter-clockwise, else -1.
    pub sense: f64,
}

impl Rides {
    /// Moves and turns with a track.
    pub fn on(track: usize) -> Rides {
        Rides { at: track, to: track, turn: track, ..Rides::default() }
    }

    /// Is taken along by a track without turning.
    pub fn along(track: usize) -> Rides {
        Rides { turn: 0, ..Rides::on(track) }
    }

    /// Is taken along by a track and turns with another one.
    pub fn turning(track: usize, turn: usize) -> Rides {
        Rides { turn, ..Rides::on(track) }
    }

    /// Lies between two tracks.
    pub fn between(at: usize, to: usize) -> Rides {
        Rides { at, to, turn: if at == to { at } else { 0 }, ..Rides::default() }
    }

    /// Whether nothing carries it.
    pub fn is_still(&self) -> bool {
        self.at == 0
            && self.to == 0
            && self.turn == 0
            && self.runs.is_none()
            && self.path.iter().all(|via| via.track == 0 && via.drum.is_none())
    }
}
