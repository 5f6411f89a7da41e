//! Places and rates are closed one after the other, by the same means.

/// Whether the level of a condition is its place or its rate; also the index in `given`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Level {
    Place,
    Rate,
}

impl Level {
    pub(super) fn index(self) -> usize {
        match self {
            Level::Place => 0,
            Level::Rate => 1,
        }
    }
}
