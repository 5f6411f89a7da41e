//! The least and the greatest value of one quantity, piece by piece.
//!
//! Candidates are both ends of every piece (so both sides of every jump) and the zeros of the slope of its polynomial; the quantity itself is evaluated there. A
//! polynomial is off by a share of its range, and a piece may range over many decades: `exp(3 t) - 100 t` from 1 over -84 to 4e15. So what a piece may hide below or
//! above what was found is looked for as well. Parts of it are settled by the coefficients there, with their errors:
//! no value beyond what is known; a slope of one sign; a curvature of one sign, where what the place of the extreme may be off by moves its value by next to nothing. What is
//! left is sampled anew by itself, with a range of its own.

use super::bracketed;
use super::crossings::{self, Bracket};
use crate::dataset::Extreme;
use crate::proxies::proxy::{Piece, Proxies, Source, Window};
use algebra::elementary;

/// Error of a piece relative to its variation, with room to spare.
const ROUGH: f64 = 1e-9;
/// Share of itself to which an extreme is known where the range of its piece says no more.
const CLOSE: f64 = 1e-11;
/// Halvings of a piece after which what is not settled is sampled anew: a thousandth of it.
const BLURRED: u32 = 10;
/// Share of a piece from which on what is left of it is sampled in two halves: it shall become shorter.
const LONG: f64 = 0.75;
/// Parts that may be sampled anew at once, and in a long motion one for each step: where rounding hides the extremes they all fail.
pub(super) const PATIENCE: u32 = 256;
/// Range of values that are rounding, in units of it.
const NOISE: f64 = 64.0;
/// Share of its range by which a polynomial is off where its values are noise, if nothing is known of their rounding.
const NOISY: f64 = 1e-6;
/// Pieces of such a part that may fail.
const FAILING: i64 = 24;

/// Extremes of a quantity, and what is left to spend on them.
#[derive(Clone, Debug)]
pub(super) struct Peaks {
    pub(super) found: Extreme,
    /// Share by which a later value must be better: of equal ones the first counts.
    tie: f64,
    patience: u32,
    most: u32,
    samples: u64,
}

impl Peaks {
    /// Of a column, nothing known; so many parts may be sampled anew at once.
    pub(super) fn new(column: usize, tie: f64, patience: u32) -> Peaks {
        let found = Extreme { column, min: f64::INFINITY, max: f64::NEG_INFINITY, ..Extreme::default() };
        Peaks { found, tie, patience, most: patience, samples: 0 }
    }

    /// Takes a value that no piece tells of.
    pub(super) fn offer(&mut self, place: f64, value: f64) {
        let range = self.found.max - self.found.min;
        self.beside(range.max(0.0), place, value);
    }

    /// Takes a value from among others of this range: equal ones are equal to a share of that, or of themselves. The range of all values may be decades larger.
    fn beside(&mut self, range: f64, place: f64, value: f64) {
        let e = &mut self.found;
        if !value.is_finite() {
            return;
        }
        if e.min > e.max {
            *e = Extreme { column: e.column, min: value, t_min: place, max: value, t_max: place };
            return;
        }
        let margin = self.tie * range.max(value.abs()) + 4.0 * f64::EPSILON * value.abs();
        if value < e.min - margin {
            (e.min, e.t_min) = (value, place);
        }
        if value > e.max + margin {
            (e.max, e.t_max) = (value, place);
        }
    }

    /// Whether no value between these two can be more.
    pub(super) fn holds(&self, [low, high]: [f64; 2]) -> bool {
        high <= self.found.max && low >= self.found.min
    }

    /// Whether no value between these two is more by a share that counts.
    fn nearly_holds(&self, [low, high]: [f64; 2]) -> bool {
        let Extreme { min, max, .. } = self.found;
        high <= max + CLOSE * max.abs() && low >= min - CLOSE * min.abs()
    }

    /// Takes a piece; `at` is the place on the axis of what is tau from the beginning of the stretch.
    pub(super) fn piece(&mut self, piece: &Piece, source: &mut dyn Source, at: &dyn Fn(f64) -> f64) {
        self.patience = (self.patience + 1).min(self.most);
        self.look(piece, source, at);
    }

    fn look(&mut self, piece: &Piece, source: &mut dyn Source, at: &dyn Fn(f64) -> f64) {
        let [low, high] = hull(&piece.row);
        if !self.holds([low, high]) {
            self.candidates(piece, source, at);
        }
        if piece.row.len() == 2 || self.nearly_holds([low - piece.error, high + piece.error]) {
            return;
        }
        let left = self.unsettled(&piece.row, piece.error);
        if left.is_empty() || self.is_noise(piece, high - low, source) {
            return;
        }
        let width = piece.to - piece.from;
        for [from, to] in left {
            let [a, b] = [from, to].map(|u| piece.from + width * u);
            if to - from < LONG {
                self.again([a, b], piece.of, source, at);
                continue;
            }
            let middle = 0.5 * (a + b);
            self.again([a, middle], piece.of, source, at);
            self.again([middle, b], piece.of, source, at);
        }
    }

    /// Whether sampling anew tells no more: the values of a piece with this range are rounding, at both ends of it (beside a pole it is large at one).
    fn is_noise(&self, piece: &Piece, range: f64, source: &mut dyn Source) -> bool {
        let [a, b] = [piece.from, piece.to].map(|tau| source.rounding(tau).get(piece.of).copied());
        match (a, b) {
            (Some(a), Some(b)) => range <= NOISE * a.min(b),
            _ => piece.error > NOISY * range,
        }
    }

