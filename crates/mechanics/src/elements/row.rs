//! What a row of the table of elements holds, and what is read by it.

use crate::formula::{KinematicFunction, Told};
use crate::keys::{Field, TableSpec, Type, Words, may};
use crate::model::Law;
use crate::reader::{Fields, Reader};
use std::sync::Arc;
use words::explain::Explanation;

/// A kind of element.
#[derive(Clone, Copy)]
pub struct Row {
    /// Its table of the file.
    pub keys: &'static TableSpec,
    /// What the table holds, in the list of tables.
    pub listed: Words,
    /// Its chapter of the verification book.
    pub chapter: &'static str,
    /// What one stands for in space.
    pub stands: Stands,
    /// Functions of formulas that only it has.
    pub functions: &'static [KinematicFunction],
    /// Codes of findings that only it has.
    pub explanations: &'static [Explanation],
    /// Reads a row of the table.
    pub(super) read: for<'a> fn(&mut Reader<'a>, &Fields<'a>) -> Option<Made>,
}

/// What an element stands for in space.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stands {
    /// Something straight between two bodies: axes that lie apart are doubtful.
    Between,
    /// Nothing of that sort.
    Anywhere,
}

/// What was read.
pub(crate) struct Made {
    pub(super) law: Arc<dyn Law>,
    pub(super) told: Vec<Told>,
}

impl Made {
    /// An element that no formula asks for.
    pub(super) fn silent(law: impl Law + 'static) -> Made {
        Made { law: Arc::new(law), told: Vec::new() }
    }
}

impl Row {
    /// Key of its table on the top level.
    pub const fn top(&self) -> Field {
        may(self.keys.name, Type::Table, "", "", self.listed, "")
    }
}
