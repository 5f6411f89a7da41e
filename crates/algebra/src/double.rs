//! Numbers of twice the digits: sums of products, and the four operations.

mod functions;

use crate::sum::two_sum;

/// A sum in twice the digits.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
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

/// aᵀ b of vectors that have twice the digits themselves.
pub fn inner(a: &[Double], b: &[Double]) -> Double {
    a.iter().zip(b).fold(Double::default(), |sum, (x, y)| sum.plus(*x, *y))
}

impl From<f64> for Double {
    fn from(high: f64) -> Double {
        Double { high, low: 0.0 }
    }
}

impl Double {
    /// The exact sum of two numbers.
    pub fn of(a: f64, b: f64) -> Double {
        let (high, low) = two_sum(a, b);
        Double { high, low }
    }
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
    /// self + other.
    #[must_use]
    pub fn sum(self, other: Double) -> Double {
        let (sum, rest) = two_sum(self.high, other.high);
        let (lows, last) = two_sum(self.low, other.low);
        let (high, low) = two_sum(sum, rest + lows);
        let (high, low) = two_sum(high, low + last);
        Double { high, low }
    }
    /// self - other.
    #[must_use]
    pub fn less(self, other: Double) -> Double {
        self.sum(other.negated())
    }
    /// self · other.
    #[must_use]
    pub fn times(self, other: Double) -> Double {
        let (product, error) = two_product(self.high, other.high);
        let (high, low) = two_sum(product, error + (self.high * other.low + self.low * other.high));
        Double { high, low }
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
    /// √self of a number that is not negative.
    #[must_use]
    pub fn root(self) -> Double {
        let root = self.high.max(0.0).sqrt();
        if root == 0.0 {
            return Double::default();
        }
        let rest = self.add(-root, root);
        Double::of(root, (rest.high + rest.low) / (2.0 * root))
    }
    /// The nearest number and what is left.
    pub fn parts(self) -> [f64; 2] {
        let (high, low) = two_sum(self.high, self.low);
        [high, low]
    }
    /// Nearest number.
    pub fn round(self) -> f64 {
        self.high + self.low
    }
    /// Whether it is exactly 0.
    pub fn is_zero(self) -> bool {
        self.high == 0.0 && self.low == 0.0
    }
}

/// Sum of products in twice the digits.
pub(super) fn dot(a: impl Iterator<Item = (f64, f64)>) -> Double {
    a.fold(Double::default(), |sum, (x, y)| sum.add(x, y))
}
