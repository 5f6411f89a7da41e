//! `[racks]`, `[rolling]`: a wheel that does not slip on a line or a circle.

use super::Found;
use super::common::{Space, direction, fixed_in, frame, point, restitution, rigid, size, word};
use crate::fields::connections::CIRCLE;
use crate::formula::Context;
use crate::model::{ConnectionKind, FrameId, PointRef, Track};
use crate::reader::names::frame_by_name;
use crate::reader::{Fields, Reader, wrong_type};
use symbolic::Expr;
use toml::de::DeValue;
use words::{Notice, digits};

pub(super) fn rack<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>, space: &Space) -> Option<Found> {
    let wheel = wheel(reader, fields, space, "gear");
    let (direction, side) = (direction(reader, fields), word(reader, fields, "side", &["left", "right"]));
    let wheel = wheel?;
    let track = Track::Line { through: None, direction, left: side? == 0 };
    let Wheel { frame: wheel, center, radius, on, .. } = wheel;
    Some(ConnectionKind::Rolling { wheel, center, radius, on, track, held: false, leaves: None }.into())
}

pub(super) fn rolling<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>, space: &Space) -> Option<Found> {
    let wheel = wheel(reader, fields, space, "body");
    let held = fields.flag(reader, "held").unwrap_or(true);
    let leaves = fields.flag(reader, "leaves").unwrap_or(false);
    let restitution = restitution(reader, fields);
    if let Some(fault) = unheld(fields, (held, leaves)) {
        reader.fault(fault);
        return None;
    }
    let on = wheel.as_ref().map_or(FrameId::GROUND, |w| w.on);
    let track = match fields.get("circle") {
        None => line(reader, fields, space, on),
        Some(_) => circle(reader, fields, space, wheel.as_ref()),
    };
    let (wheel, track) = (wheel?, track?);
    let Wheel { frame: wheel, center, radius, on, .. } = wheel;
    Some(ConnectionKind::Rolling { wheel, center, radius, on, track, held, leaves: leaves.then_some(restitution) }.into())
}

/// Only a wheel that is held by its track alone can leave it, and land again.
fn unheld(fields: &Fields, (held, leaves): (bool, bool)) -> Option<Notice> {
    let key = if leaves && !held { "leaves" } else { "restitution" };
    (leaves && !held || !leaves && fields.has("restitution")).then(|| {
        Notice::piece(
            "M080",
            fields.span_of(key),
            format!("`{key}` has no meaning for a wheel that cannot leave its track"),
            format!("`{key}` не имеет смысла: колесо не может оторваться от опоры"),
        )
        .help(
            "leaves = true needs coordinates that let the wheel leave, and no held = false; restitution needs leaves = true",
            "для leaves = true нужны координаты, допускающие отрыв, и не нужно held = false; restitution — только вместе с leaves = true",
        )
    })
}

/// The wheel and the frame of its track.
struct Wheel {
    frame: FrameId,
    center: PointRef,
    radius: Expr,
    /// its radius, when it is a number
    size: Option<f64>,
    on: FrameId,
}

fn wheel<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>, space: &Space, key: &'static str) -> Option<Wheel> {
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

fn line<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>, space: &Space, on: FrameId) -> Option<Track> {
    let (direction, side) = (direction(reader, fields), word(reader, fields, "side", &["left", "right"]));
    let through = fixed_in(reader, fields, "through", space, on)?;
    Some(Track::Line { through, direction, left: side? == 0 })
}

fn circle<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>, space: &Space, wheel: Option<&Wheel>) -> Option<Track> {
    let value = fields.get("circle")?;
    if let Some(key) = ["through", "direction", "side"].into_iter().find(|key| fields.has(key)) {
        reader.fault(
            Notice::piece(
                "M080",
                fields.span_of(key),
                format!("`{key}` belongs to a line, but there is a circle"),
                format!("`{key}` относится к прямой, а задана окружность"),
            )
            .help("keep either the line or the circle", "оставьте либо прямую, либо окружность"),
        );
        return None;
    }
    let DeValue::Table(table) = value.get_ref() else {
        reader.fault(wrong_type(
            value.span(),
            "a table { center, radius, inside }",
            "таблица { center, radius, inside }",
            value.get_ref().type_str(),
        ));
        return None;
    };
    let track = Fields::open(reader, &CIRCLE, table, value.span(), fields.path_of("circle"));
    let inside = track.flag(reader, "inside").unwrap_or(false);
    let radius = size(reader, &track, "radius", &Context::CONSTANT);
    let center = fixed_in(reader, &track, "center", space, wheel.map_or(FrameId::GROUND, |w| w.on))?;
    let (center, radius) = (center?, radius?);
    let sizes = wheel.and_then(|w| w.size).zip(reader.number_of(radius));
    if let Some((small, large)) = sizes.filter(|(small, large)| inside && small >= large) {
        let [small, large] = [small, large].map(|r| digits::quantity(r, "m"));
        reader.fault(
            Notice::piece(
                "M074",
                track.span_of("radius"),
                format!("a wheel of radius {} does not fit into a circle of radius {}", small.en, large.en),
                format!("колесо радиуса {} не помещается в окружности радиуса {}", small.ru, large.ru),
            )
            .why("inside a circle the wheel is the smaller one", "внутри окружности колесо меньше неё"),
        );
        return None;
    }
    Some(Track::Circle { center, radius, inside })
}
