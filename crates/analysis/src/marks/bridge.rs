//! Values where forces follow from no equation: in a change point, and where the coordinates themselves are singular. The motion is smooth there, and so is
//! all that follows from it; what is shown is the cubic through values on both sides. What has no limit has no such value.

use crate::Fault;

/// Where values around the place are taken, in units of the stretch that is bridged.
const NODES: [f64; 4] = [-2.0, -1.0, 1.0, 2.0];
/// Rounding of forces at these places, relative to their size.
const LIMIT: f64 = 1e-8;
/// What grows towards the place differs more between the inner sides than between the outer ones; what has a limit differs half as much.
const GROWS: f64 = 0.75;

/// Rows of values on both sides of a place of a step.
#[derive(Clone, Debug)]
pub(crate) struct Bridge {
    to: f64,
    around: f64,
    sides: Vec<Vec<f64>>,
    /// Rounding of a row on a side; empty where it is unknown.
    rounding: Vec<f64>,
}

/// What rounding makes of the difference of two values on one side, in roundings of one.
const NOISE: f64 = 8.0;

impl Bridge {
    /// Over `to`, from `around` before it to `around` behind it; `row` gives values at a place of the step.
    ///
    /// *Errors*: those of `row`.
    pub fn new([to, around]: [f64; 2], mut row: impl FnMut(f64) -> Result<Vec<f64>, Fault>) -> Result<Bridge, Fault> {
        let sides = NODES.iter().map(|node| row(to + node * around)).collect::<Result<Vec<Vec<f64>>, Fault>>()?;
        Ok(Bridge { to, around, sides, rounding: Vec::new() })
    }

    /// With the rounding of a row on a side.
    pub fn within(self, rounding: Vec<f64>) -> Bridge {
        Bridge { rounding, ..self }
    }

    /// The place on one side at which rounding is asked for.
    pub fn beside([to, around]: [f64; 2]) -> f64 {
        to + around
    }

    /// Whether a place lies on it.
    pub fn covers(&self, tau: f64) -> bool {
        (tau - self.to).abs() < self.around
    }

    /// A column at a place on it; none of what grows towards the middle instead of having a limit.
    pub fn value(&self, column: usize, tau: f64) -> Option<f64> {
        let value = |i: usize| self.sides[i].get(column).copied().unwrap_or(f64::NAN);
        let (far, near) = ((value(3) - value(0)).abs(), (value(2) - value(1)).abs());
        let size = (0..4).map(|i| value(i).abs()).fold(0.0, f64::max);
        let whole = (0..4).all(|i| value(i).is_finite());
        let place = (tau - self.to) / self.around;
        let noise = NOISE * self.rounding.get(column).copied().filter(|r| r.is_finite()).unwrap_or(0.0);
        (whole && near <= GROWS * far + (LIMIT * size).max(noise)).then(|| (0..4).map(|i| value(i) * lagrange(i, place)).sum())
    }
}

/// Weight of a node of [`NODES`] in the cubic at `place`.
fn lagrange(i: usize, place: f64) -> f64 {
    let others = (0..4).filter(|k| *k != i);
    others.map(|k| (place - NODES[k]) / (NODES[i] - NODES[k])).product()
}
