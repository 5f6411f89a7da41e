//! Exponential polynomials f(t) = Σ c t^k e^(λ t): the loads for which a linear system has a closed form.
//!
//! Constants, ramps, sines, their products and decaying ones are all of this kind, and sums and products stay in it. λ and c are complex; a
//! real function carries both halves of each conjugate pair.

use algebra::complex::{self, Complex, imaginary};
use algebra::elementary;

/// c t^k e^(λ t).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Term {
    /// λ.
    pub rate: Complex,
    /// k.
    pub power: u32,
    /// c.
    pub factor: Complex,
}

/// A sum of terms that differ in λ or k.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Load(pub Vec<Term>);

/// Sums that cancel to this share of their parts are zero: what is left is rounding.
const CANCELLED: f64 = 32.0 * f64::EPSILON;
/// Rates that differ by this share are one: both came from one number on two ways.
const SAME: f64 = 8.0 * f64::EPSILON;

impl Load {
    /// A constant.
    pub fn constant(c: f64) -> Load {
        Load::term(Complex::ZERO, 0, Complex::from(c))
    }
    /// t.
    pub fn time() -> Load {
        Load::term(Complex::ZERO, 1, Complex::ONE)
    }
    fn term(rate: Complex, power: u32, factor: Complex) -> Load {
        if factor == Complex::ZERO { Load::default() } else { Load(vec![Term { rate, power, factor }]) }
    }
    /// sin(a t + b).
    pub fn sine(a: f64, b: f64) -> Load {
        // (e^(i(at+b)) - e^(-i(at+b)))/(2i)
        let half = complex::exp(imaginary(b)) * imaginary(-0.5);
        Load::pair(a, half)
    }
    /// cos(a t + b).
    pub fn cosine(a: f64, b: f64) -> Load {
        Load::pair(a, complex::exp(imaginary(b)).scale(0.5))
    }
    fn pair(a: f64, half: Complex) -> Load {
        if a == 0.0 {
            return Load::constant(2.0 * half.re);
        }
        let mut sum = Load::term(imaginary(a), 0, half);
        sum.0.extend(Load::term(imaginary(-a), 0, half.conj()).0);
        sum
    }
    /// e^(a t + b).
    pub fn growth(a: f64, b: f64) -> Load {
        Load::term(Complex::from(a), 0, Complex::from(elementary::exp(b)))
    }

    /// The number, when it does not change.
    pub fn as_constant(&self) -> Option<f64> {
        match self.0.as_slice() {
            [] => Some(0.0),
            [t] if t.power == 0 && t.rate == Complex::ZERO => Some(t.factor.re),
            _ => None,
        }
    }
    /// The constant term.
    pub fn mean(&self) -> f64 {
        self.0.iter().filter(|t| t.power == 0 && t.rate == Complex::ZERO).fold(0.0, |sum, t| sum + t.factor.re)
    }
    /// (a, b) of a t + b.
    pub fn as_affine(&self) -> Option<(f64, f64)> {
        self.0.iter().try_fold((0.0, 0.0), |(a, b), t| match t.power {
            _ if t.rate != Complex::ZERO => None,
            0 => Some((a, b + t.factor.re)),
            1 => Some((a + t.factor.re, b)),
            _ => None,
        })
    }
    /// Whether it is zero always.
    pub fn is_zero(&self) -> bool {
        self.0.is_empty()
    }

    /// The value at t.
    pub fn at(&self, t: f64) -> f64 {
        self.0.iter().map(|term| (term.factor * complex::exp(term.rate.scale(t))).re * elementary::powi(t, term.power as i32)).sum()
    }

    /// Adds a multiple of another.
    pub fn add(&mut self, other: &Load, factor: f64) {
        for t in &other.0 {
            self.push(Term { factor: t.factor.scale(factor), ..*t });
        }
    }

    fn push(&mut self, term: Term) {
        let same = |t: &Term| t.power == term.power && complex::abs(t.rate - term.rate) <= SAME * complex::abs(t.rate);
        let Some(i) = self.0.iter().position(same) else {
            if term.factor != Complex::ZERO {
                self.0.push(term);
            }
            return;
        };
        let (before, sum) = (self.0[i].factor, self.0[i].factor + term.factor);
        if complex::abs(sum) <= CANCELLED * (complex::abs(before) + complex::abs(term.factor)) {
            self.0.remove(i);
        } else {
            self.0[i].factor = sum;
        }
    }

