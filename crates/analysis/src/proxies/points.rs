//! Chebyshev's extreme points and the polynomial through values there.

use algebra::elementary;
use std::f64::consts::PI;

/// Tables for one number of points.
#[derive(Clone, Debug)]
pub(crate) struct Points {
    pub(crate) n: usize,
    /// Places in [0, 1].
    pub(crate) u: Vec<f64>,
    /// Values to Chebyshev's coefficients, (n+1)².
    to_chebyshev: Vec<f64>,
    /// Chebyshev's coefficients to Bernstein's, (n+1)².
    to_bernstein: Vec<f64>,
}

impl Points {
    pub(crate) fn new(n: usize) -> Points {
        let angle = |j: usize, k: usize| PI * ((j * k) % (2 * n)) as f64 / n as f64;
        let half = |k: usize| if k == 0 || k == n { 0.5 } else { 1.0 };
        let mut to_chebyshev = Vec::new();
        for k in 0..=n {
            // points ascend from u = 0, where the cosine is -1
            to_chebyshev.extend((0..=n).map(|j| 2.0 / n as f64 * half(k) * half(j) * elementary::cos(angle(n - j, k))));
        }
        let columns: Vec<Vec<f64>> = (0..=n).map(|k| chebyshev_in_bernstein(k, n)).collect();
        let to_bernstein = (0..=n).flat_map(|i| columns.iter().map(move |column| column[i])).collect();
        let u = (0..=n).map(|j| elementary::powi(elementary::sin(0.5 * PI * j as f64 / n as f64), 2)).collect();
        Points { n, u, to_chebyshev, to_bernstein }
    }

    /// Bernstein's coefficients of the polynomial through the values.
    pub(super) fn row(&self, f: &[f64]) -> Vec<f64> {
        let mut row = self.times(&self.to_bernstein, &self.times(&self.to_chebyshev, f));
        (row[0], row[self.n]) = (f[0], f[self.n]);
        row
    }

    /// The last two of Chebyshev's coefficients, without sign, together.
    pub(super) fn tail(&self, f: &[f64]) -> f64 {
        let m = self.n + 1;
        let c = |k: usize| self.to_chebyshev[k * m..(k + 1) * m].iter().zip(f).map(|(a, f)| a * f).sum::<f64>();
        c(self.n).abs() + c(self.n - 1).abs()
    }

    fn times(&self, matrix: &[f64], v: &[f64]) -> Vec<f64> {
        let m = self.n + 1;
        (0..m).map(|i| (0..m).map(|j| matrix[i * m + j] * v[j]).sum()).collect()
    }
}

/// T_k(2u - 1) with n + 1 Bernstein coefficients: b_j = (-1)^(k-j) C(2k, 2j)/C(k, j) of its own degree, then raised.
fn chebyshev_in_bernstein(k: usize, n: usize) -> Vec<f64> {
    let mut b = Vec::with_capacity(n + 1);
    let (mut upper, mut lower) = (1.0, 1.0);
    for j in 0..=k {
        let sign = if (k - j).is_multiple_of(2) { 1.0 } else { -1.0 };
        b.push(sign * upper / lower);
        let at = |m: usize| m as f64;
        if j < k {
            upper *= at(2 * (k - j)) * at(2 * (k - j) - 1) / (at(2 * j + 1) * at(2 * j + 2));
            lower *= at(k - j) / at(j + 1);
        }
    }
    for degree in k..n {
        let raised = (0..=degree + 1).map(|j| {
            let w = j as f64 / (degree + 1) as f64;
            let below = if j > 0 { w * b[j - 1] } else { 0.0 };
            let above = if j <= degree { (1.0 - w) * b[j] } else { 0.0 };
            below + above
        });
        b = raised.collect();
    }
    b
}

/// Greatest less least value.
pub(super) fn spread(f: &[f64]) -> f64 {
    let (low, high) = f.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), v| (l.min(*v), h.max(*v)));
    high - low
}

/// Largest magnitude.
pub(super) fn size(f: &[f64]) -> f64 {
    f.iter().fold(0.0, |largest, v| largest.max(v.abs()))
}
