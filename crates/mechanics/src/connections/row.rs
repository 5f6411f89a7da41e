//! A row of the table of connections, and what its reader makes.

use super::common::component::Component;
use super::common::reading::Space;
use crate::formula::Kind;
use crate::keys::{Field, TableSpec, Type, Words, may};
use crate::model::{Connection, ConnectionKind, Part};
use crate::reader::{Fields, Reader};
use crate::scene::kinematics::Kinematics;
use crate::scene::requests::Resolver;
use crate::scene::{Found, Scene};
use crate::units::Dimension;

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

/// What was read.
pub(crate) struct Made {
    /// What it does.
    pub kind: ConnectionKind,
    /// The components of its reaction that formulas may name.
    pub parts: Vec<(Part, Kind)>,
    /// Dimension of `force`.
    pub force: Kind,
}

impl Made {
    /// A connection whose reaction is a force in newtons, without components so far.
    pub fn of(kind: ConnectionKind) -> Made {
        Made { kind, parts: Vec::new(), force: Kind::Known(Dimension::FORCE) }
    }

    /// One whose only reaction acts along a formula.
    pub fn along(kind: ConnectionKind, force: Kind) -> Made {
        Made { kind, parts: vec![(Part::Force, force)], force }
    }

    /// With these forces.
    pub fn forces(mut self, parts: &[Part]) -> Made {
        self.parts.extend(parts.iter().map(|part| (*part, Kind::Known(Dimension::FORCE))));
        self
    }

    /// With these moments.
    pub fn moments(mut self, parts: &[Part]) -> Made {
        self.parts.extend(parts.iter().map(|part| (*part, Kind::Known(Dimension::ENERGY))));
        self
    }
}