    /// The product with another.
    pub fn times(&self, other: &Load) -> Load {
        let mut product = Load::default();
        for a in &self.0 {
            for b in &other.0 {
                let sum = a.rate + b.rate;
                let rate = if complex::abs(sum) <= SAME * complex::abs(a.rate) { Complex::ZERO } else { sum };
                product.push(Term { rate, power: a.power + b.power, factor: a.factor * b.factor });
            }
        }
        product
    }

    /// The derivative.
    pub fn derivative(&self) -> Load {
        let mut sum = Load::default();
        for t in &self.0 {
            sum.push(Term { factor: t.factor * t.rate, ..*t });
            if t.power > 0 {
                sum.push(Term { rate: t.rate, power: t.power - 1, factor: t.factor.scale(f64::from(t.power)) });
            }
        }
        sum
    }

    /// An antiderivative.
    pub fn integral(&self) -> Load {
        let mut sum = Load::default();
        for t in &self.0 {
            if t.rate == Complex::ZERO {
                sum.push(Term { rate: t.rate, power: t.power + 1, factor: t.factor.scale(1.0 / f64::from(t.power + 1)) });
                continue;
            }
            // ∫ t^k e^(λt) = t^k e^(λt)/λ - k/λ ∫ t^(k-1) e^(λt)
            let mut factor = t.factor / t.rate;
            for power in (0..=t.power).rev() {
                sum.push(Term { rate: t.rate, power, factor });
                factor = -(factor.scale(f64::from(power)) / t.rate);
            }
        }
        sum
    }

    /// The same function over τ = t - start.
    pub fn from(&self, start: f64) -> Load {
        let mut moved = Load::default();
        for t in &self.0 {
            let factor = t.factor * complex::exp(t.rate.scale(start));
            // (τ + s)^k by the binomial theorem
            let mut binomial = 1.0;
            for j in 0..=t.power {
                let share = binomial * elementary::powi(start, (t.power - j) as i32);
                moved.push(Term { rate: t.rate, power: j, factor: factor.scale(share) });
                binomial *= f64::from(t.power - j) / f64::from(j + 1);
            }
        }
        moved
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Units of the last place.
    const ROUNDING: f64 = 1e-15;
    /// Products of loads: sums of a dozen terms.
    const PRODUCT: f64 = 1e-13;
    /// The same shifted in time: powers of the shift with their binomials.
    const NEAR: f64 = 1e-12;

    #[test]
    fn products_and_shifts_keep_the_function() {
        let mut f = Load::sine(3.0, 0.4).times(&Load::cosine(2.0, -1.0));
        f.add(&Load::time().times(&Load::time()), 2.0);
        f.add(&Load::growth(-0.5, 0.1).times(&Load::sine(1.5, 0.0)), -1.0);
        let value = |t: f64| (3.0 * t + 0.4).sin() * (2.0 * t - 1.0).cos() + 2.0 * t * t - (0.1 - 0.5 * t).exp() * (1.5 * t).sin();
        for t in [0.0, 0.3, 1.7, 4.0] {
            assert!((f.at(t) - value(t)).abs() < PRODUCT);
            assert!((f.from(1.3).at(t - 1.3) - value(t)).abs() < NEAR);
        }
    }

    #[test]
    fn squares_of_sine_and_cosine_cancel() {
        let (s, c) = (Load::sine(7.0, 0.3), Load::cosine(7.0, 0.3));
        let mut one = s.times(&s);
        one.add(&c.times(&c), 1.0);
        assert!((one.as_constant().unwrap() - 1.0).abs() < ROUNDING);
    }

    #[test]
    fn integral_has_the_derivative() {
        let f = Load::time().times(&Load::sine(2.0, 0.5));
        let (g, d) = (f.integral(), 1e-5);
        for t in [0.2, 1.0, 3.0] {
            // central differences: the square of the step, and rounding over it
            assert!(((g.at(t + d) - g.at(t - d)) / (2.0 * d) - f.at(t)).abs() < 1e-9);
        }
    }
}
