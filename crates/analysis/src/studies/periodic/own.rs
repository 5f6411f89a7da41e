//! The motion from the given start where it closes by itself, one of a family.

use super::found::Found;
use super::spectrum::spectrum;
use crate::System;

/// The first turn of the motion from the given start that closes by itself.
pub(super) enum Plain<'o> {
    /// There is none yet.
    None,
    /// There is none, and the start has been corrected.
    Left,
    /// It.
    Turn(Box<Found<'o>>),
}

/// A miss up to which the motion from the start is its own regime: what a turn leaves is less than that by a digit, and what damping leaves is more where a turn can tell it.
pub(super) const CLOSES: f64 = 1e-12;
/// Distance, in scales, at which two turns are two motions.
const APART: f64 = 1e-9;

impl<'o> Plain<'o> {
    /// That turn in place of what corrections have led to, where a multiplier besides that of the shift is 1: neighbours close as well, and what corrections then do is the rounding of the
    /// gap over that of 1 - μ.
    pub(super) fn or<S: System + ?Sized>(self, system: &mut S, best: Found<'o>, seed: u64) -> Found<'o> {
        let Plain::Turn(own) = self else { return best };
        if own.away_from(&best.orbit.first) <= APART {
            return Found { own: true, ..best };
        }
        let family = own.turn(system).and_then(|(turn, _)| spectrum(&turn, seed)).is_ok_and(|found| found.magnified.is_none());
        if family { *own } else { best }
    }
}
