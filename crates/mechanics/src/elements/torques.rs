//! Applied torques: virtual power M·ω, less that of the opposite torque on the body that takes it.

use super::row::{Made, Row, Stands};
use crate::formula::Context;
use crate::keys::{DISTANCE, LABEL, TableSpec, Type, may, must};
use crate::model::{Found, FrameId, Law, Site, Sketch, Stage, Straight};
use crate::reader::names::{frame_by_name, frame_named};
use crate::reader::{Fields, Reader, components};
use crate::units::Dimension;
use std::sync::Arc;
use symbolic::Expr;
use toml::de::DeValue;
use words::Notice;

/// `[torques]`.
pub(super) const ROW: Row = Row {
    keys: &KEYS,
    listed: ("applied torques", "приложенные моменты"),
    chapter: "elements",
    stands: Stands::Anywhere,
    functions: &[],
    explanations: &[],
    read,
};

/// `[torques.NAME]`.
const KEYS: TableSpec = TableSpec {
    name: "torques",
    about: ("Applied torques.", "Приложенные моменты."),
    short: None,
    fields: &[
        must("on", Type::Name, "", ("body, node or rod it acts on", "тело, узел или стержень, на который действует"), "\"crank\""),
        DISTANCE,
        must(
            "value",
            Type::FormulaOrVector,
            "N m",
            ("torque about z, or its components", "момент относительно оси z или его проекции"),
            "\"M0 - k*phi'\"",
        ),
        may("axes", Type::Name, "", "\"ground\"", ("axes of the components", "оси компонент"), "\"crank\""),
        may(
            "reaction",
            Type::Name,
            "",
            "",
            ("body on which minus the torque acts", "тело, на которое действует противоположный момент"),
            "\"frame\"",
        ),
        LABEL,
    ],
    example: "[torques.motor]\non = \"crank\"\nvalue = \"M0 - k*phi'\"\n",
};

/// An applied torque.
#[derive(Clone, Debug)]
pub struct Torque {
    /// Where it acts.
    pub on: FrameId,
    /// Components.
    pub value: [Expr; 3],
    /// Axes of the components.
    pub axes: FrameId,
    /// Where minus the torque acts.
    pub reaction: Option<FrameId>,
}

fn read<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>) -> Option<Made> {
    let on = frame_named(reader, fields, "on");
    let axes = frame_named(reader, fields, "axes");
    let reaction = fields.name(reader, "reaction").and_then(|(name, span)| frame_by_name(reader, &name, span));
    let value = value(reader, fields);
    if reaction == Some(on) && on != FrameId::GROUND {
        reader.fault(Notice::piece(
            "M063",
            fields.span_of("reaction"),
            "the torque and its reaction act on the same body",
            "момент и противоположный ему действуют на одно тело",
        ));
    }
    Some(Made::silent(Torque { on, value, axes, reaction }))
}

fn value<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>) -> [Expr; 3] {
    let zero = reader.builder.graph.zero();
    match fields.get("value").map(|v| (v, v.get_ref())) {
        Some((value, DeValue::Array(items))) if items.len() != 3 => {
            reader.fault(Notice::piece(
                "M008",
                value.span(),
                format!("a torque has 3 components or is one formula about z, {} given", items.len()),
                format!("у момента 3 компоненты либо одна формула вокруг z, дано: {}", items.len()),
            ));
            [zero; 3]
        }
        Some((value, DeValue::Array(_))) => components(reader, value, &Context::FORCE, &Dimension::ENERGY),
        _ => [zero, zero, fields.formula_or_zero(reader, "value", &Context::FORCE, Some(&Dimension::ENERGY)).expr],
    }
}

impl Law for Torque {
    fn act(&self, stage: &mut dyn Stage) -> Found<Vec<Expr>> {
        let value = stage.open_vector(self.value)?;
        let value = stage.in_ground_axes(self.axes, value);
        stage.turn(self.on, value);
        if let Some(body) = self.reaction {
            let opposite = value.map(|e| stage.graph().neg(e));
            stage.turn(body, opposite);
        }
        Ok(Vec::new())
    }

    fn couples(&self) -> bool {
        false
    }

    fn sketch(&self) -> Sketch {
        let site = Site::Turns { on: self.on, value: self.value, axes: self.axes, reaction: self.reaction };
        Sketch::new(site, self.value[2])
    }

    fn straight(&self) -> Straight {
        Straight { switches: false, formulas: self.value.to_vec(), degree: 1 }
    }

    fn leaves_plane(&self) -> Vec<Expr> {
        self.value[..2].to_vec()
    }

    fn over(&self, change: &mut dyn FnMut(Expr) -> Expr) -> Option<Arc<dyn Law>> {
        Some(Arc::new(Torque { value: self.value.map(change), ..self.clone() }))
    }
}
