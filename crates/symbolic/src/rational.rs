//! Exact rational numbers.
//!
//! Decimal literals of a model file stay exact: `0.1` is 1/10. Almost all numbers of a derivation fit in two machine words, so they
//! live there; a result that overflows moves to arbitrary precision and comes back when it fits again. Every value has one
//! representation, hence equality and hashing are structural.

use algebra::double::Double;
use num_bigint::BigInt;
use num_integer::Integer;
use num_rational::BigRational;
use num_traits::{One, Signed, ToPrimitive, Zero};
use std::cmp::Ordering;
use std::fmt;
use std::ops::{Add, Div, Mul, Neg, Sub};

/// An exact rational number in lowest terms with a positive denominator.
#[derive(Clone, PartialEq, Eq, Hash)]
pub struct Rational(Repr);

#[derive(Clone, PartialEq, Eq, Hash)]
enum Repr {
    /// numerator, denominator > 0, coprime; neither is `i64::MIN`
    Small(i64, i64),
    /// only values that do not fit `Small`
    Big(Box<BigRational>),
}
use Repr::{Big, Small};

impl Rational {
    /// Zero.
    pub const ZERO: Rational = Rational(Small(0, 1));
    /// One.
    pub const ONE: Rational = Rational(Small(1, 1));
    /// Minus one.
    pub const MINUS_ONE: Rational = Rational(Small(-1, 1));
    /// One half.
    pub const HALF: Rational = Rational(Small(1, 2));

    /// The fraction `numerator / denominator`; `None` when the denominator is zero.
    pub fn new(numerator: i64, denominator: i64) -> Option<Rational> {
        if denominator == 0 {
            return None;
        }
        Some(Self::from_i128(i128::from(numerator), i128::from(denominator)))
    }

    fn from_i128(n: i128, d: i128) -> Rational {
        if let (1, Some(n)) = (d, fit(n)) {
            return Rational(Small(n, 1));
        }
        let g = n.gcd(&d);
        let (mut n, mut d) = if g > 1 { (n / g, d / g) } else { (n, d) };
        if d < 0 {
            (n, d) = (-n, -d);
        }
        match (fit(n), fit(d)) {
            (Some(n), Some(d)) => Rational(Small(n, d)),
            _ => Rational(Big(Box::new(BigRational::new_raw(n.into(), d.into())))),
        }
    }

    fn from_big(value: BigRational) -> Rational {
        match (value.numer().to_i64().filter(|n| *n != i64::MIN), value.denom().to_i64()) {
            (Some(n), Some(d)) => Rational(Small(n, d)),
            _ => Rational(Big(Box::new(value))),
        }
    }

    fn to_big(&self) -> BigRational {
        match &self.0 {
            Small(n, d) => BigRational::new_raw(BigInt::from(*n), BigInt::from(*d)),
            Big(b) => (**b).clone(),
        }
    }

    /// Reads a decimal literal with an optional exponent (`12`, `0.05`, `1.5e-3`) exactly. `None` when it is not one, or when the
    /// exponent is so large (over 400) that no machine number corresponds to it.
    pub fn parse_decimal(text: &str) -> Option<Rational> {
        let (mantissa, exponent) = match text.find(['e', 'E']) {
            Some(i) => (&text[..i], text[i + 1..].parse::<i32>().ok()?),
            None => (text, 0),
        };
        let (negative, mantissa) = match mantissa.strip_prefix('-') {
            Some(rest) => (true, rest),
            None => (false, mantissa.strip_prefix('+').unwrap_or(mantissa)),
        };
        let (whole, fraction) = mantissa.split_once('.').unwrap_or((mantissa, ""));
        if whole.is_empty() && fraction.is_empty() || !whole.chars().chain(fraction.chars()).all(|c| c.is_ascii_digit()) {
            return None;
        }
        if exponent.unsigned_abs() > 400 || mantissa.len() > 1000 {
            return None;
        }
        let digits: BigInt = format!("{whole}{fraction}").parse().ok()?;
        let shift = exponent - i32::try_from(fraction.len()).ok()?;
        let scale = num_traits::pow(BigInt::from(10), shift.unsigned_abs() as usize);
        let value = if shift >= 0 { BigRational::from_integer(digits * scale) } else { BigRational::new(digits, scale) };
        Some(Self::from_big(if negative { -value } else { value }))
    }

    /// The exact value of a finite machine number; `None` for infinities and not-a-number.
    pub fn from_f64(value: f64) -> Option<Rational> {
        BigRational::from_float(value).map(Self::from_big)
    }

