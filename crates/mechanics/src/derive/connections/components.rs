//! What each kind of connection demands and gives, component by component. Signs as in [`ConnectionKind`].

use super::axes::axes_of;
use super::component::{Component, Nature, effort, labelled, moment_about, no_turning, path};
use super::sliders::slider;
use super::{axles, drums, held, rubbing, tracks, wheels};
use crate::derive::kinematics::{Kinematics, combine};
use crate::derive::loads::at_start;
use crate::derive::pathways::{Given, Path, located};
use crate::derive::requests::Resolver;
use crate::derive::scene::{Columns, Found, Scene, Vector, is_spatial};
use crate::derive::wrench::{Act, frame_of, particle};
use crate::model::{Connection, ConnectionKind, FrameId, Measure, Part, Pathway, PointRef, Rest, SupportDirection, Wound};
use symbolic::Expr;
use symbolic::connections::Rebound;
use words::Text;

/// The components of a connection.
pub fn of(scene: &mut Scene, kinematics: &mut Kinematics, resolver: &mut Resolver, connection: &Connection) -> Found<Vec<Component>> {
    let name = &connection.name;
    Ok(match &connection.kind {
        ConnectionKind::Pin { between, axes } => pin(scene, kinematics, (name, *between, *axes)),
        ConnectionKind::Weld { between, axes } => {
            let mut list = pin(scene, kinematics, (name, *between, *axes));
            let frames = between.map(|p| frame_of(scene, p));
            list.extend(no_turning(scene, kinematics, name, frames));
            list
        }
        ConnectionKind::Slider { point, on, through, direction, turns } => {
            let direction = resolver.resolve(scene, kinematics, *direction)?;
            slider(scene, kinematics, name, (*point, *on, *through, direction, *turns))
        }
        ConnectionKind::Rod { between, length } => {
            let length = rest(scene, kinematics, resolver, *length)?;
            vec![rod(scene, kinematics, resolver, (connection, *between, length))?]
        }
        ConnectionKind::Rope { path, wound, length, slack, restitution } => {
            let length = rest(scene, kinematics, resolver, *length)?;
            let restitution = resolver.resolve(scene, kinematics, *restitution)?;
            vec![rope(scene, kinematics, resolver, (connection, path, wound, length, slack.then_some(restitution)))?]
        }
        ConnectionKind::Wheels { .. } => vec![wheels::wheels(scene, kinematics, resolver, connection)?],
        ConnectionKind::Rolling { .. } => tracks::rolling(scene, kinematics, resolver, connection)?,
        ConnectionKind::Constraint { zero, on_rates } => {
            let given = if *on_rates { Given::Rates } else { Given::Pathway(Measure::Other) };
            let acts = located(scene, kinematics, resolver, (name, *zero), given)?;
            let zero = resolver.resolve(scene, kinematics, *zero)?;
            vec![constraint(name, (zero, *on_rates), acts)]
        }
        ConnectionKind::Support { at, directions, axes, on } => support(scene, kinematics, connection, (*at, directions, *axes, *on))?,
        ConnectionKind::Motion { pathway, value, is_rate } => {
            let path = path(scene, kinematics, resolver, connection, *pathway)?;
            let value = resolver.resolve(scene, kinematics, *value)?;
            vec![if *is_rate { motion_by_rate(scene, name, &path, value) } else { motion(scene, name, &path, value) }]
        }
        ConnectionKind::Motor { pathway } => {
            // not Q: Q_x is the generalized force of the loads
            let (letter, unit) = effort(*pathway, "M", "F");
            let path = path(scene, kinematics, resolver, connection, *pathway)?;
            let label = Text::new(format!("drive {name}"), format!("привод {name}"));
            vec![Component { nature: Nature::Motor, ..Component::ideal((Part::Force, letter, unit), label, path.acts) }]
        }
        ConnectionKind::Stop { gap, clearance, above, restitution, tangential, rebound } => {
            let path = path(scene, kinematics, resolver, connection, *gap)?;
            let clearance = resolver.resolve(scene, kinematics, *clearance)?;
            let normal = resolver.resolve(scene, kinematics, *restitution)?;
            let restitution = [normal, resolver.resolve(scene, kinematics, *tangential)?];
            vec![stop(scene, (name, *gap), &path, (clearance, *above, restitution, *rebound))]
        }
        ConnectionKind::Friction { .. } => vec![rubbing::friction(scene, kinematics, resolver, connection)?],
    })
}

fn rest(scene: &mut Scene, kinematics: &mut Kinematics, resolver: &mut Resolver, rest: Rest) -> Found<Option<Expr>> {
    match rest {
        Rest::Value(e) => Ok(Some(resolver.resolve(scene, kinematics, e)?)),
        Rest::Start => Ok(None),
    }
}

fn in_axis(axis: usize) -> (Text, Part, &'static str) {
    let part = [Part::ForceX, Part::ForceY, Part::ForceZ][axis];
    let letter = ["X", "Y", "Z"][axis];
    let name = ["x", "y", "z"][axis];
    (Text::new(format!("along {name}"), format!("вдоль {name}")), part, letter)
}

