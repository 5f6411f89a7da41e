//! Eigenvalues of dense matrices: K x = lambda M x, and A x = lambda x.
//!
//! The pencil is scaled to a unit diagonal of M, reduced by M = L Lᵀ to the symmetric matrix L⁻¹ K L⁻ᵀ, and the eigenpairs are refined with
//! residuals in twice the digits (see `refine.rs`), because the reduction alone leaves an error of 1e-16 of the *largest* eigenvalue
//! in all of them. *Source*: G. H. Golub, C. F. Van Loan, Matrix Computations, 8.7.2.

use crate::Trouble;
use crate::cholesky::Cholesky;
use crate::complex::{self, Complex};
use crate::elementary;
use crate::factor::scale;
pub use crate::lanczos::{Counters, Lowest, Options, Sturm, lowest};
pub use crate::modes::Modes;
use crate::modes::orient;
use crate::refine::{Dense, refine};
use crate::{eigenpair, kernels};

/// Solutions of A x = lambda x.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ComplexModes {
    /// Length of a vector.
    pub n: usize,
    /// Eigenvalues by magnitude, then by real part; of a conjugate pair, which stands together, first the one with positive imaginary part.
    pub values: Vec<Complex>,
    /// Vectors one after another: the j-th is `vectors[j*n..(j+1)*n]`, largest entry 1.
    pub vectors: Vec<Complex>,
}

impl ComplexModes {
    /// The j-th vector.
    pub fn vector(&self, j: usize) -> &[Complex] {
        &self.vectors[j * self.n..(j + 1) * self.n]
    }
}

/// Up to this size all modes are refined, of larger ones the first `REFINED`.
const SMALL: usize = 96;
const REFINED: usize = 32;

/// All solutions of K x = lambda M x.
///
/// *Shapes*: both matrices n x n, row-major, symmetric (the mean of both triangles is taken), M positive definite.
/// *Errors*: [`Trouble::Massless`] with the row when M is not positive definite, [`Trouble::Malformed`] when an entry is not finite,
/// [`Trouble::Unconverged`] when the iteration fails.
///
/// ```
/// // two equal masses between three equal springs: 1 and 3
/// let modes = algebra::eigen::symmetric(2, &[2.0, -1.0, -1.0, 2.0], &[1.0, 0.0, 0.0, 1.0])?;
/// assert!((modes.values[0] - 1.0).abs() < 1e-15 && (modes.values[1] - 3.0).abs() < 1e-15);
/// # Ok::<(), algebra::Trouble>(())
/// ```
#[doc(alias = "собственные значения")]
pub fn symmetric(n: usize, stiffness: &[f64], mass: &[f64]) -> Result<Modes, Trouble> {
    check(n, stiffness, "K")?;
    check(n, mass, "M")?;
    let scales: Vec<f64> = (0..n).map(|i| scale(mass[i * n + i])).collect();
    let scaled = |a: &[f64]| -> Vec<f64> {
        let entry = |k: usize| scales[k / n] * (0.5 * (a[k] + a[k % n * n + k / n])) * scales[k % n];
        (0..n * n).map(entry).collect()
    };
    let (k, m) = (scaled(stiffness), scaled(mass));
    let (mut values, mut vectors) = pencil(n, &k, &m)?;
    if values.first().zip(values.last()).is_some_and(|(low, high)| *low < high / SPREAD) {
        from_below(n, &k, &m, &mut values, &mut vectors);
    }
    let count = if n <= SMALL { n } else { REFINED };
    refine(Dense { n, k: &k, m: &m }, &mut values, &mut vectors, count);
    let mut order: Vec<usize> = (0..n).collect();
    order.sort_by(|&a, &b| values[a].total_cmp(&values[b]));
    let mut modes = Modes { n, values: order.iter().map(|&j| values[j]).collect(), vectors: Vec::with_capacity(n * n) };
    for j in order {
        let x = &mut vectors[j * n..(j + 1) * n];
        orient(x);
        modes.vectors.extend(x.iter().zip(&scales).map(|(x, s)| x * s));
    }
    Ok(modes)
}

/// Largest over smallest eigenvalue beyond which the lower half is taken from the inverse problem.
const SPREAD: f64 = 1e6;

