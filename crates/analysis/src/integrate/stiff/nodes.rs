//! Where a step of the implicit method begins, what stands at its nodes, what it costs.

use crate::Mode;
use algebra::sum::Instant;

/// Where a step begins.
pub(crate) struct Base<'a> {
    pub(crate) start: Instant,
    pub(crate) x: &'a [f64],
    pub(crate) low: &'a [f64],
    pub(crate) modes: &'a [Mode],
}

impl Base<'_> {
    pub(super) fn time(&self, tau: f64) -> f64 {
        self.start.after(tau).high
    }
    pub(super) fn state(&self, change: &[f64], x: &mut [f64]) {
        x.iter_mut().enumerate().for_each(|(k, x)| *x = self.x[k] + (change[k] + self.low[k]));
    }
}

/// Work of the implicit method.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counts {
    /// Jacobians.
    pub jacobians: u64,
    /// Factorisations of a matrix of the size of the state.
    pub factorisations: u64,
    /// Newton iterations; each evaluates the rates at all nodes.
    pub newton: u64,
    /// Rates between nodes, for the defect.
    pub rates: u64,
}

/// Values at the nodes, node by node.
#[derive(Clone, Debug, Default)]
pub(super) struct Stages {
    n: usize,
    pub(super) values: Vec<f64>,
}

impl Stages {
    pub(super) fn new(stages: usize, n: usize) -> Stages {
        Stages { n, values: vec![0.0; stages * n] }
    }
    pub(super) fn row(&self, i: usize) -> &[f64] {
        &self.values[i * self.n..(i + 1) * self.n]
    }
    pub(super) fn row_mut(&mut self, i: usize) -> &mut [f64] {
        &mut self.values[i * self.n..(i + 1) * self.n]
    }
    /// One state at all nodes.
    pub(super) fn column(&self, k: usize) -> impl Iterator<Item = f64> + '_ {
        self.values.iter().skip(k).step_by(self.n.max(1)).copied()
    }
}
