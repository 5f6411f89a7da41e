//! Least and greatest values of a motion, with their instants, and its means.
//!
//! Candidates are both ends of every step (so both sides of every jump) and the zeros of the derivative inside (`peaks.rs`). A step whose Σ |c_k| h^k cannot exceed
//! what was found is passed over. Of values that differ by less than the tolerance times the range the first one counts: a periodic motion names its
//! first peak, not the one that rounding favours.
//!
//! The mean is ∫ f dt / ∫ dt over the motion, from the polynomials of the steps: Σ c_k h^(k+1)/(k+1) of a state, the mean of Bernstein's coefficients
//! times its length of every other piece. A jump has no length.

use super::crossings::{self, Bracket};
use super::peaks::{PATIENCE, Peaks};
use super::{Along, bracketed};
use crate::System;
use crate::dataset::{Extreme, Overall};
use crate::proxies::proxy::{Piece, Proxies};
use algebra::sum::two_sum;

/// Whether the slope of Σ c_k τ^k keeps its sign: |c_1| > Σ_{k>1} k |c_k| h^(k-1).
fn surely_monotone(c: &[f64], h: f64) -> bool {
    let rest = c.iter().enumerate().skip(2).rev().fold(0.0, |sum, (k, c_k)| (sum + k as f64 * c_k.abs()) * h);
    c[1].abs() > rest
}

/// What is wanted of an output.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Sought {
    /// Its mean alone.
    Mean,
    /// Its mean and its extremes.
    Extremes,
}

/// Collects extremes of columns.
#[derive(Clone, Debug)]
pub struct Extremes {
    list: Vec<Peaks>,
    /// For each column the output and, when it is one, the state.
    sources: Vec<(usize, Option<usize>)>,
    proxies: Proxies,
    /// Integral of each column, high and low part, and the length of what has a piece.
    integrals: Vec<[f64; 3]>,
    /// Length of the motion.
    span: f64,
    /// Earliest instant of each column with its value.
    first: Vec<(f64, f64)>,
    last: Vec<f64>,
    /// What is wanted of each column.
    sought: Vec<Sought>,
}

/// Equal greatest values differ by the errors of the motion, and the first of them is meant; what a table of a coarse motion shows is
/// not left out for that.
const TIE: f64 = 1e-7;

impl Extremes {
    /// For these outputs of a system.
    pub fn new<S: System + ?Sized>(system: &S, chosen: &[usize], tolerance: f64) -> Extremes {
        Extremes {
            list: (0..chosen.len()).map(|j| Peaks::new(j + 1, tolerance.min(TIE), PATIENCE)).collect(),
            sources: chosen.iter().map(|&i| (i, system.state_of(i))).collect(),
            proxies: Proxies::default(),
            integrals: vec![[0.0; 3]; chosen.len()],
            span: 0.0,
            first: vec![(f64::INFINITY, f64::NAN); chosen.len()],
            last: vec![f64::NAN; chosen.len()],
            sought: vec![Sought::Extremes; chosen.len()],
        }
    }

    /// Of columns whose mean alone is wanted no extremes are sought.
    pub(super) fn seeking(self, sought: impl Iterator<Item = Sought>) -> Extremes {
        Extremes { sought: sought.collect(), ..self }
    }

    /// Takes values of all columns at an instant.
    pub fn offer_row(&mut self, t: f64, values: &[f64]) {
        for (j, value) in values.iter().enumerate() {
            self.offer(j, t, *value);
        }
    }

    fn offer(&mut self, j: usize, t: f64, value: f64) {
        self.begins(j, t, value);
        if let Some(peaks) = self.list.get_mut(j) {
            peaks.offer(t, value);
        }
    }

    fn begins(&mut self, j: usize, t: f64, value: f64) {
        if t < self.first[j].0 {
            self.first[j] = (t, value);
        }
    }

    /// Looks at a step.
    pub(crate) fn look<S: System + ?Sized>(&mut self, along: &mut Along<'_, S>) {
        let h = along.length;
        self.span += h;
        let mut sampled = Vec::new();
        for j in 0..self.sources.len() {
            match self.sources[j] {
                (_, Some(state)) => self.state(j, state, along),
                (output, None) if !sampled.contains(&output) => sampled.push(output),
                (_, None) => {}
            }
        }
        if sampled.is_empty() {
            return;
        }
        let pieces = self.proxies.pieces(along, &sampled, h);
        for piece in pieces {
            let columns = (0..self.sources.len()).filter(|j| self.sources[*j] == (piece.of, None)).collect::<Vec<_>>();
            for j in columns {
                self.piece(j, &piece, along);
            }
        }
    }

