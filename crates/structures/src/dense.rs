//! Dense linear algebra over a field: small exact problems, and small problems in machine numbers.

use crate::Scalar;

/// A X = B for a square A (row by row) and the columns of B (n rows, any number of columns, row by row); none when A is singular.
pub fn solve<S: Scalar>(a: &[S], n: usize, b: &[S], columns: usize) -> Option<Vec<S>> {
    let (mut a, mut b) = (a.to_vec(), b.to_vec());
    let scale: Vec<f64> = (0..n).map(|i| a[i * n..(i + 1) * n].iter().fold(0.0_f64, |m, v| m.max(v.size()))).collect();
    for k in 0..n {
        let size = |a: &[S], i: usize| a[i * n + k].size() / scale[i].max(f64::MIN_POSITIVE);
        let p = (k..n).max_by(|i, j| size(&a, *i).total_cmp(&size(&a, *j)))?;
        if a[p * n + k].gives_way(scale[p]) || a[p * n + k].is_zero() {
            return None;
        }
        if p != k {
            (0..n).for_each(|j| a.swap(k * n + j, p * n + j));
            (0..columns).for_each(|j| b.swap(k * columns + j, p * columns + j));
        }
        let pivot = a[k * n + k].clone();
        for i in k + 1..n {
            if a[i * n + k].is_zero() {
                continue;
            }
            let factor = a[i * n + k].div(&pivot);
            for j in k..n {
                a[i * n + j] = a[i * n + j].sub(&factor.mul(&a[k * n + j]));
            }
            for j in 0..columns {
                b[i * columns + j] = b[i * columns + j].sub(&factor.mul(&b[k * columns + j]));
            }
        }
    }
    for k in (0..n).rev() {
        for j in 0..columns {
            let mut sum = b[k * columns + j].clone();
            for i in k + 1..n {
                sum = sum.sub(&a[k * n + i].mul(&b[i * columns + j]));
            }
            b[k * columns + j] = sum.div(&a[k * n + k]);
        }
    }
    Some(b)
}

/// The identity.
pub fn identity<S: Scalar>(n: usize) -> Vec<S> {
    (0..n * n).map(|k| if k / n == k % n { S::one() } else { S::zero() }).collect()
}

/// A (m x k) times B (k x n).
pub fn product<S: Scalar>(a: &[S], b: &[S], m: usize, k: usize, n: usize) -> Vec<S> {
    let mut out = vec![S::zero(); m * n];
    for i in 0..m {
        for p in 0..k {
            let factor = &a[i * k + p];
            if factor.is_zero() {
                continue;
            }
            for j in 0..n {
                out[i * n + j] = out[i * n + j].add(&factor.mul(&b[p * n + j]));
            }
        }
    }
    out
}

/// Transpose of an m x n matrix.
pub fn transpose<S: Scalar>(a: &[S], m: usize, n: usize) -> Vec<S> {
    (0..m * n).map(|k| a[(k % m) * n + k / m].clone()).collect()
}

/// Bᵀ A B for A of n x n and B of n x m.
pub fn congruence<S: Scalar>(a: &[S], b: &[S], n: usize, m: usize) -> Vec<S> {
    product(&transpose(b, n, m), &product(a, b, n, n, m), m, n, m)
}

/// Directions v with A v = 0 for a symmetric positive semidefinite A, by elimination with the largest remaining diagonal as pivot.
pub fn null_space<S: Scalar>(a: &[S], n: usize) -> Vec<Vec<S>> {
    let mut a = a.to_vec();
    let original: Vec<f64> = (0..n).map(|i| a[i * n + i].size()).collect();
    let mut left: Vec<usize> = (0..n).collect();
    let mut done: Vec<usize> = Vec::new();
    loop {
        let relative = |i: usize| if original[i] > 0.0 { a[i * n + i].size() / original[i] } else { 0.0 };
        let Some(&k) = left.iter().max_by(|i, j| relative(**i).total_cmp(&relative(**j))) else { break };
        if a[k * n + k].gives_way(original[k]) {
            break;
        }
        left.retain(|i| *i != k);
        let pivot = a[k * n + k].clone();
        for j in 0..n {
            a[k * n + j] = a[k * n + j].div(&pivot);
        }
        for i in (0..n).filter(|i| *i != k) {
            let factor = a[i * n + k].clone();
            if !factor.is_zero() {
                for j in 0..n {
                    a[i * n + j] = a[i * n + j].sub(&factor.mul(&a[k * n + j]));
                }
            }
        }
        done.push(k);
    }
    let direction = |free: &usize| {
        let mut v = vec![S::zero(); n];
        v[*free] = S::one();
        done.iter().for_each(|k| v[*k] = a[k * n + free].neg());
        v
    };
    left.iter().map(direction).collect()
}

/// Coefficients of det(I - x A) by rising powers of x. *Source*: D. K. Faddeev, V. N. Faddeeva, Computational methods of linear algebra, 47.
/// Exact for exact numbers; for machine numbers only small n make sense.
pub fn characteristic<S: Scalar>(a: &[S], n: usize) -> Vec<S> {
    let mut coefficients = vec![S::one()];
    let mut b: Vec<S> = vec![S::zero(); n * n];
    for k in 1..=n {
        // b = A (b + c I)
        let last = coefficients[k - 1].clone();
        (0..n).for_each(|i| b[i * n + i] = b[i * n + i].add(&last));
        b = product(a, &b, n, n, n);
        let trace = (0..n).fold(S::zero(), |sum, i| sum.add(&b[i * n + i]));
        coefficients.push(trace.neg().div(&S::ratio(k as i64, 1)));
    }
    coefficients
}

#[cfg(test)]
mod tests {
    use super::*;
    use symbolic::Rational;

    #[test]
    fn characteristic_polynomial_of_a_known_matrix() {
        // det(I - x A) of [[2, 1], [1, 3]] is 1 - 5 x + 5 x²
        let a: Vec<Rational> = [2, 1, 1, 3].map(Rational::from).into();
        assert_eq!(characteristic(&a, 2), [1, -5, 5].map(Rational::from));
    }

    #[test]
    fn null_directions_are_found_within_rounding() {
        let a = [1.0, -1.0, 0.0, -1.0, 2.0, -1.0, 0.0, -1.0, 1.0];
        let null = null_space(&a, 3);
        assert_eq!(null.len(), 1);
        // elimination of a few rows, each unit of the last place grows some ten times
        assert!(null[0].iter().all(|v| (v / null[0][0] - 1.0).abs() < 1e-14));
        assert!(null_space(&[2.0, 1.0, 1.0, 2.0], 2).is_empty());
    }

    #[test]
    fn solves_with_exchanges() {
        let x = solve(&[0.0, 1.0, 1.0, 1.0], 2, &[2.0, 5.0], 1).unwrap();
        assert_eq!(x, [3.0, 2.0]);
    }
}
