//! Axes of bodies in ground components, and which of them stay parallel.

use crate::model::{Axis, FrameId};
use crate::scene::kinematics::Kinematics;
use crate::scene::pathways::unit_vector;
use crate::scene::{Scene, Vector};
use symbolic::{Expr, Function};

/// The axes of a frame in ground components.
pub fn axes_of(scene: &mut Scene, kinematics: &Kinematics, frame: FrameId) -> [Vector; 3] {
    [Axis::X, Axis::Y, Axis::Z].map(|axis| {
        let unit = unit_vector(scene, axis);
        kinematics.in_ground_axes(scene, frame, &unit)
    })
}

/// Unit vectors along and across (turned by +90 degrees) a line of a frame, ground components.
pub fn line(scene: &mut Scene, kinematics: &Kinematics, frame: FrameId, direction: Expr) -> (Vector, Vector) {
    let (c, s) = (scene.graph.call(Function::Cos, &[direction]), scene.graph.call(Function::Sin, &[direction]));
    let (m, zero) = (scene.graph.neg(s), scene.graph.zero());
    // in the plane one rotation by the sum of the angles
    if let Some(angle) = kinematics.frames[frame.index()].plane_angle {
        let total = scene.graph.add(angle, direction);
        let (c, s) = (scene.graph.call(Function::Cos, &[total]), scene.graph.call(Function::Sin, &[total]));
        let m = scene.graph.neg(s);
        return ([c, s, zero], [m, c, zero]);
    }
    (kinematics.in_ground_axes(scene, frame, &[c, s, zero]), kinematics.in_ground_axes(scene, frame, &[m, c, zero]))
}

/// The axis about which two bodies turn that are wheels of one drive: the only axis of the second that stays parallel to an axis of the first. In the
/// plane that is z. None when no axis does, or several: then the bodies do not turn against each other.
pub fn common(scene: &mut Scene, kinematics: &Kinematics, [a, b]: [FrameId; 2]) -> Option<Vector> {
    let plane = |f: FrameId| kinematics.frames[f.index()].plane_angle.is_some();
    if plane(a) && plane(b) {
        return Some(unit_vector(scene, Axis::Z));
    }
    let own = axes_of(scene, kinematics, b);
    let kept: Vec<Vector> = own.into_iter().filter(|e| keeps(scene, kinematics, a, e)).collect();
    match kept[..] {
        [only] => Some(only),
        _ => None,
    }
}

/// Whether an axis of a frame stays parallel to a vector.
pub fn keeps(scene: &mut Scene, kinematics: &Kinematics, frame: FrameId, e: &Vector) -> bool {
    axes_of(scene, kinematics, frame).iter().any(|own| {
        let sine = scene.cross(own, e);
        sine.iter().all(|component| scene.vanishes(*component))
    })
}

/// The part of a vector across a unit vector.
pub fn across(scene: &mut Scene, v: &Vector, e: &Vector) -> Vector {
    let along = scene.dot(v, e);
    let along = scene.tidy(along);
    if scene.graph.is_zero(along) {
        return *v;
    }
    [0, 1, 2].map(|i| {
        let part = scene.graph.mul(along, e[i]);
        let left = scene.graph.sub(v[i], part);
        scene.tidy(left)
    })
}
