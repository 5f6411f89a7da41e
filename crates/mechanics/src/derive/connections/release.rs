//! Released bodies: virtual displacements in which the coordinates cannot move them, and the balances there.

use super::Connected;
use crate::derive::kinematics::Kinematics;
use crate::derive::loads::Loads;
use crate::derive::scene::Scene;
use crate::derive::wrench::Act;
use crate::model::{Axis, FrameId, Inertia, Model, Origin};
use symbolic::connections::Balance;
use symbolic::{Expr, Substitution, SymbolId, Text};

/// A virtual displacement of a released body.
#[derive(Clone, Copy)]
enum Displacement {
    /// Along an axis of the ground.
    Along(Axis),
    /// About an axis of the ground through the body's origin.
    About(Axis),
}

const PLANE: [Displacement; 3] = [Displacement::Along(Axis::X), Displacement::Along(Axis::Y), Displacement::About(Axis::Z)];
const SPACE: [Displacement; 6] = [
    Displacement::Along(Axis::X),
    Displacement::Along(Axis::Y),
    Displacement::Along(Axis::Z),
    Displacement::About(Axis::X),
    Displacement::About(Axis::Y),
    Displacement::About(Axis::Z),
];

/// Whether anything leaves the plane.
pub fn is_spatial(model: &Model) -> bool {
    let graph = &model.graph;
    let off = |e: Expr| !graph.is_zero(e);
    let frames = model.frames.iter().any(|f| {
        let origin = matches!(f.origin, Origin::Vector(v) if off(v[2]));
        let axes = f.rotations.iter().any(|(a, _)| *a != Axis::Z) || f.spin.is_some_and(|(a, _)| a != Axis::Z);
        let center = f.mass.as_ref().is_some_and(|m| off(m.center[2]));
        let products = f.mass.as_ref().is_some_and(|m| matches!(m.inertia, Inertia::Tensor { yz, xz, .. } if off(yz) || off(xz)));
        origin || axes || center || products
    });
    frames
        || model.points.iter().any(|p| off(p.at[2]))
        || model.gravity.is_some_and(|g| off(g[2]))
        || model.torques.iter().any(|t| off(t.value[0]) || off(t.value[1]))
        || model.forces.iter().any(|f| matches!(&f.action, crate::model::Action::AtPoint { value, .. } if off(value[2])))
}

/// The frame that a frame is attached to: that of the point where its origin is, whatever axes its angle counts from.
fn carrier(model: &Model, frame: FrameId) -> FrameId {
    let frame = &model.frames[frame.index()];
    match frame.origin {
        Origin::Point(p) => model.points[p.index()].on,
        Origin::Vector(_) => frame.on,
    }
}

/// From a frame to the ground, both included.
fn chain(scene: &Scene, frame: FrameId) -> Vec<FrameId> {
    let mut list = vec![frame];
    let mut here = frame;
    while here != FrameId::GROUND {
        here = carrier(scene.model, here);
        list.push(here);
    }
    list
}

/// The bodies to release so that two frames part: on each side the frame next to their last common one.
pub fn parted(scene: &Scene, a: FrameId, b: FrameId) -> Vec<FrameId> {
    let (from_a, from_b) = (chain(scene, a), chain(scene, b));
    let below = |list: &[FrameId], other: &[FrameId]| list.iter().copied().take_while(|f| !other.contains(f)).last();
    below(&from_a, &from_b).into_iter().chain(below(&from_b, &from_a)).collect()
}

