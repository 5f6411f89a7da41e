//! Weak springs and dampers beside hard ones: coordinates in which neither hides the other.
//!
//! A spring of 10⁻² N/m beside one of 10¹² N/m lies below the last digit of their sum, and no study can find it there. The sum itself is a formula: where it is
//! one of numbers alone, it is evaluated in twice the digits, C = C₁ + C₂. Then C = L D Lᵀ is eliminated in twice the digits, the pivot that has kept the largest
//! share of its diagonal first, and with q = L⁻ᵀ y
//!
//! ```text
//! C becomes D, diagonal, its numbers right to their last digit; M becomes L⁻¹ M L⁻ᵀ, B and the loads alike.
//! ```
//!
//! A pivot below 10⁻²⁸ of its terms is zero: nothing restores that motion. The free motions are made orthogonal to the others in M, so that these keep a
//! stiffness that is positive definite.
//!
//! Dampers are the same: B = L D Lᵀ of its symmetric part, where it is B that hides a weak part and not C. Motions that nothing resists need no more than that their
//! pivot is zero.
//!
//! *Source*: N. J. Higham, Accuracy and Stability of Numerical Algorithms, ch. 10; J. Barlow, J. Demmel, Computing accurate eigensystems of scaled diagonally
//! dominant matrices, SIAM J. Numer. Anal. 27 (1990).

use super::matrices::{Harmonic, Matrices, parts};
use algebra::cholesky::positive_definite;
use algebra::double::Double;
use algebra::elementary;

/// A pivot below this share of its terms is what 32 digits leave of zero.
const NOTHING: f64 = 1e-28;
/// Where a pivot keeps less than this share of its diagonal, single numbers have less than six digits of it.
const LOST: f64 = 1e-10;
/// Where each pivot keeps this share of its diagonal, single numbers have ten digits left for the weakest spring.
const PLAIN: f64 = 1e-6;

/// The matrices in coordinates y with q = Z y.
pub struct Graded {
    /// Z, row-major n x n, in twice the digits: a weak spring shows in what Z bends the hard ones by.
    pub basis: Vec<Double>,
    /// In the coordinates y.
    pub matrices: Matrices,
    /// Which matrix is diagonal in them.
    pub by: By,
}

/// What the coordinates stand apart for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum By {
    /// C.
    Stiffness,
    /// B, but for gyroscopic forces.
    Damping,
}

/// Pivots and L⁻ᵀ, in the order of the coordinates.
struct Eliminated {
    pivots: Vec<Double>,
    basis: Vec<Double>,
}

impl Matrices {
    /// C in twice the digits, as far as they are known.
    fn fine(&self) -> Vec<Double> {
        both(&self.stiffness, &self.below)
    }

    /// B in twice the digits, as far as they are known.
    pub fn fine_damping(&self) -> Vec<Double> {
        both(&self.damping, &self.damping_below)
    }

    /// Whether dampers take energy in every motion, or in none give any: B without a negative direction.
    pub fn calm(&self) -> bool {
        let n = self.n;
        let (damping, _) = parts(&self.damping, n);
        if !self.damping_below.is_empty() {
            return eliminated(&even(&self.fine_damping(), n), n).is_some_and(|found| found.pivots.iter().all(|d| d.round() >= 0.0));
        }
        damping.iter().all(|b| *b == 0.0) || positive_definite(&damping, n) != Some(false)
    }

    /// Whether C is positive definite (its symmetric part is); none where it is singular.
    pub fn definite(&self) -> Option<bool> {
        let n = self.n;
        match self.by_stiffness() {
            // a diagonal says it entry by entry
            Some(Graded { matrices, .. }) => {
                let own = || (0..n).map(|i| matrices.stiffness[i * n + i]);
                if own().any(|d| d < 0.0) { Some(false) } else { own().all(|d| d > 0.0).then_some(true) }
            }
            None => positive_definite(&parts(&self.stiffness, n).0, n),
        }
    }

    /// Whether single numbers leave less than six digits of a weak spring that twice the digits know.
    pub fn loses(&self) -> bool {
        let n = self.n;
        !self.below.is_empty() && weak(&self.fine(), n, LOST)
            || !self.damping_below.is_empty() && weak(&even(&self.fine_damping(), n), n, LOST)
    }

    /// The same machine in coordinates in which weak and hard springs, or weak and hard dampers, stand apart; none where single numbers hold both, or where what is
    /// hidden is not known.
    pub fn graded(&self) -> Option<Graded> {
        self.by_stiffness().or_else(|| self.by_damping())
    }

