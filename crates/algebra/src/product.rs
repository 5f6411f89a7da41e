//! Eigenvalues of a product of many small matrices, A_N ... A_2 A_1, whose sizes lie far apart: the product itself would keep the digits of the largest one only.
//!
//! ```text
//! A_k Q_(k-1) = Q_k R_k         Q orthogonal, R upper triangular; again and again over all factors, until the first columns of Q_0 span what grows most
//! Q_0' A_N ... A_1 Q_0 = (Q_0' Q_N) R_N ... R_1      block triangular, a block for each group of eigenvalues of like size
//! ```
//!
//! The blocks are multiplied with a common exponent, so that neither 1e400 nor 1e-400 is lost. Each factor has to be known to the digits of its smaller numbers: many factors of little growth are, one of all is not.
//!
//! *Source*: A. W. Bojanczyk, G. H. Golub, P. Van Dooren, Proc. SPIE 1770 (1992) 31-42 (periodic Schur form); K. Lust, Int. J. Bifurcation and Chaos 11 (2001) 2389-2410 (multipliers).

use crate::complex::{self, Complex};
use crate::eigen::general;
use crate::trouble::Trouble;
use crate::{elementary, vectors};

/// An eigenvalue as z exp(log), |z| of size 1, and by how much it may be wrong, as a share of itself.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spread {
    /// z.
    pub z: Complex,
    /// ln of its size.
    pub log: f64,
    /// Relative error by that of the factors, each of which knows small numbers as a share of its large ones only.
    pub error: f64,
}

/// A factor, row by row.
#[derive(Clone, Debug, PartialEq)]
pub struct Factor {
    /// Its entries.
    pub matrix: Vec<f64>,
    /// What they may err by, as a share of the largest.
    pub doubt: f64,
}

impl Spread {
    /// ln of the magnitude.
    pub fn log_abs(&self) -> f64 {
        self.log + elementary::ln(complex::abs(self.z))
    }
}

/// Sweeps over all factors: each brings groups that lie apart nearer to their blocks by their ratio.
const SWEEPS: usize = 10;
/// ln of the ratio from which on eigenvalues are different groups: ten sweeps leave 1e-30 of the coupling, and a group spans three digits a pair.
const APART: f64 = 6.9;
/// Rounding of a factor and of its product with a basis, as a share of its size.
const ROUNDING: f64 = 4.0 * f64::EPSILON;

/// A factorisation Q R, R with a diagonal that is not negative (Gram and Schmidt, twice).
fn orthogonal(n: usize, a: &[f64]) -> (Vec<f64>, Vec<f64>) {
    let mut columns: Vec<Vec<f64>> = (0..n).map(|j| (0..n).map(|i| a[i * n + j]).collect()).collect();
    let mut r = vec![0.0; n * n];
    for j in 0..n {
        let (before, rest) = columns.split_at_mut(j);
        let own = &mut rest[0];
        for _ in 0..2 {
            for (i, other) in before.iter().enumerate() {
                let share = vectors::dot(other, own);
                r[i * n + j] += share;
                own.iter_mut().zip(other).for_each(|(x, o)| *x -= share * o);
            }
        }
        let length = vectors::norm(own);
        r[j * n + j] = length;
        if length > 0.0 {
            own.iter_mut().for_each(|x| *x /= length);
        } else {
            *own = fresh(n, before);
        }
    }
    let q = (0..n * n).map(|e| columns[e % n][e / n]).collect();
    (q, r)
}

/// A direction at right angles to others, where a factor has taken one away.
fn fresh(n: usize, others: &[Vec<f64>]) -> Vec<f64> {
    let mut best = (0.0, vec![0.0; n]);
    for k in 0..n {
        let mut v: Vec<f64> = (0..n).map(|i| if i == k { 1.0 } else { 0.0 }).collect();
        for other in others {
            let share = vectors::dot(other, &v);
            v.iter_mut().zip(other).for_each(|(x, o)| *x -= share * o);
        }
        let length = vectors::norm(&v);
        if length > best.0 {
            best = (length, v.iter().map(|x| x / length).collect());
        }
    }
    best.1
}

fn times(n: usize, a: &[f64], b: &[f64]) -> Vec<f64> {
    (0..n * n).map(|e| (0..n).map(|l| a[e / n * n + l] * b[l * n + e % n]).sum()).collect()
}

/// Eigenvalues of the product of square matrices of order n, row by row, the last one leftmost; largest first.
///
/// # Errors
/// Those of eigenvalues of a block.
pub fn eigenvalues(n: usize, factors: &[Factor]) -> Result<Vec<Spread>, Trouble> {
    if n == 0 || factors.is_empty() {
        return Ok(Vec::new());
    }
    // a basis that no symmetry knows
    let generic: Vec<f64> = (0..n * n).map(|e| if e / n == e % n { 1.0 } else { 0.3 / (1.0 + (e / n + 2 * (e % n)) as f64) }).collect();
    let mut q = orthogonal(n, &generic).0;
    let (mut first, mut triangles) = (q.clone(), Vec::new());
    for _ in 0..SWEEPS {
        first.clone_from(&q);
        triangles.clear();
        for factor in factors {
            let (next, r) = orthogonal(n, &times(n, &factor.matrix, &q));
            q = next;
            triangles.push(r);
        }
    }
    let transposed: Vec<f64> = (0..n * n).map(|e| first[e % n * n + e / n]).collect();
    let closing = times(n, &transposed, &q);
    let logs: Vec<f64> = (0..n).map(|i| triangles.iter().map(|r| elementary::ln(r[i * n + i])).sum()).collect();
    let mut found = Vec::with_capacity(n);
    let mut a = 0;
    while a < n {
        let mut b = a + 1;
        // a direction that was taken away (ln 0) stands alone
        while b < n && logs[b - 1] - logs[b] < APART {
            b += 1;
        }
        let block = group(n, (a, b), &closing, &triangles)?;
        let error = doubt(n, (a, b), factors, &triangles);
        found.extend(block.into_iter().map(|value| Spread { error: error * value.error, ..value }));
        a = b;
    }
    found.sort_by(|x, y| y.log_abs().total_cmp(&x.log_abs()).then(y.z.im.total_cmp(&x.z.im)));
    Ok(found)
}

