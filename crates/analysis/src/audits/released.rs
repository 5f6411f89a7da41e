//! The balances of released bodies along the motion, made anew from placements.
//!
//! Reactions of hidden directions follow from balances whose accelerations are expressions. Here nothing of these is used: centres r and rotations R of all
//! bodies are taken at Chebyshev's points of a stretch about the middle of a step, short enough to resolve them, and differentiated in numbers, twice,
//!
//! ```text
//! p = m r',   L = r × p + R I Rᵀ ω,   ω from R' Rᵀ,   about the origin of the ground
//! ```
//!
//! and in every displacement (shift s of the frame's origin o, turn w) in which a released frame with all that stands on it must balance,
//!
//! ```text
//! Σ F·(s - w × o) + Σ M·w = Σ p'·(s - w × o) + Σ L'·w
//! ```
//!
//! F and M are all loads and reactions with their moment about the origin of the ground, another point than that of the balances. A reaction from which a load or an
//! inertia force was left out breaks it. *Source*: L. N. Trefethen, Spectral Methods in MATLAB, ch. 6 (differentiation at Chebyshev's points).

use symbolic::Text;

use super::frontier::Frontier;
use crate::dataset::Audit;
use crate::system::Layout;
use crate::taylor::Step;
use crate::{Mode, System};

/// Points less one; even, so that the middle of the step is one of them.
const N: usize = 16;
/// Largest residual relative to the terms that meet. A forgotten term is seen at 1e-3 and more.
const LIMIT: f64 = 1e-6;
/// Rounding of a second derivative, in units of the last place of the place over the square of half the step.
const ROUNDING: f64 = 4.0 * (N * N) as f64 * f64::EPSILON;
/// Samples before every second one is dropped.
const SAMPLES: u64 = 8;
/// Share of a placement's change that its last coefficients may have.
const TAIL: f64 = 1e-12;
/// How often the stretch of the step that is looked at is halved.
const HALVINGS: usize = 24;
/// Numbers of a body.
const BODY: usize = Layout::BODY;

type Vector = [f64; 3];
/// Centre, rotation by rows.
type Placement = [f64; 12];

/// Collects the residual along a motion.
#[derive(Clone, Debug)]
pub struct ReleasedBalance {
    layout: Layout,
    found: Frontier,
    /// Largest terms of each displacement so far.
    largest: Vec<f64>,
    strongest: f64,
    steps: u64,
    stride: u64,
    taken: u64,
    known: bool,
    derivative: Vec<f64>,
    /// cos(π k/N), k < 2 N.
    cosines: Vec<f64>,
}

/// Terms of one displacement.
struct Terms {
    residual: f64,
    size: f64,
    rounding: f64,
}

impl ReleasedBalance {
    /// For a system.
    pub fn new<S: System + ?Sized>(system: &S) -> ReleasedBalance {
        let layout = system.layout();
        let known = !layout.frames.is_empty();
        let found = Frontier::default();
        ReleasedBalance {
            layout,
            found,
            largest: Vec::new(),
            strongest: 0.0,
            steps: 0,
            stride: 1,
            taken: 0,
            known,
            derivative: chebyshev(),
            cosines: (0..2 * N).map(|k| (std::f64::consts::PI * k as f64 / N as f64).cos()).collect(),
        }
    }

    /// Looks at the middle of a step; at every one of the first, then at every second, fourth, ...
    pub fn look<S: System + ?Sized>(&mut self, step: &Step, system: &mut S) {
        self.steps += 1;
        if !self.known || step.length == 0.0 || step.change.is_some() || !(self.steps - 1).is_multiple_of(self.stride) {
            return;
        }
        let Some(terms) = self.terms(step, system) else {
            self.known = false;
            return;
        };
        self.largest.resize(terms.len(), 0.0);
        for (term, largest) in terms.iter().zip(&mut self.largest) {
            *largest = largest.max(term.size);
            self.found.note(term.residual, term.size.max(1e-3 * *largest).max(term.rounding / LIMIT));
            self.strongest = self.strongest.max(term.size);
        }
        self.found.whole(self.strongest);
        self.taken += 1;
        if self.taken.is_multiple_of(SAMPLES) {
            self.stride *= 2;
        }
    }

