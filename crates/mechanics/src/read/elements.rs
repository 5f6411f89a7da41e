//! Springs, dampers, forces, torques, potentials, dissipation functions.

use super::frames::{frame_by_name, frame_named, two_names};
use super::reader::{Checked, Fields, Reader, components};
use crate::fields;
use crate::formula::{Context, Kind, Place};
use crate::model::{
    Action, Damper, Dissipation, Element, Force, FrameId, Measure, Pathway, PointRef, Potential, Reliance, Rest, Spring, Torque,
};
use crate::units::Dimension;
use symbolic::{Expr, Rational};
use toml::de::DeValue;
use words::Notice;

/// `[springs]`.
pub(super) fn springs<'a>(reader: &mut Reader<'a>, top: &Fields<'a>) -> Vec<Spring> {
    let mut found = Vec::new();
    for (name, fields) in top.entries(reader, "springs", &fields::SPRING) {
        if !reader.name_is_fine(&name, fields.span.clone(), &["ground"]) {
            continue;
        }
        let path = pathway_of(reader, &fields);
        let length = path.map_or(Kind::Unknown, |p| p.1);
        let (stiffness_unit, force_unit) = (per(length, 2, 0), per(length, 1, 0));
        let stiffness = fields.formula_or_zero(reader, "stiffness", &Context::TIME, stiffness_unit.as_ref());
        useful(reader, &fields, "stiffness", &stiffness, ("spring", "пружина"));
        let rest = rest(reader, &fields, path.map(|p| p.0), length);
        let preload = fields.formula_or_zero(reader, "preload", &Context::TIME, force_unit.as_ref()).expr;
        let backlash = backlash(reader, &fields, length);
        reader.scope.declare_element(&name, Element::Spring(found.len()), length);
        let pathway = path.map_or(Pathway::Along(stiffness.expr, Measure::Other), |p| p.0);
        found.push(Spring { name, pathway, stiffness: stiffness.expr, rest, preload, backlash, span: fields.span.clone() });
    }
    found
}

fn rest<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>, path: Option<Pathway>, length: Kind) -> Rest {
    let wanted = match length {
        Kind::Known(d) => Some(d),
        _ => None,
    };
    match fields.get("rest") {
        Some(value) if value.get_ref().as_str() == Some("start") => Rest::Start,
        Some(value) if value.get_ref().as_str() == Some("equilibrium") => {
            let name = fields.path.rsplit('.').next().unwrap_or_default().to_owned();
            Rest::Value(reader.rest_from_statics(&name, length, value.span()))
        }
        Some(_) => Rest::Value(fields.formula_or_zero(reader, "rest", &Context::TIME, wanted.as_ref()).expr),
        None => {
            if let Some(Pathway::Distance(..)) = path {
                reader.fault(
                    Notice::piece(
                        "M059",
                        fields.span.clone(),
                        format!("{} lacks `rest`, its length without force", fields.path),
                        format!("в {} нет `rest` — длины без нагрузки", fields.path),
                    )
                    .why(
                        "between two points a free length of zero is hardly ever meant",
                        "нулевая длина свободной пружины между точками почти никогда не имеется в виду",
                    )
                    .help(
                        "add rest = \"0.1 m\", or rest = \"start\" for the distance at the start",
                        "добавьте rest = \"0,1 м\" или rest = \"start\" — расстояние в начале движения",
                    ),
                );
            }
            Rest::Value(reader.builder.graph.zero())
        }
    }
}

