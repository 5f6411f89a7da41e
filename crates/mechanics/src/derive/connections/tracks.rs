//! Rolling without slip: wheels on lines and circles, gears and racks, wheels joined by belts, chains and teeth.

use super::components::{Component, line};
use crate::derive::kinematics::{Kinematics, combine};
use crate::derive::requests::Resolver;
use crate::derive::scene::{Columns, Found, Scene, Vector};
use crate::derive::wrench::{Act, particle};
use crate::model::{Axis, Connection, ConnectionKind, FrameId, Part, PointRef, Track};
use symbolic::{Expr, Rational, Text};

/// ω_2 r_2 ∓ ω_1 r_1 = 0, counted from the carrier.
pub fn wheels(scene: &mut Scene, kinematics: &mut Kinematics, resolver: &mut Resolver, connection: &Connection) -> Found<Component> {
    let ConnectionKind::Wheels { between: [a, b], radii, opposite, carrier } = &connection.kind else {
        return Ok(Component::ideal((Part::Force, "F", "N"), Text::default(), Vec::new()));
    };
    let (a, b, carrier) = (*a, *b, carrier.unwrap_or(FrameId::GROUND));
    let [ra, rb] = [radii[0], radii[1]].map(|e| resolver.resolve(scene, kinematics, e));
    let (ra, rb) = (ra?, rb?);
    let of_a = if *opposite { ra } else { scene.graph.neg(ra) };
    let sum = scene.graph.add(of_a, rb);
    let of_carrier = scene.graph.neg(sum);
    let mut terms = Vec::new();
    for (frame, factor) in [(a, of_a), (b, rb), (carrier, of_carrier)] {
        let columns = kinematics.turning_in_ground_axes(scene, frame);
        let turning = combine(scene, &columns)[Axis::Z.index()];
        terms.push(scene.graph.mul(factor, turning));
    }
    let rate = scene.graph.sum(&terms);
    let zero = scene.graph.zero();
    let name = &connection.name;
    let acts = match toothed(scene, kinematics, connection, ((a, b), (ra, rb), *opposite)) {
        Some(acts) => acts,
        None => [(a, of_a), (b, rb), (carrier, of_carrier)]
            .into_iter()
            .map(|(on, moment)| Act::Turn { on, moment: [zero, zero, moment] })
            .collect(),
    };
    let label = match connection.table {
        "gears" => Text::new(format!("gears {name}, tangential force"), format!("зацепление {name}, окружное усилие")),
        "chains" => Text::new(format!("chain {name}, tension"), format!("цепь {name}, усилие")),
        _ => Text::new(format!("belt {name}, tension difference"), format!("ремень {name}, разность натяжений ветвей")),
    };
    Ok(Component { rate: Some(rate), ..Component::ideal((Part::Force, "F", "N"), label, acts) })
}

/// Teeth push at the pitch point, across the line of centres; the axles feel it. None when the centres coincide in the model.
fn toothed(
    scene: &mut Scene,
    kinematics: &mut Kinematics,
    connection: &Connection,
    ((a, b), (ra, rb), opposite): ((FrameId, FrameId), (Expr, Expr), bool),
) -> Option<Vec<Act>> {
    if connection.table != "gears" {
        return None;
    }
    let (oa, ob) = (kinematics.frames[a.index()].origin, kinematics.frames[b.index()].origin);
    let between = scene.minus(&ob, &oa);
    let square = scene.dot(&between, &between);
    let square = scene.tidy(square);
    if scene.graph.is_zero(square) {
        return None;
    }
    // external: between the centres; internal: beyond the centre of the smaller wheel, r_a e from O_a on the side given by r_a - r_b
    let spread = if opposite { scene.graph.add(ra, rb) } else { scene.graph.sub(ra, rb) };
    let share = scene.graph.div(ra, spread);
    let to_pitch = between.map(|e| scene.graph.mul(share, e));
    let at = scene.plus(&oa, &to_pitch);
    // force on b whose moment about O_b is +r_b: perpendicular to the arm from O_b to the pitch point
    let arm = scene.minus(&at, &ob);
    let square = scene.dot(&arm, &arm);
    let square = scene.tidy(square);
    let length = scene.graph.sqrt(square);
    let minus_y = scene.graph.neg(arm[1]);
    let zero = scene.graph.zero();
    let force = [scene.graph.div(minus_y, length), scene.graph.div(arm[0], length), zero];
    let against = force.map(|e| scene.graph.neg(e));
    Some(vec![Act::Place { on: b, at, force }, Act::Place { on: a, at, force: against }])
}

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
    let contact = match track {
        Track::Line { through, direction, left } => {
            let direction = resolver.resolve(scene, kinematics, *direction)?;
            on_line(scene, kinematics, (centre, radius), (*on, *through, direction, *left))
        }
        Track::Circle { center, radius: large, inside } => {
            let large = resolver.resolve(scene, kinematics, *large)?;
            on_circle(scene, kinematics, (centre, radius), (*center, large, *inside))
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
    (centre, radius): (Vector, Expr),
    (middle, large, inside): (PointRef, Expr, bool),
) -> Contact {
    let middle = kinematics.position(scene, middle);
    let between = scene.minus(&centre, &middle);
    let square = scene.dot(&between, &between);
    let square = scene.tidy(square);
    let length = scene.graph.sqrt(square);
    let outwards = between.map(|e| scene.graph.div(e, length));
    let normal = if inside { outwards.map(|e| scene.graph.neg(e)) } else { outwards };
    let back = normal.map(|e| scene.graph.monomial(Rational::MINUS_ONE, &[(radius, Rational::ONE), (e, Rational::ONE)]));
    let at = scene.plus(&centre, &back);
    // the direction whose turn by +90 degrees is the normal
    let minus_x = scene.graph.neg(normal[0]);
    let along = [normal[1], minus_x, scene.graph.zero()];
    let wanted = if inside { scene.graph.sub(large, radius) } else { scene.graph.add(large, radius) };
    let distance = scene.graph.sub(length, wanted);
    let distance = if inside { scene.graph.neg(distance) } else { distance };
    Contact { at, along, normal, distance: (distance, false) }
}
