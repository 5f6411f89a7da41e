//! Which equations of equilibrium along coordinates say more than the balances of released bodies.
//!
//! By virtual work the equation of a coordinate that moves released bodies alone is a sum of their balances, whatever the loads:
//!
//! ```text
//! row_j = Σ c_i row_i      with c of the geometry alone
//! ```
//!
//! Rows are compared as vectors: the factors of all unknown reactions, what is free of them, and its change with every parameter that is in none of the factors (masses,
//! loads). They are taken beside the start and with other numbers, as at one position factors may vanish that do not elsewhere.

use algebra::elementary;
use symbolic::Equations;

use crate::rest::numbers::Numbers;
use crate::rest::rows::{rows_of, with_shares};

/// Change of numbers, relative or, of zeros, in their unit.
const MOVED: f64 = 0.03;

/// Coordinates whose equation is no sum of the balances and of the equations of coordinates before it.
///
/// *Shapes*: parameters; coordinates of the start first; the unknown reactions by index.
pub(super) fn telling(equations: &Equations, (parameters, start): (&[f64], &[f64]), unknowns: &[usize]) -> Vec<usize> {
    let n = equations.coordinates.len();
    let moved = |list: &[f64]| list.iter().enumerate().map(|(i, x)| beside(*x, elementary::sin(1.0 + i as f64))).collect::<Vec<f64>>();
    let (others, places) = (moved(parameters), moved(&start[..n]));
    let vectors = vectors(equations, (&others, &places), unknowns)
        .or_else(|| vectors(equations, (parameters, &start[..n]), unknowns))
        .unwrap_or_default();
    // balances first
    let b = equations.balances.len();
    let order: Vec<Vec<f64>> = vectors.iter().skip(n).chain(vectors.iter().take(n)).cloned().collect();
    let dependent: Vec<usize> = with_shares(&order).into_iter().map(|(i, _)| i).collect();
    (b..order.len()).filter(|i| !dependent.contains(i)).map(|i| i - b).collect()
}

fn beside(x: f64, share: f64) -> f64 {
    if x == 0.0 { MOVED * share } else { x * (1.0 + MOVED * share) }
}

/// Rows of coordinates, then of balances, each of length 1 or 0, columns of one size; none where a formula has no value.
fn vectors(equations: &Equations, (parameters, q): (&[f64], &[f64]), unknowns: &[usize]) -> Option<Vec<Vec<f64>>> {
    let width = unknowns.len() + 1;
    let roots = rows_of(equations, unknowns);
    let values = |parameters: &[f64]| Numbers::at_rest(equations, parameters, q).evaluate(&roots);
    let own = values(parameters);
    if !own.iter().all(|v| v.is_finite()) {
        return None;
    }
    let mut rows: Vec<Vec<f64>> = own.chunks(width).map(<[f64]>::to_vec).collect();
    for p in 0..parameters.len() {
        let mut others = parameters.to_vec();
        others[p] = beside(others[p], 1.0);
        let there = values(&others);
        let of_load = own.iter().zip(&there).enumerate().all(|(i, (a, b))| i % width == width - 1 || a == b);
        if of_load && there.iter().all(|v| v.is_finite()) {
            rows.iter_mut().enumerate().for_each(|(r, row)| row.push(there[r * width + width - 1] - own[r * width + width - 1]));
        }
    }
    Some(of_one_size(rows))
}

/// Columns divided by their largest entries.
fn of_one_size(mut rows: Vec<Vec<f64>>) -> Vec<Vec<f64>> {
    for column in 0..rows.first().map_or(0, Vec::len) {
        let largest = rows.iter().fold(0.0_f64, |m, row| m.max(row[column].abs()));
        if largest > 0.0 {
            rows.iter_mut().for_each(|row| row[column] /= largest);
        }
    }
    rows
}