fn backlash<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>, length: Kind) -> Option<Expr> {
    let wanted = if let Kind::Known(d) = length { Some(d) } else { None };
    let value = fields.formula(reader, "backlash", &Context::TIME, wanted.as_ref())?;
    if let Some(number) = reader.number_for(&value, Reliance::Sign).filter(|v| *v < 0.0) {
        let (en, ru) = (format!("the backlash is {number}; it is not negative"), format!("зазор равен {number}; он не отрицателен"));
        reader.fault(Notice::piece("M088", fields.span_of("backlash"), en, ru));
    } else if fields.has("preload") {
        reader.fault(
            Notice::piece(
                "M088",
                fields.span_of("backlash"),
                "a spring with backlash has no preload",
                "у пружины с зазором нет предварительного усилия",
            )
            .why("within the play the force is zero", "внутри зазора усилие равно нулю")
            .help("drop one of them, or add a second spring", "уберите одно из них или добавьте вторую пружину"),
        );
    }
    (!reader.builder.graph.is_zero(value.expr)).then_some(value.expr)
}

/// Warns of a stiffness or damping that is zero or negative.
fn useful(reader: &mut Reader, fields: &Fields, key: &'static str, value: &Checked, kind: (&str, &str)) {
    let Some(v) = reader.number_for(value, Reliance::Sign).filter(|v| *v <= 0.0) else { return };
    // an element that the command line, a variant or a sweep switches off is meant
    if !fields.has(key) || v == 0.0 && reader.is_set_by_hand(value) {
        return;
    }
    let fault = if v == 0.0 {
        Notice::piece(
            "M056",
            fields.span_of(key),
            format!("the {key} of {} is zero: this {} does nothing", fields.path, kind.0),
            format!("{key} в {} равно нулю: {} не действует", fields.path, kind.1),
        )
    } else {
        let value = words::digits::typed(v);
        Notice::piece(
            "M056",
            fields.span_of(key),
            format!("the {key} of {} is negative ({})", fields.path, value.en),
            format!("{key} в {} отрицательно ({})", fields.path, value.ru),
        )
        .why(
            "it feeds energy into the motion instead of restoring or damping it",
            "такой элемент не возвращает и не гасит движение, а раскачивает его",
        )
    };
    reader.fault(fault.warning());
}

/// `[dampers]`.
pub(super) fn dampers<'a>(reader: &mut Reader<'a>, top: &Fields<'a>) -> Vec<Damper> {
    let mut found = Vec::new();
    for (name, fields) in top.entries(reader, "dampers", &fields::DAMPER) {
        if !reader.name_is_fine(&name, fields.span.clone(), &["ground"]) {
            continue;
        }
        let path = pathway_of(reader, &fields);
        let length = path.map_or(Kind::Unknown, |p| p.1);
        let unit = per(length, 2, 1);
        let damping = fields.formula_or_zero(reader, "damping", &Context::PATHWAY, unit.as_ref());
        useful(reader, &fields, "damping", &damping, ("damper", "демпфер"));
        reader.scope.declare_element(&name, Element::Damper(found.len()), length);
        let pathway = path.map_or(Pathway::Along(damping.expr, Measure::Other), |p| p.0);
        found.push(Damper { name, pathway, damping: damping.expr, span: fields.span.clone() });
    }
    found
}

/// energy · time^times / pathway^powers: the dimension of stiffness, damping, force on a pathway.
fn per(pathway: Kind, powers: i64, times: i32) -> Option<Dimension> {
    let Kind::Known(d) = pathway else { return None };
    let below = d.without_angle().pow(&Rational::from(powers))?;
    Dimension::ENERGY.mul(&Dimension::of(0, 0, times))?.div(&below)
}

/// The pathway of an element and its dimension.
pub(super) fn pathway_of<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>) -> Option<(Pathway, Kind)> {
    match (fields.has("along"), fields.has("between")) {
        (true, false) => {
            let along = fields.formula(reader, "along", &Context::PATHWAY, None)?;
            along.good.then_some((Pathway::Along(along.expr, measured(along.kind)), along.kind))
        }
        (false, true) => between(reader, fields),
        (both, _) => {
            let (en, ru) = if both {
                ("both `along` and `between`", "и `along`, и `between`")
            } else {
                ("neither `along` nor `between`", "ни `along`, ни `between`")
            };
            reader.fault(
                Notice::piece("M057", fields.span.clone(), format!("{} has {en}", fields.path), format!("в {} есть {ru}", fields.path))
                    .why("an element acts through one scalar: its pathway", "элемент действует через одну скалярную координату")
                    .help(
                        "write along = \"x\", or between = [\"A\", \"B\"] with two points (distance) or two bodies (angle)",
                        "напишите along = \"x\" или between = [\"A\", \"B\"]: две точки (расстояние) или два тела (угол)",
                    ),
            );
            None
        }
    }
}

