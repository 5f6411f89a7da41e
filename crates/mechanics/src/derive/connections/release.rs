//! Released bodies: virtual displacements in which the coordinates cannot move them, and the balances there.
//!
//! What holds a body to its carrier does no work in the body's own displacements; of these forces and moments some are declared, and what was not declared is
//! taken perpendicular to what was. A balance may be used where such undeclared reactions do no work:
//!
//! | displacement | because |
//! |---|---|
//! | along the force of a declared reaction of the joint | the undeclared ones are perpendicular to it |
//! | the body's own, by each of its coordinates | the joint does no work there |
//! | along any direction | declared forces and own displacements span all directions: no force is undeclared |
//! | about a declared moment, about the couple of two declared forces | no moment is undeclared there |

use super::connected::Connected;
use crate::derive::place::Placer;
use crate::model::{Axis, FrameId};
use crate::scene::kinematics::Kinematics;
use crate::scene::wrench::{Act, carrier};
use crate::scene::{Scene, Vector, is_spatial};
use std::collections::BTreeSet;
use symbolic::connections::{Balance, Law};
use symbolic::{Expr, Substitution, SymbolId};
use words::Text;

/// A virtual displacement of a released body.
#[derive(Clone, PartialEq)]
pub enum Displacement {
    /// Along an axis of the ground.
    Along(Axis),
    /// About an axis of the ground through the body's origin.
    About(Axis),
    /// Along the force of a reaction.
    With(Vector, Text),
    /// About the moment of a reaction, through the body's origin.
    Turn(Vector, Text),
    /// Shift of the origin and turn.
    Own(Vector, Vector),
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

/// From a frame to the ground, both included.
pub fn chain(scene: &Scene, frame: FrameId) -> Vec<FrameId> {
    down(frame, |f| carrier(scene.model, f))
}

/// The same by what gives each frame its axes.
fn axes_chain(scene: &Scene, frame: FrameId) -> Vec<FrameId> {
    down(frame, |f| scene.model.frames[f.index()].on)
}

fn down(frame: FrameId, below: impl Fn(FrameId) -> FrameId) -> Vec<FrameId> {
    let mut list = vec![frame];
    let mut here = frame;
    while here != FrameId::GROUND {
        here = below(here);
        list.push(here);
    }
    list
}

/// The bodies to release so that two frames part: on each side the frame next to their last common one.
pub fn parted(scene: &Scene, a: FrameId, b: FrameId) -> Vec<FrameId> {
    next_to_common([chain(scene, a), chain(scene, b)])
}

fn next_to_common([a, b]: [Vec<FrameId>; 2]) -> Vec<FrameId> {
    let below = |list: &[FrameId], other: &[FrameId]| list.iter().copied().take_while(|f| !other.contains(f)).last();
    below(&a, &b).into_iter().chain(below(&b, &a)).collect()
}

/// The frames of both chains down to the last common one.
pub fn between(scene: &Scene, a: FrameId, b: FrameId) -> Vec<FrameId> {
    let (from_a, from_b) = (chain(scene, a), chain(scene, b));
    let own = |list: &[FrameId], other: &[FrameId]| list.iter().copied().filter(|f| !other.contains(f)).collect::<Vec<_>>();
    own(&from_a, &from_b).into_iter().chain(own(&from_b, &from_a)).collect()
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
                Displacement::Turn(turn, _) | Displacement::Own(_, turn) => scene.dot(turn, moment),
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
        Displacement::Turn(turn, _) => {
            let arm = scene.minus(&at, &origin);
            let moment = scene.cross(&arm, &force);
            scene.dot(turn, &moment)
        }
        Displacement::Own(shift, turn) => {
            let arm = scene.minus(&at, &origin);
            let moment = scene.cross(&arm, &force);
            let (turned, shifted) = (scene.dot(turn, &moment), scene.dot(shift, &force));
            scene.graph.add(turned, shifted)
        }
    }
}

