//! The largest ratio of residuals to scales along a motion, where the scale of the whole is known at the end only.
//!
//! A residual counts against what has met so far: a wrong beginning is not excused by a strong end. But the terms of the whole motion are rounded to
//! 1e-16 of their own size (a torque M (1 + tanh)/2 that has not begun yet is noise of 1e-16 M), so no scale is below [`FLOOR`] of the last.

use super::{LEAST, ROUNDED};

/// Share of the scale of the whole motion below which everything is rounding: then 64 units of the last place meet the least limit of the audits.
pub const FLOOR: f64 = ROUNDED * f64::EPSILON / LEAST;
/// Scales closer than this are one.
const ALIKE: f64 = 1.01;

/// Residuals that can still be the worst: both residuals and scales ascend.
#[derive(Clone, Debug, Default)]
pub struct Frontier {
    marks: Vec<[f64; 2]>,
    last: f64,
    broken: bool,
}

impl Frontier {
    /// Notes a residual with the scale that it counts against; scales may fall again.
    pub fn note(&mut self, residual: f64, scale: f64) {
        self.broken |= residual.is_nan() || scale.is_nan();
        self.last = self.last.max(scale);
        if residual <= 0.0 {
            return;
        }
        // those that are smaller against a larger scale can never be the worst
        self.marks.retain(|[r, s]| *r > residual || *s < scale);
        if self.marks.iter().any(|[r, s]| *r >= residual && *s <= scale * ALIKE) {
            return;
        }
        self.marks.push([residual, scale]);
    }

    /// The scale of the whole, when it is more than what was noted.
    pub fn whole(&mut self, scale: f64) {
        self.last = self.last.max(scale);
    }

    /// The largest ratio; not a number when a residual was none.
    pub fn worst(&self) -> f64 {
        if self.broken {
            return f64::NAN;
        }
        let floor = FLOOR * self.last;
        self.marks.iter().fold(0.0, |worst, [r, s]| f64::max(worst, r / s.max(floor)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn noise_before_the_motion_is_no_error_and_a_wrong_beginning_is() {
        let mut noise = Frontier::default();
        noise.note(1e-30, 1e-30);
        noise.note(1e-14, 1.0);
        // rounding over the scale of the whole motion
        assert!(noise.worst() < 1e-13);
        let mut wrong = Frontier::default();
        wrong.note(1e-4, 1e-3);
        wrong.note(1e-4, 1.0);
        // units of the last place
        assert!((wrong.worst() - 0.1).abs() < 1e-15);
        wrong.note(f64::NAN, 1.0);
        assert!(wrong.worst().is_nan());
    }
}
