//! The only file that knows faer: dense eigenvalues, and L D Lᵀ factors of sparse symmetric matrices by supernodes.
//!
//! Everything here takes and gives plain slices, so that the library behind it can change. No threads: studies run beside each other.

use std::sync::Arc;

use crate::complex::Complex;

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::cholesky::ldlt::factor::LdltRegularization;
use faer::linalg::matmul::matmul;
use faer::perm::PermRef;
use faer::reborrow::ReborrowMut;
use faer::sparse::linalg::SupernodalThreshold;
use faer::sparse::linalg::cholesky::supernodal::SupernodalLdltRef;
use faer::sparse::linalg::cholesky::{
    CholeskySymbolicParams, LdltRef, SymbolicCholesky, SymbolicCholeskyRaw, SymmetricOrdering, factorize_symbolic_cholesky,
};
use faer::sparse::{SparseColMatRef, SymbolicSparseColMatRef};
use faer::{Accum, Conj, MatMut, MatRef, Par, Side};

/// Eigenvalues (ascending) and orthonormal eigenvectors, one after another, of a symmetric matrix; none when the iteration fails.
pub(super) fn self_adjoint(n: usize, matrix: &[f64]) -> Option<(Vec<f64>, Vec<f64>)> {
    if n == 0 {
        return Some((Vec::new(), Vec::new()));
    }
    let found = MatRef::from_row_major_slice(matrix, n, n).self_adjoint_eigen(Side::Lower).ok()?;
    let values = found.S().column_vector().iter().copied().collect();
    let vectors = (0..n).flat_map(|j| found.U().col(j).iter().copied()).collect();
    Some((values, vectors))
}

/// Eigenvalues and right eigenvectors, one after another, of a real matrix; none when the iteration fails.
pub(super) fn nonsymmetric(n: usize, matrix: &[f64]) -> Option<(Vec<Complex>, Vec<Complex>)> {
    if n == 0 {
        return Some((Vec::new(), Vec::new()));
    }
    let found = MatRef::from_row_major_slice(matrix, n, n).eigen().ok()?;
    let values = found.S().column_vector().iter().map(|z| Complex::new(z.re, z.im)).collect();
    let vectors = (0..n).flat_map(|j| found.U().col(j).iter().map(|z| Complex::new(z.re, z.im))).collect();
    Some((values, vectors))
}

/// A symmetric matrix by columns of its lower triangle, rows ascending.
#[derive(Clone, Copy)]
pub(super) struct Columns<'a> {
    pub n: usize,
    pub starts: &'a [usize],
    pub rows: &'a [usize],
}

/// Order of elimination and places of the factor's entries.
#[derive(Clone, Debug)]
pub(super) struct Plan(Arc<SymbolicCholesky<usize>>);

impl Plan {
    /// Plans the elimination in the given order (`order[k]` is eliminated k-th), or by minimum degree; none when memory ends.
    pub fn new(a: Columns, order: Option<&[usize]>) -> Option<Plan> {
        let pattern = SymbolicSparseColMatRef::new_checked(a.n, a.n, a.starts, None, a.rows);
        let params =
            CholeskySymbolicParams { supernodal_flop_ratio_threshold: SupernodalThreshold::FORCE_SUPERNODAL, ..Default::default() };
        let symbolic = match order {
            None => factorize_symbolic_cholesky(pattern, Side::Lower, SymmetricOrdering::Amd, params),
            Some(order) => {
                let mut inverse = vec![0; a.n];
                order.iter().enumerate().for_each(|(k, &i)| inverse[i] = k);
                let order = PermRef::new_checked(order, &inverse, a.n);
                factorize_symbolic_cholesky(pattern, Side::Lower, SymmetricOrdering::Custom(order), params)
            }
        };
        symbolic.ok().map(|symbolic| Plan(Arc::new(symbolic)))
    }

    /// Numbers stored in the factor.
    pub fn size(&self) -> usize {
        self.0.len_val()
    }

    /// Rows in the order of elimination.
    pub fn order(&self) -> Vec<usize> {
        match self.0.perm() {
            Some(perm) => perm.arrays().0.to_vec(),
            None => (0..self.0.nrows()).collect(),
        }
    }

    /// Factors a matrix with this pattern whose diagonal is near 1. A pivot within `smallest` of zero is replaced by a huge one, as if
    /// its coordinate were held; none when memory ends or a number is not finite.
    pub fn factor(&self, a: Columns, values: &[f64], smallest: f64) -> Option<Factor> {
        let mut numbers = Vec::new();
        numbers.try_reserve_exact(self.size()).ok()?;
        numbers.resize(self.size(), 0.0);
        let need = self.0.factorize_numeric_ldlt_scratch::<f64>(Par::Seq, Default::default());
        let mut memory = MemBuffer::try_new(need).ok()?;
        let regularization = LdltRegularization {
            dynamic_regularization_signs: None,
            dynamic_regularization_delta: HELD,
            dynamic_regularization_epsilon: smallest,
        };
        let pattern = SymbolicSparseColMatRef::new_checked(a.n, a.n, a.starts, None, a.rows);
        let matrix = SparseColMatRef::new(pattern, values);
        let stack = MemStack::new(&mut memory);
        self.0.factorize_numeric_ldlt(&mut numbers, matrix, Side::Lower, regularization, Par::Seq, stack, Default::default()).ok()?;
        Some(Factor { plan: self.clone(), numbers })
    }
}

/// Pivot in place of a vanishing one: 2^200.
const HELD: f64 = 1.606_938_044_258_990_3e60;

/// P A Pᵀ = L D Lᵀ.
#[derive(Clone, Debug)]
pub(super) struct Factor {
    plan: Plan,
    numbers: Vec<f64>,
}

