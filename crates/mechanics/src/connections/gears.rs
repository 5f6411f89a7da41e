//! Gear pairs, external and internal.

use super::common::keys::{CARRIER, RADII, WHEELS, table};
use super::common::made::Made;
use super::common::reading::Space;
use super::common::wheels::{self, components};
use super::row::Row;
use crate::keys::{LABEL, TableSpec, Type, may};
use crate::model::Strands;
use crate::reader::{Fields, Reader};

/// `[gears]`.
pub(super) const ROW: Row =
    Row { keys: &KEYS, listed: ("gear pairs", "зубчатые пары"), chapter: "reactions", within: &[], read, components };

/// `[gears.NAME]`.
const KEYS: TableSpec = table(
    "gears",
    (
        "Gear pairs. force acts along the pitch circles, positive when it turns the second wheel in the positive direction; in space about the axis x, y or z of the second wheel that is the axis of both.",
        "Зубчатые пары. force действует по касательной к начальным окружностям, положительна, если вращает второе колесо в положительную сторону; в пространстве — вокруг той оси x, y или z второго колеса, которая является общей осью обоих.",
    ),
    &[
        WHEELS,
        RADII,
        may(
            "internal",
            Type::Bool,
            "",
            "false",
            ("whether one has inner teeth: both turn alike", "внутреннее ли зацепление: вращаются в одну сторону"),
            "true",
        ),
        CARRIER,
        LABEL,
    ],
    "[gears.G]\nbetween = [\"pinion\", \"wheel\"]\nradii = [\"r1\", \"r2\"]\n",
);

fn read<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>, space: &Space) -> Option<Made> {
    let internal = fields.flag(reader, "internal").unwrap_or(false);
    let senses = if internal { wheels::Senses::Equal } else { wheels::Senses::Opposite };
    wheels::read(reader, fields, space, (senses, Strands::Teeth))
}
