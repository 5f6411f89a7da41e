//! Coefficients about a place where one coordinate rests at every instant: no motion has to be followed for them.
//!
//! ```text
//! f(t, x₀) = 0 for all t:   x' = A(t) (x - x₀),   A = ∂f/∂x at x₀
//! ```

use super::scalar::Scalar;
use crate::{Fault, System};

/// Instants of a period at which the coefficients are looked at.
const INSTANTS: usize = 256;
/// Share of the largest entry by which coefficients a period apart may differ: rounding of the time in their phases.
const REPEATS: f64 = 1e-11;
/// Share of the largest harmonic up to which others are rounding of formulas: what is left out must not be seen by polynomials over parameters, in which it comes and goes.
const ROUNDING: f64 = 1e-13;
/// Parts of the period at which they are compared: shares without a common measure with it or with each other.
const COMPARED: [f64; 5] = [0.0, 0.138, 0.351, 0.622, 0.907];

/// Hill's equation about the state x; none where the machine has more than one coordinate or any switch, moves there at some instant, or repeats after another time than `period`.
///
/// *Errors*: the equations are singular or undefined there.
pub fn standing<S: System + ?Sized>(system: &mut S, x: &[f64], period: f64) -> Result<Option<Scalar>, Fault> {
    if x.len() != 2 || system.n_coordinates() != 1 || !system.guards().is_empty() || !(period > 0.0 && period.is_finite()) {
        return Ok(None);
    }
    let mut rows = Vec::with_capacity(INSTANTS);
    for k in 0..INSTANTS {
        let Some(row) = coefficients(system, period * k as f64 / INSTANTS as f64, x)? else { return Ok(None) };
        rows.push(row);
    }
    let largest = rows.iter().flatten().fold(0.0_f64, |l, v| l.max(v.abs()));
    for share in COMPARED {
        let both = [share * period, (1.0 + share) * period].map(|t| coefficients(system, t, x));
        let [Some(here), Some(there)] = both.into_iter().collect::<Result<Vec<_>, _>>()?.try_into().unwrap_or([None, None]) else {
            return Ok(None);
        };
        if here.iter().zip(&there).any(|(a, b)| (a - b).abs() > REPEATS * largest) {
            return Ok(None);
        }
    }
    Ok(Scalar::without(ROUNDING, period, &rows).or_else(|| Scalar::of_coefficients(period, &rows)))
}

/// A(t) row by row; none where the machine does not rest, or the system knows no derivatives.
fn coefficients<S: System + ?Sized>(system: &mut S, t: f64, x: &[f64]) -> Result<Option<Vec<f64>>, Fault> {
    let (mut rates, mut rows) = ([0.0; 2], Vec::new());
    if !system.rates(t, x, &[], &mut rates) || rates != [0.0; 2] || !system.slopes(t, x, &[], &mut rows)? {
        return Ok(None);
    }
    // columns x, then t
    Ok(rows.get(..6).map(|rows| vec![rows[0], rows[1], rows[3], rows[4]]))
}
