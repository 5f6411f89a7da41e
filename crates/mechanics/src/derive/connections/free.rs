//! Bodies for the audits of balances and of virtual work: placements, and resultants of what acts.
//!
//! Nothing of the inertia terms of the balances goes in here: momenta come from the placements, by differentiation in numbers.

use super::connected::Connected;
use super::release::{Displacement, chain};
use crate::derive::lagrange::inertia_parts;
use crate::model::{FrameId, PointRef};
use crate::scene::kinematics::Kinematics;
use crate::scene::pathways::unit_vector;
use crate::scene::wrench::{Act, Along, particle};
use crate::scene::{Columns, Scene, Vector};
use symbolic::connections::{FreeBody, FreeFrame, Wrench};
use symbolic::{Expr, Function};
use words::Text;

/// All bodies, and frames without inertia that something may act on: those with an origin or axes of their own.
pub fn bodies(scene: &mut Scene, kinematics: &Kinematics) -> Vec<FreeBody> {
    let model = scene.model;
    let zero = scene.graph.zero();
    let mut list = Vec::new();
    for (i, frame) in model.frames.iter().enumerate().skip(1) {
        let rotation = kinematics.frames[i].rotation;
        list.push(match &frame.mass {
            Some(mass) => {
                let center = kinematics.position(scene, PointRef::Center(FrameId(i)));
                FreeBody { mass: mass.mass, center, rotation, inertia: inertia_parts(scene, mass) }
            }
            None => FreeBody { mass: zero, center: kinematics.frames[i].origin, rotation, inertia: Vec::new() },
        });
    }
    list
}

/// The place of a frame among the bodies; the ground is none.
fn body(frame: FrameId) -> Option<usize> {
    frame.index().checked_sub(1)
}

/// The released frames with their displacements.
pub fn frames(
    scene: &mut Scene,
    kinematics: &Kinematics,
    displacements: &[(FrameId, Displacement)],
    (loads, coupled, connected): (&[Act], &[Act], &Connected),
) -> Vec<FreeFrame> {
    let mut released: Vec<FreeFrame> = Vec::new();
    let acting = acting(scene, (loads, coupled), connected);
    for (frame, displacement) in displacements {
        let name = &scene.model.frames[frame.index()].name;
        let way = way(scene, displacement);
        if let Some(known) = released.iter_mut().find(|f| f.name.en == *name) {
            known.ways.push(way);
            continue;
        }
        let all = (0..scene.model.frames.len()).map(FrameId);
        let on: Vec<usize> = all.filter(|f| chain(scene, *f).contains(frame)).filter_map(body).collect();
        let on_it = |act: &&Act| act.frame(scene).is_some_and(|f| chain(scene, f).contains(frame));
        let carried: Vec<Act> = acting.iter().filter(on_it).cloned().collect();
        let (force, moment) = resultant(scene, kinematics, &carried);
        let origin = kinematics.frames[frame.index()].origin;
        released.push(FreeFrame { name: Text::same(name), bodies: on, origin, force, moment, ways: vec![way] });
    }
    released
}

/// Loads, inertia along coordinates as loads, and reactions.
fn acting(scene: &mut Scene, (loads, coupled): (&[Act], &[Act]), connected: &Connected) -> Vec<Act> {
    let minus = scene.graph.int(-1);
    let mut list = loads.to_vec();
    list.extend(coupled.iter().map(|act| act.times(scene, minus)));
    for (reaction, acts) in connected.reactions.iter().zip(&connected.acts) {
        let value = scene.graph.symbol(reaction.symbol);
        list.extend(acts.iter().map(|act| act.times(scene, value)));
    }
    list
}

/// What acts on each body by itself, and along each coordinate by formulas.
pub fn act(scene: &mut Scene, kinematics: &mut Kinematics, loads: &[Act], inertial: &[Act], connected: &mut Connected) {
    let acting = acting(scene, (loads, &without_bodies(inertial)), connected);
    let count = connected.free.bodies.len();
    let mut by_body: Vec<Vec<Act>> = vec![Vec::new(); count];
    let mut along: Vec<Vec<Expr>> = vec![Vec::new(); scene.n()];
    for act in acting {
        let count = along.len();
        if let Act::Along(Along { columns, .. }) = &act {
            columns.range(..count).for_each(|(j, e)| along[*j].push(*e));
            continue;
        }
        wandering(scene, kinematics, &act).range(..count).for_each(|(j, e)| along[*j].push(*e));
        if let Some(list) = act.frame(scene).and_then(body).and_then(|b| by_body.get_mut(b)) {
            list.push(act);
        }
    }
    connected.free.wrenches = by_body.iter().map(|acts| wrench(scene, kinematics, acts)).collect();
    connected.free.along = along.iter().map(|terms| [scene.graph.sum(terms), without_signs(scene, terms)]).collect();
}

/// The work of a force at a point that coordinates move along its body, over the way on the body: in a displacement of the body its particle does not go along.
fn wandering(scene: &mut Scene, kinematics: &mut Kinematics, act: &Act) -> Columns<Expr> {
    let Act::Point { point: point @ PointRef::Point(p), force } = act else { return Columns::new() };
    let model = scene.model;
    let own = &model.points[p.index()];
    if own.at.iter().all(|e| scene.gradient(*e).is_empty()) {
        return Columns::new();
    }
    let at = kinematics.position(scene, *point);
    let of_particle = particle(scene, kinematics, own.on, &at);
    let zero = scene.zero_vector();
    let ways = kinematics.jacobian(scene, *point).into_iter().map(|(j, column)| {
        let carried = of_particle.get(&j).copied().unwrap_or(zero);
        let way = scene.minus(&column, &carried);
        (j, scene.dot(force, &way))
    });
    ways.collect()
}

fn wrench(scene: &mut Scene, kinematics: &Kinematics, acts: &[Act]) -> Wrench {
    let parts: Vec<[Vector; 2]> = acts.iter().filter_map(|act| at_ground(scene, kinematics, act)).collect();
    let sum = |scene: &mut Scene, k: usize| [0, 1, 2].map(|i| scene.graph.sum(&parts.iter().map(|p| p[k][i]).collect::<Vec<_>>()));
    let (force, moment) = (sum(scene, 0), sum(scene, 1));
    let sizes = [0, 1].map(|k| [0, 1, 2].map(|i| without_signs(scene, &parts.iter().map(|p| p[k][i]).collect::<Vec<_>>())));
    Wrench { force, moment, sizes }
}

fn without_signs(scene: &mut Scene, terms: &[Expr]) -> Expr {
    let sizes: Vec<Expr> = terms.iter().map(|e| scene.graph.call(Function::Abs, &[*e])).collect();
    scene.graph.sum(&sizes)
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
        let Some([force, moment]) = at_ground(scene, kinematics, act) else { continue };
        forces.iter_mut().zip(force).for_each(|(sum, e)| sum.push(e));
        moments.iter_mut().zip(moment).for_each(|(sum, e)| sum.push(e));
    }
    (forces.map(|terms| scene.graph.sum(&terms)), moments.map(|terms| scene.graph.sum(&terms)))
}

/// Force, and moment about the origin of the ground; none of a formula.
fn at_ground(scene: &mut Scene, kinematics: &Kinematics, act: &Act) -> Option<[Vector; 2]> {
    let (at, force) = match act {
        Act::Point { point, force } => (kinematics.position(scene, *point), *force),
        Act::Place { at, force, .. } => (*at, *force),
        Act::Turn { moment, .. } => return Some([scene.zero_vector(), *moment]),
        Act::Along(_) => return None,
    };
    Some([force, scene.cross(&at, &force)])
}
