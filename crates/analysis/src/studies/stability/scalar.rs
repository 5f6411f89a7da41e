//! Hill's equation of one degree of freedom, and what it is called in Mathieu's form.
//!
//! Mathieu's equation takes the middle of ψ and its depth (least and greatest value), as if ψ had one harmonic:
//!
//! ```text
//! ψ ≈ ψ₀ (1 - μ cos ωt),   ψ₀ = (ψ_max + ψ_min)/2,   μ = (ψ_max - ψ_min)/(ψ_max + ψ_min)
//! y'' + (d - 2 e cos 2τ) y = 0,   τ = ωt/2,   d = 4 ψ₀/ω²,   e = μ d/2 = (ψ_max - ψ_min)/ω²
//! ```
//!
//! Damping h of the original is taken out by q = y exp(-∫h dt): disturbances grow where those of y grow faster than exp(η τ), η = 2 h̄/ω. To first
//! order in e they do in the main tongue where e² > (1 - d)² + 4 η², and below d = -e²/2 (Kapitza). *Source*: V. V. Bolotin, The Dynamic Stability of Elastic Systems, 1964, § 5, § 9.

use super::diagram::TRACE;
use super::floquet::{UNDAMPED, Verdict};
use algebra::elementary;
use algebra::hill::Hill;
use algebra::mathieu;
use std::f64::consts::{PI, TAU};

/// Share of its largest harmonic up to which the samples of a coefficient are rounding.
const ROUNDING: f64 = 1e-11;

/// y'' + ψ(t) y = 0 with q = y exp(-∫h dt).
#[derive(Clone, Debug, PartialEq)]
pub struct Scalar {
    /// ψ over its least period.
    pub hill: Hill,
    /// How many of these the given period holds.
    pub parts: usize,
    /// Mean of h, 1/s.
    pub decay: f64,
    /// ψ_min, ψ_max.
    pub extremes: [f64; 2],
    /// Entries of the monodromy matrix of y over the least period, and its determinant.
    trace: f64,
    /// 1 by Liouville.
    determinant: f64,
}

/// Which equation gives a verdict.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Criterion {
    /// The main tongue to first order, e² > (1 - d)² + 4η²; for a falling average -d > e²/2.
    Classical,
    /// Mathieu's equation with d and e.
    Mathieu,
    /// Hill's equation itself.
    Hill,
}

impl Criterion {
    /// All, the roughest first.
    pub const ALL: [Criterion; 3] = [Criterion::Classical, Criterion::Mathieu, Criterion::Hill];
    /// Name in files.
    pub fn key(self) -> &'static str {
        match self {
            Criterion::Classical => "classical",
            Criterion::Mathieu => "mathieu",
            Criterion::Hill => "hill",
        }
    }
}

impl Scalar {
    /// From k(t) and h(t), functions of a period; none where one of them jumps or has no value.
    pub fn of(period: f64, mut stiffness: impl FnMut(f64) -> Option<f64>, mut decay: impl FnMut(f64) -> Option<f64>) -> Option<Scalar> {
        let h = Hill::of(period, &mut decay)?;
        let psi = Hill::of(period, |t| {
            let now = h.value(t);
            stiffness(t).map(|k| k - now * now - h.slope(t))
        })?;
        let count = 8 * (h.waves.len() + 1);
        let size = (0..count).map(|i| h.value(period * i as f64 / count as f64).abs()).sum::<f64>() / count as f64;
        Some(Scalar::new(psi, mean_of(h.mean, size, period)))
    }

    /// From the coefficients of x' = A(t) x at equally spaced instants of a period, x = (q, q'); none where they are not of that form, or jump.
    pub fn of_coefficients(period: f64, rows: &[Vec<f64>]) -> Option<Scalar> {
        Scalar::without(ROUNDING, period, rows)
    }

    /// The same with the share of the largest harmonic up to which others are rounding.
    pub(super) fn without(rounding: f64, period: f64, rows: &[Vec<f64>]) -> Option<Scalar> {
        let form = |a: &Vec<f64>| a.len() == 4 && a[0] == 0.0 && a[1] == 1.0;
        if rows.is_empty() || !rows.iter().all(form) {
            return None;
        }
        let halves: Vec<f64> = rows.iter().map(|a| -0.5 * a[3]).collect();
        let h = Hill::of_samples(period, &halves)?.faded(rounding)?;
        let time = |i: usize| period * i as f64 / rows.len() as f64;
        let value = |(i, a): (usize, &Vec<f64>)| {
            let now = h.value(time(i));
            -a[2] - now * now - h.slope(time(i))
        };
        let samples: Vec<f64> = rows.iter().enumerate().map(value).collect();
        let size = halves.iter().map(|h| h.abs()).sum::<f64>() / halves.len() as f64;
        Some(Scalar::new(Hill::of_samples(period, &samples)?.faded(rounding)?, mean_of(h.mean, size, period)))
    }

