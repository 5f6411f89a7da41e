//! Whether samples at Chebyshev's points show what the operations behind a quantity do between them.
//!
//! Each operation c = f(a, b) was recorded at the points. Its operands and its result are replaced by polynomials like the quantity itself. Where the linear
//! term of f prevails over the range of the operands it is seen. Otherwise it must meet both
//!
//! ```text
//! the polynomial of c has converged                                     its last coefficients are small (not asked of products)
//! |f - c_0| over the range of the operands <= 16 (range of c)           it moves as far as the function can: nothing is hidden
//! ```
//!
//! or, where the second does not decide, the range of f over the Bernstein hulls of its operands leaves that of c by no more than half of its own
//! width (three quarters with two operands). These are the conditions that a step of the integrator has to meet (docs/theory/steps.md). A choice must
//! be the same all along. Sines and cosines move wherever their argument does, and a solution of a system where its entries do. A branch that is not
//! taken has no numbers and counts as seen.

use algebra::elementary;
use program::curve::{Curve, Range};
use program::faithful::{NEAR, NOTHING, RATIO};
use program::{Behind, Node, Seen};

use super::points::{Points, spread};

/// A polynomial between Chebyshev's points stays within this multiple of the range of its values there, n <= 16 (Lebesgue's constant).
const BETWEEN: f64 = 2.5;

/// The operations at the points of one piece.
pub(crate) struct Look<'p> {
    points: &'p Points,
    rows: &'p [Vec<f64>],
    behind: &'p Behind,
    /// Where the record begins in a row.
    first: usize,
    error: f64,
    known: Vec<Option<bool>>,
}

