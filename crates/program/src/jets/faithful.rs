//! How far the polynomials of a step can be believed.
//!
//! A function that is flat to all orders where a step begins (a saturated tanh, a far Gaussian, sin(t)^30) has Taylor coefficients that vanish or
//! underflow, and no rule made of coefficients sees what it does later in the step. So each nonlinear operation c = f(a) is held against its own
//! polynomial over the whole step [0, h]:
//!
//! ```text
//! |a(tau) - a_0| <= way(a) = sum_{k>=1} |a_k| h^k            0 <= tau <= h
//! |f - f(a_0)| over that range  <=  16 way(c)                 the polynomial moves as far as the function can: nothing is hidden
//! ```
//!
//! For most operations of a step not even that has to be computed. The sums way(.) are a norm with way(u v) <= way(u) way(v) for series without
//! constant term; so where way(a) is below a fixed share of the distance over which f changes its character, the linear term
//! of f prevails in c and the condition holds. What is left is divided: on each part of the step the arguments and c are bounded by their Bernstein
//! coefficients (a polynomial lies within the hull of these), f by its range over the arguments. A part is good when the range of f leaves that of c
//! by no more than half its own width (three quarters for two arguments, see [`share_beside`]) or by tol W, W the largest value of f met on the step. Parts are halved while that does not decide; the step
//! ends where the first part begins that is not good. All this is said of the polynomials of the arguments: where they have to be looked at, their own last
//! terms must be small too, or they are not the arguments (a sine over several turns).
//!
//! *Source*: the range of a polynomial from its Bernstein coefficients, as in J. M. Lane, R. F. Riesenfeld, Bounds on a polynomial, BIT 21 (1981)
//! 112-117; the norm is that of K. Makino, M. Berz, Taylor models and other validated functional inclusion methods, IJPAM 4 (2003) 379-456.
//!
//! **Powers at zero.** √a and a^p have no series at a = 0, but a motion passes it: the force is integrable. There the operation is kept constant over a
//! step so short that what it misses is nothing, sup |f - c_0| <= 10 tol W and sup |f - c_0| h' <= tol² W h; the steps after it grow with the distance
//! from the singular point.

use super::steps::{Row, Rows};
use crate::curve::{Curve, Range};
use algebra::bernstein::{halve_row, to_bernstein};
use algebra::elementary;

/// An operation to be watched: c = f(a, b).
#[derive(Clone, Copy, Debug)]
pub(crate) struct Watched {
    pub(crate) curve: Curve,
    pub(crate) a: Row,
    pub(crate) b: Row,
    pub(crate) c: Row,
}

impl Watched {
    /// Whether the result is never negative.
    fn is_positive(&self) -> bool {
        match self.curve {
            Curve::Root => true,
            Curve::Power(p) => p > 0.0 && p.fract() != 0.0,
            _ => false,
        }
    }

    pub(super) fn is_power(&self) -> bool {
        matches!(self.curve, Curve::Root | Curve::Power(_))
    }
}

/// How much further than its polynomial a function may range without being looked at closely.
pub const RATIO: f64 = 16.0;
/// Share of the distance to a singular point within which roots, powers, logarithms and quotients show their linear term.
pub const NEAR: f64 = 0.4;
/// What is below this counts as zero.
pub const NOTHING: f64 = 1e-100;
/// Deepest halving of a step in one look; a feature still narrower is found by the next one.
const DEPTH: u32 = 20;
/// The same of a root or power that passes zero: behind it the step goes on with the wrong sign for this share of it, which moves the motion by its square.
const DEEP: u32 = 26;
/// Parts looked at to find the largest value of a function.
const PARTS: usize = 64;
/// Looks at one operation.
const LOOKS: usize = 12;
/// A series of fewer coefficients says nothing of its convergence.
const LEAST_COUNT: usize = 6;

