//! A smooth function of two parameters over a rectangle, where one value costs much: Chebyshev polynomials on patches.
//!
//! ```text
//! f(x, y) ≈ Σ c_ij T_i(ξ) T_j(η),   ξ, η ∈ [-1, 1] on a patch,   c from the values at cos(πk/n), k = 0 ... n
//! ```
//!
//! The trace of a monodromy matrix is an analytic function of the coefficients of its equation (an entire one for Hill's equation y'' + (a + b p(t)) y = 0, for its right side
//! is), so that its coefficients fall faster than any power. A patch is kept where the last ones are below the tolerance and values at places between its nodes agree; otherwise
//! it is halved. What is left when a patch would cost more values than it saves is no part of the surface, and the function itself is asked there.
//!
//! *Source*: L. N. Trefethen, Approximation Theory and Approximation Practice, 2013, ch. 3, 4, 8.

use crate::elementary;
use std::f64::consts::PI;

/// Degree of a patch in each parameter. A tongue and what lies beside it need some twenty; more cost values, fewer cost patches.
const DEGREE: usize = 24;
const NODES: usize = DEGREE + 1;
/// Last coefficients of a parameter that count as what was left out: a function that is even or odd about the middle of a patch has every second one 0.
const LAST: usize = 2;
/// Places of a patch between its nodes, as shares of its sides: values there are laid against the polynomial. The fractions are those of multiples of 0.618 and 0.414, which
/// keep away from one another and from the nodes.
const BETWEEN: [[f64; 2]; 4] = [[0.118, 0.571], [0.472, 0.243], [0.854, 0.828], [0.618, 0.071]];

/// What is asked.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rectangle {
    /// First and last value of the first parameter.
    pub x: [f64; 2],
    /// Of the second one.
    pub y: [f64; 2],
    /// Points of the grid that the surface is for, in each parameter: a patch that holds fewer of them than it has nodes is not worth it.
    pub points: [usize; 2],
    /// Error, as a share of the larger of 1 and of the least |f| of the nodes of a patch.
    pub tolerance: f64,
}

/// K functions over a rectangle.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Surface<const K: usize> {
    patches: Vec<Patch<K>>,
    /// Estimate of the error, in the measure of the tolerance: what the last coefficients and the values between the nodes tell.
    pub error: f64,
    /// Values of the function that it took.
    pub values: usize,
}

#[derive(Clone, Debug, PartialEq)]
struct Patch<const K: usize> {
    x: [f64; 2],
    y: [f64; 2],
    /// c_ij of each function, j within i.
    coefficients: [Vec<f64>; K],
}

/// The side that is halved.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Side {
    X,
    Y,
}

impl<const K: usize> Surface<K> {
    /// The surface of a function; where this has no value, there is no patch.
    pub fn of(asked: &Rectangle, mut f: impl FnMut(f64, f64) -> Option<[f64; K]>) -> Surface<K> {
        let mut surface = Surface { patches: Vec::new(), error: 0.0, values: 0 };
        let nodes: Vec<f64> = (0..NODES).map(|k| elementary::cos(PI * k as f64 / DEGREE as f64)).collect();
        // in the order of the rectangle: the first half of a patch before the second one
        let mut open = vec![(asked.x, asked.y)];
        while let Some((x, y)) = open.pop() {
            if !asked.is_worth(x, y) {
                continue;
            }
            let side = match surface.try_patch(asked, (x, y), (&nodes, &mut f)) {
                Ok(()) => continue,
                Err(side) => side,
            };
            let halves = |[low, high]: [f64; 2]| {
                let middle = 0.5 * (low + high);
                [[middle, high], [low, middle]]
            };
            match side {
                Side::X => open.extend(halves(x).map(|x| (x, y))),
                Side::Y => open.extend(halves(y).map(|y| (x, y))),
            }
        }
        surface
    }

