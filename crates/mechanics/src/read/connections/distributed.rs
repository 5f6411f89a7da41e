//! `[distributed]`: a load along a straight line between two points of a body, as equivalent forces.
//!
//! q(s) = q_A + (q_B - q_A) s/L is a falling and a rising triangle: q_A L/2 at L/3 from A and q_B L/2 at L/3 from B, exactly, whatever
//! the directions of q_A and q_B. A uniform load is q L at the middle.

use crate::connections::{Space, frame, point};
use crate::elements::{FORCES, Force, element};
use crate::fields::DISTRIBUTED;
use crate::formula::Context;
use crate::model::{Element, FrameId, Point, PointId, PointRef};
use crate::read::structures::{self, Owner};
use crate::reader::{Fields, Reader, components};
use crate::units::Dimension;
use std::ops::Range;
use symbolic::{Expr, Rational};
use words::Notice;

/// Force per length.
const PER_LENGTH: Dimension = Dimension::of(0, 1, -2);

/// The equivalent forces, and the points where they act, numbered after `known` points.
pub(in crate::read) fn distributed<'a>(
    reader: &mut Reader<'a>,
    top: &Fields<'a>,
    space: &Space,
    known: usize,
) -> (Vec<Element>, Vec<Point>) {
    let mut found = (Vec::new(), Vec::new());
    for (name, fields) in structures::rows(reader, top, "distributed", &DISTRIBUTED, Owner::Bodies) {
        if !reader.name_is_fine(&name, fields.span.clone(), &["ground"]) {
            continue;
        }
        let Some(load) = load(reader, &fields, space) else { continue };
        let whole = format!("distributed.{name}");
        let label = fields.text(reader, "label").unwrap_or_default();
        for (part, (at, value)) in resultants(reader, &load).into_iter().enumerate() {
            let name = if load.end.is_none() { name.clone() } else { format!("{name}{}", part + 1) };
            let id = PointId(known + found.1.len());
            found.1.push(Point { name: name.clone(), on: load.on, at, span: fields.span.clone() });
            let force = Force::AtPoint { at: PointRef::Point(id), value, axes: load.axes };
            let part = element(FORCES, name, force, fields.span.clone());
            found.0.push(Element { path: whole.clone(), label: label.clone(), ..part });
        }
    }
    found
}

/// A line load; `end` is `None` when it is uniform.
struct Load {
    on: FrameId,
    from: [Expr; 3],
    to: [Expr; 3],
    begin: [Expr; 3],
    end: Option<[Expr; 3]>,
    axes: FrameId,
}

fn load<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>, space: &Space) -> Option<Load> {
    let (from, to) = (point(reader, fields, "from"), point(reader, fields, "to"));
    let on = fields.has("on").then(|| frame(reader, fields, "on"));
    let axes = frame(reader, fields, "axes");
    let mut vector = |key| fields.get(key).map(|v| components(reader, v, &Context::FORCE, &PER_LENGTH));
    let (begin, end) = (vector("value"), vector("value_end"));
    let (from, to, axes, begin) = (from?, to?, axes?, begin?);
    let ends = [from, to].map(|p| (space.carrier(reader, p), space.place_in(reader, p)));
    let [(first, (frame_a, a)), (second, (frame_b, b))] = ends;
    let span = fields.span_of("to");
    if first.is_none() || second.is_none() || frame_a != frame_b {
        reader.fault(two_bodies(span));
        return None;
    }
    if let Some(on) = on
        && on? != frame_a
    {
        reader.fault(two_bodies(fields.span_of("on")));
        return None;
    }
    if a == b {
        reader.fault(Notice::piece("M063", span, "both ends are at the same place", "оба конца в одной точке"));
        return None;
    }
    Some(Load { on: frame_a, from: a, to: b, begin, end, axes })
}

fn two_bodies(span: Range<usize>) -> Notice {
    Notice::piece("M087", span, "the load does not lie on one body", "нагрузка лежит не на одном теле")
        .why("it is replaced by forces at fixed points of one body", "она заменяется силами в закреплённых точках одного тела")
        .help(
            "take two points fixed on the same body, and split the load at joints",
            "возьмите две точки, закреплённые на одном теле, и разделите нагрузку у шарниров",
        )
}

/// Distance of the ends; along an axis without a root, so that formulas stay as one writes them.
fn length(reader: &mut Reader, load: &Load) -> Expr {
    let mut sides = Vec::new();
    for (a, b) in load.from.iter().zip(&load.to) {
        let side = reader.builder.graph.sub(*b, *a);
        if !reader.builder.graph.is_zero(side) {
            sides.push(side);
        }
    }
    if let &[side] = sides.as_slice()
        && let Some(number) = reader.number_of(side)
    {
        return if number < 0.0 { reader.builder.graph.neg(side) } else { side };
    }
    let graph = &mut reader.builder.graph;
    let squares: Vec<Expr> = sides.iter().map(|side| graph.square(*side)).collect();
    let square = graph.sum(&squares);
    graph.sqrt(square)
}

/// (place, force) of each resultant.
fn resultants(reader: &mut Reader, load: &Load) -> Vec<([Expr; 3], [Expr; 3])> {
    let length = length(reader, load);
    let graph = &mut reader.builder.graph;
    let mut resultant = |part: &Rational, share: &Rational, q: [Expr; 3]| {
        let mut at = load.from;
        for (slot, (a, b)) in at.iter_mut().zip(load.from.iter().zip(&load.to)) {
            let rest = &Rational::ONE - part;
            *slot = graph.linear(Rational::ZERO, &[(*a, rest), (*b, part.clone())]);
        }
        let value = q.map(|q| graph.monomial(share.clone(), &[(q, Rational::ONE), (length, Rational::ONE)]));
        (at, value)
    };
    let third = &Rational::ONE / &Rational::from(3);
    match load.end {
        None => vec![resultant(&Rational::HALF, &Rational::ONE, load.begin)],
        Some(end) => {
            let far = &third + &third;
            vec![resultant(&third, &Rational::HALF, load.begin), resultant(&far, &Rational::HALF, end)]
        }
    }
}
