//! Eigenpairs of a real nonsymmetric matrix to the last digits: Newton's method for (A - lambda) x = 0, x_k = 1, residuals in twice the
//! digits. Pairs of a defective or repeated eigenvalue, at which Newton's matrix is singular, stay as they are.
//! *Source*: J. J. Dongarra, C. B. Moler, J. H. Wilkinson, Improving the accuracy of computed eigenvalues, SIAM J. Numer. Anal. 20 (1983).

use crate::complex::{self, Complex};
use crate::double::Double;
use crate::lu::Lu;

/// Larger matrices are left alone: each pair costs a factorisation.
pub(super) const LARGEST: usize = 64;

/// Improves a pair; `x` has its largest entry 1.
pub(super) fn refine(n: usize, a: &[f64], value: &mut Complex, x: &mut [Complex]) {
    let norm = a.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
    for _ in 0..2 {
        let Some(step) = step(n, a, *value, x) else { return };
        let change = complex::abs(step[n]);
        let far = step[..n].iter().fold(0.0_f64, |m, d| m.max(complex::abs(*d)));
        // what is not small is no rounding error
        if change.is_nan() || change > 1e-6 * complex::abs(*value) + 1e-12 * norm || far.is_nan() || far > 1e-4 {
            return;
        }
        *value -= step[n];
        if value.im.abs() < f64::MIN_POSITIVE {
            value.im = 0.0;
        }
        x.iter_mut().zip(&step).for_each(|(x, d)| *x -= *d);
    }
}

/// Solution (dx, dlambda) of (A - lambda) dx - x dlambda = (A - lambda) x, dx_k = 0; none when singular.
fn step(n: usize, a: &[f64], value: Complex, x: &[Complex]) -> Option<Vec<Complex>> {
    let k = (0..n).fold(0, |best, i| if complex::abs(x[i]) > complex::abs(x[best]) { i } else { best });
    let w = n + 1;
    let mut matrix = vec![Complex::ZERO; w * w];
    for i in 0..n {
        (0..n).for_each(|j| matrix[i * w + j] = Complex::from(a[i * n + j]));
        matrix[i * w + i] -= value;
        matrix[i * w + n] = -x[i];
    }
    matrix[n * w + k] = Complex::ONE;
    let mut right: Vec<Complex> = (0..n).map(|i| residual(&a[i * n..(i + 1) * n], value, x, i)).collect();
    right.push(Complex::ZERO);
    Lu::exact(&matrix, w)?.solve(&right)
}

/// Row i of (A - lambda) x.
fn residual(row: &[f64], value: Complex, x: &[Complex], i: usize) -> Complex {
    let product = |part: fn(&Complex) -> f64| row.iter().zip(x).fold(Double::default(), |sum, (a, x)| sum.add(*a, part(x)));
    let re = product(|x| x.re).add(-value.re, x[i].re).add(value.im, x[i].im);
    let im = product(|x| x.im).add(-value.re, x[i].im).add(-value.im, x[i].re);
    Complex::new(re.round(), im.round())
}
