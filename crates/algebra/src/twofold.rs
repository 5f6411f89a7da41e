//! Sparse symmetric matrices in twice the digits: products, A = L D Lᵀ, solutions, inertia.
//!
//! The stiffness of a stiff frame on soft springs is a sum in which the springs lie below the last digit of the rods; in twice the digits both are there.
//! Elimination goes row by row on the pattern that the elimination tree gives. *Source*: T. A. Davis, Direct Methods for Sparse Linear Systems, 4.

use crate::double::Double;
use crate::kernels::{Columns, Plan};
use crate::sparse::{Sparse, Triplets};
use crate::trouble::{Defect, Pivot, Trouble};

/// A pivot below this share of its diagonal entry is what rounding leaves of zero: products carry 1e-32, and a chain of thousands of parts adds four decades.
const SMALLEST: f64 = 1e-27;

/// Products of an elimination beyond which a factor in twice the digits costs seconds.
const DEAR: f64 = 2e8;

/// A symmetric matrix by columns of its lower triangle: (row, value), rows ascending.
#[derive(Clone, Debug, Default)]
pub struct Twofold {
    columns: Vec<Vec<(usize, Double)>>,
}

impl Twofold {
    /// From entries (row, column, value) of the lower triangle, each place once.
    pub fn new(n: usize, entries: impl Iterator<Item = (usize, usize, Double)>) -> Twofold {
        let mut columns = vec![Vec::new(); n];
        entries.filter(|e| !e.2.is_zero()).for_each(|(i, j, v)| columns[i.min(j)].push((i.max(j), v)));
        columns.iter_mut().for_each(|c| c.sort_by_key(|e| e.0));
        Twofold { columns }
    }

    /// The diagonal.
    pub fn diagonal(&self) -> Vec<Double> {
        let own = |(j, column): (usize, &Vec<(usize, Double)>)| column.first().filter(|e| e.0 == j).map_or(Double::default(), |e| e.1);
        self.columns.iter().enumerate().map(own).collect()
    }

    /// From a dense row-major matrix; its lower triangle is read.
    pub fn from_dense(n: usize, matrix: &[Double]) -> Twofold {
        Twofold::new(n, (0..n).flat_map(|i| (0..=i).map(move |j| (i, j, matrix[i * n + j]))))
    }

    /// Number of rows.
    pub fn size(&self) -> usize {
        self.columns.len()
    }

    fn entries(&self) -> impl Iterator<Item = (usize, usize, Double)> + '_ {
        self.columns.iter().enumerate().flat_map(|(j, column)| column.iter().map(move |(i, v)| (*i, j, *v)))
    }

    /// The nearest matrix of single numbers.
    ///
    /// *Errors*: numbers that are not finite.
    pub fn rounded(&self) -> Result<Sparse, Trouble> {
        let mut triplets = Triplets::new(self.size());
        self.entries().for_each(|(i, j, v)| triplets.add(i, j, v.round()));
        Sparse::from_triplets(&triplets)
    }

    /// A x.
    pub fn product(&self, x: &[Double]) -> Vec<Double> {
        let mut out = vec![Double::default(); self.size()];
        for (i, j, v) in self.entries() {
            out[i] = out[i].plus(v, x[j]);
            if i != j {
                out[j] = out[j].plus(v, x[i]);
            }
        }
        out
    }

    /// xᵀ A x / xᵀ M x.
    pub fn quotient(&self, mass: &Twofold, x: &[f64]) -> f64 {
        let x: Vec<Double> = x.iter().map(|v| Double::from(*v)).collect();
        let form = |a: &Twofold| a.product(&x).iter().zip(&x).fold(Double::default(), |sum, (a, x)| sum.plus(*a, *x));
        form(self).over(form(mass)).round()
    }

    /// Self - s other.
    #[must_use]
    pub fn shifted(&self, s: f64, other: &Twofold) -> Twofold {
        let mut columns = self.columns.clone();
        let s = Double::from(-s);
        for (i, j, v) in other.entries() {
            let column = &mut columns[j];
            match column.binary_search_by_key(&i, |e| e.0) {
                Ok(at) => column[at].1 = column[at].1.plus(s, v),
                Err(at) => column.insert(at, (i, s.times(v))),
            }
        }
        Twofold { columns }
    }

    /// Order of elimination by minimum degree.
    fn order(&self) -> Option<Vec<usize>> {
        let n = self.size();
        let (mut starts, mut rows) = (vec![0], Vec::new());
        for (j, column) in self.columns.iter().enumerate() {
            rows.push(j);
            rows.extend(column.iter().map(|e| e.0).filter(|i| *i != j));
            starts.push(rows.len());
        }
        Some(Plan::new(Columns { n, starts: &starts, rows: &rows }, None)?.order())
    }

    /// L D Lᵀ in an order of minimum degree; none where it would cost more than a few seconds.
    pub fn factor(&self) -> Option<Factor> {
        let n = self.size();
        let order = self.order()?;
        let mut place = vec![0; n];
        order.iter().enumerate().for_each(|(k, i)| place[*i] = k);
        let mut upper: Vec<Vec<(usize, Double)>> = vec![Vec::new(); n];
        for (i, j, v) in self.entries() {
            let (a, b) = (place[i], place[j]);
            upper[a.max(b)].push((a.min(b), v));
        }
        let (parent, counts) = tree(&upper);
        let cost: f64 = counts.iter().map(|c| (*c as f64) * (*c as f64)).sum();
        (cost <= DEAR).then(|| eliminate(order, &upper, &parent))
    }
}

