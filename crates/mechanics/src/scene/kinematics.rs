//! Where everything is: rotations, origins and angular velocities of frames, positions and Jacobians of points.
//!
//! Rotation matrices turn frame components into ground components. Angular velocities are kept in the axes of their own frame, where
//! inertia is constant: through a rotation by α about axis a, `ω -> R_a(α)^T ω + a α'`. Chains of rotations about z are one rotation by
//! the sum of the angles, so plane machines never see products of rotations.

use super::{Columns, Scene, Vector};
use crate::model::{Axis, Frame, FrameId, Origin, PointRef};
use rustc_hash::FxHashMap;
use symbolic::{Expr, Function};

/// A rotation matrix, ground from frame.
pub type Rotation = [[Expr; 3]; 3];

/// Kinematics of one frame.
#[derive(Clone, Debug)]
pub struct FrameMotion {
    /// Ground components from frame components.
    pub rotation: Rotation,
    /// The angle about z when all rotations so far are about z.
    pub plane_angle: Option<Expr>,
    /// Position of the origin, ground axes.
    pub origin: Vector,
    /// Angular velocity = Σ column·rate, frame axes.
    pub turning: Columns<Vector>,
}

/// Kinematics of the machine.
#[derive(Debug, Default)]
pub struct Kinematics {
    /// As `Model::frames`.
    pub frames: Vec<FrameMotion>,
    jacobians: FxHashMap<PointRef, Columns<Vector>>,
}

impl Kinematics {
    /// Follows the frame tree from the ground.
    pub fn new(scene: &mut Scene) -> Kinematics {
        let model = scene.model;
        let mut kinematics = Kinematics::default();
        let (zero, one) = (scene.graph.zero(), scene.graph.one());
        kinematics.frames.push(FrameMotion {
            rotation: [[one, zero, zero], [zero, one, zero], [zero, zero, one]],
            plane_angle: Some(zero),
            origin: [zero; 3],
            turning: Columns::new(),
        });
        for (i, frame) in model.frames.iter().enumerate().skip(1) {
            let origin = match &frame.origin {
                Origin::Vector(v) => kinematics.to_ground(scene, frame.on, *v),
                Origin::Point(p) => kinematics.position(scene, PointRef::Point(*p)),
            };
            let mut motion = FrameMotion { origin, ..kinematics.frames[frame.on.index()].clone() };
            origin.iter().for_each(|e| scene.must_exist(*e));
            for (axis, angle) in rotations(scene, i, frame) {
                scene.must_exist(angle);
                turn(scene, &mut motion, axis, angle);
            }
            kinematics.frames.push(motion);
        }
        kinematics
    }

    /// Ground coordinates of a place given in the axes and from the origin of a frame.
    fn to_ground(&self, scene: &mut Scene, frame: FrameId, at: Vector) -> Vector {
        let at = scene.open_vector(at);
        let turned = self.in_ground_axes(scene, frame, &at);
        scene.plus(&self.frames[frame.index()].origin.clone(), &turned)
    }

    /// Ground components of a vector given in the axes of a frame.
    pub fn in_ground_axes(&self, scene: &mut Scene, frame: FrameId, v: &Vector) -> Vector {
        if frame == FrameId::GROUND {
            return *v;
        }
        let rotation = self.frames[frame.index()].rotation;
        rotation.map(|row| scene.dot(&row, v))
    }

    /// Ground coordinates of a point.
    pub fn position(&self, scene: &mut Scene, point: PointRef) -> Vector {
        let model = scene.model;
        match point {
            PointRef::Point(p) => {
                let p = &model.points[p.index()];
                self.to_ground(scene, p.on, p.at)
            }
            PointRef::Origin(f) => self.frames[f.index()].origin,
            PointRef::Center(f) => match &model.frames[f.index()].mass {
                Some(mass) => self.to_ground(scene, f, mass.center),
                None => self.frames[f.index()].origin,
            },
        }
    }

