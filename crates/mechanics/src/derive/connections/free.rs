//! Released bodies for the audit of their balances: placements, and resultants of what acts.
//!
//! Nothing of the inertia terms of the balances goes in here: momenta come from the placements, by differentiation in numbers.

use super::Connected;
use super::release::{Displacement, chain};
use crate::derive::kinematics::Kinematics;
use crate::derive::lagrange::inertia_parts;
use crate::derive::pathways::unit_vector;
use crate::derive::scene::{Scene, Vector};
use crate::derive::wrench::{Act, Along};
use crate::model::{FrameId, PointRef};
use symbolic::connections::{FreeBody, FreeFrame, Released};
use symbolic::{Expr, Text};

/// The bodies and the released frames with their displacements.
pub fn bodies(
    scene: &mut Scene,
    kinematics: &Kinematics,
    displacements: &[(FrameId, Displacement)],
    (loads, coupled, connected): (&[Act], &[Act], &Connected),
) -> Released {
    let mut released = Released::default();
    let mut frames: Vec<FrameId> = Vec::new();
    for (i, frame) in scene.model.frames.iter().enumerate() {
        let Some(mass) = &frame.mass else { continue };
        let center = kinematics.position(scene, PointRef::Center(FrameId(i)));
        let inertia = inertia_parts(scene, mass);
        released.bodies.push(FreeBody { mass: mass.mass, center, rotation: kinematics.frames[i].rotation, inertia });
        frames.push(FrameId(i));
    }
    let minus = scene.graph.int(-1);
    let mut acting: Vec<(FrameId, Act)> = Vec::new();
    let mut push = |scene: &Scene, act: Act| acting.extend(act.frame(scene).map(|f| (f, act)));
    for act in loads {
        push(scene, act.clone());
    }
    for act in coupled {
        let against = act.times(scene, minus);
        push(scene, against);
    }
    for (reaction, acts) in connected.reactions.iter().zip(&connected.acts) {
        let value = scene.graph.symbol(reaction.symbol);
        for act in acts {
            let whole = act.times(scene, value);
            push(scene, whole);
        }
    }
    for (frame, displacement) in displacements {
        let name = &scene.model.frames[frame.index()].name;
        let way = way(scene, displacement);
        if let Some(known) = released.frames.iter_mut().find(|f| f.name.en == *name) {
            known.ways.push(way);
            continue;
        }
        let on: Vec<usize> = (0..frames.len()).filter(|i| chain(scene, frames[*i]).contains(frame)).collect();
        let carried: Vec<Act> = acting.iter().filter(|(f, _)| chain(scene, *f).contains(frame)).map(|(_, act)| act.clone()).collect();
        let (force, moment) = resultant(scene, kinematics, &carried);
        let origin = kinematics.frames[frame.index()].origin;
        released.frames.push(FreeFrame { name: Text::same(name), bodies: on, origin, force, moment, ways: vec![way] });
    }
    released
}

/// Inertia along coordinates has no body: it is a load here.
pub fn without_bodies(inertial: &[Act]) -> Vec<Act> {
    inertial.iter().filter(|act| matches!(act, Act::Along(Along { .. }))).cloned().collect()
}

fn way(scene: &mut Scene, displacement: &Displacement) -> [Vector; 2] {
    let zero = scene.zero_vector();
    match displacement {
        Displacement::Along(axis) => [unit_vector(scene, *axis), zero],
        Displacement::About(axis) => [zero, unit_vector(scene, *axis)],
        Displacement::With(force, _) => [*force, zero],
        Displacement::Turn(moment, _) => [zero, *moment],
        Displacement::Own(shift, turn) => [*shift, *turn],
    }
}

/// Sum of forces, and moment about the origin of the ground.
fn resultant(scene: &mut Scene, kinematics: &Kinematics, acts: &[Act]) -> (Vector, Vector) {
    let (mut forces, mut moments): ([Vec<Expr>; 3], [Vec<Expr>; 3]) = Default::default();
    for act in acts {
        let (at, force) = match act {
            Act::Point { point, force } => (kinematics.position(scene, *point), *force),
            Act::Place { at, force, .. } => (*at, *force),
            Act::Turn { moment, .. } => {
                moments.iter_mut().zip(moment).for_each(|(sum, e)| sum.push(*e));
                continue;
            }
            Act::Along(_) => continue,
        };
        let moment = scene.cross(&at, &force);
        forces.iter_mut().zip(force).for_each(|(sum, e)| sum.push(e));
        moments.iter_mut().zip(moment).for_each(|(sum, e)| sum.push(e));
    }
    (forces.map(|terms| scene.graph.sum(&terms)), moments.map(|terms| scene.graph.sum(&terms)))
}