/// r_Q - r_P along the axes.
fn pin(scene: &mut Scene, kinematics: &mut Kinematics, (name, [p, q], axes): (&str, [PointRef; 2], FrameId)) -> Vec<Component> {
    let (rp, rq) = (kinematics.position(scene, p), kinematics.position(scene, q));
    let between = scene.minus(&rq, &rp);
    let directions = axes_of(scene, kinematics, axes);
    // in turning axes e·d(r_Q - r_P)/dt vanishes with the gap; e'·(r_Q - r_P), no velocity of bodies, is left out
    let turns = !kinematics.frames[axes.index()].turning.is_empty();
    let speed = scene.total_vector(between);
    let count = if is_spatial(scene.model) { 3 } else { 2 };
    (0..count)
        .map(|i| {
            let (what, part, letter) = in_axis(i);
            let e = directions[i];
            let opposite = e.map(|c| scene.graph.neg(c));
            let place = scene.dot(&e, &between);
            let rate = turns.then(|| scene.dot(&e, &speed));
            let acts = vec![Act::Point { point: q, force: e }, Act::Point { point: p, force: opposite }];
            Component {
                place: Some(place), rate, ..Component::ideal((part, letter, "N"), labelled("pin", "шарнир", name, &what), acts)
            }
        })
        .collect()
}

/// |r_B - r_A| - length.
fn rod(
    scene: &mut Scene,
    kinematics: &mut Kinematics,
    resolver: &mut Resolver,
    (connection, [a, b], length): (&Connection, [PointRef; 2], Option<Expr>),
) -> Found<Component> {
    let path = path(scene, kinematics, resolver, connection, Pathway::Distance(a, b))?;
    let length = length.unwrap_or_else(|| at_start(scene, &connection.name, path.value));
    let place = scene.graph.sub(path.value, length);
    let minus = scene.graph.int(-1);
    // tension pulls the ends together
    let acts = path.acts.iter().map(|act| act.times(scene, minus)).collect();
    let name = &connection.name;
    let label = Text::new(format!("rod {name}, tension"), format!("стержень {name}, усилие (растяжение +)"));
    Ok(Component { place: Some(place), negative: true, ..Component::ideal((Part::Force, "S", "N"), label, acts) })
}

/// Polygon + Σ ± radius · angle - length; as a contact when it may go slack.
fn rope(
    scene: &mut Scene,
    kinematics: &mut Kinematics,
    resolver: &mut Resolver,
    (connection, corners, wound, length, restitution): (&Connection, &[PointRef], &[Wound], Option<Expr>, Option<Expr>),
) -> Found<Component> {
    let name = &connection.name;
    let (mut parts, mut acts) = (Vec::new(), Vec::new());
    for pair in corners.windows(2) {
        let (ra, rb) = (kinematics.position(scene, pair[0]), kinematics.position(scene, pair[1]));
        let between = scene.minus(&rb, &ra);
        let square = scene.dot(&between, &between);
        let square = scene.tidy(square);
        let distance = scene.graph.sqrt(square);
        let unit = between.map(|e| scene.graph.div(e, distance));
        let opposite = unit.map(|e| scene.graph.neg(e));
        acts.push(Act::Point { point: pair[0], force: unit });
        acts.push(Act::Point { point: pair[1], force: opposite });
        parts.push(distance);
    }
    if corners.is_empty() {
        axles::stay_apart(scene, kinematics, connection, wound)?;
    }
    for drum in wound {
        let radius = resolver.resolve(scene, kinematics, drum.radius)?;
        let turn = drums::turn(scene, kinematics, connection, (drum, corners, wound))?;
        let arc = scene.graph.mul(radius, turn.value);
        parts.push(if drum.positive { arc } else { scene.graph.neg(arc) });
        // the wound length grows against the pull
        let pull = if drum.positive { scene.graph.neg(radius) } else { radius };
        let held = axles::is_held(scene, drum.on);
        let alone = held && axles::pull_on(scene, kinematics, (connection, drum.on, corners), (&turn.acts, pull), &mut acts)?;
        for act in &turn.acts {
            let on = act.frame(scene);
            if on == Some(drum.on) || !alone && on != Some(FrameId::GROUND) {
                acts.push(act.times(scene, pull));
            }
        }
    }
    let total = scene.graph.sum(&parts);
    let length = length.unwrap_or_else(|| at_start(scene, name, total));
    let (en, ru) = if connection.table == "threads" { ("thread", "нить") } else { ("rope", "канат") };
    let label = Text::new(format!("{en} {name}, tension"), format!("{ru} {name}, натяжение"));
    let of = (Part::Force, "S", "N");
    Ok(match restitution {
        None => {
            let place = scene.graph.sub(total, length);
            Component { place: Some(place), negative: true, ..Component::ideal(of, label, acts) }
        }
        Some(restitution) => {
            let gap = scene.graph.sub(length, total);
            let nature = Nature::Contact { gap, restitution: [restitution, scene.graph.zero()], tie: true, rebound: Rebound::Newton };
            Component { place: Some(gap), nature, ..Component::ideal(of, label, acts) }
        }
    })
}

