//! The second derivation: Newton's and Euler's equations of every body, projected on the directions of motion.
//!
//! ```text
//! R_i = Σ_bodies ( m a·J_i + (I ω' + ω × I ω)·W_i ) - Q_i
//! ```
//!
//! Accelerations come from positions by differentiation twice, moments from angular momentum in body axes, forces of elements from
//! geometry. The residual vanishes where Lagrange's equations hold; in the time direction it is the power of the drives that realise
//! the prescribed motions.

use super::connections::Connected;
use super::inertial::moment;
use super::lagrange::inertia_parts;
use super::loads::Loads;
use crate::model::{FrameId, PointRef};
use crate::scene::kinematics::{Kinematics, combine};
use crate::scene::{Columns, Scene, Vector};
use symbolic::Expr;

/// The projected equations.
#[derive(Clone, Debug)]
pub struct Projected {
    /// R_i for every coordinate.
    pub residuals: Vec<Expr>,
    /// Power of the drives.
    pub drives: Expr,
    /// Its parts by size, |m a_k v_k| and |(I ω' + ω × I ω)_k ω_k| of every body and axis: in a frame that turns they cancel. None without drives.
    pub sizes: Vec<Expr>,
}

/// Projects the equations of all bodies.
pub fn project(scene: &mut Scene, kinematics: &mut Kinematics, loads: &Loads, connected: &Connected) -> Projected {
    let n = scene.n();
    let (mut inertial, mut powers): (Vec<Vec<Expr>>, Vec<(Vector, Vector)>) = (vec![Vec::new(); n + 1], Vec::new());
    let model = scene.model;
    for (i, frame) in model.frames.iter().enumerate() {
        let Some(mass) = &frame.mass else { continue };
        if !scene.graph.is_zero(mass.mass) {
            let center = PointRef::Center(FrameId(i));
            let position = kinematics.position(scene, center);
            let velocity = scene.total_vector(position);
            let acceleration = scene.total_vector(velocity);
            let force = acceleration.map(|a| scene.graph.mul(mass.mass, a));
            let columns = kinematics.jacobian(scene, center);
            push_projection(scene, &force, &columns, &mut inertial);
            powers.push((force, velocity));
        }
        let parts = inertia_parts(scene, mass);
        if !parts.is_empty() {
            let turning = kinematics.frames[i].turning.clone();
            let moment = moment(scene, &turning, &parts);
            push_projection(scene, &moment, &turning, &mut inertial);
            powers.push((moment, combine(scene, &turning)));
        }
    }
    for inertia in &model.inertias {
        let [a, b] = inertia.between;
        let (qa, qb) = (scene.q[a][2], scene.q[b][2]);
        inertial[a].push(scene.graph.mul(inertia.value, qb));
        if a != b {
            inertial[b].push(scene.graph.mul(inertia.value, qa));
        }
    }
    let mut sums: Vec<Expr> = inertial.iter().map(|terms| scene.graph.sum(terms)).collect();
    let time_part = sums.pop().unwrap_or_else(|| scene.graph.zero());
    let residuals = sums
        .into_iter()
        .enumerate()
        .map(|(j, inertial)| {
            let forces = [&loads.conservative, &loads.resisting, &loads.applied].map(|l| Loads::in_direction(scene, l, j));
            let reactions = connected.geometric_force(scene, j);
            let force = scene.graph.sum(&forces);
            let force = scene.graph.add(force, reactions);
            scene.graph.sub(inertial, force)
        })
        .collect();
    // drives supply what inertia needs in the time direction, less what other forces give there, plus the growth of potentials by time
    let forces = [&loads.resisting, &loads.applied].map(|l| Loads::in_direction(scene, l, n));
    let reactions = connected.geometric_force(scene, n);
    let force = scene.graph.sum(&forces);
    let force = scene.graph.add(force, reactions);
    let change = scene.graph.sum(&loads.potential_change);
    let drives = scene.graph.sub(time_part, force);
    let drives = scene.graph.add(drives, change);
    let sizes = if scene.graph.is_zero(drives) { Vec::new() } else { sizes(scene, &powers) };
    Projected { residuals, drives, sizes }
}

/// |f_k v_k| of every pair of vectors and every component.
fn sizes(scene: &mut Scene, pairs: &[(Vector, Vector)]) -> Vec<Expr> {
    let products: Vec<(Expr, Expr)> = pairs.iter().flat_map(|(f, v)| f.iter().copied().zip(v.iter().copied())).collect();
    let size = |(f, v): (Expr, Expr)| {
        let power = scene.graph.mul(f, v);
        scene.graph.call(symbolic::Function::Abs, &[power])
    };
    products.into_iter().map(size).collect()
}

fn push_projection(scene: &mut Scene, force: &Vector, columns: &Columns<Vector>, out: &mut [Vec<Expr>]) {
    for (j, column) in columns {
        let e = scene.dot(force, column);
        out[*j].push(e);
    }
}
