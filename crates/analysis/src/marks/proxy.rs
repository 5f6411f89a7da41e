//! A quantity along a step as polynomials through its values.
//!
//! On [a, b] the values at Chebyshev's extreme points u_j = (1 - cos(π j/n))/2 give the coefficients of f = Σ c_k T_k(2u - 1). For an analytic f they
//! fall like ρ^-k, ρ by the nearest singularity; n = 8 is tried, then 16, then the halves. The last two coefficients measure the error: they must fall
//! below `ERROR` of the variation Σ |c_k|, k >= 1, or be rounding of the largest value in the step. A kink or a jump (`abs` in an output) is closed in by halving to
//! `DEEPEST`; a quantity that is noise itself never converges and is given up after `PIECES` pieces a step, which is more than any smooth one needs.
//!
//! *Source*: J. P. Boyd, Solving Transcendental Equations (SIAM 2014), chapter 3 (Chebyshev proxies with subdivision).

use std::f64::consts::PI;

/// Error relative to the variation.
const ERROR: f64 = 1e-11;
/// Rounding of a value, in units of the last place of the largest.
const ROUNDING: f64 = 32.0 * f64::EPSILON;
/// Share of the step below which a piece is an instant.
const DEEPEST: f64 = 1e-14;
/// Most pieces of a quantity in one step.
const PIECES: usize = 160;

/// A polynomial on a part of the step.
#[derive(Clone, Debug)]
pub struct Piece {
    /// Which quantity.
    pub of: usize,
    /// Where it begins.
    pub from: f64,
    /// Where it ends.
    pub to: f64,
    /// Bernstein's coefficients over the part; two when it is a line or an instant.
    pub row: Vec<f64>,
}

/// Tables for one number of points.
#[derive(Clone, Debug)]
struct Points {
    n: usize,
    /// Places in [0, 1].
    u: Vec<f64>,
    /// Values to Chebyshev's coefficients, (n+1)².
    to_chebyshev: Vec<f64>,
    /// Chebyshev's coefficients to Bernstein's, (n+1)².
    to_bernstein: Vec<f64>,
}

