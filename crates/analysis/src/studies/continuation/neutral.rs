//! Equations that depend on one another all along a branch: a machine that is alike all round rests, or moves, in any direction alike.
//!
//! ```text
//! A v = 0, w A = 0           A = | J ; t' |     at every point, not at branch points alone
//! | A  w | | x |   | r |
//! | v' 0 | | g | = | 0 |     the solution across v: nothing moves in the neutral directions
//! ```
//!
//! *Source*: Yu. A. Kuznetsov, Elements of Applied Bifurcation Theory, 7.4 (symmetry), 10.

use super::zeros::{Local, Place, Sort};
use algebra::elementary;
use algebra::lu::Lu;
use algebra::qr::Qr;
use algebra::refined::stretches;
use algebra::vectors::{Basis, norm};
use std::f64::consts::TAU;

/// What is left of a direction below this share of what rows make of others is rounding; the same of rows, of which the column of the parameter is that of a difference.
const OF_ROOTS: [f64; 2] = [1e-11, 1e-7];
/// The same of a turn, which is known to its tolerance.
const OF_TURNS: [f64; 2] = [1e-8, 1e-6];
/// The share at a branch point, which is known to some digits less.
const CROSSING: f64 = 1e-5;
/// By how much vectors at random may show an inverse too small, beside the root of their number: one of three is off by ten once in some thousand times, all three never.
const SEEN: f64 = 10.0;
/// Directions that are looked in where two vanish together.
const LOOKS: usize = 16;

/// A square matrix in parts of what its rows are otherwise.
pub(super) struct Even {
    k: usize,
    rows: Vec<f64>,
    sizes: Vec<f64>,
    shares: [f64; 2],
}

impl Even {
    /// J of the equations near a point with one more row.
    pub(super) fn new(matrix: &[f64], local: &Local, sort: Sort) -> Even {
        let k = local.basis.len();
        let usual = |i: usize| local.rows.get(i).copied().unwrap_or(0.0);
        let sizes = matrix.chunks(k).enumerate().map(|(i, row)| norm(row).max(usual(i))).map(|s| if s > 0.0 { s } else { 1.0 });
        let sizes: Vec<f64> = sizes.collect();
        let shares = if sort == Sort::Roots { OF_ROOTS } else { OF_TURNS };
        Even { k, rows: matrix.iter().enumerate().map(|(e, v)| v / sizes[e / k]).collect(), sizes, shares }
    }

    /// Directions that it takes away but for a share, orthonormal.
    fn taken_away(&self, share: f64) -> Vec<Vec<f64>> {
        orthonormal(Qr::alike(&self.rows, self.k, self.k, share).null_space())
    }

    /// Number of neutral directions.
    pub(super) fn count(&self) -> usize {
        if self.regular().is_some() { 0 } else { self.taken_away(self.shares[0]).len() }
    }

    /// The factors, where A⁻¹ is so small that no direction is neutral: no pivot of an orthogonal factorisation is below the least singular value. The search for neutral directions costs
    /// some ten eliminations of the matrix of a collocation.
    fn regular(&self) -> Option<Lu> {
        let k = self.k;
        let lu = Lu::exact(&self.rows, k)?;
        let column = |j: usize| norm(&self.rows.iter().skip(j).step_by(k).copied().collect::<Vec<_>>());
        let largest = (0..k).map(column).fold(0.0, f64::max);
        let least = 1.0 / (SEEN * (k as f64).sqrt());
        let clear = |[v, x]: &[Vec<f64>; 2]| norm(v) * least > self.shares[0] * largest * norm(x);
        stretches(k, |v| lu.solve(v).unwrap_or_else(|| vec![f64::NAN; k])).iter().all(clear).then_some(lu)
    }

    /// A solution of A x = r that moves in no neutral direction; none where A has no inverse beside them.
    pub(super) fn solve(&self, right: &[f64]) -> Option<Vec<f64>> {
        let (k, rows) = (self.k, &self.rows);
        let sides = right.iter().zip(&self.sizes).map(|(r, s)| r / s);
        if let Some(lu) = self.regular() {
            return lu.solve(&sides.collect::<Vec<_>>());
        }
        let neutral = self.taken_away(self.shares[0]);
        let transposed: Vec<f64> = (0..k * k).map(|e| rows[e % k * k + e / k]).collect();
        let against = match neutral.len() {
            0 => Vec::new(),
            _ => orthonormal(Qr::alike(&transposed, k, k, self.shares[1]).null_space()),
        };
        let d = if against.len() == neutral.len() { neutral.len() } else { 0 };
        let n = k + d;
        let entry = |i: usize, j: usize| match (i < k, j < k) {
            (true, true) => rows[i * k + j],
            (true, false) => against[j - k][i],
            (false, true) => neutral[i - k][j],
            (false, false) => 0.0,
        };
        let bordered: Vec<f64> = (0..n * n).map(|e| entry(e / n, e % n)).collect();
        let mut x = Lu::exact(&bordered, n)?.solve(&sides.chain(vec![0.0; d]).collect::<Vec<_>>())?;
        x.truncate(k);
        Some(x)
    }

    /// Directions at a branch point in which branches may part (local, of unit length), where more than one vanishes there; else none.
    pub(super) fn parting(&self) -> Vec<Vec<f64>> {
        let found = self.taken_away(CROSSING);
        if found.len() < 2 {
            return Vec::new();
        }
        let sum =
            |weights: &[(usize, f64)]| -> Vec<f64> { (0..self.k).map(|i| weights.iter().map(|(j, w)| w * found[*j][i]).sum()).collect() };
        let around = |(a, b): (usize, usize)| {
            let angles = (0..LOOKS).map(|i| TAU * i as f64 / LOOKS as f64);
            angles.map(move |angle| [(a, elementary::cos(angle)), (b, elementary::sin(angle))])
        };
        let pairs = (0..found.len()).flat_map(|a| (a + 1..found.len()).map(move |b| (a, b)));
        pairs.flat_map(around).map(|weights| sum(&weights)).collect()
    }
}

fn orthonormal(vectors: Vec<Vec<f64>>) -> Vec<Vec<f64>> {
    let mut basis = Basis::default();
    for v in vectors {
        basis.takes(&v, f64::EPSILON * norm(&v));
    }
    basis.into_vectors()
}

/// Whether a branch has the same neutral directions at most of its points.
pub(super) fn all_along(places: &[Place]) -> bool {
    2 * places.iter().filter(|place| place.signs.neutral > 0).count() > places.len()
}
