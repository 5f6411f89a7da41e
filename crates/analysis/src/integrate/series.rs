//! Taylor coefficients of several quantities, row by row.

/// Rows of Taylor coefficients of one length.
#[derive(Clone, Debug, Default)]
pub(crate) struct Series {
    values: Vec<f64>,
    stride: usize,
}

impl Series {
    pub(crate) fn row(&self, i: usize) -> &[f64] {
        &self.values[i * self.stride..(i + 1) * self.stride]
    }
    pub(super) fn n_rows(&self) -> usize {
        self.values.len().checked_div(self.stride).unwrap_or(0)
    }
    pub(super) fn set_first(&mut self, i: usize, value: f64) {
        self.values[i * self.stride] = value;
    }
    /// Leaves the terms up to this one.
    pub(super) fn cut(&mut self, last: usize) {
        for row in self.values.chunks_mut(self.stride.max(1)) {
            row.iter_mut().skip(last + 1).for_each(|c| *c = 0.0);
        }
    }
    pub(crate) fn reset(&mut self, stride: usize) {
        self.values.clear();
        self.stride = stride;
    }
    /// Adds a whole row.
    pub(super) fn extend(&mut self, row: impl Iterator<Item = f64>) {
        self.values.extend(row);
    }
    /// Adds a row; a shorter one is continued by zeros.
    pub(crate) fn push(&mut self, row: &[f64]) {
        let n = row.len().min(self.stride);
        self.values.extend_from_slice(&row[..n]);
        self.values.resize(self.values.len() + self.stride - n, 0.0);
    }
}