impl Points {
    fn new(n: usize) -> Points {
        let angle = |j: usize, k: usize| PI * ((j * k) % (2 * n)) as f64 / n as f64;
        let half = |k: usize| if k == 0 || k == n { 0.5 } else { 1.0 };
        let mut to_chebyshev = Vec::new();
        for k in 0..=n {
            // points ascend from u = 0, where the cosine is -1
            to_chebyshev.extend((0..=n).map(|j| 2.0 / n as f64 * half(k) * half(j) * angle(n - j, k).cos()));
        }
        let columns: Vec<Vec<f64>> = (0..=n).map(|k| chebyshev_in_bernstein(k, n)).collect();
        let to_bernstein = (0..=n).flat_map(|i| columns.iter().map(move |column| column[i])).collect();
        let u = (0..=n).map(|j| (0.5 * PI * j as f64 / n as f64).sin().powi(2)).collect();
        Points { n, u, to_chebyshev, to_bernstein }
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

/// Makes proxies.
#[derive(Clone, Debug)]
pub struct Proxies {
    coarse: Points,
    fine: Points,
}

impl Default for Proxies {
    fn default() -> Proxies {
        Proxies { coarse: Points::new(8), fine: Points::new(16) }
    }
}

impl Proxies {
    /// Pieces of the quantities `wanted` of `sample` over [0, h], each quantity's in order of time.
    ///
    /// *Shapes*: `sample(tau)` gives all quantities, at least up to the largest of `wanted`. Values that are not finite give no piece.
    pub fn pieces(&self, sample: &mut dyn FnMut(f64) -> Vec<f64>, wanted: &[usize], h: f64) -> Vec<Piece> {
        let mut out: Vec<Piece> = Vec::new();
        let mut spent = vec![0_usize; wanted.len()];
        // of the whole step: in a small piece beside a zero the rounding is still that of the large terms
        let mut largest = vec![0.0_f64; wanted.len()];
        let mut open: Vec<(f64, f64, Vec<usize>)> = vec![(0.0, h, (0..wanted.len()).collect())];
        while let Some((from, to, mut left)) = open.pop() {
            let coarse = self.values(&self.coarse, sample, (from, to), &[]);
            for &w in &left {
                largest[w] = coarse.iter().map(|row| row[wanted[w]].abs()).filter(|v| v.is_finite()).fold(largest[w], f64::max);
            }
            left.retain(|&w| !self.take(&self.coarse, &coarse, (wanted[w], from, to), (largest[w], Last::No), &mut out));
            if left.is_empty() {
                continue;
            }
            let fine = self.values(&self.fine, sample, (from, to), &coarse);
            let instant = to - from <= DEEPEST * h;
            left.retain(|&w| {
                spent[w] += 1;
                let last = if instant || spent[w] > PIECES { Last::Yes } else { Last::No };
                !self.take(&self.fine, &fine, (wanted[w], from, to), (largest[w], last), &mut out)
            });
            if !left.is_empty() {
                let middle = 0.5 * (from + to);
                open.push((middle, to, left.clone()));
                open.push((from, middle, left));
            }
        }
        out
    }

    /// Rows of values at the points; every second one of the finer is known.
    fn values(
        &self,
        points: &Points,
        sample: &mut dyn FnMut(f64) -> Vec<f64>,
        (from, to): (f64, f64),
        known: &[Vec<f64>],
    ) -> Vec<Vec<f64>> {
        let place = |j: usize| if j == points.n { to } else { from + (to - from) * points.u[j] };
        (0..=points.n).map(|j| if !known.is_empty() && j % 2 == 0 { known[j / 2].clone() } else { sample(place(j)) }).collect()
    }

    /// Adds the piece when it is exact enough.
    fn take(
        &self,
        points: &Points,
        values: &[Vec<f64>],
        (of, from, to): (usize, f64, f64),
        (largest, last): (f64, Last),
        out: &mut Vec<Piece>,
    ) -> bool {
        let f: Vec<f64> = values.iter().map(|row| row[of]).collect();
        if f.iter().any(|v| !v.is_finite()) {
            return last == Last::Yes;
        }
        let c = points.times(&points.to_chebyshev, &f);
        let variation: f64 = c[1..].iter().map(|c| c.abs()).sum();
        let tail = c[points.n].abs() + c[points.n - 1].abs();
        if tail <= (ERROR * variation).max(ROUNDING * largest) {
            out.push(Piece { of, from, to, row: points.times(&points.to_bernstein, &c) });
            return true;
        }
        if last == Last::Yes {
            // a jump or noise: its two ends
            out.push(Piece { of, from, to, row: vec![f[0], f[points.n]] });
        }
        last == Last::Yes
    }
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Last {
    No,
    Yes,
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::marks::crossings::value;

    #[test]
    fn a_smooth_function_is_met_to_rounding_and_a_kink_is_closed_in() {
        let proxies = Proxies::default();
        let mut f = |t: f64| vec![(3.0 * t).sin() / (1.2 + t.cos()), (t - 0.3).abs()];
        let pieces = proxies.pieces(&mut f, &[0, 1], 2.0);
        for piece in &pieces {
            for k in 0..=10 {
                let u = f64::from(k) / 10.0;
                let t = piece.from + (piece.to - piece.from) * u;
                let off = (value(&piece.row, u) - f(t)[piece.of]).abs();
                assert!(off < 1e-10, "{} at {t}: {off}", piece.of);
            }
        }
        assert!(pieces.iter().filter(|p| p.of == 1).count() > 30);
        assert!(pieces.iter().filter(|p| p.of == 0).count() <= 8);
    }

    #[test]
    fn noise_costs_a_bounded_number_of_pieces() {
        let mut k = 0_u64;
        let mut f = |_: f64| {
            k = k.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            vec![(k >> 40) as f64]
        };
        let pieces = Proxies::default().pieces(&mut f, &[0], 1.0);
        assert!(pieces.len() < 400, "{}", pieces.len());
    }
}