/// Workspace of the check.
#[derive(Clone, Debug, Default)]
pub(crate) struct Watch {
    pub(super) nodes: Vec<Watched>,
    /// h^k.
    powers: Vec<f64>,
    /// way(row) and the look it belongs to.
    ways: Vec<(u32, f64)>,
    look: u32,
    /// Operations that had to be looked at closely.
    pub(super) looks: u64,
    /// Whether a root or power at zero was kept constant in the last check.
    pub(crate) held: bool,
}

impl Watch {
    pub(crate) fn new(nodes: Vec<Watched>, rows: usize) -> Watch {
        Watch { nodes, ways: vec![(0, 0.0); rows], ..Watch::default() }
    }

    /// The longest step, at most `h`, on which every operation is good; a power at zero asks for no less than `least`.
    pub(crate) fn faithful(&mut self, rows: Rows<'_>, mut h: f64, tolerance: f64, least: f64) -> f64 {
        if rows.count < 2 || h.is_nan() || h <= 0.0 {
            return h;
        }
        self.held = false;
        self.measure(rows.count, h);
        for i in 0..self.nodes.len() {
            let node = self.nodes[i];
            let shorter = if self.calm(rows, node, tolerance) {
                if !self.may_turn(rows, node) {
                    continue;
                }
                self.looks += 1;
                looked((rows, node), h, tolerance, &keeps_its_sign)
            } else {
                self.looks += 1;
                if is_singular(rows, node) {
                    self.held = true;
                    self.over_singular(rows, node, h, tolerance).max(least).min(h)
                } else {
                    looked((rows, node), h, tolerance, &is_good)
                }
            };
            if shorter < h {
                h = shorter;
                self.measure(rows.count, h);
            }
        }
        h
    }

    /// Whether the polynomial of a root may pass zero: of a square both roots are polynomials, and the one that passes zero is not the root behind it.
    fn may_turn(&mut self, rows: Rows<'_>, node: Watched) -> bool {
        node.is_positive() && self.way(rows, node.c) > rows.row(node.c)[0]
    }

    fn measure(&mut self, count: usize, h: f64) {
        self.look = self.look.wrapping_add(1);
        self.powers.clear();
        let mut power = 1.0;
        for _ in 0..count {
            self.powers.push(power);
            power *= h;
        }
    }

    /// sum_{k>=1} |c_k| h^k.
    fn way(&mut self, rows: Rows<'_>, row: Row) -> f64 {
        let known = self.ways[row as usize];
        if known.0 == self.look {
            return known.1;
        }
        let way = way(&rows.row(row)[1..], &self.powers[1..]);
        self.ways[row as usize] = (self.look, way);
        way
    }

    /// Whether the operation surely hides nothing on the step.
    fn calm(&mut self, rows: Rows<'_>, node: Watched, tolerance: f64) -> bool {
        let Watched { curve, a, b, c } = node;
        let (row, way_a) = (rows.row(a), self.way(rows, a));
        if way_a == 0.0 && !curve.has_two() {
            return true;
        }
        match curve {
            Curve::Product => {
                let way_b = self.way(rows, b);
                self.is_product_seen(rows, c, way_a * way_b, tolerance)
            }
            Curve::Square => self.is_product_seen(rows, c, way_a * way_a, tolerance),
            Curve::Quotient => self.way(rows, b) <= NEAR * rows.row(b)[0].abs(),
            Curve::Root | Curve::Power(_) if is_singular(rows, node) => false,
            Curve::Root | Curve::Power(_) | Curve::Log if way_a <= NEAR * row[0].abs() => true,
            Curve::Exp | Curve::Tanh | Curve::Sinh | Curve::Cosh if way_a <= 1.0 => true,
            Curve::Asin | Curve::Acos if row[0].abs() + way_a <= 0.9 => true,
            // the singular points of both are at ±i
            Curve::Atan | Curve::Asinh if way_a <= NEAR * (1.0 + row[0].abs()) => true,
            Curve::Acosh if way_a <= NEAR * (row[0] - 1.0) => true,
            Curve::Atanh if way_a <= NEAR * (1.0 - row[0].abs()) => true,
            Curve::Angle => {
                let way_b = self.way(rows, b);
                way_a + way_b <= NEAR * elementary::hypot(row[0], rows.row(b)[0]) || self.is_seen(rows, c, std::f64::consts::PI)
            }
            _ => {
                let around = Range { low: row[0] - way_a, high: row[0] + way_a };
                let Some(range) = curve.range(around, around) else { return false };
                let start = rows.row(c)[0];
                let reach = (range.high - start).max(start - range.low);
                reach <= tolerance * start.abs() || reach <= NOTHING || self.is_seen(rows, c, reach)
            }
        }
    }