    /// By the dampers.
    fn by_damping(&self) -> Option<Graded> {
        let n = self.n;
        if self.damping_below.is_empty() || !hides(&parts(&self.damping, n).0, n) {
            return None;
        }
        let whole = self.fine_damping();
        let b = even(&whole, n);
        let Eliminated { pivots, basis } = eliminated(&b, n)?;
        // motions that nothing resists hide nothing
        if (0..n).all(|i| pivots[i].is_zero() || pivots[i].round().abs() > PLAIN * b[i * n + i].round().abs()) {
            return None;
        }
        let turning: Vec<Double> = whole.iter().zip(&b).map(|(a, even)| a.less(*even)).collect();
        let mut damping: Vec<f64> = congruence(&basis, &turning, n).iter().map(|v| v.round()).collect();
        (0..n).for_each(|i| damping[i * n + i] = pivots[i].round());
        let matrices = Matrices { damping, damping_below: vec![0.0; n * n], ..self.within(&basis) };
        Some(Graded { matrices, basis, by: By::Damping })
    }

    /// In coordinates of these columns.
    fn within(&self, basis: &[Double]) -> Matrices {
        let n = self.n;
        let vector = |v: &[f64]| -> Vec<f64> {
            (0..n).map(|k| (0..n).fold(Double::default(), |sum, i| sum.add_times(v[i], basis[i * n + k])).round()).collect()
        };
        let square = |a: &[Double]| congruence(basis, a, n);
        let rounded = |a: &[Double]| square(a).iter().map(|v| v.round()).collect::<Vec<f64>>();
        let (damping, low): (Vec<f64>, Vec<f64>) = square(&self.fine_damping()).iter().map(|v| v.parts()).map(|[a, b]| (a, b)).unzip();
        Matrices {
            n,
            mass: rounded(&both(&self.mass, &[])),
            damping,
            damping_below: if self.damping_below.is_empty() { Vec::new() } else { low },
            damping_open: self.damping_open,
            stiffness: rounded(&self.fine()),
            force: vector(&self.force),
            loads: self.loads.iter().map(|l| Harmonic { rate: l.rate, cos: vector(&l.cos), sin: vector(&l.sin) }).collect(),
            shaped: self.shaped.iter().map(|(form, factors)| (*form, vector(factors))).collect(),
            ..Matrices::default()
        }
    }

    /// By the springs.
    fn by_stiffness(&self) -> Option<Graded> {
        let n = self.n;
        if self.below.is_empty() || !hides(&self.stiffness, n) {
            return None;
        }
        let c = self.fine();
        let size = |i: usize| c[i * n + i].round().abs();
        let alike = |p: usize| {
            let (i, j) = (p / n, p % n);
            c[p].less(c[j * n + i]).round().abs() <= NOTHING * (size(i) * size(j)).sqrt()
        };
        let Eliminated { mut pivots, mut basis } = (0..n * n).all(alike).then(|| eliminated(&c, n)).flatten()?;
        let free: Vec<bool> = pivots.iter().map(|d| d.is_zero()).collect();
        // motions that nothing restores hide nothing
        if (0..n).all(|i| free[i] || pivots[i].round().abs() > PLAIN * size(i)) {
            return None;
        }
        let mass: Vec<Double> = self.mass.iter().map(|v| Double::from(*v)).collect();
        part(&mut basis, &mass, &free)?;
        level(&mut basis, &mut pivots);
        let mut matrices = self.within(&basis);
        for p in (0..n * n).filter(|p| free[p / n] != free[p % n]) {
            matrices.mass[p] = 0.0;
        }
        let diagonal = |p: usize| if p / n == p % n { pivots[p / n].round() } else { 0.0 };
        matrices.stiffness = (0..n * n).map(diagonal).collect();
        Some(Graded { basis, matrices, by: By::Stiffness })
    }
}

/// Whether elimination leaves a pivot of at most this share of its diagonal that is more than nothing.
fn weak(a: &[Double], n: usize, share: f64) -> bool {
    let size = |i: usize| a[i * n + i].round().abs();
    eliminated(a, n).is_some_and(|e| (0..n).any(|i| !e.pivots[i].is_zero() && e.pivots[i].round().abs() <= share * size(i)))
}

/// Whether a weak damper stands beside a hard one in B of these two parts.
pub(super) fn has_weak_damper(high: &[f64], low: &[f64], n: usize) -> bool {
    weak(&even(&both(high, low), n), n, PLAIN)
}

/// A matrix in twice the digits, as far as they are known.
fn both(high: &[f64], low: &[f64]) -> Vec<Double> {
    high.iter().enumerate().map(|(p, high)| Double::of(*high, low.get(p).copied().unwrap_or(0.0))).collect()
}

/// (A + Aᵀ)/2.
fn even(a: &[Double], n: usize) -> Vec<Double> {
    let half = Double::from(0.5);
    (0..n * n).map(|p| a[p].sum(a[(p % n) * n + p / n]).times(half)).collect()
}

