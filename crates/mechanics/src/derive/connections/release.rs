//! Released bodies: virtual displacements in which the coordinates cannot move them, and the balances there.

use super::Connected;
use crate::derive::kinematics::Kinematics;
use crate::derive::scene::{Scene, Vector};
use crate::derive::wrench::{Act, carrier};
use crate::model::{Axis, FrameId, Inertia, Model, Origin};
use symbolic::connections::{Balance, Law};
use symbolic::{Expr, Substitution, SymbolId, Text};

/// A virtual displacement of a released body.
#[derive(Clone, PartialEq)]
enum Displacement {
    /// Along an axis of the ground.
    Along(Axis),
    /// About an axis of the ground through the body's origin.
    About(Axis),
    /// Along the force of a reaction.
    With(Vector, Text),
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
fn work(scene: &mut Scene, kinematics: &Kinematics, act: &Act, (frame, displacement): (FrameId, &Displacement)) -> Expr {
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
                _ => scene.graph.zero(),
            };
        }
        Act::Along(_) => return scene.graph.zero(),
    };
    match displacement {
        Displacement::Along(axis) => force[axis.index()],
        Displacement::With(way, _) => scene.dot(way, &force),
        Displacement::About(axis) => {
            let arm = scene.minus(&at, &origin);
            scene.cross(&arm, &force)[axis.index()]
        }
    }
}

/// Whether actions do work in some displacement of the released bodies.
pub fn is_felt(scene: &mut Scene, kinematics: &Kinematics, frames: &[FrameId], acts: &[Act]) -> bool {
    let displacements: &[Displacement] = if is_spatial(scene.model) { &SPACE } else { &PLANE };
    frames.iter().any(|frame| {
        displacements.iter().any(|displacement| {
            let parts: Vec<Expr> = acts.iter().map(|act| work(scene, kinematics, act, (*frame, displacement))).collect();
            let sum = scene.graph.sum(&parts);
            let sum = scene.tidy(sum);
            !scene.graph.is_zero(sum)
        })
    })
}

/// Displacements along the forces of the reactions that hold the body, then along and about the axes of the ground. The first give each reaction
/// its own balance: what holds the body across it and was not asked for has no part there, and the balance serves in every position. A structure
/// without coordinates stands in one position: the axes of the ground suffice.
fn displacements(scene: &Scene, frame: FrameId, connected: &Connected) -> Vec<Displacement> {
    let mut list: Vec<Displacement> = Vec::new();
    let ground: &[Displacement] = if is_spatial(scene.model) { &SPACE } else { &PLANE };
    if scene.n() == 0 {
        return ground.to_vec();
    }
    let graph = &scene.graph;
    let of_ground = |v: &Vector| v.iter().filter(|e| !graph.is_zero(**e)).count() == 1 && v.iter().all(|e| graph.as_number(*e).is_some());
    for (reaction, acts) in connected.reactions.iter().zip(&connected.acts).filter(|(r, _)| matches!(r.law, Law::Support)) {
        for act in acts.iter().filter(|act| act.frame(scene) == Some(frame)) {
            let (Act::Point { force, .. } | Act::Place { force, .. }) = act else { continue };
            let known = |d: &Displacement| matches!(d, Displacement::With(way, _) if way == force);
            if !of_ground(force) && !list.iter().any(known) {
                list.push(Displacement::With(*force, Text::same(&reaction.name)));
            }
        }
    }
    list.extend(ground.iter().cloned());
    list
}

/// Adds the balances of a released body.
pub fn balance(scene: &mut Scene, kinematics: &Kinematics, frame: FrameId, (loads, inertial): (&[Act], &[Act]), connected: &mut Connected) {
    let model = scene.model;
    for displacement in &displacements(scene, frame, connected) {
        let row = connected.balances.len();
        for k in 0..connected.reactions.len() {
            let parts: Vec<Expr> = connected.acts[k].iter().map(|act| work(scene, kinematics, act, (frame, displacement))).collect();
            let e = scene.graph.sum(&parts);
            let e = scene.tidy(e);
            if !scene.graph.is_zero(e) {
                connected.reactions[k].released.push((row, e));
            }
        }
        let mut sum = |acts: &[Act]| -> Expr {
            let parts: Vec<Expr> = acts.iter().map(|act| work(scene, kinematics, act, (frame, displacement))).collect();
            scene.graph.sum(&parts)
        };
        let (inertia, applied) = (sum(inertial), sum(loads));
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
        let name = label(&model.frames[frame.index()].name, displacement);
        connected.balances.push(Balance { name, columns, rest });
    }
}

fn label(body: &str, displacement: &Displacement) -> Text {
    let axis = |a: &Axis| ["x", "y", "z"][a.index()];
    match displacement {
        Displacement::Along(a) => Text::new(format!("{body}, forces along {}", axis(a)), format!("{body}, силы вдоль {}", axis(a))),
        Displacement::With(_, reaction) => {
            Text::new(format!("{body}, forces along {}", reaction.en), format!("{body}, силы вдоль {}", reaction.ru))
        }
        Displacement::About(a) => {
            Text::new(format!("{body}, moments about {}", axis(a)), format!("{body}, моменты относительно {}", axis(a)))
        }
    }
}
