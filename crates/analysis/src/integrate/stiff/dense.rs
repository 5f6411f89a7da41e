//! The collocation polynomial in Legendre's form: decay of its coefficients, and how it goes on after the step.

use super::radau::{Tableau, legendre};
use super::scales::Scales;
use algebra::elementary;

/// Legendre coefficients 0 ... s of some functions on a step.
#[derive(Clone, Debug, Default)]
pub(super) struct Dense {
    /// Length of the step.
    pub(super) h: f64,
    width: usize,
    coefficients: Vec<f64>,
}

impl Dense {
    pub(super) fn new(n: usize, stages: usize) -> Dense {
        Dense { h: 0.0, width: stages + 1, coefficients: vec![0.0; n * (stages + 1)] }
    }
    pub(super) fn row(&self, k: usize) -> &[f64] {
        &self.coefficients[k * self.width..(k + 1) * self.width]
    }
    pub(super) fn fill(&mut self, k: usize, tableau: &Tableau, first: f64, values: impl Iterator<Item = f64>) {
        let row = &mut self.coefficients[k * self.width..(k + 1) * self.width];
        tableau.to_legendre(first, values, row);
    }

    /// Factor by which the step may grow: |a_k| <= tol^(k/s) A for k = s - 1, s.
    pub(super) fn growth(&self, scales: &Scales) -> f64 {
        let s = self.width - 1;
        let worst = |k: usize| {
            let share = |i: usize| self.row(i)[k].abs() / scales.of[i];
            (0..scales.of.len()).map(share).fold(0.0, |m, q| if q <= m { m } else { q })
        };
        factor(worst(s), scales.tolerance, (s, s)).min(factor(worst(s - 1), scales.tolerance, (s - 1, s)))
    }

    /// The polynomial of function k at `theta` steps after its start, minus its value at 1: series cut at its smallest term, because far outside
    /// the step the last coefficients are noise.
    pub(super) fn beyond(&self, k: usize, farthest: usize, values: &[Vec<f64>]) -> Vec<f64> {
        let row = self.row(k);
        let term = |j: usize| row[j].abs() * values[farthest][j].abs();
        let last = (1..self.width).fold(1, |best, j| if term(j) < term(best) { j } else { best });
        let end: f64 = row[..=last].iter().sum();
        values.iter().map(|p| row[..=last].iter().zip(p).map(|(a, p)| a * p).sum::<f64>() - end).collect()
    }
}

/// Legendre polynomials at `1 + ratio c` for the nodes of the next step.
pub(super) fn ahead(tableau: &Tableau, ratio: f64) -> Vec<Vec<f64>> {
    tableau.nodes.iter().map(|c| legendre(1.0 + ratio * c, tableau.stages)).collect()
}

/// (tol^(k/s) / worst)^(1/k).
fn factor(worst: f64, tolerance: f64, (k, s): (usize, usize)) -> f64 {
    if worst == 0.0 { f64::INFINITY } else { elementary::pow(tolerance, 1.0 / s as f64) * elementary::pow(worst, -1.0 / k as f64) }
}
