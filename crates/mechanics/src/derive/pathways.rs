//! Pathways: one scalar through which an element acts, its rate, and its derivatives in all directions.
//!
//! Each is found twice, independently: by differentiation of the scalar (Lagrange) and by geometry from velocities of points and
//! bodies (Newton-Euler).

use super::kinematics::Kinematics;
use super::requests::Resolver;
use super::scene::{Columns, Found, Scene};
use super::wrench::{Act, generalized};
use crate::diagnostic::Diagnostic;
use crate::model::{Axis, FrameId, Pathway, PointRef};
use std::ops::Range;
use symbolic::{Expr, Text};

/// A pathway ready for use.
#[derive(Clone, Debug)]
pub struct Path {
    /// The scalar.
    pub value: Expr,
    /// Its derivatives in all directions, by differentiation.
    pub gradient: Columns<Expr>,
    /// The same from velocities.
    pub geometric: Columns<Expr>,
    /// What a unit force that increases it does to the bodies.
    pub acts: Vec<Act>,
}

/// Finds value and gradients of a pathway.
pub fn resolve(
    scene: &mut Scene,
    kinematics: &mut Kinematics,
    resolver: &mut Resolver,
    (pathway, span): (Pathway, &Range<usize>),
) -> Found<Path> {
    match pathway {
        Pathway::Along(e) => {
            let value = resolver.resolve(scene, kinematics, e)?;
            scene.must_exist(value);
            let gradient = scene.gradient(value);
            Ok(Path { value, acts: vec![Act::Along(gradient.clone())], geometric: gradient.clone(), gradient })
        }
        Pathway::Distance(a, b) => Ok(distance(scene, kinematics, a, b)),
        Pathway::RelativeAngle(a, b) => relative_angle(scene, kinematics, (a, b), span),
    }
}

/// d = |r_B - r_A|; geometric gradient e·(J_B - J_A) with the unit vector e from A to B.
fn distance(scene: &mut Scene, kinematics: &mut Kinematics, a: PointRef, b: PointRef) -> Path {
    let (ra, rb) = (kinematics.position(scene, a), kinematics.position(scene, b));
    let between = scene.minus(&rb, &ra);
    let square = scene.dot(&between, &between);
    let square = scene.tidy(square);
    let value = scene.graph.sqrt(square);
    let gradient = scene.gradient(value);
    let unit = between.map(|e| scene.graph.div(e, value));
    let opposite = unit.map(|e| scene.graph.neg(e));
    let acts = vec![Act::Point { point: b, force: unit }, Act::Point { point: a, force: opposite }];
    let geometric = generalized(scene, kinematics, &acts);
    Path { value, gradient, geometric, acts }
}

/// Angle of b minus angle of a: in the plane, or about the one axis of rotation between a parent and its child.
fn relative_angle(scene: &mut Scene, kinematics: &mut Kinematics, (a, b): (FrameId, FrameId), span: &Range<usize>) -> Found<Path> {
    let (fa, fb) = (&kinematics.frames[a.index()], &kinematics.frames[b.index()]);
    if let (Some(pa), Some(pb)) = (fa.plane_angle, fb.plane_angle) {
        let value = scene.graph.sub(pb, pa);
        let gradient = scene.gradient(value);
        let axis = unit_vector(scene, Axis::Z);
        let opposite = axis.map(|e| scene.graph.neg(e));
        let acts = vec![Act::Turn { on: b, moment: axis }, Act::Turn { on: a, moment: opposite }];
        let geometric = generalized(scene, kinematics, &acts);
        return Ok(Path { value, gradient, geometric, acts });
    }
    let model = scene.model;
    let single = |child: FrameId, parent: FrameId| {
        let frame = &model.frames[child.index()];
        (frame.on == parent && frame.rotations.len() + usize::from(frame.spin.is_some()) == 1).then_some(child)
    };
    let (child, negative) = match (single(b, a), single(a, b)) {
        (Some(child), _) => (child, false),
        (_, Some(child)) => (child, true),
        _ => return Err(Box::new(no_common_axis(&model.frames[a.index()].name, &model.frames[b.index()].name, span))),
    };
    let frame = &model.frames[child.index()];
    let angle = match frame.rotations.first() {
        Some((_, angle)) => scene.open(*angle),
        None => {
            let symbol = scene.turns.iter().find(|t| t.frame == child.index()).map_or(model.time, |t| t.symbol);
            scene.graph.symbol(symbol)
        }
    };
    let value = if negative { scene.graph.neg(angle) } else { angle };
    let gradient = scene.gradient(value);
    // the axis stands still in the child; the moment that grows the angle turns b forwards and a backwards
    let axis = match (frame.rotations.first(), frame.spin) {
        (Some((axis, _)), _) => *axis,
        (None, spin) => spin.map_or(Axis::Z, |(axis, _)| axis),
    };
    let along = unit_vector(scene, axis);
    let along = kinematics.in_ground_axes(scene, child, &along);
    let against = along.map(|e| scene.graph.neg(e));
    let acts = vec![Act::Turn { on: b, moment: along }, Act::Turn { on: a, moment: against }];
    Ok(Path { value, geometric: gradient.clone(), gradient, acts })
}

/// A unit vector.
pub fn unit_vector(scene: &mut Scene, axis: Axis) -> [Expr; 3] {
    let (zero, one) = (scene.graph.zero(), scene.graph.one());
    let mut v = [zero; 3];
    v[axis.index()] = one;
    v
}

fn no_common_axis(a: &str, b: &str, span: &Range<usize>) -> Diagnostic {
    Diagnostic::error(
        "M102",
        span.clone(),
        Text::new(format!("no single angle between `{a}` and `{b}`"), format!("между `{a}` и `{b}` нет единственного угла")),
    )
    .why(Text::new(
        "in space two bodies have a relative angle only when one stands on the other and turns about one axis",
        "в пространстве относительный угол определён, только если одно тело стоит на другом и поворачивается вокруг одной оси",
    ))
    .help(Text::new(
        "write the pathway as a formula, along = \"...\", or put the element between parent and child",
        "задайте координату элемента формулой, along = \"...\", или поставьте элемент между несущим телом и телом на нём",
    ))
}
