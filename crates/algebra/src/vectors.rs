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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lengths_of_tiny_and_huge_vectors() {
        // a quotient, a square, a sum, a root and a product are rounded
        let close = |length: f64, exact: f64| (length / exact - 1.0).abs() <= 4.0 * f64::EPSILON;
        assert!(close(norm(&[3e-200, 4e-200]), 5e-200) && close(norm(&[3e200, 4e200]), 5e200));
        assert_eq!(norm(&[]), 0.0);
        assert!(norm(&[f64::NAN]).is_nan());
    }
}
