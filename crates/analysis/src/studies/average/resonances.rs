//! Speeds at which a linear rest resonates: a harmonic of the turn meets one of its natural frequencies.
//!
//! ```text
//! M q'' + C q' + K q = 0, the mean over a turn:   s = -δ ± iν      kΩ = ν(Ω)      half width δ/k
//! ```
//!
//! Between two speeds that are looked at a resonance may lie that neither of them shows.

use super::settled::companion;
use super::turn::{Grid, Place, Turning};
use crate::marks::bracketed;
use algebra::eigen::general;
use algebra::elementary;
use algebra::lu::Lu;
use std::f64::consts::TAU;

/// Highest harmonic of the turn, and instants that tell it from the others.
const HARMONICS: usize = 8;
const INSTANTS: usize = 2 * HARMONICS + 1;
/// Share of the largest value of a row below which what varies over a turn is rounding of its terms.
const ROUNDING: f64 = 1e-12;
/// Places about the top of a resonance, in half widths: near it, where N - V has its extremes.
const TOP: [f64; 7] = [0.0, 0.25, 0.5, 0.75, 1.0, 1.4, 2.0];
/// How much farther each place beyond is. Beside a pole p of its answer the moment is a function of (Ω - p)/width; between places at distances from p in this ratio it is what a few halvings resolve, however narrow the resonance is.
const FARTHER: f64 = 1.6;
/// Parts of the range of speeds in which the poles of varying coefficients are looked for.
const WINDOWS: usize = 16;
/// Share of the speed over which A(Ω) is taken as a parabola, which it is where damping is linear and stiffness quadratic in the speed.
const PARABOLA: f64 = 0.1;
/// How often a pole is sought anew.
const POLISHED: usize = 3;
/// Distance, beside the speed, to which places close in on a real pole.
const CLOSEST: f64 = 1e-8;
/// Half width, beside the speed, below which nothing damps: there is no answer at the top.
const NARROWEST: f64 = 1e-9;

/// Speeds on and beside the resonances between ascending ones, from their tops to where the distance of the speeds is that from them.
pub(super) fn resonances<T: Turning + ?Sized>(machine: &T, speeds: &[f64]) -> Vec<f64> {
    let (Some(first), Some(last)) = (speeds.first(), speeds.last()) else { return Vec::new() };
    let mut list = Vec::new();
    if varies(machine, *first) {
        for ends in windows(speeds) {
            list.extend(poles(machine, ends).into_iter().flat_map(|[speed, width]| beside(speed, width, ends[1] - ends[0])));
        }
    } else {
        let known: Vec<Vec<[f64; 2]>> = speeds.iter().map(|speed| own(machine, *speed)).collect();
        for k in harmonics(machine, *first) {
            for (ends, found) in speeds.windows(2).zip(known.windows(2)) {
                let met = met(machine, k, ([ends[0], ends[1]], [&found[0], &found[1]]));
                list.extend(met.into_iter().flat_map(|[speed, width]| beside(speed, width, ends[1] - ends[0])));
            }
        }
    }
    list.retain(|speed| speed > first && speed < last);
    list
}

/// Speeds between two at which a harmonic meets a frequency, with their half widths.
fn met<T: Turning + ?Sized>(machine: &T, k: f64, (ends, found): ([f64; 2], [&Vec<[f64; 2]>; 2])) -> Vec<[f64; 2]> {
    // a frequency that begins to be is the least one: they are counted from the greatest
    let count = found[0].len().min(found[1].len());
    let off = |own: &[[f64; 2]], which: usize, speed: f64| own[own.len() - which][0] - k * speed.abs();
    let mut list = Vec::new();
    for which in 1..=count {
        let [a, b] = [0, 1].map(|end| off(found[end], which, ends[end]));
        if (a <= 0.0) == (b <= 0.0) {
            continue;
        }
        let mut missed = |speed: f64| {
            let own = own(machine, speed);
            if own.len() < which { f64::NAN } else { off(&own, which, speed) }
        };
        let speed = bracketed(&mut missed, (ends[0], a), (ends[1], b));
        list.extend(own(machine, speed).iter().rev().nth(which - 1).map(|own| [speed, own[1].abs() / k]));
    }
    list
}

/// Parts of the range in each of which poles are looked for from its middle.
fn windows(speeds: &[f64]) -> Vec<[f64; 2]> {
    let stride = (speeds.len() - 1).div_ceil(WINDOWS).max(1);
    let ends: Vec<f64> = speeds.iter().step_by(stride).chain(speeds.last()).copied().collect();
    ends.windows(2).filter(|pair| pair[0] < pair[1]).map(|pair| [pair[0], pair[1]]).collect()
}

/// Poles of the answers between two speeds where the coefficients vary over a turn: the complex speeds Ω at which the collocation A(Ω) = A₀ + ΩA₁ + Ω²A₂ is singular, and how far they are from the real ones.
/// Each is sought anew from its own speed.
fn poles<T: Turning + ?Sized>(machine: &T, ends: [f64; 2]) -> Vec<[f64; 2]> {
    let range = ends[1] - ends[0];
    let inside = |pole: &[f64; 2]| pole[0] >= ends[0] && pole[0] <= ends[1] && pole[1] <= range;
    let mut list = Vec::new();
    for mut pole in beside_speed(machine, 0.5 * (ends[0] + ends[1])).into_iter().filter(inside) {
        for _ in 0..POLISHED {
            let from = pole[0];
            let near = |a: &[f64; 2]| elementary::hypot(a[0] - from, a[1]);
            let found = beside_speed(machine, from).into_iter().min_by(|a, b| near(a).total_cmp(&near(b)));
            pole = found.unwrap_or(pole);
        }
        // at the edge of a parametric resonance a pole is real, whatever the damping: places close in on it
        list.push([pole[0], pole[1].max(CLOSEST * pole[0].abs())]);
    }
    list
}

