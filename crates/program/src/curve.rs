//! Nonlinear operations as functions of intervals: what values they take while their arguments run through given ranges.
//!
//! Every function here is monotone between known points, so its range follows from the ends and those points; products, quotients and angles of
//! boxes follow from the corners. Results are widened by a few units in the last place, for the rounding of the functions themselves.

use algebra::elementary;
use std::f64::consts::PI;

/// Rounding of a library function.
const ULPS: f64 = 4.0 * f64::EPSILON;

/// low..=high.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Range {
    /// Least value.
    pub low: f64,
    /// Greatest value.
    pub high: f64,
}

impl Range {
    /// Between two values in any order.
    pub fn new(a: f64, b: f64) -> Range {
        Range { low: a.min(b), high: a.max(b) }
    }

    /// high - low.
    pub fn width(self) -> f64 {
        self.high - self.low
    }

    /// Largest absolute value.
    pub fn size(self) -> f64 {
        self.low.abs().max(self.high.abs())
    }

    fn contains(self, x: f64) -> bool {
        self.low <= x && x <= self.high
    }

    fn widened(self) -> Range {
        let room = ULPS * self.size() + f64::MIN_POSITIVE;
        Range { low: self.low - room, high: self.high + room }
    }
}

/// An operation that can be flat where its argument moves.
#[derive(Clone, Copy, Debug, PartialEq)]
#[allow(missing_docs)]
pub enum Curve {
    /// a b
    Product,
    /// a²
    Square,
    /// a/b
    Quotient,
    /// √a
    Root,
    /// a^p
    Power(f64),
    Exp,
    Tanh,
    Sinh,
    Cosh,
    Log,
    Asin,
    Acos,
    Atan,
    Asinh,
    Acosh,
    Atanh,
    /// Angle of the point (b, a), continued over ±π
    Angle,
}

impl Curve {
    /// Whether a and b both count.
    pub fn has_two(self) -> bool {
        matches!(self, Curve::Product | Curve::Quotient | Curve::Angle)
    }

    /// Value at (a, b). Roots and fractional powers are continued by their value at zero, because a switch ends the step there.
    pub fn value(self, a: f64, b: f64) -> f64 {
        match self {
            Curve::Product => a * b,
            Curve::Square => a * a,
            Curve::Quotient => a / b,
            Curve::Root => a.max(0.0).sqrt(),
            Curve::Power(p) if p.fract() == 0.0 => elementary::pow(a, p),
            Curve::Power(p) => elementary::pow(a.max(0.0), p),
            Curve::Exp => elementary::exp(a),
            Curve::Tanh => elementary::tanh(a),
            Curve::Sinh => elementary::sinh(a),
            Curve::Cosh => elementary::cosh(a),
            Curve::Log => elementary::ln(a),
            Curve::Asin => elementary::asin(a.clamp(-1.0, 1.0)),
            Curve::Acos => elementary::acos(a.clamp(-1.0, 1.0)),
            Curve::Atan => elementary::atan(a),
            Curve::Asinh => elementary::asinh(a),
            Curve::Acosh => elementary::acosh(a.max(1.0)),
            Curve::Atanh => elementary::atanh(a),
            Curve::Angle => elementary::atan2(a, b),
        }
    }

    /// The values for all (a, b) in a box; none where the box holds a point without a value.
    pub fn range(self, a: Range, b: Range) -> Option<Range> {
        let range = match self {
            Curve::Product => corners(a, b, |a, b| a * b),
            Curve::Quotient if b.contains(0.0) => return None,
            Curve::Quotient => corners(a, b, |a, b| a / b),
            Curve::Square | Curve::Cosh if a.contains(0.0) => {
                Range { low: self.value(0.0, 0.0), high: self.value(a.low, 0.0).max(self.value(a.high, 0.0)) }
            }
            Curve::Log if a.low <= 0.0 => return None,
            Curve::Atanh if a.size() >= 1.0 => return None,
            Curve::Power(p) if (p < 0.0 || p.fract() == 0.0) && a.low <= 0.0 => return None,
            Curve::Angle if a.contains(0.0) && b.contains(0.0) => return None,
            // left of the axis the angle is taken about pi
            Curve::Angle if b.high < 0.0 => {
                let about = corners(a, b, |a, b| elementary::atan2(-a, -b));
                Range { low: about.low + PI, high: about.high + PI }
            }
            Curve::Angle => corners(a, b, elementary::atan2),
            _ => Range::new(self.value(a.low, 0.0), self.value(a.high, 0.0)),
        };
        (!range.low.is_nan() && !range.high.is_nan()).then(|| range.widened())
    }
}

fn corners(a: Range, b: Range, f: impl Fn(f64, f64) -> f64) -> Range {
    let values = [f(a.low, b.low), f(a.low, b.high), f(a.high, b.low), f(a.high, b.high)];
    if values.iter().any(|v| v.is_nan()) {
        return Range { low: f64::NAN, high: f64::NAN };
    }
    values.iter().fold(Range { low: values[0], high: values[0] }, |r, v| Range { low: r.low.min(*v), high: r.high.max(*v) })
}

#[cfg(test)]
mod tests {
    use super::*;

    const CURVES: [Curve; 17] = [
        Curve::Product,
        Curve::Square,
        Curve::Quotient,
        Curve::Root,
        Curve::Power(1.75),
        Curve::Exp,
        Curve::Tanh,
        Curve::Sinh,
        Curve::Cosh,
        Curve::Log,
        Curve::Asin,
        Curve::Acos,
        Curve::Atan,
        Curve::Asinh,
        Curve::Acosh,
        Curve::Atanh,
        Curve::Angle,
    ];

    /// A fixed sequence in -1..1.
    fn numbers() -> impl FnMut() -> f64 {
        let mut n = 0.0_f64;
        move || {
            n += 1.0;
            2.0 * (n * 0.754_877_666_246_692_7).fract() - 1.0
        }
    }

    #[test]
    fn range_holds_every_value_of_the_box() {
        let mut next = numbers();
        for _ in 0..4000 {
            let size = 10.0_f64.powf(2.0 * next());
            let [a, b] = [0; 2].map(|_| Range::new(size * next(), size * next()));
            for curve in CURVES {
                let Some(range) = curve.range(a, b) else { continue };
                for k in 0..=20 {
                    let (s, r) = (f64::from(k) / 20.0, f64::from(k * 7 % 21) / 20.0);
                    // rounding must not leave the box: where f is steep, the range would not hold that
                    let at = |range: Range, share: f64| (range.low + share * range.width()).min(range.high);
                    let value = curve.value(at(a, s), at(b, r));
                    let turned = curve == Curve::Angle && range.contains(value + 2.0 * PI);
                    assert!(range.contains(value) || turned, "{curve:?} {a:?} {b:?}: {value} not in {range:?}");
                }
            }
        }
    }
}
