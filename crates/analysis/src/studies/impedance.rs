//! (C - ω² M + i ω B) X = F, also where the matrix is singular: at a natural frequency without damping.
//!
//! Beside such a frequency, at ω + δ, X = P/δ + X₀ + O(δ) with A₀ P = 0, A₁ P + A₀ X₀ = F and A₁ X₀ + A₀ X₁ = M P, where A₀ is the matrix
//! at ω and A₁ = -2 ω M + i B its derivative. Quantities that P does not move are finite and follow X₀, the limit of their amplitudes; all
//! others are infinite, real and imaginary part each on its own. A load that does no work on the free oscillation has P = 0. Machines that nothing
//! holds at ω = 0 and near it: `free_motion`.
//!
//! Solutions are refined with residuals in twice the digits: where a damper or a spring is 10¹³ times as strong as the others plain elimination leaves few digits.
//! *Source*: N. J. Higham, Accuracy and Stability of Numerical Algorithms, ch. 12.

use crate::linear::{Graded, Matrices};
use crate::studies::amplitudes::{Amplitudes, SINGULAR, cleared, size, turned};
use crate::studies::free_motion;
use crate::studies::shapes::Complex;
use crate::studies::sharp::{self, Spot};
use algebra::double::Double;
use algebra::elementary;
use algebra::lu::Lu;
use algebra::qr::Qr;
use algebra::refined::{Factors, products};

/// A free oscillation whose frequency differs by less than this share of ω is at ω.
const NEAR: f64 = 1e-10;
/// Work of the load on a free oscillation below this share of its terms is none.
const IDLE: f64 = 1e-11;

/// Rounding of a basis of the motions that conditions allow.
const BASIS: f64 = 8.0 * f64::EPSILON;

/// The amplitudes that a load F exp(iωt) forces; conditions of connections reduce the problem to the motions they allow.
pub fn solve(m: &Matrices, omega: f64, load: &[Complex]) -> Amplitudes {
    solve_at(m, Spot::At(omega), load)
}

/// Whether distances from a root can be counted: it is a simple one, and damped.
pub fn is_simple(m: &Matrices, root: Complex) -> bool {
    match (m.drift.is_empty(), m.allowed(), m.graded()) {
        (false, ..) => false,
        (true, Some((z, k)), _) => is_simple(&m.reduced(&z, k), root),
        (true, None, Some(graded)) => is_simple(&graded.matrices, root),
        (true, None, None) => sharp::is_simple(m, root),
    }
}

/// The same also at a distance from a root.
pub fn solve_at(m: &Matrices, spot: Spot, load: &[Complex]) -> Amplitudes {
    let omega = spot.omega();
    if !m.drift.is_empty() {
        // conditions on rates are solved in single numbers
        if m.loses() {
            return Amplitudes { doubt: f64::NAN, ..Amplitudes::default() };
        }
        return crate::studies::rolling::forced(m, omega, load);
    }
    if let Some((z, k)) = m.allowed() {
        // X = Z Y with Zᵀ (C - ω² M + i ω B) Z Y = Zᵀ F
        let idle = BASIS * load.iter().map(|f| size(*f)).sum::<f64>();
        let onto = |c: usize| (0..m.n).fold((0.0, 0.0), |s, i| (s.0 + z[i * k + c] * load[i].0, s.1 + z[i * k + c] * load[i].1));
        let onto = |c: usize| Some(onto(c)).filter(|f| size(*f) > idle).unwrap_or_default();
        let y = solve_at(&m.reduced(&z, k), spot, &(0..k).map(onto).collect::<Vec<_>>());
        // the basis is known to a few roundings of its unit vectors: what is below them is nothing
        let back = |y: &[Complex]| -> Vec<Complex> {
            let rounding = BASIS * y.iter().map(|v| size(*v)).sum::<f64>();
            let entry = |i: usize| y.iter().enumerate().fold((0.0, 0.0), |s, (c, v)| (s.0 + z[i * k + c] * v.0, s.1 + z[i * k + c] * v.1));
            (0..m.n).map(entry).map(|v| if size(v) <= rounding { (0.0, 0.0) } else { v }).collect()
        };
        let onto_all = |column: &Vec<Double>| -> Vec<Double> {
            (0..m.n).map(|i| column.iter().enumerate().fold(Double::default(), |s, (c, v)| s.add_times(z[i * k + c], *v))).collect()
        };
        let fine = y.fine.iter().map(|(column, a)| (onto_all(column), *a)).collect();
        return Amplitudes { fine, ..y.mapped(back) };
    }
    if let Some(graded) = m.graded() {
        let basis = graded.rounded();
        return apart(&graded, &basis, solve_at(&graded.matrices, spot, &onto(&basis, load)));
    }
    if let Some(found) = matches!(spot, Spot::Beside { .. }).then(|| sharp::amplitudes(m, spot, load)).flatten() {
        return found;
    }
    if let Some(found) = (omega > 0.0).then(|| free_motion::apart(m, omega, load)).flatten() {
        return found;
    }
    let system = Real::new(m, omega);
    let right = system.load(load);
    if let Some((x, doubt)) = system.regular(&right, omega) {
        return Amplitudes { regular: system.unscaled(&x), doubt, ..Amplitudes::default() };
    }
    // the damping of a free oscillation next to ω may lie below the rounding of ω² M
    if let Some(found) = (omega > 0.0).then(|| sharp::amplitudes(m, spot, load)).flatten() {
        return found;
    }
    let at_rest = || free_motion::at_zero([&m.stiffness, &m.damping, &m.mass], m.n, free_motion::pace(m), load);
    let found = (omega == 0.0).then(at_rest).flatten().unwrap_or_else(|| system.limit(&right));
    // free by rounding alone
    let doubt = if omega == 0.0 && free_motion::is_barely_held(m) { f64::NAN } else { found.doubt };
    Amplitudes { doubt, ..found }
}