    fn new(psi: Hill, decay: f64) -> Scalar {
        let (hill, parts) = psi.least();
        let whole = hill.monodromy();
        let largest = whole.entries.iter().fold(1.0_f64, |l, v| l.max(v.abs()));
        let determinant = 1.0 + (whole.determinant() - 1.0) / (largest * largest);
        Scalar { extremes: hill.extremes(), trace: whole.trace(), determinant, hill, parts, decay }
    }

    /// ω, rad/s.
    pub fn frequency(&self) -> f64 {
        TAU / self.hill.period
    }
    /// d.
    pub fn d(&self) -> f64 {
        2.0 * (self.extremes[0] + self.extremes[1]) / (self.frequency() * self.frequency())
    }
    /// e.
    pub fn e(&self) -> f64 {
        (self.extremes[1] - self.extremes[0]) / (self.frequency() * self.frequency())
    }
    /// μ; none where the middle of ψ is not positive.
    pub fn depth(&self) -> Option<f64> {
        let [low, high] = self.extremes;
        (low + high > 0.0).then(|| (high - low) / (high + low))
    }
    /// η.
    pub fn eta(&self) -> f64 {
        2.0 * self.decay / self.frequency()
    }
    /// Trace of the monodromy matrix of y over the least period.
    pub fn trace(&self) -> f64 {
        self.trace
    }
    /// Difference of the determinant from 1, as a share of what entries of this size can make.
    pub fn liouville(&self) -> f64 {
        (self.determinant - 1.0).abs()
    }
    /// Trace of Mathieu's equation over π.
    pub fn trace_of_mathieu(&self) -> f64 {
        mathieu::trace(self.d(), self.e())
    }
    /// The multipliers of q over the least period as [re, im], from the trace alone.
    pub fn multipliers(&self) -> [[f64; 2]; 2] {
        let shrink = elementary::exp(-self.decay * self.hill.period);
        let half = 0.5 * self.trace;
        let square = half * half - 1.0;
        if square < 0.0 {
            let im = (-square).sqrt();
            return [[shrink * half, shrink * im], [shrink * half, -shrink * im]];
        }
        let large = if half < 0.0 { half - square.sqrt() } else { half + square.sqrt() };
        [[shrink * large, 0.0], [shrink / large, 0.0]]
    }
    /// Amplitudes of the harmonics of ψ as shares of its middle.
    pub fn harmonics(&self) -> Vec<f64> {
        let middle = 0.5 * (self.extremes[0] + self.extremes[1]).abs();
        self.hill.waves.iter().map(|[c, s]| elementary::hypot(*c, *s) / middle.max(f64::MIN_POSITIVE)).collect()
    }

    /// Positive where disturbances grow, negative where they do not: -η where damping is negative, for the product of the multipliers is then larger than 1.
    pub fn excess(&self, by: Criterion) -> f64 {
        let (d, e, eta) = (self.d(), self.e(), self.eta());
        match by {
            _ if eta < 0.0 => -eta,
            Criterion::Hill => self.trace.abs() - 2.0 * elementary::cosh(PI * eta),
            Criterion::Mathieu => self.trace_of_mathieu().abs() - 2.0 * elementary::cosh(PI * eta),
            Criterion::Classical => (e * e - (1.0 - d) * (1.0 - d) - 4.0 * eta * eta).max(-d - 0.5 * e * e),
        }
    }

    /// Where disturbances grow, the number of the tongue: zeros of the growing solution in the least period.
    pub fn tongue(&self) -> Option<usize> {
        if self.verdict(Criterion::Hill) == Verdict::Unstable { self.hill.tongue() } else { None }
    }

    /// The verdict.
    pub fn verdict(&self, by: Criterion) -> Verdict {
        if self.decay < 0.0 {
            // the product of the multipliers is larger than 1
            return Verdict::Unstable;
        }
        let error = match by {
            Criterion::Hill => return Verdict::of_trace([self.trace, self.decay * self.hill.period]),
            Criterion::Mathieu => TRACE * self.trace_of_mathieu().abs().max(1.0),
            // a formula of two coefficients: some ten units of the last place
            Criterion::Classical => 1e-14,
        };
        Verdict::of_excess(self.excess(by), error)
    }
}