/// Work of actions together.
pub fn total_work(scene: &mut Scene, kinematics: &Kinematics, acts: &[Act], way: (FrameId, &Displacement)) -> Expr {
    let parts: Vec<Expr> = acts.iter().map(|act| work(scene, kinematics, act, way)).collect();
    scene.graph.sum(&parts)
}

/// Whether actions together do work in a displacement.
pub fn does_work(scene: &mut Scene, kinematics: &Kinematics, acts: &[Act], way: (FrameId, &Displacement)) -> bool {
    let sum = total_work(scene, kinematics, acts, way);
    !scene.vanishes(sum)
}

/// Whether actions do work in some displacement of the released bodies.
pub fn is_felt(scene: &mut Scene, kinematics: &Kinematics, frames: &[FrameId], acts: &[Act]) -> bool {
    let displacements: &[Displacement] = if is_spatial(scene.model) { &SPACE } else { &PLANE };
    frames.iter().any(|frame| displacements.iter().any(|displacement| does_work(scene, kinematics, acts, (*frame, displacement))))
}

/// Displacements of all released bodies. The first give reactions their own balances, which serve in every position; a structure without coordinates
/// stands in one position, and the axes of the ground suffice.
pub fn displacements(scene: &mut Scene, kinematics: &Kinematics, placer: &Placer, connected: &Connected) -> Vec<(FrameId, Displacement)> {
    let frames: Vec<FrameId> = connected.released.iter().copied().collect();
    let ground: &[Displacement] = if is_spatial(scene.model) { &SPACE } else { &PLANE };
    if scene.n() == 0 {
        return frames.iter().flat_map(|f| ground.iter().map(|d| (*f, d.clone()))).collect();
    }
    let mut ordered: [Vec<(FrameId, Displacement)>; 4] = Default::default();
    for frame in frames {
        let joint = Joint::new(scene, kinematics, placer, (frame, connected));
        for (place, list) in joint.displacements(scene, placer).into_iter().enumerate() {
            for d in list {
                if !ordered[place].contains(&(frame, d.clone())) {
                    ordered[place].push((frame, d));
                }
            }
        }
    }
    ordered.into_iter().flatten().collect()
}

/// What holds a frame to its carrier.
struct Joint {
    frame: FrameId,
    /// Declared forces with their places.
    forces: Vec<(Vector, Vector, Text)>,
    /// Declared moments.
    moments: Vec<(Vector, Text)>,
    /// Declared forces, with their places, that pass by a mount: between a body that is mounted at a point of another one and what this body stands on,
    /// or what gives its axes. The mount takes forces in the same directions, so they say nothing about what is not declared.
    beside: Vec<(Vector, Vector, Text)>,
    /// Forces of other declared reactions on the frame and what stands on it.
    other: Vec<(Vector, Text)>,
}

/// What a reaction is to a frame's joint.
#[derive(Clone, Copy, PartialEq)]
enum Hold {
    /// One of its forces and moments.
    Own,
    /// It passes by a mount.
    Beside,
    /// It holds others.
    Other,
}

impl Joint {
    fn new(scene: &mut Scene, kinematics: &Kinematics, placer: &Placer, (frame, connected): (FrameId, &Connected)) -> Joint {
        let mut joint = Joint { frame, forces: Vec::new(), moments: Vec::new(), beside: Vec::new(), other: Vec::new() };
        for (reaction, acts) in connected.reactions.iter().zip(&connected.acts).filter(|(r, _)| matches!(r.law, Law::Support)) {
            let name = Text::same(&reaction.name);
            let hold = match hold(scene, placer, acts, frame) {
                found if found != Hold::Other && works(scene, kinematics, placer, (frame, acts)) => Hold::Other,
                found => found,
            };
            for act in acts {
                if !act.frame(scene).is_some_and(|f| chain(scene, f).contains(&frame)) {
                    continue;
                }
                let (force, at) = match act {
                    Act::Turn { moment, .. } if hold == Hold::Own => {
                        joint.moments.push((*moment, name.clone()));
                        continue;
                    }
                    Act::Point { point, force } => (*force, kinematics.position(scene, *point)),
                    Act::Place { at, force, .. } => (*force, *at),
                    Act::Turn { .. } | Act::Along(_) => continue,
                };
                match hold {
                    Hold::Own => joint.forces.push((force, at, name.clone())),
                    Hold::Beside => joint.beside.push((force, at, name.clone())),
                    Hold::Other => joint.other.push((force, name.clone())),
                }
            }
        }
        joint
    }