impl Factor {
    fn nodes(&self) -> Option<SupernodalLdltRef<'_, usize, f64>> {
        match self.plan.0.raw() {
            SymbolicCholeskyRaw::Supernodal(symbolic) => Some(SupernodalLdltRef::new(symbolic, &self.numbers)),
            SymbolicCholeskyRaw::Simplicial(_) => None,
        }
    }

    /// Pivots in the order of elimination.
    pub fn pivots(&self) -> Vec<f64> {
        let Some(factor) = self.nodes() else { return self.lone_pivots() };
        let mut pivots = Vec::with_capacity(self.plan.0.nrows());
        for s in 0..factor.symbolic().n_supernodes() {
            let matrix = factor.supernode(s).val();
            pivots.extend((0..matrix.ncols()).map(|j| matrix[(j, j)]));
        }
        pivots
    }

    /// Pivots of a matrix without a coupling, for which faer chooses the other form of factor: a diagonal, first in each column.
    fn lone_pivots(&self) -> Vec<f64> {
        match self.plan.0.raw() {
            SymbolicCholeskyRaw::Simplicial(symbolic) => {
                symbolic.col_ptr()[..self.plan.0.nrows()].iter().map(|&start| self.numbers[start]).collect()
            }
            SymbolicCholeskyRaw::Supernodal(_) => Vec::new(),
        }
    }

    /// Places in the order of elimination of the pivots that were replaced.
    pub fn held(&self) -> Vec<usize> {
        self.pivots().iter().enumerate().filter(|(_, d)| d.abs() == HELD).map(|(k, _)| k).collect()
    }

    /// Row of the matrix eliminated k-th.
    pub fn row(&self, k: usize) -> usize {
        self.plan.order()[k]
    }

    /// The direction in which the matrix vanishes when its k-th pivot does: v with Lᵀ v = e_k.
    pub fn motion(&self, k: usize) -> Vec<f64> {
        let n = self.plan.0.nrows();
        let mut x = vec![0.0; n];
        x[k] = 1.0;
        let Some(factor) = self.nodes() else {
            // without couplings the motion is that of the coordinate itself
            let mut v = vec![0.0; n];
            v[self.row(k)] = 1.0;
            return v;
        };
        for s in (0..factor.symbolic().n_supernodes()).rev() {
            let node = factor.supernode(s);
            let (matrix, start, pattern) = (node.val(), node.start(), node.pattern());
            let width = matrix.ncols();
            for j in (0..width).rev() {
                let inside: f64 = (j + 1..width).map(|i| matrix[(i, j)] * x[start + i]).sum();
                let below: f64 = pattern.iter().enumerate().map(|(i, &row)| matrix[(width + i, j)] * x[row]).sum();
                x[start + j] -= inside + below;
            }
        }
        let mut v = vec![0.0; n];
        self.plan.order().iter().enumerate().for_each(|(k, &i)| v[i] = x[k]);
        v
    }

    /// Solves A X = B in place for `count` columns, one after another.
    pub fn solve(&self, b: &mut [f64], count: usize) {
        let n = self.plan.0.nrows();
        let mut memory = MemBuffer::new(self.plan.0.solve_in_place_scratch::<f64>(count, Par::Seq));
        let b = MatMut::from_column_major_slice_mut(b, n, count);
        LdltRef::new(&self.plan.0, &self.numbers).solve_in_place_with_conj(Conj::No, b, Par::Seq, MemStack::new(&mut memory));
    }
}

/// Rows taken at a time, so that a block stays in the cache while the basis streams by.
const TILE: usize = 1024;

/// Sum of products, in eight lanes.
pub(super) fn dot(a: &[f64], b: &[f64]) -> f64 {
    let (a8, b8) = (a.chunks_exact(8), b.chunks_exact(8));
    let tail: f64 = a8.remainder().iter().zip(b8.remainder()).map(|(x, y)| x * y).sum();
    let mut lanes = [0.0; 8];
    for (x, y) in a8.zip(b8) {
        (0..8).for_each(|l| lanes[l] += x[l] * y[l]);
    }
    ((lanes[0] + lanes[4]) + (lanes[1] + lanes[5])) + ((lanes[2] + lanes[6]) + (lanes[3] + lanes[7])) + tail
}

/// Products of each of the first vectors (length n, one after another) with each of the block: a row of all columns per vector.
pub(super) fn shares(n: usize, vectors: &[f64], block: &[f64]) -> Vec<f64> {
    let (size, count) = (vectors.len() / n, block.len() / n);
    let mut out = vec![0.0; size * count];
    let (vectors, block) = (MatRef::from_column_major_slice(vectors, n, size), MatRef::from_column_major_slice(block, n, count));
    let mut result = MatMut::from_row_major_slice_mut(&mut out, size, count);
    for start in (0..n).step_by(TILE) {
        let rows = TILE.min(n - start);
        let (some, part) = (vectors.subrows(start, rows), block.subrows(start, rows));
        matmul(result.rb_mut(), Accum::Add, some.transpose(), part, 1.0, Par::Seq);
    }
    out
}

/// Takes the vectors times their shares (as from [`shares`]) out of each vector of the block.
pub(super) fn subtract(n: usize, block: &mut [f64], vectors: &[f64], shares: &[f64]) {
    let (size, count) = (vectors.len() / n, block.len() / n);
    let vectors = MatRef::from_column_major_slice(vectors, n, size);
    let shares = MatRef::from_row_major_slice(shares, size, count);
    let mut block = MatMut::from_column_major_slice_mut(block, n, count);
    for start in (0..n).step_by(TILE) {
        let rows = TILE.min(n - start);
        matmul(block.rb_mut().subrows_mut(start, rows), Accum::Add, vectors.subrows(start, rows), shares, -1.0, Par::Seq);
    }
}
