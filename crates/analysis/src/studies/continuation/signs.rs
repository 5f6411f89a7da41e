//! Test functions: what changes its sign where something happens on a branch.
//!
//! ```text
//! fold                 dp/ds
//! branch point         det | J  |      t tangent: the rank of J falls
//!                          | t' |     (rounding all along a branch with a neutral direction, and no test there)
//! period doubling      Π (μ_i + 1)
//! torus                Π_(i<j) (1 - μ_i μ_j)          of a pair that leaves the unit circle, not of two real multipliers
//! Hopf point           Π_(i<j) (-λ_i - λ_j)           the same of roots
//! extreme of energy    Π (1 - μ_i)                    of free motions without losses, where it is no branch point: the sign of both is that of dE/ds times it
//! cusp                 κ: dp/ds = -κ w R_q, dq/ds = κ w R_p     on a curve of folds in the plane of p and q, w A = 0: w R_u v v but for its size
//! ```
//!
//! A contact that sticks or closes just where the period begins takes directions away, and their multipliers 0 with them. Each factor is positive for what is stable, so
//! that the number of factors has no part in the sign of a product; determinants are counted with the sign of -J for the same reason.
//!
//! *Source*: Yu. A. Kuznetsov, Elements of Applied Bifurcation Theory, 10.

use super::neutral::Even;
use super::zeros::{Place, Signs, Sort};
use crate::studies::periodic::Multiplier;
use algebra::complex::{self, Complex};
use algebra::elementary;
use algebra::lu::Lu;

/// The test functions at a point.
pub(super) fn at(place: &Place, sort: Sort) -> Signs {
    let k = place.local.basis.len();
    let matrix = place.bordered();
    let last = place.y.len() - 1;
    let m = k - 1;
    let square: Vec<f64> = (0..m * m).map(|e| place.local.jacobian[e / m * k + e % m]).collect();
    let sign = if m.is_multiple_of(2) { 1.0 } else { -1.0 };
    let numbers = place.local.facts.multipliers.as_deref();
    // without losses each multiplier has its reciprocal, and products of pairs are rounding; the number outside tells what leaves the circle
    let free = place.local.facts.energy.is_some();
    let pair = numbers.filter(|_| !free).and_then(|numbers| pair(numbers, sort));
    Signs {
        fold: place.tangent[last] / place.local.scales[last],
        branch: Lu::exact(&matrix, k).map_or(0.0, |lu| sign * lu.determinant()),
        neutral: Even::new(&matrix, &place.local, sort).count(),
        square: Lu::exact(&square, m).map_or(0.0, |lu| sign * lu.determinant()),
        doubling: numbers.filter(|_| sort == Sort::Multipliers).map(|numbers| product(numbers, 1.0)),
        pair: pair.map(|pair| pair.0),
        paired: pair.is_some_and(|pair| pair.1 == Bond::Known),
        outside: numbers.map(|numbers| outside(numbers, sort)),
        ones: numbers.filter(|_| free).map(|numbers| product(numbers, -1.0)),
        cusp: place.local.facts.across.map(|across| along_both(place, across)),
    }
}

/// Those that are not 1 (or 0) by themselves.
fn own(numbers: &[Multiplier]) -> Vec<Complex> {
    numbers.iter().filter(|m| !m.trivial).map(|m| Complex { re: m.re, im: m.im }).collect()
}

/// Π (1 + by μ).
fn product(multipliers: &[Multiplier], by: f64) -> f64 {
    let one = Complex { re: 1.0, im: 0.0 };
    own(multipliers).into_iter().map(|m| one + m.scale(by)).fold(one, |a, b| a * b).re
}

/// κ of both parameters, the last unknowns.
fn along_both(place: &Place, [p, q]: [f64; 2]) -> f64 {
    let moves = |back: usize| place.tangent.len().checked_sub(back).map_or(0.0, |i| place.tangent[i] / place.local.scales[i]);
    (p * moves(1) - q * moves(2)) / elementary::hypot(p, q)
}

/// Whether the product (the sum) of some pair is 1 (0) as far as its errors tell: the pair stays on the circle (the axis), as in a machine without damping.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Bond {
    Known,
    None,
}

