//! Coordinates of a frame that have nothing to do with each other: the two kinds of motion of a symmetric frame.
//!
//! Shapes and static displacements come out of eliminations, so that the entries of M and K between the two kinds are rounding and not zero; a load of one
//! kind would excite the other by as much. Where all entries between two groups of coordinates are as small as that they are zero.

/// Entries below this share of the geometric mean of their diagonal ones may be rounding: shapes are known to some 1e-9.
const ROUNDING: f64 = 1e-8;

/// Groups of coordinates, row-major matrices of order `n`: the number of its group for each.
pub(super) fn groups(matrices: [&[f64]; 2], n: usize) -> Vec<usize> {
    let mut group: Vec<usize> = (0..n).collect();
    for (i, j) in (0..n).flat_map(|i| (0..i).map(move |j| (i, j))) {
        let ties = |a: &&[f64]| a[i * n + j].abs() > ROUNDING * (a[i * n + i] * a[j * n + j]).abs().sqrt();
        if group[i] != group[j] && matrices.iter().any(ties) {
            let (from, to) = (group[i].max(group[j]), group[i].min(group[j]));
            group.iter_mut().filter(|g| **g == from).for_each(|g| *g = to);
        }
    }
    group
}

/// Generalised forces without those on groups that they excite by rounding only; `stiffness` makes forces of unlike units comparable.
pub(super) fn on_groups(forces: &mut [f64], group: &[usize], stiffness: &[f64]) {
    let n = forces.len();
    let size = |i: usize, forces: &[f64]| {
        let own = stiffness[i * n + i].abs().sqrt();
        if own > 0.0 { forces[i].abs() / own } else { f64::INFINITY }
    };
    let of_group = |g: usize, forces: &[f64]| (0..n).filter(|i| group[*i] == g).map(|i| size(i, forces)).fold(0.0, f64::max);
    let largest = (0..n).map(|i| size(i, forces)).fold(0.0, f64::max);
    let idle: Vec<usize> = (0..n).filter(|i| of_group(group[*i], forces) <= ROUNDING * largest).collect();
    idle.into_iter().for_each(|i| forces[i] = 0.0);
}