    /// In the order of their use: with declared forces; shifts; other directions; turns.
    fn displacements(&self, scene: &mut Scene, placer: &Placer) -> [Vec<Displacement>; 4] {
        let spatial = is_spatial(scene.model);
        let mut ordered: [Vec<Displacement>; 4] = Default::default();
        ordered[0].extend(self.forces.iter().map(|(force, _, name)| Displacement::With(*force, name.clone())));
        let own = placer.own(self.frame);
        let zero = scene.zero_vector();
        let (mut shifts, mut turns): (Vec<Vector>, Vec<Vector>) = (Vec::new(), Vec::new());
        for j in own.coordinates() {
            let Some((shift, turn)) = own.column(scene, j) else { continue };
            ordered[if turn == zero { 1 } else { 3 }].push(Displacement::Own(shift, turn));
            if turn == zero {
                shifts.push(shift);
            } else if shift == zero {
                turns.push(turn);
            }
        }
        let declared: Vec<Vector> = self.forces.iter().map(|f| f.0).collect();
        let all = declared.iter().chain(&shifts).copied().collect::<Vec<_>>();
        let mut pairs = self.forces.clone();
        if scene.rank(&all) == if spatial { 3 } else { 2 } {
            let beside = self.beside.iter().map(|(force, _, name)| (force, name));
            let others = self.other.iter().map(|(force, name)| (force, name)).chain(beside);
            ordered[2].extend(others.map(|(force, name)| Displacement::With(*force, name.clone())));
            ordered[2].extend(if spatial { SPACE[..3].to_vec() } else { PLANE[..2].to_vec() });
            pairs.extend(self.beside.iter().cloned());
        }
        ordered[3].extend(self.moments.iter().map(|(moment, name)| Displacement::Turn(*moment, name.clone())));
        let directions: Vec<Vector> = pairs.iter().map(|f| f.0).collect();
        let (couples, free) = (pairs.len().saturating_sub(scene.rank(&directions)), scene.rank(&turns));
        if couples + self.moments.len() + free >= if spatial { 3 } else { 1 } {
            ordered[3].extend(if spatial { SPACE[3..].to_vec() } else { PLANE[2..].to_vec() });
        } else if couples > 0 {
            ordered[3].extend(couples_of(scene, &pairs));
        }
        ordered
    }
}

/// Axes of the couples of two parallel forces.
fn couples_of(scene: &mut Scene, forces: &[(Vector, Vector, Text)]) -> Vec<Displacement> {
    let mut list = Vec::new();
    for (i, (force, at, name)) in forces.iter().enumerate() {
        for (other, place, _) in &forces[..i] {
            if other == force {
                let arm = scene.minus(at, place);
                let axis = scene.cross(&arm, force).map(|e| scene.tidy(e));
                list.push(Displacement::Turn(axis, name.clone()));
            }
        }
    }
    list
}

