//! Eigenpairs of a real nonsymmetric matrix to the last digits: Newton's method for (A - lambda) x = 0, x_k = 1, residuals in twice the
//! digits. Pairs of a defective or repeated eigenvalue, at which Newton's matrix is singular, stay as they are.
//! *Source*: J. J. Dongarra, C. B. Moler, J. H. Wilkinson, Improving the accuracy of computed eigenvalues, SIAM J. Numer. Anal. 20 (1983).

use crate::numerics::eigen::Complex;
use crate::numerics::refine::Double;

/// Larger matrices are left alone: each pair costs a factorisation.
pub(super) const LARGEST: usize = 64;

fn minus(a: Complex, b: Complex) -> Complex {
    (a.0 - b.0, a.1 - b.1)
}
fn times(a: Complex, b: Complex) -> Complex {
    (a.0 * b.0 - a.1 * b.1, a.0 * b.1 + a.1 * b.0)
}
fn over(a: Complex, b: Complex) -> Complex {
    let square = b.0 * b.0 + b.1 * b.1;
    ((a.0 * b.0 + a.1 * b.1) / square, (a.1 * b.0 - a.0 * b.1) / square)
}
fn size(a: Complex) -> f64 {
    a.0.hypot(a.1)
}

/// Improves a pair; `x` has its largest entry 1.
pub(super) fn refine(n: usize, a: &[f64], value: &mut Complex, x: &mut [Complex]) {
    let norm = a.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
    for _ in 0..2 {
        let Some(step) = step(n, a, *value, x) else { return };
        let change = size(step[n]);
        let far = step[..n].iter().fold(0.0_f64, |m, d| m.max(size(*d)));
        // what is not small is no rounding error
        if change.is_nan() || change > 1e-6 * size(*value) + 1e-12 * norm || far.is_nan() || far > 1e-4 {
            return;
        }
        *value = minus(*value, step[n]);
        if value.1.abs() < f64::MIN_POSITIVE {
            value.1 = 0.0;
        }
        x.iter_mut().zip(&step).for_each(|(x, d)| *x = minus(*x, *d));
    }
}

/// Solution (dx, dlambda) of (A - lambda) dx - x dlambda = (A - lambda) x, dx_k = 0; none when singular.
fn step(n: usize, a: &[f64], value: Complex, x: &[Complex]) -> Option<Vec<Complex>> {
    let k = (0..n).fold(0, |best, i| if size(x[i]) > size(x[best]) { i } else { best });
    let w = n + 2;
    let mut m = vec![(0.0, 0.0); (n + 1) * w];
    for i in 0..n {
        (0..n).for_each(|j| m[i * w + j] = (a[i * n + j], 0.0));
        m[i * w + i] = minus(m[i * w + i], value);
        m[i * w + n] = (-x[i].0, -x[i].1);
        m[i * w + n + 1] = residual(&a[i * n..(i + 1) * n], value, x, i);
    }
    m[n * w + k] = (1.0, 0.0);
    eliminate(n + 1, &mut m)
}

/// Row i of (A - lambda) x.
fn residual(row: &[f64], value: Complex, x: &[Complex], i: usize) -> Complex {
    let product = |part: fn(&Complex) -> f64| row.iter().zip(x).fold(Double::default(), |sum, (a, x)| sum.add(*a, part(x)));
    let re = product(|x| x.0).add(-value.0, x[i].0).add(value.1, x[i].1);
    let im = product(|x| x.1).add(-value.0, x[i].1).add(-value.1, x[i].0);
    (re.round(), im.round())
}

/// Gauss with exchange of rows on an n x (n + 1) system.
fn eliminate(n: usize, m: &mut [Complex]) -> Option<Vec<Complex>> {
    let w = n + 1;
    for k in 0..n {
        let pivot = (k..n).fold(k, |best, i| if size(m[i * w + k]) > size(m[best * w + k]) { i } else { best });
        (0..w).for_each(|j| m.swap(k * w + j, pivot * w + j));
        if size(m[k * w + k]) == 0.0 {
            return None;
        }
        for i in k + 1..n {
            let factor = over(m[i * w + k], m[k * w + k]);
            if factor != (0.0, 0.0) {
                (k + 1..w).for_each(|j| m[i * w + j] = minus(m[i * w + j], times(factor, m[k * w + j])));
            }
        }
    }
    let mut x = vec![(0.0, 0.0); n];
    for i in (0..n).rev() {
        let known = (i + 1..n).fold((0.0, 0.0), |s: Complex, j| {
            let p = times(m[i * w + j], x[j]);
            (s.0 + p.0, s.1 + p.1)
        });
        x[i] = over(minus(m[i * w + n], known), m[i * w + i]);
    }
    Some(x)
}
