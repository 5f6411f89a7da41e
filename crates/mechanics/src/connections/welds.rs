//! Welds: two points coincide, and ω_Q − ω_P = 0, about z in the plane, about the axes of the reaction in space.

use super::common::axes::axes_of;
use super::common::component::{Component, no_turning};
use super::common::faults;
use super::common::keys::{AXES, TWO_POINTS, table};
use super::common::made::Made;
use super::common::reading::{Space, frame, two_points};
use super::pins::{FORCES, coincide};
use super::row::Row;
use crate::keys::{LABEL, TableSpec};
use crate::model::{Connection, ConnectionKind, Part};
use crate::reader::{Fields, Reader};
use crate::scene::kinematics::Kinematics;
use crate::scene::requests::Resolver;
use crate::scene::wrench::frame_of;
use crate::scene::{Found, Scene};

/// `[welds]`.
pub(super) const ROW: Row =
    Row {
        keys: &KEYS, listed: ("welds", "жёсткие соединения"), chapter: "survey-linkages", within: &[], read, components
    };

/// `[welds.NAME]`.
const KEYS: TableSpec = table(
    "welds",
    (
        "Welds: two points coincide and their bodies do not turn against each other. Reactions as with pins, and moment (moment_x, moment_y in space).",
        "Жёсткие соединения: две точки совпадают, тела не поворачиваются друг относительно друга. Реакции как у шарниров и moment (в пространстве ещё moment_x, moment_y).",
    ),
    &[TWO_POINTS, AXES, LABEL],
    "[welds.W]\nbetween = [\"end\", \"begin\"]\n",
);

/// Components of the moment.
pub(super) const MOMENTS: [Part; 3] = [Part::Moment, Part::MomentX, Part::MomentY];

fn read<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>, space: &Space) -> Option<Made> {
    let (between, axes) = (two_points(reader, fields, space), frame(reader, fields, "axes"));
    Some(Made::of(ConnectionKind::Weld { between: between?, axes: axes? }).forces(&FORCES).moments(&MOMENTS))
}

fn components(scene: &mut Scene, kinematics: &mut Kinematics, _: &mut Resolver, connection: &Connection) -> Found<Vec<Component>> {
    let ConnectionKind::Weld { between, axes } = &connection.kind else {
        return Err(faults::of_another_kind(connection));
    };
    let mut list = coincide(scene, kinematics, (&connection.name, *between, *axes));
    let frames = between.map(|p| frame_of(scene, p));
    let directions = axes_of(scene, kinematics, *axes);
    list.extend(no_turning(scene, kinematics, (&connection.name, directions), frames));
    Ok(list)
}
