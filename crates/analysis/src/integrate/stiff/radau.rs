//! Coefficients of the Radau IIA methods with s stages.
//!
//! The nodes c_1 < ... < c_s = 1 are the zeros of P_s - P_(s-1), Legendre's polynomials on [0, 1]; collocation there is of order 2s - 1 at the end of the step, of
//! order s inside it, L-stable and stiffly accurate. With the weights w_j of Radau's quadrature, which integrates P_k P_m exactly for k + m <= 2s - 2,
//!
//! ```text
//! a_ij = ∫_0^c_i l_j = sum_(k<s) I_k(c_i) (2k + 1) w_j P_k(c_j) ,   I_0(c) = c ,   I_k(c) = (P_(k+1)(c) - P_(k-1)(c)) / (2 (2k + 1))
//! ```
//!
//! needs no inverse and is exact to rounding. Nothing is tabulated: any number of stages is made when it is wanted. For odd s the matrix A has one
//! real eigenvalue and (s - 1)/2 pairs, by which a step of n unknowns falls into as many systems of size n.
//!
//! *Source*: E. Hairer, G. Wanner, Solving Ordinary Differential Equations II, Springer 1996, IV.5 and IV.8.

use crate::Fault;
use algebra::Trouble;
use algebra::arrange::Arrange;
use algebra::complex::Complex;
use algebra::eigen;
use algebra::elementary;
use algebra::lu::Lu;

/// What a step needs of the method.
#[derive(Clone, Debug)]
pub struct Tableau {
    /// Number of stages, odd.
    pub stages: usize,
    /// c_i, ascending, the last one 1.
    pub nodes: Vec<f64>,
    /// a_ij, row by row.
    pub a: Vec<f64>,
    /// One of each pair of eigenvalues of A, the real one first.
    pub eigen: Vec<Eigen>,
    /// Values at 0, c_1 ... c_s to Legendre coefficients 0 ... s, row by row.
    legendre: Vec<f64>,
    /// Row k: P_k by powers, s + 1 each.
    powers: Vec<f64>,
}

/// An eigenvalue of A = T diag(mu) T^-1.
#[derive(Clone, Debug)]
pub struct Eigen {
    /// mu, imaginary part not negative.
    pub value: Complex,
    /// Its column of T, times 2 for one of a pair: the real part of the sum is then the sum over the pair.
    pub column: Vec<Complex>,
    /// Its row of T^-1.
    pub row: Vec<Complex>,
}

impl Tableau {
    /// The method with so many stages.
    ///
    /// *Errors*: S023 when the eigenvalues are not found; `stages` is odd, 3 ... 15.
    pub fn new(stages: usize) -> Result<Tableau, Fault> {
        let nodes = nodes(stages);
        let a = matrix(&nodes);
        let eigen = eigenvalues(&a, stages)?;
        let legendre = interpolation(&nodes).ok_or(Trouble::Unconverged { found: 0, wanted: stages })?;
        Ok(Tableau { stages, powers: powers(stages), nodes, a, eigen, legendre })
    }

    /// Legendre coefficients of the polynomial of degree s that is `first` at 0 and takes the given values at the nodes.
    pub fn to_legendre(&self, first: f64, values: impl Iterator<Item = f64>, into: &mut [f64]) {
        into.fill(0.0);
        for (j, value) in std::iter::once(first).chain(values).enumerate() {
            for (k, c) in into.iter_mut().enumerate() {
                *c += self.legendre[k * (self.stages + 1) + j] * value;
            }
        }
    }

    /// Coefficients of the powers of tau of a polynomial in tau/h given by its Legendre coefficients.
    pub fn to_powers(&self, legendre: &[f64], h: f64, into: &mut [f64]) {
        into.fill(0.0);
        for (row, c) in self.powers.chunks(self.stages + 1).zip(legendre) {
            into.iter_mut().zip(row).for_each(|(sum, p)| *sum += c * p);
        }
        let mut scale = 1.0;
        for c in into {
            *c /= scale;
            scale *= h;
        }
    }
}