    /// Velocity of a point = Σ column·rate, ground axes; the columns are the derivatives of its position.
    pub fn jacobian(&mut self, scene: &mut Scene, point: PointRef) -> Columns<Vector> {
        if let Some(known) = self.jacobians.get(&point) {
            return known.clone();
        }
        let position = self.position(scene, point);
        let mut columns = Columns::new();
        for (i, component) in position.iter().enumerate() {
            for (j, derivative) in scene.gradient(*component) {
                let zero = scene.zero_vector();
                columns.entry(j).or_insert(zero)[i] = derivative;
            }
        }
        self.jacobians.insert(point, columns.clone());
        columns
    }

    /// Angular velocity in ground axes = Σ column·rate.
    pub fn turning_in_ground_axes(&self, scene: &mut Scene, frame: FrameId) -> Columns<Vector> {
        let turning = self.frames[frame.index()].turning.clone();
        turning.into_iter().map(|(j, w)| (j, self.in_ground_axes(scene, frame, &w))).collect()
    }

    /// Angular velocity in the frame's own axes.
    pub fn angular_velocity(&self, scene: &mut Scene, frame: FrameId) -> Vector {
        let turning = self.frames[frame.index()].turning.clone();
        combine(scene, &turning)
    }
}

/// Σ column·rate.
pub fn combine(scene: &mut Scene, columns: &Columns<Vector>) -> Vector {
    [0, 1, 2].map(|i| {
        let terms: Vec<Expr> = columns
            .iter()
            .map(|(j, column)| {
                let rate = scene.rate(*j);
                scene.graph.mul(column[i], rate)
            })
            .collect();
        scene.graph.sum(&terms)
    })
}

/// The rotations of a frame, the turn by its prescribed rate last.
pub(super) fn rotations(scene: &mut Scene, index: usize, frame: &Frame) -> Vec<(Axis, Expr)> {
    let mut list: Vec<(Axis, Expr)> = frame.rotations.iter().map(|(axis, angle)| (*axis, scene.open(*angle))).collect();
    if let Some((axis, _)) = frame.spin {
        let angle = scene.turns.iter().find(|t| t.frame == index).map(|t| t.symbol);
        if let Some(symbol) = angle {
            list.push((axis, scene.graph.symbol(symbol)));
        }
    }
    list
}

/// Turns a frame by an angle about one of its own axes.
fn turn(scene: &mut Scene, motion: &mut FrameMotion, axis: Axis, angle: Expr) {
    let gradient = scene.gradient(angle);
    match (motion.plane_angle, axis) {
        (Some(before), Axis::Z) => {
            let total = scene.graph.add(before, angle);
            motion.plane_angle = Some(total);
            motion.rotation = about(scene, Axis::Z, total);
        }
        _ => {
            motion.plane_angle = None;
            let step = about(scene, axis, angle);
            motion.rotation = multiply(scene, &motion.rotation, &step);
            // R^T ω
            let columns: Vec<usize> = motion.turning.keys().copied().collect();
            for j in columns {
                let w = motion.turning[&j];
                let turned = [0, 1, 2].map(|i| scene.dot(&[step[0][i], step[1][i], step[2][i]], &w));
                motion.turning.insert(j, turned.map(|e| scene.tidy(e)));
            }
        }
    }
    for (j, derivative) in gradient {
        let zero = scene.zero_vector();
        let column = motion.turning.entry(j).or_insert(zero);
        column[axis.index()] = scene.graph.add(column[axis.index()], derivative);
    }
}

/// Rotation by an angle about an axis.
fn about(scene: &mut Scene, axis: Axis, angle: Expr) -> Rotation {
    let (zero, one) = (scene.graph.zero(), scene.graph.one());
    let (c, s) = (scene.graph.call(Function::Cos, &[angle]), scene.graph.call(Function::Sin, &[angle]));
    let m = scene.graph.neg(s);
    match axis {
        Axis::X => [[one, zero, zero], [zero, c, m], [zero, s, c]],
        Axis::Y => [[c, zero, s], [zero, one, zero], [m, zero, c]],
        Axis::Z => [[c, m, zero], [s, c, zero], [zero, zero, one]],
    }
}

fn multiply(scene: &mut Scene, a: &Rotation, b: &Rotation) -> Rotation {
    a.map(|row| {
        [0, 1, 2].map(|j| {
            let e = scene.dot(&row, &[b[0][j], b[1][j], b[2][j]]);
            scene.tidy(e)
        })
    })
}
