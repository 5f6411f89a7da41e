//! Amplitudes of forced motions, finite ones and those with poles, and how quantities follow them.

use crate::studies::shapes::Complex;
use algebra::double::Double;
use algebra::elementary;
use algebra::lu::Lu;

/// Amplitudes of the coordinates: X(ω + δ) = Σ_m poles_m/δ^m + regular + Σ free, the last at ω > 0 only.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Amplitudes {
    /// X₀, without the free motions that stand apart.
    pub regular: Vec<Complex>,
    /// Coefficients of δ⁻¹, δ⁻², ...; empty where the matrix is regular or the free oscillation is not excited.
    pub poles: Vec<Vec<Complex>>,
    /// Free motions that stand apart, direction and amplitude: they may be many orders larger than the rest, and what they do not move must not see them.
    pub free: Vec<(Vec<f64>, Complex)>,
    /// Motions of a stiffness of their own, direction and amplitude, where weak springs stand beside hard ones: in twice the digits, because a hard spring is bent by
    /// less than a rounding of what the weak one lets go.
    pub fine: Vec<(Vec<Double>, Complex)>,
    /// Share of X₀ that plain elimination gets wrong, which refinement has put right: what a rounding of the matrix may change. NaN where refinement fails.
    pub doubt: f64,
}

/// How a quantity follows the coordinates: y = (∂y/∂q + iω ∂y/∂q' - ω² ∂y/∂q'') X.
#[derive(Clone, Copy, Debug)]
pub struct Gain<'a> {
    /// ∂y/∂q.
    pub place: &'a [f64],
    /// ∂y/∂q'.
    pub rate: &'a [f64],
    /// ∂y/∂q''.
    pub acceleration: &'a [f64],
    /// ω, rad/s.
    pub omega: f64,
}

impl Gain<'_> {
    /// g, dg/dω and ½ d²g/dω².
    fn terms(&self) -> [Vec<Complex>; 3] {
        let w = self.omega;
        let n = self.place.len();
        [
            (0..n).map(|i| (self.place[i] - w * w * self.acceleration[i], w * self.rate[i])).collect(),
            (0..n).map(|i| (-2.0 * w * self.acceleration[i], self.rate[i])).collect(),
            self.acceleration.iter().map(|a| (-a, 0.0)).collect(),
        ]
    }

    /// How far a unit of a free motion moves it, and the largest of the terms; what is rounding of its terms is nothing.
    fn along(&self, z: &[f64]) -> (Complex, f64) {
        let one = |g: &[f64]| {
            let (sum, size) = g.iter().zip(z).fold((0.0, 0.0), |(s, m), (g, z)| (s + g * z, m + (g * z).abs()));
            if f64::abs(sum) <= SINGULAR * size { 0.0 } else { sum }
        };
        let moved = (one(self.place) - self.omega * self.omega * one(self.acceleration), self.omega * one(self.rate));
        (moved, size(moved))
    }
}

/// A sum in twice the digits below this share of its terms is rounding.
const FINE: f64 = 1e-28;

impl Gain<'_> {
    /// How far a unit of a motion moves it, in twice the digits.
    fn along_fine(&self, z: &[Double]) -> Complex {
        let one = |g: &[f64]| {
            let sum = g.iter().zip(z).fold(Double::default(), |s, (g, z)| s.add_times(*g, *z)).round();
            let terms = g.iter().zip(z).fold(0.0, |m, (g, z)| m + (g * z.round()).abs());
            if sum.abs() <= FINE * terms { 0.0 } else { sum }
        };
        (one(self.place) - self.omega * self.omega * one(self.acceleration), self.omega * one(self.rate))
    }
}

/// Pivots of the scaled matrix below this share are zero: a few roundings of its terms.
pub(super) const SINGULAR: f64 = 2e-14;

/// A share of a free oscillation below this moves nothing.
const UNMOVED: f64 = 1e-9;

/// Share of its terms below which a sum of amplitudes is rounding: what the basis of the motions that conditions allow leaves of them, too.
pub(super) const CANCELLED: f64 = 16.0 * f64::EPSILON;

impl Amplitudes {
    /// X, infinite where a pole moves the coordinate.
    pub fn coordinates(&self) -> Vec<Complex> {
        let n = self.regular.len();
        let none = vec![0.0; n];
        let unit = |i: usize| (0..n).map(|k| f64::from(u8::from(k == i))).collect::<Vec<_>>();
        (0..n).map(|i| self.seen(&Gain { place: &unit(i), rate: &none, acceleration: &none, omega: 0.0 })).collect()
    }

    /// The same in other coordinates, X = T Y.
    pub(super) fn mapped(&self, map: impl Fn(&[Complex]) -> Vec<Complex>) -> Amplitudes {
        let real = |z: &[f64]| map(&z.iter().map(|v| (*v, 0.0)).collect::<Vec<_>>()).into_iter().map(|v| v.0).collect();
        Amplitudes {
            regular: map(&self.regular),
            poles: self.poles.iter().map(|p| map(p)).collect(),
            free: self.free.iter().map(|(z, a)| (real(z), *a)).collect(),
            fine: Vec::new(),
            doubt: self.doubt,
        }
    }

    /// Σ g_i X_i, zero where only rounding is left. Real and imaginary part are infinite where a pole moves them, each on its own; the other one is its
    /// limit at ω.
    pub fn seen(&self, gain: &Gain) -> Complex {
        self.seen_in_terms(gain).0
    }

