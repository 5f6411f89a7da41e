//! Small dense linear systems, real or complex: L U factors with rows scaled and exchanged.
//!
//! *Source*: G. H. Golub, C. F. Van Loan, Matrix Computations, 3.4, with row scaling.

use crate::complex::{self, Complex};
use std::ops::{Add, Mul, Neg, Sub};

/// What systems are made of.
pub trait Number:
    Copy + Default + PartialEq + From<f64> + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Neg<Output = Self>
{
    /// A number of the order of its modulus.
    fn size(self) -> f64;
    /// self / other.
    fn over(self, other: Self) -> Self;
    /// self times a real number.
    fn times(self, factor: f64) -> Self;
}

impl Number for f64 {
    fn size(self) -> f64 {
        self.abs()
    }
    fn over(self, other: f64) -> f64 {
        self / other
    }
    fn times(self, factor: f64) -> f64 {
        self * factor
    }
}

impl Number for Complex {
    fn size(self) -> f64 {
        self.re.abs() + self.im.abs()
    }
    fn over(self, other: Complex) -> Complex {
        complex::over(self, other)
    }
    fn times(self, factor: f64) -> Complex {
        self.scale(factor)
    }
}

/// L U factors of a square matrix.
#[derive(Clone, Debug)]
pub struct Lu<T = f64> {
    n: usize,
    /// Row-major factors.
    factors: Vec<T>,
    rows: Vec<usize>,
    /// 1 / largest entry of each row.
    scales: Vec<f64>,
    /// Column without pivot, when the matrix is singular.
    deficient: Option<usize>,
}

/// A pivot below this share of the (scaled) largest entry makes the matrix singular: entries that come out of other computations are known to some 1e-13.
const PIVOT: f64 = 1e-12;

impl<T: Number> Lu<T> {
    /// Factors a row-major n x n matrix, which counts as singular below `PIVOT`.
    pub fn new(matrix: &[T], n: usize) -> Lu<T> {
        Lu::factored(matrix, n, PIVOT)
    }

    /// Factors a matrix that is right to the last bit: none only where a pivot is exactly zero or no number. For steps that are corrected afterwards.
    pub fn exact(matrix: &[T], n: usize) -> Option<Lu<T>> {
        Some(Lu::factored(matrix, n, 0.0)).filter(|lu| lu.deficient.is_none())
    }

    fn factored(matrix: &[T], n: usize, limit: f64) -> Lu<T> {
        let scales: Vec<f64> = (0..n)
            .map(|i| matrix[i * n..(i + 1) * n].iter().fold(0.0_f64, |m, a| m.max(a.size())))
            .map(|largest| if largest > 0.0 { 1.0 / largest } else { 1.0 })
            .collect();
        let factors = (0..n * n).map(|k| matrix[k].times(scales[k / n])).collect();
        let mut lu = Lu { n, factors, rows: (0..n).collect(), scales, deficient: None };
        for k in 0..n {
            lu.eliminate(k, limit);
        }
        lu
    }

    fn eliminate(&mut self, k: usize, limit: f64) {
        let n = self.n;
        let column = |lu: &Lu<T>, i: usize| lu.factors[i * n + k].size();
        let pivot = (k..n).fold(k, |best, i| if column(self, i) > column(self, best) { i } else { best });
        let size = column(self, pivot);
        if !size.is_finite() || size <= limit {
            self.deficient.get_or_insert(k);
            return;
        }
        if pivot != k {
            (0..n).for_each(|j| self.factors.swap(k * n + j, pivot * n + j));
            self.rows.swap(k, pivot);
        }
        let (done, rest) = self.factors.split_at_mut((k + 1) * n);
        let top = &done[k * n..];
        for row in rest.chunks_mut(n) {
            if row[k] == T::default() {
                continue;
            }
            let factor = row[k].over(top[k]);
            row[k] = factor;
            for (a, b) in row[k + 1..].iter_mut().zip(&top[k + 1..]) {
                *a = *a - factor * *b;
            }
        }
    }

