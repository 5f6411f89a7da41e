//! Wheels that turn together: belts, chains, gears.
//!
//! The parts of the two angular velocities about the common axis e, counted from the line of centres, obey
//!
//! ```text
//! r_2 (ω_2 - ω_l) ± r_1 (ω_1 - ω_l) = 0,   ω_l = (e × u)·u' / u²,   u from centre to centre across e
//! ```
//!
//! Nothing slips at the pitch point of teeth, and no belt gets longer; the sign is + where the wheels turn in opposite senses. A body that carries both axes
//! turns like their line. What belts and chains pull along the line stands in `strands.rs`. Where the centres coincide in the model there is no line, and the body must be known.

use super::component::{Component, Doubt};
use super::drums::is_fixed;
use super::faults;
use super::made::Made;
use super::pair::{Line, Pair, label, pair};
use super::reading::{Space, frame, positive, rigid, same_thing};
use super::strands;
use crate::formula::Context;
use crate::model::{Connection, ConnectionKind, FrameId, Part, PointRef, Strands};
use crate::reader::names::{frame_by_name, two_names};
use crate::reader::{Fields, Reader, wrong_type};
use crate::scene::kinematics::{Kinematics, combine};
use crate::scene::requests::Resolver;
use crate::scene::wrench::{Act, carrier};
use crate::scene::{Found, Scene};
use crate::units::Dimension;
use symbolic::Expr;
use words::{Notice, Text};

/// How two wheels turn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Senses {
    /// An open belt, a chain, teeth inside.
    Equal,
    /// A crossed belt, teeth outside.
    Opposite,
}

/// Two wheels, with what is known of their strands.
pub fn read<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>, space: &Space, (senses, strands): (Senses, Strands)) -> Option<Made> {
    let names = two_names(reader, fields, "between");
    let found = names.as_ref().map(|names| names.clone().map(|(name, span)| frame_by_name(reader, &name, span)));
    let radii = radii(reader, fields);
    let carrier = fields.has("carrier").then(|| frame(reader, fields, "carrier"));
    let (names, [a, b]) = (names?, found?);
    let between: [FrameId; 2] = [a?, b?];
    if between[0] == between[1] {
        reader.fault(same_thing(fields.span_of("between"), &names[0].0));
        return None;
    }
    if space.root(between[0]) == space.root(between[1]) {
        let fault = rigid(fields.span_of("between"), [&names[0].0, &names[1].0]);
        reader.fault(fault);
        return None;
    }
    let carrier = match carrier {
        Some(found) => Some(found?),
        None => None,
    };
    if carrier.is_some_and(|c| between.contains(&c)) {
        reader.fault(
            Notice::piece("M063", fields.span_of("carrier"), "the carrier is one of the wheels", "водило — одно из колёс")
                .why("turning counts from the carrier", "повороты считаются от водила"),
        );
        return None;
    }
    let parts: &[Part] = match strands {
        Strands::Pretension(_) | Strands::Slack { .. } => &[Part::Force, Part::Tight, Part::Slack],
        Strands::Teeth | Strands::Open => &[Part::Force],
    };
    Some(Made::of(ConnectionKind::Wheels { between, radii: radii?, opposite: senses == Senses::Opposite, carrier, strands }).forces(parts))
}

fn radii<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>) -> Option<[Expr; 2]> {
    let value = fields.get("radii")?;
    let Some(items) = value.get_ref().as_array() else {
        reader.fault(
            wrong_type(value.span(), "an array of two radii", "массив из двух радиусов", value.get_ref().type_str())
                .help("write radii = [\"r1\", \"r2\"]", "напишите radii = [\"r1\", \"r2\"]"),
        );
        return None;
    };
    if items.len() != 2 {
        let n = items.len();
        reader.fault(Notice::piece(
            "M008",
            value.span(),
            format!("two wheels have 2 radii, {n} given"),
            format!("у двух колёс 2 радиуса, дано: {n}"),
        ));
        return None;
    }
    let mut found = Vec::new();
    for item in items.iter() {
        let raw = reader.raw(item)?;
        let radius = reader.value(&raw, &Context::CONSTANT, Some(&Dimension::LENGTH));
        found.push(positive(reader, &radius, "radii", item.span()).then_some(radius.expr));
    }
    match found.as_slice() {
        [Some(a), Some(b)] => Some([*a, *b]),
        _ => None,
    }
}

