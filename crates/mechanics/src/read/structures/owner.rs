//! Whose a row of a table is that structures share with connections of bodies.

use crate::fields;
use crate::reader::{Fields, Reader};

/// Whose a row of a shared table is.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(in crate::read) enum Owner {
    /// Nodes and their rods.
    Structure,
    /// Connections of bodies.
    Bodies,
}

/// The rows of one owner in a table that structures share with connections of bodies.
pub(in crate::read) fn rows<'a>(
    reader: &mut Reader<'a>,
    top: &Fields<'a>,
    key: &'static str,
    spec: &'static fields::TableSpec,
    of: Owner,
) -> Vec<(String, Fields<'a>)> {
    top.entries_if(reader, key, spec, &|reader, table| owner(reader, key, table) == of)
}

fn owner(reader: &Reader, key: &str, table: &crate::reader::syntax::Table) -> Owner {
    if owns(reader, key, table) { Owner::Structure } else { Owner::Bodies }
}

/// Whether a row of a shared table is about nodes and their rods.
fn owns(reader: &Reader, key: &str, table: &crate::reader::syntax::Table) -> bool {
    let draft = &reader.structure;
    if draft.nodes.is_empty() {
        return false;
    }
    let text = |key: &str| table.get(key).and_then(|v| v.get_ref().as_str()).unwrap_or_default();
    let is_place = |name: &str| reader.scope.place(name).is_some();
    match key {
        "rods" => match table.get("between").and_then(|v| v.get_ref().as_array()) {
            Some(ends) => !ends.iter().all(|e| e.get_ref().as_str().is_some_and(is_place)),
            None => true,
        },
        "supports" => draft.node_index.contains_key(text("at")) || !is_place(text("at")),
        "distributed" => table.contains_key("on") && !table.contains_key("from"),
        _ => false,
    }
}
