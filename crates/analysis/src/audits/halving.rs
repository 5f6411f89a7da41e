//! Tolerance halving: how far the result moves when the tolerance is halved. For motions that do not amplify errors it bounds the error of the result;
//! where it is large the motion itself is sensitive (chaos, a separatrix), and only short spans or averages are meaningful.

use symbolic::Text;

use crate::dataset::{Audit, Column};

/// Errors of a step add up and are amplified by the motion; more than this many tolerances means that the motion is sensitive.
const AMPLIFICATION: f64 = 1e5;

/// Largest difference of two runs, each column relative to its largest magnitude.
pub fn tolerance_halving(columns: &[Column], finer: &[Column], tolerance: f64) -> Audit {
    let worst = columns.iter().zip(finer).map(|(a, b)| difference(&a.values, &b.values)).fold(0.0, f64::max);
    let name = Text::new("tolerance halving: largest relative difference", "половинная точность: наибольшее относительное расхождение");
    Audit::at_most("tolerance_halving", name, worst, (AMPLIFICATION * tolerance).max(1e-9))
}

fn difference(a: &[f64], b: &[f64]) -> f64 {
    let size = a.iter().map(|x| x.abs()).fold(0.0, f64::max);
    let gap = a.iter().zip(b).map(|(x, y)| (x - y).abs()).fold(0.0, f64::max);
    if gap == 0.0 { 0.0 } else { gap / size }
}
