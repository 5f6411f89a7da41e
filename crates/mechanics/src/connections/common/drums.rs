//! Drums on which ropes wind: the angle that winds.
//!
//! A drum takes up r (ω - ω_run), where the run is the piece of rope between the drum and the nearest point of the path. The run turns with the body that
//! carries the drum's axis when a point of that body, other than the axis, is an end of the path or next to the drum; it does not turn where it keeps its
//! direction. Otherwise it is unknown what the angle counts from, and the model must say it. On a body that does not turn the motion is the same either way; the
//! couple of the rope, which that body or the ground holds, is not.

use super::faults;
use crate::model::{Connection, FrameId, PointRef, Wound};
use crate::scene::kinematics::{Kinematics, combine};
use crate::scene::pathways::{Path, relative_angle};
use crate::scene::wrench::{carrier, frame_of, particle};
use crate::scene::{Found, Scene, Vector};

/// The angle of a drum that winds the rope, counted from its carrier.
pub fn turn(
    scene: &mut Scene,
    kinematics: &mut Kinematics,
    connection: &Connection,
    (drum, corners, wound): (&Wound, &[PointRef], &[Wound]),
) -> Found<Path> {
    let base = match drum.carrier {
        Some(named) => Some(named),
        None => base(scene, kinematics, (drum.on, corners, wound)),
    };
    match base {
        Some(base) => relative_angle(scene, kinematics, (base, drum.on), &connection.span),
        None => Err(faults::no_drum_carrier(scene.model, connection, drum.on)),
    }
}

/// What the angle of a drum counts from; none when that cannot be known.
fn base(scene: &mut Scene, kinematics: &mut Kinematics, (drum, corners, wound): (FrameId, &[PointRef], &[Wound])) -> Option<FrameId> {
    let parent = carrier(scene.model, drum);
    let turns = !kinematics.frames[parent.index()].turning.is_empty();
    let plane = kinematics.frames[drum.index()].plane_angle.is_some();
    let hinged = is_fixed(scene, kinematics, PointRef::Origin(drum), parent);
    let moves = turns || !kinematics.jacobian(scene, PointRef::Origin(drum)).is_empty();
    let ends: Vec<usize> = if corners.is_empty() { Vec::new() } else { vec![0, corners.len() - 1] };
    let own: Vec<usize> = ends.iter().copied().filter(|i| frame_of(scene, corners[*i]) == drum).collect();
    let runs = hinged && ends.iter().any(|i| runs_over(scene, kinematics, (drum, parent), (corners, *i)));
    let held = runs || leaves_over(scene, (drum, parent), corners);
    let counted = if plane && !turns && !held { FrameId::GROUND } else { parent };
    let known = if corners.is_empty() {
        hinged && (!moves || wound.iter().all(|other| carrier(scene.model, other.on) == parent))
    } else if hinged && turns {
        ends.iter().any(|i| is_fixed(scene, kinematics, corners[*i], parent))
    } else if hinged {
        let steady = own.iter().all(|i| is_steady(scene, kinematics, (drum, corners, *i)));
        runs || steady && !(moves && own.is_empty())
    } else {
        !turns && ends.iter().any(|i| is_steady(scene, kinematics, (drum, corners, *i)))
    };
    known.then_some(counted)
}

/// Whether the rope's pull on the drum is counted where it leaves, at a point of what carries the drum: its moment about the axle is then held there, and not
/// by the ground. Two drums without a path between them hold each other.
fn leaves_over(scene: &Scene, (drum, parent): (FrameId, FrameId), corners: &[PointRef]) -> bool {
    let of_parent = |corner: Option<&PointRef>| corner.is_some_and(|c| is_of(scene, frame_of(scene, *c), (drum, parent)));
    corners.is_empty() || of_parent(corners.first()) || of_parent(corners.last())
}

/// Whether the piece of rope at an end of the path keeps its place on what carries the drum: the end is fixed there, or, where the path ends in the drum's own
/// axis, which always is, the corner after it. The pull is then held there too.
fn runs_over(
    scene: &mut Scene,
    kinematics: &mut Kinematics,
    (drum, parent): (FrameId, FrameId),
    (corners, end): (&[PointRef], usize),
) -> bool {
    let next = if end == 0 { 1 } else { end - 1 };
    let corner = if frame_of(scene, corners[end]) == drum { corners.get(next) } else { corners.get(end) };
    corner.is_some_and(|corner| frame_of(scene, *corner) != drum && is_fixed(scene, kinematics, *corner, parent))
}

/// Whether a frame is `parent` or stands on it without a joint of its own; the drum does not.
fn is_of(scene: &Scene, mut frame: FrameId, (drum, parent): (FrameId, FrameId)) -> bool {
    while frame != drum {
        let own = &scene.model.frames[frame.index()];
        if frame == parent {
            return true;
        }
        if frame == FrameId::GROUND || !own.rotations.is_empty() || own.spin.is_some() {
            return false;
        }
        frame = carrier(scene.model, frame);
    }
    false
}

/// Whether a point is fixed in a frame.
pub fn is_fixed(scene: &mut Scene, kinematics: &mut Kinematics, point: PointRef, frame: FrameId) -> bool {
    let at = kinematics.position(scene, point);
    let (own, carried) = (kinematics.jacobian(scene, point), particle(scene, kinematics, frame, &at));
    let [own, carried] = [own, carried].map(|columns| combine(scene, &columns));
    let relative = scene.minus(&own, &carried);
    is_none(scene, &relative)
}

/// Whether an end of the path moves with the drum's axis without turning about it, and the rope there keeps its direction.
fn is_steady(scene: &mut Scene, kinematics: &mut Kinematics, (drum, corners, end): (FrameId, &[PointRef], usize)) -> bool {
    let next = if end == 0 { corners.get(1) } else { corners.get(end - 1) };
    let Some(next) = next else { return false };
    let [axis, here, there] = [PointRef::Origin(drum), corners[end], *next].map(|p| kinematics.position(scene, p));
    let arm = scene.minus(&here, &axis);
    let arm = scene.total_vector(arm);
    let run = scene.minus(&there, &here);
    let speed = scene.total_vector(run);
    let turning = scene.cross(&run, &speed);
    is_none(scene, &arm) && is_none(scene, &turning)
}

fn is_none(scene: &mut Scene, v: &Vector) -> bool {
    v.iter().all(|e| scene.vanishes(*e))
}
