//! Where a place joins another one, from the side of that one.
//!
//! ```text
//! K(p) of the place that is joined:   positive beyond p*,  negative before it
//! ```
//!
//! A place that comes to another one as √|p - p*| is known there to the root of rounding only; the other one is regular through p*, and its stability
//! changes there.

use super::{BEHIND, Branch, Event, ONE, Spot, mixed};
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
        let Some(mut beyond) = self.spot(machine, value + step, q)? else { return Ok(None) };
        let Some(mut before) = self.spot(machine, value - step, &beyond.place.q)? else { return Ok(None) };
        if before.unstable <= beyond.unstable || !beyond.violated.is_empty() {
            return Ok(None);
        }
        let (stable, [mut low, mut high]) = (beyond.unstable, [value - step, value + step]);
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
        let sharp = (high - low).abs() <= ONE * high.abs().max(step.abs());
        Ok((sharp && self.known(side, high, Event::Joins).is_none()).then_some((high, beyond)))
    }
}
