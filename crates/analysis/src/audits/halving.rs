//! Tolerance halving: how far the result moves when the tolerance is halved. For motions that do not amplify errors it bounds the error of the result;
//! where it is large the motion itself is sensitive (chaos, a separatrix), and only short spans or averages are meaningful.

use words::Text;

use crate::dataset::{Audit, Column};

/// Errors of a step add up and are amplified by the motion; more than this many tolerances means that the motion is sensitive.
const AMPLIFICATION: f64 = 1e5;

/// A column below this share of the largest of its unit is compared with that: what is left of it may be rounding of the others.
const SMALL: f64 = 1e-8;

/// Largest difference of two runs, each column relative to its largest magnitude.
pub fn tolerance_halving(columns: &[Column], finer: &[Column], tolerance: f64) -> Audit {
    let of_unit = |unit: &str| columns.iter().filter(|c| c.quantity.unit == unit).map(|c| size(&c.values)).fold(own_size(unit), f64::max);
    let one = |(a, b): (&Column, &Column)| difference(&a.values, &b.values, SMALL * of_unit(&a.quantity.unit));
    let worst = super::worst(columns.iter().zip(finer).map(one));
    let name = Text::new("tolerance halving: largest relative difference", "половинная точность: наибольшее относительное расхождение");
    Audit::at_most("tolerance_halving", name, worst, (AMPLIFICATION * tolerance).max(super::LEAST))
}

fn size(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |m, x| x.abs().max(m))
}

/// Angles and numbers have a size by themselves.
fn own_size(unit: &str) -> f64 {
    if matches!(unit, "rad" | "1") { 1.0 } else { 0.0 }
}

fn difference(a: &[f64], b: &[f64], least: f64) -> f64 {
    // a value that both runs do not have is the same
    let both = a.iter().zip(b).filter(|(x, y)| !(x.is_nan() && y.is_nan()));
    let gap = super::worst(both.map(|(x, y)| (x - y).abs()));
    if gap == 0.0 { 0.0 } else { gap / size(a).max(least) }
}