    /// Keeps a patch, or says which side of it is to be halved.
    fn try_patch(
        &mut self,
        asked: &Rectangle,
        (x, y): ([f64; 2], [f64; 2]),
        (nodes, f): (&[f64], &mut impl FnMut(f64, f64) -> Option<[f64; K]>),
    ) -> Result<(), Side> {
        let mut values: [Vec<f64>; K] = std::array::from_fn(|_| Vec::with_capacity(NODES * NODES));
        let longer = if asked.share(x, asked.x) < asked.share(y, asked.y) { Side::Y } else { Side::X };
        for (xi, eta) in nodes.iter().flat_map(|xi| nodes.iter().map(move |eta| (xi, eta))) {
            self.values += 1;
            let found = f(place(x, *xi), place(y, *eta)).filter(|found| found.iter().all(|v| v.is_finite())).ok_or(longer)?;
            values.iter_mut().zip(found).for_each(|(all, v)| all.push(v));
        }
        let least = |all: &[f64]| {
            let (low, high) = all.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), v| (l.min(*v), h.max(*v)));
            if low > 0.0 { low } else { (-high).max(0.0) }
        };
        let allowed: [f64; K] = std::array::from_fn(|k| asked.tolerance * least(&values[k]).max(1.0));
        let patch = Patch { x, y, coefficients: values.map(|all| coefficients(&all, nodes)) };
        let mut error = 0.0_f64;
        for (c, allowed) in patch.coefficients.iter().zip(allowed) {
            let [by_x, by_y] = tails(c);
            if by_x + by_y > allowed {
                return Err(if by_x > 2.0 * by_y {
                    Side::X
                } else if by_y > 2.0 * by_x {
                    Side::Y
                } else {
                    longer
                });
            }
            error = error.max((by_x + by_y) / allowed);
        }
        for [u, v] in BETWEEN {
            let (at_x, at_y) = (x[0] + u * (x[1] - x[0]), y[0] + v * (y[1] - y[0]));
            self.values += 1;
            let found = f(at_x, at_y).ok_or(longer)?;
            for ((own, found), allowed) in patch.at(at_x, at_y).into_iter().zip(found).zip(allowed) {
                let off = (own - found).abs() / allowed;
                // a value that is no number is off too
                if off.is_nan() || off > 1.0 {
                    return Err(longer);
                }
                error = error.max(off);
            }
        }
        self.error = self.error.max(error * asked.tolerance);
        self.patches.push(patch);
        Ok(())
    }

    /// The values at a place; none where no patch is.
    pub fn at(&self, x: f64, y: f64) -> Option<[f64; K]> {
        self.patches.iter().find(|p| p.x[0] <= x && x <= p.x[1] && p.y[0] <= y && y <= p.y[1]).map(|p| p.at(x, y))
    }

    /// The values on a grid of ascending xs and ys, those of each x together; none where no patch is.
    pub fn grid(&self, xs: &[f64], ys: &[f64]) -> Vec<Option<[f64; K]>> {
        let mut all = vec![None; xs.len() * ys.len()];
        let within = |list: &[f64], [low, high]: [f64; 2]| list.partition_point(|v| *v < low)..list.partition_point(|v| *v <= high);
        let (mut sums, mut row) = (Vec::new(), [0.0; NODES]);
        for patch in &self.patches {
            let (of_x, of_y) = (within(xs, patch.x), within(ys, patch.y));
            let width = of_y.len();
            // T_j of all ys, those of each j together
            let mut by_y = vec![0.0; NODES * width];
            for (place, y) in ys[of_y.clone()].iter().enumerate() {
                chebyshev(share(*y, patch.y)).iter().enumerate().for_each(|(j, t)| by_y[j * width + place] = *t);
            }
            for i in of_x {
                let by_x = chebyshev(share(xs[i], patch.x));
                for (k, c) in patch.coefficients.iter().enumerate() {
                    row.fill(0.0);
                    by_x.iter().zip(c.chunks_exact(NODES)).for_each(|(t, c)| row.iter_mut().zip(c).for_each(|(r, c)| *r += t * c));
                    sums.clear();
                    sums.resize(width, 0.0);
                    // the smallest first
                    for (r, t) in row.iter().zip(by_y.chunks_exact(width.max(1))).rev() {
                        sums.iter_mut().zip(t).for_each(|(sum, t)| *sum += r * t);
                    }
                    for (place, sum) in of_y.clone().zip(&sums) {
                        all[i * ys.len() + place].get_or_insert([0.0; K])[k] = *sum;
                    }
                }
            }
        }
        all
    }

    /// How many patches there are.
    pub fn patches(&self) -> usize {
        self.patches.len()
    }
}

