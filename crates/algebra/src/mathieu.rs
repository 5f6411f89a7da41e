//! Mathieu's equation y'' + (a - 2 q cos 2τ) y = 0: characteristic values, and the trace of its monodromy matrix over the period π.
//!
//! A solution of period π or 2π is a Fourier series whose coefficients obey three-term recurrences, so that the characteristic values are the
//! eigenvalues of symmetric tridiagonal matrices:
//!
//! ```text
//! a_2n      diagonal 0, 4, 16, ...      beside it √2 q, q, q, ...      even, period π
//! a_2n+1    diagonal 1 + q, 9, 25, ...  beside it q, q, ...            even, period 2π
//! b_2n+1    diagonal 1 - q, 9, 25, ...  beside it q, q, ...            odd,  period 2π
//! b_2n+2    diagonal 4, 16, 36, ...     beside it q, q, ...            odd,  period π
//! ```
//!
//! The trace comes from power series in s = sin² τ about τ = 0 and about τ = π/2, where the sign of q is the other one. Both have three terms too, and
//! meet at τ = π/4 (s = 1/2, half of the radius of convergence):
//!
//! ```text
//! even  (2k+1)(2k+2) c_(k+1) = (4k² - a + 2q) c_k - 4q c_(k-1)               y = Σ c_k s^k
//! odd   (2k+2)(2k+3) c_(k+1) = ((2k+1)² - a + 2q) c_k - 4q c_(k-1)           y = √s Σ c_k s^k
//! trace = 2 (2 y₁(π/2) y₂'(π/2) - 1)
//! ```
//!
//! *Source*: N. W. McLachlan, Theory and Application of Mathieu Functions, 1947, 2.10-2.14, 3.10, 4.14; DLMF 28.4, 28.2(iii).

use crate::elementary;
use crate::hill::Hill;
use std::f64::consts::PI;

/// Which solutions have the period π or 2π.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Parity {
    /// a_n, n = 0, 1, 2, ...
    Even,
    /// b_n, n = 1, 2, 3, ...
    Odd,
}

/// Rows beyond those in which a function of this order and parameter lives.
const MARGIN: f64 = 40.0;
/// Terms of the power series: at s = 1/2 the last ones are below 2⁻⁵³ of the largest.
const TERMS: usize = 72;
/// |a| + 2|q| up to which the power series keep 1e-11: their terms grow like exp(0.9 √(|a| + 2|q|)).
const SERIES: f64 = 90.0;
/// Largest |q| and order whose matrix is built.
const LARGEST: f64 = 1e10;

/// Diagonal and off-diagonal of the matrix, and the index of the eigenvalue counted from below.
fn matrix(parity: Parity, n: usize, q: f64) -> (Vec<f64>, Vec<f64>, usize) {
    let odd = n % 2 == 1;
    // where 4 r² exceeds the largest of a and 2 q, the coefficients fall faster than any power
    let rows = (0.5 * n as f64 + 2.0 * q.abs().sqrt().min(2.0 * q.abs()) + MARGIN).ceil() as usize;
    let first = match (parity, odd) {
        (Parity::Even, false) => 0,
        (_, true) => 1,
        (Parity::Odd, false) => 2,
    };
    let mut diagonal: Vec<f64> = (0..rows).map(|r| (2 * r + first) as f64).map(|m| m * m).collect();
    let mut beside = vec![q; rows - 1];
    match (parity, odd) {
        (Parity::Even, true) => diagonal[0] += q,
        (Parity::Odd, true) => diagonal[0] -= q,
        (Parity::Even, false) => beside[0] *= std::f64::consts::SQRT_2,
        (Parity::Odd, false) => {}
    }
    (diagonal, beside, (n - first.min(n)) / 2)
}

/// How many eigenvalues lie below x. *Source*: W. Barth, R. S. Martin, J. H. Wilkinson, Numer. Math. 9 (1967).
fn below(diagonal: &[f64], beside: &[f64], x: f64) -> usize {
    let (mut count, mut pivot) = (0, 1.0_f64);
    for (i, d) in diagonal.iter().enumerate() {
        let coupled = if i == 0 { 0.0 } else { beside[i - 1] * (beside[i - 1] / pivot) };
        pivot = d - x - coupled;
        if pivot == 0.0 {
            pivot = f64::MIN_POSITIVE;
        }
        count += usize::from(pivot < 0.0);
    }
    count
}

