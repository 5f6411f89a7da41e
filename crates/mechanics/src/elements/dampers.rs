//! Viscous dampers: Φ = b δ'²/2; the force b δ' against the growing pathway δ.

use super::common::{pathway_of, per, told, useful};
use super::row::{Made, Row, Stands};
use crate::formula::{Context, Kind};
use crate::keys::{ALONG, BETWEEN, LABEL, TableSpec, Type, must};
use crate::model::{Found, Law, Measure, Pathway, Push, Site, Sketch, Stage, Straight};
use crate::reader::{Fields, Reader};
use std::sync::Arc;
use symbolic::{Expr, Rational};

/// `[dampers]`.
pub(super) const ROW: Row = Row {
    keys: &KEYS,
    listed: ("dampers", "демпферы"),
    chapter: "elements",
    stands: Stands::Between,
    functions: &[],
    explanations: &[],
    read,
};

/// `[dampers.NAME]`.
const KEYS: TableSpec = TableSpec {
    name: "dampers",
    about: ("Viscous dampers: force = damping*rate of the pathway.", "Вязкие демпферы: усилие = damping*скорость координаты."),
    short: None,
    fields: &[
        ALONG,
        BETWEEN,
        must(
            "damping",
            Type::Formula,
            "N s/m",
            ("damping; N m s per radian for an angle", "коэффициент вязкого сопротивления; Н·м·с на радиан для угла"),
            "\"25 N s/m\"",
        ),
        LABEL,
    ],
    example: "[dampers.shaft]\nbetween = [\"rotor\", \"pendulum\"]\ndamping = \"k\"\n",
};

/// Damper: force = damping · rate of the pathway, against it.
#[derive(Clone, Debug)]
pub struct Damper {
    /// Pathway.
    pub pathway: Pathway,
    /// Damping.
    pub damping: Expr,
}

fn read<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>) -> Option<Made> {
    let path = pathway_of(reader, fields);
    let length = path.map_or(Kind::Unknown, |p| p.1);
    let unit = per(length, 2, 1);
    let damping = fields.formula_or_zero(reader, "damping", &Context::PATHWAY, unit.as_ref());
    useful(reader, fields, "damping", &damping, ("damper", "демпфер"));
    let pathway = path.map_or(Pathway::Along(damping.expr, Measure::Other), |p| p.0);
    let told = told(length);
    Some(Made { law: Arc::new(Damper { pathway, damping: damping.expr }), told })
}

impl Law for Damper {
    fn act(&self, stage: &mut dyn Stage) -> Found<Vec<Expr>> {
        let way = stage.way(self.pathway)?;
        let damping = stage.open(self.damping)?;
        let [rate, measured] = stage.rates(way);
        let graph = stage.graph();
        let square = graph.square(rate);
        let function = graph.monomial(Rational::HALF, &[(damping, Rational::ONE), (square, Rational::ONE)]);
        let force = graph.mul(damping, measured);
        let against = graph.neg(force);
        stage.dissipate(function, Push { way, force: against });
        Ok(vec![force, way.value])
    }

    fn sketch(&self) -> Sketch {
        Sketch::new(Site::On(self.pathway), self.damping)
    }

    fn straight(&self) -> Straight {
        Straight { switches: false, formulas: vec![self.damping], degree: 0 }
    }
}
