//! Keys that several kinds of connections have.

use crate::keys::{Field, TableSpec, Type, Words, may, must};

/// A table without a short form.
pub const fn table(name: &'static str, about: Words, fields: &'static [Field], example: &'static str) -> TableSpec {
    TableSpec { name, about, fields, short: None, example }
}

/// Two points.
pub const TWO_POINTS: Field = must(
    "between",
    Type::TwoNames,
    "",
    ("two points, or bodies for their origins", "две точки или тела (тогда их начала)"),
    "[\"A\", \"B\"]",
);
/// Axes of components.
pub const AXES: Field =
    may("axes", Type::Name, "", "\"ground\"", ("axes of the components of the reaction", "оси компонент реакции"), "\"crank\"");
/// A pathway by a formula.
pub const ALONG: Field =
    may("along", Type::Formula, "", "", ("pathway: a formula of coordinates", "координата: формула от обобщённых координат"), "\"x\"");
/// A pathway between two things.
pub const BETWEEN: Field = may(
    "between",
    Type::TwoNames,
    "",
    "",
    (
        "pathway: distance of two points, or angle of the second body minus that of the first",
        "координата: расстояние между двумя точками или угол второго тела минус угол первого",
    ),
    "[\"A\", \"B\"]",
);
/// The angle of a body.
pub const ON_BODY: Field = may(
    "on",
    Type::Name,
    "",
    "",
    ("pathway: angle of this body from the ground", "координата: угол этого тела от неподвижной системы"),
    "\"crank\"",
);
/// Of an impact.
pub const RESTITUTION: Field = may(
    "restitution",
    Type::Formula,
    "1",
    "0",
    (
        "ratio of the rates after and before the impact, 0 ... 1; over parameters only",
        "отношение скоростей после и до удара, 0 ... 1; только от параметров",
    ),
    "0.5",
);
/// Of a tie.
pub const LENGTH: Field = may(
    "length",
    Type::Formula,
    "m",
    "\"start\"",
    ("length; \"start\" for that at the start of the motion", "длина; \"start\" — длина в начале движения"),
    "\"l\"",
);
/// What carries a line.
pub const ON_FRAME: Field =
    may("on", Type::Name, "", "\"ground\"", ("frame or body of the line", "система отсчёта или тело, на котором прямая"), "\"frame\"");
/// A point of a line.
pub const THROUGH: Field = may(
    "through",
    Type::Name,
    "",
    "the place at the start",
    ("a point of the line, fixed in `on`", "точка прямой, неподвижная в `on`"),
    "\"B\"",
);
/// Of a line.
pub const DIRECTION: Field = may(
    "direction",
    Type::Formula,
    "rad",
    "0",
    ("angle of the line from the x axis of `on`", "угол прямой с осью x системы `on`"),
    "\"90 deg\"",
);
/// Of a line.
pub const SIDE: Field = may(
    "side",
    Type::String,
    "",
    "\"left\"",
    (
        "side of the line on which the wheel is: left (direction turned by +90 degrees) or right",
        "сторона прямой, на которой колесо: left (направление, повёрнутое на +90 градусов) или right",
    ),
    "\"right\"",
);
/// Two of them.
pub const WHEELS: Field = must("between", Type::TwoNames, "", ("two wheels", "два колеса"), "[\"flywheel\", \"pulley\"]");
/// Of two wheels.
pub const RADII: Field = must("radii", Type::Vector, "m", ("their pitch radii", "радиусы их начальных окружностей"), "[\"r1\", \"R4\"]");
/// Of two axes.
pub const CARRIER: Field = may(
    "carrier",
    Type::Name,
    "",
    "line of the centres",
    (
        "body that carries both axes; turning counts from it. Needed only where both wheels have one origin",
        "тело, несущее обе оси; углы считаются от него. Нужно, только если начала обоих колёс совпадают",
    ),
    "\"arm\"",
);
/// Of a wheel.
pub const RADIUS: Field = must("radius", Type::Formula, "m", ("radius of the rolling circle", "радиус окружности качения"), "\"R5\"");
/// Of a wheel.
pub const CENTER: Field =
    may("center", Type::Name, "", "origin of the body", ("centre of the wheel, a point", "центр колеса, точка"), "\"C\"");
