//! What the reader of a connection makes.

use crate::formula::Kind;
use crate::model::{ConnectionKind, Part};
use crate::units::Dimension;

/// What was read.
pub(crate) struct Made {
    /// What it does.
    pub kind: ConnectionKind,
    /// The components of its reaction that formulas may name.
    pub parts: Vec<(Part, Kind)>,
    /// Dimension of `force`.
    pub force: Kind,
}

impl Made {
    /// A connection whose reaction is a force in newtons, without components so far.
    pub fn of(kind: ConnectionKind) -> Made {
        Made { kind, parts: Vec::new(), force: Kind::Known(Dimension::FORCE) }
    }

    /// One whose only reaction acts along a formula.
    pub fn along(kind: ConnectionKind, force: Kind) -> Made {
        Made { kind, parts: vec![(Part::Force, force)], force }
    }

    /// With these forces.
    pub fn forces(mut self, parts: &[Part]) -> Made {
        self.parts.extend(parts.iter().map(|part| (*part, Kind::Known(Dimension::FORCE))));
        self
    }

    /// With these moments.
    pub fn moments(mut self, parts: &[Part]) -> Made {
        self.parts.extend(parts.iter().map(|part| (*part, Kind::Known(Dimension::ENERGY))));
        self
    }
}