    /// Solution of A x = b; none when A is singular.
    pub fn solve(&self, b: &[T]) -> Option<Vec<T>> {
        if self.deficient.is_some() {
            return None;
        }
        let n = self.n;
        let mut x: Vec<T> = self.rows.iter().map(|&i| b[i].times(self.scales[i])).collect();
        for i in 0..n {
            let (known, rest) = x.split_at_mut(i);
            for (l, v) in self.factors[i * n..i * n + i].iter().zip(known) {
                rest[0] = rest[0] - *l * *v;
            }
        }
        for i in (0..n).rev() {
            let (head, known) = x.split_at_mut(i + 1);
            for (u, v) in self.factors[i * n + i + 1..(i + 1) * n].iter().zip(known) {
                head[i] = head[i] - *u * *v;
            }
            head[i] = head[i].over(self.factors[i * n + i]);
        }
        Some(x)
    }

    /// Determinant.
    pub fn determinant(&self) -> T {
        let n = self.n;
        let (mut rows, mut out) = (self.rows.clone(), T::from(1.0));
        for k in 0..n {
            out = (out * self.factors[k * n + k]).times(1.0 / self.scales[k]);
            // the permutation, cycle by cycle
            while rows[k] != k {
                let other = rows[k];
                rows.swap(k, other);
                out = -out;
            }
        }
        out
    }

    /// A direction v with A v = 0 when A is singular: 1 in the first column without pivot, solved backwards.
    pub fn null_direction(&self) -> Option<Vec<T>> {
        let k = self.deficient?;
        let n = self.n;
        let mut v = vec![T::default(); n];
        v[k] = T::from(1.0);
        for i in (0..k).rev() {
            let sum = (i + 1..=k).fold(T::default(), |sum, j| sum + self.factors[i * n + j] * v[j]);
            v[i] = (-sum).over(self.factors[i * n + i]);
        }
        Some(v)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Solutions of a few rows: rounding times a condition of some ten.
    const FACTORED: f64 = 1e-14;

    #[test]
    fn determinants_have_the_sign_of_their_exchanges() {
        let a = [0.0, 2.0, 0.0, 0.0, 0.0, 3.0, 5.0, 0.0, 0.0];
        assert!((Lu::new(&a, 3).determinant() - 30.0).abs() < FACTORED);
        let b = [0.0, 2e6, 3.0, 1e-6];
        assert!((Lu::new(&b, 2).determinant() + 6e6).abs() < FACTORED * 6e6);
    }

    #[test]
    fn solves_a_badly_scaled_system() {
        let a = [1e-9, 2e-9, 3e5, -1e5];
        let x = Lu::new(&a, 2).solve(&[5e-9, 1e5]).unwrap();
        assert!((x[0] - 1.0).abs() < FACTORED && (x[1] - 2.0).abs() < FACTORED);
    }

    #[test]
    fn solves_a_badly_scaled_complex_system() {
        let c = Complex::new;
        let a = [c(0.0, 0.0), c(2e9, 1e9), c(3e-7, 1e-7), c(0.0, -2e-7)];
        let x = [c(1.0, -2.0), c(0.5, 3.0)];
        let b = [a[0] * x[0] + a[1] * x[1], a[2] * x[0] + a[3] * x[1]];
        let got = Lu::exact(&a, 2).unwrap().solve(&b).unwrap();
        assert!(got.iter().zip(x).all(|(got, want)| complex::abs(*got - want) < FACTORED), "{got:?}");
    }

    #[test]
    fn singular_matrix_names_its_direction() {
        let a = [1.0, -1.0, 0.0, -1.0, 2.0, -1.0, 0.0, -1.0, 1.0];
        let lu = Lu::new(&a, 3);
        assert!(lu.solve(&[0.0; 3]).is_none());
        assert_eq!(lu.null_direction().unwrap(), vec![1.0, 1.0, 1.0]);
    }

    #[test]
    fn exact_factors_need_a_pivot_that_is_a_number() {
        let c = Complex::from;
        assert!(Lu::exact(&[c(1.0), c(2.0), c(2.0), c(4.0)], 2).is_none());
        assert!(Lu::exact(&[c(f64::NAN)], 1).is_none());
        let nearly = [1.0, 1.0, 1.0, 1.0 + 1e-14];
        assert!(Lu::exact(&nearly, 2).is_some() && Lu::new(&nearly, 2).solve(&[1.0, 1.0]).is_none());
    }
}