/// P_0 ... P_highest at c in [0, 1] (or outside).
pub fn legendre(c: f64, highest: usize) -> Vec<f64> {
    let x = 2.0 * c - 1.0;
    let mut p = vec![1.0, x];
    for k in 1..highest.max(1) {
        let next = ((2 * k + 1) as f64 * x * p[k] - k as f64 * p[k - 1]) / (k + 1) as f64;
        p.push(next);
    }
    p.truncate(highest + 1);
    p
}

/// Zeros of P_s - P_(s-1) by bisection; cosines part them.
fn nodes(s: usize) -> Vec<f64> {
    let value = |c: f64| {
        let p = legendre(c, s);
        p[s] - p[s - 1]
    };
    let cells = 40 * s;
    let grid: Vec<f64> = (0..cells).map(|k| 0.5 - 0.5 * elementary::cos(std::f64::consts::PI * k as f64 / cells as f64)).collect();
    let mut found: Vec<f64> = Vec::new();
    for pair in grid.windows(2) {
        let (mut a, mut b) = (pair[0], pair[1]);
        let positive = value(a) > 0.0;
        if positive == (value(b) > 0.0) {
            continue;
        }
        for _ in 0..60 {
            let middle = 0.5 * (a + b);
            if (value(middle) > 0.0) == positive { a = middle } else { b = middle }
        }
        found.push(0.5 * (a + b));
    }
    found.push(1.0);
    found
}

/// A, row by row.
fn matrix(nodes: &[f64]) -> Vec<f64> {
    let s = nodes.len();
    let values: Vec<Vec<f64>> = nodes.iter().map(|c| legendre(*c, s)).collect();
    // on [0, 1]: w = c / (s P_(s-1)(c))²
    let weights: Vec<f64> = nodes.iter().zip(&values).map(|(c, p)| c / elementary::powi(s as f64 * p[s - 1], 2)).collect();
    let mut a = vec![0.0; s * s];
    for i in 0..s {
        for j in 0..s {
            let term = |k: usize| match k {
                0 => nodes[i] * weights[j],
                k => 0.5 * (values[i][k + 1] - values[i][k - 1]) * weights[j] * values[j][k],
            };
            a[i * s + j] = (0..s).map(term).sum();
        }
    }
    a
}

/// One of each pair of eigenvalues with its column and row.
fn eigenvalues(a: &[f64], s: usize) -> Result<Vec<Eigen>, Fault> {
    let modes = eigen::general(s, a)?;
    let t: Vec<Complex> = (0..s * s).map(|k| modes.vector(k % s)[k / s]).collect();
    let lu = Lu::exact(&t, s).ok_or(Trouble::Unconverged { found: 0, wanted: s })?;
    let mut inverse = vec![Complex::ZERO; s * s];
    for j in 0..s {
        let mut b = vec![Complex::ZERO; s];
        b[j] = Complex::ONE;
        let column = lu.solve(&b).unwrap_or_default();
        column.into_iter().enumerate().for_each(|(i, z)| inverse[i * s + j] = z);
    }
    let mut found: Vec<Eigen> = (0..s)
        .filter(|&k| modes.values[k].im >= 0.0)
        .map(|k| Eigen {
            value: modes.values[k],
            column: modes.vector(k).iter().map(|z| z.scale(if modes.values[k].im > 0.0 { 2.0 } else { 1.0 })).collect(),
            row: inverse[k * s..(k + 1) * s].to_vec(),
        })
        .collect();
    found.arrange_by(|x, y| x.value.im.total_cmp(&y.value.im));
    Ok(found)
}

