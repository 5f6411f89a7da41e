//! Q R factors with column pivoting: rank, null space, least squares, least changes.
//!
//! One rule says which columns are independent: what is left of a column beside those taken before it exceeds a share of its measure, [`DEPENDENT`] unless its
//! numbers are known less exactly. The measure is the column itself where columns have units of their own ([`Qr::new`]), the largest column where they are
//! scaled alike, so that a column of rounding counts as none ([`Qr::alike`]), or 1 where the scale is known beforehand ([`Qr::measured`]).
//!
//! *Source*: P. Businger, G. H. Golub, Linear least squares solutions by Householder transformations, Numerische Mathematik 7 (1965) 269-276.

use crate::vectors::norm;

/// A P = Q R of an m x n matrix.
#[derive(Clone, Debug, Default)]
pub struct Qr {
    rows: usize,
    columns: usize,
    /// By columns: R above the diagonal and on it, Householder vectors below.
    factors: Vec<f64>,
    /// First entry of each Householder vector; its reflection is I - beta v v'.
    heads: Vec<f64>,
    betas: Vec<f64>,
    /// Column of A that stands at each place.
    order: Vec<usize>,
    rank: usize,
    /// Rank that the columns have at best.
    most: usize,
    /// Whether each entry of A is something, by columns.
    filled: Vec<bool>,
}

/// What is left of a column is dependent below this share of its measure: entries come out of a few dozen operations, which leave some 1e-14 of them, and a thousand
/// times that is still far below any lever or stiffness that was meant.
pub const DEPENDENT: f64 = 1e-11;

impl Qr {
    /// Factors a row-major m x n matrix. Columns are compared after scaling to unit length, so that units do not matter.
    pub fn new(matrix: &[f64], rows: usize, columns: usize) -> Qr {
        Qr::own(matrix, rows, columns, DEPENDENT)
    }

    /// The same for columns that are known less exactly: what is left of one below a share of its own length is nothing.
    pub fn own(matrix: &[f64], rows: usize, columns: usize, share: f64) -> Qr {
        let qr = Qr::loaded(matrix, rows, columns);
        let lengths: Vec<f64> = (0..columns).map(|j| norm(&qr.factors[j * rows..(j + 1) * rows])).collect();
        qr.factored(&lengths, share)
    }

    /// The same for columns of like scale, compared with the largest of them.
    pub fn alike(matrix: &[f64], rows: usize, columns: usize, tolerance: f64) -> Qr {
        let qr = Qr::loaded(matrix, rows, columns);
        let largest = (0..columns).map(|j| norm(&qr.factors[j * rows..(j + 1) * rows])).fold(0.0, |m, l| if l <= m { m } else { l });
        qr.factored(&vec![largest; columns], tolerance)
    }

    /// The same for columns that are compared as they are, of which no more than `most` are independent anywhere: those left when so many have been taken
    /// differ from the others by rounding only.
    pub fn measured(matrix: &[f64], rows: usize, columns: usize, most: usize) -> Qr {
        Qr { most, ..Qr::loaded(matrix, rows, columns) }.factored(&vec![1.0; columns], DEPENDENT)
    }

    fn loaded(matrix: &[f64], rows: usize, columns: usize) -> Qr {
        let factors: Vec<f64> = (0..rows * columns).map(|k| matrix[(k % rows) * columns + k / rows]).collect();
        let filled = factors.iter().map(|entry| *entry != 0.0).collect();
        Qr { rows, columns, factors, filled, order: (0..columns).collect(), most: columns, ..Qr::default() }
    }

    fn factored(mut self, lengths: &[f64], tolerance: f64) -> Qr {
        let (rows, columns) = (self.rows, self.columns);
        let qr = &mut self;
        for k in 0..rows.min(qr.most) {
            // pivots by the share of each column that is still independent
            let share = |qr: &Qr, j: usize| {
                let left = norm(&qr.factors[j * rows + k..(j + 1) * rows]);
                let length = lengths[qr.order[j]];
                if length > 0.0 { left / length } else { 0.0 }
            };
            let mut best = (k, share(qr, k));
            for j in k + 1..columns {
                let value = share(qr, j);
                if value > best.1 {
                    best = (j, value);
                }
            }
            if best.1.is_nan() || best.1 <= tolerance {
                break;
            }
            qr.exchange(k, best.0);
            qr.reflect(k);
            qr.rank = k + 1;
        }
        self
    }

    /// Number of independent columns.
    pub fn rank(&self) -> usize {
        self.rank
    }

    /// The least distance of a column from those taken before it; 0 where one more depends on them than must.
    pub fn least_pivot(&self) -> f64 {
        if self.rank < self.most { 0.0 } else { (0..self.rank).fold(f64::INFINITY, |least, k| least.min(self.r(k, k).abs())) }
    }

    /// The independent columns, those that were taken first in front.
    pub fn independent(&self) -> &[usize] {
        &self.order[..self.rank]
    }

