//! Sliders: a point stays on a straight line, n·(r_P − r_T) = 0 for a line through T.
//!
//! In the plane one direction is held, across the line. In space two are: across the line in the plane x, y of the line's frame, and along z of that
//! frame; the second is left out where the coordinates hold the point there anyway.

use super::common::axes::{axes_of, line};
use super::common::component::{Component, no_turning};
use super::common::faults;
use super::common::keys::{DIRECTION, ON_FRAME, THROUGH, table};
use super::common::made::Made;
use super::common::reading::{Space, direction, fixed_in, frame, point, rigid};
use super::row::Row;
use super::welds::MOMENTS;
use crate::keys::{Field, LABEL, TableSpec, Type, may, must};
use crate::model::{Connection, ConnectionKind, FrameId, Part, PointRef};
use crate::reader::{Fields, Reader};
use crate::scene::kinematics::Kinematics;
use crate::scene::requests::Resolver;
use crate::scene::wrench::{Act, frame_of};
use crate::scene::{Found, Scene, Vector};
use symbolic::Expr;
use words::Text;

/// `[sliders]`.
pub(super) const ROW: Row = Row { keys: &KEYS, listed: ("sliders", "ползуны"), chapter: "statics", within: &[], read, components };

const SLIDING: &[Field] = &[
    must("point", Type::Name, "", ("point that slides, or a body for its origin", "скользящая точка или тело (тогда его начало)"), "\"C\""),
    ON_FRAME,
    THROUGH,
    DIRECTION,
    may(
        "turns",
        Type::Bool,
        "",
        "true",
        ("whether the body of the point may turn against `on`", "может ли тело точки поворачиваться относительно `on`"),
        "false",
    ),
    LABEL,
];

/// `[sliders.NAME]`.
const KEYS: TableSpec = table(
    "sliders",
    (
        "Sliders: a point stays on a straight line. force acts on the body of the point, towards the direction turned by +90 degrees; moment exists when the body may not turn. Where the point could leave the plane x, y of `on` both normal directions are held: force_y towards the direction turned by +90 degrees, force_z along z of `on`, force is the magnitude; in space moment_x, moment_y, moment are about the line, the direction turned by +90 degrees and z of `on`.",
        "Ползуны: точка остаётся на прямой. force действует на тело точки в сторону направления, повёрнутого на +90 градусов; moment есть, если тело не поворачивается. Если точка могла бы выйти из плоскости x, y системы `on`, удерживаются оба нормальных направления: force_y — в сторону направления, повёрнутого на +90 градусов, force_z — вдоль z системы `on`, force — модуль; в пространстве moment_x, moment_y, moment — относительно прямой, направления, повёрнутого на +90 градусов, и оси z системы `on`.",
    ),
    SLIDING,
    "[sliders.C]\npoint = \"C\"\n",
);

/// Components of the force: one in the plane, two where the point could leave it.
pub(super) const ACROSS: [Part; 3] = [Part::Force, Part::ForceY, Part::ForceZ];

fn read<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>, space: &Space) -> Option<Made> {
    let turns = fields.flag(reader, "turns").unwrap_or(true);
    let Line { point, on, through, direction } = guide(reader, fields, space, "point")?;
    let made = Made::of(ConnectionKind::Slider { point, on, through, direction, turns }).forces(&ACROSS);
    Some(if turns { made } else { made.moments(&MOMENTS) })
}

/// A point and the line of a body along which it slides.
pub(super) struct Line {
    pub point: PointRef,
    pub on: FrameId,
    pub through: Option<PointRef>,
    pub direction: Expr,
}

/// The guide of the point under a key.
pub(super) fn guide<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>, space: &Space, key: &'static str) -> Option<Line> {
    let (point, on) = (point(reader, fields, key), frame(reader, fields, "on"));
    let direction = direction(reader, fields);
    let (point, on) = (point?, on?);
    let through = fixed_in(reader, fields, "through", space, on)?;
    if space.carrier(reader, point) == Some(space.root(on)) {
        let name = |key: &'static str| fields.get(key).and_then(|v| v.get_ref().as_str()).unwrap_or("ground");
        let fault = rigid(fields.span_of(key), [name(key), name("on")]);
        reader.fault(fault);
        return None;
    }
    Some(Line { point, on, through, direction })
}

pub(super) fn components(
    scene: &mut Scene,
    kinematics: &mut Kinematics,
    resolver: &mut Resolver,
    connection: &Connection,
) -> Found<Vec<Component>> {
    let ConnectionKind::Slider { point, on, through, direction, turns } = &connection.kind else {
        return Err(faults::of_another_kind(connection));
    };
    let direction = resolver.resolve(scene, kinematics, *direction)?;
    Ok(slider(scene, kinematics, &connection.name, (*point, *on, *through, direction, *turns)))
}

/// The point, the frame of the line, a point of the line, its direction, whether the point's body may turn.
type Guide = (PointRef, FrameId, Option<PointRef>, Expr, bool);

/// n·(r_P - r_T) for a line through T; n·(r_P - r_O) stays as it was for a line without a given point.
fn slider(scene: &mut Scene, kinematics: &mut Kinematics, name: &str, guide: Guide) -> Vec<Component> {
    let (point, on, _, direction, turns) = guide;
    let (along, normal) = line(scene, kinematics, on, direction);
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
        list.extend(no_turning(scene, kinematics, (name, [along, normal, upright]), frames));
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