/// Inverse of the matrix P_k(c_j), j over 0 and the nodes.
fn interpolation(nodes: &[f64]) -> Option<Vec<f64>> {
    let m = nodes.len() + 1;
    let matrix: Vec<f64> = std::iter::once(&0.0).chain(nodes).flat_map(|c| legendre(*c, m - 1)).collect();
    let lu = Lu::new(&matrix, m);
    let mut inverse = vec![0.0; m * m];
    for j in 0..m {
        let mut b = vec![0.0; m];
        b[j] = 1.0;
        let column = lu.solve(&b)?;
        (0..m).for_each(|k| inverse[k * m + j] = column[k]);
    }
    Some(inverse)
}

/// P_k(c) = (-1)^k sum_j C(k, j) C(k + j, j) (-c)^j; whole numbers, exact.
fn powers(s: usize) -> Vec<f64> {
    let mut rows = vec![0.0; (s + 1) * (s + 1)];
    for k in 0..=s {
        let mut term = if k % 2 == 0 { 1.0 } else { -1.0 };
        for j in 0..=k {
            rows[k * (s + 1) + j] = term;
            term = -(term * ((k - j) * (k + j + 1)) as f64) / ((j + 1) * (j + 1)) as f64;
        }
    }
    rows
}

/// Stages for a tolerance: each Legendre coefficient is then about a tenth of the one before, 5 ... 15.
pub(crate) fn stages(tolerance: f64) -> usize {
    let digits = -elementary::log10(tolerance);
    (2 * (0.5 * digits).round() as usize + 1).clamp(5, 15)
}

#[cfg(test)]
mod tests {
    use super::*;
    use algebra::complex;

    /// Units of the last place.
    const ROUNDING: f64 = 1e-15;
    /// A quotient of polynomials that is 1 at the limit of stability: rounding of its parts.
    const CONDITION: f64 = 1e-12;
    /// Powers from Legendre’s polynomials, whose coefficients grow: relative to 2^k of the k-th.
    const DERIVATIVE: f64 = 1e-10;

    /// Radau IIA of order 5: c = (4 ∓ √6)/10, 1; the last row of A is (16 ∓ √6)/36, 1/9.
    #[test]
    fn three_stages_are_those_of_the_literature() {
        let t = Tableau::new(3).unwrap();
        let root = 6.0_f64.sqrt();
        assert!((t.nodes[0] - (4.0 - root) / 10.0).abs() < ROUNDING && (t.nodes[1] - (4.0 + root) / 10.0).abs() < ROUNDING);
        let last = [(16.0 - root) / 36.0, (16.0 + root) / 36.0, 1.0 / 9.0];
        assert!(t.a[6..].iter().zip(last).all(|(a, w)| (a - w).abs() < ROUNDING));
        // 1/mu is the real root of the denominator of the Padé approximant (2, 3): 3.6378342527444957
        assert!((1.0 / t.eigen[0].value.re - 3.637_834_252_744_496).abs() < 1e-13);
    }

    /// sum_j a_ij c_j^(k-1) = c_i^k / k for k <= s, and the quadrature of the last row up to k = 2s - 1.
    #[test]
    fn orders_of_stages_and_of_the_end() {
        for s in [3, 5, 7, 9, 11, 13, 15] {
            let t = Tableau::new(s).unwrap();
            for i in 0..s {
                let highest = if i + 1 == s { 2 * s - 1 } else { s };
                for k in 1..=highest {
                    let sum: f64 = (0..s).map(|j| t.a[i * s + j] * t.nodes[j].powi(k as i32 - 1)).sum();
                    assert!((sum - t.nodes[i].powi(k as i32) / k as f64).abs() < 4.0 * ROUNDING, "{s} {i} {k}");
                }
            }
        }
    }

