//! What inertia asks of each body: m a, I ω' + ω × I ω, momenta.

use super::lagrange::inertia_parts;
use crate::model::{FrameId, PointRef};
use crate::scene::kinematics::{Kinematics, combine};
use crate::scene::wrench::{Act, Along, Formula};
use crate::scene::{Columns, Scene, Vector};
use symbolic::Expr;

/// m a and I ω' + ω × I ω of every body, as if they acted on it; ground axes.
pub fn inertial(scene: &mut Scene, kinematics: &mut Kinematics) -> Vec<Act> {
    let model = scene.model;
    let mut acts = Vec::new();
    for (i, frame) in model.frames.iter().enumerate() {
        let Some(mass) = &frame.mass else { continue };
        if !scene.graph.is_zero(mass.mass) {
            let point = PointRef::Center(FrameId(i));
            let position = kinematics.position(scene, point);
            let velocity = scene.total_vector(position);
            let acceleration = scene.total_vector(velocity);
            acts.push(Act::Point { point, force: acceleration.map(|a| scene.graph.mul(mass.mass, a)) });
        }
        let parts = inertia_parts(scene, mass);
        if !parts.is_empty() {
            let turning = kinematics.frames[i].turning.clone();
            let moment = moment(scene, &turning, &parts);
            acts.push(Act::Turn { on: FrameId(i), moment: kinematics.in_ground_axes(scene, FrameId(i), &moment) });
        }
    }
    for inertia in &model.inertias {
        let [a, b] = inertia.between;
        let mut columns = Columns::from([(a, scene.graph.mul(inertia.value, scene.q[b][2]))]);
        columns.insert(b, scene.graph.mul(inertia.value, scene.q[a][2]));
        let name = scene.model.coordinates[a].name.clone();
        acts.push(Act::Along(Along { name, columns, of: Formula::Function }));
    }
    acts
}

/// Momenta and angular momenta that prescribed motions give bodies at rates of zero, as forces and moments on them; ground axes.
pub fn carried(scene: &mut Scene, kinematics: &mut Kinematics) -> Vec<Act> {
    let (model, time) = (scene.model, scene.n());
    let mut acts = Vec::new();
    for (i, frame) in model.frames.iter().enumerate() {
        let Some(mass) = &frame.mass else { continue };
        let point = PointRef::Center(FrameId(i));
        if let Some(velocity) = kinematics.jacobian(scene, point).get(&time).copied() {
            acts.push(Act::Point { point, force: velocity.map(|v| scene.graph.mul(mass.mass, v)) });
        }
        let parts = inertia_parts(scene, mass);
        if let Some(w) = kinematics.frames[i].turning.get(&time).copied() {
            let momentum = momentum(scene, &w, &parts);
            acts.push(Act::Turn { on: FrameId(i), moment: kinematics.in_ground_axes(scene, FrameId(i), &momentum) });
        }
    }
    acts
}

/// I ω' + ω × I ω in body axes.
pub fn moment(scene: &mut Scene, turning: &Columns<Vector>, parts: &[(usize, usize, Expr)]) -> Vector {
    let w = combine(scene, turning);
    let momentum = momentum(scene, &w, parts);
    let rate = scene.total_vector(momentum);
    let carried = scene.cross(&w, &momentum);
    scene.plus(&rate, &carried)
}

/// I ω in body axes.
fn momentum(scene: &mut Scene, w: &Vector, parts: &[(usize, usize, Expr)]) -> Vector {
    let mut momentum: [Vec<Expr>; 3] = Default::default();
    for (k, l, component) in parts {
        momentum[*k].push(scene.graph.mul(*component, w[*l]));
        if k != l {
            momentum[*l].push(scene.graph.mul(*component, w[*k]));
        }
    }
    momentum.map(|terms| scene.graph.sum(&terms))
}
