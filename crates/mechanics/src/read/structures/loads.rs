//! What acts on nodes and rods, and what is asked of them: forces, torques, loads along rods, displacements, assumed shapes.

use super::owner::{Owner, rows};
use super::quantities::{one_of, plane_vector, unknown_site};
use crate::fields;
use crate::formula::{Context, Depends, Entry, EntryKind, Kind};
use crate::read::plane;
use crate::reader::{Fields, Reader, components, string};
use crate::structure::{Action, AssumedShape, Direction, Displacement, Load, Site};
use crate::units::Dimension;
use symbolic::{Expr, Rational, SymbolId};
use toml::de::DeValue;
use words::{Notice, Text};

/// A node or rod named under a key.
fn site<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>, key: &'static str) -> Option<Site> {
    let (name, span) = fields.name(reader, key)?;
    if let Some(i) = reader.structure.node_index.get(&name) {
        return Some(Site::Node(*i));
    }
    let Some(&rod) = reader.structure.rod_index.get(&name) else {
        unknown_site(reader, &name, span);
        return None;
    };
    let distance = fields.formula_or_zero(reader, "distance", &Context::CONSTANT, Some(&Dimension::LENGTH));
    let length = reader.values.of(&reader.builder.graph, reader.structure.rods[rod].length);
    // the end of a rod is a place on it, its length being rounded
    if let Some(d) = reader.number(&distance).filter(|d| *d < 0.0 || *d > length * (1.0 + 1e-12)) {
        let fault = Notice::piece(
            "M204",
            fields.span_of("distance"),
            format!("{d} m is outside the rod {name}, whose length is {length} m"),
            format!("{d} м вне стержня {name} длиной {length} м"),
        );
        reader.fault(fault);
    }
    Some(Site::Rod(rod, distance.expr))
}

/// Whether a name under a key is a node or rod.
fn is_ours<'a>(reader: &Reader<'a>, fields: &Fields<'a>, key: &'static str) -> bool {
    let name = fields.get(key).and_then(|v| v.get_ref().as_str());
    name.is_some_and(|n| reader.structure.node_index.contains_key(n) || reader.structure.rod_index.contains_key(n))
}

/// Takes a row of a table of elements that acts on a node or rod.
pub(in crate::read) fn takes<'a>(reader: &mut Reader<'a>, table: &str, name: &str, fields: &Fields<'a>) -> bool {
    match table {
        "forces" => force(reader, name, fields),
        "torques" => torque(reader, name, fields),
        _ => false,
    }
}

/// Takes a row of `[forces]` that acts on a node or rod.
fn force<'a>(reader: &mut Reader<'a>, name: &str, fields: &Fields<'a>) -> bool {
    if !is_ours(reader, fields, "at") {
        return false;
    }
    if let (Some(site), Some(value)) = (site(reader, fields, "at"), fields.get("value")) {
        let parts = components(reader, value, &Context::TIME, &Dimension::FORCE);
        let [x, y] = plane::along(reader, value, parts);
        let zero = reader.builder.graph.zero();
        let label = fields.text(reader, "label").unwrap_or_default();
        let load = Load::of("forces", name, Action::Point { site, value: [x, y, zero] });
        reader.structure.loads.push(Load { label, ..load });
    }
    true
}

/// Takes a row of `[torques]` that acts on a node or rod.
fn torque<'a>(reader: &mut Reader<'a>, name: &str, fields: &Fields<'a>) -> bool {
    if !is_ours(reader, fields, "on") {
        return false;
    }
    if let Some(site) = site(reader, fields, "on") {
        let couple = match fields.get("value") {
            Some(value) if value.get_ref().as_array().is_some() => {
                let parts = components(reader, value, &Context::TIME, &Dimension::ENERGY);
                plane::about(reader, value, parts)
            }
            _ => fields.formula_or_zero(reader, "value", &Context::TIME, Some(&Dimension::ENERGY)).expr,
        };
        let zero = reader.builder.graph.zero();
        let label = fields.text(reader, "label").unwrap_or_default();
        let load = Load::of("torques", name, Action::Point { site, value: [zero, zero, couple] });
        reader.structure.loads.push(Load { label, ..load });
    }
    true
}

