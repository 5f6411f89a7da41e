//! Derivatives by the state and the time.

use crate::{Fault, Mode, System};

/// Half width of differences, in scales of the state: (1e-3)^4 of truncation against 1e-16/1e-3 of rounding.
const WIDTH: f64 = 1e-3;

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

/// Derivatives of the rates, then of the guards, by x and t: exact where the system knows them, otherwise central differences.
pub(super) fn slopes<S: System + ?Sized>(
    system: &mut S,
    (t, x): (f64, &[f64]),
    modes: &[Mode],
    scales: &[f64],
    rows: &mut Vec<f64>,
) -> Result<(), Fault> {
    if system.slopes(t, x, modes, rows)? {
        return Ok(());
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
    Ok(())
}
