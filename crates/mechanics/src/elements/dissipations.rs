//! Free-form Rayleigh functions: there is no geometry to find their forces in another way, but for what names points and bodies.

use super::row::{Made, Row, Stands};
use crate::formula::Context;
use crate::keys::{LABEL, TableSpec, Type, must};
use crate::model::{Found, Law, Site, Sketch, Stage, Straight};
use crate::reader::{Fields, Reader};
use crate::units::Dimension;
use symbolic::Expr;

/// `[dissipations]`.
pub(super) const ROW: Row = Row {
    keys: &KEYS,
    listed: ("free-form Rayleigh functions", "диссипативные функции общего вида"),
    chapter: "elements",
    stands: Stands::Anywhere,
    functions: &[],
    explanations: &[],
    read,
};

/// `[dissipations.NAME]`.
const KEYS: TableSpec = TableSpec {
    name: "dissipations",
    about: (
        "Rayleigh's dissipation function of any form; its force on q is -dF/dq'.",
        "Диссипативная функция Рэлея произвольного вида; сила по q равна -dF/dq'.",
    ),
    short: None,
    fields: &[
        must("function", Type::Formula, "W", ("function over coordinates and rates", "функция координат и скоростей"), "\"b*x'^2/2\""),
        LABEL,
    ],
    example: "[dissipations.oil]\nfunction = \"b*x'^2/2\"\n",
};

/// A free-form Rayleigh dissipation function; its force on q is -∂Φ/∂q'.
#[derive(Clone, Debug)]
pub struct Dissipation {
    /// Function over coordinates, rates, time and requests.
    pub function: Expr,
}

fn read<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>) -> Option<Made> {
    let function = fields.formula_or_zero(reader, "function", &Context::FORCE, Some(&Dimension::POWER)).expr;
    Some(Made::silent(Dissipation { function }))
}

impl Law for Dissipation {
    fn act(&self, stage: &mut dyn Stage) -> Found<Vec<Expr>> {
        stage.dissipate_by_rates(self.function)?;
        Ok(Vec::new())
    }

    fn sketch(&self) -> Sketch {
        Sketch::new(Site::Dissipation, self.function)
    }

    fn straight(&self) -> Straight {
        Straight { switches: false, formulas: vec![self.function], degree: 2 }
    }
}