    /// Stability function R(z): the last stage of y' = z y, y = 1, in a step 1: (I - z A) Y = 1.
    fn stability(t: &Tableau, z: Complex) -> Complex {
        let s = t.stages;
        let one = |k: usize| if k / s == k % s { Complex::ONE } else { Complex::ZERO };
        let matrix: Vec<Complex> = (0..s * s).map(|k| one(k) - z.scale(t.a[k])).collect();
        let y = Lu::exact(&matrix, s).unwrap().solve(&vec![Complex::ONE; s]).unwrap();
        y[s - 1]
    }

    /// |R| <= 1 on the imaginary axis and in the left half plane, R -> 0 at minus infinity.
    #[test]
    fn every_method_is_stable_in_the_left_half_plane_and_damps_at_infinity() {
        for s in [3, 5, 7, 9, 11, 13, 15] {
            let t = Tableau::new(s).unwrap();
            for k in -8..30 {
                let size = 2.0_f64.powi(k);
                for angle in 0..=8 {
                    let direction = complex::exp(complex::imaginary(std::f64::consts::FRAC_PI_2 * (1.0 + f64::from(angle) / 8.0)));
                    assert!(complex::abs(stability(&t, direction.scale(size))) <= 1.0 + CONDITION, "{s} stages, {size} {angle}");
                }
            }
            // |R| falls like the inverse of its argument: some thousands over 1e9
            assert!(complex::abs(stability(&t, Complex::from(-1e9))) < 1e-6, "{s}");
        }
    }

    /// R(z) - e^z = C z^(2s), C = s! (s-1)!/((2s-1)! (2s)!): observed order 2s - 1 of Dahlquist's equation.
    #[test]
    fn observed_order_on_dahlquists_equation() {
        let factorial = |n: usize| (1..=n).map(|k| k as f64).product::<f64>();
        for (s, coarse) in [(3, -0.5), (5, -1.2)] {
            let t = Tableau::new(s).unwrap();
            // the mean of both signs has no correction of first order in z
            let off = |z: f64| (stability(&t, Complex::from(z)).re - z.exp()).abs();
            let error = |z: f64| (off(z) * off(-z)).sqrt();
            let fine: f64 = 0.5 * coarse;
            let order = (error(coarse) / error(fine)).log2() - 1.0;
            assert!((order - (2 * s - 1) as f64).abs() < 0.75, "{s} stages: {order}");
            let constant = factorial(s) * factorial(s - 1) / (factorial(2 * s - 1) * factorial(2 * s));
            let ratio = error(fine) / (constant * fine.abs().powi(2 * s as i32));
            assert!((0.3..3.0).contains(&ratio), "{s}: {ratio}");
        }
    }

    #[test]
    fn eigenvalues_take_the_matrix_apart() {
        for s in [5, 9, 13, 15] {
            let t = Tableau::new(s).unwrap();
            assert_eq!(t.eigen.len(), s.div_ceil(2));
            for (i, j) in (0..s * s).map(|k| (k / s, k % s)) {
                let sum: f64 = t.eigen.iter().map(|e| (e.column[i] * e.value * e.row[j]).re).sum();
                // T has the condition 4e7 for 15 stages; what is left shrinks by this factor in each Newton step
                assert!((sum - t.a[i * s + j]).abs() < 1e-5, "{s}: {}", sum - t.a[i * s + j]);
            }
        }
    }

    #[test]
    fn polynomials_go_to_powers_and_back() {
        let t = Tableau::new(7).unwrap();
        let f = |c: f64| 2.0 - c + 3.0 * c.powi(4) - 0.5 * c.powi(7);
        let (mut l, mut p) = ([0.0; 8], [0.0; 8]);
        t.to_legendre(f(0.0), t.nodes.iter().map(|c| f(*c)), &mut l);
        t.to_powers(&l, 0.5, &mut p);
        let want = [2.0, -2.0, 0.0, 0.0, 48.0, 0.0, 0.0, -64.0];
        assert!(p.iter().zip(want).enumerate().all(|(k, (p, w))| (p - w).abs() < DERIVATIVE * 2.0_f64.powi(k as i32)), "{p:?}");
    }
}
