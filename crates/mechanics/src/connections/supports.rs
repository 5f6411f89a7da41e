//! Supports: velocity components of a point, or angular velocities of its body, are held relative to what holds the body.

use super::common::axes::axes_of;
use super::common::component::{Component, in_axis, labelled, moment_about};
use super::common::keys::{AXES, table};
use super::common::made::Made;
use super::common::reading::{Space, choose, frame, point};
use super::common::{faults, held};
use super::row::Row;
use crate::formula::Kind;
use crate::keys::{LABEL, TableSpec, Type, may, must};
use crate::model::{Connection, ConnectionKind, FrameId, Part, PointRef, SupportDirection};
use crate::reader::names::names;
use crate::reader::{Fields, Reader};
use crate::scene::kinematics::{Kinematics, combine};
use crate::scene::requests::Resolver;
use crate::scene::wrench::{Act, frame_of, particle};
use crate::scene::{Columns, Found, Scene, Vector};
use crate::units::Dimension;
use words::Notice;

/// `[supports]`.
pub(super) const ROW: Row =
    Row { keys: &KEYS, listed: ("supports", "опоры"), chapter: "hidden-reactions", within: &[], read, components };

/// `[supports.NAME]`.
const KEYS: TableSpec = table(
    "supports",
    (
        "Supports: reactions of a body that the coordinates already hold, or hold less than the support. They act on the body and hold it to what it stands on (`on` of the body), which gets the opposite. A body whose `origin` is the name of a point of another body is jointed to it there: at this place forces are those of the joint with that body, unless a pin or a weld of the two stands there; at all other places, and about turning, `on` holds it.",
        "Опоры: реакции, действующие на тело, которое уже удержано выбором координат или удерживается опорой. Опора соединяет тело с тем, на чём оно стоит (`on` тела); туда действует противоположная реакция. Тело, у которого `origin` — имя точки другого тела, соединено с ним в этой точке шарниром: силы в этом месте — силы шарнира между ними, если там нет их общего pin или weld; в остальных местах и от поворота тело удерживает `on`.",
    ),
    &[
        must("at", Type::Name, "", ("point, or body for its origin", "точка или тело (тогда его начало)"), "\"A\""),
        must(
            "directions",
            Type::Names,
            "",
            (
                "what is held: x, y, z, turn (about z), turn_x, turn_y, turn_z",
                "что удерживается: x, y, z, turn (вокруг z), turn_x, turn_y, turn_z",
            ),
            "[\"x\", \"y\"]",
        ),
        AXES,
        may(
            "on",
            Type::Name,
            "",
            "see above",
            ("what holds the body and gets the opposite", "что удерживает тело; туда действует противоположная реакция"),
            "\"cart\"",
        ),
        LABEL,
    ],
    "[supports.A]\nat = \"A\"\ndirections = [\"x\", \"y\", \"turn\"]\n",
);

/// Words of `directions`; `turn` is about z.
const DIRECTIONS: [&str; 7] = ["x", "y", "z", "turn", "turn_x", "turn_y", "turn_z"];

fn read<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>, space: &Space) -> Option<Made> {
    let (at, axes) = (point(reader, fields, "at"), frame(reader, fields, "axes"));
    let mut directions = Vec::new();
    let listed = fields.get("directions").map(|v| names(reader, v))?;
    let complete = listed.iter().all(|(word, span)| {
        let Some(number) = choose(reader, word, span.clone(), &DIRECTIONS) else { return false };
        let found = direction_of(number);
        if directions.contains(&found) {
            reader.fault(Notice::piece(
                "M081",
                span.clone(),
                format!("the direction `{word}` is given twice"),
                format!("направление `{word}` задано дважды"),
            ));
            return false;
        }
        directions.push(found);
        true
    });
    if complete && directions.is_empty() {
        reader.fault(
            Notice::piece("M081", fields.span_of("directions"), "a support that holds nothing", "опора, которая ничего не держит")
                .help("write directions = [\"x\", \"y\"]", "напишите directions = [\"x\", \"y\"]"),
        );
        return None;
    }
    let (at, axes) = (at?, axes?);
    if of_ground(reader, space, at) {
        reader.fault(
            Notice::piece("M081", fields.span_of("at"), "this point belongs to the ground", "эта точка принадлежит неподвижной системе")
                .why("a support acts on a body", "опора действует на тело")
                .help("name a point of the body that is supported", "укажите точку тела, которое опирается"),
        );
        return None;
    }
    let on = match fields.has("on") {
        true => Some(holder(reader, fields, space, at)?),
        false => None,
    };
    let parts = parts(&directions);
    complete.then(|| Made { parts, ..Made::of(ConnectionKind::Support { at, directions, axes, on }) })
}

/// The components of a support; `force` is the magnitude of its forces.
fn parts(directions: &[SupportDirection]) -> Vec<(Part, Kind)> {
    use SupportDirection as D;
    let part = |d: &SupportDirection| match d {
        D::X => (Part::ForceX, Dimension::FORCE),
        D::Y => (Part::ForceY, Dimension::FORCE),
        D::Z => (Part::ForceZ, Dimension::FORCE),
        D::TurnX => (Part::MomentX, Dimension::ENERGY),
        D::TurnY => (Part::MomentY, Dimension::ENERGY),
        D::TurnZ => (Part::Moment, Dimension::ENERGY),
    };
    let single: Vec<(Part, Kind)> = directions.iter().map(part).map(|(part, d)| (part, Kind::Known(d))).collect();
    let pushes = directions.iter().any(|d| matches!(d, D::X | D::Y | D::Z));
    let total = pushes.then_some((Part::Force, Kind::Known(Dimension::FORCE)));
    total.into_iter().chain(single).collect()
}

/// What is named to hold a body: not the body itself.
fn holder<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>, space: &Space, at: PointRef) -> Option<FrameId> {
    let on = frame(reader, fields, "on")?;
    if space.place_in(reader, at).0 != on {
        return Some(on);
    }
    reader.fault(
        Notice::piece("M081", fields.span_of("on"), "this body would be held to itself", "тело удерживалось бы само собой")
            .why(
                "a support acts between two bodies, or between a body and the ground",
                "опора действует между двумя телами или между телом и неподвижной системой",
            )
            .help("name what holds the body, or drop `on`", "укажите, что удерживает тело, или уберите `on`"),
    );
    None
}

/// A body that stands still has reactions, too, so only the ground itself is refused.
fn of_ground(reader: &mut Reader, space: &Space, at: PointRef) -> bool {
    space.place_in(reader, at).0 == FrameId::GROUND
}

fn direction_of(number: usize) -> SupportDirection {
    use SupportDirection as D;
    [D::X, D::Y, D::Z, D::TurnZ, D::TurnX, D::TurnY, D::TurnZ].get(number).copied().unwrap_or(D::X)
}

fn components(scene: &mut Scene, kinematics: &mut Kinematics, _: &mut Resolver, connection: &Connection) -> Found<Vec<Component>> {
    let ConnectionKind::Support { at, directions, axes, on } = &connection.kind else {
        return Err(faults::of_another_kind(connection));
    };
    support(scene, kinematics, connection, (*at, directions, *axes, *on))
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