    fn is_seen(&mut self, rows: Rows<'_>, c: Row, reach: f64) -> bool {
        reach <= RATIO * self.way(rows, c)
    }

    /// `cross` bounds what both factors' changes give together; only that part is ever cut off. The first terms are usually enough to show it.
    fn is_product_seen(&mut self, rows: Rows<'_>, c: Row, cross: f64, tolerance: f64) -> bool {
        let row = rows.row(c);
        let first: f64 = row.iter().zip(&self.powers).take(5).skip(1).map(|(c_k, power)| c_k.abs() * power).sum();
        cross <= 4.0 * first || cross <= tolerance * row[0].abs() || cross <= NOTHING || self.is_seen(rows, c, cross)
    }

    /// How long a power at zero may be kept constant.
    fn over_singular(&mut self, rows: Rows<'_>, node: Watched, h: f64, tolerance: f64) -> f64 {
        let (row, start) = (rows.row(node.a), rows.row(node.c)[0]);
        let reach = |powers: &[f64]| {
            let far = row[0].abs() + way(&row[1..], &powers[1..]);
            (node.curve.value(far, 0.0) - start).abs()
        };
        let whole = reach(&self.powers);
        let is_little = |off: f64, shorter: f64| off <= 10.0 * tolerance * whole && off * shorter <= tolerance * tolerance * whole * h;
        let mut shorter = h;
        while shorter > f64::MIN_POSITIVE && !is_little(reach(&self.powers), shorter) {
            shorter *= 0.25;
            self.measure(rows.count, shorter);
        }
        self.measure(rows.count, h);
        shorter
    }
}

/// A root or power whose argument begins at zero: its row holds the value alone.
fn is_singular(rows: Rows<'_>, node: Watched) -> bool {
    node.is_power() && rows.row(node.c)[1..].iter().all(|c_k| *c_k == 0.0)
}

/// Σ |c_k| p_k in a fixed order.
fn way(c: &[f64], powers: &[f64]) -> f64 {
    let mut sums = [0.0_f64; 4];
    let ((c4, c), (p4, p)) = (c.as_chunks::<4>(), powers.as_chunks::<4>());
    for (c, p) in c4.iter().zip(p4) {
        for lane in 0..4 {
            sums[lane] += c[lane].abs() * p[lane];
        }
    }
    c.iter().zip(p).fold((sums[0] + sums[2]) + (sums[1] + sums[3]), |sum, (c, p)| sum + c.abs() * p)
}

/// The part of [0, h] on which the polynomial of an argument is the argument: its last two terms stay below the tolerance times its change. Beyond, a
/// sine is no longer where its series goes, and passes places that the series does not.
fn convergent(c: &[f64], mut h: f64, tolerance: f64) -> f64 {
    let p = c.len() - 1;
    for _ in 0..LOOKS * PARTS {
        let (mut power, mut change, mut last) = (1.0, 0.0_f64, 0.0_f64);
        for (k, c_k) in c.iter().enumerate().skip(1) {
            power *= h;
            let term = c_k.abs() * power;
            if k + 2 > p { last = last.max(term) } else { change = change.max(term) }
        }
        let allowed = tolerance.max(64.0 * f64::EPSILON) * change + f64::EPSILON * c[0].abs();
        if last <= allowed || last <= NOTHING {
            break;
        }
        let share = elementary::pow(allowed / last, 1.0 / p as f64);
        h *= if share.is_nan() { 0.1 } else { share.clamp(0.1, 0.97) };
    }
    h
}

