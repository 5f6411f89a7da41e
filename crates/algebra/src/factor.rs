//! S A S = L D Lᵀ of a sparse symmetric matrix, S diagonal in powers of two: solutions, number of negative eigenvalues, free motions.
//!
//! Without exchange of rows across supernodes: exact enough for positive definite matrices, and for K - sigma M away from eigenvalues.
//! The number of negative pivots is the number of negative eigenvalues (Sylvester's law of inertia).

use crate::Trouble;
use crate::elementary;
use crate::kernels::{self, Plan};
use crate::sparse::Sparse;
use crate::trouble::{Defect, Pivot};

/// A pivot of the scaled matrix (diagonal near 1) below this is a vanishing one: elimination leaves some 1e-16 of a true zero, and a
/// cantilever of 1000 elements 1e-9 of its stiffness.
const SMALLEST: f64 = 1e-13;

/// A factored matrix.
#[derive(Clone, Debug)]
pub struct Factored {
    plan: Plan,
    factor: kernels::Factor,
    /// Diagonal of S.
    scales: Vec<f64>,
}

/// 2^k near 1 / sqrt(size), so that scaling rounds nothing; 1 for zero.
pub(super) fn scale(size: f64) -> f64 {
    if size.is_normal() { elementary::exp2((-0.5 * elementary::log2(size.abs())).round()) } else { 1.0 }
}

impl Factored {
    /// Factors a matrix, with the plan of an earlier one of the same pattern when given. Vanishing pivots are held, see [`Factored::defect`].
    pub(super) fn new(a: &Sparse, plan: Option<&Factored>) -> Result<Factored, Trouble> {
        let scales: Vec<f64> = match plan {
            Some(earlier) => earlier.scales.clone(),
            None => a.diagonal().into_iter().map(scale).collect(),
        };
        let plan = match plan {
            Some(earlier) => earlier.plan.clone(),
            None => Plan::new(a.columns(), None).ok_or(Trouble::Memory)?,
        };
        let mut values = Vec::with_capacity(a.stored());
        for j in 0..a.size() {
            values.extend(a.column(j).map(|(i, v)| scales[i] * v * scales[j]));
        }
        let factor = plan.factor(a.columns(), &values, SMALLEST).ok_or(Trouble::Memory)?;
        Ok(Factored { plan, factor, scales })
    }

    /// The first pivot that vanishes or is negative.
    pub(super) fn defect(&self) -> Option<Pivot> {
        let pivots = self.factor.pivots();
        let held = self.factor.held();
        let k = pivots.iter().position(|&d| d < 0.0).into_iter().chain(held.first().copied()).min()?;
        let defect = if held.contains(&k) { Defect::Singular } else { Defect::Negative };
        Some(Pivot { row: self.factor.row(k), defect, motion: self.motion(k) })
    }

    fn motion(&self, k: usize) -> Vec<f64> {
        let scaled = self.factor.motion(k);
        let largest = scaled.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
        let motion: Vec<f64> = scaled.iter().zip(&self.scales).map(|(v, s)| v * s).collect();
        // 1 where the scaled motion is largest
        let i = scaled.iter().position(|v| v.abs() == largest).unwrap_or(0);
        let unit = if motion[i] != 0.0 { motion[i] } else { 1.0 };
        motion.iter().map(|v| v / unit).collect()
    }

    /// Number of negative eigenvalues, and whether no pivot vanished, so that the number is certain.
    pub(super) fn inertia(&self) -> (usize, bool) {
        (self.factor.pivots().iter().filter(|&&d| d < 0.0).count(), self.factor.held().is_empty())
    }

    /// Numbers in the factor.
    pub fn size(&self) -> usize {
        self.plan.size()
    }

    /// Solves A X = B in place for `count` right sides, one after another.
    pub fn solve(&self, b: &mut [f64], count: usize) {
        let scaled =
            |b: &mut [f64]| b.chunks_mut(self.scales.len().max(1)).for_each(|c| c.iter_mut().zip(&self.scales).for_each(|(v, s)| *v *= s));
        scaled(b);
        self.factor.solve(b, count);
        scaled(b);
    }
}

impl Sparse {
    /// Factors the matrix for static problems: L D Lᵀ of the scaled matrix.
    ///
    /// *Errors*: the first pivot that vanishes or is negative, with its row and the free motion.
    pub fn factor(&self) -> Result<Factored, Trouble> {
        let factored = Factored::new(self, None)?;
        match factored.defect() {
            Some(pivot) => Err(Trouble::Pivot(pivot)),
            None => Ok(factored),
        }
    }

    /// Solution of A x = b for a positive definite matrix. *Errors*: as [`Sparse::factor`].
    pub fn solve(&self, b: &[f64]) -> Result<Vec<f64>, Trouble> {
        if b.len() != self.size() || b.iter().any(|v| !v.is_finite()) {
            return Err(Trouble::Malformed("b"));
        }
        let mut x = b.to_vec();
        self.factor()?.solve(&mut x, 1);
        Ok(x)
    }
}
