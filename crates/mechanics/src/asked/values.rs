//! Values of studies: times, plots, ranges of parameters.

use symbolic::Expr;
use words::Text;

/// Values of a parameter, or of a start or starting rate of a coordinate.
#[derive(Clone, PartialEq, Debug)]
pub struct SweepRange {
    /// Name as with `--set`: `v`, `phi`, `phi'`.
    pub name: String,
    /// Values, SI.
    pub values: Vec<f64>,
}

/// name = factor·ω².
#[derive(Clone, Debug)]
pub struct FrequencyVariable {
    /// The user's letter.
    pub name: String,
    /// Over constant parameters.
    pub factor: Expr,
}

/// Times at which results are wanted.
#[derive(Clone, Debug, PartialEq)]
pub enum Times {
    /// Not said.
    Automatic,
    /// 0, step, 2 step, ... and the end.
    Every(f64),
    /// Exactly these, ascending.
    At(Vec<f64>),
}

/// A plot.
#[derive(Clone, Debug)]
pub struct Plot {
    /// Title; may be empty.
    pub title: Text,
    /// Name on the horizontal axis; `None` is time.
    pub x: Option<String>,
    /// Names on the vertical axis.
    pub y: Vec<String>,
}