/// The characteristic value a_n(q) or b_n(q); none for b₀, which there is not, and for |q| or n above 10¹⁰.
///
/// By bisection on Sturm's count, which sees every entry of the matrix to its own rounding; the error is some units of the last place of max(|q|, n²).
pub fn characteristic(parity: Parity, n: usize, q: f64) -> Option<f64> {
    if (parity == Parity::Odd && n == 0) || q.is_nan() || q.abs() > LARGEST || n as f64 > LARGEST.sqrt() {
        return None;
    }
    let (diagonal, beside, index) = matrix(parity, n, q);
    let mut low = -2.0 * q.abs() - 1.0;
    let mut high = (n * n) as f64 + 2.0 * q.abs() + 1.0;
    // halving ends where no number lies between
    loop {
        let middle = 0.5 * (low + high);
        if middle <= low || middle >= high {
            return Some(middle);
        }
        if below(&diagonal, &beside, middle) > index { high = middle } else { low = middle }
    }
}

/// Value and derivative by τ at τ = π/4 of the even and of the odd solution about τ = 0 (values 1, 0 and 0, 1 there).
fn quarter(a: f64, q: f64) -> [f64; 4] {
    let (shifted, coupled) = (a - 2.0 * q, 4.0 * q);
    let (mut even, mut even_rate, mut odd, mut odd_rate) = (0.0, 0.0, 0.0, 0.0);
    // terms c_k s^k and those before them, all at s = 1/2
    let (mut c, mut c_before, mut o, mut o_before) = (1.0, 0.0, 1.0, 0.0);
    for k in 0..TERMS {
        let k = k as f64;
        even += c;
        // dy/dτ = y'(s) sin 2τ, and sin 2τ = 1
        even_rate += 2.0 * k * c;
        odd += o;
        odd_rate += (2.0 * k + 1.0) * o;
        let next = (0.5 * (4.0 * k * k - shifted) * c - 0.25 * coupled * c_before) / ((2.0 * k + 1.0) * (2.0 * k + 2.0));
        (c_before, c) = (c, next);
        let m = 2.0 * k + 1.0;
        let next = (0.5 * (m * m - shifted) * o - 0.25 * coupled * o_before) / ((m + 1.0) * (m + 2.0));
        (o_before, o) = (o, next);
    }
    let root = std::f64::consts::FRAC_1_SQRT_2;
    [even, even_rate, root * odd, root * odd_rate]
}

/// Trace of the monodromy matrix over the period π: 2 cos πν; stable below 2 in magnitude.
///
/// The error is at most 1e-10, or 1e-12 of the largest entry of the matrix where that is larger (|a|, |q| up to some thousands).
pub fn trace(a: f64, q: f64) -> f64 {
    if a.abs() + 2.0 * q.abs() > SERIES {
        return Hill { period: PI, mean: a, waves: vec![[-2.0 * q, 0.0]] }.monodromy().trace();
    }
    let [u1, r1, u2, r2] = quarter(a, q);
    let [v1, w1, v2, w2] = quarter(a, -q);
    2.0 * (2.0 * (w2 * u1 + v2 * r1) * (w1 * u2 + v1 * r2) - 1.0)
}

/// The exponent μ + iν of a solution e^((μ + iν) τ) p(τ), p of period π: growth and frequency in [0, 1], from a trace over the period π.
pub fn exponent(trace: f64) -> [f64; 2] {
    let half = 0.5 * trace;
    if half.abs() <= 1.0 {
        return [0.0, elementary::acos(half) / PI];
    }
    [elementary::acosh(half.abs()) / PI, if half > 0.0 { 0.0 } else { 1.0 }]
}

#[cfg(test)]
mod truth;

#[cfg(test)]
mod tests {
    use super::truth::{TRACES, VALUES};
    use super::*;
    use Parity::{Even, Odd};

    /// Some hundred roundings of numbers about 1.
    const EXACT: f64 = 1e-13;
    /// What roundings become in the steps of a period, or in the matrix of a collocation.
    const STEPS: f64 = 1e-11;
    /// The error that a trace may have.
    const PROMISED: f64 = 1e-10;

    #[test]
    fn characteristic_values_agree_with_forty_digits() {
        for &(letter, n, q, value) in VALUES {
            let parity = if letter == 'a' { Even } else { Odd };
            let found = characteristic(parity, n, q).unwrap();
            // 1e-12 wherever a machine number holds it
            let allowed = 1e-12_f64.max(4.0 * f64::EPSILON * (2.0 * q.abs()).max((n * n) as f64));
            assert!((found - value).abs() <= allowed, "{parity:?}{n}({q}) = {found}, should be {value}: {:e}", found - value);
        }
    }

    /// DLMF 28.2.20: a₀ < b₁ < a₁ < b₂ < a₂ < ... for q > 0. Neighbours come nearer than a rounding where q is large.
    #[test]
    fn characteristic_values_are_ordered() {
        for q in [0.01, 0.7, 5.0, 25.0, 300.0, 1e4] {
            let mut before = characteristic(Even, 0, q).unwrap();
            for n in 1..=20 {
                for parity in [Odd, Even] {
                    let value = characteristic(parity, n, q).unwrap();
                    assert!(value > before - 1e-11 * q.max(1.0), "{parity:?}{n}({q}) = {value} after {before}");
                    before = value;
                }
            }
        }
    }

