//! The numbers of a frame: machine numbers, machine numbers of twice the digits, or exact rationals.

use algebra::double::Double;
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

    /// Whether a pivot of a stiffness counts as 0 beside entries of this size. A deformation that is rounding of places stores an energy of its square, so that
    /// numbers of more digits tell soft springs from nothing where directions of rods do not.
    fn gives_way(&self, size: f64) -> bool {
        self.vanishes(size)
    }

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

/// A pivot of a stiffness in twice the digits that is rounding: products carry 1e-32, and directions of rods that are off by 1e-16 store as much.
const PIVOT: f64 = 1e-27;

impl Scalar for Double {
    fn zero() -> Double {
        Double::default()
    }
    fn of(value: &Rational) -> Double {
        value.to_double()
    }
    fn add(&self, other: &Double) -> Double {
        self.sum(*other)
    }
    fn sub(&self, other: &Double) -> Double {
        self.less(*other)
    }
    fn mul(&self, other: &Double) -> Double {
        self.times(*other)
    }
    fn div(&self, other: &Double) -> Double {
        self.over(*other)
    }
    fn value(&self) -> f64 {
        self.round()
    }
    fn vanishes(&self, size: f64) -> bool {
        // places and directions have the digits of single numbers
        self.round().abs() <= ROUNDING * size
    }
    fn gives_way(&self, size: f64) -> bool {
        self.round().abs() <= PIVOT * size
    }
    fn ratio(n: i64, d: i64) -> Double {
        Double::from(n as f64).over(Double::from(d as f64))
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
