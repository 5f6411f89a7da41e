//! Ropes: the polygon through the points and what is wound on drums, Σ |r_k+1 − r_k| + Σ ± r φ, is the length; as a contact where the rope may go slack.

use super::common::component::{Component, Nature, length_of};
use super::common::keys::{LENGTH, RESTITUTION, table};
use super::common::made::Made;
use super::common::reading::{Space, choose, frame, length, point_named, restitution, same_thing, size};
use super::common::{axles, drums, faults};
use super::row::Row;
use crate::formula::Context;
use crate::keys::{Field, LABEL, TableSpec, Type, may, must};
use crate::model::{Connection, ConnectionKind, FrameId, Part, PointRef, Wound};
use crate::reader::names::{frame_by_name, names};
use crate::reader::{Fields, Reader, wrong_type};
use crate::scene::kinematics::Kinematics;
use crate::scene::requests::Resolver;
use crate::scene::start::at_start;
use crate::scene::wrench::Act;
use crate::scene::{Found, Scene};
use symbolic::Expr;
use symbolic::connections::Rebound;
use toml::de::DeValue;
use words::{Notice, Text};

/// `[ropes]`.
pub(super) const ROW: Row =
    Row { keys: &KEYS, listed: ("ropes", "канаты"), chapter: "space-connections", within: &[], read, components };

/// `[ropes.NAME]`.
const KEYS: TableSpec = table(
    "ropes",
    (
        "Inextensible ropes: polygon through the points plus what is wound on drums is the length. force is the tension.",
        "Нерастяжимые канаты: длина равна ломаной через точки плюс намотанное на барабаны. force — натяжение.",
    ),
    TIE,
    "[ropes.R]\npath = [\"A\", \"ring\", \"B\"]\nwound = [{ on = \"drum\", radius = \"R\", turns_in = \"+\" }]\n",
);

/// Keys of ropes and threads.
pub(super) const TIE: &[Field] = &[
    may(
        "path",
        Type::Names,
        "",
        "[]",
        (
            "points in order: ends, rings, axles of small pulleys; two at least, or none when the rope only winds on two drums",
            "точки по порядку: концы, кольца, оси малых блоков; не меньше двух, либо ни одной, если канат только наматывается на два барабана",
        ),
        "[\"A\", \"ring\", \"B\"]",
    ),
    may(
        "wound",
        Type::Array,
        "",
        "[]",
        (
            "drums on which it winds: { on, radius, turns_in, carrier }",
            "барабаны, на которые он наматывается: { on, radius, turns_in, carrier }",
        ),
        "[{ on = \"drum\", radius = \"R\" }]",
    ),
    LENGTH,
    may(
        "slack",
        Type::Bool,
        "",
        "true",
        ("whether it may go slack; false: always held taut", "может ли провисать; false — всегда натянут"),
        "false",
    ),
    RESTITUTION,
    LABEL,
];

/// `wound = [{ ... }]`.
pub(super) const WOUND: TableSpec = table(
    "wound",
    ("one drum", "один барабан"),
    &[
        must("on", Type::Name, "", ("the drum", "барабан"), "\"drum\""),
        must("radius", Type::Formula, "m", ("its radius", "его радиус"), "\"R\""),
        may(
            "turns_in",
            Type::String,
            "",
            "\"+\"",
            (
                "\"+\": the rope winds on when the drum turns positively; \"-\": it winds off",
                "\"+\": при положительном повороте барабана канат наматывается; \"-\": сматывается",
            ),
            "\"-\"",
        ),
        may(
            "carrier",
            Type::Name,
            "",
            "body that carries its axis",
            (
                "body that carries its axis and the run of the rope to it; its angle counts from it",
                "тело, несущее ось барабана и набегающую на него ветвь; угол барабана считается от него",
            ),
            "\"boom\"",
        ),
    ],
    "",
);

