//! Whether found solutions of K x = lambda M x are solutions, and whether none below them is missing; independent of how they were found.
//!
//! With r = K x - lambda M x (in twice the digits) and any sigma for which K - sigma M is positive definite, an eigenvalue lies within
//!
//! ```text
//! |lambda_j - lambda| <= |lambda_j - sigma| |(K - sigma M)⁻¹ r| / |x|        norms |x|² = xᵀ M x
//! |lambda_j - lambda| <= sqrt(rᵀ M⁻¹ r) / |x|
//! ```
//!
//! A value of exactly zero with K x that is rounding of its terms is that of a free motion and has no bound but this.
//! (K - sigma M)⁻¹ M and M⁻¹ K are self-adjoint in this inner product; the first bound is sharp for low modes, the second for high ones. The
//! number of eigenvalues below s is the number of negative pivots of K - s M (Sylvester's law of inertia, Sturm's count).
//! *Source*: B. N. Parlett, The Symmetric Eigenvalue Problem, 3.3, 4.5, 15.

use crate::Trouble;
use crate::eigen::Modes;
use crate::factor::Factored;
use crate::kernels::dot;
use crate::lanczos::positive;
use crate::sparse::Sparse;

/// What the check found.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Certificate {
    /// Bound of the relative error of each eigenvalue by its residual.
    pub residuals: Vec<f64>,
    /// Eigenvalues found below the limit of the count, and eigenvalues that are there; none when no limit gave a certain count.
    pub count: Option<(usize, usize)>,
}

/// Largest bound by the residual: the squares of frequencies are right to eight digits, mostly to twice as many.
pub const RESIDUAL: f64 = 1e-8;
/// Relative distance of neighbours between which a limit of the count fits.
const GAP: f64 = 1e-3;
/// Places of the limit in a gap, tried until no pivot vanishes.
const PLACES: [f64; 4] = [0.4, 0.55, 0.25, 0.7];

/// Checks the first `wanted` solutions; further ones may be given, which let the count reach above the last wanted one.
///
/// *Shapes*: M positive semidefinite, eigenvalues ascending. *Errors*: memory, K and M that vanish for the same motion.
pub fn certify(k: &Sparse, m: &Sparse, modes: &Modes, wanted: usize) -> Result<Certificate, Trouble> {
    let wanted = wanted.min(modes.values.len());
    if modes.n == 0 {
        // nothing can be missing where nothing moves
        return Ok(Certificate { residuals: Vec::new(), count: Some((0, 0)) });
    }
    if wanted == 0 {
        return Ok(Certificate::default());
    }
    let (factor, shift) = positive(k, m, &mut Default::default())?;
    let masses = Factored::new(m, None)?;
    let masses = masses.defect().is_none().then_some(masses);
    let residuals = (0..wanted).map(|j| residual((k, m), modes, j, (&factor, shift), masses.as_ref())).collect();
    let limits = limits(&modes.values, wanted, shift, modes.n);
    let count = limits.into_iter().find_map(|(limit, expected)| Some((expected, below(k, m, limit, &factor)?)));
    Ok(Certificate { residuals, count })
}

/// Number of eigenvalues below a limit; none when a pivot vanishes.
fn below(k: &Sparse, m: &Sparse, limit: f64, plan: &Factored) -> Option<usize> {
    let shifted = k.sum(1.0, m, -limit);
    if shifted.size() == 1 {
        // its only entry is its pivot
        return Some(shifted.diagonal().iter().filter(|d| **d < 0.0).count());
    }
    let (below, certain) = Factored::new(&shifted, Some(plan)).ok()?.inertia();
    certain.then_some(below)
}

/// The smaller of both bounds, relative to the distance from the shift.
fn residual((k, m): (&Sparse, &Sparse), modes: &Modes, j: usize, (factor, shift): (&Factored, f64), masses: Option<&Factored>) -> f64 {
    let (x, value) = (modes.shape(j), modes.values[j]);
    let rest = k.defect(m, value, x);
    if value == 0.0
        && let Some(share) = free(k, x, &rest)
    {
        return share;
    }
    let length = dot(x, &m.product(x)).max(0.0).sqrt();
    let mut low = rest.clone();
    factor.solve(&mut low, 1);
    let bound = dot(&low, &m.product(&low)).max(0.0).sqrt() / length;
    let high = masses.map_or(f64::INFINITY, |masses| {
        let mut solved = rest.clone();
        masses.solve(&mut solved, 1);
        dot(&rest, &solved).max(0.0).sqrt() / (length * (value - shift).abs())
    });
    let least = bound.min(high);
    if least.is_nan() { f64::INFINITY } else { least }
}