    /// The nearest machine number.
    pub fn to_f64(&self) -> f64 {
        const EXACT: u64 = 1 << 53;
        match &self.0 {
            Small(n, d) if n.unsigned_abs() <= EXACT && d.unsigned_abs() <= EXACT => *n as f64 / *d as f64,
            _ => self.to_big().to_f64().unwrap_or(f64::NAN),
        }
    }

    /// The nearest number of twice the digits.
    pub fn to_double(&self) -> Double {
        let high = self.to_f64();
        let rest = Rational::from_f64(high).map_or(0.0, |near| (self - &near).to_f64());
        Double::of(high, rest)
    }

    /// Whether the value is 0.
    pub fn is_zero(&self) -> bool {
        matches!(self.0, Small(0, _))
    }
    /// Whether the value is 1.
    pub fn is_one(&self) -> bool {
        matches!(self.0, Small(1, 1))
    }
    /// Whether the value is below zero.
    pub fn is_negative(&self) -> bool {
        match &self.0 {
            Small(n, _) => *n < 0,
            Big(b) => b.is_negative(),
        }
    }
    /// Whether the denominator is 1.
    pub fn is_integer(&self) -> bool {
        match &self.0 {
            Small(_, d) => *d == 1,
            Big(b) => b.is_integer(),
        }
    }
    /// The value as a machine integer, when it is one.
    pub fn to_i64(&self) -> Option<i64> {
        match &self.0 {
            Small(n, 1) => Some(*n),
            _ => None,
        }
    }
    /// The absolute value.
    pub fn abs(&self) -> Rational {
        if self.is_negative() { -self } else { self.clone() }
    }
    /// Numerator and denominator in decimal digits, the sign on the numerator.
    pub fn digits(&self) -> (String, String) {
        match &self.0 {
            Small(n, d) => (n.to_string(), d.to_string()),
            Big(b) => (b.numer().to_string(), b.denom().to_string()),
        }
    }
    /// The larger number of binary digits of numerator and denominator: how much memory and time arithmetic with it takes.
    pub fn bits(&self) -> u64 {
        match &self.0 {
            Small(n, d) => u64::from(64 - n.unsigned_abs().max(d.unsigned_abs()).leading_zeros()),
            Big(b) => b.numer().bits().max(b.denom().bits()),
        }
    }
    /// The reciprocal; `None` for zero.
    pub fn recip(&self) -> Option<Rational> {
        if self.is_zero() { None } else { Some(&Rational::ONE / self) }
    }

    /// An integer power. `None` for a negative power of zero and for results beyond some ten thousand digits.
    pub fn pow(&self, exponent: i64) -> Option<Rational> {
        if exponent < 0 {
            return self.recip()?.pow(exponent.checked_neg()?);
        }
        if self.is_one() || exponent == 0 {
            return Some(Rational::ONE);
        }
        let (n, d) = self.digits();
        let size = u64::try_from(n.len().max(d.len())).ok()?;
        if self.is_zero() || *self == Rational::MINUS_ONE || size.checked_mul(exponent as u64)? <= 10_000 {
            let reduced = if *self == Rational::MINUS_ONE { exponent % 2 } else { exponent };
            return Some(Self::from_big(num_traits::pow(self.to_big(), if self.is_zero() { 1 } else { reduced as usize })));
        }
        None
    }

    /// The exact root of the given degree, when it is rational: `(4/9).root(2)` is 2/3. Only for non-negative values.
    pub fn root(&self, degree: u32) -> Option<Rational> {
        if self.is_negative() || degree == 0 {
            return None;
        }
        let big = self.to_big();
        let (n, d) = (big.numer().nth_root(degree), big.denom().nth_root(degree));
        let exact =
            num_traits::pow(n.clone(), degree as usize) == *big.numer() && num_traits::pow(d.clone(), degree as usize) == *big.denom();
        exact.then(|| Self::from_big(BigRational::new(n, d)))
    }

    /// The largest integer not above the value.
    pub fn floor(&self) -> Rational {
        match &self.0 {
            Small(n, d) => Rational(Small(n.div_floor(d), 1)),
            Big(b) => Self::from_big(b.floor()),
        }
    }
}

/// The pair fits `Small` when it is an `i64` whose negation is one as well.
fn fit(n: i128) -> Option<i64> {
    i64::try_from(n).ok().filter(|n| *n != i64::MIN)
}

impl From<i64> for Rational {
    fn from(n: i64) -> Rational {
        Rational::from_i128(i128::from(n), 1)
    }
}

