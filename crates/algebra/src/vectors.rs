//! Lengths and products of vectors.

/// Squares between these neither overflow nor lose digits.
const SQUARES: std::ops::Range<f64> = 1e-280..1e300;

/// Length of a vector.
pub fn norm(v: &[f64]) -> f64 {
    let square: f64 = v.iter().map(|a| a * a).sum();
    if SQUARES.contains(&square) {
        return square.sqrt();
    }
    let largest = v.iter().fold(0.0_f64, |m, a| m.max(a.abs()));
    if largest == 0.0 || !largest.is_finite() {
        return square.sqrt();
    }
    largest * v.iter().map(|a| (a / largest) * (a / largest)).sum::<f64>().sqrt()
}

/// a·b, in the order of the entries.
pub fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}

/// Perpendicular unit vectors, one after another (Gram-Schmidt, twice is enough).
///
/// *Source*: L. Giraud, J. Langou, M. Rozložník, The loss of orthogonality in the Gram-Schmidt orthogonalization process, Comput. Math. Appl. 50 (2005).
#[derive(Clone, Debug, Default)]
pub struct Basis(Vec<Vec<f64>>);

impl Basis {
    /// Takes a vector whose part perpendicular to those before is longer than `nothing`, which is not negative; says whether it did.
    pub fn takes(&mut self, vector: &[f64], nothing: f64) -> bool {
        let mut left = vector.to_vec();
        for _ in 0..2 {
            for b in &self.0 {
                let share = dot(b, &left);
                left.iter_mut().zip(b).for_each(|(l, b)| *l -= share * b);
            }
        }
        let rest = norm(&left);
        let is_new = rest > nothing;
        if is_new {
            left.iter_mut().for_each(|l| *l /= rest);
            self.0.push(left);
        }
        is_new
    }

    /// The vectors, orthonormal.
    pub fn into_vectors(self) -> Vec<Vec<f64>> {
        self.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_basis_takes_what_is_independent() {
        let mut basis = Basis::default();
        let [a, b] = [[1.0, 2.0, 2.0], [1.0, 2.0, 2.000001]];
        let sum = [0, 1, 2].map(|i| 3.0 * a[i] - 2.0 * b[i]);
        assert!(!basis.takes(&[0.0; 3], 0.0) && basis.takes(&a, 1e-9) && basis.takes(&b, 1e-9) && !basis.takes(&sum, 1e-9));
        // the small part of b is perpendicular to a in all digits, though six of them cancelled
        assert!(dot(&basis.0[0], &basis.0[1]).abs() < 2.0 * f64::EPSILON);
    }

    #[test]
    fn lengths_of_tiny_and_huge_vectors() {
        // a quotient, a square, a sum, a root and a product are rounded
        let close = |length: f64, exact: f64| (length / exact - 1.0).abs() <= 4.0 * f64::EPSILON;
        assert!(close(norm(&[3e-200, 4e-200]), 5e-200) && close(norm(&[3e200, 4e200]), 5e200));
        assert_eq!(norm(&[]), 0.0);
        assert!(norm(&[f64::NAN]).is_nan());
    }
}