/// K x of a free motion as a share of its terms, where it is no more than rounding of K's entries: nothing restores the motion as far as the numbers know. No
/// shift says more, as the bound divides that rounding by it.
fn free(k: &Sparse, x: &[f64], rest: &[f64]) -> Option<f64> {
    let mut terms = vec![0.0; x.len()];
    for j in 0..x.len() {
        for (i, v) in k.column(j) {
            terms[i] += (v * x[j]).abs();
            if i != j {
                terms[j] += (v * x[i]).abs();
            }
        }
    }
    let largest = terms.iter().copied().fold(0.0, f64::max);
    let share = rest.iter().fold(0.0_f64, |m, r| m.max(r.abs())) / largest;
    (share <= ENTRIES).then_some(share)
}

/// Rounding of a stiffness that is a sum of some dozens of terms, and of a shape.
const ENTRIES: f64 = 64.0 * f64::EPSILON;

/// Limits of the count with the number of found eigenvalues below each: in the first wide gap above the wanted ones, else in the nearest
/// below, else below all. Above all n eigenvalues nothing can be missing.
pub(super) fn limits(values: &[f64], wanted: usize, shift: f64, n: usize) -> Vec<(f64, usize)> {
    let wide = |j: &usize| values[*j] - values[*j - 1] > GAP * (values[*j] - shift).abs();
    let above = (wanted..values.len()).find(|j| *j > 0 && wide(j));
    let j = above.or_else(|| (1..wanted).rev().find(wide));
    let top = values[values.len() - 1];
    let (low, high, expected) = match j {
        _ if values.len() == n && top > shift => (top, top + (top - shift), n),
        Some(j) => (values[j - 1], values[j], j),
        None => (shift, values[0], 0),
    };
    PLACES.iter().map(|place| (low + place * (high - low), expected)).collect()
}

impl Certificate {
    /// Largest bound.
    pub fn worst(&self) -> f64 {
        self.residuals.iter().fold(0.0, |m, r| m.max(*r))
    }

    /// Number of eigenvalues that lie below the i-th found one: i, and those that the count has more.
    pub fn below(&self, i: usize) -> Option<usize> {
        self.count.map(|(expected, counted)| (i + counted).saturating_sub(expected))
    }

    /// Number of eigenvalues that the count has more or fewer than were found; 1 when there was no certain count.
    pub fn missing(&self) -> usize {
        self.count.map_or(1, |(expected, counted)| expected.abs_diff(counted))
    }

