//! Speeds at which a linear rest resonates: a harmonic of the turn meets one of its natural frequencies.
//!
//! ```text
//! M q'' + C q' + K q = 0, the mean over a turn:   s = -δ ± iν      kΩ = ν(Ω)      half width δ/k
//! ```
//!
//! Between two speeds that are looked at a resonance may lie that neither of them shows.

use super::settled::companion;
use super::turn::{Place, Turning};
use algebra::eigen::general;
use algebra::elementary;
use std::f64::consts::TAU;

/// Highest harmonic of the turn, and instants that tell it from the others.
const HARMONICS: usize = 8;
const INSTANTS: usize = 2 * HARMONICS + 1;
/// Share of the largest value of a row below which what varies over a turn is rounding of its terms.
const ROUNDING: f64 = 1e-12;
/// Places beside a resonance, in half widths: the top, the flanks, where they are steepest, and the feet.
const PLACES: [f64; 7] = [-3.0, -1.0, -0.5, 0.0, 0.5, 1.0, 3.0];
/// Steps to the speed at which a frequency that depends on it is met: it changes by a small share of the speed.
const STEPS: usize = 8;
/// Half width, beside the speed, below which nothing damps: there is no answer at the top.
const NARROWEST: f64 = 1e-9;

/// Speeds on and beside the resonances between ascending ones.
pub(super) fn resonances<T: Turning + ?Sized>(machine: &T, speeds: &[f64]) -> Vec<f64> {
    let (Some(first), Some(last)) = (speeds.first(), speeds.last()) else { return Vec::new() };
    let known: Vec<Vec<[f64; 2]>> = speeds.iter().map(|speed| own(machine, *speed)).collect();
    let mut list = Vec::new();
    for k in harmonics(machine, *first) {
        for (ends, found) in speeds.windows(2).zip(known.windows(2)) {
            for (a, b) in found[0].iter().zip(&found[1]) {
                let off = [(a, ends[0]), (b, ends[1])].map(|(own, speed)| own[0] - k * speed.abs());
                if off[0] * off[1] <= 0.0 && off[0] != off[1] {
                    let guess = ends[0] + (ends[1] - ends[0]) * off[0] / (off[0] - off[1]);
                    list.extend(beside(machine, k, guess));
                }
            }
        }
    }
    list.retain(|speed| speed > first && speed < last);
    list
}

/// Places about the resonance that a speed is near to.
fn beside<T: Turning + ?Sized>(machine: &T, k: f64, mut speed: f64) -> Vec<f64> {
    let mut width = 0.0;
    for _ in 0..STEPS {
        let off = |own: &[f64; 2]| (own[0] - k * speed.abs()).abs();
        let Some(own) = own(machine, speed).into_iter().min_by(|a, b| off(a).total_cmp(&off(b))) else { return Vec::new() };
        (speed, width) = (own[0] / k * speed.signum(), own[1].abs() / k);
    }
    if width > NARROWEST * speed.abs() { PLACES.map(|place| speed + place * width).into() } else { Vec::new() }
}

/// ν and δ of the mean of the equations of the rest over a turn, by ascending ν.
fn own<T: Turning + ?Sized>(machine: &T, speed: f64) -> Vec<[f64; 2]> {
    let m = machine.others();
    let mut mean = vec![0.0; 3 * m * m];
    for (slopes, _) in around(machine, speed) {
        mean.iter_mut().zip(&slopes).for_each(|(sum, v)| *sum += v / INSTANTS as f64);
    }
    let values = companion(&mean, m).and_then(|matrix| general(2 * m, &matrix).ok()).map(|found| found.values).unwrap_or_default();
    let mut list: Vec<[f64; 2]> = values.iter().filter(|s| s.im > 0.0).map(|s| [s.im, s.re]).collect();
    list.sort_by(|a, b| a[0].total_cmp(&b[0]));
    list
}

/// Derivatives and residuals of the rest, held still at zero, at instants of a turn.
fn around<T: Turning + ?Sized>(machine: &T, speed: f64) -> Vec<(Vec<f64>, Vec<f64>)> {
    let still = vec![0.0; machine.others()];
    let at = |k: usize| {
        let angle = TAU * k as f64 / INSTANTS as f64;
        let instant = machine.at(&Place { angle, speed, values: &still, rates: &still, accelerations: &still });
        (instant.slopes, instant.residuals[..still.len()].to_vec())
    };
    (0..INSTANTS).map(at).collect()
}

/// Harmonics of the turn that may excite the rest: those of its loads, or all where its coefficients vary too.
fn harmonics<T: Turning + ?Sized>(machine: &T, speed: f64) -> Vec<f64> {
    let all = around(machine, speed);
    let is_there = |k: usize, row: &dyn Fn(usize) -> f64| {
        let sums = (0..INSTANTS).fold([0.0, 0.0, 0.0], |[c, s, size], i| {
            let (sin, cos) = elementary::sin_cos(TAU * (i * k % INSTANTS) as f64 / INSTANTS as f64);
            [c + row(i) * cos, s + row(i) * sin, size + row(i).abs()]
        });
        elementary::hypot(sums[0], sums[1]) > ROUNDING * sums[2]
    };
    let count = |list: &[f64]| 0..list.len();
    let varies = count(&all[0].0).any(|e| (1..=HARMONICS).any(|k| is_there(k, &|i| all[i].0[e])));
    let loaded = |k: &usize| varies || count(&all[0].1).any(|e| is_there(*k, &|i| all[i].1[e]));
    (1..=HARMONICS).filter(loaded).map(|k| k as f64).collect()
}
