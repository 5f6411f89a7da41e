//! Free-form potential energies: there is no geometry to find their forces in another way, but for what names points and bodies.

use super::row::{Made, Row, Stands};
use crate::formula::Context;
use crate::keys::{LABEL, TableSpec, Type, must};
use crate::model::{Found, Law, Site, Sketch, Stage, Straight};
use crate::reader::{Fields, Reader};
use crate::units::Dimension;
use symbolic::Expr;

/// `[potentials]`.
pub(super) const ROW: Row = Row {
    keys: &KEYS,
    listed: ("free-form potential energies", "потенциальные энергии общего вида"),
    chapter: "elements",
    stands: Stands::Anywhere,
    functions: &[],
    explanations: &[],
    read,
};

/// `[potentials.NAME]`.
const KEYS: TableSpec = TableSpec {
    name: "potentials",
    about: ("Potential energy of any form.", "Потенциальная энергия произвольного вида."),
    short: None,
    fields: &[
        must(
            "energy",
            Type::Formula,
            "N m",
            ("energy over coordinates and time", "энергия как функция координат и времени"),
            "\"c*x^4/4\"",
        ),
        LABEL,
    ],
    example: "[potentials.hardening]\nenergy = \"c3*x^4/4\"\n",
};

/// A free-form potential energy.
#[derive(Clone, Debug)]
pub struct Potential {
    /// Energy over coordinates, time and position requests.
    pub energy: Expr,
}

fn read<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>) -> Option<Made> {
    let energy = fields.formula_or_zero(reader, "energy", &Context::PATHWAY, Some(&Dimension::ENERGY)).expr;
    Some(Made::silent(Potential { energy }))
}

impl Law for Potential {
    fn act(&self, stage: &mut dyn Stage) -> Found<Vec<Expr>> {
        stage.store_by_places(self.energy)?;
        Ok(Vec::new())
    }

    fn couples(&self) -> bool {
        false
    }

    fn sketch(&self) -> Sketch {
        Sketch::new(Site::Energy, self.energy)
    }

    fn straight(&self) -> Straight {
        Straight { switches: false, formulas: vec![self.energy], degree: 2 }
    }
}
