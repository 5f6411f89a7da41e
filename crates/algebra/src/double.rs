//! Sums of products in twice the digits.

use crate::sum::two_sum;

/// A sum in twice the digits.
#[derive(Clone, Copy, Debug, Default)]
pub struct Double {
    pub(super) high: f64,
    pub(super) low: f64,
}

/// a b = product + error exactly. *Source*: T. J. Dekker, A floating-point technique, Numer. Math. 18 (1971).
#[inline]
fn two_product(a: f64, b: f64) -> (f64, f64) {
    const SPLIT: f64 = 134_217_729.0; // 2^27 + 1
    let product = a * b;
    let (a_big, b_big) = (SPLIT * a, SPLIT * b);
    let (a_high, b_high) = (a_big - (a_big - a), b_big - (b_big - b));
    let (a_low, b_low) = (a - a_high, b - b_high);
    (product, ((a_high * b_high - product) + a_high * b_low + a_low * b_high) + a_low * b_low)
}

impl From<f64> for Double {
    fn from(high: f64) -> Double {
        Double { high, low: 0.0 }
    }
}

impl Double {
    /// self + a b.
    #[inline]
    pub fn add(self, a: f64, b: f64) -> Double {
        let (product, error) = two_product(a, b);
        let (sum, rest) = two_sum(self.high, product);
        let (high, low) = two_sum(sum, self.low + error + rest);
        Double { high, low }
    }
    /// self + b other.
    pub fn add_times(self, b: f64, other: Double) -> Double {
        let sum = self.add(b, other.high);
        Double { high: sum.high, low: sum.low + b * other.low }
    }
    /// self + a b.
    #[must_use]
    pub fn plus(self, a: Double, b: Double) -> Double {
        self.add(a.high, b.high).add(a.high, b.low).add(a.low, b.high)
    }
    /// -self.
    #[must_use]
    pub fn negated(self) -> Double {
        Double { high: -self.high, low: -self.low }
    }
    /// self / other.
    pub fn over(self, other: Double) -> Double {
        let high = self.high / other.high;
        let rest = self.add_times(-high, other);
        Double { high, low: (rest.high + rest.low) / other.high }
    }
    /// Nearest number.
    pub fn round(self) -> f64 {
        self.high + self.low
    }
}

/// Sum of products in twice the digits.
pub(super) fn dot(a: impl Iterator<Item = (f64, f64)>) -> Double {
    a.fold(Double::default(), |sum, (x, y)| sum.add(x, y))
}
