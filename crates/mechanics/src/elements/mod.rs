//! Elements that act by a law: one element, one file, one row of [`TABLE`]. The row gives its keys, from which the file is read and the reference is written,
//! its place in the list of tables, its chapter of the verification book, and the functions of formulas that only it has.

mod common;
mod dampers;
mod dissipations;
mod forces;
mod potentials;
mod row;
mod springs;
mod torques;
mod torsion_bars;

pub(crate) use common::pathway_of;
pub use forces::Force;
pub use potentials::Potential;
pub use row::{Row, Stands};

use crate::formula::KinematicFunction;
use crate::model::{Element, Law};
use crate::reader::{Fields, Reader};
use std::ops::Range;
use std::sync::Arc;
use words::Text;

/// Every kind, in the order in which elements are read and act, and in which the reference lists them.
pub const TABLE: &[Row] = &[springs::ROW, dampers::ROW, torsion_bars::ROW, forces::ROW, torques::ROW, potentials::ROW, dissipations::ROW];

/// The table of loads in points and on pathways, which other rooms of the file make, too.
pub const FORCES: &str = forces::ROW.keys.name;
/// The table of energies of any form.
pub const POTENTIALS: &str = potentials::ROW.keys.name;

/// An element of the kind of that table.
pub fn element(table: &'static str, name: String, law: impl Law + 'static, span: Range<usize>) -> Element {
    let rank = TABLE.iter().position(|row| row.keys.name == table).unwrap_or(TABLE.len());
    Element { path: format!("{table}.{name}"), name, table, rank, label: Text::default(), law: Arc::new(law), span }
}

/// All functions of formulas that only elements have.
pub fn functions() -> impl Iterator<Item = &'static KinematicFunction> {
    TABLE.iter().flat_map(|row| row.functions)
}

/// Reads all elements. What a table shares with other rooms of the file, `elsewhere` takes.
pub(crate) fn read<'a>(
    reader: &mut Reader<'a>,
    top: &Fields<'a>,
    elsewhere: &dyn Fn(&mut Reader<'a>, &str, &str, &Fields<'a>) -> bool,
) -> Vec<Element> {
    let mut found = Vec::new();
    for (rank, row) in TABLE.iter().enumerate() {
        let table = row.keys.name;
        for (name, fields) in top.entries(reader, table, row.keys) {
            if !reader.name_is_fine(&name, fields.span.clone(), &["ground"]) || elsewhere(reader, table, &name, &fields) {
                continue;
            }
            let Some(made) = (row.read)(reader, &fields) else { continue };
            if !made.told.is_empty() {
                reader.scope.declare_element((table, &name), found.len(), made.told);
            }
            let label = fields.text(reader, "label").unwrap_or_default();
            let (path, span) = (format!("{table}.{name}"), fields.span.clone());
            found.push(Element { path, name, table, rank, label, law: made.law, span });
        }
    }
    found
}
