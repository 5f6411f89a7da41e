//! What acts where: forces at points, forces at places of a body, moments on bodies.
//!
//! Newton-Euler's side of every load and reaction. Its generalized force is its power in the velocity of the place it acts on, found
//! from velocities of points and bodies, not by differentiation of the element's scalar.

use super::kinematics::Kinematics;
use super::{Columns, Scene, Vector};
use crate::model::{FrameId, Measure, Model, Origin, PointRef};
use symbolic::Expr;

/// An action on a body, ground axes.
#[derive(Clone, PartialEq, Debug)]
pub enum Act {
    /// A force at a point, with which it moves.
    Point {
        /// Where.
        point: PointRef,
        /// Force.
        force: Vector,
    },
    /// A force on that particle of a body which is at a place just now.
    Place {
        /// The body.
        on: FrameId,
        /// Ground coordinates.
        at: Vector,
        /// Force.
        force: Vector,
    },
    /// A moment on a body.
    Turn {
        /// The body.
        on: FrameId,
        /// Moment.
        moment: Vector,
    },
    /// A generalized force by a formula: `derive::place` finds the bodies it acts on.
    Along(Along),
}

/// A generalized force by a formula of coordinates.
#[derive(Clone, PartialEq, Debug)]
pub struct Along {
    /// The element it belongs to.
    pub name: String,
    /// Force in each direction.
    pub columns: Columns<Expr>,
    /// What it is the force of.
    pub of: Formula,
}

/// What a generalized force is the force of.
#[derive(Clone, PartialEq, Debug)]
pub enum Formula {
    /// A pathway: its gradient, and what it measures.
    Pathway(Columns<Expr>, Measure),
    /// A function of its own: a potential, a dissipation function, inertia along coordinates.
    Function,
}

impl Act {
    /// The same times a factor.
    pub fn times(&self, scene: &mut Scene, factor: Expr) -> Act {
        let mut scaled = |v: &Vector| v.map(|e| scene.graph.mul(factor, e));
        match self {
            Act::Point { point, force } => Act::Point { point: *point, force: scaled(force) },
            Act::Place { on, at, force } => Act::Place { on: *on, at: *at, force: scaled(force) },
            Act::Turn { on, moment } => Act::Turn { on: *on, moment: scaled(moment) },
            Act::Along(along) => {
                let columns = along.columns.iter().map(|(j, e)| (*j, scene.graph.mul(factor, *e))).collect();
                Act::Along(Along { columns, ..along.clone() })
            }
        }
    }

    /// The body it acts on; none for a formula.
    pub fn frame(&self, scene: &Scene) -> Option<FrameId> {
        match self {
            Act::Point { point, .. } => Some(frame_of(scene, *point)),
            Act::Place { on, .. } | Act::Turn { on, .. } => Some(*on),
            Act::Along(_) => None,
        }
    }
}

/// The frame a point belongs to.
pub fn frame_of(scene: &Scene, point: PointRef) -> FrameId {
    match point {
        PointRef::Point(p) => scene.model.points[p.index()].on,
        PointRef::Origin(f) | PointRef::Center(f) => f,
    }
}

/// The frame that a frame is attached to: that of the point where its origin is, whatever axes its angle counts from.
pub fn carrier(model: &Model, frame: FrameId) -> FrameId {
    let frame = &model.frames[frame.index()];
    match frame.origin {
        Origin::Point(p) => model.points[p.index()].on,
        Origin::Vector(_) => frame.on,
    }
}

/// Generalized forces of actions in all directions.
pub fn generalized(scene: &mut Scene, kinematics: &mut Kinematics, acts: &[Act]) -> Columns<Expr> {
    let mut sums: Columns<Vec<Expr>> = Columns::new();
    for act in acts {
        for (j, e) in one(scene, kinematics, act) {
            sums.entry(j).or_default().push(e);
        }
    }
    sums.into_iter().map(|(j, terms)| (j, scene.graph.sum(&terms))).collect()
}

fn one(scene: &mut Scene, kinematics: &mut Kinematics, act: &Act) -> Columns<Expr> {
    let (force, columns) = match act {
        Act::Point { point, force } => (force, kinematics.jacobian(scene, *point)),
        Act::Place { on, at, force } => (force, particle(scene, kinematics, *on, at)),
        Act::Turn { on, moment } => (moment, kinematics.turning_in_ground_axes(scene, *on)),
        Act::Along(along) => return along.columns.clone(),
    };
    columns.iter().map(|(j, column)| (*j, scene.dot(force, column))).collect()
}

/// Velocity of the particle of a body at a place = Σ column·rate: that of the origin and ω × r.
pub fn particle(scene: &mut Scene, kinematics: &mut Kinematics, on: FrameId, at: &Vector) -> Columns<Vector> {
    let mut columns = kinematics.jacobian(scene, PointRef::Origin(on));
    let origin = kinematics.frames[on.index()].origin;
    let arm = scene.minus(at, &origin);
    for (j, w) in kinematics.turning_in_ground_axes(scene, on) {
        let turned = scene.cross(&w, &arm);
        let zero = scene.zero_vector();
        let column = columns.entry(j).or_insert(zero);
        *column = scene.plus(column, &turned);
    }
    columns
}