/// What a pathway of this dimension measures.
fn measured(kind: Kind) -> Measure {
    match kind {
        Kind::Known(d) if d.same(&Dimension::LENGTH) => Measure::Length,
        Kind::Known(d) if d.without_angle().is_none() => Measure::Angle,
        _ => Measure::Other,
    }
}

fn between<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>) -> Option<(Pathway, Kind)> {
    let [first, second] = two_names(reader, fields, "between")?;
    let mut find = |(name, span): &(String, std::ops::Range<usize>)| {
        let place = reader.scope.place(name);
        if place.is_none() {
            let fault = reader.scope.unknown_place(name, span.clone());
            reader.fault(fault);
        }
        place
    };
    let (a, b) = (find(&first), find(&second));
    let (a, b) = (a?, b?);
    if a == b {
        reader.fault(
            Notice::piece("M063", fields.span_of("between"), format!("both ends are `{}`", first.0), format!("оба конца — `{}`", first.0))
                .why("an element between a thing and itself does nothing", "элемент между телом и им самим не действует"),
        );
        return None;
    }
    match (a, b) {
        (Place::Point(a), Place::Point(b)) => {
            Some((Pathway::Distance(PointRef::Point(a), PointRef::Point(b)), Kind::Known(Dimension::LENGTH)))
        }
        (Place::Frame(a), Place::Frame(b)) => Some((Pathway::RelativeAngle(a, b), Kind::Known(Dimension::ANGLE))),
        _ => {
            reader.fault(
                Notice::piece(
                    "M058",
                    fields.span_of("between"),
                    format!("`{}` and `{}` are a point and a body", first.0, second.0),
                    format!("`{}` и `{}` — точка и тело", first.0, second.0),
                )
                .why("two points give a distance, two bodies give an angle", "две точки дают расстояние, два тела — угол")
                .help(
                    "add a point on the body: A = { on = \"body\", at = [0, 0] }",
                    "добавьте точку на теле: A = { on = \"body\", at = [0, 0] }",
                ),
            );
            None
        }
    }
}

/// `[forces]`.
pub(super) fn forces<'a>(reader: &mut Reader<'a>, top: &Fields<'a>) -> Vec<Force> {
    let mut found = Vec::new();
    for (name, fields) in top.entries(reader, "forces", &fields::FORCE) {
        if reader.name_is_fine(&name, fields.span.clone(), &["ground"])
            && !super::structures::force(reader, &name, &fields)
            && let Some(action) = action(reader, &fields)
        {
            let load = format!("forces.{name}");
            found.push(Force { name, load, action, span: fields.span.clone() });
        }
    }
    found
}

