//! The variational equations Φ' = A(t) Φ along a motion that is known, A = ∂f/∂x, with a step of their own.
//!
//! How quickly a disturbance moves has nothing to do with how quickly the regime moves: a mode may turn a thousand times in a period. The equations
//! are linear, so Radau's method (IIA, seven stages, order 13, L-stable) is one linear system a step. Each step is also taken in two halves; the
//! difference is the error, and the halves are what counts.
//!
//! ```text
//! K_i = A(t + c_i h) (1 + h Σ a_ij K_j),   F = 1 + h Σ a_sj K_j,   Φ <- F Φ
//! det Φ = exp ∫ tr A dt                    Liouville's formula, by Gauss's rule and independent of the steps
//! ```
//!
//! What counts is the error in F Φ, not in F: a mode that has died out in Φ needs no resolution any more, so that relaxation oscillations take steps of
//! the length of their slow parts. All that the steps may have left in Φ(T) is added up, each error carried on to the end ([`Chain::doubt`]). The scales
//! are balanced first (E. E. Osborne, J. ACM 7 (1960)): those of a machine at rest may be many decades apart.
//!
//! *Source*: E. Hairer, G. Wanner, Solving Ordinary Differential Equations II, IV.5.

use super::listener::{Listener, Stage};
use super::orbit::Orbit;
use super::slopes::slopes;
use super::square::Square;
use crate::integrate::Step;
use crate::{Fault, System};
use algebra::elementary;
use algebra::gauss::EIGHT;
use algebra::lu::Lu;
use algebra::sum::Instant;

/// Stages.
const STAGES: usize = 7;
/// Error of a step, in scales, of a start that changes by one scale.
const TOLERANCE: f64 = 1e-13;
/// The same for one of several steps of Newton's method, which leaves about this share of the gap then; rounding of A alone may leave a hundredth of it.
pub(in crate::studies) const CORRECTS: f64 = 1e-7;
/// Least number of steps in a period: a flat regime says nothing of how its stiffness moves in time.
const LEAST: f64 = 32.0;
/// Most steps of a stretch.
const MOST: usize = 2_000_000;
/// A difference below this that does not fall with the step is rounding of A.
const ROUGH: f64 = 1e-9;
/// By how much a step grows where rounding of A is all that the difference shows.
const LONGER: f64 = 1.5;
/// How much smaller than the difference the error of the two halves is, at least: 2^13 in theory.
const BETTER: f64 = 64.0;
/// Share of the turn below which there is no step.
const SHORTEST: f64 = 1e-22;
/// Most steps of the motion that a step of the variations covers.
const AHEAD: usize = 4;
/// Places of a turn at which A is looked at to balance the scales, and sweeps.
const PLACES: usize = 48;
const SWEEPS: usize = 10;
/// Links of a chain before neighbours are joined.
const LINKS: usize = 8192;

/// A stretch of the motion without switches.
pub(super) struct Stretch<'o> {
    pub(super) steps: &'o [Step],
    pub(super) scales: &'o [f64],
    /// Duration of the whole turn.
    pub(super) period: f64,
    /// What the result is for.
    pub(super) care: Care,
    /// Who listens.
    pub(super) listener: Listener<'o>,
}

/// What a fundamental matrix is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Care {
    /// Multipliers with a bound of their errors, and Liouville's formula.
    Multipliers,
    /// A step of Newton's method that has to close at once, however near to singular it is: all digits, but nothing is said of them.
    Closing,
    /// One of several steps: an error of the matrix leaves as small a share of the gap, and the next step takes that away.
    Correction,
}

impl Care {
    /// Error of a step of the variations, in scales, of a start that changes by one scale.
    fn tolerance(self) -> f64 {
        match self {
            Care::Multipliers | Care::Closing => TOLERANCE,
            Care::Correction => CORRECTS,
        }
    }
}

/// Time from one instant to another. Jumps of a microsecond after half an hour need more digits than one number has.
fn between(from: Instant, to: Instant) -> f64 {
    from.until(to.high) + to.low
}

impl Stretch<'_> {
    /// How far a step from t may go: over so few steps of the motion that none of its quick parts lies between the nodes.
    fn seen_from(&self, t: Instant) -> f64 {
        let here = self.steps.partition_point(|s| between(t, s.end()) <= 0.0);
        let last = (here + AHEAD).min(self.steps.len()) - 1;
        between(t, self.steps[last].end())
    }
}

/// The fundamental matrix from the start of the turn as a product, in scales.
pub(super) struct Chain {
    pub(super) whole: Square,
    links: Vec<Link>,
}

