//! The variational equations Φ' = A(t) Φ along a motion that is known, A = ∂f/∂x, with a step of their own.
//!
//! How quickly a disturbance moves has nothing to do with how quickly the regime moves: a mode may turn a thousand times in a period. The equations
//! are linear, so Radau's method (IIA, seven stages, order 13, L-stable) is one linear system a step. Each step is also taken in two halves; the
//! difference is the error, and the halves are what counts.
//!
//! ```text
//! K_i = A(t + c_i h) (1 + h Σ a_ij K_j),   Φ = 1 + h Σ a_sj K_j
//! det Φ = exp ∫ tr A dt                    Liouville's formula, by Gauss's rule and independent of the steps
//! ```
//!
//! *Source*: E. Hairer, G. Wanner, Solving Ordinary Differential Equations II, IV.5.

use super::fundamental::{Square, slopes};
use crate::numerics::gauss::EIGHT;
use crate::numerics::lu::Lu;
use crate::taylor::Step;
use crate::{Fault, System};

/// Stages.
const STAGES: usize = 7;
/// Error of a step, in scales, of a start that changes by one scale.
const TOLERANCE: f64 = 1e-13;
/// Least number of steps in a period: a flat regime says nothing of how its stiffness moves in time.
const LEAST: f64 = 32.0;
/// Most steps of a stretch.
const MOST: usize = 2_000_000;

/// A stretch of the motion without switches.
pub(super) struct Stretch<'o> {
    pub(super) steps: &'o [Step],
    pub(super) scales: &'o [f64],
    /// Duration of the whole turn.
    pub(super) period: f64,
}

/// What the variations of a stretch are.
pub(super) struct Varied {
    /// Fundamental matrix, SI.
    pub(super) matrix: Square,
    /// ∫ tr A dt.
    pub(super) divergence: f64,
    /// By how much Liouville's formula is missed: sum over the steps of |det Φ - exp ∫ tr A|, each relative to the largest determinant that columns
    /// of this length can have.
    pub(super) liouville: f64,
}

/// Nodes and weights of Radau's method.
struct Radau {
    c: [f64; STAGES],
    a: [[f64; STAGES]; STAGES],
}

/// Legendre's polynomials of the degrees k and k - 1 at x.
fn legendre(k: usize, x: f64) -> (f64, f64) {
    (1..k).fold((x, 1.0), |(p, q), n| (((2 * n + 1) as f64 * x * p - n as f64 * q) / (n + 1) as f64, p))
}

impl Radau {
    /// The nodes are the zeros of P_s - P_(s-1) on (-1, 1]; a_ij are integrals of Lagrange's polynomials, exact by Gauss's rule.
    fn new() -> Radau {
        let value = |x: f64| {
            let (p, q) = legendre(STAGES, x);
            p - q
        };
        let mut c = [1.0; STAGES];
        let (mut found, parts) = (0, 400);
        for k in 0..parts {
            let (mut low, mut high) = (-1.0 + 2.0 * k as f64 / parts as f64, -1.0 + 2.0 * (k + 1) as f64 / parts as f64);
            if found + 1 >= STAGES || value(low) * value(high) > 0.0 {
                continue;
            }
            for _ in 0..60 {
                let middle = 0.5 * (low + high);
                if value(low) * value(middle) <= 0.0 { high = middle } else { low = middle }
            }
            c[found] = 0.5 * (1.0 + 0.5 * (low + high));
            found += 1;
        }
        let lagrange = |j: usize, x: f64| (0..STAGES).filter(|&k| k != j).map(|k| (x - c[k]) / (c[j] - c[k])).product::<f64>();
        let entry = |i: usize, j: usize| EIGHT.iter().map(|(x, w)| 0.5 * c[i] * w * lagrange(j, 0.5 * c[i] * (1.0 + x))).sum();
        let a = std::array::from_fn(|i| std::array::from_fn(|j| entry(i, j)));
        Radau { c, a }
    }
}

/// Looks up the motion and its derivatives.
struct Along<'s, 'o, S: System + ?Sized> {
    system: &'s mut S,
    stretch: &'s Stretch<'o>,
    n: usize,
    x: Vec<f64>,
    rows: Vec<f64>,
}

impl<S: System + ?Sized> Along<'_, '_, S> {
    /// A in scales: entry (i, j) is the rate of state i in its scale by a change of state j in its own.
    fn matrix(&mut self, t: f64) -> Result<Vec<f64>, Fault> {
        let steps = self.stretch.steps;
        let k = steps.partition_point(|s| s.end().high < t).min(steps.len() - 1);
        steps[k].state_at(t, &mut self.x);
        slopes(self.system, t, &self.x, &steps[k].modes, self.stretch.scales, &mut self.rows)?;
        let (n, scales) = (self.n, self.stretch.scales);
        let entry = |k: usize| self.rows[(k / n) * (n + 1) + k % n] * scales[k % n] / scales[k / n];
        let out: Vec<f64> = (0..n * n).map(entry).collect();
        if out.iter().all(|v| v.is_finite()) { Ok(out) } else { Err(super::no_derivative(t)) }
    }

