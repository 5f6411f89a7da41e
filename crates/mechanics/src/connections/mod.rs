//! Connections: everything with a reaction. One kind, one file, one row of [`TABLE`]. The row gives its keys, from which the file is read and the reference is
//! written; its reading, with the components that its reaction has; and what it demands and gives, a list of `Component`s, from which both derivations follow.
//! Its data are a variant of [`ConnectionKind`](crate::model::ConnectionKind), because connections ask for each other: a friction for the path of its rope, a drum for
//! the pin on its axle.

mod belts;
mod chains;
pub(crate) mod common;
mod constraints;
pub(crate) mod frictions;
mod gears;
mod motions;
mod motors;
mod pins;
mod racks;
mod rods;
mod rolling;
mod ropes;
mod row;
mod sliders;
mod slots;
mod stops;
mod supports;
mod threads;
mod welds;

pub(crate) use common::component::{Component, Doubt, Nature, Pull, Rubbing};
pub(crate) use common::made::Made;
pub(crate) use common::reading::{Space, choose, frame, point};
pub(crate) use common::strands::{pretension, tensions, watched};
pub use row::Row;

use crate::model::Connection;
use crate::reader::{Fields, Reader};
use crate::scene::kinematics::Kinematics;
use crate::scene::requests::Resolver;
use crate::scene::{Found, Scene};

/// Every kind, in the order of the model and of the reference; frictions last, because their normal forces name other connections.
pub const TABLE: &[Row] = &[
    pins::ROW,
    welds::ROW,
    sliders::ROW,
    slots::ROW,
    rods::ROW,
    ropes::ROW,
    threads::ROW,
    belts::ROW,
    chains::ROW,
    gears::ROW,
    racks::ROW,
    rolling::ROW,
    constraints::ROW,
    supports::ROW,
    motions::ROW,
    motors::ROW,
    stops::ROW,
    frictions::ROW,
];

impl Row {
    /// A row of its table.
    pub(crate) fn read<'a>(&self, reader: &mut Reader<'a>, fields: &Fields<'a>, space: &Space) -> Option<Made> {
        (self.read)(reader, fields, space)
    }
}

/// What a connection demands and gives, component by component. Signs as in [`ConnectionKind`](crate::model::ConnectionKind).
pub(crate) fn components(
    scene: &mut Scene,
    kinematics: &mut Kinematics,
    resolver: &mut Resolver,
    connection: &Connection,
) -> Found<Vec<Component>> {
    match TABLE.iter().find(|row| row.keys.name == connection.table) {
        Some(row) => (row.components)(scene, kinematics, resolver, connection),
        None => Err(common::faults::of_another_kind(connection)),
    }
}