/// Whether elimination in single numbers leaves a pivot six digits and more below its diagonal, the largest share first.
pub(super) fn hides(stiffness: &[f64], n: usize) -> bool {
    let mut rest = stiffness.to_vec();
    let terms: Vec<f64> = (0..n).map(|i| stiffness[i * n + i].abs()).collect();
    let mut left: Vec<usize> = (0..n).filter(|i| terms[*i] > 0.0).collect();
    let share = |rest: &[f64], i: usize| rest[i * n + i].abs() / terms[i];
    while let Some(k) = left.iter().copied().max_by(|i, j| share(&rest, *i).total_cmp(&share(&rest, *j))) {
        if share(&rest, k) <= PLAIN {
            return true;
        }
        left.retain(|i| *i != k);
        for i in &left {
            let factor = rest[i * n + k] / rest[k * n + k];
            if factor != 0.0 {
                left.iter().for_each(|j| rest[i * n + j] -= factor * rest[k * n + j]);
            }
        }
    }
    false
}

/// L D Lᵀ with the largest remaining share of the diagonal as the next pivot; none where what is left has no diagonal but couplings.
fn eliminated(c: &[Double], n: usize) -> Option<Eliminated> {
    let mut rest = c.to_vec();
    let one = Double::from(1.0);
    let mut basis: Vec<Double> = (0..n * n).map(|p| if p / n == p % n { one } else { Double::default() }).collect();
    let mut pivots = vec![Double::default(); n];
    let terms: Vec<f64> = (0..n).map(|i| c[i * n + i].round().abs()).collect();
    let share = |rest: &[Double], i: usize| if terms[i] > 0.0 { rest[i * n + i].round().abs() / terms[i] } else { 0.0 };
    let mut left: Vec<usize> = (0..n).collect();
    while let Some(k) = left.iter().copied().max_by(|i, j| share(&rest, *i).total_cmp(&share(&rest, *j)).then(j.cmp(i))) {
        if share(&rest, k) <= NOTHING {
            break;
        }
        left.retain(|i| *i != k);
        let pivot = rest[k * n + k];
        pivots[k] = pivot;
        for i in &left {
            let factor = rest[i * n + k].over(pivot);
            if factor.is_zero() {
                continue;
            }
            let minus = factor.negated();
            for j in &left {
                rest[i * n + j] = rest[i * n + j].plus(minus, rest[k * n + j]);
            }
            // q_k follows y_k - Σ l_ik q_i: columns of L⁻ᵀ
            for r in 0..n {
                basis[r * n + i] = basis[r * n + i].plus(minus, basis[r * n + k]);
            }
        }
    }
    let nothing = |i: usize, j: usize| rest[i * n + j].round().abs() <= NOTHING * (terms[i] * terms[j]).sqrt();
    left.iter().all(|i| left.iter().all(|j| nothing(*i, *j))).then_some(Eliminated { pivots, basis })
}

/// Makes the motions with a stiffness orthogonal to the free ones: z ← z - Z₀ (Z₀ᵀ M Z₀)⁻¹ Z₀ᵀ M z; none where the free ones have no inertia.
fn part(basis: &mut [Double], mass: &[Double], free: &[bool]) -> Option<()> {
    let n = free.len();
    let column = |basis: &[Double], j: usize| -> Vec<Double> { (0..n).map(|i| basis[i * n + j]).collect() };
    let dot = |a: &[Double], b: &[Double]| a.iter().zip(b).fold(Double::default(), |sum, (x, y)| sum.plus(*x, *y));
    let heavy = |x: &[Double]| -> Vec<Double> { mass.chunks(n).map(|row| dot(row, x)).collect() };
    // an orthogonal basis of the free motions, then every other column without them; twice, so that rounding of the first is gone
    let mut done: Vec<(Vec<Double>, Vec<Double>, Double)> = Vec::new();
    let order = (0..n).filter(|j| free[*j]).chain((0..n).filter(|j| !free[*j]));
    for j in order.collect::<Vec<_>>() {
        let mut x = column(basis, j);
        for _ in 0..2 {
            for (z, mz, size) in &done {
                let minus = dot(mz, &x).over(*size).negated();
                x.iter_mut().zip(z).for_each(|(x, z)| *x = x.plus(minus, *z));
            }
        }
        (0..n).for_each(|i| basis[i * n + j] = x[i]);
        if free[j] {
            let mx = heavy(&x);
            let size = dot(&x, &mx);
            if size.round() <= 0.0 {
                return None;
            }
            done.push((x, mx, size));
        }
    }
    Some(())
}

