//! The last solutions for accelerations and reactions: audits ask for them one after another at the same places of a step.

/// So many are kept: a step has hardly more places at which several audits meet.
pub(super) const KEPT: usize = 6;

/// Solutions, the oldest replaced first.
#[derive(Clone, Debug, Default)]
pub(super) struct Solved {
    pub(super) list: Vec<Solution>,
    pub(super) next: usize,
}

/// q'' and reactions at a state.
#[derive(Clone, Debug, Default)]
pub(super) struct Solution {
    pub(super) t: f64,
    pub(super) x: Vec<f64>,
    pub(super) modes: Vec<crate::Mode>,
    pub(super) inputs: Vec<f64>,
}

impl Solution {
    /// Zeros of different signs are different: the angle of a point behind the origin goes by them.
    pub(super) fn is_at(&self, t: f64, x: &[f64]) -> bool {
        self.t.to_bits() == t.to_bits() && self.x.len() == x.len() && self.x.iter().zip(x).all(|(a, b)| a.to_bits() == b.to_bits())
    }
}
