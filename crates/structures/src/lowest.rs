//! The lowest modes of the matrices of a structure, with a certificate: residuals, and a count by inertia.

use crate::Fault;
use crate::assembly::Sparse;
use crate::matrices::told;
use algebra::certify::{Certificate, certify};
use algebra::double::Double;
use algebra::polish::Firm;
use algebra::twofold::Twofold;
use algebra::{eigen, sparse};

/// The same matrix by columns.
///
/// *Errors*: numbers that are not finite.
pub fn compressed(matrix: &Sparse<f64>) -> Result<sparse::Sparse, Fault> {
    let mut triplets = sparse::Triplets::new(matrix.n);
    matrix.entries.iter().for_each(|(i, j, v)| triplets.add(*i, *j, *v));
    sparse::Sparse::from_triplets(&triplets).map_err(told)
}

/// The same matrix by columns in twice the digits.
pub fn twofold(matrix: &Sparse<Double>) -> Twofold {
    Twofold::new(matrix.n, matrix.entries.iter().copied())
}

/// Modes beyond the wanted ones, so that Sturm's count finds a gap above the last wanted one.
const BEYOND: usize = 4;

/// The lowest modes of small matrices, M may be singular, with their certificate.
///
/// *Errors*: a stiffness that is not positive definite, matrices without modes, or a search that does not settle.
pub fn lowest_dense(stiffness: &[Double], mass: &[Double], n: usize, count: usize) -> Result<(eigen::Modes, Certificate), Fault> {
    let rounded = |a: &[Double]| a.iter().map(|v| v.round()).collect::<Vec<f64>>();
    let (k, m) = (Twofold::from_dense(n, stiffness), Twofold::from_dense(n, mass));
    let modes = match eigen::symmetric(n, &rounded(stiffness), &rounded(mass)) {
        Ok(modes) => modes,
        Err(_) => approximate(&k, &m, n)?,
    };
    checked(k, &m, modes, count)
}

/// The lowest modes of sparse matrices with their certificate.
///
/// *Errors*: a stiffness that is not positive definite, matrices without modes, or a search that does not settle.
pub fn lowest_sparse(k: &Sparse<Double>, m: &Sparse<Double>, count: usize) -> Result<(eigen::Modes, Certificate), Fault> {
    let (k, m) = (twofold(k), twofold(m));
    let modes = approximate(&k, &m, count + BEYOND)?;
    checked(k, &m, modes, count)
}

fn approximate(k: &Twofold, m: &Twofold, count: usize) -> Result<eigen::Modes, Fault> {
    let (k, m) = (k.rounded().map_err(told)?, m.rounded().map_err(told)?);
    Ok(eigen::lowest(&k, &m, count, eigen::Options::default()).map_err(told)?.modes)
}

/// Polishes and checks the lowest `count` modes and leaves the others out. Where K is too large to be factored in twice the digits, what its rounding does to
/// the values is part of their bounds.
fn checked(k: Twofold, m: &Twofold, mut modes: eigen::Modes, count: usize) -> Result<(eigen::Modes, Certificate), Fault> {
    let count = count.min(modes.values.len());
    let rounded = k.rounded().map_err(told)?;
    let quotients: Vec<f64> = (0..count).map(|j| k.quotient(m, modes.shape(j))).collect();
    if let Some(firm) = Firm::of(k).map_err(told)? {
        return firm.polished(m, &modes, count).map_err(told);
    }
    let mut certificate = certify(&rounded, &m.rounded().map_err(told)?, &modes, count).map_err(told)?;
    modes.values.truncate(count);
    modes.vectors.truncate(count * modes.n);
    for (j, quotient) in quotients.into_iter().enumerate() {
        certificate.residuals[j] = certificate.residuals[j].max((modes.values[j] / quotient - 1.0).abs());
        modes.values[j] = quotient;
    }
    Ok((modes, certificate))
}
