//! Test functions: what changes its sign where something happens on a branch.
//!
//! ```text
//! fold                 dp/ds
//! branch point         det | J  |      t tangent: the rank of J falls
//!                          | t' |
//! period doubling      Π (μ_i + 1)
//! torus                Π_(i<j) (μ_i μ_j - 1)          of a pair that leaves the unit circle, not of two real multipliers
//! Hopf point           Π_(i<j) (λ_i + λ_j)            the same of roots
//! ```
//!
//! *Source*: Yu. A. Kuznetsov, Elements of Applied Bifurcation Theory, 10.

use super::zeros::{Place, Signs, Sort};
use crate::studies::periodic::Multiplier;
use algebra::complex::{self, Complex};
use algebra::lu::Lu;

/// Products of two multipliers (sums of two roots) that are this near to 1 (to 0) at both ends belong to a pair that stays there: a machine without damping.
const PAIRED: f64 = 1e-7;
/// Roots this near to the imaginary axis, as a share of the largest, decide nothing.
pub(super) const NEUTRAL: f64 = 1e-9;

/// The test functions at a point.
pub(super) fn at(place: &Place, sort: Sort) -> Signs {
    let k = place.local.basis.len();
    let column = |c: &Vec<f64>| place.tangent.iter().zip(c).zip(&place.local.scales).map(|((t, c), s)| t / s * c).sum::<f64>();
    let mut matrix = place.local.jacobian.clone();
    matrix.extend(place.local.basis.iter().map(column));
    let last = place.y.len() - 1;
    let m = k - 1;
    let square: Vec<f64> = (0..m * m).map(|e| place.local.jacobian[e / m * k + e % m]).collect();
    let numbers = place.local.facts.multipliers.as_deref();
    let pair = numbers.and_then(|numbers| pair(&own(numbers), sort));
    Signs {
        fold: place.tangent[last] / place.local.scales[last],
        branch: Lu::exact(&matrix, k).map_or(0.0, |lu| lu.determinant()),
        square: Lu::exact(&square, m).map_or(0.0, |lu| lu.determinant()),
        doubling: numbers.filter(|_| sort == Sort::Multipliers).map(doubling),
        pair: pair.map(|pair| pair.0),
        paired: pair.is_some_and(|pair| pair.1 <= PAIRED),
        outside: numbers.map(|numbers| outside(numbers, sort)),
    }
}

/// Those that are not 1 (or 0) by themselves.
fn own(numbers: &[Multiplier]) -> Vec<Complex> {
    numbers.iter().filter(|m| !m.trivial).map(|m| Complex { re: m.re, im: m.im }).collect()
}

fn doubling(multipliers: &[Multiplier]) -> f64 {
    own(multipliers).into_iter().map(|m| m + Complex { re: 1.0, im: 0.0 }).fold(Complex { re: 1.0, im: 0.0 }, |a, b| a * b).re
}

/// The product over all pairs, and the least of its factors by size; none of a single multiplier.
fn pair(numbers: &[Complex], sort: Sort) -> Option<(f64, f64)> {
    let (mut product, mut least) = (Complex { re: 1.0, im: 0.0 }, f64::INFINITY);
    for (i, a) in numbers.iter().enumerate() {
        for b in &numbers[i + 1..] {
            let value = match sort {
                Sort::Multipliers => a * b - Complex { re: 1.0, im: 0.0 },
                Sort::Roots => {
                    let size = complex::abs(*a) + complex::abs(*b);
                    (a + b).scale(if size > 0.0 { 1.0 / size } else { 1.0 })
                }
            };
            least = least.min(complex::abs(value));
            product *= value;
        }
    }
    (numbers.len() > 1).then_some((product.re, least))
}

/// Number outside of the circle, or right of the axis.
pub(super) fn outside(numbers: &[Multiplier], sort: Sort) -> usize {
    match sort {
        Sort::Multipliers => crate::studies::periodic::outside(numbers),
        Sort::Roots => {
            let largest = numbers.iter().map(Multiplier::abs).fold(0.0, f64::max);
            numbers.iter().filter(|m| m.re > m.error.max(NEUTRAL * largest)).count()
        }
    }
}

/// Whether a pair with an imaginary part is the one that is on the circle (the axis) next.
pub(super) fn leaves_as_pair(numbers: &[Multiplier], sort: Sort) -> bool {
    let off = |m: &Multiplier| match sort {
        Sort::Multipliers => (m.abs() - 1.0).abs(),
        Sort::Roots => m.re.abs() / m.abs().max(f64::MIN_POSITIVE),
    };
    let own = numbers.iter().filter(|m| !m.trivial);
    own.min_by(|a, b| off(a).total_cmp(&off(b))).is_some_and(|m| m.im != 0.0)
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
    let nearest = |x: &Complex| b.iter().map(|y| complex::abs(x - y)).fold(f64::INFINITY, f64::min);
    let most = a.iter().map(nearest).fold(0.0, f64::max);
    if most.is_finite() { most } else { 0.0 }
}
