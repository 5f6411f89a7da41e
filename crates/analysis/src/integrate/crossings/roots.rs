//! First sign change of a polynomial on an interval, with a guarantee.
//!
//! In the Bernstein basis of [0, 1] the number of sign changes of the coefficients is at least the number of roots and differs from it by an
//! even number (Descartes' rule). No change: no root; one: exactly one root; more: the interval is halved by de Casteljau's
//! algorithm, left half first. So a pair of roots cannot slip through, however close, down to the rounding of the coefficients themselves.
//!
//! *Source*: G. E. Collins, A. G. Akritas, Polynomial real root isolation using Descartes' rule of signs, SYMSAC 1976; Bernstein form by
//! J. M. Lane, R. F. Riesenfeld, Bounds on a polynomial, BIT 21 (1981) 112-117.

use algebra::bernstein::{halve_row, to_bernstein};
use algebra::elementary;

/// Deepest halving: intervals below this share of the step are one instant.
const DEPTH: u32 = 50;
/// Rounding of a coefficient relative to the terms that met in it.
const NOISE: f64 = 4.0 * f64::EPSILON;

/// Share of the terms of a polynomial above which it is surely more than their rounding.
pub(in crate::integrate) const CLEAR: f64 = 16.0 * NOISE;

/// Share of its last terms that a polynomial must exceed at the distance at which a root is sharp: a thousand times that distance is what they may move it.
const SHIFTED: f64 = 1e-3;

/// Share of the way to a root behind which nothing is gained by going nearer: a sixteenth of it is a step.
const NEAREST: f64 = 0.9375;

/// Terms at the end that together are below this share of the first coefficient are far below its noise in every coefficient of Bernstein's form.
const NEGLIGIBLE: f64 = 0.25 * f64::EPSILON;

/// Workspace of the root search; reused so that a search allocates nothing.
#[derive(Clone, Debug, Default)]
pub struct RootFinder {
    /// c_k h^k.
    scaled: Vec<f64>,
    /// How many of them count.
    count: usize,
    /// Bernstein coefficients of the intervals still to be searched, then the sizes of the terms in them: one row each, first interval last.
    rows: Vec<f64>,
    /// (left end, depth) of the rows.
    intervals: Vec<(f64, u32)>,
    left: Vec<f64>,
}

/// Whether the polynomial surely keeps its sign on [0, h]: |c_0| > sum |c_k| h^k.
#[inline]
pub fn surely_no_root(c: &[f64], h: f64) -> bool {
    let Some((first, rest)) = c.split_first() else { return true };
    let sum = rest.iter().rev().fold(0.0, |sum, c_k| (sum + c_k.abs()) * h);
    first.abs() > sum
}

/// The last place before a root at which the polynomial stands clear of its rounding and of what it leaves out; none where it does at the distance `sharp`, or nowhere
/// before it.
///
/// Where a root has the order m, rounding hides the polynomial around it over ε^(1/m) of the distance; and beside a value of 1e-14 of a quantity that was 1 where the
/// polynomial begins, what a tolerance leaves out is more than the quantity. One expanded at the place found here is as exact as its own terms there, which are as
/// small as it is.
pub fn clear_before(c: &[f64], root: f64, sharp: f64) -> Option<f64> {
    let is_clear = |u: f64, left_out: f64| {
        let (value, size) = c.iter().rev().fold((0.0, 0.0), |(value, size), c_k| (value * u + c_k, size * u + c_k.abs()));
        let last = c.iter().enumerate().rev().take(2).map(|(k, c_k)| c_k.abs() * elementary::powi(u, k as i32)).sum::<f64>();
        f64::abs(value) > CLEAR * size + left_out * last
    };
    if is_clear(root - sharp, SHIFTED) {
        return None;
    }
    let mut back = 2.0 * sharp;
    while back < NEAREST * root {
        if is_clear(root - back, 2.0) {
            return Some(root - back);
        }
        back = (2.0 * back).min(0.5 * (back + root));
    }
    None
}

