//! What a friction acts between: a pathway, a point on another body, a named contact, a pin, a rope.

use crate::connections::common::reading::{pathway, point_named, size};
use crate::formula::{Context, Kind, shared};
use crate::model::{Aim, Connection, ConnectionKind, PointRef, Reliance, Slides};
use crate::reader::names::names;
use crate::reader::names::{frame_by_name, frame_named, two_names};
use crate::reader::{Fields, Reader, components};
use crate::units::Dimension;
use symbolic::Function;
use toml::de::DeValue;
use words::Notice;

/// Keys that say it, one of them at a time; a pathway goes by one of three.
const PLACES: [&str; 6] = ["along", "between", "on", "at", "pin", "rope"];
/// Keys that belong to some of them only.
const OWN: [(&str, &[&str]); 6] =
    [("direction", &["at"]), ("axes", &["at"]), ("lever", &["at"]), ("radius", &["at", "pin"]), ("over", &["rope"]), ("wrap", &["rope"])];

/// What slides, and the dimension of its way.
pub(super) fn slides<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>) -> Option<(Slides, Kind)> {
    let given: Vec<&'static str> = PLACES.into_iter().filter(|key| fields.has(key)).collect();
    let by = match given[..] {
        [.., other] if given.len() > 1 && PLACES[3..].contains(&other) => {
            reader.fault(several(fields, other));
            return None;
        }
        [only] if PLACES[3..].contains(&only) => only,
        _ => "",
    };
    if let Some((key, _)) = OWN.into_iter().find(|(key, of)| fields.has(key) && !of.contains(&by)) {
        reader.fault(foreign(fields, key));
        return None;
    }
    match by {
        "at" => at(reader, fields),
        "pin" => pin(reader, fields),
        "rope" => rope(reader, fields),
        _ => pathway(reader, fields).map(|(path, kind)| (Slides::Along(path), kind)),
    }
}

/// Whether the normal force comes with what slides.
pub(super) fn presses(slides: &Slides) -> bool {
    !matches!(slides, Slides::Along(_) | Slides::Point { .. })
}

fn at<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>) -> Option<(Slides, Kind)> {
    let length = Kind::Known(Dimension::LENGTH);
    if is_single(fields, "at") {
        let (table, of) = connection(reader, fields, "at", &["rolling", "stops"])?;
        if table == "rolling" && fields.has("radius") {
            reader.fault(foreign(fields, "radius"));
            return None;
        }
        if fields.has("lever") {
            return Some((Slides::Rolls { of }, Kind::Known(Dimension::ANGLE)));
        }
        let radius = match fields.has("radius") {
            true => Some(fields.formula(reader, "radius", &Context::CONSTANT, Some(&Dimension::LENGTH)).filter(|r| r.good)?.expr),
            false => None,
        };
        let direction = match fields.has("direction") {
            true => Some(aim(reader, fields)?),
            false => None,
        };
        return Some((Slides::Contact { of, direction, radius }, length));
    }
    if let Some(key) = ["lever", "radius"].into_iter().find(|key| fields.has(key)) {
        reader.fault(foreign(fields, key));
        return None;
    }
    let [(name, span), (body, place)] = two_names(reader, fields, "at")?;
    let (point, on) = (point_named(reader, &name, span), frame_by_name(reader, &body, place));
    let (point, on) = (point?, on?);
    if !fields.has("direction") {
        reader.fault(without_direction(fields));
        return None;
    }
    let direction = aim(reader, fields)?;
    Some((Slides::Point { point, on, direction }, length))
}

fn pin<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>) -> Option<(Slides, Kind)> {
    let of = connection(reader, fields, "pin", &["pins", "supports"]);
    if !fields.has("radius") {
        let (en, ru) = (format!("{} lacks the radius of the pin", fields.path), format!("в {} нет радиуса цапфы", fields.path));
        reader.fault(Notice::piece("M120", fields.span.clone(), en, ru).help("add radius = \"10 mm\"", "добавьте radius = \"10 mm\""));
        return None;
    }
    let radius = size(reader, fields, "radius", &Context::CONSTANT);
    Some((Slides::Journal { of: of?.1, radius: radius? }, Kind::Known(Dimension::ANGLE)))
}

