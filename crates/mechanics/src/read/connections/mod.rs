//! The tables of connections in the file, each row by its kind.

mod distributed;
mod kept;

pub(super) use distributed::distributed;
pub(super) use kept::{Places, warn};

use super::structures::Owner;
use crate::connections::frictions::springing_back;
use crate::connections::{Space, TABLE, choose};
use crate::formula::Kind;
use crate::model::Connection;
use crate::reader::{Fields, Reader};
use crate::units::si_label;
use symbolic::connections::Impacts;

/// Makes the names known, so that a reaction in the formula of a force is told from a misspelt spring.
pub(super) fn announce<'a>(reader: &mut Reader<'a>, top: &Fields<'a>) {
    for table in TABLE.iter().map(|row| row.keys.name) {
        names(top, table).for_each(|name| reader.scope.announce_connection(table, name));
    }
}

fn names<'a>(top: &Fields<'a>, table: &'static str) -> impl Iterator<Item = &'a str> {
    top.get(table).and_then(|v| v.get_ref().as_table()).into_iter().flatten().map(|(name, _)| name.get_ref().as_ref())
}

/// All connections; their reactions can be named in formulas from here on.
pub(super) fn read<'a>(reader: &mut Reader<'a>, top: &Fields<'a>, space: &Space) -> Vec<Connection> {
    let mut connections = Vec::new();
    for row in TABLE {
        let table = row.keys.name;
        let rows = super::structures::rows(reader, top, table, row.keys, Owner::Bodies);
        let others = names(top, table).filter(|name| rows.iter().all(|(own, _)| own != name));
        others.for_each(|name| reader.scope.withdraw(table, name));
        for (name, fields) in rows {
            if !reader.name_is_fine(&name, fields.span.clone(), &["ground"]) {
                continue;
            }
            let Some(found) = row.read(reader, &fields, space) else {
                continue;
            };
            reader.scope.declare_connection(table, &name, connections.len(), found.parts);
            let unit = unit_of(found.force);
            let label = fields.text(reader, "label").unwrap_or_default();
            connections.push(Connection { name, table, label, kind: found.kind, unit, span: fields.span.clone() });
        }
    }
    springing_back(reader, &connections);
    connections
}

/// The unit of a force.
fn unit_of(force: Kind) -> String {
    match force {
        Kind::Known(d) => si_label(&d),
        _ => String::new(),
    }
}

/// `impacts`, at the top of the file.
pub(super) fn impacts<'a>(reader: &mut Reader<'a>, top: &Fields<'a>) -> Impacts {
    let Some((text, span)) = top.get("impacts").and_then(|v| Some((v.get_ref().as_str()?, v.span()))) else { return Impacts::default() };
    match choose(reader, text, span, &["in sequence", "together"]) {
        Some(1) => Impacts::Together,
        _ => Impacts::InSequence,
    }
}

#[cfg(test)]
mod tests;