fn action<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>) -> Option<Action> {
    let on_path = fields.has("along") || fields.has("between");
    if fields.has("at") == on_path {
        reader.fault(
            Notice::piece(
                "M062",
                fields.span.clone(),
                format!("{} needs either `at` or a pathway", fields.path),
                format!("в {} нужно либо `at`, либо координата", fields.path),
            )
            .help(
                "at = \"A\" with value = [\"Fx\", \"Fy\"]; or along = \"x\" (or between) with value = \"F\"",
                "at = \"A\" и value = [\"Fx\", \"Fy\"]; либо along = \"x\" (или between) и value = \"F\"",
            ),
        );
        return None;
    }
    if on_path {
        let (pathway, length) = pathway_of(reader, fields)?;
        let value = fields.formula_or_zero(reader, "value", &Context::FORCE, per(length, 1, 0).as_ref()).expr;
        return Some(Action::OnPathway { pathway, value });
    }
    let (name, span) = fields.name(reader, "at")?;
    let at = match reader.scope.place(&name) {
        Some(Place::Point(p)) => PointRef::Point(p),
        Some(Place::Frame(f)) => PointRef::Center(f),
        None => {
            let fault = reader.scope.unknown_place(&name, span);
            reader.fault(fault);
            return None;
        }
    };
    let value = components(reader, fields.get("value")?, &Context::FORCE, &Dimension::FORCE);
    let axes = frame_named(reader, fields, "axes");
    Some(Action::AtPoint { at, value, axes })
}

/// `[torques]`.
pub(super) fn torques<'a>(reader: &mut Reader<'a>, top: &Fields<'a>) -> Vec<Torque> {
    let mut found = Vec::new();
    for (name, fields) in top.entries(reader, "torques", &fields::TORQUE) {
        if !reader.name_is_fine(&name, fields.span.clone(), &["ground"]) {
            continue;
        }
        if super::structures::torque(reader, &name, &fields) {
            continue;
        }
        let on = frame_named(reader, &fields, "on");
        let axes = frame_named(reader, &fields, "axes");
        let reaction = fields.name(reader, "reaction").and_then(|(name, span)| frame_by_name(reader, &name, span));
        let value = torque_value(reader, &fields);
        if reaction == Some(on) && on != FrameId::GROUND {
            reader.fault(Notice::piece(
                "M063",
                fields.span_of("reaction"),
                "the torque and its reaction act on the same body",
                "момент и противоположный ему действуют на одно тело",
            ));
        }
        found.push(Torque { name, on, value, axes, reaction, span: fields.span.clone() });
    }
    found
}

fn torque_value<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>) -> [Expr; 3] {
    let zero = reader.builder.graph.zero();
    match fields.get("value").map(|v| (v, v.get_ref())) {
        Some((value, DeValue::Array(items))) if items.len() != 3 => {
            reader.fault(Notice::piece(
                "M008",
                value.span(),
                format!("a torque has 3 components or is one formula about z, {} given", items.len()),
                format!("у момента 3 компоненты либо одна формула вокруг z, дано: {}", items.len()),
            ));
            [zero; 3]
        }
        Some((value, DeValue::Array(_))) => components(reader, value, &Context::FORCE, &Dimension::ENERGY),
        _ => [zero, zero, fields.formula_or_zero(reader, "value", &Context::FORCE, Some(&Dimension::ENERGY)).expr],
    }
}

/// `[potentials]`.
pub(super) fn potentials<'a>(reader: &mut Reader<'a>, top: &Fields<'a>) -> Vec<Potential> {
    let mut found = Vec::new();
    for (name, fields) in top.entries(reader, "potentials", &fields::POTENTIAL) {
        if reader.name_is_fine(&name, fields.span.clone(), &["ground"]) {
            let energy = fields.formula_or_zero(reader, "energy", &Context::PATHWAY, Some(&Dimension::ENERGY)).expr;
            found.push(Potential { name, energy, span: fields.span.clone() });
        }
    }
    found
}

/// `[dissipations]`.
pub(super) fn dissipations<'a>(reader: &mut Reader<'a>, top: &Fields<'a>) -> Vec<Dissipation> {
    let mut found = Vec::new();
    for (name, fields) in top.entries(reader, "dissipations", &fields::DISSIPATION) {
        if reader.name_is_fine(&name, fields.span.clone(), &["ground"]) {
            let function = fields.formula_or_zero(reader, "function", &Context::FORCE, Some(&Dimension::POWER)).expr;
            found.push(Dissipation { name, function, span: fields.span.clone() });
        }
    }
    found
}
