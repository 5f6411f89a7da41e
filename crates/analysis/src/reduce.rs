//! Single numbers of a column: largest, least, mean, amplitude, last.
//!
//! An extreme between the rows is that of the polynomial of fourth degree through the five rows around it; where the column jumps, the values on
//! both sides of the event count instead. The mean is over the axis, by trapezoids.

use crate::Dataset;
use crate::dataset::Column;

/// What is made of a column.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reduction {
    /// Largest value.
    Max,
    /// Least value.
    Min,
    /// Half of the difference of both.
    Amplitude,
    /// Mean over the axis.
    Mean,
    /// Value of the last row.
    Last,
}

/// Names in files.
pub const NAMES: [(&str, Reduction); 5] = [
    ("max", Reduction::Max),
    ("min", Reduction::Min),
    ("amplitude", Reduction::Amplitude),
    ("mean", Reduction::Mean),
    ("last", Reduction::Last),
];

/// The number; none when the column does not exist or is empty.
pub fn reduce(data: &Dataset, name: &str, reduction: Reduction) -> Option<f64> {
    let i = data.columns.iter().position(|c| c.quantity.name == name)?;
    let column = &data.columns[i];
    let axis = data.axis.and_then(|a| data.columns.get(a));
    let last = *column.values.last()?;
    Some(match reduction {
        Reduction::Max => extreme(data, i, axis, 1.0),
        Reduction::Min => extreme(data, i, axis, -1.0),
        Reduction::Amplitude => 0.5 * (extreme(data, i, axis, 1.0) - extreme(data, i, axis, -1.0)),
        Reduction::Mean => mean(column, axis),
        Reduction::Last => last,
    })
}

/// Largest (`sign` 1) or least (-1) value.
fn extreme(data: &Dataset, i: usize, axis: Option<&Column>, sign: f64) -> f64 {
    let values = &data.columns[i].values;
    let offset = data.columns.len() - data.events.first().map_or(0, |e| e.outputs[0].len());
    let beside =
        data.events.iter().flat_map(|e| [&e.outputs[0], &e.outputs[1]]).filter_map(|side| side.get(i.checked_sub(offset)?).copied());
    let largest = values.iter().copied().chain(beside).filter(|v| v.is_finite()).map(|v| sign * v).fold(f64::NEG_INFINITY, f64::max);
    let between = axis.map_or(f64::NEG_INFINITY, |axis| peak(data, values, &axis.values, sign));
    sign * largest.max(between)
}

/// Largest value between rows.
fn peak(data: &Dataset, values: &[f64], t: &[f64], sign: f64) -> f64 {
    let mut best = f64::NEG_INFINITY;
    for k in 2..values.len().saturating_sub(2) {
        let near = &values[k - 2..=k + 2];
        let top = sign * values[k];
        let smooth = near.iter().all(|v| v.is_finite()) && !data.events.iter().any(|e| e.t >= t[k - 2] && e.t <= t[k + 2]);
        if smooth && top >= sign * near[1] && top >= sign * near[3] && t[k + 2] > t[k - 2] {
            best = best.max(top_of(&t[k - 2..=k + 2], near, sign));
        }
    }
    best
}

/// Largest value, between the second and the fourth point, of the polynomial through five points.
fn top_of(t: &[f64], values: &[f64], sign: f64) -> f64 {
    let value = |at: f64| -> f64 {
        let weight = |i: usize| (0..5).filter(|&j| j != i).map(|j| (at - t[j]) / (t[i] - t[j])).product::<f64>();
        (0..5).map(|i| sign * values[i] * weight(i)).sum()
    };
    let (mut a, mut b) = (t[1], t[3]);
    let ratio = 0.5 * (5.0_f64.sqrt() - 1.0);
    for _ in 0..80 {
        let (x, y) = (b - ratio * (b - a), a + ratio * (b - a));
        if value(x) < value(y) { a = x } else { b = y }
    }
    value(0.5 * (a + b))
}

fn mean(column: &Column, axis: Option<&Column>) -> f64 {
    let v = &column.values;
    let plain = || v.iter().sum::<f64>() / v.len() as f64;
    let Some(axis) = axis else { return plain() };
    let length = axis.values.last().copied().unwrap_or(0.0) - axis.values.first().copied().unwrap_or(0.0);
    if length == 0.0 || v.len() != axis.values.len() {
        return plain();
    }
    let area: f64 = axis.values.windows(2).zip(v.windows(2)).map(|(t, v)| 0.5 * (t[1] - t[0]) * (v[0] + v[1])).sum();
    area / length
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Quantity;

    #[test]
    fn a_sine_has_its_amplitude_between_rows() {
        let t: Vec<f64> = (0..=1000).map(|k| k as f64 * 0.01).collect();
        let v: Vec<f64> = t.iter().map(|t| 2.0 + 3.0 * (t * 1.37).sin()).collect();
        let column = |name: &str, values| Column { quantity: Quantity::new(name, "m"), values };
        let data = Dataset { axis: Some(0), columns: vec![column("t", t), column("x", v)], ..Dataset::default() };
        assert!((reduce(&data, "x", Reduction::Max).unwrap() - 5.0).abs() < 1e-11);
        assert!((reduce(&data, "x", Reduction::Min).unwrap() + 1.0).abs() < 1e-11);
        assert!((reduce(&data, "x", Reduction::Amplitude).unwrap() - 3.0).abs() < 1e-11);
        assert_eq!(reduce(&data, "y", Reduction::Max), None);
    }
}
