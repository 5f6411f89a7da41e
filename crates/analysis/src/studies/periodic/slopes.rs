//! Derivatives by the state and the time.

use crate::{Fault, Mode, System};

/// Half width of differences, in scales of the state: (1e-3)^4 of truncation against 1e-16/1e-3 of rounding.
pub(super) const WIDTH: f64 = 1e-3;

/// Derivative of a vector function by every state: central differences of fourth order; row i = component i.
pub(crate) fn derivative(
    x: &[f64],
    scales: &[f64],
    mut value: impl FnMut(&[f64]) -> Result<Vec<f64>, Fault>,
) -> Result<Vec<Vec<f64>>, Fault> {
    let mut columns = Vec::with_capacity(x.len());
    for (j, scale) in scales.iter().enumerate().take(x.len()) {
        columns.push(along(x, j, *scale, &mut value)?);
    }
    let rows = columns.first().map_or(0, Vec::len);
    Ok((0..rows).map(|i| columns.iter().map(|c| c[i]).collect()).collect())
}

/// Derivative by state j; a smaller width where the function ends.
fn along(x: &[f64], j: usize, scale: f64, value: &mut impl FnMut(&[f64]) -> Result<Vec<f64>, Fault>) -> Result<Vec<f64>, Fault> {
    let mut width = WIDTH * scale;
    let mut place = x.to_vec();
    for tries in 0..3 {
        let mut at = |k: f64| {
            place[j] = x[j] + k * width;
            value(&place)
        };
        let values = at(-2.0).and_then(|a| Ok([a, at(-1.0)?, at(1.0)?, at(2.0)?]));
        match values {
            Ok([a, b, c, d]) => {
                let difference = |i: usize| (8.0 * (c[i] - b[i]) - (d[i] - a[i])) / (12.0 * width);
                return Ok((0..a.len()).map(difference).collect());
            }
            Err(fault) if tries == 2 => return Err(fault),
            // away from an end of the domain
            Err(_) => width *= 1e-2,
        }
    }
    Ok(Vec::new())
}

/// First distance of differences by time as a share of the period, by how much each next one is shorter, and how many there are: the last is 2e-6 of a period.
const APART: f64 = 0.03;
const SHORTER: f64 = 4.0;
const DISTANCES: usize = 8;

/// Derivative of a vector function by time: central differences at ever shorter distances, extrapolated to none, each component where its table agrees best.
/// How quickly a load or a stop moves is not known beforehand: at 20 kHz a microsecond is long, at a turn a day short.
///
/// *Source*: C. J. F. Ridders, Advances in Engineering Software 4 (1982).
pub(super) fn by_time(t: f64, period: f64, mut value: impl FnMut(f64) -> Result<Vec<f64>, Fault>) -> Result<Vec<f64>, Fault> {
    let (mut best, mut error): (Vec<f64>, Vec<f64>) = (Vec::new(), Vec::new());
    let mut before: Vec<Vec<f64>> = Vec::new();
    let mut distance = APART * period;
    for row in 0..DISTANCES {
        let (early, late) = (value(t - distance)?, value(t + distance)?);
        // numbers of time carry their own rounding
        let width = (t + distance) - (t - distance);
        let mut now = vec![early.iter().zip(&late).map(|(a, b)| (b - a) / width).collect::<Vec<f64>>()];
        if row == 0 {
            best.clone_from(&now[0]);
            error = vec![f64::INFINITY; best.len()];
        }
        let mut factor = 1.0;
        for column in 0..row {
            factor *= SHORTER * SHORTER;
            let next: Vec<f64> = now[column].iter().zip(&before[column]).map(|(a, b)| a + (a - b) / (factor - 1.0)).collect();
            for (i, entry) in next.iter().enumerate() {
                let off = (entry - now[column][i]).abs().max((entry - before[column][i]).abs());
                if off < error[i] {
                    (best[i], error[i]) = (*entry, off);
                }
            }
            now.push(next);
        }
        // what does not depend on time at two distances does not depend on it
        if row == 1 && now[0].iter().chain(&before[0]).all(|slope| *slope == 0.0) {
            return Ok(now.swap_remove(0));
        }
        before = now;
        distance /= SHORTER;
    }
    Ok(best)
}

/// How derivatives are known.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Known {
    /// Up to rounding.
    Exactly,
    /// By differences.
    Roughly,
}

/// Derivatives of the rates, then of the guards, by x and t: exact where the system knows them, otherwise central differences.
pub(super) fn slopes<S: System + ?Sized>(
    system: &mut S,
    (t, x): (f64, &[f64]),
    modes: &[Mode],
    scales: &[f64],
    rows: &mut Vec<f64>,
) -> Result<Known, Fault> {
    if system.slopes(t, x, modes, rows)? {
        return Ok(Known::Exactly);
    }
    let mut values = |t: f64, x: &[f64]| {
        system.expand(t, x, modes, 1)?;
        let rates = (0..x.len()).map(|i| system.state(i)[1]);
        let guards = (0..modes.len()).map(|g| system.guard(g).first().copied().unwrap_or(0.0));
        Ok(rates.chain(guards).collect::<Vec<f64>>())
    };
    let by_state = derivative(x, scales, |x| values(t, x))?;
    // a hundredth of a second, and of the time, as the scale of formulas of time
    let by_time = derivative(&[t], &[1e-2 * (1.0 + t.abs())], |t| values(t[0], x))?;
    rows.clear();
    by_state.iter().zip(&by_time).for_each(|(row, time)| rows.extend(row.iter().chain(time)));
    Ok(Known::Roughly)
}