    /// DLMF 28.2.26-28.2.29: a_n(-q) = a_n(q) and b_n(-q) = b_n(q) for even n, a_n(-q) = b_n(q) for odd n.
    #[test]
    fn negative_parameters_mirror_positive_ones() {
        for q in [0.3, 4.0, 77.0] {
            for n in 1..8 {
                let value = |parity, q| characteristic(parity, n, q).unwrap();
                let other = if n % 2 == 0 { Even } else { Odd };
                assert_eq!(value(Even, -q).to_bits(), value(other, q).to_bits(), "a_{n}(-{q})");
            }
        }
        assert_eq!(characteristic(Odd, 0, 1.0), None);
    }

    /// DLMF 28.8.1: a_m(q), b_(m+1)(q) ~ -2h² + 2sh - (s² + 1)/8 - (s³ + 3s)/(2⁷ h) - ..., h = √q, s = 2m + 1; the next term is of order h⁻².
    #[test]
    fn large_parameters_approach_the_asymptotic_series() {
        for (m, q) in [(0_usize, 1e4_f64), (3, 1e4), (5, 1e6), (1, 1e8)] {
            let (h, s) = (q.sqrt(), (2 * m + 1) as f64);
            let series = -2.0 * h * h + 2.0 * s * h - (s * s + 1.0) / 8.0 - (s * s * s + 3.0 * s) / (128.0 * h);
            let next = (5.0 * s.powi(4) + 34.0 * s * s + 9.0) / (4096.0 * h * h);
            for value in [characteristic(Even, m, q).unwrap(), characteristic(Odd, m + 1, q).unwrap()] {
                let rest = value - series;
                assert!((rest + next).abs() <= 0.1 * next + 1e-15 * q * 8.0, "m = {m}, q = {q}: {rest:e} beside {:e}", -next);
            }
        }
    }

    /// On the characteristic curves a multiplier is +1 or -1: the trace is 2 for even n and -2 for odd n.
    #[test]
    fn the_trace_is_two_on_characteristic_curves() {
        for q in [0.0, 0.4, 3.0, 12.0, 30.0] {
            for n in 0..6 {
                for parity in [Even, Odd] {
                    let Some(a) = characteristic(parity, n, q) else { continue };
                    let found = trace(a, q);
                    let should = if n % 2 == 0 { 2.0 } else { -2.0 };
                    // the slope of the trace times the rounding of a
                    let slope = ((trace(a + 1e-6, q) - trace(a - 1e-6, q)) / 2e-6).abs();
                    assert!((found - should).abs() <= PROMISED + 1e-14 * slope * q.max(1.0), "{parity:?}{n}({q}): {found}");
                }
            }
        }
    }

    /// Two ways: the power series against Taylor steps of Hill's equation; and the closed form 2 cos π√a at q = 0.
    #[test]
    fn power_series_agree_with_taylor_steps() {
        let mut random = crate::random::Random::new(3);
        for _ in 0..400 {
            let (a, q) = (random.between(-8.0, 45.0), random.between(-20.0, 20.0));
            let (series, whole) = (trace(a, q), Hill { period: PI, mean: a, waves: vec![[-2.0 * q, 0.0]] }.monodromy());
            assert!(
                (series - whole.trace()).abs() <= PROMISED * (1.0 + whole.trace().abs()),
                "a = {a}, q = {q}: {series} {}",
                whole.trace()
            );
            let largest = whole.entries.iter().fold(1.0_f64, |l, v| l.max(v.abs()));
            assert!((whole.determinant() - 1.0).abs() <= STEPS * largest * largest, "a = {a}, q = {q}: {}", whole.determinant());
        }
        for a in [0.25, 3.0, 49.5, 200.0] {
            assert!((trace(a, 0.0) - 2.0 * elementary::cos(PI * elementary::pow(a, 0.5))).abs() < STEPS, "{a}");
        }
    }

    #[test]
    fn traces_agree_with_fifty_digits() {
        for &(a, q, value) in TRACES {
            let found = trace(a, q);
            assert!((found - value).abs() <= PROMISED.max(1e-13 * value.abs()), "a = {a}, q = {q}: {found}, should be {value}");
        }
    }

    #[test]
    fn exponents_of_free_oscillation() {
        let [growth, frequency] = exponent(trace(0.36, 0.0));
        assert!(growth == 0.0 && (frequency - 0.6).abs() < EXACT);
        let [growth, frequency] = exponent(trace(-0.25, 0.0));
        assert!((growth - 0.5).abs() < EXACT && frequency == 0.0);
    }
}
