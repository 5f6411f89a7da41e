//! `kind = "equations"`: the page shows the equations of motion; nothing is computed.

use super::{Found, Study};
use crate::machine::Machine;
use crate::watch::Watch;
use mechanics::asked::{Asked, Kind};

/// The study.
pub struct Equations;

static KIND: Kind = Kind::new("equations", ("Derive the equations of motion", "Вывести уравнения движения"));

impl Study for Equations {
    fn kind(&self) -> &'static Kind {
        &KIND
    }
    fn run(&self, _: &mut Machine, _: &Asked, _: &mut Watch) -> Found {
        None
    }
    fn has_command(&self) -> bool {
        false
    }
}