/// Zᵀ F.
fn onto(basis: &[f64], load: &[Complex]) -> Vec<Complex> {
    let n = load.len();
    (0..n)
        .map(|k| load.iter().enumerate().fold((0.0, 0.0), |s, (i, f)| (s.0 + basis[i * n + k] * f.0, s.1 + basis[i * n + k] * f.1)))
        .collect()
}

/// X = Z Y with each motion of its own stiffness apart, so that what stretches a hard spring does not see what a weak one lets go.
fn apart(graded: &Graded, basis: &[f64], found: Amplitudes) -> Amplitudes {
    let n = graded.matrices.n;
    let back = |y: &[Complex]| -> Vec<Complex> {
        (0..n)
            .map(|i| y.iter().enumerate().fold((0.0, 0.0), |s, (k, y)| (s.0 + basis[i * n + k] * y.0, s.1 + basis[i * n + k] * y.1)))
            .collect()
    };
    if !found.poles.is_empty() {
        return found.mapped(back);
    }
    let Amplitudes { mut regular, free, doubt, .. } = found;
    for (z, a) in free {
        regular.iter_mut().zip(z).for_each(|(y, z)| *y = (y.0 + z * a.0, y.1 + z * a.1));
    }
    let column = |k: usize| -> Vec<Double> { (0..n).map(|i| graded.basis[i * n + k]).collect() };
    let fine = regular.iter().enumerate().map(|(k, y)| (column(k), *y)).collect();
    Amplitudes { regular: vec![(0.0, 0.0); n], fine, doubt, ..Amplitudes::default() }
}

/// The matrices as real ones of twice the size, [Re -Im; Im Re], in coordinates scaled to like stiffness.
struct Real {
    n: usize,
    scale: Vec<f64>,
    /// A₀, A₁, M.
    matrix: Vec<f64>,
    slope: Vec<f64>,
    mass: Vec<f64>,
}

impl Real {
    fn new(m: &Matrices, omega: f64) -> Real {
        let n = m.n;
        let own = |i: usize| m.stiffness[i * n + i].abs() + omega * omega * m.mass[i * n + i].abs() + omega * m.damping[i * n + i].abs();
        // powers of 2 leave every digit as it is
        let scale: Vec<f64> =
            (0..n).map(|i| if own(i) > 0.0 { elementary::exp2((-0.5 * elementary::log2(own(i))).round()) } else { 1.0 }).collect();
        let double = |re: &dyn Fn(usize) -> f64, im: &dyn Fn(usize) -> f64| -> Vec<f64> {
            let mut a = vec![0.0; 4 * n * n];
            for p in 0..n * n {
                let (i, j) = (p / n, p % n);
                let (re, im) = (re(p) * scale[i] * scale[j], im(p) * scale[i] * scale[j]);
                a[i * 2 * n + j] = re;
                a[i * 2 * n + n + j] = -im;
                a[(n + i) * 2 * n + j] = im;
                a[(n + i) * 2 * n + n + j] = re;
            }
            a
        };
        let matrix = double(&|p| m.stiffness[p] - omega * omega * m.mass[p], &|p| omega * m.damping[p]);
        let slope = double(&|p| -2.0 * omega * m.mass[p], &|p| m.damping[p]);
        let mass = double(&|p| m.mass[p], &|_| 0.0);
        Real { n, scale, matrix, slope, mass }
    }

