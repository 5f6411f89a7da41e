//! A quantity along a step as polynomials through its values.
//!
//! On [a, b] the values at Chebyshev's extreme points u_j = (1 - cos(π j/n))/2 give the coefficients of f = Σ c_k T_k(2u - 1). For an analytic f they
//! fall like ρ^-k, ρ by the nearest singularity; n = 8 is tried, then 16, then the halves. The last two coefficients measure the error: they must fall
//! below `ERROR` of the variation, or be rounding: of the largest value so far, or what the running error analysis of the tape gives. A pulse between
//! the points leaves these coefficients small; so every operation behind the quantity must be seen at the points too (`behind.rs`). A kink or a
//! jump (`abs` in an output) is closed in by halving to `DEEPEST`. What does not converge is given up after `BANK` pieces in the whole run, and said so.
//!
//! *Source*: J. P. Boyd, Solving Transcendental Equations (SIAM 2014), chapter 3 (Chebyshev proxies with subdivision).

use std::collections::BTreeSet;
use std::sync::{Arc, LazyLock};

use program::Behind;

use super::behind::Look;
use super::points::{Points, size, spread};

/// Error relative to the variation.
pub(crate) const ERROR: f64 = 1e-11;
/// Rounding of a value, in units of the last place of the largest.
pub(crate) const ROUNDING: f64 = 32.0 * f64::EPSILON;
/// Share of the step below which a piece is an instant.
const DEEPEST: f64 = 1e-14;
/// Pieces of a quantity that may fail before it is given up; each step gives `EARNED` back.
const BANK: i64 = 8_000;
const EARNED: i64 = 32;

/// What is sampled.
pub(crate) trait Source {
    /// All quantities at tau after the start of the step, then the record of the operations behind them.
    fn sample(&mut self, tau: f64) -> Vec<f64>;
    /// One quantity at tau.
    fn value(&mut self, tau: f64, of: usize) -> f64 {
        self.sample(tau)[of]
    }
    /// Rounding of such a row at tau; empty when unknown.
    fn rounding(&mut self, tau: f64) -> Vec<f64>;
    /// Number of quantities, and the operations behind them with places in the record.
    fn behind(&mut self) -> (usize, Arc<Behind>);
    /// Shortest difference of two instants.
    fn resolution(&self) -> f64;
}

/// Quantities that are known by their values alone.
pub(crate) struct Values<F>(pub F);

impl<F: FnMut(f64) -> Vec<f64>> Source for Values<F> {
    fn sample(&mut self, tau: f64) -> Vec<f64> {
        self.0(tau)
    }
    fn rounding(&mut self, tau: f64) -> Vec<f64> {
        self.sample(tau).iter().map(|v| f64::EPSILON * v.abs()).collect()
    }
    fn behind(&mut self) -> (usize, Arc<Behind>) {
        (0, Arc::default())
    }
    fn resolution(&self) -> f64 {
        0.0
    }
}

/// What is sampled, from a place on.
pub(crate) struct Window<'a, S: ?Sized> {
    source: &'a mut S,
    from: f64,
}

impl<'a, S: Source + ?Sized> Window<'a, S> {
    /// From this place on.
    pub(crate) fn new(source: &'a mut S, from: f64) -> Window<'a, S> {
        Window { source, from }
    }
}

impl<S: Source + ?Sized> Source for Window<'_, S> {
    fn sample(&mut self, tau: f64) -> Vec<f64> {
        self.source.sample(self.from + tau)
    }
    fn value(&mut self, tau: f64, of: usize) -> f64 {
        self.source.value(self.from + tau, of)
    }
    fn rounding(&mut self, tau: f64) -> Vec<f64> {
        self.source.rounding(self.from + tau)
    }
    fn behind(&mut self) -> (usize, Arc<Behind>) {
        self.source.behind()
    }
    fn resolution(&self) -> f64 {
        self.source.resolution()
    }
}

/// A polynomial on a part of the step.
#[derive(Clone, Debug)]
pub struct Piece {
    /// Which quantity.
    pub of: usize,
    /// Where it begins.
    pub from: f64,
    /// Where it ends.
    pub to: f64,
    /// Bernstein's coefficients over the part; two when it is a line or an instant.
    pub row: Vec<f64>,
    /// What its values may be off by.
    pub error: f64,
}

