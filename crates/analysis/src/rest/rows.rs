//! Equations of equilibrium as rows of factors, and which vectors depend on which.

use symbolic::{Equations, Expr};

use algebra::qr::Qr;
use algebra::vectors::norm;

/// Share below which a remainder counts as nothing.
pub(crate) const NOTHING: f64 = 1e-9;

/// Σ forces λ + h of each coordinate, Σ released λ + rest of each balance: row by row the factors of the unknowns, last what is free of them.
pub(crate) fn rows_of(equations: &Equations, unknowns: &[usize]) -> Vec<Expr> {
    let (n, b, width) = (equations.coordinates.len(), equations.balances.len(), unknowns.len() + 1);
    let zero = equations.graph.clone().zero();
    let mut roots: Vec<Expr> = vec![zero; (n + b) * width];
    for (k, &r) in unknowns.iter().enumerate() {
        let reaction = &equations.reactions[r];
        reaction.forces.iter().for_each(|(j, e)| roots[j * width + k] = *e);
        reaction.released.iter().for_each(|(i, e)| roots[(n + i) * width + k] = *e);
    }
    let free = equations.force.iter().copied().chain(equations.balances.iter().map(|balance| balance.rest));
    free.enumerate().for_each(|(row, e)| roots[row * width + width - 1] = e);
    roots
}

/// Independent vectors, and for each dependent one those it combines from.
pub(crate) fn independent(vectors: &[Vec<f64>]) -> (Vec<usize>, Vec<(usize, Vec<usize>)>) {
    let relations = with_shares(vectors);
    let dependent: Vec<usize> = relations.iter().map(|r| r.0).collect();
    let kept = (0..vectors.len()).filter(|k| !dependent.contains(k)).collect();
    (kept, relations.into_iter().map(|(k, shares)| (k, shares.into_iter().map(|s| s.0).collect())).collect())
}

/// Each vector that depends on those before it, with its shares of these.
pub(crate) fn with_shares(vectors: &[Vec<f64>]) -> Vec<(usize, Vec<(usize, f64)>)> {
    let mut kept: Vec<usize> = Vec::new();
    let mut relations = Vec::new();
    for (i, vector) in vectors.iter().enumerate() {
        let (m, n) = (vector.len(), kept.len());
        let length = norm(vector);
        let (shares, rest) = if n == 0 || length == 0.0 {
            (Vec::new(), length)
        } else {
            let matrix: Vec<f64> = (0..m * n).map(|p| vectors[kept[p % n]][p / n]).collect();
            let (c, _) = Qr::new(&matrix, m, n).least_squares(vector);
            let left: Vec<f64> = (0..m).map(|p| vector[p] - (0..n).map(|k| matrix[p * n + k] * c[k]).sum::<f64>()).collect();
            (c, norm(&left))
        };
        if length > 0.0 && rest > NOTHING * length && kept.len() < m {
            kept.push(i);
        } else {
            let list = kept.iter().copied().zip(shares).filter(|(_, c)| c.abs() > NOTHING).collect();
            relations.push((i, list));
        }
    }
    relations
}
