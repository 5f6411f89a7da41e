//! Orthogonal collocation on one interval of a mesh: polynomials of degree five that satisfy x' = f(t, x) at Gauss's points.
//!
//! ```text
//! k_i = f(t + c_i h, x + h Σ a_il k_l),    G(x) = x + h Σ b_i k_i        c, b Gauss's rule, a its integrals
//! (1 - h a ⊗ J) dk = J dx,                 dG = dx + h Σ b_i dk_i
//! ```
//!
//! At the ends of intervals the error falls with the tenth power of their length.
//!
//! *Source*: U. M. Ascher, R. M. M. Mattheij, R. D. Russell, Numerical Solution of Boundary Value Problems for Ordinary Differential Equations, 5; E. Hairer, G. Wanner, II, IV.5.

use crate::integrate::Step;
use crate::{Fault, Machine, Mode, System};
use algebra::gauss::FIVE;
use algebra::lu::Lu;

/// Points of an interval.
pub(super) const STAGES: usize = 5;
/// Corrections of the rates of an interval.
const CORRECTIONS: usize = 12;
/// A correction below this, in scales, has arrived.
const ENOUGH: f64 = 1e-15;
/// Where corrections end to fall, an interval is known to this.
const ROUGH: f64 = 1e-12;
/// Error of the series by which the mesh is laid, as a share of the scales: intervals are as long as a step of that tolerance is, divided by [`FINER`].
const TOLERANCE: f64 = 1e-13;
/// Intervals a step of the series: its order is 26, and that of Gauss's points ten.
const FINER: f64 = 2.0;
/// Largest h |J| of an interval: beyond it corrections of its rates meet a disturbance that grows by powers of ten.
const QUICKEST: f64 = 4.0;
/// Least number of intervals.
const LEAST: usize = 16;

/// Gauss's rule on [0, 1].
pub(super) struct Gauss {
    pub(super) c: [f64; STAGES],
    b: [f64; STAGES],
    a: [[f64; STAGES]; STAGES],
}

impl Gauss {
    pub(super) fn new() -> Gauss {
        let c = FIVE.map(|(x, _)| 0.5 * (1.0 + x));
        let b = FIVE.map(|(_, w)| 0.5 * w);
        let lagrange = |j: usize, x: f64| (0..STAGES).filter(|k| *k != j).map(|k| (x - c[k]) / (c[j] - c[k])).product::<f64>();
        // of degree four, for which the rule itself is exact
        let entry = |i: usize, j: usize| (0..STAGES).map(|l| c[i] * b[l] * lagrange(j, c[i] * c[l])).sum();
        let a = std::array::from_fn(|i| std::array::from_fn(|j| entry(i, j)));
        Gauss { c, b, a }
    }
}

/// An interval: where it begins, how long it is, and the switch positions that hold in it.
pub(super) struct Interval<'m> {
    pub(super) machine: &'m mut Machine,
    pub(super) rule: &'m Gauss,
    pub(super) modes: &'m [Mode],
    pub(super) scales: &'m [f64],
    pub(super) start: f64,
    pub(super) length: f64,
}

/// What an interval makes of a state.
pub(super) struct Passed {
    /// The state at its end.
    pub(super) end: Vec<f64>,
    /// Derivatives of the rates by the states at the points.
    slopes: Vec<Vec<f64>>,
    system: Lu,
    /// Sum of the rates of the points with their weights.
    mean: Vec<f64>,
}

/// What the rates miss at the points, the derivatives there, and the matrix of a correction; none where it is singular.
struct Linear {
    residual: Vec<f64>,
    slopes: Vec<Vec<f64>>,
    system: Option<Lu>,
}

/// How an end changes.
pub(super) struct Change {
    /// By the start, row by row, SI.
    pub(super) by_start: Vec<f64>,
    /// By the duration of the whole, the interval keeping its share of it.
    pub(super) by_period: Vec<f64>,
}

/// Rates of the states.
pub(super) fn rates(machine: &mut Machine, (t, x): (f64, &[f64]), modes: &[Mode]) -> Result<Vec<f64>, Fault> {
    let mut out = vec![0.0; x.len()];
    if !machine.rates(t, x, modes, &mut out) {
        machine.expand(t, x, modes, 1)?;
        (0..x.len()).for_each(|i| out[i] = machine.state(i)[1]);
    }
    Ok(out)
}

