//! Pins: two points coincide, e·(r_Q − r_P) = 0 for each axis e of the reaction, which acts as e on the second body and as −e on the first.

use super::common::axes::axes_of;
use super::common::component::{Component, in_axis, labelled};
use super::common::faults;
use super::common::keys::{AXES, TWO_POINTS, table};
use super::common::made::Made;
use super::common::reading::{Space, frame, two_points};
use super::row::Row;
use crate::keys::{LABEL, TableSpec};
use crate::model::{Connection, ConnectionKind, FrameId, Part, PointRef};
use crate::reader::{Fields, Reader};
use crate::scene::kinematics::Kinematics;
use crate::scene::requests::Resolver;
use crate::scene::wrench::Act;
use crate::scene::{Found, Scene, is_spatial};

/// `[pins]`.
pub(super) const ROW: Row = Row { keys: &KEYS, listed: ("pins", "шарниры"), chapter: "reactions", within: &[], read, components };

/// `[pins.NAME]`.
const KEYS: TableSpec = table(
    "pins",
    (
        "Pins: two points coincide. Reactions force_x, force_y, force_z act on the second body, and opposite on the first; force is the magnitude.",
        "Шарниры: две точки совпадают. Реакции force_x, force_y, force_z действуют на второе тело, противоположные — на первое; force — модуль.",
    ),
    &[TWO_POINTS, AXES, LABEL],
    "[pins.A]\nbetween = [\"A1\", \"A2\"]\n",
);

/// Components of the force.
pub(super) const FORCES: [Part; 4] = [Part::Force, Part::ForceX, Part::ForceY, Part::ForceZ];

fn read<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>, space: &Space) -> Option<Made> {
    let (between, axes) = (two_points(reader, fields, space), frame(reader, fields, "axes"));
    Some(Made::of(ConnectionKind::Pin { between: between?, axes: axes? }).forces(&FORCES))
}

fn components(scene: &mut Scene, kinematics: &mut Kinematics, _: &mut Resolver, connection: &Connection) -> Found<Vec<Component>> {
    let ConnectionKind::Pin { between, axes } = &connection.kind else {
        return Err(faults::of_another_kind(connection));
    };
    Ok(coincide(scene, kinematics, (&connection.name, *between, *axes)))
}

/// r_Q - r_P along the axes.
pub(super) fn coincide(
    scene: &mut Scene,
    kinematics: &mut Kinematics,
    (name, [p, q], axes): (&str, [PointRef; 2], FrameId),
) -> Vec<Component> {
    let (rp, rq) = (kinematics.position(scene, p), kinematics.position(scene, q));
    let between = scene.minus(&rq, &rp);
    let directions = axes_of(scene, kinematics, axes);
    // in turning axes e·d(r_Q - r_P)/dt vanishes with the gap; e'·(r_Q - r_P), no velocity of bodies, is left out
    let turns = !kinematics.frames[axes.index()].turning.is_empty();
    let speed = scene.total_vector(between);
    let count = if is_spatial(scene.model) { 3 } else { 2 };
    (0..count)
        .map(|i| {
            let (what, part, letter) = in_axis(i);
            let e = directions[i];
            let opposite = e.map(|c| scene.graph.neg(c));
            let place = scene.dot(&e, &between);
            let rate = turns.then(|| scene.dot(&e, &speed));
            let acts = vec![Act::Point { point: q, force: e }, Act::Point { point: p, force: opposite }];
            Component {
                place: Some(place), rate, ..Component::ideal((part, letter, "N"), labelled("pin", "шарнир", name, &what), acts)
            }
        })
        .collect()
}
