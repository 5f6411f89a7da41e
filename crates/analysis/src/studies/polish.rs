//! Roots and shapes of (λ² M + λ B + C) x = 0 to the last digits, by Newton's method with residuals in twice the digits.
//!
//! ```text
//! [ Q(λ)  Q'(λ) x ] [ dx ]     [ Q(λ) x ]
//! [ x₀ᴴ      0    ] [ dλ ] = - [   0    ],      Q = λ² M + λ B + C
//! ```
//!
//! Eigenvalues err by the rounding of the largest one: beside a damper of 1e15 N s/m nothing is left of a slow root. The first dλ says how much was wrong.
//! *Source*: G. H. Golub, C. F. Van Loan, Matrix Computations, 7.6.1; F. Tisseur, K. Meerbergen, SIAM Review 43 (2001).

use super::shapes::Complex;
use crate::linear::Matrices;
use algebra::double::Double;
use algebra::elementary;
use algebra::refined::Factors;

/// Steps of Newton's method.
const STEPS: usize = 30;
/// Change of a root that ends them.
const SETTLED: f64 = 4.0 * f64::EPSILON;
/// A root that moves farther than this is another one.
const NEAR: f64 = 0.5;

/// A complex number in twice the digits.
#[derive(Clone, Copy, Default)]
pub(super) struct Fine {
    pub(super) re: Double,
    pub(super) im: Double,
}

impl Fine {
    fn of(z: Complex) -> Fine {
        Fine { re: z.0.into(), im: z.1.into() }
    }

    pub(super) fn round(self) -> Complex {
        (self.re.round(), self.im.round())
    }

    /// self + a b.
    fn plus(self, a: Fine, b: Fine) -> Fine {
        Fine { re: self.re.plus(a.re, b.re).plus(a.im.negated(), b.im), im: self.im.plus(a.re, b.im).plus(a.im, b.re) }
    }

    /// self + (re, im).
    fn moved(self, re: f64, im: f64) -> Fine {
        Fine { re: self.re.add(1.0, re), im: self.im.add(1.0, im) }
    }

    /// self a.
    fn times(self, a: f64) -> Fine {
        Fine { re: Double::default().add_times(a, self.re), im: Double::default().add_times(a, self.im) }
    }
}

/// A root and its shape; none where Newton's method does not stand (a double root).
///
/// Both are carried in twice the digits: a rounding of the shape alone changes the forces of strong dampers by more than all of those that hold a slow motion.
pub(super) fn polish(m: &Matrices, root: Complex, shape: &[Complex]) -> Option<(Complex, Vec<Complex>)> {
    polished(m, root, shape).map(|(root, shape)| (root.round(), shape))
}

/// The same with the root in twice the digits.
pub(super) fn polished(m: &Matrices, root: Complex, shape: &[Complex]) -> Option<(Fine, Vec<Complex>)> {
    let n = m.n;
    let mut x: Vec<Fine> = shape.iter().map(|z| Fine::of(*z)).collect();
    let mut root_now = Fine::of(root);
    let length: f64 = shape.iter().map(|z| z.0 * z.0 + z.1 * z.1).sum();
    let first: Vec<Complex> = shape.iter().map(|z| (z.0 / length, z.1 / length)).collect();
    let mut before = f64::INFINITY;
    for _ in 0..STEPS {
        let (matrix, right) = bordered(m, root_now, &x, &first);
        let (step, _) = Factors::new(&matrix, 2 * n + 2).refined(&matrix, &right);
        let now = root_now.round();
        let change = elementary::hypot(step[n], step[2 * n + 1]) / elementary::hypot(now.0, now.1);
        // it does not converge, and this is not rounding yet
        if !change.is_finite() || (change > 0.9 * before && change > 1e-12) {
            return None;
        }
        x.iter_mut().enumerate().for_each(|(i, z)| *z = z.moved(step[i], step[n + 1 + i]));
        root_now = root_now.moved(step[n], step[2 * n + 1]);
        // rounding of a pencil of unlike sizes ends here
        if change <= SETTLED || (change >= before && change <= 1e-12) {
            break;
        }
        before = change;
    }
    let found = root_now.round();
    let moved = elementary::hypot(found.0 - root.0, found.1 - root.1);
    (moved <= NEAR * elementary::hypot(root.0, root.1)).then(|| (root_now, x.iter().map(|z| z.round()).collect()))
}

/// The system as a real one of twice the size: unknowns Re dx, Re dλ, Im dx, Im dλ.
fn bordered(m: &Matrices, root: Fine, x: &[Fine], first: &[Complex]) -> (Vec<f64>, Vec<f64>) {
    let n = m.n;
    let fine_square = Fine::default().plus(root, root);
    let (square, (re, im)) = (fine_square.round(), root.round());
    let size = 2 * n + 2;
    let fine_damping = m.fine_damping();
    let mut matrix = vec![0.0; size * size];
    let mut right = vec![0.0; size];
    let mut put = |i: usize, j: usize, z: Complex| {
        matrix[i * size + j] = z.0;
        matrix[i * size + n + 1 + j] = -z.1;
        matrix[(n + 1 + i) * size + j] = z.1;
        matrix[(n + 1 + i) * size + n + 1 + j] = z.0;
    };
    for i in 0..n {
        let (mut slope, mut sum) = ((0.0, 0.0), Fine::default());
        for (j, fine) in x.iter().enumerate() {
            let p = i * n + j;
            let (mass, damping, stiffness) = (m.mass[p], m.damping[p], m.stiffness[p]);
            // the terms stay apart: strong ones cancel between columns, not within one entry
            let dragged = Fine { re: root.re.times(fine_damping[p]), im: root.im.times(fine_damping[p]) };
            for a in [fine_square.times(mass), dragged, Fine::of((stiffness, 0.0))] {
                sum = sum.plus(a, *fine);
            }
            let z = fine.round();
            let q = (square.0 * mass + re * damping + stiffness, square.1 * mass + im * damping);
            put(i, j, q);
            let d = (2.0 * re * mass + damping, 2.0 * im * mass);
            slope = (slope.0 + d.0 * z.0 - d.1 * z.1, slope.1 + d.0 * z.1 + d.1 * z.0);
        }
        put(i, n, slope);
        let sum = sum.round();
        (right[i], right[n + 1 + i]) = (-sum.0, -sum.1);
    }
    for (j, z) in first.iter().enumerate() {
        put(n, j, (z.0, -z.1));
    }
    (matrix, right)
}