/// Work of an action in a virtual displacement of a body: zero unless it acts on the body or on something that stands on it.
fn work(scene: &mut Scene, kinematics: &Kinematics, act: &Act, (frame, displacement): (FrameId, Displacement)) -> Expr {
    let carried = act.frame(scene).is_some_and(|f| chain(scene, f).contains(&frame));
    if !carried {
        return scene.graph.zero();
    }
    let origin = kinematics.frames[frame.index()].origin;
    let (at, force) = match act {
        Act::Point { point, force } => (kinematics.position(scene, *point), *force),
        Act::Place { at, force, .. } => (*at, *force),
        Act::Turn { moment, .. } => {
            return match displacement {
                Displacement::About(axis) => moment[axis.index()],
                Displacement::Along(_) => scene.graph.zero(),
            };
        }
        Act::Along(_) => return scene.graph.zero(),
    };
    match displacement {
        Displacement::Along(axis) => force[axis.index()],
        Displacement::About(axis) => {
            let arm = scene.minus(&at, &origin);
            scene.cross(&arm, &force)[axis.index()]
        }
    }
}

/// Adds the balances of a released body.
pub fn balance(scene: &mut Scene, kinematics: &Kinematics, frame: FrameId, (loads, inertial): (&Loads, &[Act]), connected: &mut Connected) {
    let model = scene.model;
    let displacements: &[Displacement] = if is_spatial(model) { &SPACE } else { &PLANE };
    let complete = complete(scene, kinematics, frame, (loads, connected));
    for displacement in displacements {
        let row = connected.balances.len();
        for k in 0..connected.reactions.len() {
            let parts: Vec<Expr> = connected.acts[k].iter().map(|act| work(scene, kinematics, act, (frame, *displacement))).collect();
            let e = scene.graph.sum(&parts);
            let e = scene.tidy(e);
            if !scene.graph.is_zero(e) {
                connected.reactions[k].released.push((row, e));
            }
        }
        let mut sum = |acts: &[Act]| -> Expr {
            let parts: Vec<Expr> = acts.iter().map(|act| work(scene, kinematics, act, (frame, *displacement))).collect();
            scene.graph.sum(&parts)
        };
        let (inertia, applied) = (sum(inertial), sum(&loads.acts));
        let mut columns = Vec::new();
        for (j, c) in model.coordinates.iter().enumerate() {
            let e = scene.graph.derivative(inertia, c.symbols[2]);
            let e = scene.tidy(e);
            if !scene.graph.is_zero(e) {
                columns.push((j, e));
            }
        }
        let zero = scene.graph.zero();
        let still: Vec<(SymbolId, Expr)> = model.coordinates.iter().map(|c| (c.symbols[2], zero)).collect();
        let carried = Substitution::new(still).apply(&mut scene.graph, inertia);
        let rest = scene.graph.sub(applied, carried);
        let name = label(&model.frames[frame.index()].name, *displacement);
        connected.balances.push(Balance { name, columns, rest, complete });
    }
}

/// Whether no load on the body is a mere formula.
fn complete(scene: &mut Scene, kinematics: &Kinematics, frame: FrameId, (loads, connected): (&Loads, &Connected)) -> bool {
    let carried: Vec<FrameId> = (0..scene.model.frames.len()).map(FrameId).filter(|f| chain(scene, *f).contains(&frame)).collect();
    let mut moving: Vec<usize> = Vec::new();
    for f in carried {
        moving.extend(kinematics.frames[f.index()].turning.keys());
        let origin = kinematics.frames[f.index()].origin;
        for e in origin {
            moving.extend(scene.gradient(e).keys());
        }
    }
    let touches = |act: &Act| matches!(act, Act::Along(columns) if columns.keys().any(|j| moving.contains(j)));
    !loads.acts.iter().any(touches) && !connected.acts.iter().flatten().any(touches)
}

fn label(body: &str, displacement: Displacement) -> Text {
    let axis = |a: Axis| ["x", "y", "z"][a.index()];
    match displacement {
        Displacement::Along(a) => Text::new(format!("{body}, forces along {}", axis(a)), format!("{body}, силы вдоль {}", axis(a))),
        Displacement::About(a) => {
            Text::new(format!("{body}, moments about {}", axis(a)), format!("{body}, моменты относительно {}", axis(a)))
        }
    }
}
