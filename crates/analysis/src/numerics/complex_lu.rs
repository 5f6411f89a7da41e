//! Dense complex linear systems of a few dozen unknowns.

use super::complex::Complex;

/// L U factors of a square complex matrix, rows scaled and exchanged.
#[derive(Clone, Debug, Default)]
pub struct ComplexLu {
    n: usize,
    /// Row-major factors; the diagonal holds the reciprocals of the pivots.
    factors: Vec<Complex>,
    rows: Vec<usize>,
    /// 1 / largest entry of each row.
    scales: Vec<f64>,
}

fn size(z: Complex) -> f64 {
    z.re.abs() + z.im.abs()
}

impl ComplexLu {
    /// Factors a row-major n x n matrix; none when it is singular or not finite.
    ///
    /// *Source*: G. H. Golub, C. F. Van Loan, Matrix Computations, 3.4, with row scaling.
    pub fn new(matrix: &[Complex], n: usize) -> Option<ComplexLu> {
        let largest = |i: usize| matrix[i * n..(i + 1) * n].iter().fold(0.0_f64, |m, z| m.max(size(*z)));
        let scales: Vec<f64> = (0..n).map(|i| 1.0 / largest(i)).collect();
        let factors = (0..n * n).map(|k| matrix[k].scale(scales[k / n])).collect();
        let mut lu = ComplexLu { n, factors, rows: (0..n).collect(), scales };
        (0..n).all(|k| lu.eliminate(k)).then_some(lu)
    }

    fn eliminate(&mut self, k: usize) -> bool {
        let n = self.n;
        let column = |lu: &ComplexLu, i: usize| size(lu.factors[i * n + k]);
        let pivot = (k..n).fold(k, |best, i| if column(self, i) > column(self, best) { i } else { best });
        let largest = column(self, pivot);
        if !(largest > 0.0 && largest.is_finite()) {
            return false;
        }
        if pivot != k {
            (0..n).for_each(|j| self.factors.swap(k * n + j, pivot * n + j));
            self.rows.swap(k, pivot);
        }
        let inverse = Complex::ONE / self.factors[k * n + k];
        self.factors[k * n + k] = inverse;
        let (done, rest) = self.factors.split_at_mut((k + 1) * n);
        let top = &done[k * n..];
        for row in rest.chunks_mut(n) {
            if size(row[k]) == 0.0 {
                continue;
            }
            let factor = row[k] * inverse;
            row[k] = factor;
            for (a, b) in row[k + 1..].iter_mut().zip(&top[k + 1..]) {
                *a = *a - factor * *b;
            }
        }
        true
    }

    /// Replaces b by the solution of A x = b.
    pub fn solve(&self, b: &mut [Complex]) {
        let n = self.n;
        let mut x: Vec<Complex> = self.rows.iter().map(|&i| b[i].scale(self.scales[i])).collect();
        for i in 0..n {
            let (known, rest) = x.split_at_mut(i);
            for (l, v) in self.factors[i * n..i * n + i].iter().zip(known) {
                rest[0] = rest[0] - *l * *v;
            }
        }
        for i in (0..n).rev() {
            let (head, known) = x.split_at_mut(i + 1);
            for (u, v) in self.factors[i * n + i + 1..(i + 1) * n].iter().zip(known) {
                head[i] = head[i] - *u * *v;
            }
            head[i] = head[i] * self.factors[i * n + i];
        }
        b.copy_from_slice(&x);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn solves_a_badly_scaled_system() {
        let c = Complex::new;
        let a = [c(0.0, 0.0), c(2e9, 1e9), c(3e-7, 1e-7), c(0.0, -2e-7)];
        let x = [c(1.0, -2.0), c(0.5, 3.0)];
        let mut b = [a[0] * x[0] + a[1] * x[1], a[2] * x[0] + a[3] * x[1]];
        ComplexLu::new(&a, 2).unwrap().solve(&mut b);
        assert!(b.iter().zip(x).all(|(got, want)| (*got - want).abs() < 1e-14), "{b:?}");
    }

    #[test]
    fn singular_matrix_has_no_factors() {
        let c = Complex::real;
        assert!(ComplexLu::new(&[c(1.0), c(2.0), c(2.0), c(4.0)], 2).is_none());
        assert!(ComplexLu::new(&[c(f64::NAN)], 1).is_none());
    }
}
