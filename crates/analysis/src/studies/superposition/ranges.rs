//! The greatest and the least value of an output over a period of all loads together.

use super::{Care, Motion, Range, Run};
use crate::Fault;
use crate::linear::{Place, Seen};
use crate::studies::amplitudes::Amplitudes;
use crate::studies::free_motion::settled;
use crate::studies::modes::Complex;
use crate::studies::response::{gain, magnitude};
use crate::waveform::{NODES, RULE, series};
use algebra::arrange::Arrange;
use algebra::double::Double;
use algebra::elementary;
use std::f64::consts::TAU;

/// Share of a curve's range that a maximum may stand above the nodes beside it: 1 - cos 0.31 for a turn to a panel, halved by the range.
const BETWEEN: f64 = 0.03;
/// Panels that are searched for an extreme at most.
const MOST_PANELS: usize = 256;

impl<'f, 'm> Run<'f, 'm> {
    /// The range of an output.
    pub(super) fn range(&self, (output, s): (usize, &Seen), motion: &Motion) -> Result<Range, Fault> {
        if motion.poles.iter().any(|(nu, pole)| self.resounds(s, *nu, pole)) {
            let (above, below) = ((f64::INFINITY, f64::NAN), (f64::NEG_INFINITY, f64::NAN));
            return Ok(Range { mean: s.mean, max: above, min: below, largest: above });
        }
        let reduce = |g: &[f64]| -> Vec<f64> {
            let Some((z, k)) = &self.z else { return g.to_vec() };
            if let Some(z) = &self.exact {
                let one = |c: usize| (0..self.full).fold(Double::default(), |s, i| s.add_times(g[i], z[i * k + c])).round();
                return (0..*k).map(one).collect();
            }
            (0..*k).map(|c| (0..self.full).map(|i| g[i] * z[i * k + c]).sum()).collect()
        };
        let mut values = vec![0.0; self.panels.count() * NODES];
        for (g, of) in [(&s.by_place, &motion.places), (&s.by_rate, &motion.rates), (&s.by_acceleration, &motion.accelerations)] {
            for (g, row) in reduce(g).iter().zip(of).filter(|(g, _)| **g != 0.0) {
                values.iter_mut().zip(row).for_each(|(v, x)| *v += g * x);
            }
        }
        for f in &motion.free {
            for (g, row) in [(&s.by_place, &f.place), (&s.by_rate, &f.rate)] {
                // what the free motion does not move must not see it
                let moved = settled(reduce(g).iter().zip(&f.z).map(|(g, z)| g * z));
                values.iter_mut().zip(row).for_each(|(v, a)| *v += moved * a);
            }
        }
        let formula = if self.care == Care::Number { self.by_formula(output, motion)? } else { None };
        let mut mean = s.mean;
        if let Some(curve) = formula {
            values = curve;
            let level = values.iter().zip(self.panels.weights()).map(|(v, w)| v * w).sum::<f64>() / TAU;
            values.iter_mut().for_each(|v| *v -= level);
            mean = level;
        }
        self.add_direct(s, &mut values)?;
        let high = self.extreme(&values, 1.0);
        let low = self.extreme(&values, -1.0);
        let largest = farther(high, (-low.0, low.1));
        if self.forced.observer.by_reactions.contains(&output) {
            // a square, an absolute value or a quotient of reactions has no line within real amplitudes, and no formula of places gives it
            let none = (f64::NAN, f64::NAN);
            return Ok(Range { mean: f64::NAN, max: none, min: none, largest: none });
        }
        Ok(Range { mean, max: (mean + high.0, high.1), min: (mean + low.0, low.1), largest })
    }

    /// An output that leaves its straight line, by its formula along the superposed motion.
    fn by_formula(&self, output: usize, motion: &Motion) -> Result<Option<Vec<f64>>, Fault> {
        let Some(formulas) = self.forced.formulas.as_ref().filter(|_| self.forced.bent.contains(&output)) else { return Ok(None) };
        let back = |v: &[Vec<f64>], x: usize| -> Vec<f64> {
            let Some((z, k)) = &self.z else { return v.iter().map(|row| row[x]).collect() };
            (0..self.full).map(|i| (0..*k).map(|c| z[i * k + c] * v[c][x]).sum()).collect()
        };
        let rest = &self.forced.place;
        let (moved, rates) = (motion.whole_places(), motion.whole_rates());
        let at = |x: usize| Place {
            q: rest.q.iter().zip(back(&moved, x)).map(|(q, d)| q + d).collect(),
            rates: back(&rates, x),
            accelerations: back(&motion.accelerations, x),
            ..rest.clone()
        };
        let places: Vec<Place> = (0..self.panels.count() * NODES).map(at).collect();
        let values = self.forced.machine.values_at(formulas, &places)?;
        Ok(Some(values.into_iter().map(|v| v[output]).collect()))
    }

