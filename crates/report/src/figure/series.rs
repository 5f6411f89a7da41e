//! Curves and marks of a figure.

/// A curve. NaN breaks the line.
#[derive(Clone, Debug)]
pub struct Series {
    /// Name of the model, shown as a symbol.
    pub name: String,
    /// What it is, in words; empty for none.
    pub label: String,
    /// Abscissas, SI.
    pub x: Vec<f64>,
    /// Ordinates, SI, as many.
    pub y: Vec<f64>,
    /// How its points are joined.
    pub pen: Pen,
}

/// How the points of a curve are joined.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Pen {
    /// By a line.
    #[default]
    Line,
    /// Not at all: each is a dot.
    Dots,
}

/// A line or point that is pointed out.
#[derive(Clone, Debug, PartialEq)]
pub enum Mark {
    /// Vertical line.
    Vertical {
        /// Abscissa, SI.
        x: f64,
        /// Words beside it.
        label: String,
    },
    /// Horizontal line.
    Horizontal {
        /// Ordinate, SI.
        y: f64,
        /// Words beside it.
        label: String,
    },
    /// Point.
    Point {
        /// Abscissa, SI.
        x: f64,
        /// Ordinate, SI.
        y: f64,
        /// Words beside it.
        label: String,
    },
}