/// All solutions by M = L Lᵀ: values ascending, vectors with xᵀ M x = 1; each value errs by some 1e-16 of the largest.
fn pencil(n: usize, k: &[f64], m: &[f64]) -> Result<(Vec<f64>, Vec<f64>), Trouble> {
    let lower = Cholesky::new(m, n).map_err(|weak| Trouble::Massless(weak.row))?;
    let (values, mut vectors) = kernels::self_adjoint(n, &reduced(n, &lower, k)).ok_or(Trouble::Unconverged { found: 0, wanted: n })?;
    vectors.chunks_mut(n.max(1)).for_each(|x| lower.backward(x));
    Ok((values, vectors))
}

/// Takes the lower eigenpairs from M x = theta K x, theta = 1/lambda, whose values err by 1e-16 of 1/(smallest eigenvalue): where the
/// spectrum is wider than the digits of a number, each problem knows only its own end. The ends are joined in the widest gap near the
/// geometric mean of the spectrum. Nothing changes when K is not positive definite. Coordinates without stiffness that nothing couples to the others are free
/// motions of their own: what is left without them may be positive definite.
fn from_below(n: usize, k: &[f64], m: &[f64], values: &mut [f64], vectors: &mut [f64]) {
    let held: Vec<usize> = (0..n).filter(|i| (0..n).any(|j| k[i * n + j] != 0.0)).collect();
    let loose: Vec<usize> = (0..n).filter(|i| !held.contains(i)).collect();
    if !loose.is_empty() && held.iter().all(|i| loose.iter().all(|j| m[i * n + j] == 0.0)) {
        return beside(n, (k, m), [&loose, &held], values, vectors);
    }
    let scales: Vec<f64> = (0..n).map(|i| scale(k[i * n + i])).collect();
    let scaled = |a: &[f64]| -> Vec<f64> { (0..n * n).map(|e| scales[e / n] * a[e] * scales[e % n]).collect() };
    let Ok((thetas, inverse)) = pencil(n, &scaled(m), &scaled(k)) else { return };
    if thetas.iter().any(|theta| *theta <= 0.0) {
        return;
    }
    let lambda = |i: usize| 1.0 / thetas[n - 1 - i];
    let middle = (lambda(0) * values[n - 1]).sqrt();
    // within two decades of the middle both ways of computing lose equally few digits
    let near = |i: &usize| (1e-2 * middle..1e2 * middle).contains(&lambda(*i));
    let gap = |i: &usize| lambda(*i) / lambda(*i - 1);
    let joint = (1..n).filter(near).max_by(|i, j| gap(i).total_cmp(&gap(j)));
    let joint = joint.unwrap_or_else(|| (0..n).filter(|i| lambda(*i) < middle).count());
    for i in 0..joint {
        let own = &inverse[(n - 1 - i) * n..(n - i) * n];
        // xᵀ K x = 1 there, so that xᵀ M x = theta
        let factor = thetas[n - 1 - i].sqrt().recip();
        values[i] = lambda(i);
        vectors[i * n..(i + 1) * n].iter_mut().zip(own.iter().zip(&scales)).for_each(|(v, (x, s))| *v = factor * s * x);
    }
}

/// Eigenpairs of the free coordinates, all zero, then those of the held ones.
fn beside(n: usize, (k, m): (&[f64], &[f64]), [loose, held]: [&[usize]; 2], values: &mut [f64], vectors: &mut [f64]) {
    let part = |a: &[f64], list: &[usize]| -> Vec<f64> { list.iter().flat_map(|i| list.iter().map(move |j| a[i * n + j])).collect() };
    let mut place = 0;
    for list in [loose, held] {
        let size = list.len();
        let (stiff, heavy) = (part(k, list), part(m, list));
        let Ok((mut own, mut shapes)) = pencil(size, &stiff, &heavy) else { return };
        if size > 0 && own[0] < own[size - 1] / SPREAD {
            from_below(size, &stiff, &heavy, &mut own, &mut shapes);
        }
        for j in 0..size {
            values[place] = own[j];
            let vector = &mut vectors[place * n..(place + 1) * n];
            vector.fill(0.0);
            list.iter().enumerate().for_each(|(a, i)| vector[*i] = shapes[j * size + a]);
            place += 1;
        }
    }
}

fn check(n: usize, matrix: &[f64], name: &'static str) -> Result<(), Trouble> {
    if matrix.len() != n * n || matrix.iter().any(|a| !a.is_finite()) {
        return Err(Trouble::Malformed(name));
    }
    Ok(())
}