/// What a reaction is to the joint of a frame. Moments go by what gives the axes, as angles count from there; forces by what carries the origins.
fn hold(scene: &Scene, placer: &Placer, acts: &[Act], frame: FrameId) -> Hold {
    let frames: BTreeSet<FrameId> = acts.iter().filter_map(|act| act.frame(scene)).collect();
    let pairs: Vec<(FrameId, FrameId)> = frames.iter().flat_map(|a| frames.iter().map(|b| (*a, *b))).collect();
    let held: BTreeSet<FrameId> = pairs.iter().flat_map(|(a, b)| parted(scene, *a, *b)).collect();
    let turned: BTreeSet<FrameId> =
        pairs.iter().flat_map(|(a, b)| next_to_common([axes_chain(scene, *a), axes_chain(scene, *b)])).collect();
    let by_the_mount = turned.len() == 1 && turned != held;
    let moment = acts.iter().all(|act| matches!(act, Act::Turn { .. }));
    match (by_the_mount, moment) {
        (true, true) if turned.contains(&frame) => Hold::Own,
        (true, false) if turned.contains(&frame) || held.contains(&frame) => Hold::Beside,
        (true, _) => Hold::Other,
        (false, _) if belongs(placer, &held, frame) => Hold::Own,
        (false, _) => Hold::Other,
    }
}

/// Whether a reaction is one between the frame and its carrier, or realises the formula by which the frame follows another.
fn belongs(placer: &Placer, held: &BTreeSet<FrameId>, frame: FrameId) -> bool {
    let own = placer.own(frame).coordinates();
    let follows = |other: &FrameId| {
        let others = placer.own(*other).coordinates();
        others.is_subset(&own) && others != own
    };
    held.contains(&frame) && held.iter().filter(|f| **f != frame).all(follows)
}

/// Whether actions do work in any of the frame's own displacements.
fn works(scene: &mut Scene, kinematics: &Kinematics, placer: &Placer, (frame, acts): (FrameId, &[Act])) -> bool {
    let own = placer.own(frame);
    own.coordinates().into_iter().any(|j| {
        let column = own.column(scene, j);
        column.is_some_and(|(shift, turn)| does_work(scene, kinematics, acts, (frame, &Displacement::Own(shift, turn))))
    })
}

/// Adds the balance of a released body in a displacement.
pub fn balance(
    scene: &mut Scene,
    kinematics: &Kinematics,
    (frame, displacement): (FrameId, &Displacement),
    (loads, inertial, momenta): (&[Act], &[Act], &[Act]),
    connected: &mut Connected,
) {
    let model = scene.model;
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
    let (inertia, applied, carried) = (sum(inertial), sum(loads), sum(momenta));
    let moving = !scene.vanishes(carried);
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
    let without = Substitution::new(still).apply(&mut scene.graph, inertia);
    let rest = scene.graph.sub(applied, without);
    let own = &model.frames[frame.index()];
    let body = if own.label.en.is_empty() { Text::same(&own.name) } else { own.label.clone() };
    let name = label(&body, displacement);
    connected.balances.push(Balance { name, columns, rest, carried: moving.then_some(carried) });
}

fn label(body: &Text, displacement: &Displacement) -> Text {
    let (body, body_ru) = (&body.en, &body.ru);
    let axis = |a: &Axis| ["x", "y", "z"][a.index()];
    match displacement {
        Displacement::Along(a) => Text::new(format!("{body}, forces along {}", axis(a)), format!("{body_ru}, силы вдоль {}", axis(a))),
        Displacement::With(_, reaction) => {
            Text::new(format!("{body}, forces along {}", reaction.en), format!("{body_ru}, силы вдоль {}", reaction.ru))
        }
        Displacement::Turn(_, reaction) => {
            Text::new(format!("{body}, moments about {}", reaction.en), format!("{body_ru}, моменты относительно {}", reaction.ru))
        }
        Displacement::Own(..) => Text::new(format!("{body}, along its own displacement"), format!("{body_ru}, на собственном перемещении")),
        Displacement::About(a) => {
            // a body's moments are taken about its origin
            Text::new(
                format!("{body}, moments about {} at its origin", axis(a)),
                format!("{body_ru}, моменты относительно оси {} в начале координат тела", axis(a)),
            )
        }
    }
}