fn constraint(name: &str, (zero, on_rates): (Expr, bool), acts: Vec<Act>) -> Component {
    let label = Text::new(format!("constraint {name}"), format!("связь {name}"));
    let (place, rate) = if on_rates { (None, Some(zero)) } else { (Some(zero), None) };
    Component { place, rate, ..Component::ideal((Part::Force, "λ", ""), label, acts) }
}

/// Velocity components of the point, or angular velocities of its body, are held relative to what holds the body, which gets the opposite.
fn support(
    scene: &mut Scene,
    kinematics: &mut Kinematics,
    connection: &Connection,
    (at, directions, axes, on): (PointRef, &[SupportDirection], FrameId, Option<FrameId>),
) -> Found<Vec<Component>> {
    let (name, axes) = (&connection.name, axes_of(scene, kinematics, axes));
    let body = frame_of(scene, at);
    let place = kinematics.position(scene, at);
    let mut list = Vec::new();
    for direction in directions {
        let (turns, i) = match direction {
            SupportDirection::X => (false, 0),
            SupportDirection::Y => (false, 1),
            SupportDirection::Z => (false, 2),
            SupportDirection::TurnX => (true, 0),
            SupportDirection::TurnY => (true, 1),
            SupportDirection::TurnZ => (true, 2),
        };
        let axis = axes[i];
        let against = axis.map(|e| scene.graph.neg(e));
        let (columns, acts) = if turns {
            let base = on.map_or_else(|| held::against_turning(scene, kinematics, connection, at), Ok)?;
            let columns = [body, base].map(|f| kinematics.turning_in_ground_axes(scene, f));
            (columns, vec![Act::Turn { on: body, moment: axis }, Act::Turn { on: base, moment: against }])
        } else {
            let base = on.map_or_else(|| held::at_place(scene, connection, at), Ok)?;
            let columns = [kinematics.jacobian(scene, at), particle(scene, kinematics, base, &place)];
            (columns, vec![Act::Point { point: at, force: axis }, Act::Place { on: base, at: place, force: against }])
        };
        let moving = relative(scene, columns);
        let (what, part, letter) = if turns { moment_about(i) } else { in_axis(i) };
        let rate = scene.dot(&axis, &moving);
        let rate = scene.tidy(rate);
        let unit = if turns { "N m" } else { "N" };
        let label = labelled("support", "опора", name, &what);
        list.push(Component { rate: Some(rate), ..Component::ideal((part, letter, unit), label, acts) });
    }
    Ok(list)
}

/// Difference of two velocities.
fn relative(scene: &mut Scene, columns: [Columns<Vector>; 2]) -> Vector {
    let [own, base] = columns.map(|c| combine(scene, &c));
    scene.minus(&own, &base)
}

/// pathway - value(t)
fn motion(scene: &mut Scene, name: &str, path: &Path, value: Expr) -> Component {
    Component { place: Some(scene.graph.sub(path.value, value)), ..prescribed(name) }
}

/// Rate of the pathway - value(t).
fn motion_by_rate(scene: &mut Scene, name: &str, path: &Path, value: Expr) -> Component {
    let rate = scene.rate_of(&path.gradient);
    Component { rate: Some(scene.graph.sub(rate, value)), ..prescribed(name) }
}

/// A motion without its condition.
fn prescribed(name: &str) -> Component {
    Component {
        part: None,
        letter: "",
        unit: "",
        label: Text::new(format!("prescribed motion {name}"), format!("заданное движение {name}")),
        place: None,
        rate: None,
        negative: false,
        acts: Vec::new(),
        nature: Nature::Motion,
        doubts: Vec::new(),
        beside: Columns::new(),
        open: Vec::new(),
    }
}

/// gap = pathway - clearance, or clearance - pathway.
fn stop(
    scene: &mut Scene,
    (name, pathway): (&str, Pathway),
    path: &Path,
    (clearance, above, restitution, rebound): (Expr, bool, [Expr; 2], Rebound),
) -> Component {
    let gap = if above { scene.graph.sub(path.value, clearance) } else { scene.graph.sub(clearance, path.value) };
    let acts = if above {
        path.acts.clone()
    } else {
        let minus = scene.graph.int(-1);
        path.acts.iter().map(|act| act.times(scene, minus)).collect()
    };
    let (letter, unit) = effort(pathway, "M", "N");
    let label = Text::new(format!("stop {name}"), format!("упор {name}"));
    Component {
        place: Some(gap),
        nature: Nature::Contact { gap, restitution, tie: false, rebound },
        ..Component::ideal((Part::Force, letter, unit), label, acts)
    }
}
