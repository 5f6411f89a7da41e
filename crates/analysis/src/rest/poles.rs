//! Poles of a force: it changes its sign there and grows towards them from both sides (tan x at π/2, 1/(x − a)³), which Newton's method takes for a place of rest, since the
//! correction F/F' vanishes with the distance.
//!
//! ```text
//! |F(s)| > |F(4 s)|  for s = ±10⁻¹⁰, ±10⁻⁸ of the sizes         a pole; at a place of rest F(s) → 0
//! ```

/// Distances at which a force is looked at, relative to the size of the coordinate, and again so many times as far.
const NEAR: [f64; 2] = [1e-10, 1e-8];
const FARTHER: f64 = 4.0;
/// Growth between both that a jump of a smooth force on each side does not make.
const GROWS: f64 = 1.05;
/// A force above this share of the terms that meet in it is clear of their rounding, at the least of these distances too.
pub(super) const CLEAR: f64 = 1e-12;

/// Whether one of the forces at these displacements has a pole at zero; nothing is said of a force that is rounding there, which has no value.
pub(super) fn is_pole(forces: &mut dyn FnMut(f64) -> Option<Vec<f64>>) -> bool {
    let mut grown: Option<Vec<bool>> = None;
    for s in NEAR.into_iter().flat_map(|s| [s, -s]) {
        let Some((near, far)) = forces(s).zip(forces(FARTHER * s)) else { return false };
        let grows = |k: usize| near[k].abs() > GROWS * far[k].abs();
        let grown = grown.get_or_insert_with(|| vec![true; near.len()]);
        grown.iter_mut().enumerate().for_each(|(k, all)| *all &= grows(k));
        if !grown.contains(&true) {
            return false;
        }
    }
    grown.is_some()
}