impl Add for &Rational {
    type Output = Rational;
    fn add(self, other: &Rational) -> Rational {
        match (&self.0, &other.0) {
            (Small(a, 1), Small(b, 1)) => Rational::from_i128(i128::from(*a) + i128::from(*b), 1),
            (Small(0, _), _) => other.clone(),
            (_, Small(0, _)) => self.clone(),
            (Small(a, b), Small(c, d)) => {
                let (a, b, c, d) = (i128::from(*a), i128::from(*b), i128::from(*c), i128::from(*d));
                match (a * d).checked_add(c * b) {
                    Some(n) => Rational::from_i128(n, b * d),
                    None => Rational::from_big(self.to_big() + other.to_big()),
                }
            }
            _ => Rational::from_big(self.to_big() + other.to_big()),
        }
    }
}
impl Mul for &Rational {
    type Output = Rational;
    fn mul(self, other: &Rational) -> Rational {
        match (&self.0, &other.0) {
            (Small(1, 1), _) => other.clone(),
            (_, Small(1, 1)) => self.clone(),
            (Small(a, b), Small(c, d)) => Rational::from_i128(i128::from(*a) * i128::from(*c), i128::from(*b) * i128::from(*d)),
            _ => Rational::from_big(self.to_big() * other.to_big()),
        }
    }
}
impl Neg for &Rational {
    type Output = Rational;
    fn neg(self) -> Rational {
        match &self.0 {
            Small(n, d) => Rational(Small(-n, *d)),
            Big(b) => Rational::from_big(-(**b).clone()),
        }
    }
}
impl Sub for &Rational {
    type Output = Rational;
    fn sub(self, other: &Rational) -> Rational {
        self + &-other
    }
}
/// Division by zero gives zero divided by one only through [`Rational::recip`]; the operator is for divisors known to be non-zero.
impl Div for &Rational {
    type Output = Rational;
    fn div(self, other: &Rational) -> Rational {
        debug_assert!(!other.is_zero(), "rational division by zero");
        if other.is_zero() {
            return Rational::ZERO;
        }
        match (&self.0, &other.0) {
            (Small(a, b), Small(c, d)) => Rational::from_i128(i128::from(*a) * i128::from(*d), i128::from(*b) * i128::from(*c)),
            _ => Rational::from_big(self.to_big() / other.to_big()),
        }
    }
}
impl PartialOrd for Rational {
    fn partial_cmp(&self, other: &Rational) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}
impl Ord for Rational {
    fn cmp(&self, other: &Rational) -> Ordering {
        match (&self.0, &other.0) {
            (Small(a, b), Small(c, d)) => (i128::from(*a) * i128::from(*d)).cmp(&(i128::from(*c) * i128::from(*b))),
            _ => self.to_big().cmp(&other.to_big()),
        }
    }
}
impl fmt::Display for Rational {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let (n, d) = self.digits();
        if d == "1" { write!(f, "{n}") } else { write!(f, "{n}/{d}") }
    }
}
impl fmt::Debug for Rational {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        fmt::Display::fmt(self, f)
    }
}
impl Default for Rational {
    fn default() -> Rational {
        debug_assert!(BigInt::zero() != BigInt::one());
        Rational::ZERO
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn decimal_literals_are_exact() {
        let tenth = Rational::parse_decimal("0.1").unwrap();
        assert_eq!(tenth, Rational::new(1, 10).unwrap());
        assert_eq!(Rational::parse_decimal("-12.50e-2").unwrap(), Rational::new(-1, 8).unwrap());
        assert_eq!(Rational::parse_decimal("1e400").unwrap().pow(2), Some(Rational::parse_decimal("1e400").map(|v| &v * &v).unwrap()));
        for bad in ["", ".", "1.2.3", "1e", "0x1", "1e999", "--1"] {
            assert_eq!(Rational::parse_decimal(bad), None, "{bad}");
        }
    }

    #[test]
    fn overflow_moves_to_big_and_back() {
        let big = Rational::from(i64::MAX);
        let square = &big * &big;
        assert_eq!(&square / &big, big);
        assert_eq!((&square - &square), Rational::ZERO);
        assert_eq!(Rational::from(i64::MIN).to_f64(), -(2f64.powi(63)));
    }

    #[test]
    fn nearest_machine_number() {
        for text in ["0.0053", "9.81", "1e-4", "0.0614323679", "123456789012345678901234567890", "2.2250738585072014e-308", "3e-320"] {
            assert_eq!(Rational::parse_decimal(text).unwrap().to_f64(), text.parse::<f64>().unwrap(), "{text}");
        }
    }

    #[test]
    fn roots_and_powers() {
        assert_eq!(Rational::new(4, 9).unwrap().root(2), Rational::new(2, 3));
        assert_eq!(Rational::from(2).root(2), None);
        assert_eq!(Rational::from(2).pow(-3), Rational::new(1, 8));
        assert_eq!(Rational::ZERO.pow(-1), None);
        assert_eq!(Rational::from(10).pow(1_000_000), None);
        assert_eq!(Rational::new(-7, 2).unwrap().floor(), Rational::from(-4));
    }
}
