//! The least value of an output over a steady forced motion.

use super::response::{Forced, magnitude};
use super::superposition::{Care, superpose};
use crate::Fault;

/// An output of a steady motion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Least {
    /// About which it oscillates.
    pub mean: f64,
    /// The least value.
    pub least: f64,
}

/// The outputs at ω: over a period, or, where the frequencies have none in common, the mean less all amplitudes, which such a motion comes as near
/// as one likes.
///
/// *Errors*: formulas without a value at this frequency.
pub fn least(forced: &mut Forced, omega: f64) -> Result<Vec<Least>, Fault> {
    if let Some(all) = superpose(forced, omega, Care::Curve)? {
        return Ok(all.outputs.iter().map(|range| Least { mean: range.mean, least: range.min.0 }).collect());
    }
    forced.matrices(omega)?;
    let seen = forced.machine.observe(&forced.observer, &forced.place)?;
    let mut found: Vec<Least> = seen.iter().map(|s| Least { mean: s.mean, least: s.mean }).collect();
    let (current, orders) = (forced.current(), forced.components().iter().map(|c| c.order).collect::<Vec<_>>());
    for (k, order) in orders.into_iter().enumerate() {
        forced.choose(k);
        let point = forced.at(order * omega)?;
        found.iter_mut().zip(&point.outputs).for_each(|(found, z)| found.least -= magnitude(*z));
    }
    forced.choose(current);
    Ok(found)
}
