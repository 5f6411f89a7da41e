//! Least, greatest and mean values of sampled quantities over an axis of any kind.

use super::peaks::Peaks;
use crate::dataset::{Extreme, Overall};
use crate::proxies::proxy::{Proxies, Source};

/// Share by which a later value must be better: of equal ones the first counts.
const TIE: f64 = 1e-13;

/// Parts of a quantity that may be sampled anew at once: a place of a mechanism is costly.
const PATIENCE: u32 = 32;

/// Quantities over an axis; column k + 1 is quantity k.
#[derive(Clone, Debug)]
pub(crate) struct Course {
    list: Vec<Peaks>,
    /// Integral, and length of what has a piece.
    integrals: Vec<[f64; 2]>,
    span: f64,
    proxies: Proxies,
}

impl Course {
    /// For so many quantities.
    pub(crate) fn new(count: usize, proxies: Proxies) -> Course {
        let list = (0..count).map(|k| Peaks::new(k + 1, TIE, PATIENCE)).collect();
        Course { list, integrals: vec![[0.0; 2]; count], span: 0.0, proxies }
    }

    /// Takes the value of a quantity at a place of the axis.
    pub(crate) fn offer(&mut self, k: usize, place: f64, value: f64) {
        self.list[k].offer(place, value);
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
            self.list[piece.of].piece(&piece, source, at);
        }
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
        self.list.iter().map(|peaks| &peaks.found).filter(|e| e.min <= e.max && !self.is_lost(e.column - 1)).cloned().collect()
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