/// The condition of two wheels.
pub fn components(
    scene: &mut Scene,
    kinematics: &mut Kinematics,
    resolver: &mut Resolver,
    connection: &Connection,
) -> Found<Vec<Component>> {
    Ok(vec![wheels(scene, kinematics, resolver, connection)?])
}

/// What the turning counts from.
enum Base {
    Frame(FrameId),
    Line,
}

/// r_2 (ω_2 - ω_l) ± r_1 (ω_1 - ω_l) = 0.
fn wheels(scene: &mut Scene, kinematics: &mut Kinematics, resolver: &mut Resolver, connection: &Connection) -> Found<Component> {
    let (Some(pair), ConnectionKind::Wheels { carrier, strands, .. }) = (pair(scene, kinematics, resolver, connection)?, &connection.kind)
    else {
        return Ok(Component::ideal((Part::Force, "F", "N"), Text::default(), Vec::new()));
    };
    let line = Line::new(scene, kinematics, &pair);
    let mut doubts = Vec::new();
    if let Some(line) = line.as_ref().filter(|_| *strands == Strands::Teeth) {
        line.meshes(scene, connection, &pair)?;
    }
    let base = match &line {
        Some(line) => {
            doubts.extend(line.change(scene, connection));
            line_base(scene, kinematics, (connection, *carrier, &pair), line, &mut doubts)
        }
        None => Base::Frame(standing(scene, kinematics, (connection, *carrier, &pair))?),
    };
    let (rate, acts) = match (base, &line) {
        (Base::Line, Some(line)) => line.drive(scene, kinematics, &pair),
        (Base::Frame(frame), line) => frame_drive(scene, kinematics, (*strands, &pair), (frame, line.as_ref())),
        (Base::Line, None) => frame_drive(scene, kinematics, (*strands, &pair), (FrameId::GROUND, None)),
    };
    let ideal = Component::ideal((Part::Force, "F", "N"), label(connection), acts);
    let component = Component { rate: Some(rate), doubts, ..ideal };
    strands::along_the_line(scene, component, (connection, *strands), (&pair, line.as_ref()))
}

/// The named carrier when it turns like the line; else the one body in which both axles are fixed, or an arm that carries one of them and turns like the line;
/// else the line itself: then the axles hold what the wheels feel.
fn line_base(
    scene: &mut Scene,
    kinematics: &mut Kinematics,
    (connection, named, pair): (&Connection, Option<FrameId>, &Pair),
    line: &Line,
    doubts: &mut Vec<Doubt>,
) -> Base {
    if let Some(frame) = named {
        let turning = pair.turning(scene, kinematics, frame);
        let drift = scene.graph.sub(turning, line.rate);
        if scene.vanishes(drift) {
            return Base::Frame(frame);
        }
        doubts.push(Doubt { rate: drift, fault: *faults::not_the_carrier(scene.model, connection, frame) });
        return Base::Line;
    }
    let [below_a, below_b] = [pair.a, pair.b].map(|f| carrier(scene.model, f));
    if below_a == below_b && [pair.a, pair.b].iter().all(|f| is_fixed(scene, kinematics, PointRef::Origin(*f), below_b)) {
        return Base::Frame(below_b);
    }
    let arms = [below_b, below_a].into_iter().filter(|f| ![pair.a, pair.b, FrameId::GROUND].contains(f));
    for frame in arms {
        let turning = pair.turning(scene, kinematics, frame);
        let drift = scene.graph.sub(turning, line.rate);
        if !scene.vanishes(turning) && scene.vanishes(drift) {
            return Base::Frame(frame);
        }
    }
    Base::Line
}

