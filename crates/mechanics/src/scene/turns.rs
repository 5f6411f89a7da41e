//! The one axis about which two bodies turn against each other.
//!
//! A body is turned by a list of rotations from the ground outwards. What is the same at the head of both lists turns both bodies alike; the rest is
//!
//! ```text
//! R_b = P A_u(β) C_b,   R_a = P A_u(α) C_a,      ω_b - ω_a = P u (β' - α')   with constant C_a, C_b
//! ```
//!
//! when both turn about one axis u first, and do not vary after it. P u is known in the axes of a body whose C is missing.

use super::Scene;
use super::kinematics::{Kinematics, rotations};
use crate::model::{Axis, FrameId};
use symbolic::Expr;

/// A turn of one frame against another about one axis.
pub(super) struct RelativeTurn {
    /// The frame in whose axes the axis stands still.
    pub frame: FrameId,
    pub axis: Axis,
    /// Angle of the second minus angle of the first.
    pub value: Expr,
}

/// The turn of b against a, where it is one about a single axis: one stands on the other, on something that does not turn, or both turn alike before it.
pub(super) fn relative_turn(scene: &mut Scene, kinematics: &Kinematics, (a, b): (FrameId, FrameId)) -> Option<RelativeTurn> {
    let still = [a, b].map(|f| kinematics.frames[f.index()].turning.is_empty());
    // the frame that turns, what it turns against, whether that is to be tried, the sign of the angle
    let ways = [(b, a, true, 1), (a, b, true, -1), (b, FrameId::GROUND, still[0], 1), (a, FrameId::GROUND, still[1], -1)];
    let found = ways.into_iter().filter(|way| way.2).find_map(|(child, parent, _, sign)| Some((turn_on(scene, child, parent)?, sign)));
    let Some((turn, sign)) = found else { return alike(scene, (a, b)) };
    let sign = scene.graph.int(sign);
    Some(RelativeTurn { value: scene.graph.mul(sign, turn.value), ..turn })
}

/// The turn of a frame against one on which it stands, when all that varies between them turns about one axis; a constant rotation counts for nothing.
fn turn_on(scene: &mut Scene, child: FrameId, parent: FrameId) -> Option<RelativeTurn> {
    let model = scene.model;
    let (mut found, mut left): (Option<RelativeTurn>, bool) = (None, false);
    let mut here = child;
    while here != parent {
        if here == FrameId::GROUND {
            return None;
        }
        let frame = &model.frames[here.index()];
        let list = rotations(scene, here.index(), frame);
        for (k, (axis, angle)) in list.iter().enumerate().rev() {
            let varies = !scene.gradient(*angle).is_empty();
            match &mut found {
                Some(turn) if turn.axis == *axis && !left => turn.value = scene.graph.add(turn.value, *angle),
                Some(_) if varies => return None,
                Some(_) => left = true,
                None if varies && list[k..].iter().all(|(other, _)| other == axis) => {
                    found = Some(RelativeTurn { frame: here, axis: *axis, value: *angle });
                }
                None if varies => return None,
                None => {}
            }
        }
        here = frame.on;
    }
    found
}

/// The turn of two frames whose rotations are the same up to the axis.
fn alike(scene: &mut Scene, (a, b): (FrameId, FrameId)) -> Option<RelativeTurn> {
    let lists = [a, b].map(|frame| from_ground(scene, frame));
    let same = lists[0].iter().zip(&lists[1]).take_while(|(one, other)| one == other).count();
    let rests = lists.each_ref().map(|list| &list[same..]);
    let axis = rests.iter().filter_map(|rest| rest.first()).find(|(_, angle)| !scene.gradient(*angle).is_empty())?.0;
    let [first, second] = rests.map(|rest| rest.iter().take_while(|(other, _)| *other == axis).count());
    let [constant_a, constant_b] = [(rests[0], first), (rests[1], second)]
        .map(|(rest, n)| rest[n..].iter().all(|(_, angle)| scene.gradient(*angle).is_empty()).then_some(rest.len() == n));
    let frame = match (constant_a?, constant_b?) {
        (_, true) => b,
        (true, _) => a,
        _ => return None,
    };
    let [alpha, beta] = [&rests[0][..first], &rests[1][..second]].map(|turns| {
        let angles: Vec<Expr> = turns.iter().map(|(_, angle)| *angle).collect();
        scene.graph.sum(&angles)
    });
    let value = scene.graph.sub(beta, alpha);
    (!scene.gradient(value).is_empty()).then_some(RelativeTurn { frame, axis, value })
}

/// All rotations of a frame, the outermost first.
fn from_ground(scene: &mut Scene, frame: FrameId) -> Vec<(Axis, Expr)> {
    let model = scene.model;
    let (mut list, mut here) = (Vec::new(), frame);
    while here != FrameId::GROUND {
        let frame = &model.frames[here.index()];
        let mut own = rotations(scene, here.index(), frame);
        own.append(&mut list);
        list = own;
        here = frame.on;
    }
    list
}
