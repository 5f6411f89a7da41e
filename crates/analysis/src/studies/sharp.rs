//! Forced motions beside a root with little damping: X = α x + X⊥ with the root λ and its shape x apart.
//!
//! At s = iω the matrix Q(s) = s² M + s B + C is singular but for s - λ, which is rounding of ω where the damping is. With Q(λ) x = 0
//!
//! ```text
//! Q(s) x = (s - λ) v,   v = ((s + λ) M + B) x,        [ Q(s)  v ] [ X⊥ ]   [ F ]
//!                                                     [ xᴴ    0 ] [ β  ] = [ 0 ],     α = β / (s - λ)
//! ```
//!
//! which holds exactly, and the bordered matrix is regular where λ is a simple root: all that is small stands in s - λ, and that is known to its last digit where
//! the place is given as a distance from the root.
//!
//! *Source*: W. Govaerts, Numerical Methods for Bifurcations of Dynamical Equilibria, ch. 3 (bordered matrices).

use super::amplitudes::Amplitudes;
use super::polish::{Fine, polished};
use super::shapes::Complex;
use crate::linear::{Matrices, largest};
use algebra::double::Double;
use algebra::elementary;
use algebra::refined::Factors;

/// Where the forced motion is asked for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Spot {
    /// At this ω.
    At(f64),
    /// So far from the frequency of the root next to this one.
    Beside {
        /// The root, to a few digits.
        root: Complex,
        /// ω less its imaginary part.
        offset: f64,
    },
}

impl Spot {
    /// ω in single digits.
    pub fn omega(self) -> f64 {
        match self {
            Spot::At(omega) => omega,
            Spot::Beside { root, offset } => root.1 + offset,
        }
    }
}

/// A decay below this share of a root is what its refinement in twice the digits leaves of none.
const UNDAMPED: f64 = 1e-28;
/// β below this share of the load is rounding: the load does no work on the motion.
const IDLE: f64 = 1e-13;
/// Steps of inverse iteration from which a shape comes.
const STEPS: usize = 3;
/// Distance of the root found from the place, as a share of it, beyond which it is another one.
const NEXT: f64 = 1e-5;

/// The amplitudes at a spot beside a simple root that is damped; none where there is no such root, or where nothing damps it.
pub(super) fn amplitudes(m: &Matrices, spot: Spot, load: &[Complex]) -> Option<Amplitudes> {
    if largest(&m.damping) == 0.0 {
        return None;
    }
    let seed = match spot {
        Spot::At(omega) => (0.0, omega),
        Spot::Beside { root, .. } => root,
    };
    let (root, shape) = next(m, seed)?;
    let found = root.round();
    // s - λ
    let beside = match spot {
        Spot::At(omega) => (-found.0, Double::from(omega).less(root.im).round()),
        Spot::Beside { offset, .. } => (-found.0, offset),
    };
    let (rest, work, doubt) = bordered(m, (found, beside), &shape, load)?;
    let by = beside.0 * beside.0 + beside.1 * beside.1;
    let along = ((work.0 * beside.0 + work.1 * beside.1) / by, (work.1 * beside.0 - work.0 * beside.1) / by);
    let (real, imaginary): (Vec<f64>, Vec<f64>) = shape.iter().copied().unzip();
    let moves = along != (0.0, 0.0);
    let free = if moves { vec![(real, along), (imaginary, (-along.1, along.0))] } else { Vec::new() };
    Some(Amplitudes { regular: rest, free, doubt, ..Amplitudes::default() })
}

/// Whether a root is a simple one, and damped.
pub(super) fn is_simple(m: &Matrices, root: Complex) -> bool {
    largest(&m.damping) > 0.0 && next(m, root).is_some()
}

/// The damped root next to a place.
fn next(m: &Matrices, seed: Complex) -> Option<(Fine, Vec<Complex>)> {
    let (root, shape) = polished(m, seed, &shape(m, seed))?;
    let found = root.round();
    let away = elementary::hypot(found.0 - seed.0, found.1 - seed.1);
    (found.0.abs() > UNDAMPED * found.1.abs() && away <= NEXT * seed.1.abs()).then_some((root, shape))
}

