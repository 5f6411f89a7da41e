//! Massless rigid rods: |r_B − r_A| = l; the tension pulls the ends together.

use super::common::component::{Component, length_of, path};
use super::common::faults;
use super::common::keys::{LENGTH, TWO_POINTS, table};
use super::common::made::Made;
use super::common::reading::{Space, length, two_points};
use super::row::Row;
use crate::keys::{LABEL, TableSpec};
use crate::model::{Connection, ConnectionKind, Part, Pathway, PointRef};
use crate::reader::{Fields, Reader};
use crate::scene::kinematics::Kinematics;
use crate::scene::requests::Resolver;
use crate::scene::start::at_start;
use crate::scene::{Found, Scene};
use symbolic::Expr;
use words::Text;

/// `[rods]`.
pub(super) const ROW: Row =
    Row {
        keys: &KEYS, listed: ("massless rods", "невесомые стержни"), chapter: "reactions", within: &[], read, components
    };

/// `[rods.NAME]`.
const KEYS: TableSpec = table(
    "rods",
    (
        "Massless rigid rods: the distance of two points is constant. force is positive in tension.",
        "Невесомые жёсткие стержни: расстояние между двумя точками постоянно. force положительна при растяжении.",
    ),
    &[TWO_POINTS, LENGTH, LABEL],
    "[rods.AB]\nbetween = [\"A\", \"B\"]\nlength = \"l\"\n",
);

fn read<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>, space: &Space) -> Option<Made> {
    let (between, length) = (two_points(reader, fields, space), length(reader, fields));
    Some(Made::of(ConnectionKind::Rod { between: between?, length: length? }).forces(&[Part::Force]))
}

fn components(scene: &mut Scene, kinematics: &mut Kinematics, resolver: &mut Resolver, connection: &Connection) -> Found<Vec<Component>> {
    let ConnectionKind::Rod { between, length } = &connection.kind else {
        return Err(faults::of_another_kind(connection));
    };
    let length = length_of(scene, kinematics, resolver, *length)?;
    Ok(vec![rod(scene, kinematics, resolver, (connection, *between, length))?])
}

/// |r_B - r_A| - length.
fn rod(
    scene: &mut Scene,
    kinematics: &mut Kinematics,
    resolver: &mut Resolver,
    (connection, [a, b], length): (&Connection, [PointRef; 2], Option<Expr>),
) -> Found<Component> {
    let path = path(scene, kinematics, resolver, connection, Pathway::Distance(a, b))?;
    let length = length.unwrap_or_else(|| at_start(scene, &connection.name, path.value));
    let place = scene.graph.sub(path.value, length);
    let minus = scene.graph.int(-1);
    // tension pulls the ends together
    let acts = path.acts.iter().map(|act| act.times(scene, minus)).collect();
    let name = &connection.name;
    let label = Text::new(format!("rod {name}, tension"), format!("стержень {name}, усилие (растяжение +)"));
    Ok(Component { place: Some(place), negative: true, ..Component::ideal((Part::Force, "S", "N"), label, acts) })
}
