//! Polynomials on [0, 1] in Bernstein's basis, b_j of C(n,j) u^j (1 - u)^(n-j): the polynomial lies between the least and the largest of its coefficients, and has no
//! more roots than they have changes of sign.
//!
//! *Source*: J. M. Lane, R. F. Riesenfeld, Bounds on a polynomial, BIT 21 (1981) 112-117.

/// Powers to Bernstein coefficients on [0, 1]: the triangle of sums of c_k / C(n,k).
pub fn to_bernstein(c: &mut [f64]) {
    let n = c.len() - 1;
    let mut binomial = 1.0;
    for (k, c_k) in c.iter_mut().enumerate() {
        *c_k /= binomial;
        binomial *= (n - k) as f64 / (k + 1) as f64;
    }
    for level in 0..n {
        // each takes its neighbour as it was
        let mut before = c[level];
        for c_j in &mut c[level + 1..] {
            before = std::mem::replace(c_j, *c_j + before);
        }
    }
}

/// De Casteljau at the middle: the row becomes its right half, the left half is appended to `left`.
pub fn halve_row(row: &mut [f64], left: &mut Vec<f64>) {
    let n = row.len();
    for level in 0..n {
        left.push(row[0]);
        let mut behind = row[n - 1 - level];
        for c_j in row[..n - 1 - level].iter_mut().rev() {
            behind = std::mem::replace(c_j, 0.5 * (*c_j + behind));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// (1 + 2 u)^2 = 1 (1-u)^2 + 3 * 2 u (1-u) + 9 u^2; by halves, ends and control points of 1, 4 and 4, 9.
    #[test]
    fn a_square_has_the_coefficients_of_its_blossom() {
        let mut c = [1.0, 4.0, 4.0];
        to_bernstein(&mut c);
        assert_eq!(c, [1.0, 3.0, 9.0]);
        let mut left = Vec::new();
        halve_row(&mut c, &mut left);
        assert_eq!((left.as_slice(), c), (&[1.0, 2.0, 4.0][..], [4.0, 6.0, 9.0]));
    }
}