/// Makes proxies; what it remembers is that of one motion.
#[derive(Clone, Debug)]
pub struct Proxies {
    coarse: &'static Points,
    fine: &'static Points,
    /// Largest magnitude so far of each place of a row.
    largest: Vec<f64>,
    /// Pieces that may still fail, by quantity.
    bank: Vec<i64>,
    /// Quantities that were given up somewhere.
    lost: BTreeSet<usize>,
    /// Rows that were sampled.
    samples: u64,
}

static COARSE: LazyLock<Points> = LazyLock::new(|| Points::new(8));
static FINE: LazyLock<Points> = LazyLock::new(|| Points::new(16));

impl Default for Proxies {
    fn default() -> Proxies {
        Proxies { coarse: &COARSE, fine: &FINE, largest: Vec::new(), bank: Vec::new(), lost: BTreeSet::new(), samples: 0 }
    }
}

/// A part of the step under work.
struct Part {
    from: f64,
    to: f64,
    /// Quantities still without a piece there.
    left: Vec<usize>,
}

impl Proxies {
    /// For what is costly to sample: so many pieces may fail.
    pub(crate) fn sparing(pieces: i64, quantities: usize) -> Proxies {
        Proxies { bank: vec![pieces; quantities], ..Proxies::default() }
    }

    /// Pieces of the quantities `wanted` over [0, h], each quantity's in order of time. Values that are not finite give no piece.
    pub(crate) fn pieces(&mut self, source: &mut dyn Source, wanted: &[usize], h: f64) -> Vec<Piece> {
        let mut out: Vec<Piece> = Vec::new();
        let behind = source.behind();
        for &w in wanted {
            self.bank.resize(self.bank.len().max(w + 1), BANK);
            self.bank[w] = (self.bank[w] + EARNED).min(BANK);
        }
        let shortest = (DEEPEST * h).max(source.resolution());
        let mut open = vec![Part { from: 0.0, to: h, left: wanted.to_vec() }];
        while let Some(mut part) = open.pop() {
            let coarse = self.values(8, source, &part, &[]);
            self.remember(&coarse);
            self.leave_out(&coarse, &mut part);
            self.take((&coarse, &[]), &behind, &mut part, &mut out);
            if part.left.is_empty() {
                continue;
            }
            let fine = self.values(16, source, &part, &coarse);
            self.remember(&fine);
            self.take((&fine, &[]), &behind, &mut part, &mut out);
            if part.left.is_empty() {
                continue;
            }
            // beside a pole or a cusp it is large at one end only
            let [mut rounding, other] = [source.rounding(part.to), source.rounding(part.from)];
            rounding.iter_mut().zip(other).for_each(|(end, other)| *end = end.min(other));
            if !rounding.is_empty() {
                self.take((&fine, &rounding), &behind, &mut part, &mut out);
            }
            if part.to - part.from <= shortest {
                self.end(&fine, &part, &mut out);
                continue;
            }
            self.give_up(&fine, &mut part, &mut out);
            if !part.left.is_empty() {
                let middle = 0.5 * (part.from + part.to);
                open.push(Part { from: middle, to: part.to, left: part.left.clone() });
                open.push(Part { from: part.from, to: middle, left: part.left });
            }
        }
        out
    }

    /// Quantities that could not be followed everywhere.
    pub(crate) fn lost(&self) -> &BTreeSet<usize> {
        &self.lost
    }

    /// Rows sampled so far.
    pub(crate) fn samples(&self) -> u64 {
        self.samples
    }

    /// Rows of values at the points; every second one of the finer is known.
    fn values(&mut self, last: usize, source: &mut dyn Source, part: &Part, known: &[Vec<f64>]) -> Vec<Vec<f64>> {
        let (u, samples) = (if last == self.coarse.n { &self.coarse.u } else { &self.fine.u }, &mut self.samples);
        let place = |j: usize| if j == last { part.to } else { part.from + (part.to - part.from) * u[j] };
        let mut row = |j: usize| match known.get(j / 2).filter(|_| j.is_multiple_of(2)) {
            Some(row) => row.clone(),
            None => {
                *samples += 1;
                source.sample(place(j))
            }
        };
        (0..=last).map(&mut row).collect()
    }

    fn remember(&mut self, rows: &[Vec<f64>]) {
        for row in rows {
            self.largest.resize(self.largest.len().max(row.len()), 0.0);
            for (largest, v) in self.largest.iter_mut().zip(row).filter(|(_, v)| v.is_finite()) {
                *largest = largest.max(v.abs());
            }
        }
    }