impl RootFinder {
    /// First tau in [0, h] at which sum_k c_k tau^k takes the sign opposite to `sign` (+1 or -1, its sign just after 0); none when it
    /// keeps its sign or only touches zero.
    pub fn first_crossing(&mut self, c: &[f64], h: f64, sign: f64) -> Option<f64> {
        if c.is_empty() || surely_no_root(c, h) {
            return None;
        }
        self.load(c, h, sign);
        let n = self.count;
        while let Some((left, depth)) = self.intervals.pop() {
            let width = elementary::powi(0.5_f64, depth as i32);
            let start = self.rows.len() - 2 * n;
            let (row, sizes) = self.rows[start..].split_at(n);
            let (changes, first, last) = signs(row, sizes);
            // only the first coefficient is a value of the polynomial: when it is noise, the next one says nothing about the left end
            if row[0] < -NOISE * sizes[0] || (changes == 0 && first < 0.0) {
                return Some(left * h);
            }
            let isolated = changes == 1 && first > 0.0;
            if changes > 0 && !isolated && depth < DEPTH {
                self.halve(start, left, depth);
                continue;
            }
            self.rows.truncate(start);
            if isolated {
                return Some(h * self.polish(left, left + width));
            }
            if last < 0.0 {
                return Some((left + width) * h);
            }
        }
        None
    }

    /// One row for [0, 1]: the Bernstein coefficients b_j = sum_{k<=j} C(j,k)/C(n,k) c_k h^k of sign * polynomial, then the same of |c_k| h^k: how
    /// large the terms were that met in each b_j.
    fn load(&mut self, c: &[f64], h: f64, sign: f64) {
        self.scaled.clear();
        let mut power = sign;
        for c_k in c {
            self.scaled.push(c_k * power);
            power *= h;
        }
        self.count = significant(&self.scaled);
        let counted = &self.scaled[..self.count];
        self.rows.clear();
        self.rows.extend_from_slice(counted);
        self.rows.extend(counted.iter().map(|c_k| c_k.abs()));
        let (row, sizes) = self.rows.split_at_mut(self.count);
        to_bernstein(row);
        to_bernstein(sizes);
        self.intervals.clear();
        self.intervals.push((0.0, 0));
    }

    /// Replaces the last row by its right half and pushes its left half.
    fn halve(&mut self, start: usize, left: f64, depth: u32) {
        let n = self.count;
        self.left.clear();
        let (row, sizes) = self.rows[start..].split_at_mut(n);
        halve_row(row, &mut self.left);
        halve_row(sizes, &mut self.left);
        self.rows.extend_from_slice(&self.left);
        let width = elementary::powi(0.5_f64, depth as i32 + 1);
        self.intervals.push((left + width, depth + 1));
        self.intervals.push((left, depth + 1));
    }

    /// The only root in [a, b] (in units of the step), from positive to negative: Newton's method kept inside the bracket.
    fn polish(&self, mut a: f64, mut b: f64) -> f64 {
        let mut u = 0.5 * (a + b);
        for _ in 0..200 {
            let (value, slope) = value_and_slope(&self.scaled, u);
            if value == 0.0 {
                return u;
            }
            if value > 0.0 {
                a = u;
            } else {
                b = u;
            }
            let newton = u - value / slope;
            let next = if newton > a && newton < b { newton } else { 0.5 * (a + b) };
            if (next - u).abs() <= f64::EPSILON * u.abs() || b - a <= f64::EPSILON * b.abs() {
                return next;
            }
            u = next;
        }
        u
    }
}

/// Number of leading terms without which the polynomial would change.
fn significant(scaled: &[f64]) -> usize {
    let (limit, mut rest) = (NEGLIGIBLE * scaled[0].abs(), 0.0);
    let negligible = |c_k: &&f64| {
        rest += c_k.abs();
        rest <= limit
    };
    scaled.len() - scaled[1..].iter().rev().take_while(negligible).count()
}

fn value_and_slope(c: &[f64], u: f64) -> (f64, f64) {
    let (mut value, mut slope) = (0.0, 0.0);
    for c_k in c.iter().rev() {
        slope = slope * u + value;
        value = value * u + c_k;
    }
    (value, slope)
}

