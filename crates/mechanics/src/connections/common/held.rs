//! What a support holds its body to, where the file does not say it.
//!
//! A body stands on its `on`, and a support holds it to that. A body whose `origin` is the name of a point of another body has two partners: that body
//! carries it at the point (its mount), and `on` gives it its axes.
//!
//! | what is held | by |
//! |---|---|
//! | forces at the mount | the body of the point: they are those of the joint; `on` where a pin or a weld of the two declares this joint |
//! | forces at other places | `on` |
//! | turning | `on`, against which the angle counts; not known where the two partners do not turn against each other: then the joint may be a weld |
//!
//! A frame that is no body gives no reaction of its own. Mounted at a point of a body it stands for this body at the origin of what it carries; anything
//! else is not known.

use super::faults;
use crate::model::{Connection, ConnectionKind, FrameId, PointRef};
use crate::scene::kinematics::{Kinematics, combine};
use crate::scene::wrench::{carrier, frame_of};
use crate::scene::{Found, Scene};

/// What holds a point of a body against shifts.
pub fn at_place(scene: &mut Scene, connection: &Connection, at: PointRef) -> Found<FrameId> {
    let body = frame_of(scene, at);
    let (below, mount) = partners(scene, body);
    let at_origin = is_origin(scene, at);
    if mount != below {
        let joint = at_origin && !is_declared(scene, [body, mount]);
        return Ok(if joint { mount } else { below });
    }
    match floating(scene, below) {
        Some(mount) if !at_origin => Err(faults::unknown_holder(scene.model, connection, [body, mount, below])),
        _ => Ok(below),
    }
}

/// What holds a body against turning.
pub fn against_turning(scene: &mut Scene, kinematics: &Kinematics, connection: &Connection, at: PointRef) -> Found<FrameId> {
    let body = frame_of(scene, at);
    let (below, mount) = partners(scene, body);
    if mount != below {
        let one = body_below(scene, mount) == body_below(scene, below);
        let known = one || is_declared(scene, [body, mount]) || turn_apart(scene, kinematics, [mount, below]);
        return if known { Ok(below) } else { Err(faults::unknown_holder(scene.model, connection, [body, mount, below])) };
    }
    match floating(scene, below) {
        Some(mount) => Err(faults::unknown_holder(scene.model, connection, [body, mount, below])),
        None => Ok(below),
    }
}

/// What gives a frame its axes, and what carries its origin.
fn partners(scene: &Scene, frame: FrameId) -> (FrameId, FrameId) {
    (scene.model.frames[frame.index()].on, carrier(scene.model, frame))
}

/// The body at a point of which a frame that is no body is mounted, when it is not the one that gives it its axes.
fn floating(scene: &Scene, frame: FrameId) -> Option<FrameId> {
    let (below, mount) = partners(scene, frame);
    let apart = body_below(scene, mount) != body_below(scene, below);
    (frame != FrameId::GROUND && !scene.model.frames[frame.index()].is_body && apart).then_some(mount)
}

/// The frame itself if it is a body, else the first body, or the ground, on which it stands.
fn body_below(scene: &Scene, frame: FrameId) -> FrameId {
    let mut here = frame;
    while here != FrameId::GROUND && !scene.model.frames[here.index()].is_body {
        here = scene.model.frames[here.index()].on;
    }
    here
}

/// Whether a point is the origin of its frame for all values of the parameters.
fn is_origin(scene: &mut Scene, at: PointRef) -> bool {
    match at {
        PointRef::Origin(_) => true,
        PointRef::Center(_) => false,
        PointRef::Point(p) => {
            let at = scene.open_vector(scene.model.points[p.index()].at);
            at.into_iter().all(|e| scene.vanishes(e))
        }
    }
}

/// Whether a pin or a weld joins a body at its origin with the body that carries it.
fn is_declared(scene: &mut Scene, [body, mount]: [FrameId; 2]) -> bool {
    let model = scene.model;
    let ends = model.connections.iter().filter_map(|c| match c.kind {
        ConnectionKind::Pin { between, .. } | ConnectionKind::Weld { between, .. } => Some(between),
        _ => None,
    });
    let mut both = ends.flat_map(|[a, b]| [(a, b), (b, a)]);
    both.any(|(own, other)| frame_of(scene, own) == body && frame_of(scene, other) == mount && is_origin(scene, own))
}

/// Whether two frames turn against each other.
fn turn_apart(scene: &mut Scene, kinematics: &Kinematics, frames: [FrameId; 2]) -> bool {
    let [a, b] = frames.map(|f| {
        let columns = kinematics.turning_in_ground_axes(scene, f);
        combine(scene, &columns)
    });
    let turning = scene.minus(&a, &b);
    turning.into_iter().any(|e| !scene.vanishes(e))
}