/// Relative error of a block: what a factor errs by, beside what it does to the directions of the block.
fn doubt(n: usize, (a, b): (usize, usize), factors: &[Factor], triangles: &[Vec<f64>]) -> f64 {
    let one = |(factor, r): (&Factor, &Vec<f64>)| {
        let size = vectors::norm(&factor.matrix);
        let least = (a..b).map(|i| r[i * n + i]).fold(f64::INFINITY, f64::min);
        (factor.doubt + ROUNDING) * size / least
    };
    let sum: f64 = factors.iter().zip(triangles).map(one).sum();
    if sum.is_nan() { f64::INFINITY } else { sum.min(1.0) }
}

/// Eigenvalues of a block on the diagonal; as their errors by how much the largest of them is larger.
fn group(n: usize, (a, b): (usize, usize), closing: &[f64], triangles: &[Vec<f64>]) -> Result<Vec<Spread>, Trouble> {
    let m = b - a;
    let part = |matrix: &[f64]| -> Vec<f64> { (0..m * m).map(|e| matrix[(a + e / m) * n + a + e % m]).collect() };
    let mut log = 0.0;
    let mut right: Vec<f64> = (0..m * m).map(|e| if e / m == e % m { 1.0 } else { 0.0 }).collect();
    for r in triangles {
        right = times(m, &part(r), &right);
        let size = right.iter().fold(0.0_f64, |l, v| l.max(v.abs()));
        if size == 0.0 {
            let none = Spread { z: Complex::new(0.0, 0.0), log: 0.0, error: 0.0 };
            return Ok(vec![none; m]);
        }
        right.iter_mut().for_each(|v| *v /= size);
        log += elementary::ln(size);
    }
    // Q_0' Q_N stands leftmost
    let product = times(m, &part(closing), &right);
    let values = general(m, &product)?.values;
    let largest = values.iter().map(|z| complex::abs(*z)).fold(0.0, f64::max);
    Ok(values.into_iter().map(|z| Spread { z, log, error: largest / complex::abs(z).max(f64::MIN_POSITIVE) }).collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::Random;

    /// Rounding of forty factors, each of which holds numbers three digits apart.
    const ROUNDED: f64 = 1e-10;

    /// Turned diagonal factors: G_k D G_(k-1)^-1 with G_N = G_0 has the eigenvalues of the product of the D.
    #[test]
    fn sizes_far_beyond_the_range_of_numbers_keep_their_digits() {
        let (n, count) = (4, 40);
        let logs = [4.0, 0.0, -0.01, -4.0];
        let mut random = Random::new(3);
        let bases: Vec<Vec<f64>> =
            (0..count).map(|_| orthogonal(n, &(0..n * n).map(|_| random.between(-1.0, 1.0)).collect::<Vec<f64>>()).0).collect();
        let factors: Vec<Factor> = (0..count)
            .map(|k| {
                let (from, to) = (&bases[k], &bases[(k + 1) % count]);
                let scaled: Vec<f64> = (0..n * n).map(|e| elementary::exp(logs[e / n]) * from[e % n * n + e / n]).collect();
                Factor { matrix: times(n, to, &scaled), doubt: 0.0 }
            })
            .collect();
        let found = eigenvalues(n, &factors).unwrap();
        for (value, log) in found.iter().zip(logs) {
            let exact = log * count as f64;
            assert!((value.log_abs() - exact).abs() < ROUNDED * (1.0 + exact.abs()), "{} for {exact}", value.log_abs());
        }
    }

    /// A turn by an angle in one plane, growth by e^120 beside it: the pair stays on the circle to rounding.
    #[test]
    fn a_pair_on_the_circle_stays_there_beside_what_grows() {
        let (count, angle) = (30, 0.1_f64);
        let mix = orthogonal(3, &[1.0, 0.4, 0.2, -0.3, 1.0, 0.5, 0.7, -0.2, 1.0]).0;
        let (c, s) = (elementary::cos(angle), elementary::sin(angle));
        let turn = [c, -s, 0.0, s, c, 0.0, 0.0, 0.0, elementary::exp(4.0)];
        let back: Vec<f64> = (0..9).map(|e| mix[e % 3 * 3 + e / 3]).collect();
        let factor = Factor { matrix: times(3, &mix, &times(3, &turn, &back)), doubt: 0.0 };
        let found = eigenvalues(3, &vec![factor; count]).unwrap();
        assert!((found[0].log_abs() - 120.0).abs() < ROUNDED * 120.0);
        for (value, sign) in found[1..].iter().zip([1.0, -1.0]) {
            assert!(value.log_abs().abs() < ROUNDED, "{}", value.log_abs());
            assert!((complex::arg(value.z) - sign * angle * count as f64).abs() < ROUNDED);
        }
    }
}