/// Parents in the elimination tree, and entries below the diagonal of each column of L.
fn tree(upper: &[Vec<(usize, Double)>]) -> (Vec<usize>, Vec<usize>) {
    let n = upper.len();
    let (mut parent, mut counts, mut seen) = (vec![usize::MAX; n], vec![0; n], vec![usize::MAX; n]);
    for (k, column) in upper.iter().enumerate() {
        seen[k] = k;
        for (start, _) in column {
            let mut i = *start;
            while seen[i] != k {
                if parent[i] == usize::MAX {
                    parent[i] = k;
                }
                counts[i] += 1;
                seen[i] = k;
                i = parent[i];
            }
        }
    }
    (parent, counts)
}

/// Row k of L solves L D l = a_k with the rows above it.
fn eliminate(order: Vec<usize>, upper: &[Vec<(usize, Double)>], parent: &[usize]) -> Factor {
    let n = upper.len();
    let mut lower: Vec<Vec<(usize, Double)>> = vec![Vec::new(); n];
    let (mut pivots, mut diagonal) = (Vec::with_capacity(n), Vec::with_capacity(n));
    let (mut work, mut seen) = (vec![Double::default(); n], vec![usize::MAX; n]);
    for (k, column) in upper.iter().enumerate() {
        seen[k] = k;
        let mut pattern: Vec<usize> = Vec::new();
        for (start, v) in column {
            work[*start] = work[*start].sum(*v);
            let (mut i, mut path) = (*start, Vec::new());
            while seen[i] != k {
                path.push(i);
                seen[i] = k;
                i = parent[i];
            }
            // a path ends where an earlier one has been: it goes before that one
            pattern.splice(0..0, path);
        }
        let mut pivot = std::mem::take(&mut work[k]);
        diagonal.push(pivot.round().abs());
        for i in pattern {
            let y = std::mem::take(&mut work[i]);
            let minus = y.negated();
            lower[i].iter().for_each(|(row, l)| work[*row] = work[*row].plus(*l, minus));
            let l = y.over(pivots[i]);
            pivot = pivot.plus(l, minus);
            lower[i].push((k, l));
        }
        pivots.push(pivot);
    }
    Factor { order, lower, pivots, diagonal }
}

/// P A Pᵀ = L D Lᵀ.
#[derive(Clone, Debug)]
pub struct Factor {
    order: Vec<usize>,
    /// Entries of each column of L below its diagonal of ones.
    lower: Vec<Vec<(usize, Double)>>,
    pivots: Vec<Double>,
    /// Diagonal entries of A in the order of elimination.
    diagonal: Vec<f64>,
}

impl Factor {
    fn vanishes(&self, k: usize) -> bool {
        let pivot = self.pivots[k].round().abs();
        !pivot.is_finite() || pivot <= SMALLEST * self.diagonal[k]
    }

    /// The first pivot that vanishes or is negative, with the motion that it leaves free.
    pub fn defect(&self) -> Option<Pivot> {
        let k = (0..self.pivots.len()).find(|k| self.vanishes(*k) || self.pivots[*k].round() < 0.0)?;
        let defect = if self.vanishes(k) { Defect::Singular } else { Defect::Negative };
        let mut x = vec![Double::default(); self.pivots.len()];
        x[k] = Double::from(1.0);
        self.backward(&mut x);
        let mut motion = vec![0.0; x.len()];
        self.order.iter().zip(&x).for_each(|(i, v)| motion[*i] = v.round());
        Some(Pivot { row: self.order[k], defect, motion })
    }

