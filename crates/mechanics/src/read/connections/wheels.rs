//! `[belts]`, `[chains]`, `[gears]`: two wheels that turn together.

use super::Found;
use super::common::{Space, choose, positive, same_thing};
use crate::formula::Context;
use crate::model::{ConnectionKind, FrameId, Strands};
use crate::reader::names::{frame_by_name, two_names};
use crate::reader::{Fields, Reader, wrong_type};
use crate::units::Dimension;
use symbolic::Expr;
use words::Notice;

pub(super) fn belt<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>, space: &Space) -> Option<Found> {
    let crossed = fields.flag(reader, "crossed").unwrap_or(false);
    let strands = match fields.has("pretension") {
        true => Strands::Pretension(pretension(reader, fields)?),
        false => Strands::Open,
    };
    wheels(reader, fields, space, (crossed, strands))
}

/// Half the sum of the tensions.
fn pretension<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>) -> Option<Expr> {
    let value = fields.formula(reader, "pretension", &Context::CONSTANT, Some(&Dimension::FORCE))?;
    let Some(number) = reader.number(&value).filter(|v| *v < 0.0) else { return value.good.then_some(value.expr) };
    reader.fault(
        Notice::piece(
            "M074",
            fields.span_of("pretension"),
            format!("`pretension` is {number} N; it must not be negative"),
            format!("`pretension` равно {number} Н; должно быть неотрицательным"),
        )
        .why("the strands of a belt pull", "ветви ремня тянут"),
    );
    None
}

pub(super) fn chain<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>, space: &Space) -> Option<Found> {
    let strands = match fields.name(reader, "tight") {
        Some((word, span)) => Strands::Slack { positive: choose(reader, &word, span, &["+", "-"])? == 0 },
        None => Strands::Open,
    };
    wheels(reader, fields, space, (false, strands))
}

pub(super) fn gear<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>, space: &Space) -> Option<Found> {
    let internal = fields.flag(reader, "internal").unwrap_or(false);
    wheels(reader, fields, space, (!internal, Strands::Teeth))
}

fn wheels<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>, space: &Space, (opposite, strands): (bool, Strands)) -> Option<Found> {
    let names = two_names(reader, fields, "between");
    let found = names.as_ref().map(|names| names.clone().map(|(name, span)| frame_by_name(reader, &name, span)));
    let radii = radii(reader, fields);
    let carrier = fields.has("carrier").then(|| super::common::frame(reader, fields, "carrier"));
    let (names, [a, b]) = (names?, found?);
    let between: [FrameId; 2] = [a?, b?];
    if between[0] == between[1] {
        reader.fault(same_thing(fields.span_of("between"), &names[0].0));
        return None;
    }
    if space.root(between[0]) == space.root(between[1]) {
        let fault = super::common::rigid(fields.span_of("between"), [&names[0].0, &names[1].0]);
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
    Some(ConnectionKind::Wheels { between, radii: radii?, opposite, carrier, strands }.into())
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
