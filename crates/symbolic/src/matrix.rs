//! Matrices of expressions.

use crate::{Expr, Graph};

/// A dense matrix of expressions, row by row.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Matrix {
    rows: usize,
    columns: usize,
    entries: Vec<Expr>,
}

impl Matrix {
    /// A matrix of zeros.
    pub fn zeros(graph: &mut Graph, rows: usize, columns: usize) -> Matrix {
        Matrix { rows, columns, entries: vec![graph.zero(); rows * columns] }
    }
    /// The identity.
    pub fn identity(graph: &mut Graph, size: usize) -> Matrix {
        let mut m = Matrix::zeros(graph, size, size);
        let one = graph.one();
        for i in 0..size {
            m.set(i, i, one);
        }
        m
    }
    /// From rows of equal length; shorter rows are an error of the caller.
    pub fn from_rows(rows: &[Vec<Expr>]) -> Matrix {
        let columns = rows.first().map_or(0, Vec::len);
        debug_assert!(rows.iter().all(|r| r.len() == columns));
        Matrix { rows: rows.len(), columns, entries: rows.concat() }
    }
    /// Number of rows.
    pub fn rows(&self) -> usize {
        self.rows
    }
    /// Number of columns.
    pub fn columns(&self) -> usize {
        self.columns
    }
    /// Entry in row `i`, column `j`.
    pub fn get(&self, i: usize, j: usize) -> Expr {
        self.entries[i * self.columns + j]
    }
    /// Replaces an entry.
    pub fn set(&mut self, i: usize, j: usize, e: Expr) {
        self.entries[i * self.columns + j] = e;
    }
    /// All entries, row by row.
    pub fn entries(&self) -> &[Expr] {
        &self.entries
    }
    /// The transpose.
    pub fn transpose(&self) -> Matrix {
        let mut entries = Vec::with_capacity(self.entries.len());
        for j in 0..self.columns {
            for i in 0..self.rows {
                entries.push(self.get(i, j));
            }
        }
        Matrix { rows: self.columns, columns: self.rows, entries }
    }
    /// self · other.
    pub fn mul(&self, graph: &mut Graph, other: &Matrix) -> Matrix {
        debug_assert_eq!(self.columns, other.rows);
        let mut out = Matrix::zeros(graph, self.rows, other.columns);
        for i in 0..self.rows {
            for j in 0..other.columns {
                let terms: Vec<Expr> = (0..self.columns).map(|k| graph.mul(self.get(i, k), other.get(k, j))).collect();
                let e = graph.sum(&terms);
                out.set(i, j, e);
            }
        }
        out
    }
    /// self · v.
    pub fn apply(&self, graph: &mut Graph, v: &[Expr]) -> Vec<Expr> {
        debug_assert_eq!(self.columns, v.len());
        (0..self.rows)
            .map(|i| {
                let terms: Vec<Expr> = (0..self.columns).map(|k| graph.mul(self.get(i, k), v[k])).collect();
                graph.sum(&terms)
            })
            .collect()
    }
}
