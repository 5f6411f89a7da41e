//! The one scalar through which an element acts.

use crate::requests::{FrameId, PointRef};
use symbolic::Expr;

/// One scalar through which an element acts.
#[derive(Clone, Copy, Debug)]
pub enum Pathway {
    /// A formula over coordinates, time and position requests, and what it measures.
    Along(Expr, Measure),
    /// Distance between two points.
    Distance(PointRef, PointRef),
    /// Plane angle of the second frame minus that of the first.
    RelativeAngle(FrameId, FrameId),
}

/// What a formula of a pathway measures: its force is a force on a length, a moment on an angle.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Measure {
    /// A length.
    Length,
    /// An angle.
    Angle,
    /// Anything else.
    Other,
}

/// The value of the pathway at which a spring carries its preload.
#[derive(Clone, Copy, Debug)]
pub enum Rest {
    /// A formula.
    Value(Expr),
    /// The value of the pathway at the start of the motion.
    Start,
}