    fn terms<S: System + ?Sized>(&self, step: &Step, system: &mut S) -> Option<Vec<Terms>> {
        let middle = 0.5 * step.length;
        let here = self.balance(step, middle, system)?;
        let (nodes, half) = self.nodes(step, middle, system)?;
        let momenta: Vec<[Vector; 3]> = (0..self.layout.bodies).map(|b| self.rates(&nodes, b, half)).collect();
        let mut at = BODY * self.layout.bodies;
        let mut take = || -> Vector {
            at += 3;
            [here[at - 3], here[at - 2], here[at - 1]]
        };
        let mut list = Vec::new();
        for (bodies, ways) in &self.layout.frames {
            let (origin, force, moment) = (take(), take(), take());
            for _ in 0..*ways {
                let (shift, turn) = (take(), take());
                let shift = minus(shift, cross(turn, origin));
                let (f, m) = (dot(force, shift), dot(moment, turn));
                let (mut residual, mut size, mut rounding) = (f + m, f.abs() + m.abs(), 0.0);
                for [p, l, noise] in bodies.iter().map(|b| momenta[*b]) {
                    let (linear, angular) = (dot(p, shift), dot(l, turn));
                    residual -= linear + angular;
                    size += linear.abs() + angular.abs();
                    rounding += noise[0] * length(shift) + noise[1] * length(turn);
                }
                list.push(Terms { residual: residual.abs(), size, rounding });
            }
        }
        Some(list)
    }

    /// Placements at Chebyshev's points of a stretch about the middle that is short enough to resolve them, and half of its length.
    fn nodes<S: System + ?Sized>(&self, step: &Step, middle: f64, system: &mut S) -> Option<(Vec<Vec<f64>>, f64)> {
        let mut half = middle;
        let mut x = vec![0.0; system.states().len()];
        for halving in 1.. {
            let mut node = |k: usize| {
                let t = step.instant(middle + half * abscissa(k)).high;
                step.state_at(t, &mut x);
                system.placements(t, &x)
            };
            let nodes: Vec<Vec<f64>> = (0..=N).map(&mut node).collect::<Option<_>>()?;
            if halving == HALVINGS || self.is_resolved(&nodes) {
                return Some((nodes, half));
            }
            half *= 0.5;
        }
        None
    }

    /// Whether the last coefficients of Chebyshev's series of every placement have died out: a step may hold many turns of a shaft.
    fn is_resolved(&self, nodes: &[Vec<f64>]) -> bool {
        let end = |j: usize| if j == 0 || j == N { 0.5 } else { 1.0 };
        let coefficients = |body: usize, k: usize| self.weighted(nodes, body, |j| 2.0 / N as f64 * end(j) * self.cosines[j * k % (2 * N)]);
        let largest = |m: Placement, c: Placement| std::array::from_fn(|i| f64::max(m[i], c[i].abs()));
        (0..self.layout.bodies).all(|body| {
            let tail = (N - 2..=N).fold(Placement::default(), |m, k| largest(m, coefficients(body, k)));
            let size = (1..N / 2).fold(Placement::default(), |m, k| largest(m, coefficients(body, k)));
            let values = nodes.iter().fold(Placement::default(), |m, node| largest(m, *placement(node, body)));
            (0..tail.len()).all(|i| tail[i] <= (TAIL * size[i]).max(8.0 * f64::EPSILON * values[i]))
        })
    }

    /// Σ w_j placement_j over the points.
    fn weighted(&self, nodes: &[Vec<f64>], body: usize, weight: impl Fn(usize) -> f64) -> Placement {
        let mut sum = Placement::default();
        for (j, node) in nodes.iter().enumerate() {
            let w = weight(j);
            sum.iter_mut().zip(placement(node, body)).for_each(|(s, v)| *s += w * v);
        }
        sum
    }

    /// Bodies and all that acts on them.
    fn balance<S: System + ?Sized>(&self, step: &Step, after: f64, system: &mut S) -> Option<Vec<f64>> {
        let t = step.instant(after).high;
        let n = system.states().len();
        let (mut x, mut rates) = (vec![0.0; n], vec![0.0; n]);
        step.state_at(t, &mut x);
        step.rate_at(t, &mut rates);
        let q = system.n_coordinates();
        let modes: &[Mode] = &step.modes;
        system.released(t, &x, &rates[q..2 * q], modes)
    }

