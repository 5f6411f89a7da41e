//! `[pins]`, `[welds]`, `[sliders]`, `[slots]`, `[supports]`.

use super::Found;
use super::common::{Space, choose, direction, fixed_in, frame, point, rigid, two_points};
use crate::model::{ConnectionKind, FrameId, PointRef, SupportDirection};
use crate::reader::names::names;
use crate::reader::{Fields, Reader};
use symbolic::Expr;
use words::Notice;

pub(super) fn pin<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>, space: &Space) -> Option<Found> {
    let (between, axes) = (two_points(reader, fields, space), frame(reader, fields, "axes"));
    Some(ConnectionKind::Pin { between: between?, axes: axes? }.into())
}

pub(super) fn weld<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>, space: &Space) -> Option<Found> {
    let (between, axes) = (two_points(reader, fields, space), frame(reader, fields, "axes"));
    Some(ConnectionKind::Weld { between: between?, axes: axes? }.into())
}

pub(super) fn slider<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>, space: &Space) -> Option<Found> {
    let turns = fields.flag(reader, "turns").unwrap_or(true);
    let Guide { point, on, through, direction } = guide(reader, fields, space, "point")?;
    Some(ConnectionKind::Slider { point, on, through, direction, turns }.into())
}

pub(super) fn slot<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>, space: &Space) -> Option<Found> {
    let Guide { point, on, through, direction } = guide(reader, fields, space, "pin")?;
    Some(ConnectionKind::Slider { point, on, through, direction, turns: true }.into())
}

/// A point and the line of a body along which it slides.
struct Guide {
    point: PointRef,
    on: FrameId,
    through: Option<PointRef>,
    direction: Expr,
}

/// The guide of the point under a key.
fn guide<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>, space: &Space, key: &'static str) -> Option<Guide> {
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
    Some(Guide { point, on, through, direction })
}

/// Words of `directions`; `turn` is about z.
const DIRECTIONS: [&str; 7] = ["x", "y", "z", "turn", "turn_x", "turn_y", "turn_z"];

pub(super) fn support<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>, space: &Space) -> Option<Found> {
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
    complete.then(|| ConnectionKind::Support { at, directions, axes, on }.into())
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
