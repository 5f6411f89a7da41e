//! Loads distributed along a line.

use crate::keys::{LABEL, TableSpec, Type, may, must};

/// `[distributed.NAME]`.
pub const DISTRIBUTED: TableSpec = TableSpec {
    name: "distributed",
    short: None,
    about: (
        "Loads distributed along the straight line between two points of one body, uniform or growing linearly; replaced by the equivalent forces.",
        "Нагрузки, распределённые вдоль прямой между двумя точками одного тела, равномерно или по линейному закону; заменяются эквивалентными силами.",
    ),
    fields: &[
        may("on", Type::Name, "", "body of the points", ("body it acts on", "тело, на которое действует"), "\"beam\""),
        must("from", Type::Name, "", ("point where it begins", "точка начала"), "\"A\""),
        must("to", Type::Name, "", ("point where it ends", "точка конца"), "\"B\""),
        must("value", Type::Vector, "N/m", ("force per length at `from`", "сила на единицу длины в `from`"), "[\"0\", \"-q\"]"),
        may("value_end", Type::Vector, "N/m", "value", ("force per length at `to`", "сила на единицу длины в `to`"), "[\"0\", \"0\"]"),
        may("axes", Type::Name, "", "\"ground\"", ("axes of the components", "оси компонент"), "\"beam\""),
        LABEL,
    ],
    example: "[distributed.q]\nfrom = \"A\"\nto = \"B\"\nvalue = [\"0\", \"-q\"]\n",
};
