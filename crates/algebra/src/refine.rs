//! Eigenpairs of K x = lambda M x to the last digits: Newton's correction in the basis of all eigenvectors, residuals in twice the digits.
//!
//! r = K x_i - lambda_i M x_i,  x_i <- x_i - sum over j of x_j (x_j . r) / (lambda_j - lambda_i),  lambda_i = Rayleigh's quotient.
//! *Source*: after T. Ogita, K. Aishima, Iterative refinement for symmetric eigenvalue decomposition, Japan J. Indust. Appl. Math. 35 (2018).

use crate::double::{Double, dot};
use crate::kernels;
use crate::modes::Modes;
use crate::sparse::Sparse;

/// Sum of x_i y_i with y in twice the digits.
fn dot_double(x: &[f64], y: &[Double]) -> Double {
    x.iter().zip(y).fold(Double::default(), |sum, (x, y)| sum.add_times(*x, *y))
}

/// Matrices of frames are mostly zeros, which add nothing in any number of digits.
fn row_products(n: usize, a: &[f64], x: &[f64]) -> Vec<Double> {
    let row = |i: usize| a[i * n..(i + 1) * n].iter().copied().zip(x.iter().copied()).filter(|(a, _)| *a != 0.0);
    (0..n).map(|i| dot(row(i))).collect()
}

/// A pencil of row-major matrices.
#[derive(Clone, Copy)]
pub(super) struct Dense<'a> {
    pub n: usize,
    pub k: &'a [f64],
    pub m: &'a [f64],
}

/// A larger share of another mode than this is no correction: the two eigenvalues are equal within rounding.
const CORRECTION: f64 = 1e-4;

/// Refines the first `count` pairs; `vectors` are all n, one after another, M-orthonormal within rounding.
pub(super) fn refine(pencil: Dense, values: &mut [f64], vectors: &mut [f64], count: usize) {
    for _ in 0..2 {
        for i in 0..count {
            correct(pencil, values, vectors, i);
        }
    }
}

fn correct(pencil: Dense, values: &mut [f64], vectors: &mut [f64], i: usize) {
    let n = pencil.n;
    let own = i * n..(i + 1) * n;
    let (value, residual) = quotient(pencil, &vectors[own.clone()]);
    values[i] = value.round();
    let mut x = vectors[own.clone()].to_vec();
    for j in (0..n).filter(|&j| j != i) {
        let other = &vectors[j * n..(j + 1) * n];
        let gap = values[j] - values[i];
        let share = dot(other.iter().copied().zip(residual.iter().copied())).round() / gap;
        if share.abs() < CORRECTION {
            x.iter_mut().zip(other).for_each(|(x, o)| *x -= share * o);
        }
    }
    let norm = dot_double(&x, &row_products(n, pencil.m, &x)).round();
    if norm > 0.0 && norm.is_finite() {
        let factor = norm.sqrt().recip();
        vectors[own.clone()].iter_mut().zip(&x).for_each(|(v, x)| *v = x * factor);
        values[i] = quotient(pencil, &vectors[own]).0.round();
    }
}

/// Takes out of each of a few eigenvectors the shares of the others that rounding left in it, by the same correction. Where the highest
/// eigenvalue is 10^12 of the lowest, solutions with K leave 1e-11 of the first shape in the fourth.
pub(super) fn sharpen(k: &Sparse, m: &Sparse, modes: &mut Modes) {
    let n = modes.n;
    for i in 0..modes.values.len() {
        let rest = k.defect(m, modes.values[i], modes.shape(i));
        let mut x = modes.shape(i).to_vec();
        for j in (0..modes.values.len()).filter(|j| *j != i) {
            let other = modes.shape(j);
            let share = kernels::dot(other, &rest) / (modes.values[j] - modes.values[i]);
            if share.abs() < CORRECTION {
                x.iter_mut().zip(other).for_each(|(x, o)| *x -= share * o);
            }
        }
        let norm = kernels::dot(&x, &m.product(&x)).sqrt();
        if norm > 0.0 && norm.is_finite() {
            modes.vectors[i * n..(i + 1) * n].iter_mut().zip(&x).for_each(|(v, x)| *v = x / norm);
        }
    }
}

/// Rayleigh's quotient and K x - lambda M x.
fn quotient(pencil: Dense, x: &[f64]) -> (Double, Vec<f64>) {
    let (kx, mx) = (row_products(pencil.n, pencil.k, x), row_products(pencil.n, pencil.m, x));
    let value = dot_double(x, &kx).over(dot_double(x, &mx));
    let rest = |(k, m): (&Double, &Double)| k.add_times(-value.high, *m).add_times(-value.low, *m).round();
    (value, kx.iter().zip(&mx).map(rest).collect())
}
