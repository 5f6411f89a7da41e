//! The numbers of a frame: machine numbers, or exact rationals.

use symbolic::Rational;

/// A field of numbers with a notion of size, for pivots.
pub trait Scalar: Clone + std::fmt::Debug + PartialEq {
    /// 0.
    fn zero() -> Self;
    /// The nearest number to an exact one.
    fn of(value: &Rational) -> Self;
    /// self + other.
    fn add(&self, other: &Self) -> Self;
    /// self - other.
    fn sub(&self, other: &Self) -> Self;
    /// self · other.
    fn mul(&self, other: &Self) -> Self;
    /// self / other; the divisor is not 0.
    fn div(&self, other: &Self) -> Self;
    /// The nearest machine number.
    fn value(&self) -> f64;
    /// Whether a result counts as 0 beside terms of this size: within rounding for machine numbers, exactly for exact ones.
    fn vanishes(&self, size: f64) -> bool;

    /// 1.
    fn one() -> Self {
        Self::of(&Rational::ONE)
    }
    /// n/d; the denominator is not 0.
    fn ratio(n: i64, d: i64) -> Self {
        Self::of(&Rational::new(n, d).unwrap_or(Rational::ZERO))
    }
    /// -self.
    fn neg(&self) -> Self {
        Self::zero().sub(self)
    }
    /// Whether it is exactly 0.
    fn is_zero(&self) -> bool {
        *self == Self::zero()
    }
    /// Absolute machine number.
    fn size(&self) -> f64 {
        self.value().abs()
    }
}

/// Rounding of a short sum, with room for two digits.
const ROUNDING: f64 = 1e-11;

impl Scalar for f64 {
    fn zero() -> f64 {
        0.0
    }
    fn of(value: &Rational) -> f64 {
        value.to_f64()
    }
    fn add(&self, other: &f64) -> f64 {
        self + other
    }
    fn sub(&self, other: &f64) -> f64 {
        self - other
    }
    fn mul(&self, other: &f64) -> f64 {
        self * other
    }
    fn div(&self, other: &f64) -> f64 {
        self / other
    }
    fn value(&self) -> f64 {
        *self
    }
    fn vanishes(&self, size: f64) -> bool {
        self.abs() <= ROUNDING * size
    }
}

impl Scalar for Rational {
    fn zero() -> Rational {
        Rational::ZERO
    }
    fn of(value: &Rational) -> Rational {
        value.clone()
    }
    fn add(&self, other: &Rational) -> Rational {
        self + other
    }
    fn sub(&self, other: &Rational) -> Rational {
        self - other
    }
    fn mul(&self, other: &Rational) -> Rational {
        self * other
    }
    fn div(&self, other: &Rational) -> Rational {
        self / other
    }
    fn value(&self) -> f64 {
        self.to_f64()
    }
    fn vanishes(&self, _: f64) -> bool {
        self.is_zero()
    }
    fn is_zero(&self) -> bool {
        Rational::is_zero(self)
    }
}
