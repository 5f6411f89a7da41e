//! Divided differences of the exponential function: the entire functions of linear oscillations.
//!
//! With z0, ..., zm in any order, equal ones allowed, exp_t[z0, ..., zm] is the inverse Laplace transform of 1/((s - z0) ... (s - zm)):
//!
//! ```text
//! exp_t[a] = e^(a t),   exp_t[a, b] = (e^(a t) - e^(b t))/(a - b),   exp_t[a, a] = t e^(a t),   ...
//! ```
//!
//! So exp_t[r1, r2] is the response of x'' + 2 n x' + k² x to a unit impulse, whatever the damping, and exp_t[r1, r2, λ] its response from
//! rest to e^(λ t), also in resonance. No case is a division by zero, because close nodes are summed as a series instead of subtracted.
//! *Source*: A. McCurdy, K. C. Ng, B. N. Parlett, Accurate computation of divided differences of the exponential function, Math. Comp. 43
//! (1984).

use crate::complex::{self, Complex};
use crate::elementary;

/// Nodes within a circle of this diameter (times t) are summed as a series; farther ones are subtracted, which then costs no digits.
const CLOSE: f64 = 1.0;
/// Terms of the series: 1/22! is below the rounding of 1.
const TERMS: usize = 22;

/// exp_t[z0, ..., zm] for t >= 0.
///
/// *Errors*: none; no node gives 0. The cost doubles with each node.
///
/// ```
/// # use algebra::{complex::Complex, divided::exponential};
/// let critical = exponential(&[Complex::from(-10.0); 2], 0.3);
/// assert!((critical.re - 0.3 * (-3.0_f64).exp()).abs() < 1e-17);
/// ```
pub fn exponential(nodes: &[Complex], t: f64) -> Complex {
    let scaled: Vec<Complex> = nodes.iter().map(|z| z.scale(t)).collect();
    let order = nodes.len().saturating_sub(1) as i32;
    difference(&scaled).scale(elementary::powi(t, order))
}

/// exp[w0, ..., wm].
fn difference(w: &[Complex]) -> Complex {
    match w {
        [] => Complex::ZERO,
        [a] => complex::exp(*a),
        _ => {
            let (i, j, distance) = farthest(w);
            if distance <= CLOSE {
                return series(w);
            }
            let without = |k: usize| -> Complex {
                let rest: Vec<Complex> = w.iter().enumerate().filter(|(l, _)| *l != k).map(|(_, z)| *z).collect();
                difference(&rest)
            };
            complex::over(without(j) - without(i), w[i] - w[j])
        }
    }
}

fn farthest(w: &[Complex]) -> (usize, usize, f64) {
    let mut best = (0, 0, 0.0);
    for i in 0..w.len() {
        for j in 0..i {
            let distance = complex::abs(w[i] - w[j]);
            if distance > best.2 {
                best = (i, j, distance);
            }
        }
    }
    best
}

/// e^μ Σ h_k(w - μ)/(k + m)!, h_k the complete homogeneous symmetric polynomials, μ the mean of the nodes.
fn series(w: &[Complex]) -> Complex {
    let mean = w.iter().fold(Complex::ZERO, |s, z| s + *z).scale(1.0 / w.len() as f64);
    // h_k of the nodes so far: h_k(.., d) = h_k(..) + d h_(k-1)(.., d)
    let mut h = [Complex::ZERO; TERMS];
    h[0] = Complex::ONE;
    for z in w {
        let d = *z - mean;
        for k in 1..TERMS {
            h[k] += d * h[k - 1];
        }
    }
    let m = w.len() - 1;
    let mut inverse_factorial = (1..=m).fold(1.0, |f, i| f / i as f64);
    let mut weights = [0.0; TERMS];
    for (k, weight) in weights.iter_mut().enumerate() {
        *weight = inverse_factorial;
        inverse_factorial /= (k + m + 1) as f64;
    }
    // small terms first
    let sum = h.iter().zip(&weights).rev().fold(Complex::ZERO, |s, (h, f)| s + h.scale(*f));
    complex::exp(mean) * sum
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Units of the last place.
    const ROUNDING: f64 = 1e-15;
    /// Arguments that nearly coincide: a series of a dozen terms.
    const CLOSE: f64 = 1e-14;

    fn close(got: Complex, re: f64, im: f64, relative: f64) {
        let size = re.hypot(im);
        assert!(complex::abs(got - Complex::new(re, im)) <= relative * size, "{got:?} instead of {re} + {im} i");
    }

    /// 40-digit values of mpmath (tests/book/truth/transient.py).
    #[test]
    fn near_far_and_equal_nodes() {
        let c = Complex::new;
        close(exponential(&[c(-10.0, 0.0), c(-10.0, 0.0)], 0.7), 0.7 * (-7.0_f64).exp(), 0.0, ROUNDING);
        // sin(k t)/k and the growth in resonance (sin kt - kt cos kt)/(2 k^2)
        let k: f64 = 3.0;
        let impulse = exponential(&[c(0.0, k), c(0.0, -k)], 1.3);
        close(impulse, (k * 1.3).sin() / k, 0.0, ROUNDING);
        let resonant = exponential(&[c(0.0, k), c(0.0, -k), c(0.0, k)], 1.3);
        let x = k * 1.3;
        // response from rest to e^(ikt): t sin(kt)/(2k) - i (kt cos kt - sin kt)/(2 k^2)
        close(resonant, 1.3 * x.sin() / (2.0 * k), (x.sin() - x * x.cos()) / (2.0 * k * k), CLOSE);
        // t^4/24 from four times the node 0
        close(exponential(&[Complex::ZERO; 5], 2.0), 16.0 / 24.0, 0.0, ROUNDING);
    }

    #[test]
    fn threshold_between_series_and_subtraction_is_not_seen() {
        let nodes = |d: f64| [Complex::from(-1.0), Complex::from(-1.0 - d), Complex::new(-1.0 - 0.5 * d, 0.3 * d)];
        let (a, b) = (exponential(&nodes(CLOSE), 1.0), exponential(&nodes(CLOSE * (1.0 + 1e-14)), 1.0));
        assert!(complex::abs(a - b) < CLOSE * complex::abs(a), "{a:?} {b:?}");
    }
}