/// A mean of the damping; none of it where it is rounding: of samples of this mean size, or of multipliers that it leaves on the circle.
fn mean_of(mean: f64, size: f64, period: f64) -> f64 {
    if mean.abs() <= ROUNDING * size || mean.abs() * period <= UNDAMPED { 0.0 } else { mean }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Some hundred roundings of numbers about 1.
    const EXACT: f64 = 1e-13;
    /// What roundings become in the steps of a period, or in the matrix of a collocation.
    const STEPS: f64 = 1e-11;

    fn mathieu(d: f64, e: f64, eta: f64) -> Scalar {
        // τ = t: ω = 2
        Scalar::of(PI, |t| Some(d + eta * eta - 2.0 * e * elementary::cos(2.0 * t)), |_| Some(eta)).unwrap()
    }

    #[test]
    fn one_harmonic_is_mathieus_equation_itself() {
        for (d, e) in [(0.9, 0.3), (4.1, 1.2), (-0.2, 0.9), (2.2, 0.1)] {
            let found = mathieu(d, e, 0.0);
            assert!((found.d() - d).abs() < EXACT && (found.e() - e).abs() < EXACT, "{d} {e}");
            assert!((found.trace() - found.trace_of_mathieu()).abs() < STEPS, "{d} {e}");
            assert_eq!(found.verdict(Criterion::Hill), found.verdict(Criterion::Mathieu));
            assert!(found.liouville() < EXACT);
        }
    }

    /// The classical criterion is (1 - d)², not 1 - d²: the equation is unstable at d = 1 and stable at d = 0.9, e = 0.05.
    #[test]
    fn the_main_tongue_lies_about_one() {
        for (d, e, verdict) in [(1.0, 0.1, Verdict::Unstable), (0.9, 0.05, Verdict::Stable), (1.2, 0.1, Verdict::Stable)] {
            let found = mathieu(d, e, 0.0);
            Criterion::ALL.iter().for_each(|by| assert_eq!(found.verdict(*by), verdict, "{d} {e} {by:?}"));
        }
    }

    /// Damping lifts the tongue: first order 2η = e at d = 1 (Hill's form), the next term is of order e³.
    #[test]
    fn damped_tongues_begin_at_twice_the_damping() {
        for eta in [0.005, 0.01] {
            assert_eq!(mathieu(1.0, 2.0 * eta + 1e-4, eta).verdict(Criterion::Hill), Verdict::Unstable);
            assert_eq!(mathieu(1.0, 2.0 * eta - 1e-4, eta).verdict(Criterion::Hill), Verdict::Stable);
        }
        assert_eq!(mathieu(1.0, 0.0, -0.1).verdict(Criterion::Mathieu), Verdict::Unstable);
    }

    /// A damping that varies, h = h₀ + h₁ cos 2t, is taken out exactly: det = exp(-2∫h), and with k = h² + h' + k₀ the rest is free oscillation.
    #[test]
    fn varying_damping_is_taken_out() {
        let (h0, h1, k0) = (0.1, 0.4, 1.7);
        let h = |t: f64| h0 + h1 * elementary::cos(2.0 * t);
        let slope = |t: f64| -2.0 * h1 * elementary::sin(2.0 * t);
        let found = Scalar::of(PI, |t| Some(h(t) * h(t) + slope(t) + k0), |t| Some(h(t))).unwrap();
        assert!((found.trace() - 2.0 * elementary::cos(PI * k0.sqrt())).abs() < STEPS, "{}", found.trace());
        assert!((found.decay - h0).abs() < EXACT);
        let [a, b] = found.multipliers();
        let product = a[0] * b[0] - a[1] * b[1];
        assert!((product - elementary::exp(-2.0 * h0 * found.hill.period)).abs() < EXACT);
    }

    /// h = h₁ sin 2t has no mean, whatever its samples sum to: with k = h² + h' + k₀ the multipliers are exp(±i√k₀ T), simple on the circle.
    #[test]
    fn damping_without_a_mean_is_none() {
        for (h1, k0) in [(0.3, 2.3), (1e-6, 2.3), (4.0, 0.7)] {
            let h = |t: f64| h1 * elementary::sin(2.0 * t + 0.4);
            let slope = |t: f64| 2.0 * h1 * elementary::cos(2.0 * t + 0.4);
            let stiffness = |t: f64| h(t) * h(t) + slope(t) + k0;
            let by_formula = Scalar::of(PI, |t| Some(stiffness(t)), |t| Some(h(t))).unwrap();
            let row = |k: usize| {
                let t = PI * k as f64 / 256.0;
                vec![0.0, 1.0, -stiffness(t), -2.0 * h(t)]
            };
            let by_samples = Scalar::of_coefficients(PI, &(0..256).map(row).collect::<Vec<_>>()).unwrap();
            for found in [by_formula, by_samples] {
                assert!(found.decay == 0.0 && found.verdict(Criterion::Hill) == Verdict::Stable, "{h1}: {}", found.decay);
                assert!(
                    (found.excess(Criterion::Hill) - (2.0 * elementary::cos(found.hill.period * f64::sqrt(k0))).abs() + 2.0).abs() < STEPS
                );
            }
            let negative = Scalar::of(PI, |t| Some(stiffness(t)), |t| Some(h(t) - 1e-6)).unwrap();
            assert_eq!(negative.verdict(Criterion::Hill), Verdict::Unstable);
            assert!((negative.excess(Criterion::Hill) - 1e-6).abs() < EXACT, "η of ω = 2 is h");
        }
    }

    #[test]
    fn a_multiple_of_the_period_is_noticed() {
        let found = Scalar::of(3.0 * PI, |t| Some(0.9 - 0.6 * elementary::cos(2.0 * t)), |_| Some(0.0)).unwrap();
        assert!(found.parts == 3 && (found.d() - 0.9).abs() < EXACT && (found.e() - 0.3).abs() < EXACT);
        assert!((found.trace() - -2.2126726193010466).abs() < STEPS);
    }
}