/// Brings all stiffnesses to the size of one by powers of two, which round nothing: a hard spring is bent by as little as its force needs, and that little must not
/// be rounding of what a weak one is bent by.
fn level(basis: &mut [Double], pivots: &mut [Double]) {
    let n = pivots.len();
    for j in 0..n {
        if pivots[j].is_zero() {
            continue;
        }
        let factor = Double::from(elementary::exp2((-0.5 * elementary::log2(pivots[j].round().abs())).round()));
        pivots[j] = pivots[j].times(factor).times(factor);
        (0..n).for_each(|i| basis[i * n + j] = basis[i * n + j].times(factor));
    }
}

impl Graded {
    /// Z in single numbers.
    pub fn rounded(&self) -> Vec<f64> {
        self.basis.iter().map(|v| v.round()).collect()
    }
}

/// Zᵀ A Z.
fn congruence(basis: &[Double], a: &[Double], n: usize) -> Vec<Double> {
    let product = |left: &dyn Fn(usize, usize) -> Double, right: &[Double]| -> Vec<Double> {
        (0..n * n).map(|p| (0..n).fold(Double::default(), |sum, k| sum.plus(left(p / n, k), right[k * n + p % n]))).collect()
    };
    let az = product(&|i, k| a[i * n + k], basis);
    product(&|i, k| basis[k * n + i], &az)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Three masses in line: a weak spring to the ground, hard ones between.
    fn chain(weak: f64, hard: f64) -> Matrices {
        let fine = [
            [Double::of(hard, weak), Double::from(-hard), Double::default()],
            [Double::from(-hard), Double::from(2.0 * hard), Double::from(-hard)],
            [Double::default(), Double::from(-hard), Double::from(hard)],
        ]
        .concat();
        let stiffness: Vec<f64> = fine.iter().map(|v| v.round()).collect();
        let below = fine.iter().zip(&stiffness).map(|(v, s)| v.less(Double::from(*s)).round()).collect();
        Matrices {
            n: 3,
            mass: vec![1.0, 0.0, 0.0, 0.0, 2.0, 0.0, 0.0, 0.0, 1e-6],
            damping: vec![0.0; 9],
            stiffness,
            below,
            force: vec![0.0; 3],
            ..Matrices::default()
        }
    }

    #[test]
    fn a_weak_spring_keeps_its_digits() {
        for weak in [1e-2, 1.0, 1e-9] {
            let found = chain(weak, 1e12).graded().unwrap();
            // the masses together on the weak spring: y of M y'' + D y = 0 is a mode of its own but for 1e-12
            let ratio = |i: usize| found.matrices.stiffness[4 * i] / found.matrices.mass[4 * i];
            let least = (0..3).map(ratio).fold(f64::INFINITY, f64::min);
            // the hard springs give way by 1e-12 of it at most
            assert!((least * 3.000_001 / weak - 1.0).abs() < 1e-10, "{weak} {:?}", found.matrices.stiffness);
        }
        // a motion that nothing restores hides nothing
        assert!(chain(0.0, 1e12).graded().is_none());
        // one decade between the springs hides nothing
        assert!(chain(0.1, 1.0).graded().is_none());
    }
    /// Two pairs on hard springs with a weak one between them, held by nothing: one motion is free, exactly and without coupling to the weak one.
    #[test]
    fn a_free_motion_beside_a_weak_spring() {
        let (weak, hard) = (1e-3, 1e12);
        let own = Double::of(hard, weak);
        let (none, minus, soft, plain) = (Double::default(), Double::from(-hard), Double::from(-weak), Double::from(hard));
        let fine = [[plain, minus, none, none], [minus, own, soft, none], [none, soft, own, minus], [none, none, minus, plain]].concat();
        let stiffness: Vec<f64> = fine.iter().map(|v| v.round()).collect();
        let below = fine.iter().zip(&stiffness).map(|(v, s)| v.less(Double::from(*s)).round()).collect();
        let mass = (0..16).map(|p| f64::from(u8::from(p / 4 == p % 4))).collect();
        let whole = Matrices { n: 4, mass, damping: vec![0.0; 16], stiffness, below, force: vec![0.0; 4], ..Matrices::default() };
        let found = whole.graded().unwrap().matrices;
        let loose: Vec<usize> = (0..4).filter(|i| found.stiffness[5 * i] == 0.0).collect();
        assert_eq!(loose.len(), 1);
        assert!((0..4).filter(|j| *j != loose[0]).all(|j| found.mass[4 * loose[0] + j] == 0.0));
        // two pairs of 2 kg against each other: ω² = 2 k/2 kg
        let ratio = |i: usize| found.stiffness[5 * i] / found.mass[5 * i];
        let least = (0..4).filter(|i| *i != loose[0]).map(ratio).fold(f64::INFINITY, f64::min);
        // the hard springs give way by 1e-15 of it
        assert!((least / weak - 1.0).abs() < 1e-10, "{least}");
    }
}