    /// Whether the residuals are small and the number is right.
    pub fn passes(&self) -> [bool; 2] {
        [self.worst() <= RESIDUAL, self.missing() == 0]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::eigen;

    /// A chain of n equal masses and springs: lambda_j = 4 sin²(j pi/(2 n + 2)).
    fn chain(n: usize) -> (Sparse, Sparse, Modes) {
        let entry = |i: usize, j: usize| if i == j { 2.0 } else { -f64::from(u8::from(i.abs_diff(j) == 1)) };
        let k: Vec<f64> = (0..n * n).map(|e| entry(e / n, e % n)).collect();
        let m: Vec<f64> = (0..n * n).map(|e| f64::from(u8::from(e / n == e % n))).collect();
        let modes = eigen::symmetric(n, &k, &m).unwrap();
        (Sparse::from_dense(n, &k).unwrap(), Sparse::from_dense(n, &m).unwrap(), modes)
    }

    fn without(modes: &Modes, skipped: usize) -> Modes {
        let kept: Vec<usize> = (0..modes.values.len()).filter(|j| *j != skipped).collect();
        Modes {
            n: modes.n,
            values: kept.iter().map(|j| modes.values[*j]).collect(),
            vectors: kept.iter().flat_map(|j| modes.shape(*j).to_vec()).collect(),
        }
    }

    #[test]
    fn right_modes_pass() {
        let (k, m, modes) = chain(12);
        for wanted in [1, 5, 12] {
            let found = certify(&k, &m, &modes, wanted).unwrap();
            assert_eq!(found.passes(), [true, true], "{found:?}");
            assert_eq!(found.below(wanted - 1), Some(wanted - 1));
        }
    }

    #[test]
    fn one_and_two_freedoms_are_counted() {
        for n in [1, 2, 3] {
            let (k, m, modes) = chain(n);
            let found = certify(&k, &m, &modes, n).unwrap();
            assert_eq!(found.passes(), [true, true], "{n}: {found:?}");
        }
    }

    #[test]
    fn every_skipped_mode_is_counted() {
        let (k, m, modes) = chain(12);
        for skipped in 0..6 {
            let found = certify(&k, &m, &without(&modes, skipped), 6).unwrap();
            assert_eq!(found.passes(), [true, false], "{skipped}: {found:?}");
            assert_eq!(found.below(5), Some(6));
        }
    }

    #[test]
    fn a_wrong_value_or_shape_has_a_residual() {
        let (k, m, modes) = chain(12);
        let mut value = modes.clone();
        value.values[2] *= 1.0 + 1e-6;
        assert!(!certify(&k, &m, &value, 6).unwrap().passes()[0]);
        let mut shape = modes.clone();
        shape.vectors[3 * 12 + 4] += 1e-5;
        assert!(!certify(&k, &m, &shape, 6).unwrap().passes()[0]);
    }

    /// Free motions with K x of rounding: with the value zero they pass, with one of 1e-6 of the stiffness they do not.
    #[test]
    fn free_motions_by_cancellation_pass_at_zero_only() {
        let (s, c) = (0.3_f64.sin(), 0.3_f64.cos());
        // a spring across two free points, its direction rounded
        let d = [c, s, -c, -s];
        let k: Vec<f64> = (0..16).map(|e| 4e3 * d[e / 4] * d[e % 4]).collect();
        let m: Vec<f64> = (0..16).map(|e| f64::from(u8::from(e / 4 == e % 4))).collect();
        let mut modes = eigen::symmetric(4, &k, &m).unwrap();
        let pencil = [&k, &m].map(|a| Sparse::from_dense(4, a).unwrap());
        modes.values[..3].fill(0.0);
        // residuals of a few rows relative to their terms: rounding
        assert!(certify(&pencil[0], &pencil[1], &modes, 4).unwrap().worst() < 1e-13);
        modes.values[1] = 4e-3;
        assert!(certify(&pencil[0], &pencil[1], &modes, 4).unwrap().worst() > RESIDUAL);
        modes.values[1] = 0.0;
        let wrong = modes.shape(3).to_vec();
        modes.vectors[..4].copy_from_slice(&wrong);
        assert!(certify(&pencil[0], &pencil[1], &modes, 4).unwrap().worst() > RESIDUAL);
    }

    #[test]
    fn free_motions_and_repeated_values_are_counted() {
        // two equal free pairs: 0, 0, 2, 2
        let k = [1.0, -1.0, 0.0, 0.0, -1.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, -1.0, 0.0, 0.0, -1.0, 1.0];
        let m: Vec<f64> = (0..16).map(|e| f64::from(u8::from(e / 4 == e % 4))).collect();
        let modes = eigen::symmetric(4, &k, &m).unwrap();
        let (k, m) = (Sparse::from_dense(4, &k).unwrap(), Sparse::from_dense(4, &m).unwrap());
        assert_eq!(certify(&k, &m, &modes, 4).unwrap().passes(), [true, true]);
        assert_eq!(certify(&k, &m, &modes, 3).unwrap().passes(), [true, true]);
        assert!(!certify(&k, &m, &without(&modes, 0), 3).unwrap().passes()[1]);
    }

    /// Equal oscillators beside one another, and one that stands apart from a chain.
    #[test]
    fn uncoupled_motions_are_counted() {
        for n in [2, 3, 5] {
            let identity: Vec<f64> = (0..n * n).map(|e| f64::from(u8::from(e / n == e % n))).collect();
            let k: Vec<f64> = identity.iter().map(|e| 20_689.3 * e).collect();
            let modes = eigen::symmetric(n, &k, &identity).unwrap();
            let pencil = [&k, &identity].map(|a| Sparse::from_dense(n, a).unwrap());
            let found = certify(&pencil[0], &pencil[1], &modes, n).unwrap();
            assert_eq!(found.count, Some((n, n)), "{n}");
        }
    }
}