impl<const K: usize> Patch<K> {
    fn at(&self, x: f64, y: f64) -> [f64; K] {
        let (by_x, by_y) = (chebyshev(share(x, self.x)), chebyshev(share(y, self.y)));
        std::array::from_fn(|k| {
            // all y-coefficients at once: sums that do not wait for one another
            let mut row = [0.0; NODES];
            for (t, c) in by_x.iter().zip(self.coefficients[k].chunks_exact(NODES)) {
                row.iter_mut().zip(c).for_each(|(r, c)| *r += t * c);
            }
            // the smallest first
            row.iter().zip(&by_y).rev().map(|(r, t)| r * t).sum()
        })
    }
}

impl Rectangle {
    fn share(&self, part: [f64; 2], whole: [f64; 2]) -> f64 {
        if whole[1] > whole[0] { (part[1] - part[0]) / (whole[1] - whole[0]) } else { 0.0 }
    }

    /// Whether a patch holds more points of the grid than it has nodes.
    fn is_worth(&self, x: [f64; 2], y: [f64; 2]) -> bool {
        let held = |part, whole, count: usize| self.share(part, whole) * count as f64;
        held(x, self.x, self.points[0]) * held(y, self.y, self.points[1]) > (NODES * NODES) as f64
    }
}

/// A place of a side from ξ; the ends exactly.
pub(crate) fn place([low, high]: [f64; 2], xi: f64) -> f64 {
    0.5 * ((1.0 - xi) * low + (1.0 + xi) * high)
}

/// ξ from a place.
pub(crate) fn share(x: f64, [low, high]: [f64; 2]) -> f64 {
    (((x - low) - (high - x)) / (high - low)).clamp(-1.0, 1.0)
}

/// T_0 ... T_n.
fn chebyshev(xi: f64) -> [f64; NODES] {
    let mut all = [1.0; NODES];
    all[1] = xi;
    for k in 2..NODES {
        all[k] = 2.0 * xi * all[k - 1] - all[k - 2];
    }
    all
}

/// Coefficients of values at the nodes, in x and then in y: c_j = (2/n) Σ'' f_k cos(πjk/n), the first and the last terms halved, c_0 and c_n too.
fn coefficients(values: &[f64], nodes: &[f64]) -> Vec<f64> {
    let halved = |k: usize| if k == 0 || k == DEGREE { 0.5 } else { 1.0 };
    // cos(πjk/n) by the nodes themselves
    let cosine = |j: usize, k: usize| {
        let turn = j * k % (2 * DEGREE);
        nodes[turn.min(2 * DEGREE - turn)]
    };
    let matrix: Vec<f64> = (0..NODES * NODES)
        .map(|e| (e / NODES, e % NODES))
        .map(|(j, k)| 2.0 / DEGREE as f64 * halved(j) * halved(k) * cosine(j, k))
        .collect();
    let sum = |row: &[f64], of: &dyn Fn(usize) -> f64| row.iter().enumerate().map(|(k, m)| m * of(k)).sum::<f64>();
    let mut by_x = vec![0.0; NODES * NODES];
    for (i, row) in matrix.chunks_exact(NODES).enumerate() {
        (0..NODES).for_each(|l| by_x[i * NODES + l] = sum(row, &|k| values[k * NODES + l]));
    }
    let mut both = vec![0.0; NODES * NODES];
    for (j, row) in matrix.chunks_exact(NODES).enumerate() {
        (0..NODES).for_each(|i| both[i * NODES + j] = sum(row, &|k| by_x[i * NODES + k]));
    }
    both
}

