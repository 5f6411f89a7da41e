//! What a connection keeps as it is at the start, where the start is only guessed: the guess then is geometry, and the file should say so.
//!
//! A length of the start is that of the numbers in the file, guesses among them; an angle and a line are what the closing of the connections leaves.

use crate::model::{Connection, ConnectionKind, CoordinateDecl, Frame, FrameId, Origin, Point, PointRef};
use crate::reader::Reader;
use std::collections::BTreeSet;
use symbolic::{Expr, Graph, SymbolId};
use words::{Notice, Text};

/// Frames and points of a machine.
pub(in crate::read) struct Places<'m> {
    pub frames: &'m [Frame],
    pub points: &'m [Point],
    pub coordinates: &'m [CoordinateDecl],
}

/// What is kept.
enum Kept {
    Angle,
    Line,
}

/// Warns of every angle or line of the start that belongs to guessed coordinates.
pub(in crate::read) fn warn(reader: &mut Reader, connections: &[Connection], places: &Places) {
    for connection in connections {
        for (kept, of) in kept(&reader.builder.graph, connection, places) {
            let guessed = places.coordinates.iter().filter(|c| c.guessed[0] && of.contains(&c.symbols[0]));
            let names: Vec<String> = guessed.map(|c| format!("`{}`", c.name)).collect();
            if !names.is_empty() {
                reader.report(warning(connection, &kept, &names.join(", ")));
            }
        }
    }
}

/// What a connection takes from the start, and the symbols it depends on.
fn kept(graph: &Graph, connection: &Connection, places: &Places) -> Vec<(Kept, BTreeSet<SymbolId>)> {
    let of_frames = |frames: [FrameId; 2]| apart(frames.map(|f| places.turns(graph, f)));
    let of_points = |points: &[PointRef]| points.iter().flat_map(|p| places.of_point(graph, *p)).collect();
    let mut list = Vec::new();
    match &connection.kind {
        ConnectionKind::Weld { between, .. } => list.push((Kept::Angle, of_frames(between.map(|p| places.frame_of(p))))),
        ConnectionKind::Slider { point, on, through, turns, .. } => {
            if !turns {
                list.push((Kept::Angle, of_frames([*on, places.frame_of(*point)])));
            }
            if through.is_none() {
                list.push((Kept::Line, of_points(&[*point, PointRef::Origin(*on)])));
            }
        }
        _ => {}
    }
    list
}

/// What only one of two sets has: both frames turn alike by the rest.
fn apart([a, b]: [BTreeSet<SymbolId>; 2]) -> BTreeSet<SymbolId> {
    a.symmetric_difference(&b).copied().collect()
}

impl Places<'_> {
    pub(super) fn frame_of(&self, point: PointRef) -> FrameId {
        match point {
            PointRef::Point(p) => self.points[p.index()].on,
            PointRef::Origin(f) | PointRef::Center(f) => f,
        }
    }

    /// Symbols in the turns of a frame and of what its axes count from.
    fn turns(&self, graph: &Graph, frame: FrameId) -> BTreeSet<SymbolId> {
        let (mut found, mut here) = (BTreeSet::new(), frame);
        while here != FrameId::GROUND {
            let frame = &self.frames[here.index()];
            let angles: Vec<Expr> = frame.rotations.iter().map(|(_, angle)| *angle).collect();
            found.extend(graph.symbols_in(&angles));
            here = frame.on;
        }
        found
    }

    /// Symbols in the place of a point.
    fn of_point(&self, graph: &Graph, point: PointRef) -> BTreeSet<SymbolId> {
        let (mut found, mut pending) = (BTreeSet::new(), vec![point]);
        while let Some(point) = pending.pop() {
            let frame = self.frame_of(point);
            if let PointRef::Point(p) = point {
                found.extend(graph.symbols_in(&self.points[p.index()].at));
            }
            found.extend(self.turns(graph, frame));
            if frame == FrameId::GROUND {
                continue;
            }
            match self.frames[frame.index()].origin {
                Origin::Vector(v) => {
                    found.extend(graph.symbols_in(&v));
                    pending.push(PointRef::Origin(self.frames[frame.index()].on));
                }
                Origin::Point(p) => pending.push(PointRef::Point(p)),
            }
        }
        found
    }
}

fn warning(connection: &Connection, kept: &Kept, names: &str) -> Notice {
    let of = format!("{}.{}", connection.table, connection.name);
    let (what, help) = match kept {
        Kept::Angle => (
            ("the angle of the start", "угол начала движения"),
            (
                "give them `start`, or hold the angle itself: [constraints] zero = \"c - a\"",
                "задайте им `start` или удержите сам угол: [constraints] zero = \"c - a\"",
            ),
        ),
        Kept::Line => (
            ("its line through the place of the start", "прямую через место начала движения"),
            ("give the line a point: `through`", "задайте точку прямой: `through`"),
        ),
    };
    Notice::file(
        "M119",
        connection.span.clone(),
        Text::new(
            format!("`{of}` keeps {}, and {names} is only guessed there", what.0),
            format!("`{of}` сохраняет {}, а {names} там лишь приближённо", what.1),
        ),
    )
    .warning()
    .why(
        "a rough guess, and what the closing of the connections makes of it, becomes geometry",
        "грубое приближение и то, что сделает из него замыкание связей, становится геометрией",
    )
    .help(help.0, help.1)
}
