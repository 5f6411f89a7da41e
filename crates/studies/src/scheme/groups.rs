//! Groups of frames that are one piece, and how each moves against the one that carries it.

use super::numbers::{ALIKE, Numbers, Pose, STILL, V3, dot, minus, norm, unit};
use crate::connections::{Grip, Held, Place, grips};
use mechanics::Model;
use mechanics::model::{Frame, FrameId, Origin, PointRef};

/// How a group moves against its carrier.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Joint {
    /// Not at all: the ground.
    Ground,
    /// About a point that stands still in the carrier.
    Turns,
    /// Along a direction, without turning.
    Slides(V3),
    /// Not at all, but something else than the ground holds it: bodies of statics.
    Held,
    /// Without turning, in more than one direction.
    Shifts,
    /// Any other way.
    Free,
}

/// Frames that are one piece.
#[derive(Clone, Debug)]
pub struct Group {
    /// Its frames.
    pub frames: Vec<FrameId>,
    /// The frame that gives it its joint.
    pub root: FrameId,
    /// The group that carries it.
    pub carrier: usize,
    /// How it moves.
    pub joint: Joint,
    /// Whether it turns against the ground.
    pub turns: bool,
    /// Whether anything on it has mass.
    pub heavy: bool,
    /// Whether one of its frames is a body.
    pub body: bool,
    /// `bodies.crank`, of its first body.
    pub path: String,
    /// Its number in the picture, from 1; 0 before it has one.
    pub number: usize,
}

/// All groups; the first is the ground.
#[derive(Clone, Debug)]
pub struct Groups {
    /// The groups.
    pub all: Vec<Group>,
    of: Vec<usize>,
}

impl Groups {
    /// Finds them by what stays together in all states.
    pub fn new(model: &Model, numbers: &Numbers) -> Groups {
        let mut of = vec![0; model.frames.len()];
        let mut all = vec![group(FrameId::GROUND, (0, Joint::Ground), "ground")];
        for (i, frame) in model.frames.iter().enumerate().skip(1) {
            let carrier = carrier_of(model, frame);
            let held = frame.is_body && is_held(model, FrameId(i));
            let fixed = [carrier, frame.on].into_iter().find(|c| stays(numbers, *c, FrameId(i)) && !(held && of[c.index()] == 0));
            of[i] = match fixed {
                Some(c) => of[c.index()],
                None => {
                    let joint = if stays(numbers, carrier, FrameId(i)) { Joint::Held } else { joint(numbers, carrier, FrameId(i)) };
                    all.push(group(FrameId(i), (of[carrier.index()], joint), ""));
                    all.len() - 1
                }
            };
            let g = &mut all[of[i]];
            if g.root != FrameId(i) {
                g.frames.push(FrameId(i));
            }
            g.heavy |= frame.mass.is_some();
            g.body |= frame.is_body;
            if g.path.is_empty() || frame.is_body && g.path.starts_with("frames.") {
                g.path = format!("{}.{}", if frame.is_body { "bodies" } else { "frames" }, frame.name);
            }
        }
        for g in &mut all {
            let first = numbers.frames[0][g.root.index()];
            let moved =
                // what turns by STEP turns its axes by far more; rounding of rotations is 1e-15
                |s: usize| numbers.frames[s][g.root.index()].rotation.iter().zip(&first.rotation).any(|(a, b)| norm(minus(*a, *b)) > 1e-7);
            g.turns = g.joint == Joint::Held || (1..numbers.frames.len()).any(moved);
        }
        Groups { all, of }
    }

    /// The group of a frame.
    pub fn of(&self, frame: FrameId) -> usize {
        self.of[frame.index()]
    }

    /// The group of a point.
    pub fn of_point(&self, model: &Model, point: PointRef) -> usize {
        self.of(frame_of(model, point))
    }

    /// The group that a connection takes hold of.
    pub fn of_grip(&self, model: &Model, grip: &Grip) -> usize {
        match grip.what {
            Place::Point(point) => self.of_point(model, point),
            Place::Frame(frame) => self.of(frame),
        }
    }
}

/// The frame a point belongs to.
pub fn frame_of(model: &Model, point: PointRef) -> FrameId {
    match point {
        PointRef::Point(p) => model.points[p.index()].on,
        PointRef::Origin(f) | PointRef::Center(f) => f,
    }
}

fn group(root: FrameId, (carrier, joint): (usize, Joint), path: &str) -> Group {
    Group { frames: vec![root], root, carrier, joint, turns: false, heavy: false, body: false, path: path.to_owned(), number: 0 }
}

/// Whether hinges or supports of the file hold a body.
fn is_held(model: &Model, body: FrameId) -> bool {
    let on = |p: &PointRef| frame_of(model, *p) == body;
    let holds = |held| matches!(held, Held::Hinged | Held::Fixed | Held::Linked | Held::Supported | Held::Slides);
    grips(model).any(|grip| holds(grip.held) && matches!(&grip.what, Place::Point(p) if on(p)))
}

/// What a frame is hinged to: the frame of the point that it begins at.
fn carrier_of(model: &Model, frame: &Frame) -> FrameId {
    match frame.origin {
        Origin::Point(p) => model.points[p.index()].on,
        Origin::Vector(_) => frame.on,
    }
}

/// The origin of one frame and its axes in another one.
fn seen(numbers: &Numbers, state: usize, (from, frame): (FrameId, FrameId)) -> Pose {
    let (a, b) = (numbers.frames[state][from.index()], numbers.frames[state][frame.index()]);
    let columns = [0, 1, 2].map(|j| a.seen([b.rotation[0][j], b.rotation[1][j], b.rotation[2][j]]));
    let rotation = [0, 1, 2].map(|i| [columns[0][i], columns[1][i], columns[2][i]]);
    Pose { origin: a.seen(minus(b.origin, a.origin)), rotation }
}

fn stays(numbers: &Numbers, from: FrameId, frame: FrameId) -> bool {
    let first = seen(numbers, 0, (from, frame));
    (1..numbers.frames.len()).all(|s| {
        let pose = seen(numbers, s, (from, frame));
        same_axes(&first, &pose) && norm(minus(pose.origin, first.origin)) < STILL * (1.0 + norm(first.origin))
    })
}

fn same_axes(a: &Pose, b: &Pose) -> bool {
    a.rotation.iter().zip(&b.rotation).all(|(x, y)| norm(minus(*x, *y)) < STILL)
}

fn joint(numbers: &Numbers, from: FrameId, frame: FrameId) -> Joint {
    let first = seen(numbers, 0, (from, frame));
    let poses: Vec<Pose> = (1..numbers.frames.len()).map(|s| seen(numbers, s, (from, frame))).collect();
    let turns = poses.iter().any(|p| !same_axes(&first, p));
    let ways: Vec<V3> = poses.iter().map(|p| minus(p.origin, first.origin)).filter(|w| norm(*w) > STILL).collect();
    // the states of single coordinates say which way is forward
    let single = poses.iter().skip(3).map(|p| minus(p.origin, first.origin)).find(|w| norm(*w) > STILL);
    let forward = single.and_then(unit).or_else(|| ways.first().and_then(|w| unit(*w)));
    match (turns, forward) {
        (true, None) => Joint::Turns,
        (true, Some(_)) => Joint::Free,
        (false, None) => Joint::Free,
        (false, Some(e)) => {
            let straight = ways.iter().all(|w| norm(*w) - dot(*w, e).abs() < ALIKE * norm(*w));
            if straight { Joint::Slides(numbers.frames[0][from.index()].shown(e)) } else { Joint::Shifts }
        }
    }
}