/// Sums of the last coefficients in x and in y.
fn tails(c: &[f64]) -> [f64; 2] {
    let late = |k: usize| k + LAST > DEGREE;
    c.iter().enumerate().fold([0.0, 0.0], |[by_x, by_y], (e, c)| match [late(e / NODES), late(e % NODES)] {
        [true, _] => [by_x + c.abs(), by_y],
        [false, true] => [by_x, by_y + c.abs()],
        [false, false] => [by_x, by_y],
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What is asked of the surfaces here.
    const TOLERANCE: f64 = 1e-11;

    fn asked(x: [f64; 2], y: [f64; 2]) -> Rectangle {
        Rectangle { x, y, points: [500, 500], tolerance: TOLERANCE }
    }

    fn line([low, high]: [f64; 2], count: usize) -> Vec<f64> {
        (0..count).map(|k| low + (high - low) * k as f64 / (count - 1) as f64).collect()
    }

    /// Polynomials up to the degree of a patch come out to rounding, by one patch.
    #[test]
    fn polynomials_are_themselves() {
        let f = |x: f64, y: f64| Some([x * x * x - 2.0 * x * y + 1.0, elementary::powi(0.1 * y, 9)]);
        let surface = Surface::of(&asked([-1.0, 3.0], [2.0, 7.0]), f);
        assert_eq!((surface.patches(), surface.values), (1, NODES * NODES + BETWEEN.len()));
        for (x, y) in [(-1.0, 2.0), (3.0, 7.0), (0.3, 4.4)] {
            let (own, found) = (f(x, y).unwrap(), surface.at(x, y).unwrap());
            // some ten roundings of values about 50
            assert!((own[0] - found[0]).abs() < 1e-13 * 50.0 && (own[1] - found[1]).abs() < 1e-13, "{x} {y}");
        }
        assert_eq!(surface.at(3.1, 4.0), None);
    }

    /// The error that is told holds: against a function of both parameters that oscillates and grows by 10⁵, on a grid of its own.
    #[test]
    fn the_estimate_is_no_less_than_the_error() {
        let f = |x: f64, y: f64| Some([elementary::exp(0.9 * y) * elementary::cos(3.0 * x + x * y)]);
        let (x, y) = ([-4.0, 4.0], [-6.0, 6.0]);
        let surface = Surface::of(&asked(x, y), f);
        let (xs, ys) = (line(x, 83), line(y, 67));
        let found = surface.grid(&xs, &ys);
        let mut worst = 0.0_f64;
        for (k, value) in found.iter().enumerate() {
            let (own, [value]) = (f(xs[k / ys.len()], ys[k % ys.len()]).unwrap()[0], value.unwrap());
            worst = worst.max((own - value).abs() / own.abs().max(1.0));
        }
        assert!(surface.error <= TOLERANCE && worst <= TOLERANCE, "{worst:e}, said {:e}", surface.error);
    }

    /// A grid has the values of its places, bit for bit as often as it is asked, and a kink is left to the function itself.
    #[test]
    fn a_kink_is_no_part_of_a_surface() {
        let f = |x: f64, y: f64| Some([(x - 0.371).abs() + y]);
        let surface = Surface::of(&asked([0.0, 1.0], [0.0, 1.0]), f);
        let (xs, ys) = (line([0.0, 1.0], 500), line([0.0, 1.0], 500));
        let found = surface.grid(&xs, &ys);
        assert!(surface.at(0.371, 0.5).is_none() && surface.at(0.9, 0.5).is_some());
        for (k, value) in found.iter().enumerate().filter_map(|(k, v)| v.map(|v| (k, v[0]))) {
            assert!((value - f(xs[k / 500], ys[k % 500]).unwrap()[0]).abs() <= TOLERANCE);
        }
        let left = found.iter().filter(|v| v.is_none()).count();
        assert!(left > 0 && left < found.len() / 4, "{left} of {}", found.len());
        assert_eq!(found, surface.grid(&xs, &ys));
    }

    #[test]
    fn places_without_a_value_have_no_patch() {
        let f = |x: f64, y: f64| (x < 0.5).then_some([x * y]);
        let surface = Surface::of(&asked([0.0, 1.0], [0.0, 1.0]), f);
        assert!(surface.at(0.25, 0.3).is_some() && surface.at(0.75, 0.3).is_none());
    }
}