/// The product over all pairs; none of a single multiplier.
fn pair(numbers: &[Multiplier], sort: Sort) -> Option<(f64, Bond)> {
    let list: Vec<(Complex, f64)> = numbers.iter().filter(|m| !m.trivial).map(|m| (Complex { re: m.re, im: m.im }, m.error)).collect();
    let (mut product, mut known) = (Complex { re: 1.0, im: 0.0 }, Bond::None);
    for (i, a) in list.iter().enumerate() {
        for b in &list[i + 1..] {
            let (value, error) = bond(*a, *b, sort);
            if complex::abs(value) <= error {
                known = Bond::Known;
            }
            product *= -value;
        }
    }
    (list.len() > 1).then_some((product.re, known))
}

/// Number outside of the circle, or right of the axis, each beyond its own error: a wider band would be left where nothing happens.
pub(super) fn outside(numbers: &[Multiplier], sort: Sort) -> usize {
    numbers.iter().filter(|m| !m.trivial && off(m, sort) > m.error).count()
}

/// How far outside of the circle, or right of the axis.
pub(super) fn off(m: &Multiplier, sort: Sort) -> f64 {
    match sort {
        Sort::Multipliers => m.abs() - 1.0,
        Sort::Roots => m.re,
    }
}

/// How far the pair that is next to leave is outside, and its error; none without a pair.
pub(super) fn leaving(numbers: &[Multiplier], sort: Sort) -> Option<[f64; 2]> {
    let pairs = numbers.iter().filter(|m| !m.trivial && m.im != 0.0);
    let next = pairs.min_by(|a, b| off(a, sort).abs().total_cmp(&off(b, sort).abs()))?;
    Some([off(next, sort), next.error])
}

/// Whether the pair whose product is nearest to 1 (whose sum is nearest to 0) is one of conjugates: two real numbers do the same where nothing happens (a neutral saddle).
pub(super) fn leaves_as_pair(numbers: &[Multiplier], sort: Sort) -> bool {
    let list = own(numbers);
    let mut nearest = (f64::INFINITY, false);
    for (i, a) in list.iter().enumerate() {
        for b in &list[i + 1..] {
            let (value, _) = bond((*a, 0.0), (*b, 0.0), sort);
            if complex::abs(value) < nearest.0 {
                nearest = (complex::abs(value), a.im != 0.0 && b.im != 0.0);
            }
        }
    }
    nearest.1
}

/// By how much the product of two multipliers is off 1, or the sum of two roots off 0 as a share of their sizes; with its error.
fn bond((a, error_a): (Complex, f64), (b, error_b): (Complex, f64), sort: Sort) -> (Complex, f64) {
    let (size_a, size_b) = (complex::abs(a), complex::abs(b));
    match sort {
        Sort::Multipliers => (a * b - Complex { re: 1.0, im: 0.0 }, size_a * error_b + size_b * error_a),
        Sort::Roots => {
            let share = if size_a + size_b > 0.0 { 1.0 / (size_a + size_b) } else { 1.0 };
            ((a + b).scale(share), (error_a + error_b) * share)
        }
    }
}

/// Whether the product of two multipliers is 1 as far as their errors tell.
pub(super) fn are_reciprocal(a: &Multiplier, b: &Multiplier) -> bool {
    let [a, b] = [a, b].map(|m| (Complex { re: m.re, im: m.im }, m.error));
    let (off, error) = bond(a, b, Sort::Multipliers);
    complex::abs(off) <= error
}

/// How far the nearest multiplier is from where it would mean something: from 1 and from -1.
pub(super) fn distance(numbers: &[Multiplier], sort: Sort) -> f64 {
    let near = |m: &Complex| match sort {
        Sort::Multipliers => complex::abs(m - Complex { re: 1.0, im: 0.0 }).min(complex::abs(m + Complex { re: 1.0, im: 0.0 })),
        Sort::Roots => f64::INFINITY,
    };
    own(numbers).iter().map(near).fold(f64::INFINITY, f64::min)
}

/// Largest change of a multiplier from one point to another.
pub(super) fn moved(a: &[Multiplier], b: &[Multiplier]) -> f64 {
    let (a, b) = (own(a), own(b));
    // far outside it counts as a share: nothing is decided there
    let share = |x: &Complex| complex::abs(*x).max(1.0);
    let nearest = |x: &Complex| b.iter().map(|y| complex::abs(x - y)).fold(f64::INFINITY, f64::min) / share(x);
    let most = a.iter().map(nearest).fold(0.0, f64::max);
    if most.is_finite() { most } else { 0.0 }
}