    /// One step of Radau's method; none when its system is singular.
    fn step(&mut self, radau: &Radau, t: f64, h: f64) -> Result<Option<Square>, Fault> {
        let n = self.n;
        let size = n * STAGES;
        let mut matrix = vec![0.0; size * size];
        let mut right = Vec::with_capacity(STAGES);
        for i in 0..STAGES {
            let a = self.matrix(t + radau.c[i] * h)?;
            for (k, entry) in a.iter().enumerate() {
                let row = (i * n + k / n) * size + k % n;
                (0..STAGES).for_each(|j| matrix[row + j * n] = -h * radau.a[i][j] * entry);
            }
            right.push(a);
        }
        (0..size).for_each(|i| matrix[i * size + i] += 1.0);
        let lu = Lu::new(&matrix, size);
        let mut out = Square::identity(n);
        for column in 0..n {
            let b: Vec<f64> = (0..size).map(|k| right[k / n][(k % n) * n + column]).collect();
            let Some(k) = lu.solve(&b) else { return Ok(None) };
            for i in 0..n {
                out.values[i * n + column] += h * (0..STAGES).map(|j| radau.a[STAGES - 1][j] * k[j * n + i]).sum::<f64>();
            }
        }
        Ok(Some(out))
    }

    /// The step in two halves, and the difference from one step.
    fn halves(&mut self, radau: &Radau, t: f64, h: f64) -> Result<Option<(Square, f64)>, Fault> {
        let Some(whole) = self.step(radau, t, h)? else { return Ok(None) };
        let Some(first) = self.step(radau, t, 0.5 * h)? else { return Ok(None) };
        let Some(second) = self.step(radau, t + 0.5 * h, 0.5 * h)? else { return Ok(None) };
        let fine = second.times(&first);
        let size = fine.values.iter().fold(1.0_f64, |m, v| m.max(v.abs()));
        let off = fine.values.iter().zip(&whole.values).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        Ok(Some((fine, off / size)))
    }

    fn trace(&mut self, t: f64) -> Result<f64, Fault> {
        let (a, n) = (self.matrix(t)?, self.n);
        Ok((0..n).map(|i| a[i * n + i]).sum())
    }

    /// ∫ tr A dt over [t, t + h].
    fn divergence(&mut self, t: f64, h: f64) -> Result<f64, Fault> {
        let mut sum = 0.0;
        for (x, w) in EIGHT {
            sum += 0.5 * h * w * self.trace(t + 0.5 * h * (1.0 + x))?;
        }
        Ok(sum)
    }

    /// The same on halves until it no longer changes.
    fn settled_divergence(&mut self, t: f64, h: f64) -> Result<f64, Fault> {
        let mut stack = vec![(t, h, self.divergence(t, h)?, 0_u32)];
        let mut sum = 0.0;
        while let Some((t, h, whole, depth)) = stack.pop() {
            let (first, second) = (self.divergence(t, 0.5 * h)?, self.divergence(t + 0.5 * h, 0.5 * h)?);
            if depth >= 12 || (first + second - whole).abs() <= 1e-13 * (1.0 + whole.abs()) {
                sum += first + second;
            } else {
                stack.push((t + 0.5 * h, 0.5 * h, second, depth + 1));
                stack.push((t, 0.5 * h, first, depth + 1));
            }
        }
        Ok(sum)
    }
}

/// Variations of a stretch.
///
/// *Errors*: S054 where f has no derivative, S055 when the steps become too small or too many.
pub(super) fn vary<S: System + ?Sized>(system: &mut S, stretch: &Stretch<'_>) -> Result<Varied, Fault> {
    let n = stretch.scales.len();
    let mut out = Varied { matrix: Square::identity(n), divergence: 0.0, liouville: 0.0 };
    let (Some(first), Some(last)) = (stretch.steps.first(), stretch.steps.last()) else { return Ok(out) };
    let radau = Radau::new();
    let mut along = Along { system, stretch, n, x: vec![0.0; n], rows: Vec::new() };
    let (mut t, end) = (first.start.high, last.end().high);
    let mut h = (end - t).min(stretch.period / LEAST);
    for _ in 0..MOST {
        if end - t <= 4.0 * f64::EPSILON * end.abs() {
            out.matrix.unscale(stretch.scales);
            return Ok(out);
        }
        h = h.min(end - t);
        if h <= 8.0 * f64::EPSILON * (t.abs() + h) {
            break;
        }
        let (factor, found) = match along.halves(&radau, t, h)? {
            Some((fine, off)) if off.is_finite() => (0.9 * (TOLERANCE / off.max(1e-30)).powf(1.0 / (2 * STAGES) as f64), Some((fine, off))),
            _ => (0.25, None),
        };
        if let Some((fine, _)) = found.filter(|(_, off)| *off <= TOLERANCE) {
            let divergence = along.settled_divergence(t, h)?;
            out.liouville += (fine.determinant() - divergence.exp()).abs() / fine.hadamard().max(divergence.exp());
            out.divergence += divergence;
            out.matrix = fine.times(&out.matrix);
            t = if h >= end - t { end } else { t + h };
        }
        h *= factor.clamp(0.2, 3.0);
    }
    Err(super::too_quick(t))
}
