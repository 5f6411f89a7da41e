//! Rolling without slip: wheels on lines and circles, gears on racks. The wheel lies in the plane x, y of the frame of its track.

use super::axes::{across, axes_of, keeps, line};
use super::component::{Component, Nature};
use super::faults;
use super::reading::{Space, frame, point, rigid, size};
use crate::formula::Context;
use crate::model::{Connection, ConnectionKind, FrameId, Model, Part, PointRef, Slides, Track};
use crate::reader::names::frame_by_name;
use crate::reader::{Fields, Reader};
use crate::scene::kinematics::{Kinematics, combine};
use crate::scene::requests::Resolver;
use crate::scene::start::at_start;
use crate::scene::wrench::{Act, particle};
use crate::scene::{Columns, Found, Scene, Vector};
use symbolic::connections::Rebound;
use symbolic::{Expr, Rational};
use words::Text;

/// The wheel and the frame of its track.
pub struct Wheel {
    pub frame: FrameId,
    pub center: PointRef,
    pub radius: Expr,
    /// its radius, when it is a number
    pub size: Option<f64>,
    pub on: FrameId,
}

/// The wheel under a key.
pub fn wheel<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>, space: &Space, key: &'static str) -> Option<Wheel> {
    let named = fields.name(reader, key);
    let frame_found = named.clone().and_then(|(name, span)| frame_by_name(reader, &name, span));
    let radius = size(reader, fields, "radius", &Context::CONSTANT);
    let center = fields.has("center").then(|| point(reader, fields, "center"));
    let on = frame(reader, fields, "on");
    let (frame, on, radius) = (frame_found?, on?, radius?);
    let center = match center {
        Some(found) => found?,
        None => PointRef::Origin(frame),
    };
    if space.root(frame) == space.root(on) {
        let on_name = fields.get("on").and_then(|v| v.get_ref().as_str()).unwrap_or("ground");
        let fault = rigid(fields.span_of(key), [&named.map_or(String::new(), |n| n.0), on_name]);
        reader.fault(fault);
        return None;
    }
    let size = reader.number_of(radius);
    Some(Wheel { frame, center, radius, size, on })
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

/// No slip at the contact point; the centre keeps its distance. Where a friction is named for the contact it decides about slip.
pub fn components(
    scene: &mut Scene,
    kinematics: &mut Kinematics,
    resolver: &mut Resolver,
    connection: &Connection,
) -> Found<Vec<Component>> {
    let ConnectionKind::Rolling { wheel, on, held, leaves, .. } = &connection.kind else {
        return Err(faults::of_another_kind(connection));
    };
    let contact = contact(scene, kinematics, resolver, connection)?;
    let name = &connection.name;
    let mut list = Vec::new();
    if !slips(scene.model, connection) {
        let (part, letter, what) = if connection.table == "racks" {
            (Part::Force, "F", Text::new(format!("rack {name}, tangential force"), format!("рейка {name}, окружное усилие")))
        } else {
            (Part::Tangential, "F", Text::new(format!("rolling {name}, tangential force"), format!("качение {name}, сила сцепления")))
        };
        let (rate, acts) = slipping(scene, kinematics, (*wheel, *on, &contact));
        let nature = if leaves.is_some() { Nature::Rough } else { Nature::Ideal };
        list.push(Component { rate: Some(rate), nature, ..Component::ideal((part, letter, "N"), what, acts) });
    }
    if *held {
        let label = Text::new(format!("rolling {name}, normal force"), format!("качение {name}, нормальная реакция"));
        let acts = pair((*wheel, *on), &contact, contact.normal, scene);
        let of = (Part::Normal, "N", "N");
        let (distance, only_rate) = contact.distance;
        match leaves {
            Some(restitution) => {
                let restitution = resolver.resolve(scene, kinematics, *restitution)?;
                let start = if only_rate { at_start(scene, name, distance) } else { scene.graph.zero() };
                let gap = scene.graph.sub(distance, start);
                let nature = Nature::Contact { gap, restitution: [restitution, scene.graph.zero()], tie: false, rebound: Rebound::Newton };
                // what is rough follows its contact
                list.insert(0, Component { place: Some(gap), nature, ..Component::ideal(of, label, acts) });
            }
            None => {
                let (place, rate) = if only_rate { (None, Some(scene.total(distance))) } else { (Some(distance), None) };
                list.push(Component { place, rate, ..Component::ideal(of, label, acts) });
            }
        }
    }
    Ok(list)
}

