//! Linear systems solved with residuals in twice the digits: strong and weak parts beside each other.
//!
//! x ← x + A⁻¹ (b - A x) with A⁻¹ by plain elimination converges while elimination keeps one digit. *Source*: N. J. Higham, Accuracy and Stability of
//! Numerical Algorithms, ch. 12.

use super::double::Double;
use super::lu::Lu;
use super::qr::Qr;
use super::random::Random;

/// Corrections below this share are those of the last digits.
const ENDED: f64 = 1e-12;
/// Product of the sizes of a matrix and of its inverse, as vectors at random show it, up to which no pivot is in doubt.
const SOUND: f64 = 1e8;
/// Steps of refinement.
const REFINED: usize = 12;

/// A solver with refinement.
pub struct Factors {
    lu: Lu,
    qr: Option<Qr>,
    size: usize,
}

impl Factors {
    /// Of a row-major square matrix.
    pub fn new(matrix: &[f64], size: usize) -> Factors {
        let lu = Lu::new(matrix, size);
        // elimination gives up where a pivot is small
        let qr = lu.solve(&vec![0.0; size]).is_none().then(|| Qr::alike(matrix, size, size, f64::MIN_POSITIVE));
        Factors { lu, qr, size }
    }

    /// Whether a pivot is exactly zero.
    pub fn is_singular(&self) -> bool {
        self.qr.as_ref().is_some_and(|qr| qr.rank() < self.size)
    }

    /// Whether |A⁻¹| |A| is surely far below the inverse of rounding.
    pub fn is_sound(&self, matrix: &[f64]) -> bool {
        if self.qr.is_some() || self.size == 0 {
            return self.size == 0;
        }
        let longest = |v: &[f64]| v.iter().fold(0.0_f64, |m, a| m.max(a.abs()));
        let norm = matrix.chunks(self.size).map(|row| row.iter().map(|a| a.abs()).sum::<f64>()).fold(0.0, f64::max);
        stretches(self.size, |v| self.solve(v)).iter().all(|[v, x]| longest(x) * norm <= SOUND * longest(v))
    }

    fn solve(&self, right: &[f64]) -> Vec<f64> {
        match &self.qr {
            Some(qr) => qr.least_squares(right).0,
            None => self.lu.solve(right).unwrap_or_else(|| vec![f64::NAN; right.len()]),
        }
    }

    /// The solution by residuals in twice the digits, and how far it is in doubt, relative to it: what plain elimination gets wrong, and where a pivot is small
    /// what the rounding of the entries means; NaN where the corrections do not die out.
    pub fn refined(&self, matrix: &[f64], right: &[f64]) -> (Vec<f64>, f64) {
        let (x, first) = self.corrected(matrix, right);
        let doubt = if self.qr.is_some() && !first.is_nan() { first.max(self.sensitivity(matrix, &x)) } else { first };
        (x, doubt)
    }

    /// What a unit of the last place in every entry changes at most: | |A⁻¹| ε |A| |x| | / |x|. *Source*: R. D. Skeel, Scaling for numerical stability in Gaussian
    /// elimination, J. ACM 26 (1979).
    fn sensitivity(&self, matrix: &[f64], x: &[f64]) -> f64 {
        let size = x.len();
        let mut moved = vec![0.0; size];
        for j in 0..size {
            let terms: f64 = (0..size).map(|k| (matrix[j * size + k] * x[k]).abs()).sum();
            let unit: Vec<f64> = (0..size).map(|i| if i == j { f64::EPSILON * terms } else { 0.0 }).collect();
            moved.iter_mut().zip(self.solve(&unit)).for_each(|(sum, v)| *sum += v.abs());
        }
        let longest = |v: &[f64]| v.iter().fold(0.0_f64, |m, a| m.max(a.abs()));
        longest(&moved) / longest(x).max(f64::MIN_POSITIVE)
    }

    fn corrected(&self, matrix: &[f64], right: &[f64]) -> (Vec<f64>, f64) {
        let size = right.len();
        let mut x = self.solve(right);
        let longest = |v: &[f64]| v.iter().fold(0.0_f64, |m, a| m.max(a.abs()));
        let (mut first, mut before) = (0.0, f64::INFINITY);
        for step in 0..REFINED {
            let rest: Vec<f64> = residual(matrix, size, &x, right);
            let correction = self.solve(&rest);
            let share = longest(&correction) / longest(&x).max(f64::MIN_POSITIVE);
            if step == 0 {
                first = share;
            }
            if !share.is_finite() || share >= 0.5 * before {
                // at the last digit corrections wander; before it they must not
                let ended = share.is_finite() && share.min(before) <= ENDED;
                return (x, if ended { first } else { f64::NAN });
            }
            x.iter_mut().zip(&correction).for_each(|(x, c)| *x += c);
            if share <= f64::EPSILON {
                break;
            }
            before = share;
        }
        (x, first)
    }
}

/// Three vectors at random with A⁻¹ of each: they show |A⁻¹| but for a factor of some √size.
///
/// *Source*: J. D. Dixon, Estimating extremal eigenvalues and condition numbers of matrices, SIAM J. Numer. Anal. 20 (1983).
pub fn stretches(size: usize, solve: impl Fn(&[f64]) -> Vec<f64>) -> [[Vec<f64>; 2]; 3] {
    let mut random = Random::new(7);
    std::array::from_fn(|_| {
        let v: Vec<f64> = (0..size).map(|_| random.between(-1.0, 1.0)).collect();
        let x = solve(&v);
        [v, x]
    })
}

/// b - A x in twice the digits.
fn residual(matrix: &[f64], size: usize, x: &[f64], b: &[f64]) -> Vec<f64> {
    let row = |i: usize| (0..size).fold(Double::default().add(1.0, b[i]), |sum, j| sum.add(-matrix[i * size + j], x[j])).round();
    (0..size).map(row).collect()
}

/// A x in twice the digits.
pub fn products(matrix: &[f64], size: usize, x: &[f64]) -> Vec<f64> {
    residual(matrix, size, x, &vec![0.0; size]).iter().map(|v| -v).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_strong_coupling_leaves_the_weak_support_its_digits() {
        // two masses on 100 N/m, joined by 1e13 N/m, 1 N on the first: both move by 1/100 m
        let c = 2.0_f64.powi(43);
        let a = [100.0 + c, -c, -c, c];
        let (x, doubt) = Factors::new(&a, 2).refined(&a, &[1.0, 0.0]);
        // the place without load to its last digit; the other to what the strong coupling rounds
        assert!((x[1] - 0.01).abs() < 1e-16 && (x[0] - 0.01).abs() < 1e-12, "{x:?}");
        // the doubt is below the digits that refinement needs
        assert!(doubt < 1e-2, "{doubt}");
    }

    #[test]
    fn what_rounding_decides_is_in_doubt() {
        // joined by 1e17 N/m: two digits of the 100 N/m are left in the sum
        let a = [100.0 + 1e17, -1e17, -1e17, 1e17];
        for right in [[1.0, 0.0], [0.0, 1.0], [0.3, 0.7]] {
            let (_, doubt) = Factors::new(&a, 2).refined(&a, &right);
            assert!(doubt.is_nan() || doubt > 0.1, "{doubt}");
        }
    }
}