/// Poles as they are seen from a speed s: with τ = Ω - s and μ = 1/τ, μ²A(s) + μA'(s) + A₂ is singular.
fn beside_speed<T: Turning + ?Sized>(machine: &T, speed: f64) -> Vec<[f64; 2]> {
    let m = machine.others();
    let (grid, size) = (Grid::new(INSTANTS, m), INSTANTS * m);
    let still = vec![0.0; size];
    let at = |speed: f64| grid.matrix(&grid.instants(machine, speed, &still), speed);
    let step = PARABOLA * speed;
    let [before, here, behind] = [at(speed - step), at(speed), at(speed + step)];
    let Some(lu) = Lu::exact(&here, size) else { return Vec::new() };
    let mut companion = vec![0.0; 4 * size * size];
    for column in 0..size {
        let of = |by: &dyn Fn(usize) -> f64| lu.solve(&(0..size).map(|row| -by(row * size + column)).collect::<Vec<f64>>());
        let first = of(&|e| (behind[e] - before[e]) / (2.0 * step));
        let second = of(&|e| (behind[e] - 2.0 * here[e] + before[e]) / (2.0 * step * step));
        let (Some(first), Some(second)) = (first, second) else { return Vec::new() };
        for row in 0..size {
            companion[row * 2 * size + column] = first[row];
            companion[row * 2 * size + size + column] = second[row];
        }
        companion[(size + column) * 2 * size + column] = 1.0;
    }
    let values = general(2 * size, &companion).map(|found| found.values).unwrap_or_default();
    // 1/μ; a pole and its conjugate are one
    let pole = |re: f64, im: f64| [speed + re / (re * re + im * im), im / (re * re + im * im)];
    values.iter().filter(|mu| mu.im >= 0.0).map(|mu| pole(mu.re, mu.im)).collect()
}

/// How far a speed is from the nearest of the resonances, which are poles at complex speeds, of the linear equations beside an answer; their harmonics are those that it has.
pub(super) fn nearest(slopes: &[Vec<f64>], speed: f64, excited: &dyn Fn(usize) -> bool) -> f64 {
    let Some(width) = slopes.first().map(Vec::len) else { return f64::INFINITY };
    let mean: Vec<f64> = (0..width).map(|e| slopes.iter().map(|row| row[e]).sum::<f64>() / slopes.len() as f64).collect();
    let m = (1..=width).find(|m| 3 * m * m >= width).unwrap_or(1);
    let own = damped(&mean, m);
    let present = (1..=HARMONICS).filter(|k| excited(*k)).map(|k| k as f64);
    let away = present.flat_map(|k| own.iter().map(move |[nu, delta]| elementary::hypot(nu / k - speed.abs(), delta / k)));
    away.fold(f64::INFINITY, f64::min).max(NARROWEST * speed.abs())
}

/// Places about a resonance of a half width, up to a distance.
fn beside(speed: f64, width: f64, far: f64) -> Vec<f64> {
    if width <= NARROWEST * speed.abs() {
        return Vec::new();
    }
    let mut places: Vec<f64> = TOP.iter().map(|place| place * width).collect();
    let mut place = FARTHER * TOP[TOP.len() - 1] * width;
    while place < far {
        places.push(place);
        place *= FARTHER;
    }
    places.iter().flat_map(|by| [speed - by, speed + by]).collect()
}

/// ν and δ of the mean of the equations of the rest over a turn, by ascending ν.
fn own<T: Turning + ?Sized>(machine: &T, speed: f64) -> Vec<[f64; 2]> {
    let m = machine.others();
    let mut mean = vec![0.0; 3 * m * m];
    for (slopes, _) in around(machine, speed) {
        mean.iter_mut().zip(&slopes).for_each(|(sum, v)| *sum += v / INSTANTS as f64);
    }
    damped(&mean, m)
}

/// ν and δ of equations with constant coefficients, by ascending ν.
fn damped(mean: &[f64], m: usize) -> Vec<[f64; 2]> {
    let values = companion(mean, m).and_then(|matrix| general(2 * m, &matrix).ok()).map(|found| found.values).unwrap_or_default();
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

/// Whether a row of what is known at the instants has a harmonic.
fn is_there(k: usize, row: &dyn Fn(usize) -> f64) -> bool {
    let sums = (0..INSTANTS).fold([0.0, 0.0, 0.0], |[c, s, size], i| {
        let (sin, cos) = elementary::sin_cos(TAU * (i * k % INSTANTS) as f64 / INSTANTS as f64);
        [c + row(i) * cos, s + row(i) * sin, size + row(i).abs()]
    });
    elementary::hypot(sums[0], sums[1]) > ROUNDING * sums[2]
}

/// Whether coefficients vary over a turn.
fn varies<T: Turning + ?Sized>(machine: &T, speed: f64) -> bool {
    let all = around(machine, speed);
    (0..all[0].0.len()).any(|e| (1..=HARMONICS).any(|k| is_there(k, &|i| all[i].0[e])))
}

/// Harmonics of the turn in the loads of the rest.
fn harmonics<T: Turning + ?Sized>(machine: &T, speed: f64) -> Vec<f64> {
    let all = around(machine, speed);
    let loaded = |k: &usize| (0..all[0].1.len()).any(|e| is_there(*k, &|i| all[i].1[e]));
    (1..=HARMONICS).filter(loaded).map(|k| k as f64).collect()
}
