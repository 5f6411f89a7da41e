//! Applied forces: virtual power F·v of a vector at a point, or of a force along a pathway.

use super::common::{pathway_of, per};
use super::row::{Made, Row, Stands};
use crate::formula::{Context, Place};
use crate::keys::{ALONG, BETWEEN, DISTANCE, LABEL, TableSpec, Type, may, must};
use crate::model::{Found, FrameId, Law, Pathway, PointRef, Push, Site, Sketch, Stage, Straight};
use crate::reader::names::frame_named;
use crate::reader::{Fields, Reader, components};
use crate::units::Dimension;
use std::sync::Arc;
use symbolic::Expr;
use words::Notice;

/// `[forces]`.
pub(super) const ROW: Row = Row {
    keys: &KEYS,
    listed: ("applied forces", "приложенные силы"),
    chapter: "elements",
    stands: Stands::Anywhere,
    functions: &[],
    explanations: &[],
    read,
};

/// `[forces.NAME]`.
const KEYS: TableSpec = TableSpec {
    name: "forces",
    about: (
        "Applied forces: a vector at a point (or at the mass centre of a body), or a force along a pathway, positive when it makes the pathway longer.",
        "Приложенные силы: вектор в точке (или в центре масс тела) либо сила вдоль координаты, положительная, если увеличивает её.",
    ),
    short: None,
    fields: &[
        may(
            "at",
            Type::Name,
            "",
            "",
            ("point, body for its mass centre, node or rod", "точка, тело (тогда центр масс), узел или стержень"),
            "\"A\"",
        ),
        DISTANCE,
        ALONG,
        BETWEEN,
        must(
            "value",
            Type::FormulaOrVector,
            "N",
            ("components with `at`, one formula with a pathway", "компоненты при `at`, одна формула при координате"),
            "[\"F0*sin(Omega*t)\", \"0\"]",
        ),
        may("axes", Type::Name, "", "\"ground\"", ("axes of the components", "оси компонент"), "\"blade\""),
        LABEL,
    ],
    example: "[forces.drag]\nat = \"A\"\nvalue = [\"-c*vx(A)\", \"-c*vy(A)\"]\n",
};

/// An applied force.
#[derive(Clone, Debug)]
pub enum Force {
    /// A vector at a point.
    AtPoint {
        /// Where.
        at: PointRef,
        /// Components.
        value: [Expr; 3],
        /// Axes of the components.
        axes: FrameId,
    },
    /// Along a pathway; positive increases the pathway.
    OnPathway {
        /// Pathway.
        pathway: Pathway,
        /// Force, or torque when the pathway is an angle.
        value: Expr,
    },
}

fn read<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>) -> Option<Made> {
    Some(Made::silent(force(reader, fields)?))
}

fn force<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>) -> Option<Force> {
    let on_path = fields.has("along") || fields.has("between");
    if fields.has("at") == on_path {
        reader.fault(
            Notice::piece(
                "M062",
                fields.span.clone(),
                format!("{} needs either `at` or a pathway", fields.path),
                format!("в {} нужно либо `at`, либо координата", fields.path),
            )
            .help(
                "at = \"A\" with value = [\"Fx\", \"Fy\"]; or along = \"x\" (or between) with value = \"F\"",
                "at = \"A\" и value = [\"Fx\", \"Fy\"]; либо along = \"x\" (или between) и value = \"F\"",
            ),
        );
        return None;
    }
    if on_path {
        let (pathway, length) = pathway_of(reader, fields)?;
        let value = fields.formula_or_zero(reader, "value", &Context::FORCE, per(length, 1, 0).as_ref()).expr;
        return Some(Force::OnPathway { pathway, value });
    }
    let (name, span) = fields.name(reader, "at")?;
    let at = match reader.scope.place(&name) {
        Some(Place::Point(p)) => PointRef::Point(p),
        Some(Place::Frame(f)) => PointRef::Center(f),
        None => {
            let fault = reader.scope.unknown_place(&name, span);
            reader.fault(fault);
            return None;
        }
    };
    let value = components(reader, fields.get("value")?, &Context::FORCE, &Dimension::FORCE);
    let axes = frame_named(reader, fields, "axes");
    Some(Force::AtPoint { at, value, axes })
}

impl Law for Force {
    fn act(&self, stage: &mut dyn Stage) -> Found<Vec<Expr>> {
        match self {
            Force::AtPoint { at, value, axes } => {
                let value = stage.open_vector(*value)?;
                let force = stage.in_ground_axes(*axes, value);
                stage.pull(*at, force);
            }
            Force::OnPathway { pathway, value } => {
                let way = stage.way(*pathway)?;
                let force = stage.open(*value)?;
                stage.push(Push { way, force });
            }
        }
        Ok(Vec::new())
    }

    fn couples(&self) -> bool {
        false
    }

    fn sketch(&self) -> Sketch {
        match self {
            Force::AtPoint { at, value, axes } => {
                let letter = value.iter().copied().find(|e| *e != value[2]).unwrap_or(value[0]);
                Sketch::new(Site::At { at: *at, value: *value, axes: *axes }, letter)
            }
            Force::OnPathway { pathway, value } => Sketch::new(Site::On(*pathway), *value),
        }
    }

    fn straight(&self) -> Straight {
        let formulas = match self {
            Force::AtPoint { value, .. } => value.to_vec(),
            Force::OnPathway { value, .. } => vec![*value],
        };
        Straight { switches: false, formulas, degree: 1 }
    }

    fn leaves_plane(&self) -> Vec<Expr> {
        match self {
            Force::AtPoint { value, .. } => vec![value[2]],
            Force::OnPathway { .. } => Vec::new(),
        }
    }

    fn over(&self, change: &mut dyn FnMut(Expr) -> Expr) -> Option<Arc<dyn Law>> {
        Some(Arc::new(match self {
            Force::AtPoint { at, value, axes } => Force::AtPoint { at: *at, value: value.map(change), axes: *axes },
            Force::OnPathway { pathway, value } => Force::OnPathway { pathway: *pathway, value: change(*value) },
        }))
    }
}
