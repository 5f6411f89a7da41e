//! Sliders and slots: a point stays on a straight line.
//!
//! In the plane one direction is held, across the line. In space two are: across the line in the plane x, y of the line's frame, and along z of that
//! frame; the second is left out where the coordinates hold the point there anyway.

use super::axes::{axes_of, line};
use super::component::{Component, no_turning};
use crate::derive::kinematics::Kinematics;
use crate::derive::scene::{Scene, Vector};
use crate::derive::wrench::{Act, frame_of};
use crate::model::{FrameId, Part, PointRef};
use symbolic::Expr;
use words::Text;

/// The point, the frame of the line, a point of the line, its direction, whether the point's body may turn.
pub type Guide = (PointRef, FrameId, Option<PointRef>, Expr, bool);

/// n·(r_P - r_T) for a line through T; n·(r_P - r_O) stays as it was for a line without a given point.
pub fn slider(scene: &mut Scene, kinematics: &mut Kinematics, name: &str, guide: Guide) -> Vec<Component> {
    let (point, on, _, direction, turns) = guide;
    let (_, normal) = line(scene, kinematics, on, direction);
    let upright = axes_of(scene, kinematics, on)[2];
    let way = |what: &str, russian: &str| {
        Text::new(format!("slider {name}, normal force{what}"), format!("ползун {name}, нормальная реакция{russian}"))
    };
    let aside =
        held(scene, kinematics, (guide, upright), (Part::ForceZ, "Z", way(" along z of the line's frame", " вдоль оси z системы прямой")));
    let mut list = if is_free(scene, &aside) {
        let label = way(" in the plane x, y of the line's frame", " в плоскости x, y системы прямой");
        vec![held(scene, kinematics, (guide, normal), (Part::ForceY, "Y", label)), aside]
    } else {
        vec![held(scene, kinematics, (guide, normal), (Part::Force, "N", way("", "")))]
    };
    if !turns {
        let frames = [on, frame_of(scene, point)];
        list.extend(no_turning(scene, kinematics, name, frames));
    }
    list
}

/// One direction across the line.
fn held(
    scene: &mut Scene,
    kinematics: &mut Kinematics,
    ((point, on, through, ..), normal): (Guide, Vector),
    (part, letter, label): (Part, &'static str, Text),
) -> Component {
    let at = kinematics.position(scene, point);
    let anchor = kinematics.position(scene, through.unwrap_or(PointRef::Origin(on)));
    let between = scene.minus(&at, &anchor);
    let distance = scene.dot(&normal, &between);
    let distance = scene.tidy(distance);
    let against = normal.map(|e| scene.graph.neg(e));
    let acts = vec![Act::Point { point, force: normal }, Act::Place { on, at, force: against }];
    let (place, rate) = match through {
        Some(_) => (Some(distance), None),
        None => (None, Some(scene.total(distance))),
    };
    Component { place, rate, ..Component::ideal((part, letter, "N"), label, acts) }
}

/// Whether some coordinate moves the point in the direction that a component holds.
fn is_free(scene: &mut Scene, component: &Component) -> bool {
    let rate = match (component.rate, component.place) {
        (Some(rate), _) => rate,
        (None, Some(place)) => scene.total(place),
        (None, None) => return false,
    };
    (0..scene.n()).any(|j| {
        let slope = scene.by_rate(rate, j);
        !scene.vanishes(slope)
    })
}
