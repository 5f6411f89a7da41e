//! The lowest modes of the matrices of a structure, with a certificate: residuals, and a count by inertia.

use crate::Fault;
use crate::assembly::Sparse;
use crate::matrices::told;
use algebra::certify::{Certificate, certify};
use algebra::{eigen, sparse};

/// The same matrix by columns.
///
/// *Errors*: numbers that are not finite.
pub fn compressed(matrix: &Sparse<f64>) -> Result<sparse::Sparse, Fault> {
    let mut triplets = sparse::Triplets::new(matrix.n);
    matrix.entries.iter().for_each(|(i, j, v)| triplets.add(*i, *j, *v));
    sparse::Sparse::from_triplets(&triplets).map_err(told)
}

/// Modes beyond the wanted ones, so that Sturm's count finds a gap above the last wanted one.
const BEYOND: usize = 2;

/// The lowest modes of small matrices, M may be singular, with their certificate.
///
/// *Errors*: matrices without modes, or a search that does not settle.
pub fn lowest_dense(stiffness: &[f64], mass: &[f64], n: usize, count: usize) -> Result<(eigen::Modes, Certificate), Fault> {
    let (k, m) = (sparse::Sparse::from_dense(n, stiffness).map_err(told)?, sparse::Sparse::from_dense(n, mass).map_err(told)?);
    let modes = match eigen::symmetric(n, stiffness, mass) {
        Ok(modes) => modes,
        Err(_) => eigen::lowest(&k, &m, n, eigen::Options::default()).map_err(told)?.modes,
    };
    checked(&k, &m, modes, count)
}

/// The lowest modes of sparse matrices with their certificate.
///
/// *Errors*: matrices without modes, or a search that does not settle.
pub fn lowest_sparse(k: &Sparse<f64>, m: &Sparse<f64>, count: usize) -> Result<(eigen::Modes, Certificate), Fault> {
    let (k, m) = (compressed(k)?, compressed(m)?);
    let modes = eigen::lowest(&k, &m, count + BEYOND, eigen::Options::default()).map_err(told)?.modes;
    checked(&k, &m, modes, count)
}

/// Checks the lowest `count` modes and leaves the others out.
fn checked(k: &sparse::Sparse, m: &sparse::Sparse, mut modes: eigen::Modes, count: usize) -> Result<(eigen::Modes, Certificate), Fault> {
    let count = count.min(modes.values.len());
    let certificate = certify(k, m, &modes, count).map_err(told)?;
    modes.values.truncate(count);
    modes.vectors.truncate(count * modes.n);
    Ok((modes, certificate))
}