/// Of the root next to a place, by inverse iteration.
fn shape(m: &Matrices, (re, im): Complex) -> Vec<Complex> {
    let n = m.n;
    let square = (re * re - im * im, 2.0 * re * im);
    let entry = |p: usize| (square.0 * m.mass[p] + re * m.damping[p] + m.stiffness[p], square.1 * m.mass[p] + im * m.damping[p]);
    let mut matrix = vec![0.0; 4 * n * n];
    (0..n * n).for_each(|p| put(&mut matrix, n, (p / n, p % n), entry(p)));
    let factors = Factors::new(&matrix, 2 * n);
    let mut x: Vec<f64> = (0..2 * n).map(|i| 1.0 / (1.0 + i as f64)).collect();
    for _ in 0..STEPS {
        let next = factors.refined(&matrix, &x).0;
        let length = next.iter().fold(0.0_f64, |m, a| m.max(a.abs()));
        if !(length > 0.0 && length.is_finite()) {
            break;
        }
        x = next.iter().map(|a| a / length).collect();
    }
    (0..n).map(|i| (x[i], x[n + i])).collect()
}

/// A complex entry in a real matrix of twice the size, [Re -Im; Im Re].
fn put(matrix: &mut [f64], n: usize, (i, j): (usize, usize), z: Complex) {
    let size = 2 * n;
    matrix[i * size + j] = z.0;
    matrix[i * size + n + j] = -z.1;
    matrix[(n + i) * size + j] = z.1;
    matrix[(n + i) * size + n + j] = z.0;
}

/// X⊥, β and the doubt of both.
fn bordered(m: &Matrices, (root, beside): (Complex, Complex), x: &[Complex], load: &[Complex]) -> Option<(Vec<Complex>, Complex, f64)> {
    let (n, k) = (m.n, m.n + 1);
    let s = (0.0, root.1 + beside.1);
    let size = |i: usize| m.stiffness[i * n + i].abs() + s.1 * s.1 * m.mass[i * n + i].abs() + s.1 * m.damping[i * n + i].abs();
    // powers of 2 leave every digit as it is
    let scale: Vec<f64> =
        (0..n).map(|i| if size(i) > 0.0 { elementary::exp2((-0.5 * elementary::log2(size(i))).round()) } else { 1.0 }).collect();
    let mut matrix = vec![0.0; 4 * k * k];
    for p in 0..n * n {
        let by = scale[p / n] * scale[p % n];
        put(&mut matrix, k, (p / n, p % n), ((m.stiffness[p] - s.1 * s.1 * m.mass[p]) * by, s.1 * m.damping[p] * by));
    }
    let along = |i: usize| {
        (0..n).fold((0.0, 0.0), |sum, j| {
            let (mass, damping) = (m.mass[i * n + j], m.damping[i * n + j]);
            let (re, im) = (root.0 * mass + damping, (root.1 + s.1) * mass);
            (sum.0 + re * x[j].0 - im * x[j].1, sum.1 + re * x[j].1 + im * x[j].0)
        })
    };
    let v: Vec<Complex> = (0..n).map(|i| (along(i), scale[i])).map(|(z, d)| (z.0 * d, z.1 * d)).collect();
    let own: Vec<Complex> = x.iter().zip(&scale).map(|(x, d)| (x.0 / d, x.1 / d)).collect();
    let longest = |list: &[Complex]| list.iter().fold(0.0_f64, |m, z| m.max(elementary::hypot(z.0, z.1)));
    let (push, row) = (longest(&v), longest(&own));
    for i in 0..n {
        put(&mut matrix, k, (i, n), (v[i].0 / push, v[i].1 / push));
        put(&mut matrix, k, (n, i), (own[i].0 / row, -own[i].1 / row));
    }
    let mut right = vec![0.0; 2 * k];
    load.iter().enumerate().for_each(|(i, f)| (right[i], right[k + i]) = (f.0 * scale[i], f.1 * scale[i]));
    let (y, doubt) = Factors::new(&matrix, 2 * k).refined(&matrix, &right);
    let strongest = right.iter().fold(0.0_f64, |m, f| m.max(f.abs()));
    let work = Some((y[n], y[k + n])).filter(|w| elementary::hypot(w.0, w.1) > IDLE * strongest).unwrap_or_default();
    let rest = (0..n).map(|i| (y[i] * scale[i], y[k + i] * scale[i])).collect();
    (!doubt.is_nan()).then_some((rest, (work.0 / push, work.1 / push), doubt))
}