/// What both axes stand on, for wheels drawn at one place.
fn standing(
    scene: &mut Scene,
    kinematics: &Kinematics,
    (connection, named, pair): (&Connection, Option<FrameId>, &Pair),
) -> Found<FrameId> {
    if let Some(frame) = named {
        let [own, base] = [pair.a, frame].map(|f| {
            let columns = kinematics.turning_in_ground_axes(scene, f);
            combine(scene, &columns)
        });
        let relative = scene.minus(&own, &base);
        let aside = scene.cross(&relative, &pair.axis);
        return match aside.iter().all(|e| scene.vanishes(*e)) {
            true => Ok(frame),
            false => Err(faults::not_the_carrier(scene.model, connection, frame)),
        };
    }
    let [below_a, below_b] = [pair.a, pair.b].map(|f| carrier(scene.model, f));
    let [wa, wb] = [below_a, below_b].map(|f| pair.turning(scene, kinematics, f));
    let apart = scene.graph.sub(wa, wb);
    match (scene.vanishes(wa), scene.vanishes(wb)) {
        (true, true) => Ok(if below_a == below_b { below_b } else { FrameId::GROUND }),
        _ if scene.vanishes(apart) => Ok(below_b),
        (true, _) => Err(faults::no_carrier(scene.model, connection, below_b)),
        _ => Err(faults::no_carrier(scene.model, connection, below_a)),
    }
}

/// Condition and actions that count from a frame.
fn frame_drive(
    scene: &mut Scene,
    kinematics: &mut Kinematics,
    (strands, pair): (Strands, &Pair),
    (frame, line): (FrameId, Option<&Line>),
) -> (Expr, Vec<Act>) {
    let factors = pair.factors(scene);
    let parts = [(pair.a, factors[0]), (pair.b, factors[1]), (frame, factors[2])];
    let terms: Vec<Expr> = parts
        .iter()
        .map(|(f, factor)| {
            let turning = pair.turning(scene, kinematics, *f);
            scene.graph.mul(*factor, turning)
        })
        .collect();
    let acts = match line {
        Some(line) if strands == Strands::Teeth => toothed(scene, kinematics, pair, line),
        Some(line) => line.acts(scene, pair),
        None => parts.into_iter().map(|(on, factor)| Act::Turn { on, moment: pair.axis.map(|e| scene.graph.mul(factor, e)) }).collect(),
    };
    (scene.graph.sum(&terms), acts)
}

/// Teeth push at the pitch point, across the line of centres; the axles feel it.
fn toothed(scene: &mut Scene, kinematics: &Kinematics, pair: &Pair, line: &Line) -> Vec<Act> {
    let ([ra, rb], ob) = (pair.radii, kinematics.frames[pair.b.index()].origin);
    // external: between the centres; internal: beyond the centre of the smaller wheel, r_a e from O_a on the side given by r_a - r_b
    let spread = if pair.opposite { scene.graph.add(ra, rb) } else { scene.graph.sub(ra, rb) };
    let share = scene.graph.div(ra, spread);
    let to_pitch = line.between.map(|e| scene.graph.mul(share, e));
    let at = scene.plus(&line.foot, &to_pitch);
    // force on b whose moment about O_b is +r_b: perpendicular to the arm from O_b to the pitch point
    let arm = scene.minus(&at, &ob);
    let square = scene.dot(&arm, &arm);
    let square = scene.tidy(square);
    let length = scene.graph.sqrt(square);
    let force = scene.cross(&pair.axis, &arm).map(|e| scene.graph.div(e, length));
    let against = force.map(|e| scene.graph.neg(e));
    vec![Act::Place { on: pair.b, at, force }, Act::Place { on: pair.a, at, force: against }]
}
