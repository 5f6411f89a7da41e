//! Small dense linear systems.

/// L U factors of a square matrix, rows scaled and exchanged.
#[derive(Clone, Debug)]
pub struct Lu {
    n: usize,
    /// Row-major factors.
    factors: Vec<f64>,
    rows: Vec<usize>,
    /// 1 / largest entry of each row.
    scales: Vec<f64>,
    /// Column without pivot, when the matrix is singular.
    deficient: Option<usize>,
}

/// A pivot below this share of the (scaled) largest entry makes the matrix singular.
const PIVOT: f64 = 1e-12;

impl Lu {
    /// Factors a row-major n x n matrix. *Source*: G. H. Golub, C. F. Van Loan, Matrix Computations, 3.4, with row scaling.
    pub fn new(matrix: &[f64], n: usize) -> Lu {
        let scales: Vec<f64> = (0..n)
            .map(|i| matrix[i * n..(i + 1) * n].iter().fold(0.0_f64, |m, a| m.max(a.abs())))
            .map(|largest| if largest > 0.0 { 1.0 / largest } else { 1.0 })
            .collect();
        let factors = (0..n * n).map(|k| matrix[k] * scales[k / n]).collect();
        let mut lu = Lu { n, factors, rows: (0..n).collect(), scales, deficient: None };
        for k in 0..n {
            lu.eliminate(k);
        }
        lu
    }

    fn eliminate(&mut self, k: usize) {
        let n = self.n;
        let column = |lu: &Lu, i: usize| lu.factors[i * n + k].abs();
        let pivot = (k..n).fold(k, |best, i| if column(self, i) > column(self, best) { i } else { best });
        let size = column(self, pivot);
        if size.is_nan() || size <= PIVOT {
            self.deficient.get_or_insert(k);
            return;
        }
        if pivot != k {
            (0..n).for_each(|j| self.factors.swap(k * n + j, pivot * n + j));
            self.rows.swap(k, pivot);
        }
        for i in k + 1..n {
            let factor = self.factors[i * n + k] / self.factors[k * n + k];
            self.factors[i * n + k] = factor;
            for j in k + 1..n {
                self.factors[i * n + j] -= factor * self.factors[k * n + j];
            }
        }
    }

    /// Solution of A x = b; none when A is singular.
    pub fn solve(&self, b: &[f64]) -> Option<Vec<f64>> {
        if self.deficient.is_some() {
            return None;
        }
        let n = self.n;
        let mut x: Vec<f64> = self.rows.iter().map(|&i| b[i] * self.scales[i]).collect();
        for i in 0..n {
            for j in 0..i {
                x[i] -= self.factors[i * n + j] * x[j];
            }
        }
        for i in (0..n).rev() {
            for j in i + 1..n {
                x[i] -= self.factors[i * n + j] * x[j];
            }
            x[i] /= self.factors[i * n + i];
        }
        Some(x)
    }

    /// A direction v with A v = 0 when A is singular: 1 in the first column without pivot, solved backwards.
    pub fn null_direction(&self) -> Option<Vec<f64>> {
        let k = self.deficient?;
        let n = self.n;
        let mut v = vec![0.0; n];
        v[k] = 1.0;
        for i in (0..k).rev() {
            let sum: f64 = (i + 1..=k).map(|j| self.factors[i * n + j] * v[j]).sum();
            v[i] = -sum / self.factors[i * n + i];
        }
        Some(v)
    }
}

/// Whether a symmetric matrix is positive definite: all pivots of the elimination are. None when one of them vanishes within rounding.
pub fn positive_definite(matrix: &[f64], n: usize) -> Option<bool> {
    let mut a = matrix.to_vec();
    for k in 0..n {
        let (pivot, size) = (a[k * n + k], matrix[k * n + k].abs());
        if pivot.abs() <= 1e-10 * size || (pivot == 0.0 && size == 0.0) {
            return if (k..n).any(|j| a[k * n + j].abs() > 1e-10 * size) { Some(false) } else { None };
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
    fn solves_a_badly_scaled_system() {
        let a = [1e-9, 2e-9, 3e5, -1e5];
        let lu = Lu::new(&a, 2);
        let x = lu.solve(&[5e-9, 1e5]).unwrap();
        assert!((x[0] - 1.0).abs() < 1e-14 && (x[1] - 2.0).abs() < 1e-14);
    }

    #[test]
    fn singular_matrix_names_its_direction() {
        let a = [1.0, -1.0, 0.0, -1.0, 2.0, -1.0, 0.0, -1.0, 1.0];
        let lu = Lu::new(&a, 3);
        assert!(lu.solve(&[0.0; 3]).is_none());
        assert_eq!(lu.null_direction().unwrap(), vec![1.0, 1.0, 1.0]);
    }

    #[test]
    fn definiteness() {
        assert_eq!(positive_definite(&[2.0, 1.0, 1.0, 2.0], 2), Some(true));
        assert_eq!(positive_definite(&[1.0, 2.0, 2.0, 1.0], 2), Some(false));
        assert_eq!(positive_definite(&[1.0, 1.0, 1.0, 1.0], 2), None);
    }
}