    fn load(&self, load: &[Complex]) -> Vec<f64> {
        let scaled = |part: fn(&Complex) -> f64| load.iter().zip(&self.scale).map(move |(z, d)| part(z) * d);
        scaled(|z| z.0).chain(scaled(|z| z.1)).collect()
    }

    fn unscaled(&self, x: &[f64]) -> Vec<Complex> {
        (0..self.n).map(|i| (x[i] * self.scale[i], x[self.n + i] * self.scale[i])).collect()
    }

    fn product(&self, a: &[f64], x: &[f64]) -> Vec<f64> {
        a.chunks(2 * self.n).map(|row| row.iter().zip(x).map(|(a, x)| a * x).sum()).collect()
    }

    /// The solution where the matrix is regular, with what plain elimination gets wrong; entries that are rounding only are zero.
    fn regular(&self, right: &[f64], omega: f64) -> Option<(Vec<f64>, f64)> {
        let size = 2 * self.n;
        let factors = Factors::new(&self.matrix, size);
        // a small pivot is a free oscillation, or a strong damper or spring beside weak ones
        let doubtful = !factors.is_sound(&self.matrix) && Qr::alike(&self.matrix, size, size, SINGULAR).rank() < size;
        if doubtful && (omega == 0.0 || self.distance(&factors) <= NEAR * omega) {
            return None;
        }
        let (mut x, doubt) = factors.refined(&self.matrix, right);
        cleared(&self.matrix, right, &mut x);
        Some((x, doubt))
    }

    /// How far the frequency of the nearest free oscillation is, |δ|: A(ω) v = w with v, u from inverse iteration, δ = -(uᴴ w)/(uᴴ A₁ v).
    fn distance(&self, factors: &Factors) -> f64 {
        if factors.is_singular() {
            return 0.0;
        }
        let size = 2 * self.n;
        let transposed = turned(&self.matrix, size);
        let across = Factors::new(&transposed, size);
        let iterate = |factors: &Factors, matrix: &[f64]| {
            let mut v: Vec<f64> = (0..size).map(|i| 1.0 / (1.0 + i as f64)).collect();
            for _ in 0..3 {
                let next = factors.refined(matrix, &v).0;
                let length = next.iter().fold(0.0_f64, |m, a| m.max(a.abs()));
                if !(length > 0.0 && length.is_finite()) {
                    break;
                }
                v = next.iter().map(|a| a / length).collect();
            }
            v
        };
        let (v, u) = (iterate(factors, &self.matrix), iterate(&across, &transposed));
        let inner = |z: &[f64]| -> f64 {
            let n = self.n;
            let re: f64 = (0..size).map(|i| u[i] * z[i]).sum();
            let im: f64 = (0..n).map(|i| u[i] * z[n + i] - u[n + i] * z[i]).sum();
            elementary::hypot(re, im)
        };
        let w = products(&self.matrix, size, &v);
        let (rest, slope) = (inner(&w), inner(&self.product(&self.slope, &v)));
        if rest == 0.0 { 0.0 } else { rest / slope }
    }