/// A factor, and what it may err by in the entries of its product with all before it.
struct Link {
    matrix: Square,
    error: f64,
}

impl Chain {
    pub(super) fn new(n: usize) -> Chain {
        Chain { whole: Square::identity(n), links: Vec::new() }
    }

    pub(super) fn push(&mut self, matrix: Square, error: f64) {
        self.whole = matrix.times(&self.whole);
        self.links.push(Link { matrix, error });
        if self.links.len() >= LINKS {
            let joined = |pair: &[Link]| match pair {
                [a, b] => Link { matrix: b.matrix.times(&a.matrix), error: b.error + b.matrix.norm() * a.error },
                _ => Link { matrix: pair[0].matrix.clone(), error: pair[0].error },
            };
            self.links = self.links.chunks(2).map(joined).collect();
        }
    }

    /// Bound of the error in the entries of the whole, as a share of the largest: Σ |F_N ... F_(k+1)| e_k.
    pub(super) fn doubt(&self) -> f64 {
        let (mut after, mut sum) = (Square::identity(self.whole.n), 0.0);
        for link in self.links.iter().rev() {
            sum += after.norm() * link.error;
            after = after.times(&link.matrix);
        }
        let doubt = sum / self.whole.largest();
        if doubt.is_finite() { doubt } else { 0.0 }
    }
}

/// What the variations of a stretch are.
pub(super) struct Varied {
    /// ∫ tr A dt; of a correction 0.
    pub(super) divergence: f64,
    /// By how much Liouville's formula is missed: sum over the steps of |det F - exp ∫ tr A|, each relative to the largest determinant that columns
    /// of this length can have; of a step that does not resolve modes long dead the same with F Φ.
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
    fn matrix(&mut self, t: Instant) -> Result<Vec<f64>, Fault> {
        let steps = self.stretch.steps;
        let k = steps.partition_point(|s| between(t, s.end()) < 0.0).min(steps.len() - 1);
        steps[k].state_after(between(steps[k].start, t), &mut self.x);
        slopes(self.system, (t.high, &self.x), &steps[k].modes, self.stretch.scales, &mut self.rows)?;
        let (n, scales) = (self.n, self.stretch.scales);
        let entry = |k: usize| self.rows[(k / n) * (n + 1) + k % n] * scales[k % n] / scales[k / n];
        let out: Vec<f64> = (0..n * n).map(entry).collect();
        if out.iter().all(|v| v.is_finite()) { Ok(out) } else { Err(super::faults::no_derivative(t.high)) }
    }

    /// One step of Radau's method; none when its system is singular. Only states on which some rate depends are unknowns: those whose columns of A are
    /// zero at all stages follow.
    fn step(&mut self, radau: &Radau, t: Instant, h: f64) -> Result<Option<Square>, Fault> {
        let n = self.n;
        let right = radau.c.iter().map(|c| self.matrix(t.after(c * h))).collect::<Result<Vec<_>, _>>()?;
        let felt: Vec<usize> = (0..n).filter(|j| right.iter().any(|a| (0..n).any(|i| a[i * n + j] != 0.0))).collect();
        let (m, size) = (felt.len(), felt.len() * STAGES);
        let mut matrix = vec![0.0; size * size];
        for (i, a) in right.iter().enumerate() {
            for (row, column) in (0..m).flat_map(|row| (0..m).map(move |column| (row, column))) {
                let entry = a[felt[row] * n + felt[column]];
                (0..STAGES).for_each(|j| matrix[(i * m + row) * size + j * m + column] = -h * radau.a[i][j] * entry);
            }
        }
        (0..size).for_each(|i| matrix[i * size + i] += 1.0);
        let lu = Lu::new(&matrix, size);
        let mut out = Square::identity(n);
        let mut disturbed = vec![0.0; size];
        for (place, &column) in felt.iter().enumerate() {
            let b: Vec<f64> = (0..size).map(|k| right[k / m][felt[k % m] * n + column]).collect();
            let Some(k) = lu.solve(&b) else { return Ok(None) };
            // the felt states at the stages
            for (i, d) in disturbed.iter_mut().enumerate() {
                let own = if i % m == place { 1.0 } else { 0.0 };
                *d = own + h * (0..STAGES).map(|j| radau.a[i / m][j] * k[j * m + i % m]).sum::<f64>();
            }
            for row in 0..n {
                let rate = |j: usize| match felt.iter().position(|of| *of == row) {
                    Some(own) => k[j * m + own],
                    None => felt.iter().enumerate().map(|(l, &of)| right[j][row * n + of] * disturbed[j * m + l]).sum(),
                };
                out.values[row * n + column] += h * (0..STAGES).map(|j| radau.a[STAGES - 1][j] * rate(j)).sum::<f64>();
            }
        }
        Ok(Some(out))
    }