    pub(super) fn resounds(&self, s: &Seen, nu: f64, poles: &[Vec<Complex>]) -> bool {
        let back = |pole: &[Complex], z: &[f64], k: usize| -> Vec<Complex> {
            let entry =
                |i: usize| pole.iter().enumerate().fold((0.0, 0.0), |t, (c, v)| (t.0 + z[i * k + c] * v.0, t.1 + z[i * k + c] * v.1));
            (0..self.full).map(entry).collect()
        };
        let whole = |pole: &Vec<Complex>| self.z.as_ref().map_or_else(|| pole.clone(), |(z, k)| back(pole, z, *k));
        let x = Amplitudes { regular: vec![(0.0, 0.0); self.full], poles: poles.iter().map(whole).collect(), ..Amplitudes::default() };
        !magnitude(x.seen(&gain(s, nu))).is_finite()
    }

    /// What the output does by itself at multiples of the common frequency.
    fn add_direct(&self, s: &Seen, values: &mut [f64]) -> Result<(), Fault> {
        let nodes = self.panels.nodes();
        let whole =
            // a multiple of the common frequency but for rounding
            |rate: f64| Some((rate / self.rate).round()).filter(|k| k.abs() >= 1.0 && (rate - k * self.rate).abs() <= 1e-9 * rate.abs());
        for (rate, c, s) in &s.waves {
            let Some(k) = whole(*rate) else { continue };
            values.iter_mut().zip(&nodes).for_each(|(v, x)| *v += c * elementary::cos(k * x) + s * elementary::sin(k * x));
        }
        let rates = self.forced.form_rates()?;
        for (form, factor) in &s.forms {
            let Some(rate) = rates.get(*form).copied().filter(|r| whole(*r).is_some()) else { continue };
            values.iter_mut().zip(self.waveform(*form, rate)?).for_each(|(v, w)| *v += factor * w);
        }
        Ok(())
    }

    /// Largest value (sign 1) or least (-1) over the period, and its instant.
    fn extreme(&self, values: &[f64], sign: f64) -> (f64, f64) {
        let peak = |v: &[f64]| v.iter().fold(f64::NEG_INFINITY, |m, x| m.max(sign * x));
        let mut order: Vec<usize> = (0..self.panels.count()).collect();
        let peaks: Vec<f64> = values.chunks(NODES).map(peak).collect();
        order.arrange_by(|a, b| peaks[*b].total_cmp(&peaks[*a]).then(a.cmp(b)));
        let mut best = (f64::NEG_INFINITY, 0.0);
        // between two nodes a sine rises by less than this share of its range
        let lowest = peaks.iter().copied().chain(values.iter().map(|v| sign * v)).fold(f64::INFINITY, f64::min);
        let highest_node = order.first().map_or(0.0, |p| peaks[*p]);
        let worth = |p: &usize| peaks[*p] >= highest_node - BETWEEN * (highest_node - lowest);
        for panel in order.into_iter().take_while(worth).take(MOST_PANELS) {
            let c = RULE.coefficients(&values[panel * NODES..(panel + 1) * NODES]);
            let (a, b) = (self.panels.edges[panel], self.panels.edges[panel + 1]);
            let (x, v) = highest(&mut |x| sign * series(&c, x));
            // equal to rounding: the earlier instant
            let place = 0.5 * (a + b) + 0.5 * (b - a) * x;
            // equal to rounding of a sum over the harmonics
            let same = (v - best.0).abs() <= 1e-13 * v.abs();
            if (!same && v > best.0) || (same && place < best.1) {
                best = (v, place);
            }
        }
        (sign * best.0, best.1 / self.rate)
    }
}

/// The larger of two values with their instants; of equal ones, up to rounding, the earlier.
fn farther(a: (f64, f64), b: (f64, f64)) -> (f64, f64) {
    // equal to rounding of a sum over the harmonics
    let equal = (a.0 - b.0).abs() <= 1e-13 * a.0.abs().max(b.0.abs());
    let first = if equal { a.1 <= b.1 } else { a.0 >= b.0 };
    if first { a } else { b }
}

/// Where a smooth function on -1...1 is largest.
fn highest(f: &mut dyn FnMut(f64) -> f64) -> (f64, f64) {
    let place = |i: usize| -1.0 + 2.0 * i as f64 / 64.0;
    let best = (0..=64).map(|i| (place(i), f(place(i)))).fold((-1.0, f64::NEG_INFINITY), |b, e| if e.1 > b.1 { e } else { b });
    let (mut a, mut b) = ((best.0 - 2.0 / 64.0).max(-1.0), (best.0 + 2.0 / 64.0).min(1.0));
    for _ in 0..60 {
        let (x, y) = (a + 0.382 * (b - a), a + 0.618 * (b - a));
        if f(x) >= f(y) { b = y } else { a = x }
    }
    let x = 0.5 * (a + b);
    let v = f(x);
    if v > best.1 { (x, v) } else { best }
}