/// Whether a friction at the contact of this wheel takes the place of the condition that it does not slip.
fn slips(model: &Model, connection: &Connection) -> bool {
    model.connections.iter().any(|other| match &other.kind {
        ConnectionKind::Friction { slides: Slides::Contact { of, .. }, .. } => {
            let named = &model.connections[*of];
            (named.table, &named.name) == (connection.table, &connection.name)
        }
        _ => false,
    })
}

/// Speed of the wheel's contact point along the track, and the forces along it per unit.
pub fn slip(scene: &mut Scene, kinematics: &mut Kinematics, resolver: &mut Resolver, connection: &Connection) -> Found<(Expr, Vec<Act>)> {
    let ConnectionKind::Rolling { wheel, on, .. } = connection.kind else { return Ok((scene.graph.zero(), Vec::new())) };
    let contact = contact(scene, kinematics, resolver, connection)?;
    Ok(slipping(scene, kinematics, (wheel, on, &contact)))
}

fn slipping(scene: &mut Scene, kinematics: &mut Kinematics, (wheel, on, contact): (FrameId, FrameId, &Contact)) -> (Expr, Vec<Act>) {
    let (of_wheel, of_track) = (particle(scene, kinematics, wheel, &contact.at), particle(scene, kinematics, on, &contact.at));
    let slip = difference(scene, &of_wheel, &of_track);
    let slip = scene.dot(&contact.along, &slip);
    let slip = scene.tidy(slip);
    (slip, pair((wheel, on), contact, contact.along, scene))
}

/// A force on the wheel, the opposite on the track.
fn pair((wheel, on): (FrameId, FrameId), contact: &Contact, force: Vector, scene: &mut Scene) -> Vec<Act> {
    let against = force.map(|e| scene.graph.neg(e));
    vec![Act::Place { on: wheel, at: contact.at, force }, Act::Place { on, at: contact.at, force: against }]
}

fn contact(scene: &mut Scene, kinematics: &mut Kinematics, resolver: &mut Resolver, connection: &Connection) -> Found<Contact> {
    let ConnectionKind::Rolling { wheel, center, radius, on, track, .. } = &connection.kind else {
        return Err(faults::no_place(connection, &connection.name));
    };
    let radius = resolver.resolve(scene, kinematics, *radius)?;
    let centre = kinematics.position(scene, *center);
    let upright = axes_of(scene, kinematics, *on)[2];
    if !keeps(scene, kinematics, *wheel, &upright) {
        return Err(faults::wheel_not_in_plane(scene.model, connection, *wheel, *on));
    }
    if leaves_plane(scene, kinematics, (*center, *on, &upright)) {
        return Err(faults::leaves_plane(scene.model, connection, *wheel, *on));
    }
    Ok(match track {
        Track::Line { through, direction, left } => {
            let direction = resolver.resolve(scene, kinematics, *direction)?;
            on_line(scene, kinematics, (centre, radius), (*on, *through, direction, if *left { Side::Left } else { Side::Right }))
        }
        Track::Circle { center, radius: large, inside } => {
            let large = resolver.resolve(scene, kinematics, *large)?;
            on_circle(scene, kinematics, (centre, radius, &upright), (*center, large, if *inside { Stand::Inside } else { Stand::Outside }))
        }
    })
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

/// On which side of the direction of its track a wheel is.
#[derive(PartialEq)]
enum Side {
    Left,
    Right,
}

/// Where a wheel stands at a circle.
#[derive(PartialEq)]
enum Stand {
    Inside,
    Outside,
}

/// The track passes at the distance `radius` below the wheel (to the right of its direction) when the wheel is on its left.
fn on_line(
    scene: &mut Scene,
    kinematics: &mut Kinematics,
    (centre, radius): (Vector, Expr),
    (on, through, direction, side): (FrameId, Option<PointRef>, Expr, Side),
) -> Contact {
    let (along, across) = line(scene, kinematics, on, direction);
    let normal = if side == Side::Left { across } else { across.map(|e| scene.graph.neg(e)) };
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
    (middle, large, stand): (PointRef, Expr, Stand),
) -> Contact {
    let inside = stand == Stand::Inside;
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
