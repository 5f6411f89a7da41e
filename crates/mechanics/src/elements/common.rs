//! What elements share: the pathway through which they act, and the dimensions that follow from it.

use crate::formula::{Context, Kind, Place, Told};
use crate::model::{Measure, Pathway, PointRef, Reliance};
use crate::reader::names::two_names;
use crate::reader::{Checked, Fields, Reader};
use crate::units::Dimension;
use symbolic::Rational;
use words::Notice;

/// energy · time^times / pathway^powers: the dimension of stiffness, damping, force on a pathway.
pub(super) fn per(pathway: Kind, powers: i64, times: i32) -> Option<Dimension> {
    let Kind::Known(d) = pathway else { return None };
    let below = d.without_angle().pow(&Rational::from(powers))?;
    Dimension::ENERGY.mul(&Dimension::of(0, 0, times))?.div(&below)
}

/// The pathway of an element and its dimension.
pub(crate) fn pathway_of<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>) -> Option<(Pathway, Kind)> {
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

/// Warns of a stiffness or damping that is zero or negative.
pub(super) fn useful(reader: &mut Reader, fields: &Fields, key: &'static str, value: &Checked, kind: (&str, &str)) {
    let Some(v) = reader.number_for(value, Reliance::Sign).filter(|v| *v <= 0.0) else { return };
    // an element that the command line, a variant or a sweep switches off is meant; and one with another datum acts by that
    let acts = ["stiffness", "damping"].iter().any(|other| *other != key && fields.knows(other) && fields.has(other));
    if !fields.has(key) || v == 0.0 && (acts || reader.is_set_by_hand(value)) {
        return;
    }
    let fault = if v == 0.0 {
        Notice::piece(
            "M056",
            fields.span_of(key),
            format!("the {key} of {} is zero: this {} does nothing", fields.path, kind.0),
            format!("значение {key} в {} равно нулю: {} не действует", fields.path, kind.1),
        )
    } else {
        let value = words::digits::typed(v);
        let why = match key {
            "stiffness" => (
                "it pushes away from the place where its force vanishes instead of pulling back",
                "усилие направлено не к положению, где оно равно нулю, а от него",
            ),
            _ => {
                ("it feeds energy into the motion instead of taking it away", "такой элемент не отнимает энергию у движения, а подводит её")
            }
        };
        Notice::piece(
            "M056",
            fields.span_of(key),
            format!("the {key} of {} is negative ({})", fields.path, value.en),
            format!("значение {key} в {} отрицательно ({})", fields.path, value.ru),
        )
        .why(why.0, why.1)
    };
    reader.fault(fault.warning());
}

/// The functions of an element on a pathway: its force (first value), which is a torque on an angle, and the pathway beyond rest (second value).
pub(super) fn told(pathway: Kind) -> Vec<Told> {
    let kind = pathway.conjugate();
    let other = matches!(kind, Kind::Known(d) if !d.same(&Dimension::ENERGY));
    let torque = Told { function: "torque", kind, value: 0 };
    let rest = [Told { function: "force", kind, value: 0 }, Told { function: "extension", kind: pathway, value: 1 }];
    (!other).then_some(torque).into_iter().chain(rest).collect()
}