    /// Adds the pieces of the quantities that are exact enough, and takes them off the part.
    fn take(&self, (rows, rounding): (&[Vec<f64>], &[f64]), (first, behind): &(usize, Arc<Behind>), part: &mut Part, out: &mut Vec<Piece>) {
        let points = if rows.len() == self.coarse.n + 1 { self.coarse } else { self.fine };
        let noise = |i: usize| (ROUNDING * self.largest[i]).max(rounding.get(i).copied().filter(|r| r.is_finite()).unwrap_or(0.0));
        let mut look = Look::new(points, rows, behind, *first, ERROR);
        part.left.retain(|&w| {
            let f: Vec<f64> = rows.iter().map(|row| row[w]).collect();
            let (tail, small) = (points.tail(&f), ERROR * spread(&f));
            let exact = f.iter().all(|v| v.is_finite()) && tail <= small.max(noise(w));
            let seen = exact && behind.of.get(w).is_none_or(|nodes| nodes.iter().all(|n| look.sees(*n, &noise)));
            if seen {
                out.push(Piece {
                    of: w,
                    from: part.from,
                    to: part.to,
                    row: points.row(&f),
                    error: tail.max(small).max(ROUNDING * size(&f)),
                });
            }
            !seen
        });
    }

    /// Quantities without a value anywhere on a part.
    fn leave_out(&mut self, rows: &[Vec<f64>], part: &mut Part) {
        let lost = &mut self.lost;
        part.left.retain(|&w| {
            let absent = rows.iter().all(|row| row[w].is_nan());
            if absent {
                lost.insert(w);
            }
            !absent
        });
    }

    /// An instant: a jump has its two ends.
    fn end(&mut self, rows: &[Vec<f64>], part: &Part, out: &mut Vec<Piece>) {
        for &w in &part.left {
            let ends = vec![rows[0][w], rows[rows.len() - 1][w]];
            if ends.iter().all(|v| v.is_finite()) {
                out.push(Piece { of: w, from: part.from, to: part.to, row: ends, error: 0.0 });
            } else {
                self.lost.insert(w);
            }
        }
    }

    /// Quantities that have failed too often are taken as they are.
    fn give_up(&mut self, rows: &[Vec<f64>], part: &mut Part, out: &mut Vec<Piece>) {
        let points = self.fine;
        let (bank, lost) = (&mut self.bank, &mut self.lost);
        part.left.retain(|&w| {
            bank[w] -= 1;
            if bank[w] > 0 {
                return true;
            }
            lost.insert(w);
            let f: Vec<f64> = rows.iter().map(|row| row[w]).collect();
            if f.iter().all(|v| v.is_finite()) {
                out.push(Piece { of: w, from: part.from, to: part.to, row: points.row(&f), error: points.tail(&f) });
            }
            false
        });
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::marks::crossings::value;

    #[test]
    fn a_smooth_function_is_met_to_rounding_and_a_kink_is_closed_in() {
        let f = |t: f64| vec![(3.0 * t).sin() / (1.2 + t.cos()), (t - 0.3).abs()];
        let pieces = Proxies::default().pieces(&mut Values(f), &[0, 1], 2.0);
        for piece in &pieces {
            for k in 0..=10 {
                let u = f64::from(k) / 10.0;
                let t = piece.from + (piece.to - piece.from) * u;
                let off = (value(&piece.row, u) - f(t)[piece.of]).abs();
                // ten times the error that a piece is made with
                assert!(off < 1e-10, "{} at {t}: {off}", piece.of);
            }
        }
        assert!(pieces.iter().filter(|p| p.of == 1).count() > 30);
        assert!(pieces.iter().filter(|p| p.of == 0).count() <= 8);
    }

    #[test]
    fn noise_costs_a_bounded_number_of_pieces() {
        let mut k = 0_u64;
        let f = |_: f64| {
            k = k.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            vec![(k >> 40) as f64]
        };
        let mut proxies = Proxies { bank: vec![300], ..Proxies::default() };
        let pieces = proxies.pieces(&mut Values(f), &[0], 1.0);
        assert!(pieces.len() < 400 && proxies.lost().contains(&0), "{}", pieces.len());
    }
}
