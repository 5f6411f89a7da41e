//! Slots: the pin of one body stays on a straight line of another, as a slider that turns.

use super::common::keys::{DIRECTION, ON_FRAME, THROUGH, table};
use super::common::made::Made;
use super::common::reading::Space;
use super::row::Row;
use super::sliders::{ACROSS, Line, components, guide};
use crate::keys::{LABEL, TableSpec, Type, must};
use crate::model::ConnectionKind;
use crate::reader::{Fields, Reader};

/// `[slots]`.
pub(super) const ROW: Row = Row { keys: &KEYS, listed: ("slots", "кулисы"), chapter: "kinematics", within: &[], read, components };

/// `[slots.NAME]`.
const KEYS: TableSpec = table(
    "slots",
    (
        "Slots: a pin stays in a straight slot of a body. force acts on the body of the pin, towards the direction turned by +90 degrees; in space force_y, force_z as for sliders.",
        "Кулисы: палец остаётся в прямом пазу тела. force действует на тело пальца в сторону направления, повёрнутого на +90 градусов; в пространстве — force_y, force_z, как у ползунов.",
    ),
    &[
        must("pin", Type::Name, "", ("the pin: a point, or a body for its origin", "палец: точка или тело (тогда его начало)"), "\"A\""),
        ON_FRAME,
        THROUGH,
        DIRECTION,
        LABEL,
    ],
    "[slots.K]\npin = \"A\"\non = \"yoke\"\n",
);

fn read<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>, space: &Space) -> Option<Made> {
    let Line { point, on, through, direction } = guide(reader, fields, space, "pin")?;
    Some(Made::of(ConnectionKind::Slider { point, on, through, direction, turns: true }).forces(&ACROSS))
}
