//! Single numbers of a column: largest, least, mean, amplitude, last. They are those of the motion, whatever rows a table has.

use crate::Dataset;
use crate::dataset::{Overall, Windowed};

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
    /// Value at the end.
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

/// The number between two instants; none when the study did not look there, or ended before.
pub fn within(data: &Dataset, name: &str, reduction: Reduction, between: [f64; 2]) -> Option<f64> {
    let of = |w: &&Windowed| w.between == between && w.columns.iter().any(|q| q.name == name);
    let window = data.windows.iter().find(of)?;
    let column = 1 + window.columns.iter().position(|q| q.name == name)?;
    let extreme = || window.extremes.iter().find(|e| e.column == column);
    match reduction {
        Reduction::Max => extreme().map(|e| e.max),
        Reduction::Min => extreme().map(|e| e.min),
        Reduction::Amplitude => extreme().map(|e| 0.5 * (e.max - e.min)),
        Reduction::Mean => window.overall.iter().find(|o| o.column == column).map(Overall::mean),
        Reduction::Last => None,
    }
}

/// The number; none when the column does not exist, or its axis is known at rows only.
pub fn reduce(data: &Dataset, name: &str, reduction: Reduction) -> Option<f64> {
    if data.axis.is_none() {
        return of_list(&data.column(name)?.values, reduction);
    }
    Some(match reduction {
        Reduction::Max => data.extreme(name)?.max,
        Reduction::Min => data.extreme(name)?.min,
        Reduction::Amplitude => data.extreme(name).map(|e| 0.5 * (e.max - e.min))?,
        Reduction::Mean => data.overall(name)?.mean(),
        Reduction::Last => data.overall(name)?.last,
    })
}

/// Of results that stand beside one another (positions of equilibrium), with nothing between them.
fn of_list(values: &[f64], reduction: Reduction) -> Option<f64> {
    let last = *values.last()?;
    let (low, high) = values.iter().fold((last, last), |(l, h), v| (l.min(*v), h.max(*v)));
    Some(match reduction {
        Reduction::Max => high,
        Reduction::Min => low,
        Reduction::Amplitude => 0.5 * (high - low),
        Reduction::Mean => values.iter().sum::<f64>() / values.len() as f64,
        Reduction::Last => last,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Quantity;
    use crate::dataset::{Column, Extreme};

    /// x = sin 2 pi t seen at whole seconds: its rows say nothing.
    #[test]
    fn the_rows_of_a_table_do_not_count() {
        let column = |name: &str, values: &[f64]| Column { quantity: Quantity::new(name, "m"), values: values.to_vec() };
        let mut data =
            Dataset { axis: Some(0), columns: vec![column("t", &[0.0, 1.0, 2.0]), column("x", &[0.0; 3])], ..Dataset::default() };
        assert_eq!(reduce(&data, "x", Reduction::Max), None);
        data.extremes = vec![Extreme { column: 1, min: -1.0, t_min: 0.75, max: 1.0, t_max: 0.25 }];
        data.overall = vec![Overall { column: 1, integral: 0.5, span: 2.0, first: 0.0, last: 0.1 }];
        let all = NAMES.map(|(_, reduction)| reduce(&data, "x", reduction).unwrap());
        assert_eq!(all, [1.0, -1.0, 1.0, 0.25, 0.1]);
        assert_eq!(reduce(&data, "y", Reduction::Max), None);
    }
}
