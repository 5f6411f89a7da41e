//! Rolling without slip: wheels on lines and circles, gears on racks. The wheel lies in the plane x, y of the frame of its track.

use super::axes::{across, axes_of, keeps, line};
use super::components::Component;
use super::faults;
use crate::derive::kinematics::{Kinematics, combine};
use crate::derive::requests::Resolver;
use crate::derive::scene::{Columns, Found, Scene, Vector};
use crate::derive::wrench::{Act, particle};
use crate::model::{Connection, ConnectionKind, FrameId, Part, PointRef, Track};
use symbolic::{Expr, Rational, Text};

/// The contact of a wheel with its track.
struct Contact {
    /// The point, ground coordinates.
    at: Vector,
    /// Along the track.
    along: Vector,
    /// From the track towards the wheel's centre.
    normal: Vector,
    /// Distance of the centre from the track less what it should be; with the flag whether only its rate is known to vanish.
    distance: (Expr, bool),
}

/// No slip at the contact point; the centre keeps its distance.
pub fn rolling(scene: &mut Scene, kinematics: &mut Kinematics, resolver: &mut Resolver, connection: &Connection) -> Found<Vec<Component>> {
    let ConnectionKind::Rolling { wheel, center, radius, on, track, held } = &connection.kind else { return Ok(Vec::new()) };
    let radius = resolver.resolve(scene, kinematics, *radius)?;
    let centre = kinematics.position(scene, *center);
    let upright = axes_of(scene, kinematics, *on)[2];
    if !keeps(scene, kinematics, *wheel, &upright) {
        return Err(faults::wheel_not_in_plane(scene.model, connection, *wheel, *on));
    }
    if leaves_plane(scene, kinematics, (*center, *on, &upright)) {
        return Err(faults::leaves_plane(scene.model, connection, *wheel, *on));
    }
    let contact = match track {
        Track::Line { through, direction, left } => {
            let direction = resolver.resolve(scene, kinematics, *direction)?;
            on_line(scene, kinematics, (centre, radius), (*on, *through, direction, *left))
        }
        Track::Circle { center, radius: large, inside } => {
            let large = resolver.resolve(scene, kinematics, *large)?;
            on_circle(scene, kinematics, (centre, radius, &upright), (*center, large, *inside))
        }
    };
    let (of_wheel, of_track) = (particle(scene, kinematics, *wheel, &contact.at), particle(scene, kinematics, *on, &contact.at));
    let slip = difference(scene, &of_wheel, &of_track);
    let slip = scene.dot(&contact.along, &slip);
    let slip = scene.tidy(slip);
    let name = &connection.name;
    let pair = |scene: &mut Scene, force: Vector| {
        let against = force.map(|e| scene.graph.neg(e));
        vec![Act::Place { on: *wheel, at: contact.at, force }, Act::Place { on: *on, at: contact.at, force: against }]
    };
    let (part, letter, what) = if connection.table == "racks" {
        (Part::Force, "F", Text::new(format!("rack {name}, tangential force"), format!("рейка {name}, окружное усилие")))
    } else {
        (Part::Tangential, "F", Text::new(format!("rolling {name}, tangential force"), format!("качение {name}, сила сцепления")))
    };
    let acts = pair(scene, contact.along);
    let mut list = vec![Component { rate: Some(slip), ..Component::ideal((part, letter, "N"), what, acts) }];
    if *held {
        let label = Text::new(format!("rolling {name}, normal force"), format!("качение {name}, нормальная реакция"));
        let acts = pair(scene, contact.normal);
        let (distance, only_rate) = contact.distance;
        let (place, rate) = if only_rate { (None, Some(scene.total(distance))) } else { (Some(distance), None) };
        list.push(Component { place, rate, ..Component::ideal((Part::Normal, "N", "N"), label, acts) });
    }
    Ok(list)
}

/// Whether the centre moves along the normal of the plane in which the track lies.
fn leaves_plane(scene: &mut Scene, kinematics: &mut Kinematics, (center, on, upright): (PointRef, FrameId, &Vector)) -> bool {
    let at = kinematics.position(scene, center);
    let (own, carried) = (kinematics.jacobian(scene, center), particle(scene, kinematics, on, &at));
    let moving = difference(scene, &own, &carried);
    let across = scene.dot(upright, &moving);
    !scene.vanishes(across)
}

fn difference(scene: &mut Scene, a: &Columns<Vector>, b: &Columns<Vector>) -> Vector {
    let (a, b) = (combine(scene, a), combine(scene, b));
    scene.minus(&a, &b)
}

/// The track passes at the distance `radius` below the wheel (to the right of its direction) when the wheel is on its left.
fn on_line(
    scene: &mut Scene,
    kinematics: &mut Kinematics,
    (centre, radius): (Vector, Expr),
    (on, through, direction, left): (FrameId, Option<PointRef>, Expr, bool),
) -> Contact {
    let (along, across) = line(scene, kinematics, on, direction);
    let normal = if left { across } else { across.map(|e| scene.graph.neg(e)) };
    let down = normal.map(|e| {
        let arm = scene.graph.mul(radius, e);
        scene.graph.neg(arm)
    });
    let at = scene.plus(&centre, &down);
    let anchor = kinematics.position(scene, through.unwrap_or(PointRef::Origin(on)));
    let between = scene.minus(&centre, &anchor);
    let distance = scene.dot(&normal, &between);
    let distance = scene.graph.sub(distance, radius);
    let distance = scene.tidy(distance);
    Contact { at, along, normal, distance: (distance, through.is_none()) }
}

/// The wheel stands outside or inside the circle.
fn on_circle(
    scene: &mut Scene,
    kinematics: &mut Kinematics,
    (centre, radius, upright): (Vector, Expr, &Vector),
    (middle, large, inside): (PointRef, Expr, bool),
) -> Contact {
    let middle = kinematics.position(scene, middle);
    let between = scene.minus(&centre, &middle);
    let between = across(scene, &between, upright);
    let square = scene.dot(&between, &between);
    let square = scene.tidy(square);
    let length = scene.graph.sqrt(square);
    let outwards = between.map(|e| scene.graph.div(e, length));
    let normal = if inside { outwards.map(|e| scene.graph.neg(e)) } else { outwards };
    let back = normal.map(|e| scene.graph.monomial(Rational::MINUS_ONE, &[(radius, Rational::ONE), (e, Rational::ONE)]));
    let at = scene.plus(&centre, &back);
    // the direction whose turn by +90 degrees is the normal
    let along = scene.cross(&normal, upright);
    let wanted = if inside { scene.graph.sub(large, radius) } else { scene.graph.add(large, radius) };
    let distance = scene.graph.sub(length, wanted);
    let distance = if inside { scene.graph.neg(distance) } else { distance };
    Contact { at, along, normal, distance: (distance, false) }
}