fn rope<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>) -> Option<(Slides, Kind)> {
    let of = connection(reader, fields, "rope", &["ropes", "threads"]);
    let over = over(reader, fields);
    let wrap = match fields.has("wrap") {
        true => Some(fields.formula(reader, "wrap", &Context::TIME, Some(&Dimension::ANGLE)).filter(|w| w.good)?.expr),
        false => None,
    };
    Some((Slides::Belt { of: of?.1, over: over?, wrap }, Kind::Known(Dimension::LENGTH)))
}

/// One point of the drum, or the first and the last.
fn over<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>) -> Option<[PointRef; 2]> {
    match fields.get("over").map(|v| v.get_ref()) {
        None => {
            let (en, ru) = (format!("{} lacks `over`", fields.path), format!("в {} нет `over`", fields.path));
            let fault = Notice::piece("M120", fields.span.clone(), en, ru).help(
                "add over = \"P\", the point of the rope's path on the drum, or over = [\"P1\", \"P2\"], where it runs on and off",
                "добавьте over = \"P\" — точку пути каната на барабане, или over = [\"P1\", \"P2\"] — точки набегания и сбегания",
            );
            reader.fault(fault);
            None
        }
        Some(DeValue::Array(_)) if !is_single(fields, "over") => {
            let [first, last] = two_names(reader, fields, "over")?.map(|(name, span)| point_named(reader, &name, span));
            Some([first?, last?])
        }
        Some(_) => {
            let (name, span) = single(reader, fields, "over")?;
            point_named(reader, &name, span).map(|p| [p, p])
        }
    }
}

/// Whether a key holds one name, by itself or as a list of one.
fn is_single(fields: &Fields<'_>, key: &'static str) -> bool {
    fields.get(key).is_some_and(|v| v.get_ref().as_array().is_none_or(|list| list.len() == 1))
}

/// The name of such a key.
fn single<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>, key: &'static str) -> Option<(String, std::ops::Range<usize>)> {
    match fields.get(key).filter(|v| v.get_ref().as_array().is_some()) {
        Some(value) => names(reader, value).pop(),
        None => fields.name(reader, key),
    }
}

/// The table and the index of a named connection of one of these tables.
fn connection<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>, key: &'static str, tables: &[&str]) -> Option<(&'static str, usize)> {
    let (name, span) = single(reader, fields, key)?;
    let named = reader.scope.connections(tables, &name);
    match named[..] {
        [(table, index)] => index.map(|i| (table, i)),
        [_, _, ..] => {
            let several: Vec<&str> = named.iter().map(|(table, _)| *table).collect();
            let fault = shared(&several, &name, &span, |table| format!("{key} = \"{table}.{name}\""));
            reader.fault(fault);
            None
        }
        [] => {
            let list = tables.join(", ");
            let fault = Notice::piece("M121", span, format!("there is no `{name}` in {list}"), format!("нет `{name}` среди {list}"));
            let near: Vec<String> = reader.scope.connections_of(tables).map(str::to_owned).collect();
            let fault = match reader.scope.nearest(&name, near.iter().map(String::as_str)) {
                Some(near) => fault.meant(&name, near),
                None => fault.help(help(key).0, help(key).1),
            };
            reader.fault(fault);
            None
        }
    }
}

fn help(key: &str) -> (&'static str, &'static str) {
    match key {
        "pin" => ("name a pin or a support of the journal: pin = \"O\"", "укажите шарнир или опору цапфы: pin = \"O\""),
        "rope" => ("name a rope or a thread: rope = \"R\"", "укажите канат или нить: rope = \"R\""),
        _ => (
            "name a rolling contact or a stop, or a point and the other body: at = [\"A\", \"floor\"]",
            "укажите качение или упор либо точку и другое тело: at = [\"A\", \"floor\"]",
        ),
    }
}

