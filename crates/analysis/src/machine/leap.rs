//! A jump, told from what runs on steeply: a prescribed velocity that ends in zero is a rounding away from it a rounding earlier.
//!
//! ```text
//! |f(t + δ) - f(t - δ)| > 8 (|f(t - δ) - f(t - 2 δ)| + |f(t + 2 δ) - f(t + δ)|)
//! ```
//!
//! A smooth f changes by as much on either side as across; the bound lets roots with vertical tangents pass, as √x.

/// How much more a jump is than the change on both sides of it.
const STEEPER: f64 = 8.0;

/// Values just before and just after an instant.
pub(super) struct Leap {
    /// The nearer instant first.
    pub before: [Vec<f64>; 2],
    pub after: [Vec<f64>; 2],
}

impl Leap {
    /// The instants of the values: before, after, the nearer ones first.
    pub(super) fn instants([earlier, later]: [f64; 2]) -> [[f64; 2]; 2] {
        let gap = 0.5 * (later - earlier);
        [[earlier, earlier - gap], [later, later + gap]]
    }

    /// How far value i jumps, 0 where it runs on.
    pub(super) fn of(&self, i: usize) -> f64 {
        let [[near, far], [next, beyond]] = [&self.before, &self.after].map(|side| side.each_ref().map(|values| values[i]));
        let jump = next - near;
        if jump.abs() > STEEPER * ((near - far).abs() + (beyond - next).abs()) { jump } else { 0.0 }
    }

    /// The larger of the values on both sides.
    pub(super) fn size(&self, i: usize) -> f64 {
        self.before[0][i].abs().max(self.after[0][i].abs())
    }

    /// Whether one of the values jumps by more than this share of the largest of them.
    pub(super) fn is_felt(&self, share: f64) -> bool {
        let n = self.before[0].len();
        let size = (0..n).fold(0.0_f64, |m, i| m.max(self.size(i)));
        (0..n).any(|i| self.of(i).abs() > share * size)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn leap(f: fn(f64) -> f64) -> f64 {
        let at = |t: [f64; 2]| t.map(|t| vec![f(t)]);
        let [before, after] = Leap::instants([-1e-14, 1e-14]);
        Leap { before: at(before), after: at(after) }.of(0)
    }

    #[test]
    fn a_ramp_a_kink_and_a_vertical_tangent_are_no_jumps() {
        assert_eq!(leap(|t| 3.0 * t), 0.0);
        assert_eq!(leap(|t| if t < 0.0 { -5.0 * t } else { 0.0 }), 0.0);
        assert_eq!(leap(|t| if t < 0.0 { (-t).sqrt() } else { 0.0 }), 0.0);
        // its slope of 1 over the 1e-14 behind the instant, and a rounding
        const BEHIND: f64 = 1.2e-14;
        assert!((leap(|t| if t < 0.0 { 1.0 } else { 3.0 + t }) - 2.0).abs() < BEHIND);
    }
}
