//! Placements of bodies along a stretch, differentiated in numbers at Chebyshev's points.
//!
//! *Source*: L. N. Trefethen, Spectral Methods in MATLAB, ch. 6 (differentiation at Chebyshev's points).

use crate::system::Layout;
use algebra::elementary;
use algebra::lanes::combined;
use algebra::space::{Vector, cross, dot, minus, norm};
use std::sync::LazyLock;

/// Points less one; even, so that the middle of the stretch is one of them.
pub(super) const N: usize = 16;
/// What a second derivative in the middle makes of an error of places, over the square of half the stretch.
const MAGNIFIED: f64 = 4.0 * (N * N) as f64;
/// Share of a placement's change that its last coefficients may have.
const TAIL: f64 = 1e-12;
/// How many of the last coefficients must have died out, and how many of the first, but the mean, tell how far a placement moves.
const LAST: usize = 3;
const FIRST: usize = N / 2 - 1;
/// How often the stretch that is looked at is halved.
const HALVINGS: usize = 24;
/// Numbers of a body.
pub(super) const BODY: usize = 19;

/// Numbers of what acts on a body.
pub(super) const WRENCH: usize = 12;

/// What acts on a body by itself.
pub(super) struct Wrench {
    pub force: Vector,
    /// About the origin of the ground.
    pub moment: Vector,
    /// Sums of the components without signs.
    pub sizes: [Vector; 2],
}

impl Wrench {
    /// From the numbers of a state.
    pub(super) fn new(layout: &Layout, here: &[f64], body: usize) -> Wrench {
        let first = here.len() - 2 * layout.along - WRENCH * (layout.wrenches - body);
        let take = |k: usize| [here[first + 3 * k], here[first + 3 * k + 1], here[first + 3 * k + 2]];
        Wrench { force: take(0), moment: take(1), sizes: [take(2), take(3)] }
    }

    /// The terms that meet in its work.
    pub(super) fn size(&self, shift: Vector, turn: Vector) -> f64 {
        let one = |sizes: Vector, way: Vector| (0..3).map(|i| sizes[i] * way[i].abs()).sum::<f64>();
        one(self.sizes[0], shift) + one(self.sizes[1], turn)
    }
}

/// A number at the points of a stretch, or numbers that belong to them.
pub(super) type Column = [f64; N + 1];

/// Rows of placements at the points of a stretch.
pub(super) struct Stretch {
    pub nodes: Vec<Vec<f64>>,
    /// The same by number, those of bodies.
    columns: Vec<Column>,
    /// Half its length.
    pub half: f64,
}

/// Numbers that every stretch has in common.
#[derive(Debug)]
struct Tables {
    abscissae: Column,
    derivative: Vec<f64>,
    /// The same by columns.
    across: Vec<Column>,
    /// cos(π j k/N) by j, of the last k and of the first but 0.
    last: [[f64; LAST]; N + 1],
    first: [[f64; FIRST]; N + 1],
}

static TABLES: LazyLock<Tables> = LazyLock::new(|| {
    let cosines: Vec<f64> = (0..2 * N).map(|i| elementary::cos(std::f64::consts::PI * i as f64 / N as f64)).collect();
    let wave = |j: usize, k: usize| cosines[j * k % (2 * N)];
    let derivative = chebyshev();
    Tables {
        abscissae: std::array::from_fn(abscissa),
        across: (0..=N).map(|j| std::array::from_fn(|k| derivative[k * (N + 1) + j])).collect(),
        derivative,
        last: std::array::from_fn(|j| std::array::from_fn(|k| wave(j, N + 1 - LAST + k))),
        first: std::array::from_fn(|j| std::array::from_fn(|k| wave(j, 1 + k))),
    }
});

/// Differentiation of placements of so many bodies.
#[derive(Clone, Debug)]
pub(super) struct Placements {
    bodies: usize,
    tables: &'static Tables,
}

impl Placements {
    pub(super) fn new(bodies: usize) -> Placements {
        Placements { bodies, tables: &TABLES }
    }

    /// The stretch of at most this half length about 0 on which the placements are resolved; none where they are resolved nowhere. `nodes` gives them at all points.
    pub(super) fn stretch(&self, longest: f64, mut nodes: impl FnMut(&Column) -> Option<Vec<Vec<f64>>>) -> Option<Stretch> {
        let mut half = longest;
        for _ in 0..HALVINGS {
            if let Some(nodes) = nodes(&self.tables.abscissae.map(|u| half * u)) {
                let mut columns: Vec<Column> = vec![[0.0; N + 1]; BODY * self.bodies];
                for (k, node) in nodes.iter().enumerate() {
                    columns.iter_mut().zip(node).for_each(|(column, number)| column[k] = *number);
                }
                if self.is_resolved(&columns) {
                    return Some(Stretch { nodes, columns, half });
                }
            }
            half *= 0.5;
        }
        None
    }

    /// Whether the last coefficients of Chebyshev's series of every placement have died out: a step may hold many turns of a shaft.
    fn is_resolved(&self, columns: &[Column]) -> bool {
        let placements = (0..self.bodies).flat_map(|b| (1..13).map(move |i| BODY * b + i));
        placements.into_iter().all(|i| {
            let column = &columns[i];
            if is_still(column) {
                return true;
            }
            let rounding = 8.0 * f64::EPSILON * largest(column);
            let tail = self.tail(column);
            let size = || largest(&coefficients(&self.tables.first, column));
            tail <= rounding || tail <= TAIL * size()
        })
    }

