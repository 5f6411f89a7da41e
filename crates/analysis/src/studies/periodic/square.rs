//! Square matrices over the states.

/// Rows by state, one column per state.
#[derive(Clone, Debug)]
pub(super) struct Square {
    pub(super) n: usize,
    pub(super) values: Vec<f64>,
}

impl Square {
    pub(super) fn identity(n: usize) -> Square {
        Square { n, values: (0..n * n).map(|k| if k / n == k % n { 1.0 } else { 0.0 }).collect() }
    }
    pub(super) fn at(&self, i: usize, j: usize) -> f64 {
        self.values[i * self.n + j]
    }
    pub(super) fn times(&self, right: &Square) -> Square {
        let n = self.n;
        let entry = |k: usize| (0..n).map(|l| self.at(k / n, l) * right.at(l, k % n)).sum();
        Square { n, values: (0..n * n).map(entry).collect() }
    }
    /// Puts entries into scales.
    pub(super) fn scale(&mut self, scales: &[f64]) {
        let n = self.n;
        self.values.iter_mut().enumerate().for_each(|(k, v)| *v *= scales[k % n] / scales[k / n]);
    }
    /// Takes entries out of scales.
    pub(super) fn unscale(&mut self, scales: &[f64]) {
        let n = self.n;
        self.values.iter_mut().enumerate().for_each(|(k, v)| *v *= scales[k / n] / scales[k % n]);
    }
    pub(super) fn determinant(&self) -> f64 {
        let (n, mut a, mut out) = (self.n, self.values.clone(), 1.0);
        for k in 0..n {
            let pivot = (k..n).fold(k, |best, i| if a[i * n + k].abs() > a[best * n + k].abs() { i } else { best });
            if pivot != k {
                (0..n).for_each(|j| a.swap(k * n + j, pivot * n + j));
                out = -out;
            }
            let diagonal = a[k * n + k];
            out *= diagonal;
            if diagonal == 0.0 {
                return 0.0;
            }
            for i in k + 1..n {
                let factor = a[i * n + k] / diagonal;
                (k..n).for_each(|j| a[i * n + j] -= factor * a[k * n + j]);
            }
        }
        out
    }
    /// Product of the lengths of the columns: no determinant is larger.
    pub(super) fn hadamard(&self) -> f64 {
        (0..self.n).map(|j| (0..self.n).map(|i| self.at(i, j) * self.at(i, j)).sum::<f64>().sqrt()).product()
    }
    /// Largest entry without its sign; infinite where one is no number.
    pub(super) fn largest(&self) -> f64 {
        self.values.iter().fold(0.0, |m, v| {
            if v.abs() <= m {
                m
            } else if v.is_nan() {
                f64::INFINITY
            } else {
                v.abs()
            }
        })
    }
    /// Largest sum of a row without signs.
    pub(super) fn norm(&self) -> f64 {
        self.values.chunks(self.n.max(1)).map(|row| row.iter().map(|v| v.abs()).sum()).fold(0.0, f64::max)
    }
    pub(super) fn apply(&self, x: &[f64]) -> Vec<f64> {
        (0..self.n).map(|i| (0..self.n).map(|j| self.at(i, j) * x[j]).sum()).collect()
    }
}
