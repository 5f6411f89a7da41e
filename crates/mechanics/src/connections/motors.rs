//! Motors: the unknown force or torque along a pathway that realises a prescribed motion.

use super::common::component::{Component, Nature, effort, path};
use super::common::faults;
use super::common::keys::{ALONG, BETWEEN, ON_BODY, table};
use super::common::made::Made;
use super::common::reading::{Space, pathway};
use super::row::Row;
use crate::keys::{LABEL, TableSpec};
use crate::model::{Connection, ConnectionKind, Part};
use crate::reader::{Fields, Reader};
use crate::scene::kinematics::Kinematics;
use crate::scene::requests::Resolver;
use crate::scene::{Found, Scene};
use words::Text;

/// `[motors]`.
pub(super) const ROW: Row = Row {
    keys: &KEYS,
    listed: ("motors that realise motions", "двигатели, реализующие заданные движения"),
    chapter: "inverse",
    within: &[],
    read,
    components,
};

/// `[motors.NAME]`.
const KEYS: TableSpec = table(
    "motors",
    (
        "Motors: unknown forces or torques that realise the motions. Between two bodies the torque acts on the second and opposite on the first; positive increases the pathway.",
        "Двигатели: неизвестные силы и моменты, реализующие заданные движения. Между двумя телами момент действует на второе, противоположный — на первое; положительный увеличивает координату.",
    ),
    &[ALONG, BETWEEN, ON_BODY, LABEL],
    "[motors.B]\nbetween = [\"bar2\", \"bar1\"]\n",
);

fn read<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>, _: &Space) -> Option<Made> {
    let (pathway, kind) = pathway(reader, fields)?;
    Some(Made::along(ConnectionKind::Motor { pathway }, kind.conjugate()))
}

fn components(scene: &mut Scene, kinematics: &mut Kinematics, resolver: &mut Resolver, connection: &Connection) -> Found<Vec<Component>> {
    let ConnectionKind::Motor { pathway } = &connection.kind else {
        return Err(faults::of_another_kind(connection));
    };
    // not Q: Q_x is the generalized force of the loads
    let (letter, unit) = effort(*pathway, "M", "F");
    let path = path(scene, kinematics, resolver, connection, *pathway)?;
    let name = &connection.name;
    let label = Text::new(format!("drive {name}"), format!("привод {name}"));
    Ok(vec![Component { nature: Nature::Motor, ..Component::ideal((Part::Force, letter, unit), label, path.acts) }])
}