    /// The largest of the last of Chebyshev's coefficients.
    fn tail(&self, column: &Column) -> f64 {
        if is_still(column) { 0.0 } else { largest(&coefficients(&self.tables.last, column)) }
    }

    /// The derivative of a number at all points.
    fn derivatives(&self, column: &Column, half: f64) -> Column {
        if is_still(column) { [0.0; N + 1] } else { combined(&self.tables.across, column).map(|sum| sum / half) }
    }

    /// How a body moves in the middle: the velocity of its particle at the origin of the ground, and its angular velocity.
    pub(super) fn moves(&self, stretch: &Stretch, body: usize) -> [Vector; 2] {
        let of = |k: usize, i: usize| stretch.columns[BODY * body + i][k];
        let derivative =
            |i: usize| -> f64 { (0..=N).map(|j| self.tables.derivative[N / 2 * (N + 1) + j] * of(j, i)).sum::<f64>() / stretch.half };
        let velocity = [1, 2, 3].map(derivative);
        let own = [0, 1, 2].map(|i| [0, 1, 2].map(|j| of(N / 2, 4 + 3 * i + j)));
        let rate = [0, 1, 2].map(|i| [0, 1, 2].map(|j| derivative(4 + 3 * i + j)));
        let turn = turning(&own, &rate);
        let center = [1, 2, 3].map(|i| of(N / 2, i));
        [minus(velocity, cross(turn, center)), turn]
    }

    /// p' and L' in the middle, and the rounding of both.
    ///
    /// A place is rounded, it moves while the time is rounded, and the last coefficients are what the points do not resolve.
    pub(super) fn rates(&self, Stretch { columns, half, .. }: &Stretch, (t, body): (f64, usize)) -> [Vector; 3] {
        let own = &columns[BODY * body..BODY * (body + 1)];
        let of = |k: usize, i: usize| own[i][k];
        // of the centre and of the rotation
        let slopes: [Column; 12] = std::array::from_fn(|i| self.derivatives(&own[i + 1], *half));
        let derivative = |i: usize, k: usize| slopes[i - 1][k];
        let mass = of(N / 2, 0);
        let momentum = |k: usize| -> (Vector, Vector) {
            let p = [1, 2, 3].map(|i| mass * derivative(i, k));
            let r = [of(k, 1), of(k, 2), of(k, 3)];
            let own = [0, 1, 2].map(|i| [0, 1, 2].map(|j| of(k, 4 + 3 * i + j)));
            let rate = [0, 1, 2].map(|i| [0, 1, 2].map(|j| derivative(4 + 3 * i + j, k)));
            let w = turning(&own, &rate);
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
            let weight = self.tables.derivative[N / 2 * (N + 1) + k] / half;
            let (linear, angular) = momentum(k);
            p.iter_mut().zip(linear).for_each(|(sum, v)| *sum += weight * v);
            l.iter_mut().zip(angular).for_each(|(sum, v)| *sum += weight * v);
        }
        let far = (0..=N).fold(0.0_f64, |m, k| m.max(norm([of(k, 1), of(k, 2), of(k, 3)])));
        let inertia = [13, 14, 15].iter().fold(0.0_f64, |m, i| m.max(of(N / 2, *i).abs()));
        let speed = |from: usize, to: usize| (from..to).fold(0.0_f64, |m, i| m.max(derivative(i, N / 2).abs()));
        let tail = |from: usize, to: usize| (from..to).fold(0.0_f64, |m, i| m.max(self.tail(&own[i])));
        let place = f64::EPSILON * (far + t.abs() * speed(1, 4)) + tail(1, 4);
        let turn = f64::EPSILON * (1.0 + t.abs() * speed(4, 13)) + tail(4, 13);
        let noise = MAGNIFIED / (half * half);
        let heavy = mass.abs();
        [p, l, [noise * heavy * place, noise * (heavy * far * place + inertia * turn), 0.0]]
    }
}

/// Whether a number does not move: most of those of a plane machine.
fn is_still(column: &Column) -> bool {
    column.iter().all(|v| *v == column[0])
}

/// Chebyshev's coefficients of a number along a stretch, of the orders of these waves.
fn coefficients<const K: usize>(waves: &[[f64; K]; N + 1], column: &Column) -> [f64; K] {
    let mut ended = *column;
    (ended[0], ended[N]) = (0.5 * column[0], 0.5 * column[N]);
    combined(waves, &ended).map(|sum| 2.0 / N as f64 * sum)
}

/// The largest without its sign; what is no number does not count.
fn largest(numbers: &[f64]) -> f64 {
    numbers.iter().fold(0.0_f64, |m, v| m.max(v.abs()))
}

/// ω from Ω = R' Rᵀ.
fn turning(own: &[Vector; 3], rate: &[Vector; 3]) -> Vector {
    let w = |i: usize, j: usize| dot(rate[i], own[j]);
    [0.5 * (w(2, 1) - w(1, 2)), 0.5 * (w(0, 2) - w(2, 0)), 0.5 * (w(1, 0) - w(0, 1))]
}

fn abscissa(k: usize) -> f64 {
    // the middle is exact
    if 2 * k == N { 0.0 } else { -elementary::cos(std::f64::consts::PI * k as f64 / N as f64) }
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_derivative_of_a_cube_is_three_squares() {
        let d = chebyshev();
        for i in 0..=N {
            let sum: f64 = (0..=N).map(|j| d[i * (N + 1) + j] * abscissa(j).powi(3)).sum();
            // a difference formula of high degree: its weights, some 1e3, times rounding
            assert!((sum - 3.0 * abscissa(i).powi(2)).abs() < 1e-11);
        }
    }
}