    /// Number of negative eigenvalues; none where a pivot vanishes.
    pub fn negative(&self) -> Option<usize> {
        let n = self.pivots.len();
        (0..n).all(|k| !self.vanishes(k)).then(|| self.pivots.iter().filter(|d| d.round() < 0.0).count())
    }

    /// Number of negative pivots however small they are; none where one is no number. At a root of the determinant either neighbour's number may come.
    pub fn signs(&self) -> Option<usize> {
        let finite = self.pivots.iter().all(|d| d.round().is_finite());
        finite.then(|| self.pivots.iter().filter(|d| d.round() < 0.0).count())
    }

    fn backward(&self, x: &mut [Double]) {
        for j in (0..x.len()).rev() {
            let sum = self.lower[j].iter().fold(Double::default(), |sum, (i, l)| sum.plus(*l, x[*i]));
            x[j] = x[j].less(sum);
        }
    }

    /// A⁻¹ b.
    pub fn solve(&self, b: &[Double]) -> Vec<Double> {
        let mut x: Vec<Double> = self.order.iter().map(|i| b[*i]).collect();
        for j in 0..x.len() {
            let minus = x[j].negated();
            self.lower[j].iter().for_each(|(i, l)| x[*i] = x[*i].plus(*l, minus));
        }
        x.iter_mut().zip(&self.pivots).for_each(|(x, d)| *x = x.over(*d));
        self.backward(&mut x);
        let mut out = vec![Double::default(); x.len()];
        self.order.iter().zip(&x).for_each(|(i, v)| out[*i] = *v);
        out
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A grid whose stiffest and softest connections differ by 10^20 (decades that doubles do not have).
    fn grid(side: usize) -> Twofold {
        let n = side * side;
        let mut entries = Vec::new();
        let mut diagonal = vec![Double::from(1e-8); n];
        for i in 0..n {
            for j in [(i % side + 1 < side).then_some(i + 1), (i + side < n).then_some(i + side)].into_iter().flatten() {
                let c = Double::from(1e12 / (1 + (i * 7 + j) % 5) as f64);
                entries.push((j, i, c.negated()));
                diagonal[i] = diagonal[i].sum(c);
                diagonal[j] = diagonal[j].sum(c);
            }
        }
        entries.extend(diagonal.into_iter().enumerate().map(|(i, d)| (i, i, d)));
        Twofold::new(n, entries.into_iter())
    }

    #[test]
    fn soft_ground_under_a_stiff_grid_keeps_its_digits() {
        // the same displacement everywhere: 1 N on each point lies on 1e-8 N/m
        let a = grid(9);
        let x = a.factor().unwrap().solve(&vec![Double::from(1.0); a.size()]);
        // 32 digits less the 20 decades of the ratio
        assert!(x.iter().all(|v| (v.round() / 1e8 - 1.0).abs() < 1e-11), "{:?}", x[0]);
    }

    #[test]
    fn a_product_is_undone_and_signs_are_counted() {
        let a = grid(6);
        let x: Vec<Double> = (0..a.size()).map(|i| Double::from((i as f64 * 0.7).sin())).collect();
        let back = a.factor().unwrap().solve(&a.product(&x));
        // 32 digits less the 20 decades of the ratio
        assert!(back.iter().zip(&x).all(|(b, x)| (b.round() - x.round()).abs() < 1e-11));
        let unit = Twofold::new(a.size(), (0..a.size()).map(|i| (i, i, Double::from(1.0))));
        assert_eq!(a.factor().unwrap().negative(), Some(0));
        // one motion, that of the whole grid, lies below 1e-7, none below 1e-9
        assert_eq!(a.shifted(1e-7, &unit).factor().unwrap().negative(), Some(1));
        assert_eq!(a.shifted(1e-9, &unit).factor().unwrap().negative(), Some(0));
    }

    #[test]
    fn a_free_motion_is_found() {
        let one = Double::from(1.0);
        let pair = Twofold::from_dense(2, &[one, one.negated(), one.negated(), one]);
        let pivot = pair.factor().unwrap().defect().unwrap();
        assert_eq!((pivot.defect, pivot.motion), (Defect::Singular, vec![1.0, 1.0]));
    }
}