/// L⁻¹ K L⁻ᵀ.
fn reduced(n: usize, l: &Cholesky, k: &[f64]) -> Vec<f64> {
    let mut rows = k.to_vec();
    // each row of K is solved from the left, which is K L⁻ᵀ; its transpose L⁻¹ K once more
    rows.chunks_mut(n.max(1)).for_each(|row| l.forward(row));
    let mut c: Vec<f64> = (0..n * n).map(|e| rows[e % n * n + e / n]).collect();
    c.chunks_mut(n.max(1)).for_each(|row| l.forward(row));
    (0..n * n).map(|e| 0.5 * (c[e] + c[e % n * n + e / n])).collect()
}

/// All eigenvalues and right eigenvectors of a real matrix.
///
/// *Shapes*: n x n, row-major. *Errors*: [`Trouble::Malformed`] when an entry is not finite, [`Trouble::Unconverged`].
/// *Source* of the scaling: B. N. Parlett, C. Reinsch, Balancing a matrix, Numer. Math. 13 (1969).
pub fn general(n: usize, a: &[f64]) -> Result<ComplexModes, Trouble> {
    check(n, a, "A")?;
    let (balanced, scales) = balance(n, a);
    let (values, vectors) = kernels::nonsymmetric(n, &balanced).ok_or(Trouble::Unconverged { found: 0, wanted: n })?;
    // one of each pair, so that both partners are conjugate to the last bit
    let mut first: Vec<usize> = (0..n).filter(|&j| values[j].im >= 0.0).collect();
    let magnitude = |j: usize| complex::abs(values[j]);
    first.sort_by(|&i, &j| {
        let parts = values[i].re.total_cmp(&values[j].re).then(values[i].im.total_cmp(&values[j].im));
        magnitude(i).total_cmp(&magnitude(j)).then(parts).then(i.cmp(&j))
    });
    let mut modes = ComplexModes { n, values: Vec::with_capacity(n), vectors: Vec::with_capacity(n * n) };
    for j in first {
        let (mut value, mut vector) = (values[j], normalised(&vectors[j * n..(j + 1) * n]));
        if n <= eigenpair::LARGEST {
            eigenpair::refine(n, &balanced, &mut value, &mut vector);
            // near critical damping a pair must not lose its partner
            if (value.im > 0.0) != (values[j].im > 0.0) {
                (value, vector) = (values[j], normalised(&vectors[j * n..(j + 1) * n]));
            }
        }
        let vector: Vec<Complex> = vector.iter().zip(&scales).map(|(z, s)| z.scale(*s)).collect();
        let vector = normalised(&vector);
        modes.values.push(value);
        modes.vectors.extend(&vector);
        if value.im > 0.0 {
            modes.values.push(value.conj());
            modes.vectors.extend(vector.iter().map(Complex::conj));
        }
    }
    if modes.values.len() != n || modes.values.iter().any(|z| !z.re.is_finite() || !z.im.is_finite()) {
        return Err(Trouble::Unconverged { found: modes.values.len().min(n), wanted: n });
    }
    Ok(modes)
}

/// The vector divided by its largest entry; of entries that are equal within rounding the first.
fn normalised(x: &[Complex]) -> Vec<Complex> {
    let size = |z: &Complex| complex::abs(*z);
    // equal entries differ by the rounding of the reduction, some n units of the last place
    let largest = x.iter().fold(Complex::ZERO, |best, z| if size(z) > size(&best) * (1.0 + 1e-12) { *z } else { best });
    if largest == Complex::ZERO { x.to_vec() } else { x.iter().map(|z| complex::over(*z, largest)).collect() }
}

/// D⁻¹ A D with rows and columns of like size, D in powers of two; and D.
fn balance(n: usize, a: &[f64]) -> (Vec<f64>, Vec<f64>) {
    let (mut a, mut d) = (a.to_vec(), vec![1.0; n]);
    for _ in 0..100 {
        let mut settled = true;
        for i in 0..n {
            let others = || (0..n).filter(|&j| j != i);
            let row: f64 = others().map(|j| a[i * n + j].abs()).sum();
            let column: f64 = others().map(|j| a[j * n + i].abs()).sum();
            if row == 0.0 || column == 0.0 {
                continue;
            }
            let factor = elementary::exp2((0.5 * elementary::log2(row / column)).round());
            if column * factor + row / factor < 0.95 * (column + row) {
                settled = false;
                d[i] *= factor;
                (0..n).for_each(|j| a[i * n + j] /= factor);
                (0..n).for_each(|j| a[j * n + i] *= factor);
            }
        }
        if settled {
            break;
        }
    }
    (a, d)
}
