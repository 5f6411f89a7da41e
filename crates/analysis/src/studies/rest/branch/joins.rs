//! Where a place joins another one, from the side of that one.
//!
//! ```text
//! K(p) of the place that is joined:   positive beyond p*,  negative before it
//! ```
//!
//! A place that comes to another one as √|p - p*| is known there to the root of rounding only; the other one is regular through p*, and its stability
//! changes there.

use super::{BEHIND, Branch, Event, ONE, Spot, Station, between, mixed};
use crate::Fault;
use crate::linear::LinearMachine;

impl Branch {
    /// Value and place of the fork at which the place near `q` is joined; none where that place keeps its stability, or is not known on both sides.
    pub(super) fn joined(
        &mut self,
        machine: &mut LinearMachine,
        side: usize,
        (value, q): (f64, &[f64]),
    ) -> Result<Option<(f64, Spot)>, Fault> {
        let step = BEHIND * (value - self.home);
        let Some(beyond) = self.spot(machine, value + step, q)? else { return Ok(None) };
        let Some(before) = self.spot(machine, value - step, &beyond.place.q)? else { return Ok(None) };
        if before.unstable <= beyond.unstable || !beyond.violated.is_empty() {
            return Ok(None);
        }
        let stable = beyond.unstable;
        let [(low, _), (high, beyond)] = self.bisected(machine, [(value - step, before), (value + step, beyond)], stable)?;
        let sharp = (high - low).abs() <= ONE * high.abs().max(step.abs());
        Ok((sharp && self.known(side, high, Event::Joins).is_none()).then_some((high, beyond)))
    }

    /// The narrowest interval in which the place that is joined gains its stability.
    fn bisected(&mut self, machine: &mut LinearMachine, ends: [(f64, Spot); 2], stable: usize) -> Result<[(f64, Spot); 2], Fault> {
        let [(mut low, mut before), (mut high, mut beyond)] = ends;
        for _ in 0..100 {
            let middle = 0.5 * (low + high);
            if middle == low || middle == high {
                break;
            }
            // in the fork itself nothing restores, and Newton's method may find no place
            let mut found = None;
            for share in [0.5, 0.3, 0.7] {
                let value = low + share * (high - low);
                let near = mixed(&before.place.q, &beyond.place.q, share);
                found = self.spot(machine, value, &near)?.map(|spot| (value, spot));
                if found.is_some() {
                    break;
                }
            }
            let Some((value, spot)) = found else { break };
            if spot.unstable > stable { (low, before) = (value, spot) } else { (high, beyond) = (value, spot) }
        }
        Ok([(low, before), (high, beyond)])
    }

    /// Where forces are rounding, a place may come to another one in steps that all look smooth. Followed back from the end of a piece of the way, that place is
    /// unstable then, and another one than that from which the piece began; the fork at which it was joined is noted.
    pub(super) fn overlooked(&mut self, machine: &mut LinearMachine, side: usize, from: &Station) -> Result<(), Fault> {
        let end = self.last(side);
        let (Some(a), Some(b)) = (&from.spot, &end.spot) else { return Ok(()) };
        if a.unstable > 0 || b.unstable > 0 || a.closed != b.closed || !b.violated.is_empty() {
            return Ok(());
        }
        self.closed.clone_from(&b.closed);
        let Some(back) = self.spot(machine, from.value, &b.place.q)? else { return Ok(()) };
        if back.unstable == 0 || self.same(&back.place.q, &a.place.q) {
            return Ok(());
        }
        let [(low, _), (at, spot)] = self.bisected(machine, [(from.value, back), (end.value, b.clone())], b.unstable)?;
        if (at - low).abs() > ONE * at.abs().max((at - self.home).abs()) {
            return Ok(());
        }
        self.change(side, at, Event::Joins, &spot.place.q);
        self.arms[side].retain(|s| between(s.value, at, side));
        self.push(side, Station { value: at, spot: Some(spot), parted: true });
        if between(at, end.value, side) {
            self.push(side, Station { parted: false, ..end });
        }
        Ok(())
    }
}
