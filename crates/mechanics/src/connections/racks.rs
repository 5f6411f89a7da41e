//! Gears on racks: no slip along the line, and nothing that carries the gear.

use super::common::keys::{CENTER, DIRECTION, RADIUS, SIDE, table};
use super::common::made::Made;
use super::common::reading::{Space, direction, word};
use super::common::tracks::{Wheel, components, wheel};
use super::row::Row;
use crate::keys::{LABEL, TableSpec, Type, may, must};
use crate::model::{ConnectionKind, Part, Track};
use crate::reader::{Fields, Reader};

/// `[racks]`.
pub(super) const ROW: Row =
    Row { keys: &KEYS, listed: ("gears on racks", "зубчатые рейки"), chapter: "reactions", within: &[], read, components };

/// `[racks.NAME]`.
const KEYS: TableSpec = table(
    "racks",
    (
        "Gears on racks: no slip, but the rack does not carry the gear. tangential acts on the gear along the direction.",
        "Зубчатые рейки: без проскальзывания, но рейка не держит колесо. tangential действует на колесо вдоль направления.",
    ),
    &[
        must("gear", Type::Name, "", ("the gear", "зубчатое колесо"), "\"roller\""),
        RADIUS,
        CENTER,
        may("on", Type::Name, "", "\"ground\"", ("frame or body of the rack", "система отсчёта или тело рейки"), "\"rack\""),
        DIRECTION,
        SIDE,
        LABEL,
    ],
    "[racks.Z]\ngear = \"roller\"\nradius = \"r4\"\non = \"rack\"\n",
);

fn read<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>, space: &Space) -> Option<Made> {
    let wheel = wheel(reader, fields, space, "gear");
    let (direction, side) = (direction(reader, fields), word(reader, fields, "side", &["left", "right"]));
    let wheel = wheel?;
    let track = Track::Line { through: None, direction, left: side? == 0 };
    let Wheel { frame: wheel, center, radius, on, .. } = wheel;
    let kind = ConnectionKind::Rolling { wheel, center, radius, on, track, held: false, leaves: None };
    Some(Made::of(kind).forces(&[Part::Force, Part::Tangential]))
}
