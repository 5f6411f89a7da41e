//! Q R factors with column pivoting: independent columns, least squares, least changes.
//!
//! *Source*: P. Businger, G. H. Golub, Linear least squares solutions by Householder transformations, Numerische Mathematik 7 (1965) 269-276.

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
}

/// What is left of a column is dependent below this share of the column itself.
pub const DEPENDENT: f64 = 1e-10;

impl Qr {
    /// Factors a row-major m x n matrix. Columns are compared after scaling to unit length, so that units do not matter.
    pub fn new(matrix: &[f64], rows: usize, columns: usize) -> Qr {
        let qr = Qr::loaded(matrix, rows, columns);
        let lengths: Vec<f64> = (0..columns).map(|j| norm(&qr.factors[j * rows..(j + 1) * rows])).collect();
        qr.factored(&lengths)
    }

    /// The same for columns that are compared as they are, of which no more than `most` are independent anywhere: those left when so many have been taken
    /// differ from the others by rounding only.
    pub fn measured(matrix: &[f64], rows: usize, columns: usize, most: usize) -> Qr {
        Qr { most, ..Qr::loaded(matrix, rows, columns) }.factored(&vec![1.0; columns])
    }

    fn loaded(matrix: &[f64], rows: usize, columns: usize) -> Qr {
        let factors = (0..rows * columns).map(|k| matrix[(k % rows) * columns + k / rows]).collect();
        Qr { rows, columns, factors, order: (0..columns).collect(), most: columns, ..Qr::default() }
    }

    fn factored(mut self, lengths: &[f64]) -> Qr {
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
            if best.1.is_nan() || best.1 <= DEPENDENT {
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
        for i in (0..self.rank).rev() {
            let known: f64 = (i + 1..self.rank).map(|j| self.r(i, j) * x[self.order[j]]).sum();
            x[self.order[i]] = (b[i] - known) / self.r(i, i);
        }
        (x, norm(&b[self.rank..]))
    }

    /// The shortest y with a_j·y = b_j for the independent columns a_j.
    pub fn shortest(&self, b: &[f64]) -> Vec<f64> {
        let mut y = vec![0.0; self.rows];
        for i in 0..self.rank {
            let known: f64 = (0..i).map(|j| self.r(j, i) * y[j]).sum();
            y[i] = (b[self.order[i]] - known) / self.r(i, i);
        }
        (0..self.rank).rev().for_each(|k| self.turn(k, &mut y));
        y
    }
}

/// Length of a vector.
pub fn norm(v: &[f64]) -> f64 {
    v.iter().map(|a| a * a).sum::<f64>().sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// 3 x 3 of rank 2: column 2 = column 0 + 2 column 1.
    const TWO: [f64; 9] = [1.0, 0.0, 1.0, 0.0, 1.0, 2.0, 1.0, 1.0, 3.0];

    #[test]
    fn rank_and_least_squares() {
        let qr = Qr::new(&TWO, 3, 3);
        assert_eq!(qr.rank(), 2);
        let (x, rest) = qr.least_squares(&[1.0, 2.0, 3.0]);
        let product: Vec<f64> = (0..3).map(|i| (0..3).map(|j| TWO[3 * i + j] * x[j]).sum()).collect();
        assert!(rest < 1e-15 && product.iter().zip([1.0, 2.0, 3.0]).all(|(a, b)| (a - b).abs() < 1e-14));
        let (_, rest) = qr.least_squares(&[0.0, 0.0, 1.0]);
        assert!((rest - 1.0 / 3.0_f64.sqrt()).abs() < 1e-15);
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
        assert!(qr.shortest(&[3.0]).iter().all(|y| (y - 1.0).abs() < 1e-15));
        // rows of different units: the rank does not change
        let tiny: Vec<f64> = TWO.iter().enumerate().map(|(k, a)| a * [1e-9, 1.0, 1e9][k % 3]).collect();
        assert_eq!(Qr::new(&tiny, 3, 3).rank(), 2);
    }
}