/// `direction`: an axis by its name, a vector, or an angle from the x axis.
fn aim<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>) -> Option<Aim> {
    let axes = frame_named(reader, fields, "axes");
    let value = fields.get("direction")?;
    let vector = match value.get_ref() {
        DeValue::Array(_) => components(reader, value, &Context::GEOMETRY, &Dimension::NONE),
        DeValue::String(text) if axis(text).is_some() => {
            let (i, sign) = axis(text)?;
            let graph = &mut reader.builder.graph;
            let mut vector = [graph.zero(); 3];
            vector[i] = graph.int(sign);
            vector
        }
        _ => {
            let angle = fields.formula(reader, "direction", &Context::CONSTANT, Some(&Dimension::ANGLE)).filter(|a| a.good)?.expr;
            let graph = &mut reader.builder.graph;
            [graph.call(Function::Cos, &[angle]), graph.call(Function::Sin, &[angle]), graph.zero()]
        }
    };
    if vector.iter().all(|e| reader.number_of(*e) == Some(0.0)) {
        let span = value.span();
        reader.fault(Notice::piece("M122", span, "the direction is the zero vector", "направление задано нулевым вектором"));
        return None;
    }
    Some(Aim { vector, axes })
}

fn axis(text: &str) -> Option<(usize, i64)> {
    let text = text.trim();
    let (name, sign) = text.strip_prefix('-').map_or((text, 1), |rest| (rest, -1));
    ["x", "y", "z"].iter().position(|axis| *axis == name).map(|i| (i, sign))
}

fn without_direction(fields: &Fields) -> Notice {
    let (en, ru) = (format!("{} lacks the direction of sliding", fields.path), format!("в {} нет направления скольжения", fields.path));
    Notice::piece("M122", fields.span.clone(), en, ru).help(
        "add direction = \"x\", a vector [\"cos(a)\", \"sin(a)\"], or an angle from the x axis of `axes`",
        "добавьте direction = \"x\", вектор [\"cos(a)\", \"sin(a)\"] или угол с осью x системы `axes`",
    )
}

fn several(fields: &Fields, key: &'static str) -> Notice {
    let path = &fields.path;
    Notice::piece("M120", fields.span_of(key), format!("{path} acts in more than one way"), format!("в {path} место трения задано дважды"))
        .help("keep one of `along`, `between`, `on`, `at`, `pin`, `rope`", "оставьте одно из `along`, `between`, `on`, `at`, `pin`, `rope`")
}

fn foreign(fields: &Fields, key: &'static str) -> Notice {
    let of = OWN.iter().find(|(own, _)| *own == key).map_or(String::new(), |(_, of)| format!("`{}`", of.join("`, `")));
    Notice::piece(
        "M120",
        fields.span_of(key),
        format!("`{key}` belongs to a friction with {of}"),
        format!("`{key}` относится к трению, заданному через {of}"),
    )
    .why(
        "direction, axes: the force at a point; lever: a named contact; radius: a pin, or a stop's contact; over, wrap: a rope",
        "direction, axes — сила в точке; lever — названный контакт; radius — цапфа или контакт упора; over, wrap — канат",
    )
}

/// What the normal force of the contact is to the friction: N for a force, the lever for a moment, a number for the pin and the rope.
pub(super) fn coefficient(slides: &Slides) -> Dimension {
    if matches!(slides, Slides::Rolls { .. }) { Dimension::LENGTH } else { Dimension::NONE }
}

/// A rope that springs back has strands of different speeds before and behind the drum, and no law says with which of them it slides there.
pub(crate) fn springing_back(reader: &mut Reader<'_>, connections: &[Connection]) {
    for friction in connections {
        let ConnectionKind::Friction { slides: Slides::Belt { of, .. }, .. } = &friction.kind else { continue };
        let ConnectionKind::Rope { slack: true, restitution, .. } = &connections[*of].kind else { continue };
        if reader.number_of_for(*restitution, Reliance::Share).is_none_or(|e| e == 0.0) {
            continue;
        }
        let (name, rope) = (&friction.name, &connections[*of].name);
        let fault = Notice::piece(
            "M145",
            friction.span.clone(),
            format!("`frictions.{name}` rubs on a drum under `{rope}`, which springs back when it tightens (`restitution`)"),
            format!("`frictions.{name}`: канат `{rope}` трётся о барабан и при натяжении отскакивает (`restitution`)"),
        )
        .why(
            "springing back the strands before and behind the drum have different speeds, and how they share the rebound depends on their stretching",
            "при отскоке ветви до и после барабана имеют разные скорости, а доли отскока зависят от растяжимости ветвей",
        )
        .help(
            "restitution = 0, or two ropes with springs and dampers in their place",
            "задайте restitution = 0 либо замените ветви пружинами с демпферами",
        );
        reader.fault(fault);
    }
}