    /// p' and L' in the middle, and the rounding of both.
    fn rates(&self, nodes: &[Vec<f64>], body: usize, half: f64) -> [Vector; 3] {
        let of = |k: usize, i: usize| nodes[k][BODY * body + i];
        let moved: Vec<Placement> = (0..=N).map(|k| self.weighted(nodes, body, |j| self.derivative[k * (N + 1) + j])).collect();
        // centre and rotation begin behind the mass
        let derivative = |i: usize, k: usize| moved[k][i - 1] / half;
        let mass = of(N / 2, 0);
        let momentum = |k: usize| -> (Vector, Vector) {
            let p = [1, 2, 3].map(|i| mass * derivative(i, k));
            let r = [of(k, 1), of(k, 2), of(k, 3)];
            let own = [0, 1, 2].map(|i| [0, 1, 2].map(|j| of(k, 4 + 3 * i + j)));
            let rate = [0, 1, 2].map(|i| [0, 1, 2].map(|j| derivative(4 + 3 * i + j, k)));
            // Ω = R' Rᵀ
            let w = |i: usize, j: usize| dot(rate[i], own[j]);
            let w = [0.5 * (w(2, 1) - w(1, 2)), 0.5 * (w(0, 2) - w(2, 0)), 0.5 * (w(1, 0) - w(0, 1))];
            let local = [0, 1, 2].map(|j| (0..3).map(|i| own[i][j] * w[i]).sum::<f64>());
            let [xx, yy, zz, xy, yz, xz] = [13, 14, 15, 16, 17, 18].map(|i| of(k, i));
            let spin = [
                xx * local[0] + xy * local[1] + xz * local[2],
                xy * local[0] + yy * local[1] + yz * local[2],
                xz * local[0] + yz * local[1] + zz * local[2],
            ];
            let spin = own.map(|row| dot(row, spin));
            let orbital = cross(r, p);
            (p, [0, 1, 2].map(|i| orbital[i] + spin[i]))
        };
        let (mut p, mut l) = ([0.0; 3], [0.0; 3]);
        for k in 0..=N {
            let weight = self.derivative[N / 2 * (N + 1) + k] / half;
            let (linear, angular) = momentum(k);
            p.iter_mut().zip(linear).for_each(|(sum, v)| *sum += weight * v);
            l.iter_mut().zip(angular).for_each(|(sum, v)| *sum += weight * v);
        }
        let far = (0..=N).fold(0.0_f64, |m, k| m.max(length([of(k, 1), of(k, 2), of(k, 3)])));
        let inertia = [13, 14, 15].iter().fold(0.0_f64, |m, i| m.max(of(N / 2, *i).abs()));
        let noise = ROUNDING / (half * half);
        [p, l, [noise * mass * far, noise * (mass * far * far + inertia), 0.0]]
    }

    /// The audit, or none when no reaction is hidden.
    pub fn audit(&self, tolerance: f64) -> Option<Audit> {
        let name = Text::new(
            "momentum and angular momentum of released bodies, from their placements: largest relative residual",
            "количество движения и кинетический момент освобождённых тел по их положениям: наибольшая относительная невязка",
        );
        (self.known && self.taken > 0).then(|| Audit::at_most("released_balance", name, self.found.worst(), (1e3 * tolerance).max(LIMIT)))
    }
}

/// Centre and rotation of a body.
fn placement(node: &[f64], body: usize) -> &Placement {
    node[BODY * body + 1..].first_chunk().unwrap_or(&[0.0; 12])
}

fn abscissa(k: usize) -> f64 {
    // the middle is exact
    if 2 * k == N { 0.0 } else { -(std::f64::consts::PI * k as f64 / N as f64).cos() }
}

/// Differentiation at Chebyshev's points from -1 to 1, row-major; the diagonal is minus the sum of the others.
fn chebyshev() -> Vec<f64> {
    let n = N + 1;
    let end = |k: usize| if k == 0 || k == N { 2.0 } else { 1.0 };
    let mut d = vec![0.0; n * n];
    for i in 0..n {
        for j in (0..n).filter(|j| *j != i) {
            let sign = if (i + j).is_multiple_of(2) { 1.0 } else { -1.0 };
            d[i * n + j] = sign * end(i) / end(j) / (abscissa(i) - abscissa(j));
        }
        d[i * n + i] = -(0..n).map(|j| d[i * n + j]).sum::<f64>();
    }
    d
}

fn dot(a: Vector, b: Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross(a: Vector, b: Vector) -> Vector {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn minus(a: Vector, b: Vector) -> Vector {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

fn length(a: Vector) -> f64 {
    dot(a, a).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_derivative_of_a_cube_is_three_squares() {
        let d = chebyshev();
        for i in 0..=N {
            let sum: f64 = (0..=N).map(|j| d[i * (N + 1) + j] * abscissa(j).powi(3)).sum();
            assert!((sum - 3.0 * abscissa(i).powi(2)).abs() < 1e-11);
        }
    }
}
