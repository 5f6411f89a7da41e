//! `[rods]`, `[ropes]`, `[threads]`.

use super::Found;
use super::common::{Space, choose, frame, length, point_named, restitution, same_thing, size, two_points};
use crate::fields::connections::WOUND;
use crate::formula::Context;
use crate::model::{ConnectionKind, PointRef, Wound};
use crate::reader::names::frame_by_name;
use crate::reader::names::names;
use crate::reader::{Fields, Reader, wrong_type};
use toml::de::DeValue;
use words::Notice;

pub(super) fn rod<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>, space: &Space) -> Option<Found> {
    let (between, length) = (two_points(reader, fields, space), length(reader, fields));
    Some(ConnectionKind::Rod { between: between?, length: length? }.into())
}

pub(super) fn rope<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>, space: &Space) -> Option<Found> {
    let path = path(reader, fields);
    let wound = drums(reader, fields);
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
    Some(ConnectionKind::Rope { path, wound, length: length?, slack, restitution }.into())
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

fn drums<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>) -> Option<Vec<Wound>> {
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