    /// The same with the sum of the absolute terms of its finite part.
    pub fn seen_in_terms(&self, gain: &Gain) -> (Complex, f64) {
        let g = gain.terms();
        let mut infinite = [false; 2];
        for m in 0..self.poles.len() {
            // what stands with δ^-(m + 1)
            let (mut pole, mut terms, mut reach) = ((0.0, 0.0), 0.0, 0.0_f64);
            for (g, p) in g.iter().zip(&self.poles[m..]) {
                let (sum, more) = dot(g, p);
                (pole, terms) = ((pole.0 + sum.0, pole.1 + sum.1), terms + more);
                let biggest = |v: &[Complex]| v.iter().map(|z| size(*z)).fold(0.0, f64::max);
                reach = reach.max(biggest(g) * biggest(p));
            }
            // a finite part with six digits fewer than that is rounding of it
            if terms > 1e-6 * UNMOVED * reach && size(pole) > UNMOVED * terms {
                infinite[0] |= pole.0.abs() > UNMOVED * size(pole);
                infinite[1] |= pole.1.abs() > UNMOVED * size(pole);
            }
        }
        let (mut sum, mut terms) = dot(&g[0], &self.regular);
        for (g, p) in g[1..].iter().zip(&self.poles) {
            let (more, size) = dot(g, p);
            (sum, terms) = ((sum.0 + more.0, sum.1 + more.1), terms + size);
        }
        let bound = CANCELLED * terms;
        for (z, a) in &self.free {
            let (moved, reach) = gain.along(z);
            sum = (sum.0 + moved.0 * a.0 - moved.1 * a.1, sum.1 + moved.0 * a.1 + moved.1 * a.0);
            terms += reach * size(*a);
        }
        for (z, a) in &self.fine {
            let moved = gain.along_fine(z);
            let more = (moved.0 * a.0 - moved.1 * a.1, moved.0 * a.1 + moved.1 * a.0);
            sum = (sum.0 + more.0, sum.1 + more.1);
            terms += size(more);
        }
        // beside an infinite part the finite one stands by itself
        let alone = infinite.contains(&true);
        let part = |value: f64, infinite: bool| match () {
            () if infinite => f64::INFINITY,
            () if (if alone { value.abs() } else { size(sum) }) <= bound.max(4.0 * f64::EPSILON * terms) => 0.0,
            () => value,
        };
        ((part(sum.0, infinite[0]), part(sum.1, infinite[1])), terms)
    }
}

pub(super) fn size(z: Complex) -> f64 {
    elementary::hypot(z.0, z.1)
}

/// Σ a_i b_i and Σ |a_i b_i|.
fn dot(a: &[Complex], b: &[Complex]) -> (Complex, f64) {
    let mut sum = ((0.0, 0.0), 0.0);
    for (x, y) in a.iter().zip(b).filter(|(x, y)| **x != (0.0, 0.0) && **y != (0.0, 0.0)) {
        sum.0 = (sum.0.0 + x.0 * y.0 - x.1 * y.1, sum.0.1 + x.0 * y.1 + x.1 * y.0);
        sum.1 += size(*x) * size(*y);
    }
    sum
}

/// Factors of rows and of columns, powers of 2, that bring the largest entries of a square matrix to size one; a row or column of zeros keeps its own.
pub(super) fn balanced(a: &[f64], n: usize) -> (Vec<f64>, Vec<f64>) {
    let (mut rows, mut columns) = (vec![1.0; n], vec![1.0; n]);
    let power = |v: f64| if v > 0.0 && v.is_finite() { elementary::exp2((-0.5 * elementary::log2(v)).round()) } else { 1.0 };
    for _ in 0..8 {
        for i in 0..n {
            rows[i] *= power((0..n).fold(0.0_f64, |m, j| m.max((a[i * n + j] * rows[i] * columns[j]).abs())));
        }
        for j in 0..n {
            columns[j] *= power((0..n).fold(0.0_f64, |m, i| m.max((a[i * n + j] * rows[i] * columns[j]).abs())));
        }
    }
    (rows, columns)
}

/// Entries of a solution x of A x = b that are rounding only become zero. An entry is known to ε |A⁻¹| (|A| |x| + |b|); its row of the inverse
/// solves Aᵀ y = e_i.
pub(super) fn cleared(a: &[f64], b: &[f64], x: &mut [f64]) {
    let size = x.len();
    let largest = x.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
    // four digits above rounding: such an entry may be nothing but that of the others
    let doubtful: Vec<usize> = (0..size).filter(|i| x[*i] != 0.0 && x[*i].abs() < 1e-12 * largest).collect();
    if doubtful.is_empty() {
        return;
    }
    let row = |i: usize| a[i * size..(i + 1) * size].iter().zip(x.iter()).map(|(a, x)| (a * x).abs()).sum::<f64>();
    let terms: Vec<f64> = (0..size).map(|i| row(i) + b[i].abs()).collect();
    let transposed = Lu::new(&turned(a, size), size);
    for i in doubtful {
        let unit: Vec<f64> = (0..size).map(|k| f64::from(u8::from(k == i))).collect();
        let Some(row) = transposed.solve(&unit) else { continue };
        let bound: f64 = row.iter().zip(&terms).map(|(r, t)| (r * t).abs()).sum();
        if x[i].abs() <= 4.0 * f64::EPSILON * bound {
            x[i] = 0.0;
        }
    }
}

pub(super) fn turned(a: &[f64], n: usize) -> Vec<f64> {
    (0..n * n).map(|p| a[(p % n) * n + p / n]).collect()
}
