//! What several rooms ask of connections, as data.

use mechanics::model::{Connection, FrameId, PointRef, SupportDirection, Track, Wound};
use symbolic::Expr;

/// How a connection stands in the file.
#[derive(Clone, Debug)]
pub(crate) struct Own<'m> {
    /// `pins.B`.
    pub path: String,
    /// `B`.
    pub name: &'m str,
    /// `pins`.
    pub table: &'static str,
}

impl<'m> Own<'m> {
    pub(crate) fn of(connection: &'m Connection) -> Own<'m> {
        let path = format!("{}.{}", connection.table, connection.name);
        Own { path, name: &connection.name, table: connection.table }
    }
}

/// What a connection takes hold of, and how.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Grip {
    pub held: Held,
    pub what: Place,
}

/// How something is taken hold of.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Held {
    /// By a hinge.
    Hinged,
    /// By a rigid joint.
    Fixed,
    /// By the end of a rod.
    Linked,
    /// A point that slides along a line.
    Slides,
    /// The frame of that line.
    Guides,
    /// By a support.
    Supported,
    /// The frame of a track.
    Rolled,
    /// By a rope.
    Roped,
    /// Not at all: a place that is seen.
    Seen,
}

/// A point or a whole frame.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Place {
    Point(PointRef),
    Frame(FrameId),
}

impl Grip {
    pub(super) fn point(held: Held, point: PointRef) -> Grip {
        Grip { held, what: Place::Point(point) }
    }

    pub(super) fn points(held: Held, points: &[PointRef]) -> Vec<Grip> {
        points.iter().map(|p| Grip::point(held, *p)).collect()
    }

    pub(super) fn frame(held: Held, frame: FrameId) -> Grip {
        Grip { held, what: Place::Frame(frame) }
    }
}

/// The rim of a wheel: its symbol, its body, its centre, its radius.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Rim {
    pub symbol: &'static str,
    pub frame: FrameId,
    pub center: PointRef,
    pub radius: Expr,
}

/// What stands beside something that acts along a pathway.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Letter {
    /// That of a formula.
    Of(Expr),
    /// F or M with the name.
    Drive,
    /// The usual one of its table.
    Usual,
}

/// Where a stop begins to push.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Limit {
    pub clearance: Expr,
    /// Whether the pathway may only grow beyond it.
    pub above: bool,
}

/// A point on a straight line.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Guide {
    pub point: PointRef,
    pub on: FrameId,
    pub through: Option<PointRef>,
    pub direction: Expr,
    pub turns: bool,
}

/// A rope along points, on drums.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Rope<'m> {
    pub path: &'m [PointRef],
    pub wound: &'m [Wound],
    pub slack: bool,
}

/// Two wheels that turn together.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Pair {
    pub between: [FrameId; 2],
    pub radii: [Expr; 2],
    pub opposite: bool,
}

/// A wheel on a track.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Rolls {
    pub wheel: FrameId,
    pub center: PointRef,
    pub radius: Expr,
    pub on: FrameId,
    pub track: Track,
}

/// A body that is held at a point.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Support<'m> {
    pub at: PointRef,
    pub directions: &'m [SupportDirection],
    pub axes: FrameId,
    pub on: Option<FrameId>,
}
