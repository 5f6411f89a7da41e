//! `kind = "equations"`: the page shows the equations of motion; nothing is computed.

use super::{Finds, Found, Repeats, Study};
use crate::machine::Machine;
use crate::watch::Watch;
use mechanics::asked::{Asked, Kind, Words};

/// The study.
pub struct Equations;

/// Its name and its keys.
pub static KIND: Kind = Kind::new("equations", ("Derive the equations of motion", "Вывести уравнения движения"));

impl Study for Equations {
    fn kind(&self) -> &'static Kind {
        &KIND
    }
    fn wanted(&self) -> Words {
        ("derive the equations of motion", "составить уравнения движения")
    }
    fn chapter(&self) -> &'static str {
        "equations"
    }
    fn finds(&self) -> Finds {
        Finds::Formulas
    }
    fn run(&self, _: &mut Machine, _: &Asked, _: &mut Watch) -> Found {
        None
    }
    fn has_command(&self) -> bool {
        false
    }
    fn repeats(&self) -> Repeats {
        Repeats::Never
    }
}