    /// The columns that depend on the independent ones.
    pub fn dependent(&self) -> &[usize] {
        &self.order[self.rank..]
    }

    fn exchange(&mut self, a: usize, b: usize) {
        if a != b {
            (0..self.rows).for_each(|i| self.factors.swap(a * self.rows + i, b * self.rows + i));
            self.order.swap(a, b);
        }
    }

    fn reflect(&mut self, k: usize) {
        let m = self.rows;
        let (done, rest) = self.factors.split_at_mut((k + 1) * m);
        let v = &mut done[k * m + k..];
        let length = norm(v);
        let alpha = if v[0] > 0.0 { -length } else { length };
        let head = v[0] - alpha;
        let tail: f64 = v[1..].iter().map(|x| x * x).sum();
        let square = head * head + tail;
        let beta = if square > 0.0 { 2.0 / square } else { 0.0 };
        for column in rest.chunks_exact_mut(m) {
            let c = &mut column[k..];
            let dot = head * c[0] + v[1..].iter().zip(&c[1..]).map(|(a, b)| a * b).sum::<f64>();
            c[0] -= beta * dot * head;
            for (c, v) in c[1..].iter_mut().zip(&v[1..]) {
                *c -= beta * dot * v;
            }
        }
        v[0] = alpha;
        self.heads.push(head);
        self.betas.push(beta);
    }

    /// Applies the reflection k to b.
    fn turn(&self, k: usize, b: &mut [f64]) {
        let m = self.rows;
        let v = &self.factors[k * m + k + 1..(k + 1) * m];
        let (head, beta) = (self.heads[k], self.betas[k]);
        let dot = head * b[k] + v.iter().zip(&b[k + 1..]).map(|(a, b)| a * b).sum::<f64>();
        b[k] -= beta * dot * head;
        for (b, v) in b[k + 1..].iter_mut().zip(v) {
            *b -= beta * dot * v;
        }
    }

    fn r(&self, i: usize, j: usize) -> f64 {
        self.factors[j * self.rows + i]
    }

    /// x with least |A x - b|; dependent columns get 0. The second result is |A x - b|.
    pub fn least_squares(&self, b: &[f64]) -> (Vec<f64>, f64) {
        let mut b = b.to_vec();
        (0..self.rank).for_each(|k| self.turn(k, &mut b));
        let mut x = vec![0.0; self.columns];
        self.back(|i| b[i], &mut x);
        (x, norm(&b[self.rank..]))
    }

    /// R x = c in the independent columns.
    fn back(&self, c: impl Fn(usize) -> f64, x: &mut [f64]) {
        for i in (0..self.rank).rev() {
            let known: f64 = (i + 1..self.rank).map(|j| self.r(i, j) * x[self.order[j]]).sum();
            x[self.order[i]] = (c(i) - known) / self.r(i, i);
        }
    }

    /// Directions v with A v = 0, one for each dependent column: 1 there, 0 in the other dependent ones.
    pub fn null_space(&self) -> Vec<Vec<f64>> {
        let direction = |j: usize| {
            let mut v = vec![0.0; self.columns];
            self.back(|i| -self.r(i, j), &mut v);
            v[self.order[j]] = 1.0;
            v
        };
        (self.rank..self.columns).map(direction).collect()
    }

    /// The shortest y with a_j·y = b_j for the independent columns a_j. What the columns with b_j = 0 alone concern stays exactly 0: reflections would leave
    /// the rounding of other columns there.
    pub fn shortest(&self, b: &[f64]) -> Vec<f64> {
        let mut y = vec![0.0; self.rows];
        for i in 0..self.rank {
            let known: f64 = (0..i).map(|j| self.r(j, i) * y[j]).sum();
            y[i] = (b[self.order[i]] - known) / self.r(i, i);
        }
        (0..self.rank).rev().for_each(|k| self.turn(k, &mut y));
        let concerned = self.concerned(b);
        y.iter_mut().zip(concerned).filter(|(_, concerned)| !concerned).for_each(|(y, _)| *y = 0.0);
        y
    }

    /// Rows that columns with b_j not 0 have entries in, or columns that share such rows with them, and so on.
    fn concerned(&self, b: &[f64]) -> Vec<bool> {
        let mut rows = vec![false; self.rows];
        let mut waiting: Vec<usize> = (0..self.columns).collect();
        let entries = |j: usize| self.filled[j * self.rows..(j + 1) * self.rows].iter();
        loop {
            let belongs = |j: &usize, rows: &[bool]| b[*j] != 0.0 || entries(*j).zip(rows).any(|(filled, row)| *filled && *row);
            let (taken, left): (Vec<usize>, Vec<usize>) = waiting.iter().partition(|j| belongs(j, &rows));
            for j in &taken {
                entries(*j).zip(&mut rows).filter(|(filled, _)| **filled).for_each(|(_, row)| *row = true);
            }
            if taken.is_empty() {
                return rows;
            }
            waiting = left;
        }
    }
}