    /// P and X₀ where it is singular.
    fn limit(&self, right: &[f64]) -> Amplitudes {
        let size = 2 * self.n;
        let qr = Qr::alike(&self.matrix, size, size, SINGULAR);
        let free = qr.null_space();
        let k = free.len();
        // columns and rows have one rank, which rounding may not show at one and the same threshold
        let across = turned(&self.matrix, size);
        let thresholds = (0..40).map(|p| SINGULAR * elementary::powi(1.5_f64, p));
        let Some(left) = thresholds.map(|t| Qr::alike(&across, size, size, t).null_space()).find(|l| l.len() == k) else {
            // what the load does on the free oscillation is not known: all that it moves counts as infinite
            let pole = (0..size).map(|i| free.iter().map(|x| x[i]).sum()).collect::<Vec<f64>>();
            return Amplitudes {
                regular: self.unscaled(&qr.least_squares(right).0),
                poles: vec![self.unscaled(&pole)],
                ..Amplitudes::default()
            };
        };
        let against = |v: &[f64]| -> Vec<f64> { left.iter().map(|w| w.iter().zip(v).map(|(a, b)| a * b).sum()).collect() };
        let small = |a: &[f64]| -> Vec<f64> {
            let columns: Vec<Vec<f64>> = free.iter().map(|x| against(&self.product(a, x))).collect();
            (0..k * k).map(|p| columns[p % k][p / k]).collect()
        };
        let combine = |c: &[f64]| -> Vec<f64> { (0..size).map(|i| free.iter().zip(c).map(|(x, c)| x[i] * c).sum()).collect() };
        let length = right.iter().fold(0.0_f64, |m, v| elementary::hypot(m, *v));
        let work = against(right);
        let excited = work.iter().any(|w| w.abs() > IDLE * length);
        let slope = Lu::new(&small(&self.slope), k);
        let pole = match (excited, slope.solve(&work)) {
            (false, _) => vec![0.0; size],
            (true, Some(a)) => combine(&a),
            // nothing restores the free motion: a double pole
            (true, None) => combine(&work),
        };
        let moved = self.product(&self.slope, &pole);
        let rest: Vec<f64> = right.iter().zip(&moved).map(|(f, p)| f - p).collect();
        let particular = qr.least_squares(&rest).0;
        let (bent, pulled) = (self.product(&self.slope, &particular), self.product(&self.mass, &pole));
        let wanted: Vec<f64> = bent.iter().zip(&pulled).map(|(b, p)| p - b).collect();
        let along = slope.solve(&against(&wanted)).or_else(|| {
            let inertia: Vec<f64> = against(&self.product(&self.mass, &particular)).iter().map(|v| -v).collect();
            Lu::new(&small(&self.mass), k).solve(&inertia)
        });
        let shift = combine(&along.unwrap_or_else(|| vec![0.0; k]));
        let regular: Vec<f64> = particular.iter().zip(&shift).map(|(x, s)| x + s).collect();
        // some ten units of the last place of the largest entry
        let noise = 1e-14 * regular.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
        let regular: Vec<f64> = regular.into_iter().map(|v| if v.abs() <= noise { 0.0 } else { v }).collect();
        let poles = if excited { vec![self.unscaled(&pole)] } else { Vec::new() };
        Amplitudes { regular: self.unscaled(&regular), poles, ..Amplitudes::default() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::studies::amplitudes::Gain;

    fn chain() -> Matrices {
        // two equal masses between three equal springs: ω = 10 (in phase) and 10√3 (against each other)
        Matrices {
            n: 2,
            mass: vec![1.0, 0.0, 0.0, 1.0],
            damping: vec![0.0; 4],
            stiffness: vec![200.0, -100.0, -100.0, 200.0],
            ..Matrices::default()
        }
    }

    #[test]
    fn a_load_that_does_no_work_on_the_free_oscillation_leaves_its_limit() {
        let found = solve(&chain(), 10.0, &[(1.0, 0.0), (-1.0, 0.0)]);
        assert!(found.poles.is_empty());
        let x = found.coordinates();
        // units of the last place of 0.005
        assert!((x[0].0 - 1.0 / 200.0).abs() < 1e-16 && (x[1].0 + 1.0 / 200.0).abs() < 1e-16, "{x:?}");
    }

    #[test]
    fn what_the_free_oscillation_does_not_move_is_finite() {
        let found = solve(&chain(), 10.0, &[(1.0, 0.0), (0.0, 0.0)]);
        assert!(found.coordinates().iter().all(|z| z.0.is_infinite()));
        let stretch = found.seen(&Gain { place: &[1.0, -1.0], rate: &[0.0; 2], acceleration: &[0.0; 2], omega: 10.0 });
        // a difference of two displacements: rounding of either
        assert!((stretch.0 - 1.0 / 200.0).abs() < 1e-15, "{stretch:?}");
    }
}
