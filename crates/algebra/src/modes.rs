//! Solutions of a symmetric eigenproblem, and the sign of a shape.

/// Solutions of K x = lambda M x.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Modes {
    /// Length of a shape.
    pub n: usize,
    /// Eigenvalues, ascending: squares of the angular frequencies.
    pub values: Vec<f64>,
    /// Shapes one after another: the j-th is `vectors[j*n..(j+1)*n]`; xᵀ M x = 1, the first entry of some size positive.
    pub vectors: Vec<f64>,
}

impl Modes {
    /// The j-th shape.
    pub fn shape(&self, j: usize) -> &[f64] {
        &self.vectors[j * self.n..(j + 1) * self.n]
    }
}

/// Makes the first entry of some size positive.
pub(super) fn orient(x: &mut [f64]) {
    let largest = x.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
    // smaller ones are no entry whose sign a reader looks at, and may be rounding
    if x.iter().find(|v| v.abs() > 1e-3 * largest).is_some_and(|v| *v < 0.0) {
        x.iter_mut().for_each(|v| *v = -*v);
    }
}