impl<'p> Look<'p> {
    pub(crate) fn new(points: &'p Points, rows: &'p [Vec<f64>], behind: &'p Behind, first: usize, error: f64) -> Look<'p> {
        Look { points, rows, behind, first, error, known: vec![None; behind.nodes.len()] }
    }

    /// Whether an operation is seen; `noise` is the rounding of a place of the row.
    pub(crate) fn sees(&mut self, node: usize, noise: &dyn Fn(usize) -> f64) -> bool {
        if let Some(known) = self.known[node] {
            return known;
        }
        let found = self.judge(self.behind.nodes[node], noise);
        self.known[node] = Some(found);
        found
    }

    fn column(&self, place: usize) -> Vec<f64> {
        self.rows.iter().map(|row| row[self.first + place]).collect()
    }

    fn judge(&self, node: Node, noise: &dyn Fn(usize) -> f64) -> bool {
        let c = self.column(node.c);
        if !c.iter().all(|v| v.is_finite()) {
            return true;
        }
        let allowed = noise(self.first + node.c);
        let converged = || self.points.tail(&c) <= (self.error * spread(&c)).max(allowed);
        let a = self.column(node.a);
        match node.seen {
            Seen::Choice => self.is_held(&a, noise(self.first + node.a)) && converged(),
            Seen::Range(curve) => {
                let b = self.column(node.b);
                let is_known = |f: &[f64], place: usize| self.points.tail(f) <= (self.error * spread(f)).max(noise(self.first + place));
                let known = || is_known(&a, node.a) && (!curve.has_two() || is_known(&b, node.b));
                self.is_steady(curve, &a, &b)
                    || (is_product(curve) || converged()) && self.is_in_range(curve, [&a, &b, &c], (allowed, &known))
            }
        }
    }

    /// Whether what decides a choice keeps its sign.
    fn is_held(&self, a: &[f64], noise: f64) -> bool {
        if a.iter().all(|v| *v == program::HELD || v.abs() <= noise) {
            return true;
        }
        if !a.iter().all(|v| v.is_finite()) {
            return false;
        }
        let around = inflated(a);
        let clear = |r: Range| r.low > 0.0 || r.high < 0.0;
        clear(around) || {
            let hull = self.hull(a);
            hull.low >= -noise || hull.high <= noise
        }
    }

    /// Whether the operands stand, or the linear term prevails.
    fn is_steady(&self, curve: Curve, a: &[f64], b: &[f64]) -> bool {
        is_calm(curve, inflated(a), inflated(b)) || spread(a) == 0.0 && (!curve.has_two() || spread(b) == 0.0)
    }

    /// `known` tells whether the polynomials of the operands are the operands: a sine over several turns is not where seventeen of its values lead.
    fn is_in_range(&self, curve: Curve, [a, b, c]: [&[f64]; 3], (allowed, known): (f64, &dyn Fn() -> bool)) -> bool {
        if !a.iter().chain(b).all(|v| v.is_finite()) {
            return false;
        }
        let (around_a, around_b) = (inflated(a), inflated(b));
        let moved = spread(c);
        let reach = match curve {
            Curve::Product => Some(0.25 * around_a.width() * around_b.width()),
            Curve::Square => Some(0.25 * around_a.width() * around_a.width()),
            _ => curve.range(around_a, around_b).map(|f| (f.high - c[0]).max(c[0] - f.low)),
        };
        let enough = |reach: f64| reach <= RATIO * moved || reach <= allowed || reach <= NOTHING;
        reach.is_some_and(enough) || known() && self.is_within(curve, [a, b, c], allowed)
    }

    /// The range of f over the hulls of its operands against the hull of its polynomial.
    fn is_within(&self, curve: Curve, [a, b, c]: [&[f64]; 3], allowed: f64) -> bool {
        let Some(mut f) = curve.range(self.hull(a), self.hull(b)) else { return false };
        let c = self.hull(c);
        if curve == Curve::Angle {
            let turn = 2.0 * std::f64::consts::PI;
            let turns = ((c.low + c.high - f.low - f.high) / (2.0 * turn)).round() * turn;
            f = Range { low: f.low + turns, high: f.high + turns };
        }
        let off = (f.high - c.high).max(c.low - f.low);
        let share = if curve.has_two() { 0.75 } else { 0.5 };
        off <= allowed.max(self.error * c.size()) || off <= share * f.width() && f.width().is_finite()
    }

    fn hull(&self, f: &[f64]) -> Range {
        let row = self.points.row(f);
        row.iter().fold(Range { low: f64::INFINITY, high: f64::NEG_INFINITY }, |r, v| Range { low: r.low.min(*v), high: r.high.max(*v) })
    }
}

/// Products show what their factors do.
fn is_product(curve: Curve) -> bool {
    matches!(curve, Curve::Product | Curve::Square)
}

/// Holds the polynomial through the values.
fn inflated(f: &[f64]) -> Range {
    let (low, high) = f.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), v| (l.min(*v), h.max(*v)));
    let (middle, half) = (0.5 * (low + high), 0.5 * BETWEEN * (high - low));
    Range { low: middle - half, high: middle + half }
}

/// Whether the linear term prevails over these ranges, so that the polynomial cannot stand still where the function moves.
fn is_calm(curve: Curve, a: Range, b: Range) -> bool {
    let middle = |r: Range| 0.5 * (r.low + r.high);
    let near = |r: Range| 0.5 * r.width() <= NEAR * middle(r).abs();
    match curve {
        Curve::Quotient => near(b),
        Curve::Root | Curve::Power(_) | Curve::Log => near(a),
        Curve::Exp | Curve::Tanh | Curve::Sinh | Curve::Cosh => a.width() <= 2.0,
        Curve::Asin | Curve::Acos => a.size() <= 0.9,
        Curve::Atan | Curve::Asinh => 0.5 * a.width() <= NEAR * (1.0 + middle(a).abs()),
        Curve::Acosh => 0.5 * a.width() <= NEAR * (middle(a) - 1.0),
        Curve::Atanh => 0.5 * a.width() <= NEAR * (1.0 - middle(a).abs()),
        Curve::Angle => 0.5 * (a.width() + b.width()) <= NEAR * elementary::hypot(middle(a), middle(b)),
        Curve::Product | Curve::Square => false,
    }
}
