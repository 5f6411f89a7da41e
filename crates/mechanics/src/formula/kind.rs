//! What is known of the dimension of a value, and what it depends on.

use crate::units::Dimension;
use std::ops::BitOr;

/// What is known of a dimension.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) enum Kind {
    Known(Dimension),
    /// Zero: fits every dimension.
    Any,
    /// Faulty elsewhere.
    Unknown,
}

impl Kind {
    /// The dimension, where zero and faults count as none.
    pub(crate) fn or_none(self) -> Dimension {
        match self {
            Kind::Known(d) => d,
            _ => Dimension::NONE,
        }
    }
}

/// What a value depends on: time 1, coordinates 2, rates 4, accelerations 8, reactions 16, the sliding speed of dry friction 32.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) struct Depends(pub(super) u8);

impl Depends {
    pub(crate) const NOTHING: Depends = Depends(0);
    pub(crate) const TIME: Depends = Depends(1);
    pub(crate) const POSITION: Depends = Depends(3);
    pub(crate) const MOTION: Depends = Depends(7);
    pub(crate) const ALL: Depends = Depends(15);
    pub(crate) const REACTION: Depends = Depends(23);
    pub(crate) const SLIDING: Depends = Depends(32);

    /// Coordinates, rates or accelerations by the number of primes.
    pub(crate) fn coordinate(primes: u8) -> Depends {
        Depends(2 << primes.min(2))
    }
    pub(crate) fn within(self, limit: Depends) -> bool {
        self.0 & !limit.0 == 0
    }
    pub(crate) fn is_constant(self) -> bool {
        self.0 == 0
    }
    pub(crate) fn is_state(self) -> bool {
        self.0 > 1
    }
    /// Of the time derivative; `None` when a third derivative of a coordinate would appear.
    pub(crate) fn derivative(self) -> Option<Depends> {
        (self.0 & !7 == 0).then_some(Depends(self.0 | (self.0 & 6) << 1))
    }
}

impl BitOr for Depends {
    type Output = Depends;
    fn bitor(self, other: Depends) -> Depends {
        Depends(self.0 | other.0)
    }
}

impl Kind {
    /// The dimension of the force that works on a pathway of this dimension: energy / pathway.
    pub(crate) fn conjugate(self) -> Kind {
        match self {
            Kind::Known(d) => Dimension::ENERGY.div(&d.without_angle()).map_or(Kind::Unknown, Kind::Known),
            other => other,
        }
    }
}
