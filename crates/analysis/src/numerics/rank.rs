//! Rank, null space and least squares of small dense matrices by Householder's Q R with exchange of columns.
//! *Source*: G. H. Golub, C. F. Van Loan, Matrix Computations, 5.4.2.

/// A P = Q R of an m x n matrix, columns exchanged so that the diagonal of R falls.
#[derive(Clone, Debug)]
pub struct Qr {
    rows: usize,
    columns: usize,
    /// Row-major; R above the diagonal, Householder vectors in `reflectors`.
    r: Vec<f64>,
    reflectors: Vec<Vec<f64>>,
    order: Vec<usize>,
    rank: usize,
}

/// Share of the largest diagonal entry of R below which a column depends on those before it.
pub const TOLERANCE: f64 = 1e-11;

impl Qr {
    /// Factors a row-major m x n matrix; rows and columns should be scaled alike. Column j counts as independent while the rest of it,
    /// after those before it, exceeds `tolerance` of the largest column.
    pub fn new(rows: usize, columns: usize, matrix: &[f64], tolerance: f64) -> Qr {
        let mut qr =
            Qr { rows, columns, r: matrix[..rows * columns].to_vec(), reflectors: Vec::new(), order: (0..columns).collect(), rank: 0 };
        let mut largest = 0.0;
        for k in 0..rows.min(columns) {
            let (pivot, size) = (k..columns).map(|j| (j, qr.rest(k, j))).fold((k, -1.0), |best, e| if e.1 > best.1 { e } else { best });
            if k == 0 {
                largest = size;
            }
            if size.is_nan() || size <= tolerance * largest {
                break;
            }
            (0..rows).for_each(|i| qr.r.swap(i * columns + k, i * columns + pivot));
            qr.order.swap(k, pivot);
            qr.reflect(k, size);
            qr.rank += 1;
        }
        qr
    }

    fn rest(&self, k: usize, j: usize) -> f64 {
        (k..self.rows).fold(0.0_f64, |norm, i| norm.hypot(self.r[i * self.columns + j]))
    }

    fn reflect(&mut self, k: usize, size: f64) {
        let n = self.columns;
        let mut v: Vec<f64> = (k..self.rows).map(|i| self.r[i * n + k]).collect();
        let alpha = if v[0] > 0.0 { -size } else { size };
        v[0] -= alpha;
        let norm = v.iter().fold(0.0_f64, |s, x| s.hypot(*x));
        v.iter_mut().for_each(|x| *x /= norm);
        for j in k..n {
            let dot: f64 = v.iter().enumerate().map(|(i, x)| x * self.r[(k + i) * n + j]).sum();
            v.iter().enumerate().for_each(|(i, x)| self.r[(k + i) * n + j] -= 2.0 * dot * x);
        }
        self.reflectors.push(v);
    }

    /// Number of independent columns.
    pub fn rank(&self) -> usize {
        self.rank
    }

    /// Indices of independent columns, the most independent first.
    pub fn independent(&self) -> &[usize] {
        &self.order[..self.rank]
    }

    /// Indices of columns that depend on the independent ones.
    pub fn dependent(&self) -> &[usize] {
        &self.order[self.rank..]
    }

    /// R₁ x = c by back substitution, R₁ the leading square of full rank.
    fn back(&self, mut c: Vec<f64>) -> Vec<f64> {
        for i in (0..self.rank).rev() {
            let sum: f64 = (i + 1..self.rank).map(|j| self.r[i * self.columns + j] * c[j]).sum();
            c[i] = (c[i] - sum) / self.r[i * self.columns + i];
        }
        c
    }

    /// Directions v with A v = 0, one per dependent column (in which the entry is 1, 0 in the other dependent ones).
    pub fn null_space(&self) -> Vec<Vec<f64>> {
        let directions = (self.rank..self.columns).map(|j| {
            let c = self.back((0..self.rank).map(|i| -self.r[i * self.columns + j]).collect());
            let mut v = vec![0.0; self.columns];
            c.iter().enumerate().for_each(|(i, x)| v[self.order[i]] = *x);
            v[self.order[j]] = 1.0;
            v
        });
        directions.collect()
    }

    /// x with least |A x - b|, zero in dependent columns, and that least residual.
    pub fn least_squares(&self, b: &[f64]) -> (Vec<f64>, f64) {
        let mut c = b[..self.rows].to_vec();
        for (k, v) in self.reflectors.iter().enumerate() {
            let dot: f64 = v.iter().zip(&c[k..]).map(|(x, y)| x * y).sum();
            v.iter().zip(&mut c[k..]).for_each(|(x, y)| *y -= 2.0 * dot * x);
        }
        let residual = c[self.rank..].iter().fold(0.0_f64, |s, x| s.hypot(*x));
        let solved = self.back(c[..self.rank].to_vec());
        let mut x = vec![0.0; self.columns];
        solved.iter().enumerate().for_each(|(i, value)| x[self.order[i]] = *value);
        (x, residual)
    }
}

/// Rank of a row-major m x n matrix with the usual tolerance.
pub fn rank(rows: usize, columns: usize, matrix: &[f64]) -> usize {
    Qr::new(rows, columns, matrix, TOLERANCE).rank()
}

/// Directions v with A v = 0 of a row-major m x n matrix, see [`Qr::null_space`].
pub fn null_space(rows: usize, columns: usize, matrix: &[f64]) -> Vec<Vec<f64>> {
    Qr::new(rows, columns, matrix, TOLERANCE).null_space()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rank_and_null_space_of_a_dependent_matrix() {
        let a = [1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0];
        assert_eq!(rank(3, 3, &a), 2);
        let v = null_space(3, 3, &a).remove(0);
        let t = v[0];
        assert!((v[1] + 2.0 * t).abs() < 1e-14 && (v[2] - t).abs() < 1e-14, "{v:?}");
        assert_eq!(rank(2, 3, &[0.0; 6]), 0);
        assert_eq!(null_space(2, 3, &[0.0; 6]).len(), 3);
    }

    #[test]
    fn least_squares_line() {
        // y = 1 + 2 t through three points, the middle one 3 too high: shift 1 in the constant, residual sqrt(1 + 4 + 1)
        let (x, residual) = Qr::new(3, 2, &[1.0, -1.0, 1.0, 0.0, 1.0, 1.0], TOLERANCE).least_squares(&[-1.0, 4.0, 3.0]);
        assert!((x[0] - 2.0).abs() < 1e-14 && (x[1] - 2.0).abs() < 1e-14);
        assert!((residual - 6.0_f64.sqrt()).abs() < 1e-14);
    }
}
