//! Dense symmetric positive definite systems: M = L D Lᵀ.
//!
//! The mass matrix of a sound model is positive definite, because kinetic energy is; then L D Lᵀ needs no exchanges (Golub and Van Loan,
//! Matrix Computations, section 4.1). A pivot that is not positive is a finding about the model, not a matter for another method: zero
//! means a motion without inertia, negative means that some formula has left its domain (an inverse sine beyond 1, say).

/// Why a matrix cannot be factored; the row is the first one that fails.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Defect {
    /// The row depends on the rows before it.
    Singular(usize),
    /// The motions up to this row have negative energy.
    Indefinite(usize),
    /// A row of a general system depends on those before it, and an unknown is left open.
    Dependent { row: usize, unknown: usize },
}

/// A factored matrix; reused from call to call without allocation.
#[derive(Clone, Debug, Default)]
pub(crate) struct Factor {
    size: usize,
    /// Lower triangle as loaded, packed by rows.
    packed: Vec<f64>,
    /// L with D on the diagonal.
    square: Vec<f64>,
}

/// A pivot below this part, times n, of its scale (the largest entry of its row) has lost all digits to cancellation.
pub(crate) const SINGULAR: f64 = 4.0 * f64::EPSILON;

impl Factor {
    /// Takes the lower triangle of a matrix, by rows.
    pub(crate) fn load(&mut self, size: usize, entries: impl Iterator<Item = f64>) {
        self.size = size;
        self.packed.clear();
        self.packed.extend(entries);
        self.square.resize(size * size, 0.0);
    }

    /// d_j = m_jj - Σ_k l_jk² d_k,  l_ij = (m_ij - Σ_k l_ik l_jk d_k)/d_j.
    ///
    /// Entries that are not finite pass through and spoil the solution, which is reported where it is used.
    pub(crate) fn factor(&mut self) -> Result<(), Defect> {
        let n = self.size;
        let mut start = 0;
        for i in 0..n {
            let (done, row) = self.square.split_at_mut(i * n);
            let row = &mut row[..n];
            row[..=i].copy_from_slice(&self.packed[start..=start + i]);
            let diagonal = row[i];
            start += i + 1;
            // row holds c_ij = l_ij d_j until the end, then is divided
            for j in 0..i {
                let other = &done[j * n..j * n + j];
                let sum: f64 = other.iter().zip(&row[..j]).map(|(l, c)| l * c).sum();
                row[j] -= sum;
            }
            let mut pivot = diagonal;
            for j in 0..i {
                let l = row[j] / done[j * n + j];
                pivot -= l * row[j];
                row[j] = l;
            }
            let lost = SINGULAR * n as f64 * diagonal.abs();
            if pivot < -lost {
                return Err(Defect::Indefinite(i));
            }
            if pivot <= lost {
                return Err(Defect::Singular(i));
            }
            row[i] = pivot;
        }
        Ok(())
    }

    /// Replaces h, of the size of M, by M⁻¹ h.
    pub(crate) fn solve(&self, h: &mut [f64]) {
        match h {
            [a] => *a /= self.square[0],
            [a, b] => self.solve_two(a, b),
            [a, b, c] => self.solve_three(a, b, c),
            h => self.solve_many(h),
        }
    }

    /// The operations of [`Factor::solve_many`] in its order, without loops: most machines have few coordinates.
    fn solve_two(&self, a: &mut f64, b: &mut f64) {
        let Some([d0, _, l10, d1]) = self.square.first_chunk() else { return };
        *b -= l10 * *a;
        *a /= d0;
        *b /= d1;
        *a -= l10 * *b;
    }

    fn solve_three(&self, a: &mut f64, b: &mut f64, c: &mut f64) {
        let Some([d0, _, _, l10, d1, _, l20, l21, d2]) = self.square.first_chunk() else { return };
        *b -= l10 * *a;
        *c = (*c - l20 * *a) - l21 * *b;
        *a /= d0;
        *b /= d1;
        *c /= d2;
        *a -= l20 * *c;
        *b -= l21 * *c;
        *a -= l10 * *b;
    }

    fn solve_many(&self, h: &mut [f64]) {
        let n = self.size;
        for i in 0..n {
            let row = &self.square[i * n..i * n + i];
            let mut value = h[i];
            for (l, x) in row.iter().zip(&h[..i]) {
                value -= l * x;
            }
            h[i] = value;
        }
        for (i, value) in h.iter_mut().enumerate() {
            *value /= self.square[i * n + i];
        }
        for i in (0..n).rev() {
            let value = h[i];
            let row = &self.square[i * n..i * n + i];
            for (l, x) in row.iter().zip(&mut h[..i]) {
                *x -= l * value;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{Defect, Factor};

    fn solved(matrix: &[f64], h: &[f64]) -> Result<Vec<f64>, Defect> {
        let mut factor = Factor::default();
        factor.load(h.len(), matrix.iter().copied());
        factor.factor()?;
        let mut x = h.to_vec();
        factor.solve(&mut x);
        Ok(x)
    }

    #[test]
    fn positive_definite_system_is_solved() {
        // [[4, 1], [1, 3]] x = [1, 2] has x = [1/11, 7/11]
        let x = solved(&[4.0, 1.0, 3.0], &[1.0, 2.0]).unwrap();
        // the last place of either
        assert!((x[0] - 1.0 / 11.0).abs() < 1e-16 && (x[1] - 7.0 / 11.0).abs() < 2e-16);
    }

    #[test]
    fn small_sizes_are_solved_as_large_ones() {
        let matrix = [4.0, 1.1, 3.0, 0.7, -0.3, 5.0];
        for n in 1..=3 {
            let mut factor = Factor::default();
            factor.load(n, matrix[..n * (n + 1) / 2].iter().copied());
            factor.factor().unwrap();
            let (mut small, mut large) = (vec![0.3, -1.7, 2.9], vec![0.3, -1.7, 2.9]);
            factor.solve(&mut small[..n]);
            factor.solve_many(&mut large[..n]);
            assert_eq!(small, large);
        }
    }

    #[test]
    fn a_matrix_that_is_no_mass_matrix_is_refused_by_kind() {
        assert_eq!(solved(&[1.0, 1.0, 1.0], &[1.0, 1.0]), Err(Defect::Singular(1)));
        assert_eq!(solved(&[0.0], &[1.0]), Err(Defect::Singular(0)));
        assert_eq!(solved(&[1.0, 2.0, 1.0], &[1.0, 1.0]), Err(Defect::Indefinite(1)));
        assert_eq!(solved(&[-2.0], &[1.0]), Err(Defect::Indefinite(0)));
    }

    #[test]
    fn badly_scaled_diagonal_is_not_singular() {
        assert_eq!(solved(&[1e20, 0.0, 1e-20], &[1e20, 1e-20]), Ok(vec![1.0, 1.0]));
    }
}