    fn state<S: System + ?Sized>(&mut self, j: usize, state: usize, along: &mut Along<'_, S>) {
        let (c, h) = (along.polynomial(state), along.length);
        let area = c.iter().enumerate().skip(1).rev().fold(0.0, |sum, (k, c_k)| (sum + c_k / (k + 1) as f64) * h) * h;
        self.add(j, h, area + along.start(state) * h);
        if self.sought[j] == Sought::Mean {
            return;
        }
        let reach = c[1..].iter().rev().fold(0.0, |sum, c_k| (sum + c_k.abs()) * h);
        let first = along.state(state, 0.0);
        if self.list[j].holds([first - reach, first + reach]) {
            return;
        }
        if c.len() > 1 && surely_monotone(&c, h) {
            self.offer(j, along.time(0.0), first);
            self.offer(j, along.time(h), along.state(state, h));
            return;
        }
        let slope: Vec<f64> = c.iter().enumerate().skip(1).map(|(k, c_k)| k as f64 * c_k).collect();
        let mut value = |tau: f64| slope.iter().rev().fold(0.0, |sum, c_k| sum * tau + c_k);
        let row = crossings::from_powers(&slope, h);
        let mut sign = 0.0;
        for Bracket { from, to, .. } in crossings::crossings(&row, 0.0, &mut sign) {
            let (a, b) = (from * h, to * h);
            let tau = if a < b {
                {
                    let ends = [value(a), value(b)];
                    bracketed(&mut value, (a, ends[0]), (b, ends[1]))
                }
            } else {
                a
            };
            self.offer(j, along.time(tau), along.state(state, tau));
        }
        self.offer(j, along.time(0.0), first);
        self.offer(j, along.time(h), along.state(state, h));
    }

    fn piece<S: System + ?Sized>(&mut self, j: usize, piece: &Piece, along: &mut Along<'_, S>) {
        let width = piece.to - piece.from;
        self.add(j, width, width * piece.row.iter().sum::<f64>() / piece.row.len() as f64);
        if self.sought[j] == Sought::Mean {
            return;
        }
        let clock = along.clock();
        self.begins(j, clock(piece.from), piece.row[0]);
        self.list[j].piece(piece, along, &clock);
    }

    fn add(&mut self, j: usize, length: f64, area: f64) {
        let [high, low, done] = &mut self.integrals[j];
        let (sum, error) = two_sum(*high, area);
        (*high, *low, *done) = (sum, *low + error, *done + length);
    }

    /// Values of all columns where the motion ends.
    pub fn end(&mut self, values: &[f64]) {
        self.last.copy_from_slice(values);
    }

    /// What was found, in the order of the columns; columns without a finite value are left out.
    pub fn found(&self) -> Vec<Extreme> {
        self.list.iter().map(|peaks| &peaks.found).filter(|e| e.min <= e.max).cloned().collect()
    }

    /// Integrals and last values of the columns. An integral is no number where a part of the motion is missing.
    pub fn overall(&self) -> Vec<Overall> {
        let one = |(j, [high, low, done]): (usize, &[f64; 3])| {
            // lengths of steps are summed with rounding
            let whole = (done - self.span).abs() <= 1e-9 * self.span;
            let integral = if whole { high + low } else { f64::NAN };
            Overall { column: j + 1, integral, span: self.span, first: self.first[j].1, last: self.last[j] }
        };
        self.integrals.iter().enumerate().map(one).collect()
    }

    /// Columns that could not be followed everywhere.
    pub fn lost(&self) -> Vec<usize> {
        (0..self.sources.len()).filter(|j| self.sources[*j].1.is_none() && self.proxies.lost().contains(&self.sources[*j].0)).collect()
    }

    /// Rows of outputs sampled.
    pub fn samples(&self) -> u64 {
        self.proxies.samples() + self.list.iter().map(Peaks::samples).sum::<u64>()
    }
}
