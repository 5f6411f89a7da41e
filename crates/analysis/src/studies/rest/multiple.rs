//! A place of rest that is a multiple zero of the force, to its last digits.
//!
//! Beside a zero of order m the force c (q - q₀)^m is below its rounding, or below any force that counts, over a stretch whose width is an m-th root: Newton's method ends
//! anywhere in it. The derivative of order m - 1 has a simple zero at q₀:
//!
//! ```text
//! h^(m-1)(q₀) = 0,   h^(m)(q₀) ≠ 0,   h^(j)(q₀) = 0 but for rounding, j < m
//! ```
//!
//! and that is where the place is. m is the first order for which this holds. For one coordinate; of several the force of higher order stands along a curve.
//!
//! *Source*: J. Stoer, R. Bulirsch, Introduction to Numerical Analysis, 5.3 (multiple zeros).

use super::degenerate::degenerate;
use crate::linear::{LinearMachine, Place};
use algebra::double::Double;

/// Highest order that is looked for: (1 - cos q)⁶ is of order 11.
const HIGHEST: usize = 16;
/// Nodes of a derivative beyond which the next one is not asked for.
const LONGEST: usize = 5000;
/// Steps of Newton's method: it doubles the digits of a simple zero, and gives up elsewhere.
const STEPS: usize = 40;
/// Share of the place below which a step ends them: a hundredth of the last digit of a single number.
const SETTLED: f64 = 1e-18;
/// How far the place may be from where Newton's method has ended, as a share of its size (of 1 where it is zero).
const NEAR: f64 = 0.2;
/// The way from there to the place, with room to spare.
const BEYOND: f64 = 4.0;
/// Share of the term of order m, over that distance, below which terms of lower order are rounding of the place: at a zero of order m - 1 they are of its size.
const VANISHED: f64 = 1e-9;
/// Share of terms of higher order that the term of order m has at least: one that is rounding has less.
const LEADS: f64 = 1e-3;

/// The place next to `q`; none where it is a simple zero or has more coordinates, or where the force is not known in twice the digits.
pub fn settled(machine: &mut LinearMachine, q: f64) -> Option<f64> {
    if machine.coordinates().len() != 1 || !machine.linear().conditions.is_empty() {
        return None;
    }
    degenerate(machine, &Place::rest(&[q]))?;
    let series = machine.force_series(HIGHEST, LONGEST);
    let size = NEAR * if q == 0.0 { 1.0 } else { q.abs().max(NEAR) };
    (2..series.len().saturating_sub(1)).find_map(|order| {
        let found = simple(machine, [series[order - 1], series[order]], Double::from(q))?;
        let terms = terms_over(machine, &series, (found, size))?;
        let moved = (found.round() - q).abs();
        // over the way to it as well: a machine may be far smaller than that distance
        let way = terms_over(machine, &series[..=order], (found, BEYOND * moved))?;
        let near = moved == 0.0 || moved <= size && way[..order].iter().all(|t| *t <= VANISHED * way[order]);
        let zero = terms[..order].iter().all(|t| *t <= VANISHED * terms[order]);
        let leads = terms[order + 1..].iter().all(|t| LEADS * t <= terms[order]);
        // a force of its own rounding is zero
        (near && zero && leads && terms[order] > 0.0).then(|| settle(found, size))
    })
}

/// A zero that is rounding of the distance it was looked for over is one at 0.
fn settle(found: Double, size: f64) -> f64 {
    let value = found.round();
    if value.abs() <= f64::EPSILON * size { 0.0 } else { value }
}

/// A simple zero by Newton's method.
fn simple(machine: &LinearMachine, list: [symbolic::Expr; 2], start: Double) -> Option<Double> {
    let mut q = start;
    for _ in 0..STEPS {
        let values = machine.series_at(&list, q)?;
        if values[0].is_zero() {
            return Some(q);
        }
        let step = values[0].over(values[1]);
        if !step.round().is_finite() {
            return None;
        }
        q = q.less(step);
        if step.round().abs() <= SETTLED * q.round().abs().max(start.round().abs()) {
            return Some(q);
        }
    }
    None
}

/// |h^(j)| size^j / j!.
fn terms_over(machine: &LinearMachine, series: &[symbolic::Expr], (q, size): (Double, f64)) -> Option<Vec<f64>> {
    let values = machine.series_at(series, q)?;
    let mut factor = 1.0;
    let term = |(j, value): (usize, &Double)| {
        factor *= if j == 0 { 1.0 } else { size / j as f64 };
        value.round().abs() * factor
    };
    Some(values.iter().enumerate().map(term).collect())
}
