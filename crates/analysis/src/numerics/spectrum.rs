//! Eigenvalues of a small real matrix: Hessenberg form by elimination, then the complex Q R iteration with Wilkinson's shift.
//! *Source*: G. H. Golub, C. F. Van Loan, Matrix Computations, 7.4, 7.5; J. H. Wilkinson, The Algebraic Eigenvalue Problem, 8.

type Complex = (f64, f64);

fn times(a: Complex, b: Complex) -> Complex {
    (a.0 * b.0 - a.1 * b.1, a.0 * b.1 + a.1 * b.0)
}
fn plus(a: Complex, b: Complex) -> Complex {
    (a.0 + b.0, a.1 + b.1)
}
fn minus(a: Complex, b: Complex) -> Complex {
    (a.0 - b.0, a.1 - b.1)
}
fn conjugate(a: Complex) -> Complex {
    (a.0, -a.1)
}
fn size(a: Complex) -> f64 {
    a.0.hypot(a.1)
}

/// Square root with non-negative real part.
fn root(a: Complex) -> Complex {
    let r = size(a);
    let re = (0.5 * (r + a.0)).max(0.0).sqrt();
    let im = (0.5 * (r - a.0)).max(0.0).sqrt();
    (re, if a.1 < 0.0 { -im } else { im })
}

/// Eigenvalues (real, imaginary part) of a row-major n x n matrix, largest magnitude first; none when the iteration does not settle.
pub fn eigenvalues(n: usize, matrix: &[f64]) -> Option<Vec<Complex>> {
    if matrix.iter().any(|a| !a.is_finite()) {
        return None;
    }
    let hessenberg = hessenberg(n, matrix.to_vec());
    let mut h: Vec<Complex> = hessenberg.iter().map(|&a| (a, 0.0)).collect();
    let norm = hessenberg.iter().fold(0.0_f64, |m, a| m.max(a.abs()));
    let mut values = Vec::with_capacity(n);
    let (mut m, mut tries) = (n, 0);
    while m > 0 {
        let small = |h: &[Complex], k: usize| {
            let beside = size(h[(k - 1) * n + k - 1]) + size(h[k * n + k]);
            let reference = if beside > 0.0 { beside } else { norm };
            size(h[k * n + k - 1]) <= f64::EPSILON * reference
        };
        let low = (1..m).rev().find(|&k| small(&h, k)).unwrap_or(0);
        if low == m - 1 {
            values.push(h[(m - 1) * n + m - 1]);
            (m, tries) = (m - 1, 0);
            continue;
        }
        tries += 1;
        if tries > 300 {
            return None;
        }
        sweep(&mut h, n, low, m, tries % 11 == 10);
    }
    // a real matrix has conjugate pairs: what is rounding is cut
    values.iter_mut().filter(|v| v.1.abs() <= 1e-13 * size(**v)).for_each(|v| v.1 = 0.0);
    values.sort_by(|a, b| size(*b).total_cmp(&size(*a)).then(b.0.total_cmp(&a.0)).then(b.1.total_cmp(&a.1)));
    Some(values)
}

/// Zeros below the subdiagonal by elimination with exchanges.
fn hessenberg(n: usize, mut a: Vec<f64>) -> Vec<f64> {
    for k in 1..n.saturating_sub(1) {
        let pivot = (k..n).fold(k, |best, i| if a[i * n + k - 1].abs() > a[best * n + k - 1].abs() { i } else { best });
        if a[pivot * n + k - 1] == 0.0 {
            continue;
        }
        if pivot != k {
            (0..n).for_each(|j| a.swap(pivot * n + j, k * n + j));
            (0..n).for_each(|i| a.swap(i * n + pivot, i * n + k));
        }
        for i in k + 1..n {
            let factor = a[i * n + k - 1] / a[k * n + k - 1];
            (0..n).for_each(|j| a[i * n + j] -= factor * a[k * n + j]);
            (0..n).for_each(|r| a[r * n + k] += factor * a[r * n + i]);
            a[i * n + k - 1] = 0.0;
        }
    }
    a
}

/// One step H - s = Q R, H <- R Q + s on the rows low..m.
fn sweep(h: &mut [Complex], n: usize, low: usize, m: usize, exceptional: bool) {
    let shift = if exceptional { (size(h[(m - 1) * n + m - 2]), 0.0) } else { wilkinson(h, n, m) };
    (low..m).for_each(|i| h[i * n + i] = minus(h[i * n + i], shift));
    let mut rotations = Vec::with_capacity(m - low);
    for k in low..m - 1 {
        let (x, y) = (h[k * n + k], h[(k + 1) * n + k]);
        let r = size(x).hypot(size(y));
        let (c, s) = if r > 0.0 { ((x.0 / r, x.1 / r), (y.0 / r, y.1 / r)) } else { ((1.0, 0.0), (0.0, 0.0)) };
        for j in k..m {
            let (a, b) = (h[k * n + j], h[(k + 1) * n + j]);
            h[k * n + j] = plus(times(conjugate(c), a), times(conjugate(s), b));
            h[(k + 1) * n + j] = minus(times(c, b), times(s, a));
        }
        rotations.push((c, s));
    }
    for (k, &(c, s)) in (low..m - 1).zip(&rotations) {
        for i in low..(k + 2).min(m) {
            let (a, b) = (h[i * n + k], h[i * n + k + 1]);
            h[i * n + k] = plus(times(a, c), times(b, s));
            h[i * n + k + 1] = minus(times(b, conjugate(c)), times(a, conjugate(s)));
        }
    }
    (low..m).for_each(|i| h[i * n + i] = plus(h[i * n + i], shift));
}

/// The eigenvalue of the last 2 x 2 block nearer to its corner.
fn wilkinson(h: &[Complex], n: usize, m: usize) -> Complex {
    let (a, b, c, d) = (h[(m - 2) * n + m - 2], h[(m - 2) * n + m - 1], h[(m - 1) * n + m - 2], h[(m - 1) * n + m - 1]);
    let half = minus(a, d);
    let half = (0.5 * half.0, 0.5 * half.1);
    let root = root(plus(times(half, half), times(b, c)));
    let mean = (0.5 * (a.0 + d.0), 0.5 * (a.1 + d.1));
    let (one, two) = (plus(mean, root), minus(mean, root));
    if size(minus(one, d)) < size(minus(two, d)) { one } else { two }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn companion_matrix_has_the_roots_of_its_polynomial() {
        // (x - 2)(x + 1)(x^2 - 2 x + 5): 1 ± 2i
        // = x^4 - 3 x^3 + 5 x^2 - x - 10
        let a = [3.0, -5.0, 1.0, 10.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0];
        let found = eigenvalues(4, &a).unwrap();
        for (v, expected) in found.iter().zip([(1.0, 2.0), (1.0, -2.0), (2.0, 0.0), (-1.0, 0.0)]) {
            assert!(size(minus(*v, expected)) < 1e-13, "{found:?}");
        }
    }

    #[test]
    fn singular_and_defective() {
        assert_eq!(eigenvalues(2, &[0.0, 1.0, 0.0, 0.0]).unwrap(), vec![(0.0, 0.0), (0.0, 0.0)]);
        let found = eigenvalues(3, &[1.0, 2.0, 3.0, 2.0, 4.0, 6.0, 3.0, 6.0, 9.0]).unwrap();
        assert!((found[0].0 - 14.0).abs() < 1e-13 && size(found[1]) < 1e-13 && size(found[2]) < 1e-13, "{found:?}");
    }
}