pub(super) fn read<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>, space: &Space) -> Option<Made> {
    let path = path(reader, fields);
    let wound = wound_on(reader, fields);
    let length = length(reader, fields);
    let slack = fields.flag(reader, "slack").unwrap_or(true);
    let restitution = restitution(reader, fields);
    if !slack && fields.has("restitution") {
        reader.fault(
            Notice::piece(
                "M080",
                fields.span_of("restitution"),
                "a rope that is always taut does not catch",
                "всегда натянутый канат не рвётся натягом и удара не даёт",
            )
            .help("drop `restitution`, or slack = false", "уберите `restitution` или slack = false"),
        );
    }
    let (path, wound) = (path?, wound?);
    if path.len() == 1 || path.is_empty() && wound.len() < 2 {
        reader.fault(
            Notice::piece(
                "M082",
                fields.span.clone(),
                format!("{} leads from nowhere to nowhere", fields.path),
                format!("{} никуда не ведёт", fields.path),
            )
            .why("a rope needs two points, or two drums and no point at all", "канату нужны две точки либо два барабана без точек")
            .help(
                "where it leaves a drum add a point: path = [\"edge\", \"load\"]",
                "в месте схода с барабана добавьте точку: path = [\"edge\", \"load\"]",
            ),
        );
        return None;
    }
    let first = path.first().and_then(|p| space.carrier(reader, *p));
    if wound.is_empty() && first.is_some() && path.iter().all(|p| space.carrier(reader, *p) == first) {
        let name = fields.path.clone();
        reader.fault(
            Notice::piece(
                "M073",
                fields.span.clone(),
                format!("all points of {name} move as one"),
                format!("все точки {name} движутся как одно целое"),
            )
            .why("the rope would hold nothing", "канат ничего бы не держал"),
        );
        return None;
    }
    Some(Made::of(ConnectionKind::Rope { path, wound, length: length?, slack, restitution }).forces(&[Part::Force]))
}

fn path<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>) -> Option<Vec<PointRef>> {
    let listed = fields.get("path").map(|v| names(reader, v)).unwrap_or_default();
    let mut found: Vec<PointRef> = Vec::new();
    for (name, span) in listed {
        let point = point_named(reader, &name, span.clone())?;
        if found.last() == Some(&point) {
            reader.fault(same_thing(span, &name));
            return None;
        }
        found.push(point);
    }
    Some(found)
}

fn wound_on<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>) -> Option<Vec<Wound>> {
    let Some(value) = fields.get("wound") else { return Some(Vec::new()) };
    let DeValue::Array(items) = value.get_ref() else {
        reader.fault(
            wrong_type(value.span(), "an array of tables", "массив таблиц", value.get_ref().type_str())
                .help("write wound = [{ on = \"drum\", radius = \"R\" }]", "напишите wound = [{ on = \"drum\", radius = \"R\" }]"),
        );
        return None;
    };
    let mut found = Vec::new();
    for item in items.iter() {
        let DeValue::Table(table) = item.get_ref() else {
            reader.fault(wrong_type(
                item.span(),
                "a table { on, radius, turns_in, carrier }",
                "таблица { on, radius, turns_in, carrier }",
                item.get_ref().type_str(),
            ));
            return None;
        };
        let drum = Fields::open(reader, &WOUND, table, item.span(), fields.path_of("wound"));
        found.push(wound(reader, &drum));
    }
    found.into_iter().collect()
}

fn wound<'a>(reader: &mut Reader<'a>, drum: &Fields<'a>) -> Option<Wound> {
    let on = drum.name(reader, "on").and_then(|(name, span)| frame_by_name(reader, &name, span));
    let radius = size(reader, drum, "radius", &Context::CONSTANT);
    let positive = match drum.name(reader, "turns_in") {
        Some((word, span)) => choose(reader, &word, span, &["+", "-"])? == 0,
        None => true,
    };
    let carrier = match drum.has("carrier") {
        true => Some(frame(reader, drum, "carrier")?),
        false => None,
    };
    let on = on?;
    if carrier == Some(on) {
        reader.fault(
            Notice::piece("M063", drum.span_of("carrier"), "the carrier is the drum itself", "водило — сам барабан")
                .why("turning counts from the carrier", "повороты считаются от водила"),
        );
        return None;
    }
    Some(Wound { on, radius: radius?, carrier, positive })
}

pub(super) fn components(
    scene: &mut Scene,
    kinematics: &mut Kinematics,
    resolver: &mut Resolver,
    connection: &Connection,
) -> Found<Vec<Component>> {
    let ConnectionKind::Rope { path, wound, length, slack, restitution } = &connection.kind else {
        return Err(faults::of_another_kind(connection));
    };
    let length = length_of(scene, kinematics, resolver, *length)?;
    let restitution = resolver.resolve(scene, kinematics, *restitution)?;
    Ok(vec![rope(scene, kinematics, resolver, (connection, path, wound, length, slack.then_some(restitution)))?])
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