/// Number of sign changes, zeros skipped; first and last non-zero coefficient (0 when all vanish). What rounding can make counts as zero.
fn signs(row: &[f64], sizes: &[f64]) -> (usize, f64, f64) {
    let (mut changes, mut first, mut last) = (0, 0.0, 0.0);
    for (&b, size) in row.iter().zip(sizes) {
        if b.abs() > NOISE * size {
            if first == 0.0 {
                first = b;
            } else if (b > 0.0) != (last > 0.0) {
                changes += 1;
            }
            last = b;
        }
    }
    (changes, first, last)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Roots in [0, 1]: units of the last place.
    const ROUNDING: f64 = 1e-15;
    /// The same beside two more roots, whose factors add their rounding.
    const STEEP: f64 = 1e-14;
    /// Behind a touch: the slope at the root is a tenth.
    const CLOSE: f64 = 1e-13;
    /// A root of thirty on an interval of a hundred: rounding of coefficients of thousands over the slope.
    const FLAT: f64 = 1e-12;

    /// Coefficients of prod (tau - root).
    fn with_roots(roots: &[f64]) -> Vec<f64> {
        let mut c = vec![1.0];
        for r in roots {
            c.push(0.0);
            for k in (0..c.len()).rev() {
                c[k] = if k > 0 { c[k - 1] } else { 0.0 } - r * c[k];
            }
        }
        c
    }

    fn first(roots: &[f64], h: f64) -> Option<f64> {
        let c = with_roots(roots);
        let sign = c[0].signum();
        RootFinder::default().first_crossing(&c, h, sign)
    }

    /// cos τ to order 26 within a short step: fourteen of its terms are nothing, and the root is that of all.
    #[test]
    fn terms_that_are_nothing_are_left_out() {
        let mut c = vec![0.0; 27];
        (0..27).step_by(2).fold(1.0, |term, k| {
            c[k] = term;
            -term / ((k + 1) * (k + 2)) as f64
        });
        c[0] -= 0.2_f64.cos();
        let mut finder = RootFinder::default();
        let t = finder.first_crossing(&c, 0.3, 1.0).unwrap();
        assert!((t - 0.2).abs() < ROUNDING && finder.count <= 13, "{t} {}", finder.count);
    }

    #[test]
    fn first_of_several_roots_is_found() {
        let t = first(&[0.7, 0.2, 0.9, 0.4, 1.5], 1.0).unwrap();
        assert!((t - 0.2).abs() < ROUNDING);
    }

    #[test]
    fn close_pair_inside_one_step_is_not_missed() {
        for gap in [1e-3, 1e-5, 1e-6] {
            let t = first(&[0.4, 0.4 + gap, 3.0, -2.0], 1.0).unwrap();
            // a root of a pair with gap d moves by rounding / d
            assert!((t - 0.4).abs() < ROUNDING / gap, "{gap}: {t}");
        }
    }

    #[test]
    fn tangential_touch_is_not_a_crossing() {
        assert_eq!(first(&[0.5, 0.5], 1.0), None);
        assert_eq!(first(&[0.3, 0.3, 2.0], 1.0), None);
        let after = first(&[0.5, 0.5, 0.8], 1.0).unwrap();
        assert!((after - 0.8).abs() < CLOSE);
    }

    #[test]
    fn root_at_a_dyadic_point_is_found() {
        for r in [0.5, 0.25, 0.75, 0.125] {
            assert!((first(&[r, 2.0], 1.0).unwrap() - r).abs() < ROUNDING);
            assert!((first(&[r, 2.0 * r, 0.99], 1.0).unwrap() - r).abs() < STEEP);
        }
    }

    #[test]
    fn triple_root_is_a_crossing() {
        let t = first(&[0.3, 0.3, 0.3], 1.0).unwrap();
        // a triple root is known to the cube root of rounding
        assert!((t - 0.3).abs() < 2e-5);
    }

    /// Seen from nearer and nearer, a root of fifth order is met to rounding: (ε^(1/5))^n of the distance after n times.
    #[test]
    fn a_root_that_rounding_blurs_is_seen_from_nearby() {
        let sharp = |root: f64| 1e-11 * root;
        // nothing is left out of it: its last terms are zero
        let whole = |roots: &[f64]| [with_roots(roots), vec![0.0; 2]].concat();
        let (mut at, mut times) = (0.0, 0);
        let root = loop {
            let c = whole(&[1.3 - at; 5]);
            let root = RootFinder::default().first_crossing(&c, 2.0, -1.0).unwrap();
            let Some(clear) = clear_before(&c, root, sharp(root).max(4.0 * f64::EPSILON)) else { break at + root };
            (at, times) = (at + clear, times + 1);
        };
        assert!((root - 1.3).abs() < ROUNDING && (3..=8).contains(&times), "{root} {times}");
        // simple ones are sharp from anywhere
        assert_eq!(clear_before(&whole(&[0.4, 3.0, -2.0]), 0.4, sharp(0.4)), None);
    }

    #[test]
    fn no_root_no_crossing() {
        assert_eq!(first(&[-1.0, 2.0, 3.0], 1.0), None);
        assert_eq!(RootFinder::default().first_crossing(&[1.0, 0.0, 1.0], 5.0, 1.0), None);
        assert_eq!(RootFinder::default().first_crossing(&[], 5.0, 1.0), None);
    }

    #[test]
    fn root_just_after_the_start_and_long_steps() {
        // the root relative to itself: the last places of 1e-13
        assert!((first(&[1e-13, 5.0], 1.0).unwrap() - 1e-13).abs() < 1e-27);
        assert!((first(&[30.0, 70.0], 100.0).unwrap() - 30.0).abs() < FLAT);
    }
}
