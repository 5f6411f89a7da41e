//! Whether the answer of the rest itself is stable while the angle turns uniformly: multipliers of M δq'' + C(t) δq' + K(t) δq = 0 over a turn.
//!
//! Gauss's rule with two stages (order 4) does not let a quick, damped motion grow, however long its steps are. *Source*: E. Hairer, G. Wanner, Solving Ordinary Differential Equations II, IV.5.

use super::turn::{Place, Turn, Turning};
use algebra::complex;
use algebra::eigen::general;
use algebra::elementary;
use algebra::lu::Lu;
use std::f64::consts::TAU;

/// Steps of a turn for each instant at which the answer is known.
const FINER: usize = 4;
/// A multiplier beyond 1 by less is on the circle: what the steps err by is far below.
const ON_CIRCLE: f64 = 1e-6;

/// Harmonics of an answer.
struct Series {
    m: usize,
    /// For each coordinate and harmonic, cosine and sine.
    terms: Vec<Vec<[f64; 2]>>,
}

impl Series {
    fn of(values: &[f64], m: usize) -> Series {
        let n = values.len() / m;
        let term = |j: usize, k: usize| {
            let sums = (0..n).fold([0.0, 0.0], |[c, s], i| {
                let (sin, cos) = elementary::sin_cos(TAU * (i * k % n) as f64 / n as f64);
                [c + values[i * m + j] * cos, s + values[i * m + j] * sin]
            });
            let share = if k == 0 { 1.0 } else { 2.0 } / n as f64;
            sums.map(|v| share * v)
        };
        Series { m, terms: (0..m).map(|j| (0..=n / 2).map(|k| term(j, k)).collect()).collect() }
    }

    /// q, q', q'' at an angle.
    fn at(&self, angle: f64, speed: f64) -> [Vec<f64>; 3] {
        let mut out = [vec![0.0; self.m], vec![0.0; self.m], vec![0.0; self.m]];
        for (j, terms) in self.terms.iter().enumerate() {
            for (k, [c, s]) in terms.iter().enumerate() {
                let (rate, (sin, cos)) = (k as f64 * speed, elementary::sin_cos(k as f64 * angle));
                let value = c * cos + s * sin;
                out[0][j] += value;
                out[1][j] += rate * (s * cos - c * sin);
                out[2][j] -= rate * rate * value;
            }
        }
        out
    }
}

/// Whether disturbances of the rest do not grow; none where its masses are singular.
pub(super) fn settles<T: Turning + ?Sized>(machine: &T, turn: &Turn) -> Option<bool> {
    let m = machine.others();
    if m == 0 {
        return Some(true);
    }
    let series = Series::of(&turn.values, m);
    let steps = FINER * (turn.values.len() / m);
    let h = TAU / turn.speed.abs() / steps as f64;
    let root = 3.0_f64.sqrt() / 6.0;
    let size = 2 * m;
    let mut whole: Vec<f64> = (0..size * size).map(|e| if e / size == e % size { 1.0 } else { 0.0 }).collect();
    for k in 0..steps {
        let stage = |c: f64| rates(machine, &series, (turn.speed * h * (k as f64 + c), turn.speed));
        let [a, b] = [stage(0.5 - root)?, stage(0.5 + root)?];
        let weights = [[0.25, 0.25 - root], [0.25 + root, 0.25]];
        let stages = 2 * size;
        let entry = |e: usize| {
            let (row, column) = (e / stages, e % stages);
            let (i, j) = (row / size, column / size);
            let slope = if i == 0 { &a } else { &b };
            let unit = if row == column { 1.0 } else { 0.0 };
            unit - h * weights[i][j] * slope[row % size * size + column % size]
        };
        let lu = Lu::exact(&(0..stages * stages).map(entry).collect::<Vec<f64>>(), stages)?;
        let mut next = whole.clone();
        for column in 0..size {
            let x: Vec<f64> = (0..size).map(|i| whole[i * size + column]).collect();
            let of = |slope: &[f64]| -> Vec<f64> { slope.chunks(size).map(|row| row.iter().zip(&x).map(|(a, x)| a * x).sum()).collect() };
            let found = lu.solve(&[of(&a), of(&b)].concat())?;
            (0..size).for_each(|i| next[i * size + column] += 0.5 * h * (found[i] + found[size + i]));
        }
        whole = next;
    }
    let values = general(size, &whole).ok()?.values;
    Some(values.iter().all(|z| complex::abs(*z) <= 1.0 + ON_CIRCLE))
}

/// Rates of (δq, δq') by them, row by row.
fn rates<T: Turning + ?Sized>(machine: &T, series: &Series, (angle, speed): (f64, f64)) -> Option<Vec<f64>> {
    let m = series.m;
    let [values, rates, accelerations] = series.at(angle, speed);
    let slopes = machine.at(&Place { angle, speed, values: &values, rates: &rates, accelerations: &accelerations }).slopes;
    companion(&slopes, m)
}

/// The same from the derivatives of the equations of the rest by q, q', q''.
pub(super) fn companion(slopes: &[f64], m: usize) -> Option<Vec<f64>> {
    let of = |order: usize| -> Vec<f64> { (0..m * m).map(|e| slopes[(e / m * 3 + order) * m + e % m]).collect() };
    let mass = Lu::exact(&of(2), m)?;
    let (stiffness, damping) = (of(0), of(1));
    let mut out = vec![0.0; 4 * m * m];
    for column in 0..2 * m {
        let from = if column < m { &stiffness } else { &damping };
        let right: Vec<f64> = (0..m).map(|i| -from[i * m + column % m]).collect();
        let found = mass.solve(&right)?;
        (0..m).for_each(|i| out[(m + i) * 2 * m + column] = found[i]);
    }
    (0..m).for_each(|i| out[i * 2 * m + m + i] = 1.0);
    Some(out)
}
