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

/// How much narrower differences become, and how often, until they stay within a piece: the last ones are 6e-11 of a scale wide, and rounding leaves five digits.
const NARROWER: f64 = 16.0;
const WIDTHS: usize = 7;
/// By what share the slopes on both sides of a place may differ: those of a smooth function differ by the third power of the width.
const KINK: f64 = 1e-6;
/// Roundings of the values in a difference.
const ROUNDED: f64 = 64.0 * f64::EPSILON;

/// The same of what an impact does, which has a bend or a jump where a contact stops closing, a friction begins to slip, or another contact comes first: of the piece that x lies in, however
/// near to its border. The values have the scales of the states. None on a border.
pub(super) fn in_piece(
    x: &[f64],
    scales: &[f64],
    mut value: impl FnMut(&[f64]) -> Result<Vec<f64>, Fault>,
) -> Result<Option<Vec<Vec<f64>>>, Fault> {
    let here = value(x)?;
    let mut columns = Vec::with_capacity(x.len());
    for (j, scale) in scales.iter().enumerate().take(x.len()) {
        let mut place = x.to_vec();
        let mut slope = None;
        for width in std::iter::successors(Some(WIDTH * scale), |width| Some(width / NARROWER)).take(WIDTHS) {
            let mut at = |k: f64| {
                place[j] = x[j] + k * width;
                value(&place)
            };
            let Ok([a, b, c, d]) = at(-2.0).and_then(|a| Ok([a, at(-1.0)?, at(1.0)?, at(2.0)?])) else { continue };
            let central = |i: usize| (8.0 * (c[i] - b[i]) - (d[i] - a[i])) / (12.0 * width);
            // slope behind less slope before, of parabolas: nothing but the fourth derivative is left of a smooth function
            let bent = |i: usize| (4.0 * (b[i] + c[i]) - (a[i] + d[i]) - 6.0 * here[i]) / (2.0 * width);
            let level = |i: usize| KINK * central(i).abs().max(scales[i] / scale) + ROUNDED * (here[i].abs() + scales[i]) / width;
            if (0..here.len()).all(|i| bent(i).abs() <= level(i)) {
                slope = Some((0..here.len()).map(central).collect::<Vec<f64>>());
                break;
            }
        }
        let Some(slope) = slope else { return Ok(None) };
        columns.push(slope);
    }
    Ok(Some((0..here.len()).map(|i| columns.iter().map(|c| c[i]).collect()).collect()))
}

/// First distance of differences by time as a share of the period, by how much each next one is shorter, and how many there are in a table: the last is 2e-6 of a period.
const APART: f64 = 0.03;
const SHORTER: f64 = 4.0;
const DISTANCES: usize = 8;
/// Distances in all, down to 7e-12 of a period.
const ALL: usize = 16;
/// Share of the difference of the slopes on both sides that a quarter of the distance may leave: a quarter of a smooth function's, all of it at a kink.
const SMOOTHER: f64 = 0.5;

/// Derivative by time of what an impact does: central differences at ever shorter distances, extrapolated to none, each component where its table agrees best. Distances that leave the piece
/// in which the instant lies (a stop that would no longer be met) begin no table.
/// How quickly a load or a stop moves is not known beforehand: at 20 kHz a microsecond is long, at a turn a day short.
///
/// *Source*: C. J. F. Ridders, Advances in Engineering Software 4 (1982).
pub(super) fn by_time(t: f64, period: f64, mut value: impl FnMut(f64) -> Result<Vec<f64>, Fault>) -> Result<Vec<f64>, Fault> {
    let here = value(t)?;
    let (mut best, mut error) = (vec![0.0; here.len()], vec![f64::INFINITY; here.len()]);
    let mut before: Vec<Vec<f64>> = Vec::new();
    let mut bent_before: Option<Vec<f64>> = None;
    let mut distance = APART * period;
    for _ in 0..ALL {
        let (early, late) = (value(t - distance)?, value(t + distance)?);
        // numbers of time carry their own rounding
        let width = (t + distance) - (t - distance);
        let slope: Vec<f64> = early.iter().zip(&late).map(|(a, b)| (b - a) / width).collect();
        let bent: Vec<f64> = (0..here.len()).map(|i| 2.0 * ((early[i] - here[i]) + (late[i] - here[i])) / width).collect();
        let is_smooth = bent_before.as_ref().is_none_or(|before| {
            let level = |i: usize| KINK * slope[i].abs() + ROUNDED * here[i].abs() / width;
            (0..here.len()).all(|i| bent[i].abs() <= SMOOTHER * before[i].abs() + level(i))
        });
        bent_before = Some(bent);
        distance /= SHORTER;
        if !is_smooth {
            before.clear();
            error.fill(f64::INFINITY);
        }
        let mut now = vec![slope];
        let row = before.len();
        if row == 0 {
            best.clone_from(&now[0]);
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
        if before.len() == DISTANCES {
            break;
        }
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