/// Rank of a row-major m x n matrix whose columns are scaled alike.
pub fn rank(matrix: &[f64], rows: usize, columns: usize) -> usize {
    Qr::alike(matrix, rows, columns, DEPENDENT).rank()
}

/// Directions v with A v = 0 of a row-major m x n matrix whose columns are scaled alike, see [`Qr::null_space`].
pub fn null_space(matrix: &[f64], rows: usize, columns: usize) -> Vec<Vec<f64>> {
    Qr::alike(matrix, rows, columns, DEPENDENT).null_space()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A few operations on numbers about 1.
    const ROUNDING: f64 = 1e-15;
    /// Products of factors of a few rows.
    const FACTORED: f64 = 1e-14;

    /// 3 x 3 of rank 2: column 2 = column 0 + 2 column 1.
    const TWO: [f64; 9] = [1.0, 0.0, 1.0, 0.0, 1.0, 2.0, 1.0, 1.0, 3.0];

    #[test]
    fn rank_and_least_squares() {
        let qr = Qr::new(&TWO, 3, 3);
        assert_eq!(qr.rank(), 2);
        let (x, rest) = qr.least_squares(&[1.0, 2.0, 3.0]);
        let product: Vec<f64> = (0..3).map(|i| (0..3).map(|j| TWO[3 * i + j] * x[j]).sum()).collect();
        assert!(rest < ROUNDING && product.iter().zip([1.0, 2.0, 3.0]).all(|(a, b)| (a - b).abs() < FACTORED));
        let (_, rest) = qr.least_squares(&[0.0, 0.0, 1.0]);
        assert!((rest - 1.0 / 3.0_f64.sqrt()).abs() < ROUNDING);
    }

    #[test]
    fn columns_that_repeat_others_are_left_to_rounding() {
        let mut matrix = TWO;
        matrix[8] += 1e-14;
        matrix[0] = 1e-3;
        let qr = Qr::measured(&matrix, 3, 3, 2);
        assert_eq!((qr.rank(), Qr::measured(&TWO, 3, 3, 1).rank()), (2, 1));
        assert!(qr.least_pivot() > 0.1);
        assert_eq!(Qr::measured(&[1.0, 1.0, 0.0, 0.0], 2, 2, 2).least_pivot(), 0.0);
    }

    #[test]
    fn shortest_solution() {
        // x + y + z = 3 nearest to the origin
        let qr = Qr::new(&[1.0, 1.0, 1.0], 3, 1);
        assert!(qr.shortest(&[3.0]).iter().all(|y| (y - 1.0).abs() < ROUNDING));
        // rows of different units: the rank does not change
        let tiny: Vec<f64> = TWO.iter().enumerate().map(|(k, a)| a * [1e-9, 1.0, 1e9][k % 3]).collect();
        assert_eq!(Qr::new(&tiny, 3, 3).rank(), 2);
    }

    #[test]
    fn the_shortest_change_leaves_alone_what_it_does_not_concern() {
        // a third unknown alone is to change; then a pair is held beside it
        assert_eq!(Qr::new(&[0.0, 0.0, 0.3], 3, 1).shortest(&[1e-3])[..2], [0.0, 0.0]);
        let both = Qr::new(&[0.7, 0.0, 0.3, 0.0, 0.0, 0.9, 0.0, 0.1], 4, 2).shortest(&[0.0, 1e-3]);
        assert_eq!(both[..2], [0.0, 0.0]);
        // units of the last place of 1e-3
        assert!((0.9 * both[2] + 0.1 * both[3] - 1e-3).abs() < 1e-18);
    }

    #[test]
    fn rank_and_null_space_of_a_dependent_matrix() {
        let a = [1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0];
        assert_eq!(rank(&a, 3, 3), 2);
        let v = null_space(&a, 3, 3).remove(0);
        let t = v[0];
        assert!((v[1] + 2.0 * t).abs() < FACTORED && (v[2] - t).abs() < FACTORED, "{v:?}");
        assert_eq!(rank(&[0.0; 6], 2, 3), 0);
        assert_eq!(null_space(&[0.0; 6], 2, 3).len(), 3);
    }

    #[test]
    fn least_squares_line() {
        // y = 1 + 2 t through three points, the middle one 3 too high: shift 1 in the constant, residual sqrt(1 + 4 + 1)
        let (x, residual) = Qr::alike(&[1.0, -1.0, 1.0, 0.0, 1.0, 1.0], 3, 2, DEPENDENT).least_squares(&[-1.0, 4.0, 3.0]);
        assert!((x[0] - 2.0).abs() < FACTORED && (x[1] - 2.0).abs() < FACTORED);
        assert!((residual - 6.0_f64.sqrt()).abs() < FACTORED);
    }
}