    /// The step in two halves, and in one.
    fn halves(&mut self, radau: &Radau, t: Instant, h: f64) -> Result<Option<[Square; 2]>, Fault> {
        let Some(whole) = self.step(radau, t, h)? else { return Ok(None) };
        let Some(first) = self.step(radau, t, 0.5 * h)? else { return Ok(None) };
        let Some(second) = self.step(radau, t.after(0.5 * h), 0.5 * h)? else { return Ok(None) };
        Ok(Some([second.times(&first), whole]))
    }

    fn trace(&mut self, t: Instant) -> Result<f64, Fault> {
        let (a, n) = (self.matrix(t)?, self.n);
        Ok((0..n).map(|i| a[i * n + i]).sum())
    }

    /// ∫ tr A dt over [t, t + h].
    fn divergence(&mut self, t: Instant, h: f64) -> Result<f64, Fault> {
        let mut sum = 0.0;
        for (x, w) in EIGHT {
            sum += 0.5 * h * w * self.trace(t.after(0.5 * h * (1.0 + x)))?;
        }
        Ok(sum)
    }

    /// The same on halves until it no longer changes, or changes by rounding only.
    fn settled_divergence(&mut self, t: Instant, h: f64) -> Result<f64, Fault> {
        let mut stack = vec![Span { t, h, whole: self.divergence(t, h)?, off: f64::INFINITY, depth: 0 }];
        let mut sum = 0.0;
        while let Some(Span { t, h, whole, off, depth }) = stack.pop() {
            let halves = [self.divergence(t, 0.5 * h)?, self.divergence(t.after(0.5 * h), 0.5 * h)?];
            let (now, size) = ((halves[0] + halves[1] - whole).abs(), 1.0 + whole.abs());
            let rounding = depth > 0 && now > 0.25 * off && now <= ROUGH * size;
            if depth >= 12 || now <= TOLERANCE * size || rounding {
                sum += halves[0] + halves[1];
                continue;
            }
            for (k, whole) in [(1.0, halves[1]), (0.0, halves[0])] {
                stack.push(Span { t: t.after(0.5 * k * h), h: 0.5 * h, whole, off: now, depth: depth + 1 });
            }
        }
        Ok(sum)
    }
}

/// A part of a step whose divergence is to settle.
struct Span {
    t: Instant,
    h: f64,
    whole: f64,
    /// By how much the part before it was off.
    off: f64,
    depth: u32,
}

/// A step tried.
struct Tried {
    matrix: Square,
    /// Difference of the halves from the whole step, as a share of the largest entry (at least 1).
    own: f64,
    /// The same of F Φ.
    passed: f64,
    /// Largest entry of the difference in F Φ.
    error: f64,
}

impl Tried {
    fn new([fine, whole]: [Square; 2], before: &Square) -> Tried {
        let mut off = fine.clone();
        off.values.iter_mut().zip(&whole.values).for_each(|(a, b)| *a -= b);
        let (carried, error) = (fine.times(before).largest(), off.times(before).largest());
        Tried { own: off.largest() / fine.largest().max(1.0), passed: error / carried.max(f64::MIN_POSITIVE), error, matrix: fine }
    }

    fn off(&self) -> f64 {
        if self.own.is_nan() { f64::NAN } else { self.own.min(self.passed) }
    }

    /// Liouville's formula on the step.
    fn missed(&self, divergence: f64, before: &Square) -> f64 {
        let growth = elementary::exp(divergence);
        if self.own <= TOLERANCE {
            return (self.matrix.determinant() - growth).abs() / self.matrix.hadamard().max(growth);
        }
        let (old, new) = (before.determinant(), self.matrix.times(before));
        (new.determinant() - growth * old).abs() / new.hadamard().max(f64::MIN_POSITIVE)
    }
}

/// What neighbours a disturbance leads to depends on the way of assembly, and its equations have a pole.
fn in_change_point<S: System + ?Sized>(system: &S, step: &Step) -> Fault {
    let t = step.start.after(step.change.map_or(0.0, |[to, _]| to)).high;
    let mut x = vec![0.0; system.states().len()];
    step.state_at(t, &mut x);
    let n = system.n_coordinates();
    Fault::varied_over_change_point(&crate::naming::configuration(system.states().iter().zip(&x).take(n)), t)
}

