//! A frame as generalised coordinates: its named displacements u and, for what they leave open, amplitudes η of shapes in which all named
//! displacements rest.
//!
//! ```text
//! q = B u + Φ η      B = K⁻¹ Pᵀ (P K⁻¹ Pᵀ)⁻¹ static shapes of unit displacements u = P q,   P Φ = 0,  Φᵀ M Φ = 1
//! ```
//!
//! K then couples no u with an η. With all η nothing is lost; with the lowest ones the frame is right up to about their frequencies.
//! *Source*: R. R. Craig, M. C. C. Bampton, Coupling of substructures for dynamic analyses, AIAA J. 6 (1968) 1313, with displacements in place
//! of boundary nodes.

use super::reduced::{Condensation, displacements, reduce};
use super::{Assembly, Frame, dense};
use crate::Fault;

/// A frame over few coordinates: the named displacements that are independent, then amplitudes.
#[derive(Clone, Debug)]
pub struct Substructure {
    /// Indices of the named displacements that are coordinates.
    pub named: Vec<usize>,
    /// Number of amplitudes.
    pub amplitudes: usize,
    /// M, row by row.
    pub mass: Vec<f64>,
    /// K, row by row.
    pub stiffness: Vec<f64>,
    /// All independent freedoms over the coordinates, n_q x n.
    pub basis: Vec<f64>,
    /// Number of independent freedoms.
    pub n_q: usize,
}

/// The coordinates of a frame, at most `count` amplitudes.
///
/// *Errors*: no inertia, faults of the eigensolver.
pub fn substructure(frame: &Frame<f64>, assembly: &Assembly<f64>, condensation: Condensation, count: usize) -> Result<Substructure, Fault> {
    let mut bare = frame.clone();
    bare.displacements.clear();
    let reduced = reduce(&bare, assembly, condensation)?;
    let (n, n_q) = (reduced.n(), reduced.n_q);
    let rows: Vec<Vec<f64>> = displacements(frame, assembly).iter().map(|p| dense::product(p, &reduced.basis, 1, n_q, n)).collect();
    let named = independent(&rows, &reduced.flexibility, n);
    let p: Vec<f64> = named.iter().flat_map(|i| rows[*i].clone()).collect();
    let m = named.len();
    let dpt = dense::product(&reduced.flexibility, &dense::transpose(&p, m, n), n, n, m);
    let small = dense::product(&p, &dpt, m, n, m);
    let inverse = dense::solve(&small, m, &dense::identity(m), m).unwrap_or_default();
    let fixed = dense::product(&dpt, &inverse, n, m, m);
    let free = resting(&p, &reduced, m, count)?;
    let amplitudes = free.len();
    let width = m + amplitudes;
    let mut local = vec![0.0; n * width];
    for i in 0..n {
        (0..m).for_each(|j| local[i * width + j] = fixed[i * m + j]);
        free.iter().enumerate().for_each(|(j, shape)| local[i * width + m + j] = shape[i]);
    }
    let mut stiffness = dense::congruence(&reduced.stiffness, &local, n, width);
    // exactly uncoupled; what rounding leaves would look like a spring
    for i in 0..m {
        for j in m..width {
            stiffness[i * width + j] = 0.0;
            stiffness[j * width + i] = 0.0;
        }
    }
    for i in m..width {
        (m..width).filter(|j| *j != i).for_each(|j| stiffness[i * width + j] = 0.0);
    }
    let mut mass = dense::congruence(&reduced.mass, &local, n, width);
    for i in m..width {
        (m..width).for_each(|j| mass[i * width + j] = f64::from(u8::from(i == j)));
    }
    Ok(Substructure { named, amplitudes, mass, stiffness, basis: dense::product(&reduced.basis, &local, n_q, n, width), n_q })
}

/// The functionals that are independent of those before them, in the metric of the flexibility.
fn independent(rows: &[Vec<f64>], flexibility: &[f64], n: usize) -> Vec<usize> {
    let mut kept: Vec<(usize, Vec<f64>)> = Vec::new();
    for (i, row) in rows.iter().enumerate() {
        let own = energy(row, row, flexibility, n);
        let mut rest = row.clone();
        for _ in 0..2 {
            for (_, other) in &kept {
                let share = energy(&rest, other, flexibility, n);
                rest.iter_mut().zip(other).for_each(|(r, o)| *r -= share * o);
            }
        }
        let left = energy(&rest, &rest, flexibility, n);
        if own > 0.0 && left > 1e-10 * own && kept.len() < n {
            rest.iter_mut().for_each(|r| *r /= left.sqrt());
            kept.push((i, rest));
        }
    }
    kept.into_iter().map(|k| k.0).collect()
}

fn energy(a: &[f64], b: &[f64], flexibility: &[f64], n: usize) -> f64 {
    let d = dense::product(flexibility, b, n, n, 1);
    a.iter().zip(&d).map(|(x, y)| x * y).sum()
}

/// The lowest oscillations in which the named displacements rest, xᵀ M x = 1.
fn resting(p: &[f64], reduced: &super::reduced::Reduced<f64>, m: usize, count: usize) -> Result<Vec<Vec<f64>>, Fault> {
    let n = reduced.n();
    if m >= n {
        return Ok(Vec::new());
    }
    // columns that solve P x = 0: the pivots of P follow the others
    let rows: Vec<super::constraints::Row<f64>> =
        (0..m).map(|i| (0..n).filter(|j| p[i * n + j].abs() > 1e-14).map(|j| (j, p[i * n + j])).collect()).collect();
    let elimination = super::constraints::eliminate(n, &rows, &|i| i);
    let k = elimination.free.len();
    let mut basis = vec![0.0; n * k];
    for (i, row) in elimination.transform.iter().enumerate() {
        row.iter().for_each(|(j, c)| basis[i * k + j] = *c);
    }
    let (stiffness, mass) = (dense::congruence(&reduced.stiffness, &basis, n, k), dense::congruence(&reduced.mass, &basis, n, k));
    let found = crate::studies::structure_modes::lowest_dense(&stiffness, &mass, k, count)?;
    Ok((0..found.values.len()).map(|j| dense::product(&basis, found.shape(j), n, k, 1)).collect())
}