    fn candidates(&mut self, piece: &Piece, source: &mut dyn Source, at: &dyn Fn(f64) -> f64) {
        let tau = |u: f64| piece.from + (piece.to - piece.from) * u;
        let [low, high] = hull(&piece.row);
        self.beside(high - low, at(piece.from), piece.row[0]);
        let row = crossings::derivative(&piece.row);
        let mut sign = 0.0;
        for Bracket { from, to, .. } in crossings::crossings(&row, 0.0, &mut sign) {
            let mut slope = |u: f64| crossings::value(&row, u);
            let ends = [slope(from), slope(to)];
            let u = if from < to { bracketed(&mut slope, (from, ends[0]), (to, ends[1])) } else { from };
            // what its polynomial leaves well inside of what was found cannot be more
            let (rough, off) = (crossings::value(&piece.row, u), ROUGH * (high - low));
            if !self.holds([rough - off, rough + off]) {
                let value = source.value(tau(u), piece.of);
                self.beside(high - low, at(tau(u)), value);
            }
        }
        self.beside(high - low, at(piece.to), piece.row[piece.row.len() - 1]);
    }

    /// Parts of [0, 1] in which a polynomial with this error may leave what was found.
    fn unsettled(&self, row: &[f64], error: f64) -> Vec<[f64; 2]> {
        let mut left: Vec<[f64; 2]> = Vec::new();
        let mut open = vec![(row.to_vec(), 0.0_f64, 0_u32)];
        while let Some((row, from, depth)) = open.pop() {
            let width = elementary::powi(0.5_f64, depth as i32);
            let [low, high] = hull(&row);
            if self.nearly_holds([low - error, high + error]) || is_simple(&row, error, width) {
                continue;
            }
            if depth < BLURRED {
                let (first, second) = crossings::halves(row);
                open.push((second, from + 0.5 * width, depth + 1));
                open.push((first, from, depth + 1));
                continue;
            }
            match left.last_mut().filter(|last| last[1] == from) {
                Some(last) => last[1] = from + width,
                None => left.push([from, from + width]),
            }
        }
        left
    }

    /// Samples a part by itself, if it is more than an instant and its values there are more than rounding.
    fn again(&mut self, [from, to]: [f64; 2], of: usize, source: &mut dyn Source, at: &dyn Fn(f64) -> f64) {
        if self.patience == 0 || to - from <= 4.0 * source.resolution() {
            return;
        }
        self.patience -= 1;
        let mut window = Window::new(source, from);
        let mut proxies = Proxies::sparing(FAILING, of + 1);
        let pieces = proxies.pieces(&mut window, &[of], to - from);
        self.samples += proxies.samples();
        for piece in pieces {
            self.look(&piece, &mut window, &|tau| at(from + tau));
        }
    }

    /// Rows sampled anew.
    pub(super) fn samples(&self) -> u64 {
        self.samples
    }
}

/// Whether a polynomial with this error, over a part of this width of its piece, has at most one extreme there, at a place that is known well enough: errors
/// of derivatives are those of a polynomial of its degree (Markov).
fn is_simple(row: &[f64], error: f64, width: f64) -> bool {
    let n = (row.len() - 1) as f64;
    let slopes = crossings::derivative(row);
    let off = 2.0 * n * n * error * width;
    let [low, high] = hull(&slopes);
    if low > off || high < -off {
        return true;
    }
    let [low, high] = hull(&crossings::derivative(&slopes));
    let bent = low.max(-high) - 4.0 / 3.0 * n * n * (n * n - 1.0) * error * width * width;
    // an eighth of the curvature is the least variation over the part
    bent > 0.0 && 0.5 * off * off / bent <= CLOSE * bent / 8.0
}

/// Least and greatest coefficient: the polynomial lies between.
fn hull(row: &[f64]) -> [f64; 2] {
    row.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], b| [low.min(*b), high.max(*b)])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::proxies::proxy::Values;

    fn peaks(f: impl Fn(f64) -> f64, length: f64) -> Peaks {
        let (mut peaks, mut source) = (Peaks::new(1, 1e-13, PATIENCE), Values(|t: f64| vec![f(t)]));
        for piece in Proxies::default().pieces(&mut source, &[0], length) {
            peaks.piece(&piece, &mut source, &|tau| tau);
        }
        peaks
    }

    #[test]
    fn what_hides_below_many_decades_is_found() {
        let ten = peaks(|t| (10.0 * t).exp() - 1e4 * t, 12.0);
        // e^(10 t) = 1000 at the least value
        let least = 1e3 * (1.0 - 1e3_f64.ln());
        // values of some hundred roundings
        assert!((ten.found.min - least).abs() < 1e-11 * least.abs(), "{}", ten.found.min);
        let touch = peaks(|t| (t - 7.3).powi(4) * (2.0 * t).exp(), 12.0);
        // what the place is off by, 1e-9 at most, to the fourth power
        assert!(touch.found.min < 1e-30, "{}", touch.found.min);
        let plain = peaks(|t| (3.0 * t).sin().powi(2), 12.0);
        // the square of what the place of a simple extreme is off by
        assert!(plain.found.min < 1e-25);
    }
}