/// The part of [0, h] on which an operation is good.
fn looked((rows, node): (Rows<'_>, Watched), mut h: f64, tolerance: f64, good: Judge<'_>) -> f64 {
    if rows.count > LEAST_COUNT {
        h = convergent(rows.row(node.a), h, tolerance);
        if node.curve.has_two() {
            h = convergent(rows.row(node.b), h, tolerance);
        }
    }
    for _ in 0..LOOKS {
        let whole = Part::whole(rows, node, h);
        let weight = largest(node, &whole).max(NOTHING);
        let allowed = tolerance.max(64.0 * f64::EPSILON) * weight;
        match good_share(node, whole, allowed, good) {
            1.0 => return h,
            // the feature is nearer than one look resolves
            0.0 => h *= elementary::powi(0.5_f64, DEPTH as i32),
            share => return share * h,
        }
    }
    h
}

/// Bernstein coefficients of a, b and c on a part of the step.
#[derive(Clone, Debug)]
struct Part {
    /// In units of the step.
    left: f64,
    depth: u32,
    rows: [Vec<f64>; 3],
}

impl Part {
    fn whole(rows: Rows<'_>, node: Watched, h: f64) -> Part {
        let load = |row: Row| {
            let mut c: Vec<f64> = rows.row(row).to_vec();
            let mut power = 1.0;
            for c_k in &mut c {
                *c_k *= power;
                power *= h;
            }
            to_bernstein(&mut c);
            c
        };
        Part { left: 0.0, depth: 0, rows: [load(node.a), if node.curve.has_two() { load(node.b) } else { vec![0.0] }, load(node.c)] }
    }

    fn width(&self) -> f64 {
        elementary::powi(0.5_f64, self.depth as i32)
    }

    fn range(&self, row: usize) -> Range {
        let first = Range { low: f64::INFINITY, high: f64::NEG_INFINITY };
        let mut range = first;
        for &b in &self.rows[row] {
            if b.is_nan() {
                return Range { low: f64::NEG_INFINITY, high: f64::INFINITY };
            }
            range = Range { low: range.low.min(b), high: range.high.max(b) };
        }
        range
    }

    /// Values of f at the ends.
    fn ends(&self, curve: Curve) -> [f64; 2] {
        let [a, b, _] = &self.rows;
        [curve.value(a[0], b[0]), curve.value(a[a.len() - 1], b[b.len() - 1])]
    }

    fn values(&self, node: Watched) -> Option<Range> {
        node.curve.range(self.range(0), self.range(1))
    }

    /// De Casteljau in the middle.
    fn halves(&self) -> [Part; 2] {
        let mut halves = [self.clone(), self.clone()];
        for row in 0..3 {
            let (left, right) = halve(&self.rows[row]);
            halves[0].rows[row] = left;
            halves[1].rows[row] = right;
        }
        halves.iter_mut().for_each(|half| half.depth += 1);
        halves[1].left += halves[1].width();
        halves
    }
}

/// A value of |f| on the step not far below the largest: parts that may hold more are halved first.
fn largest(node: Watched, whole: &Part) -> f64 {
    let finite = |best: f64, v: f64| if v.is_finite() { best.max(v.abs()) } else { best };
    let bound = |part: &Part| part.values(node).map_or(f64::INFINITY, Range::size);
    let mut best = whole.ends(node.curve).into_iter().fold(0.0, finite);
    let mut parts = vec![(bound(whole), whole.clone())];
    for _ in 0..PARTS {
        let Some(at) = (0..parts.len()).max_by(|i, j| parts[*i].0.total_cmp(&parts[*j].0)) else { break };
        if parts[at].0 <= 2.0 * best || parts[at].1.depth >= 2 * DEPTH {
            break;
        }
        let (_, part) = parts.swap_remove(at);
        for half in part.halves() {
            best = half.ends(node.curve).into_iter().fold(best, finite);
            parts.push((bound(&half), half));
        }
    }
    best
}

/// Share of the step, from its start, on which f stays where its polynomial is.
fn good_share(node: Watched, whole: Part, allowed: f64, good: Judge<'_>) -> f64 {
    let mut parts = vec![whole];
    while let Some(part) = parts.pop() {
        if good(node, &part, allowed) {
            continue;
        }
        if part.depth >= if node.is_positive() { DEEP } else { DEPTH } {
            // behind the zero of a root of a square the next step takes its other side
            return part.left + if node.is_positive() && part.rows[2][0] > 0.0 { part.width() } else { 0.0 };
        }
        let [left, right] = part.halves();
        parts.push(right);
        parts.push(left);
    }
    1.0
}

/// Whether a part of a step is good.
type Judge<'j> = &'j dyn Fn(Watched, &Part, f64) -> bool;

/// Whether the polynomial of a root is not the other root of a square.
fn keeps_its_sign(node: Watched, part: &Part, allowed: f64) -> bool {
    !node.is_positive() || part.range(2).low >= -allowed
}

fn is_good(node: Watched, part: &Part, allowed: f64) -> bool {
    let Some(mut f) = part.values(node) else { return false };
    let c = part.range(2);
    if node.curve == Curve::Angle {
        let turn = 2.0 * std::f64::consts::PI;
        let turns = ((c.low + c.high - f.low - f.high) / (2.0 * turn)).round() * turn;
        f = Range { low: f.low + turns, high: f.high + turns };
    }
    if !keeps_its_sign(node, part, allowed) {
        return false;
    }
    let off = (f.high - c.high).max(c.low - f.low);
    off <= allowed || off <= share_beside(node) * f.width() && f.width().is_finite()
}

/// Share of its width by which the range of f may leave that of its polynomial. Two arguments that depend on one another (y/|y|, which is constant) have a
/// range on both sides of the value that only halves with the part; a hidden feature leaves on one side by the whole width.
fn share_beside(node: Watched) -> f64 {
    if node.curve.has_two() { 0.75 } else { 0.5 }
}

fn halve(row: &[f64]) -> (Vec<f64>, Vec<f64>) {
    let (mut left, mut right) = (Vec::with_capacity(row.len()), row.to_vec());
    halve_row(&mut right, &mut left);
    (left, right)
}

#[cfg(test)]
mod tests {
    use super::*;

    const COUNT: usize = 20;

    /// A fixed sequence in -1..1.
    fn numbers() -> impl FnMut() -> f64 {
        let mut n = 0.0_f64;
        move || {
            n += 1.0;
            2.0 * (n * 0.754_877_666_246_692_7).fract() - 1.0
        }
    }

    fn value(c: &[f64], tau: f64) -> f64 {
        c.iter().rev().fold(0.0, |sum, c_k| sum * tau + c_k)
    }

    #[test]
    fn ways_and_parts_hold_the_polynomial() {
        let mut next = numbers();
        for _ in 0..300 {
            let h = 10.0_f64.powf(next());
            let cells: Vec<f64> = (0..COUNT).map(|k| next() * h.powi(-(k as i32))).collect();
            let rows = Rows { cells: &cells, stride: COUNT, count: COUNT };
            let node = Watched { curve: Curve::Exp, a: 0, b: 0, c: 0 };
            let mut watch = Watch::new(vec![node], 1);
            watch.measure(COUNT, h);
            let way = watch.way(rows, 0);
            let part = Part::whole(rows, node, h).halves()[1].halves()[0].clone();
            let range = part.range(0);
            for k in 0..=50 {
                let u = f64::from(k) / 50.0;
                assert!((value(&cells, u * h) - cells[0]).abs() <= way * (1.0 + 1e-13));
                let inside = value(&cells, (part.left + u * part.width()) * h);
                assert!(range.low - 1e-12 <= inside && inside <= range.high + 1e-12, "{inside} not in {range:?}");
            }
        }
    }

    /// Taylor coefficients vanish where tanh(slope tau - far) is saturated: the step must end before it rises, and not long before.
    #[test]
    fn saturated_step_is_met_at_any_width() {
        for slope in [1e2, 1e3, 1e5, 1e8] {
            let mut cells = vec![0.0; 2 * COUNT];
            (cells[0], cells[1], cells[COUNT]) = (-0.5 * slope, slope, -1.0);
            let rows = Rows { cells: &cells, stride: COUNT, count: COUNT };
            let mut watch = Watch::new(vec![Watched { curve: Curve::Tanh, a: 0, b: 0, c: 1 }], 2);
            let h = watch.faithful(rows, 1.0, 1e-12, 0.0);
            let off = (slope * h - 0.5 * slope).tanh() + 1.0;
            // a believed step keeps the tolerance it was asked with, and is not needlessly short
            assert!(off <= 1e-12 && h > 0.4 - 20.0 / slope, "{slope}: {h}, {off}");
        }
    }

    /// y/|y| is -1 all along: the intervals of its arguments know nothing of one another.
    #[test]
    fn constant_quotient_of_what_varies_is_believed() {
        let mut cells = vec![0.0; 3 * COUNT];
        (cells[0], cells[1], cells[2]) = (-1.0, 3.0, -4.9);
        (cells[COUNT], cells[COUNT + 1], cells[COUNT + 2]) = (1.0, -3.0, 4.9);
        cells[2 * COUNT] = -1.0;
        let rows = Rows { cells: &cells, stride: COUNT, count: COUNT };
        let mut watch = Watch::new(vec![Watched { curve: Curve::Quotient, a: 0, b: 1, c: 2 }], 3);
        assert_eq!(watch.faithful(rows, 0.3, 1e-12, 0.0), 0.3);
    }

    /// A bell curve that has underflowed where the step begins, passed twice within it.
    #[test]
    fn far_bell_curve_is_met() {
        for width in [0.01, 1e-4, 1e-6] {
            let mut cells = vec![0.0; 2 * COUNT];
            let w = 1.0 / (width * width);
            (cells[0], cells[1], cells[2]) = (-0.25 * w, w, -w);
            let rows = Rows { cells: &cells, stride: COUNT, count: COUNT };
            let mut watch = Watch::new(vec![Watched { curve: Curve::Exp, a: 0, b: 0, c: 1 }], 2);
            let h = watch.faithful(rows, 2.0, 1e-12, 0.0);
            let bell = (-w * (h - 0.5).powi(2)).exp();
            // a believed step keeps the tolerance it was asked with, and is not needlessly short
            assert!(bell <= 1e-12 && h > 0.5 - 1e2 * width, "{width}: {h}");
        }
    }

    #[test]
    fn resolved_function_costs_nothing() {
        // exp(tau) up to h = 3
        let mut cells = vec![0.0; 2 * COUNT];
        cells[1] = 1.0;
        (0..COUNT).fold(1.0, |c, k| {
            cells[COUNT + k] = c;
            c / (k + 1) as f64
        });
        let rows = Rows { cells: &cells, stride: COUNT, count: COUNT };
        let mut watch = Watch::new(vec![Watched { curve: Curve::Exp, a: 0, b: 0, c: 1 }], 2);
        assert_eq!(watch.faithful(rows, 3.0, 1e-12, 0.0), 3.0);
        assert_eq!(watch.looks, 0);
    }

    /// From y = -1/2 on, y² has the root |y|, and its series that of -y.
    #[test]
    fn the_root_of_a_square_turns_at_zero() {
        let mut cells = vec![0.0; 2 * COUNT];
        cells[..3].copy_from_slice(&[0.25, -1.0, 1.0]);
        cells[COUNT..COUNT + 2].copy_from_slice(&[0.5, -1.0]);
        let rows = Rows { cells: &cells, stride: COUNT, count: COUNT };
        for curve in [Curve::Root, Curve::Power(0.5)] {
            let mut watch = Watch::new(vec![Watched { curve, a: 0, b: 0, c: 1 }], 2);
            let h = watch.faithful(rows, 2.5, 1e-13, 0.0);
            assert!((0.5..0.5 + 1e-6).contains(&h), "{h}");
            // short of zero nothing is hidden
            assert_eq!(watch.faithful(rows, 0.49, 1e-13, 0.0), 0.49);
        }
    }
}
