//! Sparse symmetric matrices: assembly, products, static solution.

use crate::double::{self, Double};
use crate::kernels::{Columns, dot};
use crate::trouble::Trouble;

/// A symmetric matrix, stored by columns of its lower triangle: rows ascending, the diagonal always present.
#[derive(Clone, Debug, PartialEq)]
pub struct Sparse {
    n: usize,
    starts: Vec<usize>,
    rows: Vec<usize>,
    values: Vec<f64>,
}

/// Entries of a symmetric matrix while it is assembled.
#[derive(Clone, Debug, Default)]
pub struct Triplets {
    n: usize,
    entries: Vec<(usize, usize, f64)>,
}

impl Triplets {
    /// An n x n matrix of zeros.
    pub fn new(n: usize) -> Triplets {
        Triplets { n, entries: Vec::new() }
    }

    /// Adds `value` at (i, j) and, off the diagonal, at (j, i) too: give each pair once.
    pub fn add(&mut self, i: usize, j: usize, value: f64) {
        self.entries.push((i.max(j), i.min(j), value));
    }

    /// Adds a full symmetric element matrix (row-major) at the places of its coordinates; a place may occur more than once.
    pub fn add_element(&mut self, places: &[usize], element: &[f64]) {
        for (a, &i) in places.iter().enumerate() {
            for (b, &j) in places.iter().enumerate() {
                if i >= j {
                    self.entries.push((i, j, element[a * places.len() + b]));
                }
            }
        }
    }
}

impl Sparse {
    /// Sums the entries, those of one place in the order in which they were added.
    ///
    /// *Errors*: [`Trouble::Malformed`] when a place is outside the matrix or a number is not finite.
    pub fn from_triplets(triplets: &Triplets) -> Result<Sparse, Trouble> {
        let n = triplets.n;
        if triplets.entries.iter().any(|&(i, _, v)| i >= n || !v.is_finite()) {
            return Err(Trouble::Malformed("K, M"));
        }
        // two stable counting sorts: by rows, then by columns
        let by_row = sorted(n, triplets.entries.iter().map(|e| e.0), &(0..triplets.entries.len()).collect::<Vec<_>>());
        let by_column = sorted(n, by_row.iter().map(|&k| triplets.entries[k].1), &by_row);
        let mut sparse = Sparse { n, starts: Vec::with_capacity(n + 1), rows: Vec::new(), values: Vec::new() };
        let mut next = by_column.iter().map(|&k| triplets.entries[k]).peekable();
        for column in 0..n {
            sparse.starts.push(sparse.rows.len());
            sparse.rows.push(column);
            sparse.values.push(0.0);
            while let Some((i, _, v)) = next.next_if(|e| e.1 == column) {
                if sparse.rows.last() != Some(&i) {
                    sparse.rows.push(i);
                    sparse.values.push(0.0);
                }
                if let Some(sum) = sparse.values.last_mut() {
                    *sum += v;
                }
            }
        }
        sparse.starts.push(sparse.rows.len());
        Ok(sparse)
    }

    /// From a dense row-major matrix; its lower triangle is read.
    ///
    /// *Errors*: a size that does not fit, numbers that are not finite.
    pub fn from_dense(n: usize, matrix: &[f64]) -> Result<Sparse, Trouble> {
        if matrix.len() != n * n {
            return Err(Trouble::Malformed("K, M"));
        }
        let mut triplets = Triplets::new(n);
        for i in 0..n {
            (0..=i).filter(|j| matrix[i * n + j] != 0.0).for_each(|j| triplets.add(i, j, matrix[i * n + j]));
        }
        Sparse::from_triplets(&triplets)
    }

    /// Number of rows.
    pub fn size(&self) -> usize {
        self.n
    }

    /// Stored entries.
    pub fn stored(&self) -> usize {
        self.rows.len()
    }

    /// The diagonal.
    pub fn diagonal(&self) -> Vec<f64> {
        (0..self.n).map(|j| self.values[self.starts[j]]).collect()
    }

