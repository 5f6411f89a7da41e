//! Exact elimination of linear constraints C x = 0 between freedoms: Gauss-Jordan elimination on sparse rows gives x = T q with
//! independent q, a subset of x.
//!
//! The same elimination finds reactions: when r = K x - f are the forces that constraints must provide, and the rows of the reduced form are
//! R = W C, then r = Cᵀ λ with λ = Wᵀ r_p, where r_p are the components of r at the pivots. Rows that vanish name the constraints whose
//! forces statics alone does not determine.

use crate::Scalar;
use std::collections::BTreeMap;

/// A sparse row: (column, coefficient) by column, no zeros.
pub type Row<S> = Vec<(usize, S)>;

/// The reduced form.
#[derive(Clone, Debug)]
pub struct Elimination<S> {
    /// x = T q: each freedom over the independent ones.
    pub transform: Vec<Row<S>>,
    /// The independent freedoms: `q[i]` is `x[free[i]]`.
    pub free: Vec<usize>,
    /// Pivot of each independent constraint, and the combination of given constraints that it is.
    pivots: Vec<(usize, Row<S>)>,
    /// Combinations of constraints that vanish identically.
    pub redundant: Vec<Row<S>>,
    n_constraints: usize,
}

/// a + factor·b.
pub fn combine<S: Scalar>(a: &Row<S>, factor: &S, b: &Row<S>) -> Row<S> {
    let mut out = Vec::with_capacity(a.len() + b.len());
    let (mut i, mut j) = (0, 0);
    while i < a.len() || j < b.len() {
        let (ca, cb) = (a.get(i).map_or(usize::MAX, |t| t.0), b.get(j).map_or(usize::MAX, |t| t.0));
        if ca < cb {
            out.push(a[i].clone());
            i += 1;
        } else if cb < ca {
            out.push((cb, factor.mul(&b[j].1)));
            j += 1;
        } else {
            let (first, second) = (&a[i].1, factor.mul(&b[j].1));
            let sum = first.add(&second);
            if !sum.vanishes(first.size().max(second.size())) {
                out.push((ca, sum));
            }
            i += 1;
            j += 1;
        }
    }
    out
}

/// Eliminates the constraints, in order. `rank` orders the freedoms: of those with a sufficient coefficient the one of highest rank is
/// expressed by the others.
pub fn eliminate<S: Scalar>(n: usize, constraints: &[Row<S>], rank: &dyn Fn(usize) -> usize) -> Elimination<S> {
    let mut rows: Vec<(usize, Row<S>, Row<S>)> = Vec::new();
    let mut pivot_row: BTreeMap<usize, usize> = BTreeMap::new();
    // which reduced rows contain a column
    let mut users: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
    let mut redundant = Vec::new();
    for (i, constraint) in constraints.iter().enumerate() {
        let scale = constraint.iter().fold(0.0_f64, |m, t| m.max(t.1.size()));
        let (mut row, mut origin) = (constraint.clone(), vec![(i, S::one())]);
        for (column, _) in constraint {
            if let Some(&p) = pivot_row.get(column)
                && let Some((_, c)) = row.iter().find(|t| t.0 == *column).cloned()
            {
                row = combine(&row, &c.neg(), &rows[p].1);
                origin = combine(&origin, &c.neg(), &rows[p].2);
            }
        }
        row.retain(|t| !t.1.vanishes(scale));
        let largest = row.iter().fold(0.0_f64, |m, t| m.max(t.1.size()));
        let Some((pivot, coefficient)) = row.iter().filter(|t| t.1.size() >= 0.1 * largest).max_by_key(|t| rank(t.0)).cloned() else {
            redundant.push(origin);
            continue;
        };
        let divide = |r: &mut Row<S>| r.iter_mut().for_each(|t| t.1 = t.1.div(&coefficient));
        divide(&mut row);
        divide(&mut origin);
        for p in users.remove(&pivot).unwrap_or_default() {
            if let Some((_, c)) = rows[p].1.iter().find(|t| t.0 == pivot).cloned() {
                rows[p].1 = combine(&rows[p].1, &c.neg(), &row);
                rows[p].2 = combine(&rows[p].2, &c.neg(), &origin);
                row.iter().filter(|t| t.0 != pivot).for_each(|t| users.entry(t.0).or_default().push(p));
            }
        }
        row.iter().filter(|t| t.0 != pivot).for_each(|t| users.entry(t.0).or_default().push(rows.len()));
        pivot_row.insert(pivot, rows.len());
        rows.push((pivot, row, origin));
    }
    finish(n, constraints.len(), rows, &pivot_row, redundant)
}

fn finish<S: Scalar>(
    n: usize,
    n_constraints: usize,
    rows: Vec<(usize, Row<S>, Row<S>)>,
    pivot_row: &BTreeMap<usize, usize>,
    redundant: Vec<Row<S>>,
) -> Elimination<S> {
    let free: Vec<usize> = (0..n).filter(|c| !pivot_row.contains_key(c)).collect();
    let mut position = vec![usize::MAX; n];
    free.iter().enumerate().for_each(|(i, c)| position[*c] = i);
    let transform = (0..n)
        .map(|c| match pivot_row.get(&c) {
            None => vec![(position[c], S::one())],
            Some(&p) => rows[p].1.iter().filter(|t| t.0 != c).map(|t| (position[t.0], t.1.neg())).collect(),
        })
        .collect();
    let pivots = rows.into_iter().map(|(pivot, _, origin)| (pivot, origin)).collect();
    Elimination { transform, free, pivots, redundant, n_constraints }
}

impl<S: Scalar> Elimination<S> {
    /// All freedoms from the independent ones.
    pub fn expand(&self, q: &[S]) -> Vec<S> {
        self.transform.iter().map(|row| row.iter().fold(S::zero(), |sum, (j, c)| sum.add(&c.mul(&q[*j])))).collect()
    }
    /// Forces on the independent freedoms, Tᵀ f.
    pub fn gather(&self, forces: &[S]) -> Vec<S> {
        let mut out = vec![S::zero(); self.free.len()];
        for (row, f) in self.transform.iter().zip(forces) {
            row.iter().for_each(|(j, c)| out[*j] = out[*j].add(&c.mul(f)));
        }
        out
    }
    /// A linear functional of all freedoms as one of the independent ones; what cancels is zero: a point that a rigid rod carries along y alone has no part along x.
    pub fn pull(&self, row: &Row<S>) -> Vec<S> {
        let mut out = vec![S::zero(); self.free.len()];
        let mut sizes = vec![0.0_f64; self.free.len()];
        for (i, a) in row {
            for (j, c) in &self.transform[*i] {
                let term = c.mul(a);
                sizes[*j] += term.size();
                out[*j] = out[*j].add(&term);
            }
        }
        out.iter_mut().zip(sizes).filter(|(v, size)| v.vanishes(*size)).for_each(|(v, _)| *v = S::zero());
        out
    }
    /// The forces of the constraints from the forces that all constraints together give, r = Cᵀ λ; none where statics does not say.
    pub fn multipliers(&self, r: &[S]) -> Vec<Option<S>> {
        let mut out = vec![S::zero(); self.n_constraints];
        for (pivot, origin) in &self.pivots {
            origin.iter().for_each(|(i, w)| out[*i] = out[*i].add(&w.mul(&r[*pivot])));
        }
        let mut out: Vec<Option<S>> = out.into_iter().map(Some).collect();
        self.redundant.iter().flatten().for_each(|(i, _)| out[*i] = None);
        out
    }
}