impl Interval<'_> {
    fn point(&self, x: &[f64], k: &[f64], i: usize) -> Vec<f64> {
        let (n, h) = (x.len(), self.length);
        (0..n).map(|s| x[s] + h * (0..STAGES).map(|l| self.rule.a[i][l] * k[l * n + s]).sum::<f64>()).collect()
    }

    /// Finds the rates k from those that are likely; none where corrections do not settle.
    pub(super) fn pass(&mut self, x: &[f64], k: &mut Vec<f64>) -> Result<Option<Passed>, Fault> {
        let n = x.len();
        if k.len() != STAGES * n {
            let own = rates(self.machine, (self.start, x), self.modes)?;
            *k = (0..STAGES).flat_map(|_| own.iter().copied()).collect();
        }
        let mut last = f64::INFINITY;
        for _ in 0..CORRECTIONS {
            let Linear { residual, slopes, system } = self.linear(x, k)?;
            let Some(change) = system.as_ref().and_then(|lu| lu.solve(&residual)) else { return Ok(None) };
            k.iter_mut().zip(&change).for_each(|(k, d)| *k += d);
            let size = change.iter().enumerate().fold(0.0_f64, |l, (e, d)| l.max((self.length * d / self.scales[e % n]).abs()));
            if !size.is_finite() {
                return Ok(None);
            }
            if size <= ENOUGH || (size >= 0.5 * last && last <= ROUGH) {
                let mean: Vec<f64> = (0..n).map(|s| (0..STAGES).map(|i| self.rule.b[i] * k[i * n + s]).sum()).collect();
                let end = x.iter().zip(&mean).map(|(x, m)| x + self.length * m).collect();
                return Ok(system.map(|system| Passed { end, slopes, system, mean }));
            }
            last = size;
        }
        Ok(None)
    }

    /// The equations of a correction.
    fn linear(&mut self, x: &[f64], k: &[f64]) -> Result<Linear, Fault> {
        let n = x.len();
        let size = STAGES * n;
        let (mut residual, mut slopes, mut matrix) = (Vec::with_capacity(size), Vec::new(), vec![0.0; size * size]);
        let mut rows = Vec::new();
        for i in 0..STAGES {
            let (t, place) = (self.start + self.rule.c[i] * self.length, self.point(x, k, i));
            let found = rates(self.machine, (t, &place), self.modes)?;
            residual.extend(found.iter().zip(&k[i * n..]).map(|(f, k)| f - k));
            self.machine.slopes(t, &place, self.modes, &mut rows)?;
            let own: Vec<f64> = (0..n * n).map(|e| rows[e / n * (n + 1) + e % n]).collect();
            for l in 0..STAGES {
                let share = self.length * self.rule.a[i][l];
                (0..n * n).for_each(|e| matrix[(i * n + e / n) * size + l * n + e % n] = -share * own[e]);
            }
            slopes.push(own);
        }
        (0..size).for_each(|e| matrix[e * size + e] += 1.0);
        Ok(Linear { residual, slopes, system: Lu::exact(&matrix, size) })
    }

    /// What changes of the start and of the duration of the whole do to the end.
    pub(super) fn change(&self, passed: &Passed, k: &[f64], share: f64) -> Option<Change> {
        let (n, h) = (passed.end.len(), self.length);
        let applied = |v: &dyn Fn(usize, usize) -> f64| -> Vec<f64> {
            let row = |e: usize| (0..n).map(|s| passed.slopes[e / n][e % n * n + s] * v(e / n, s)).sum();
            (0..STAGES * n).map(row).collect()
        };
        let after = |dk: &[f64], s: usize| h * (0..STAGES).map(|i| self.rule.b[i] * dk[i * n + s]).sum::<f64>();
        let mut by_start = vec![0.0; n * n];
        for column in 0..n {
            let dk = passed.system.solve(&applied(&|_, s| if s == column { 1.0 } else { 0.0 }))?;
            (0..n).for_each(|s| by_start[s * n + column] = after(&dk, s) + if s == column { 1.0 } else { 0.0 });
        }
        let stretched = |i: usize, s: usize| share * (0..STAGES).map(|l| self.rule.a[i][l] * k[l * n + s]).sum::<f64>();
        let dk = passed.system.solve(&applied(&stretched))?;
        let by_period = (0..n).map(|s| share * passed.mean[s] + after(&dk, s)).collect();
        Some(Change { by_start, by_period })
    }
}

/// Ends of the intervals as shares of the period: each as long as the series of the motion and the derivatives of its rates allow (equidistribution).
pub(super) fn mesh(machine: &mut Machine, steps: &[Step], scales: &[f64]) -> Result<Vec<f64>, Fault> {
    let n = scales.len();
    let mut rows = Vec::new();
    let (mut ends, mut sums) = (vec![0.0], vec![0.0]);
    let first = steps.first().map_or(0.0, |step| step.start.high);
    for step in steps {
        let mut quickest = 0.0_f64;
        for share in [0.0, 0.5, 1.0] {
            let mut x = vec![0.0; n];
            step.state_after(share * step.length, &mut x);
            machine.slopes(step.start.high + share * step.length, &x, &step.modes, &mut rows)?;
            let row = |i: usize| (0..n).map(|j| (rows[i * (n + 1) + j] * scales[j] / scales[i]).abs()).sum::<f64>();
            quickest = (0..n).map(row).fold(quickest, f64::max);
        }
        let natural = (0..n).map(|i| natural(step.coefficients(i), scales[i])).fold(f64::INFINITY, f64::min);
        let density = (FINER / natural).max(quickest / QUICKEST);
        ends.push(step.start.high + step.length - first);
        sums.push(sums[sums.len() - 1] + density * step.length);
    }
    let (whole, time) = (sums[sums.len() - 1], ends[ends.len() - 1]);
    let count = (whole.ceil() as usize).max(LEAST);
    let mut at = 0;
    let inner = (1..count).map(|k| {
        let wanted = whole * k as f64 / count as f64;
        while at + 2 < sums.len() && sums[at + 1] < wanted {
            at += 1;
        }
        let share = if sums[at + 1] > sums[at] { (wanted - sums[at]) / (sums[at + 1] - sums[at]) } else { 1.0 };
        (ends[at] + share * (ends[at + 1] - ends[at])) / time
    });
    Ok([0.0].into_iter().chain(inner).chain([1.0]).collect())
}

/// Length of a step at which the last two terms of a series are what the tolerance leaves.
fn natural(coefficients: &[f64], scale: f64) -> f64 {
    let last = coefficients.len().saturating_sub(1);
    let of = |order: usize| {
        let size = (coefficients[order] / scale).abs();
        if size > 0.0 { algebra::elementary::pow(TOLERANCE / size, 1.0 / order as f64) } else { f64::INFINITY }
    };
    (last.saturating_sub(1).max(1)..=last).map(of).fold(f64::INFINITY, f64::min)
}
