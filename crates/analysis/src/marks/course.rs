//! Least, greatest and mean values of sampled quantities over an axis of any kind.

use super::bracketed;
use super::crossings::{self, Bracket};
use crate::dataset::{Extreme, Overall};
use crate::proxies::proxy::{Piece, Proxies, Source};

/// Share of the range by which a later value must be better: of equal ones the first counts.
const TIE: f64 = 1e-13;

/// Quantities over an axis; column k + 1 is quantity k.
#[derive(Clone, Debug)]
pub(crate) struct Course {
    list: Vec<Extreme>,
    /// Integral, and length of what has a piece.
    integrals: Vec<[f64; 2]>,
    span: f64,
    proxies: Proxies,
}

impl Course {
    /// For so many quantities.
    pub(crate) fn new(count: usize, proxies: Proxies) -> Course {
        let none = |k: usize| Extreme { column: k + 1, min: f64::INFINITY, max: f64::NEG_INFINITY, ..Extreme::default() };
        Course { list: (0..count).map(none).collect(), integrals: vec![[0.0; 2]; count], span: 0.0, proxies }
    }

    /// Takes the value of a quantity at a place of the axis.
    pub(crate) fn offer(&mut self, k: usize, place: f64, value: f64) {
        let e = &mut self.list[k];
        if !value.is_finite() {
            return;
        }
        if e.min > e.max {
            *e = Extreme { column: e.column, min: value, t_min: place, max: value, t_max: place };
            return;
        }
        let margin = TIE * (e.max - e.min) + 4.0 * f64::EPSILON * value.abs();
        if value < e.min - margin {
            (e.min, e.t_min) = (value, place);
        }
        if value > e.max + margin {
            (e.max, e.t_max) = (value, place);
        }
    }

    /// Takes a stretch of length h; `at` is the place on the axis of what is tau from its beginning.
    pub(crate) fn add(&mut self, source: &mut dyn Source, h: f64, at: &dyn Fn(f64) -> f64) {
        let all: Vec<usize> = (0..self.list.len()).collect();
        self.span += h;
        for piece in self.proxies.pieces(source, &all, h) {
            let width = piece.to - piece.from;
            let [integral, length] = &mut self.integrals[piece.of];
            *integral += width * piece.row.iter().sum::<f64>() / piece.row.len() as f64;
            *length += width;
            self.piece(&piece, source, at);
        }
    }

    fn piece(&mut self, piece: &Piece, source: &mut dyn Source, at: &dyn Fn(f64) -> f64) {
        let tau = |u: f64| piece.from + (piece.to - piece.from) * u;
        let (first, last) = (piece.row[0], piece.row[piece.row.len() - 1]);
        self.offer(piece.of, at(piece.from), first);
        let row = crossings::derivative(&piece.row);
        let mut sign = 0.0;
        for Bracket { from, to, .. } in crossings::crossings(&row, 0.0, &mut sign) {
            let mut slope = |u: f64| crossings::value(&row, u);
            let ends = [slope(from), slope(to)];
            let u = if from < to { bracketed(&mut slope, (from, ends[0]), (to, ends[1])) } else { from };
            let (rough, e) = (crossings::value(&piece.row, u), &self.list[piece.of]);
            if rough < e.min || rough > e.max {
                let value = source.sample(tau(u))[piece.of];
                self.offer(piece.of, at(tau(u)), value);
            }
        }
        self.offer(piece.of, at(piece.to), last);
    }

    fn is_lost(&self, k: usize) -> bool {
        self.proxies.lost().contains(&k)
    }

    /// Quantities that could not be followed everywhere.
    pub(crate) fn lost(&self) -> Vec<usize> {
        (0..self.list.len()).filter(|k| self.is_lost(*k)).collect()
    }

    /// Extremes of what could be followed everywhere.
    pub(crate) fn found(&self) -> Vec<Extreme> {
        self.list.iter().filter(|e| e.min <= e.max && !self.is_lost(e.column - 1)).cloned().collect()
    }

    /// Integrals, with these values at the two ends.
    pub(crate) fn overall(&self, ends: [&[f64]; 2]) -> Vec<Overall> {
        let one = |(k, [integral, length]): (usize, &[f64; 2])| {
            // lengths of steps are summed with rounding
            let whole = !self.is_lost(k) && (length - self.span).abs() <= 1e-9 * self.span;
            Overall {
                column: k + 1,
                integral: if whole { *integral } else { f64::NAN },
                span: self.span,
                first: ends[0][k],
                last: ends[1][k],
            }
        };
        self.integrals.iter().enumerate().map(one).collect()
    }
}
