//! Studies of frames and trusses: from a model with nodes to datasets, fields of JSON and blocks of the written calculation.

pub mod bind;
pub mod equation;
pub mod modes;

use mechanics::Model;
use mechanics::structure::Structure;

/// The structure of a model.
pub fn of(model: &Model) -> Option<&Structure> {
    model.structure.as_ref()
}