pub(super) fn distributed<'a>(reader: &mut Reader<'a>, top: &Fields<'a>) {
    let per_length = Dimension::of(0, 1, -2);
    for (name, fields) in rows(reader, top, "distributed", &fields::structures::LINE_LOAD, Owner::Structure) {
        let Some((rod, span)) = fields.name(reader, "on") else { continue };
        let Some(&rod) = reader.structure.rod_index.get(&rod) else {
            unknown_site(reader, &rod, span);
            continue;
        };
        let start = plane_vector(reader, &fields, "value", &Context::TIME, &per_length);
        let end = if fields.has("value_end") { plane_vector(reader, &fields, "value_end", &Context::TIME, &per_length) } else { start };
        reader.structure.loads.push(Load::of("distributed", &name, Action::Distributed { rod, value: [start, end] }));
    }
}

pub(super) fn displacements<'a>(reader: &mut Reader<'a>, top: &Fields<'a>) -> Vec<Displacement> {
    let mut found = Vec::new();
    for (name, fields) in top.entries(reader, "displacements", &fields::structures::DISPLACEMENT) {
        let label = fields.text(reader, "label").unwrap_or_else(Text::default);
        let direction = direction(reader, &fields);
        if let (Some(site), Some(direction)) = (site(reader, &fields, "at"), direction) {
            found.push(Displacement { name, label, site, direction, loaded: false });
        }
    }
    found
}

fn direction<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>) -> Option<Direction> {
    let (zero, one) = (reader.builder.graph.zero(), reader.builder.graph.one());
    match fields.get("direction").map(|v| (v, v.get_ref())) {
        None => Some(Direction::Along([zero, one])),
        Some((value, DeValue::Array(_))) => {
            let parts = components(reader, value, &Context::CONSTANT, &Dimension::NONE);
            let [x, y] = plane::along(reader, value, parts);
            Some(Direction::Along(unit(reader, x, y)))
        }
        Some((value, _)) => {
            let (word, span) = string(reader, value, "\"x\", \"y\", \"turn\" or a vector", "\"x\", \"y\", \"turn\" или вектор")?;
            one_of(reader, &word, span, &["x", "y", "turn"]).map(|k| match k {
                0 => Direction::Along([one, zero]),
                1 => Direction::Along([zero, one]),
                _ => Direction::Turn,
            })
        }
    }
}

pub(super) fn unit(reader: &mut Reader, x: Expr, y: Expr) -> [Expr; 2] {
    let graph = &mut reader.builder.graph;
    let (xx, yy) = (graph.square(x), graph.square(y));
    let sum = graph.add(xx, yy);
    let size = graph.pow(sum, &Rational::new(-1, 2).unwrap_or(Rational::ONE));
    [graph.mul(x, size), graph.mul(y, size)]
}

/// `[rayleigh]`: shapes over the distance s, which is a name in these formulas only: everything else is read already.
pub(super) fn rayleigh<'a>(reader: &mut Reader<'a>, top: &Fields<'a>) -> Vec<AssumedShape> {
    let rows = top.entries(reader, "rayleigh", &fields::structures::RAYLEIGH);
    if rows.is_empty() {
        return Vec::new();
    }
    let distance = reader.builder.graph.symbol_id("s", 0);
    if reader.claimed.contains_key("s") {
        let fault = Notice::piece(
            "M010",
            top.span_of("rayleigh"),
            "`s` is the distance along the rod in [rayleigh]",
            "`s` в [rayleigh] — расстояние вдоль стержня",
        )
        .help("rename the parameter `s`", "переименуйте величину `s`");
        reader.fault(fault);
        return Vec::new();
    }
    let entry = Entry { kind: EntryKind::Parameter(distance), dimension: Kind::Known(Dimension::LENGTH), depends: Depends::TIME };
    reader.scope.declare("s", entry);
    rows.into_iter().filter_map(|(name, fields)| assumed(reader, name, &fields, distance)).collect()
}

fn assumed<'a>(reader: &mut Reader<'a>, name: String, fields: &Fields<'a>, distance: SymbolId) -> Option<AssumedShape> {
    let label = fields.text(reader, "label").unwrap_or_default();
    let (rod, span) = fields.name(reader, "on")?;
    let Some(&rod) = reader.structure.rod_index.get(&rod) else {
        unknown_site(reader, &rod, span);
        return None;
    };
    let shape = fields.formula(reader, "shape", &Context::TIME, None)?;
    let at = match fields.formula(reader, "distance", &Context::CONSTANT, Some(&Dimension::LENGTH)) {
        Some(at) => at.expr,
        None => reader.structure.rods[rod].length,
    };
    let graph = &mut reader.builder.graph;
    let slope = graph.derivative(shape.expr, distance);
    let curvature = graph.derivative(slope, distance);
    shape.good.then_some(AssumedShape { name, label, rod, shape: shape.expr, slope, curvature, distance, at })
}
