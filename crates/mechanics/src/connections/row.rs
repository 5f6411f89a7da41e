//! A row of the table of connections.

use super::common::component::Component;
use super::common::made::Made;
use super::common::reading::Space;
use crate::keys::{Field, TableSpec, Type, Words, may};
use crate::model::Connection;
use crate::reader::{Fields, Reader};
use crate::scene::kinematics::Kinematics;
use crate::scene::requests::Resolver;
use crate::scene::{Found, Scene};

/// A kind of connection.
#[derive(Clone, Copy)]
pub struct Row {
    /// Its table of the file.
    pub keys: &'static TableSpec,
    /// What the table holds, in the list of tables.
    pub listed: Words,
    /// Its chapter of the verification book.
    pub chapter: &'static str,
    /// Tables within its rows, which the reference shows behind it.
    pub within: &'static [&'static TableSpec],
    /// Reads a row of the table.
    pub(super) read: for<'a> fn(&mut Reader<'a>, &Fields<'a>, &Space) -> Option<Made>,
    /// Its conditions, each with its reaction.
    pub(super) components: fn(&mut Scene, &mut Kinematics, &mut Resolver, &Connection) -> Found<Vec<Component>>,
}

impl Row {
    /// Key of its table on the top level.
    pub const fn top(&self) -> Field {
        may(self.keys.name, Type::Table, "", "", self.listed, "")
    }
}