    /// Entries of a column at and below the diagonal: (row, value).
    pub fn column(&self, j: usize) -> impl Iterator<Item = (usize, f64)> + '_ {
        let range = self.starts[j]..self.starts[j + 1];
        self.rows[range.clone()].iter().copied().zip(self.values[range].iter().copied())
    }

    /// The same as a full row-major matrix.
    pub fn to_dense(&self) -> Vec<f64> {
        let n = self.n;
        let mut dense = vec![0.0; n * n];
        for j in 0..n {
            for (i, v) in self.column(j) {
                dense[i * n + j] = v;
                dense[j * n + i] = v;
            }
        }
        dense
    }

    /// y = A x.
    pub fn product(&self, x: &[f64]) -> Vec<f64> {
        let mut y = vec![0.0; self.n];
        self.product_into(x, &mut y);
        y
    }

    /// y = A x into a given place.
    pub fn product_into(&self, x: &[f64], y: &mut [f64]) {
        y.fill(0.0);
        for j in 0..self.n {
            let (first, last) = (self.starts[j], self.starts[j + 1]);
            let (x_j, mut sum) = (x[j], self.values[first] * x[j]);
            for (&i, &v) in self.rows[first + 1..last].iter().zip(&self.values[first + 1..last]) {
                sum += v * x[i];
                y[i] += v * x_j;
            }
            y[j] += sum;
        }
    }

    /// xᵀ A x / xᵀ M x, small problems in twice the digits.
    pub(super) fn quotient(&self, mass: &Sparse, x: &[f64]) -> f64 {
        if self.stored() + mass.stored() > 400_000 {
            return dot(x, &self.product(x)) / dot(x, &mass.product(x));
        }
        self.form(x).over(mass.form(x)).round()
    }

    /// K x - value M x, small problems in twice the digits.
    pub(super) fn defect(&self, mass: &Sparse, value: f64, x: &[f64]) -> Vec<f64> {
        if self.stored() + mass.stored() > 400_000 {
            return self.product(x).iter().zip(mass.product(x)).map(|(k, m)| k - value * m).collect();
        }
        let (stiff, heavy) = (self.exact_product(x), mass.exact_product(x));
        stiff.iter().zip(&heavy).map(|(k, m)| k.add_times(-value, *m).round()).collect()
    }

    /// A x in twice the digits.
    fn exact_product(&self, x: &[f64]) -> Vec<Double> {
        let mut out = vec![Double::default(); self.n];
        for j in 0..self.n {
            for (i, v) in self.column(j) {
                out[i] = out[i].add(v, x[j]);
                if i != j {
                    out[j] = out[j].add(v, x[i]);
                }
            }
        }
        out
    }

    fn form(&self, x: &[f64]) -> Double {
        let mut sum = Double::default();
        for j in 0..self.n {
            let column = double::dot(self.column(j).map(|(i, v)| (if i == j { v } else { 2.0 * v }, x[i])));
            sum = sum.add_times(x[j], column);
        }
        sum
    }

    pub(super) fn columns(&self) -> Columns<'_> {
        Columns { n: self.n, starts: &self.starts, rows: &self.rows }
    }

    /// Self + other on the union of the patterns, each times a factor.
    pub(super) fn sum(&self, a: f64, other: &Sparse, b: f64) -> Sparse {
        let mut sum = Sparse { n: self.n, starts: Vec::with_capacity(self.n + 1), rows: Vec::new(), values: Vec::new() };
        for j in 0..self.n {
            sum.starts.push(sum.rows.len());
            let (mut mine, mut theirs) = (self.column(j).peekable(), other.column(j).peekable());
            while let Some(row) = mine.peek().map(|e| e.0).into_iter().chain(theirs.peek().map(|e| e.0)).min() {
                let value = a * mine.next_if(|e| e.0 == row).map_or(0.0, |e| e.1) + b * theirs.next_if(|e| e.0 == row).map_or(0.0, |e| e.1);
                sum.rows.push(row);
                sum.values.push(value);
            }
        }
        sum.starts.push(sum.rows.len());
        sum
    }
}

/// Stable counting sort of `items` by their keys below n.
fn sorted(n: usize, keys: impl Iterator<Item = usize> + Clone, items: &[usize]) -> Vec<usize> {
    let mut places = vec![0; n + 1];
    keys.clone().for_each(|k| places[k + 1] += 1);
    (0..n).for_each(|k| places[k + 1] += places[k]);
    let mut out = vec![0; items.len()];
    for (key, &item) in keys.zip(items) {
        out[places[key]] = item;
        places[key] += 1;
    }
    out
}
