//! Symmetric positive definite matrices: M = L Lᵀ, and whether a symmetric matrix is definite at all.
//! *Source*: G. H. Golub, C. F. Van Loan, Matrix Computations, 4.2.

/// A pivot below this share of its diagonal entry is none: elimination of a few dozen rows leaves some 1e-15 of a true zero.
pub const MASSLESS: f64 = 1e-13;
/// The same where a metric is made of the matrix, which is worth it only while its inverse has some digits.
const FIRM: f64 = 1e-12;
/// The same for stiffnesses, whose terms have cancelled before.
const DEFINITE: f64 = 1e-10;

/// The lower factor L.
#[derive(Clone, Debug)]
pub struct Cholesky {
    n: usize,
    /// Row-major.
    lower: Vec<f64>,
}

/// The first row whose pivot is not positive.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Weak {
    /// The row.
    pub row: usize,
    /// Its pivot as a share of the diagonal entry.
    pub pivot: f64,
}

impl Cholesky {
    /// Factors a row-major n x n matrix, whose lower triangle is read. *Errors*: the first row whose pivot is below [`MASSLESS`] of its entry.
    pub fn new(matrix: &[f64], n: usize) -> Result<Cholesky, Weak> {
        let mut l = vec![0.0; n * n];
        for i in 0..n {
            for j in 0..=i {
                let known: f64 = (0..j).map(|k| l[i * n + k] * l[j * n + k]).sum();
                let rest = matrix[i * n + j] - known;
                if i != j {
                    l[i * n + j] = rest / l[j * n + j];
                    continue;
                }
                let pivot = if rest == 0.0 { 0.0 } else { rest / matrix[i * n + i].abs() };
                if pivot.is_nan() || pivot <= MASSLESS {
                    return Err(Weak { row: i, pivot });
                }
                l[i * n + i] = rest.sqrt();
            }
        }
        Ok(Cholesky { n, lower: l })
    }

    /// L = I.
    pub fn identity(n: usize) -> Cholesky {
        Cholesky { n, lower: (0..n * n).map(|k| if k / n == k % n { 1.0 } else { 0.0 }).collect() }
    }

    /// b <- L⁻¹ b.
    pub fn forward(&self, b: &mut [f64]) {
        let (n, l) = (self.n, &self.lower);
        for i in 0..n {
            let known: f64 = (0..i).map(|j| l[i * n + j] * b[j]).sum();
            b[i] = (b[i] - known) / l[i * n + i];
        }
    }

    /// b <- L⁻ᵀ b.
    pub fn backward(&self, b: &mut [f64]) {
        let (n, l) = (self.n, &self.lower);
        for i in (0..n).rev() {
            let known: f64 = (i + 1..n).map(|j| l[j * n + i] * b[j]).sum();
            b[i] = (b[i] - known) / l[i * n + i];
        }
    }
}

/// Whether every motion has inertia: elimination with the largest share first, so that what is left at last is the rounding of few steps.
pub fn is_firm(matrix: &[f64], n: usize) -> bool {
    let root: Vec<f64> = (0..n).map(|i| matrix[i * n + i].sqrt()).collect();
    let mut a: Vec<f64> = (0..n * n).map(|k| matrix[k] / (root[k / n] * root[k % n])).collect();
    let mut left: Vec<usize> = (0..n).collect();
    while let Some(k) = (0..left.len()).max_by(|i, j| a[left[*i] * (n + 1)].total_cmp(&a[left[*j] * (n + 1)])) {
        let pivot = left.swap_remove(k);
        let size = a[pivot * (n + 1)];
        if size.is_nan() || size <= FIRM {
            return false;
        }
        for &i in &left {
            for &j in &left {
                a[i * n + j] -= a[i * n + pivot] * a[pivot * n + j] / size;
            }
        }
    }
    true
}

/// Whether a symmetric matrix is positive definite: all pivots of the elimination are. None when one of them vanishes within rounding.
pub fn positive_definite(matrix: &[f64], n: usize) -> Option<bool> {
    let mut a = matrix.to_vec();
    for k in 0..n {
        let (pivot, size) = (a[k * n + k], matrix[k * n + k].abs());
        if pivot.abs() <= DEFINITE * size || (pivot == 0.0 && size == 0.0) {
            return if (k..n).any(|j| a[k * n + j].abs() > DEFINITE * size) { Some(false) } else { None };
        }
        if pivot < 0.0 {
            return Some(false);
        }
        for i in k + 1..n {
            let factor = a[i * n + k] / pivot;
            for j in k + 1..n {
                a[i * n + j] -= factor * a[k * n + j];
            }
        }
    }
    Some(true)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn solves_by_both_halves() {
        // [[4, 2], [2, 5]] x = [8, 8] has x = [1.5, 1]
        let factor = Cholesky::new(&[4.0, 2.0, 2.0, 5.0], 2).unwrap();
        let mut x = [8.0, 8.0];
        factor.forward(&mut x);
        factor.backward(&mut x);
        assert_eq!(x, [1.5, 1.0]);
    }

    #[test]
    fn weak_rows_are_named_in_any_unit() {
        for unit in [1e-20, 1.0, 1e20] {
            let found = Cholesky::new(&[1.0, unit, unit, unit * unit], 2).unwrap_err();
            assert!(found.row == 1 && found.pivot.abs() <= MASSLESS, "{found:?}");
        }
        assert_eq!(Cholesky::new(&[-2.0], 1).unwrap_err(), Weak { row: 0, pivot: -1.0 });
        assert_eq!(Cholesky::new(&[0.0], 1).unwrap_err(), Weak { row: 0, pivot: 0.0 });
        assert!(!is_firm(&[1.0, 1.0, 1.0, 1.0], 2) && is_firm(&[2.0, 1.0, 1.0, 2.0], 2));
    }

    #[test]
    fn definiteness() {
        assert_eq!(positive_definite(&[2.0, 1.0, 1.0, 2.0], 2), Some(true));
        assert_eq!(positive_definite(&[1.0, 2.0, 2.0, 1.0], 2), Some(false));
        assert_eq!(positive_definite(&[1.0, 1.0, 1.0, 1.0], 2), None);
    }
}
