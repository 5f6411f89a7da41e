//! What multipliers say of stability.

use super::options::Multiplier;

/// Multipliers this near to the unit circle decide nothing, whatever their error.
pub const NEUTRAL: f64 = 1e-10;

/// What a multiplier's distance from the unit circle must exceed.
pub(super) fn margin(m: &Multiplier) -> f64 {
    m.error.max(NEUTRAL)
}

pub(super) fn stable(multipliers: &[Multiplier]) -> Option<bool> {
    let own = || multipliers.iter().filter(|m| !m.trivial);
    if own().any(|m| m.abs() - 1.0 > margin(m)) {
        return Some(false);
    }
    own().all(|m| 1.0 - m.abs() > margin(m)).then_some(true)
}
