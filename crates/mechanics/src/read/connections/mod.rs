//! Connections: everything with a reaction. One file for a few tables, one row in [`TABLES`] each.

mod common;
mod conditions;
mod contacts;
mod distributed;
mod joints;
mod kept;
mod rubbing;
mod ties;
mod tracks;
mod wheels;

pub(super) use common::Space;
pub(super) use contacts::impacts;
pub(super) use distributed::distributed;
pub(super) use kept::{Places, warn};

use super::structures::Owner;
use crate::fields::TableSpec;
use crate::fields::connections as specs;
use crate::formula::Kind;
use crate::model::{Connection, ConnectionKind, Part, Strands, SupportDirection};
use crate::reader::{Fields, Reader};
use crate::units::{Dimension, si_label};

/// A connection that was read, and the dimension of its `force` where the pathway decides it.
struct Found {
    kind: ConnectionKind,
    force: Kind,
}

impl From<ConnectionKind> for Found {
    fn from(kind: ConnectionKind) -> Found {
        Found { kind, force: Kind::Known(Dimension::FORCE) }
    }
}

struct Row {
    spec: &'static TableSpec,
    read: for<'a> fn(&mut Reader<'a>, &Fields<'a>, &Space) -> Option<Found>,
}

/// In the order of the model; frictions last, because their normal forces name other connections.
const TABLES: &[Row] = &[
    Row { spec: &specs::PIN, read: joints::pin },
    Row { spec: &specs::WELD, read: joints::weld },
    Row { spec: &specs::SLIDER, read: joints::slider },
    Row { spec: &specs::SLOT, read: joints::slot },
    Row { spec: &specs::ROD, read: ties::rod },
    Row { spec: &specs::ROPE, read: ties::rope },
    Row { spec: &specs::THREAD, read: ties::rope },
    Row { spec: &specs::BELT, read: wheels::belt },
    Row { spec: &specs::CHAIN, read: wheels::chain },
    Row { spec: &specs::GEAR, read: wheels::gear },
    Row { spec: &specs::RACK, read: tracks::rack },
    Row { spec: &specs::ROLLING, read: tracks::rolling },
    Row { spec: &specs::CONSTRAINT, read: conditions::constraint },
    Row { spec: &specs::SUPPORT, read: joints::support },
    Row { spec: &specs::MOTION, read: conditions::motion },
    Row { spec: &specs::MOTOR, read: conditions::motor },
    Row { spec: &specs::STOP, read: contacts::stop },
    Row { spec: &specs::FRICTION, read: contacts::friction },
];

/// Makes the names known, so that a reaction in the formula of a force is told from a misspelt spring.
pub(super) fn announce<'a>(reader: &mut Reader<'a>, top: &Fields<'a>) {
    for table in TABLES.iter().map(|row| row.spec.name) {
        names(top, table).for_each(|name| reader.scope.announce_connection(table, name));
    }
}

fn names<'a>(top: &Fields<'a>, table: &'static str) -> impl Iterator<Item = &'a str> {
    top.get(table).and_then(|v| v.get_ref().as_table()).into_iter().flatten().map(|(name, _)| name.get_ref().as_ref())
}

/// All connections; their reactions can be named in formulas from here on.
pub(super) fn read<'a>(reader: &mut Reader<'a>, top: &Fields<'a>, space: &Space) -> Vec<Connection> {
    let mut connections = Vec::new();
    for row in TABLES {
        let table = row.spec.name;
        let rows = super::structures::rows(reader, top, table, row.spec, Owner::Bodies);
        let others = names(top, table).filter(|name| rows.iter().all(|(own, _)| own != name));
        others.for_each(|name| reader.scope.withdraw(table, name));
        for (name, fields) in rows {
            if !reader.name_is_fine(&name, fields.span.clone(), &["ground"]) {
                continue;
            }
            let Some(found) = (row.read)(reader, &fields, space) else {
                continue;
            };
            reader.scope.declare_connection(table, &name, connections.len(), parts(&found));
            let unit = unit_of(found.force);
            connections.push(Connection { name, table, kind: found.kind, unit, span: fields.span.clone() });
        }
    }
    connections
}

/// The unit of a force.
fn unit_of(force: Kind) -> String {
    match force {
        Kind::Known(d) => si_label(&d),
        _ => String::new(),
    }
}

/// The components that a reaction has.
fn parts(found: &Found) -> Vec<(Part, Kind)> {
    let (force, moment) = (Kind::Known(Dimension::FORCE), Kind::Known(Dimension::ENERGY));
    let vector = [Part::Force, Part::ForceX, Part::ForceY, Part::ForceZ].map(|part| (part, force));
    match &found.kind {
        ConnectionKind::Pin { .. } => vector.to_vec(),
        ConnectionKind::Weld { .. } => {
            vector.into_iter().chain([Part::Moment, Part::MomentX, Part::MomentY].map(|part| (part, moment))).collect()
        }
        ConnectionKind::Slider { turns, .. } => {
            let forces = [Part::Force, Part::ForceY, Part::ForceZ].map(|part| (part, force));
            let moments = [Part::Moment, Part::MomentX, Part::MomentY].map(|part| (part, moment));
            forces.into_iter().chain(moments.into_iter().filter(|_| !turns)).collect()
        }
        ConnectionKind::Rolling { held: true, .. } => {
            vec![(Part::Force, force), (Part::Normal, force), (Part::Tangential, force)]
        }
        ConnectionKind::Rolling { held: false, .. } => vec![(Part::Force, force), (Part::Tangential, force)],
        ConnectionKind::Support { directions, .. } => support(directions),
        ConnectionKind::Motion { .. } => Vec::new(),
        ConnectionKind::Wheels { strands: Strands::Pretension(_) | Strands::Slack { .. }, .. } => {
            [Part::Force, Part::Tight, Part::Slack].map(|part| (part, force)).to_vec()
        }
        ConnectionKind::Rod { .. }
        | ConnectionKind::Rope { .. }
        | ConnectionKind::Wheels { .. }
        | ConnectionKind::Constraint { .. }
        | ConnectionKind::Motor { .. }
        | ConnectionKind::Stop { .. }
        | ConnectionKind::Friction { .. } => vec![(Part::Force, found.force)],
    }
}

/// The components of a support; `force` is the magnitude of its forces.
fn support(directions: &[SupportDirection]) -> Vec<(Part, Kind)> {
    use SupportDirection as D;
    let part = |d: &SupportDirection| match d {
        D::X => (Part::ForceX, Dimension::FORCE),
        D::Y => (Part::ForceY, Dimension::FORCE),
        D::Z => (Part::ForceZ, Dimension::FORCE),
        D::TurnX => (Part::MomentX, Dimension::ENERGY),
        D::TurnY => (Part::MomentY, Dimension::ENERGY),
        D::TurnZ => (Part::Moment, Dimension::ENERGY),
    };
    let single: Vec<(Part, Kind)> = directions.iter().map(part).map(|(part, d)| (part, Kind::Known(d))).collect();
    let pushes = directions.iter().any(|d| matches!(d, D::X | D::Y | D::Z));
    let total = pushes.then_some((Part::Force, Kind::Known(Dimension::FORCE)));
    total.into_iter().chain(single).collect()
}

#[cfg(test)]
mod tests;
