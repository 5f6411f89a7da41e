//! The pull of a rope on a drum whose axle has a connection of its own.
//!
//! A rope that winds gives its drum the couple of its tension, and pulls at the points of its path. For the motion the two are all; a support, pin or journal of
//! the drum alone also feels the pull, S along the rope where it leaves the drum:
//!
//! ```text
//! arm × u = couple per tension,      arm · u = 0,      |arm| = r            from the centre of the drum to the end of the path
//! ```
//!
//! Where an end of the path is that place the force acts on the drum, moved to its axle with the couple. Elsewhere its line is not known.

use super::faults;
use crate::model::{Connection, ConnectionKind, FrameId, PointRef, SupportDirection, Wound};
use crate::scene::kinematics::Kinematics;
use crate::scene::wrench::{Act, frame_of};
use crate::scene::{Found, Scene};
use symbolic::Expr;

/// Whether a support or pin holds the axle of a body by forces; a pin elsewhere on it is that of a rod.
pub fn is_held(scene: &Scene, body: FrameId) -> bool {
    let force = |d: &SupportDirection| matches!(d, SupportDirection::X | SupportDirection::Y | SupportDirection::Z);
    let central = |p: &PointRef| match p {
        PointRef::Point(p) => scene.model.points[p.index()].at.iter().all(|e| scene.graph.is_zero(*e)),
        PointRef::Origin(_) | PointRef::Center(_) => true,
    };
    let axle = |p: &PointRef| frame_of(scene, *p) == body && central(p);
    scene.model.connections.iter().any(|c| match &c.kind {
        ConnectionKind::Pin { between, .. } => between.iter().any(axle),
        ConnectionKind::Support { at, directions, .. } => axle(at) && directions.iter().any(force),
        _ => false,
    })
}

/// Lets the tension pull the drum in place of what carries the point where the rope leaves it; the couple is then that of the drum alone. False where the path is
/// drawn from the drum itself.
pub fn pull_on(
    scene: &mut Scene,
    kinematics: &mut Kinematics,
    (connection, drum, corners): (&Connection, FrameId, &[PointRef]),
    (turned, pull): (&[Act], Expr),
    acts: &mut [Act],
) -> Found<bool> {
    let couple = turned.iter().find_map(|act| match act {
        Act::Turn { on, moment } if *on == drum => Some(*moment),
        _ => None,
    });
    if corners.is_empty() {
        return Err(faults::pull_unknown(scene.model, connection, drum));
    }
    let ends = [(corners[0], 0), (corners[corners.len() - 1], 2 * (corners.len() - 1) - 1)];
    for (corner, index) in ends {
        let (Some(moment), Act::Point { force, .. }) = (couple, acts[index].clone()) else { continue };
        if frame_of(scene, corner) == drum {
            return Ok(false);
        }
        let at = kinematics.position(scene, corner);
        let centre = kinematics.position(scene, PointRef::Origin(drum));
        let arm = scene.minus(&at, &centre);
        let turning = scene.cross(&arm, &force);
        let wanted = moment.map(|e| scene.graph.mul(pull, e));
        let apart = scene.minus(&turning, &wanted);
        let along = scene.dot(&arm, &force);
        if apart.iter().all(|e| scene.vanishes(*e)) && scene.vanishes(along) {
            // at the axle, with the couple: the same force, and the couple holds at every place
            acts[index] = Act::Point { point: PointRef::Origin(drum), force };
            return Ok(true);
        }
    }
    Err(faults::pull_unknown(scene.model, connection, drum))
}

/// Drums with no path between them keep their distance: the run of the rope from one to the other is not counted.
pub fn stay_apart(scene: &mut Scene, kinematics: &mut Kinematics, connection: &Connection, wound: &[Wound]) -> Found<()> {
    for pair in wound.windows(2) {
        let [a, b] = [pair[0].on, pair[1].on].map(|drum| kinematics.position(scene, PointRef::Origin(drum)));
        let between = scene.minus(&b, &a);
        let square = scene.dot(&between, &between);
        let rate = scene.total(square);
        let rate = scene.tidy(rate);
        if !scene.vanishes(rate) {
            return Err(faults::run_unknown(connection));
        }
    }
    Ok(())
}