/// Continues the chain over a stretch.
///
/// *Errors*: S122 over a change point, S054 where f has no derivative, S055 when the steps become too small or too many, S042 after an interruption.
pub(super) fn vary<S: System + ?Sized>(system: &mut S, stretch: &Stretch<'_>, chain: &mut Chain) -> Result<Varied, Fault> {
    let n = stretch.scales.len();
    let mut out = Varied { divergence: 0.0, liouville: 0.0 };
    let (Some(first), Some(last)) = (stretch.steps.first(), stretch.steps.last()) else { return Ok(out) };
    if let Some(step) = stretch.steps.iter().find(|step| step.change.is_some_and(|[to, _]| (0.0..step.length).contains(&to))) {
        return Err(in_change_point(system, step));
    }
    let (radau, wanted) = (Radau::new(), stretch.care.tolerance());
    let mut along = Along { system, stretch, n, x: vec![0.0; n], rows: Vec::new() };
    let (mut t, end) = (first.start, last.end());
    let mut h = between(t, end).min(stretch.period / LEAST);
    let (mut refused, mut rough): (Option<f64>, f64) = (None, 0.0);
    for _ in 0..MOST {
        let left = between(t, end);
        if left <= SHORTEST * stretch.period {
            return Ok(out);
        }
        if stretch.listener.is_interrupted() {
            return Err(super::faults::unsettled(1.0, 0));
        }
        stretch.listener.tell(Stage::Varying(t.high / stretch.period));
        h = h.min(left).min(stretch.seen_from(t));
        if h <= SHORTEST * stretch.period {
            break;
        }
        let tried = along.halves(&radau, t, h)?.map(|both| Tried::new(both, &chain.whole));
        let Some(tried) = tried.filter(|tried| tried.off().is_finite()) else {
            (h, refused) = (0.25 * h, None);
            continue;
        };
        let off = tried.off();
        let rounding = off <= ROUGH && refused.is_some_and(|before| off > 0.5 * before);
        let allowed = wanted.max((2.0 * rough * h).min(ROUGH));
        // no quotient by nothing
        let factor = 0.9 * elementary::pow(allowed / off.max(1e-30), 1.0 / (2 * STAGES) as f64);
        if off > allowed && !rounding {
            refused = Some(off);
            h *= factor.clamp(0.2, 0.9);
            continue;
        }
        rough = if rounding { rough.max(off / h) } else { rough };
        refused = None;
        if stretch.care == Care::Multipliers {
            let divergence = along.settled_divergence(t, h)?;
            out.liouville += tried.missed(divergence, &chain.whole);
            out.divergence += divergence;
        }
        chain.push(tried.matrix, if off > wanted { tried.error } else { tried.error / BETTER });
        t = if h >= left { end } else { t.after(h) };
        // rounding of A costs the same over a time, however many steps it has
        h *= if off > wanted { LONGER } else { factor.clamp(0.9, 3.0) };
    }
    Err(super::faults::too_quick(t.high))
}

/// Scales in which the rates of each state depend on the others about as the others' depend on it: rows and columns of |A|, its largest entries along
/// the turn, made equal in length by powers of two.
pub(super) fn balanced<S: System + ?Sized>(system: &mut S, orbit: &Orbit, scales: &[f64]) -> Vec<f64> {
    let (n, mut out) = (scales.len(), scales.to_vec());
    let mut largest = vec![0.0_f64; n * n];
    let mut rows = Vec::new();
    for step in orbit.steps.iter().step_by(orbit.steps.len().div_ceil(PLACES).max(1)) {
        let x: Vec<f64> = (0..n).map(|i| step.start_value(i)).collect();
        // where there is no derivative another place tells
        if slopes(system, (step.start.high, &x), &step.modes, scales, &mut rows).is_ok() {
            for (k, entry) in largest.iter_mut().enumerate() {
                let a = (rows[(k / n) * (n + 1) + k % n] * scales[k % n] / scales[k / n]).abs();
                *entry = entry.max(if a.is_finite() { a } else { 0.0 });
            }
        }
    }
    for i in (0..n).cycle().take(SWEEPS * n) {
        let others = || (0..n).filter(|j| *j != i);
        let (row, column): (f64, f64) = (others().map(|j| largest[i * n + j]).sum(), others().map(|j| largest[j * n + i]).sum());
        if row > 0.0 && column > 0.0 {
            let factor = elementary::exp2((0.5 * elementary::log2(row / column)).round());
            out[i] *= factor;
            others().for_each(|j| {
                largest[i * n + j] /= factor;
                largest[j * n + i] *= factor;
            });
        }
    }
    out
}
