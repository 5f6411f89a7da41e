//! Exponents a second way: x = e^(st) p(t) with p of period T, by trigonometric collocation.
//!
//! ```text
//! s p_j = A(t_j) p_j - Σ D_jk p_k,   D_jk = (-1)^(j-k) (ω/2) cot(ω (t_j - t_k)/2),   t_j = j T/N, N even
//! ```
//!
//! No step in time is made, so that the errors of both ways have nothing in common; smooth coefficients give an error that falls faster than any power of 1/N.
//! *Source*: L. N. Trefethen, Spectral Methods in MATLAB, 2000, ch. 3; G. Moore, SIAM J. Numer. Anal. 42 (2005).

use crate::Fault;
use crate::studies::periodic::Multiplier;
use algebra::complex::{self, Complex};
use algebra::eigen::general;
use algebra::elementary;
use algebra::hill::Hill;
use std::f64::consts::TAU;

/// Numbers of instants that are tried, and the largest matrix.
const INSTANTS: [usize; 4] = [16, 32, 64, 128];
const LARGEST: usize = 260;
/// Share of a coefficient up to which its harmonics that the instants do not resolve may reach: multipliers are wanted to as much.
const RESOLVED: f64 = 1e-10;
/// Share of the largest coefficient below which one is rounding of the transform's sums.
const ROUNDING: f64 = 1e-12;
/// Agreement beyond which nothing is gained.
const ENOUGH: f64 = 1e-11;

/// Largest distance of a multiplier from those of the collocation, as a share of the largest multiplier (at least 1); none where the matrix would be too large or the instants
/// do not resolve the coefficients. The coefficients are
/// given at equally spaced instants, a power of two of them.
///
/// *Errors*: an eigenproblem that does not settle.
pub fn by_collocation(period: f64, rows: &[Vec<f64>], multipliers: &[Multiplier]) -> Result<Option<f64>, Fault> {
    let n = rows.first().map_or(0, |a| (a.len() as f64).sqrt().round() as usize);
    let usable = |count: &usize| n > 0 && n * count <= LARGEST && rows.len().is_multiple_of(*count);
    let Some(most) = INSTANTS.into_iter().rev().find(usable) else { return Ok(None) };
    let seen: Vec<Vec<f64>> = rows.iter().step_by(rows.len() / most).cloned().collect();
    if !resolved(period, &seen, n) {
        return Ok(None);
    }
    let size = multipliers.iter().map(Multiplier::abs).fold(1.0, f64::max);
    let mut best: Option<f64> = None;
    for count in INSTANTS.into_iter().filter(|count| *count <= most) {
        let found = of(period, rows, (n, count))?;
        let off = |m: &Multiplier| {
            let value = Complex::new(m.re, m.im);
            found.iter().map(|other| complex::abs(other - value)).fold(f64::INFINITY, f64::min)
        };
        let largest = multipliers.iter().map(off).fold(0.0, f64::max) / size;
        best = Some(best.map_or(largest, |b| b.min(largest)));
        if largest <= ENOUGH {
            break;
        }
    }
    Ok(best)
}

/// Whether the harmonics of all coefficients fade within the instants.
fn resolved(period: f64, rows: &[Vec<f64>], n: usize) -> bool {
    let size = |e: usize| rows.iter().fold(0.0_f64, |l, a| l.max(a[e].abs()));
    let largest = (0..n * n).map(size).fold(0.0, f64::max);
    (0..n * n).filter(|e| size(*e) > ROUNDING * largest).all(|e| {
        let samples: Vec<f64> = rows.iter().map(|a| a[e]).collect();
        Hill::of_samples(period, &samples).and_then(|series| series.faded(RESOLVED)).is_some()
    })
}

/// exp(s T) of all exponents; those of modes that the instants do not resolve are beside the others.
fn of(period: f64, rows: &[Vec<f64>], (n, count): (usize, usize)) -> Result<Vec<Complex>, Fault> {
    let (size, omega, stride) = (n * count, TAU / period, rows.len() / count);
    let mut matrix = vec![0.0; size * size];
    for j in 0..count {
        for k in 0..count {
            let coupled = if j == k { 0.0 } else { derivative(j, k, count) * omega };
            for i in 0..n {
                matrix[(j * n + i) * size + k * n + i] -= coupled;
            }
        }
        for e in 0..n * n {
            matrix[(j * n + e / n) * size + j * n + e % n] += rows[j * stride][e];
        }
    }
    let values = general(size, &matrix)?.values;
    Ok(values.into_iter().map(|s| complex::exp(s.scale(period))).collect())
}

/// The derivative of the trigonometric polynomial that is 1 at instant k and 0 at the others, at instant j, for the period 2π.
fn derivative(j: usize, k: usize, count: usize) -> f64 {
    let half = TAU * (j as f64 - k as f64) / (2.0 * count as f64);
    let sign = if (j + k).is_multiple_of(2) { 0.5 } else { -0.5 };
    sign / elementary::tan(half)
}

#[cfg(test)]
mod tests {
    use super::*;
    use algebra::mathieu::trace;
    use std::f64::consts::PI;

    /// The error that a trace may have.
    const PROMISED: f64 = 1e-10;

    /// Mathieu's equation: the multipliers from the trace by power series against the collocation.
    #[test]
    fn collocation_agrees_with_power_series() {
        for (d, e) in [(0.9, 0.3), (2.0, 0.8), (4.0, 1.5)] {
            let row = |k: usize| vec![0.0, 1.0, -(d - 2.0 * e * elementary::cos(TAU * k as f64 / 64.0)), 0.0];
            let rows: Vec<Vec<f64>> = (0..64).map(row).collect();
            let half = 0.5 * trace(d, e);
            let square = half * half - 1.0;
            let pair = if square < 0.0 {
                [(half, (-square).sqrt()), (half, -(-square).sqrt())]
            } else {
                [(half + square.sqrt(), 0.0), (half - square.sqrt(), 0.0)]
            };
            let multipliers = pair.map(|(re, im)| Multiplier { re, im, ..Multiplier::default() });
            let off = by_collocation(PI, &rows, &multipliers).unwrap().unwrap();
            assert!(off < PROMISED, "{d} {e}: {off:e}");
        }
    }
}
