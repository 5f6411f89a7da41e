//! Pathways: one scalar through which an element acts, its rate, and its derivatives in all directions.
//!
//! Each is found twice, independently: by differentiation of the scalar (Lagrange) and by geometry from velocities of points and
//! bodies (Newton-Euler).

use super::kinematics::Kinematics;
use super::requests::Resolver;
use super::wrench::{Act, Along, Formula, generalized};
use super::{Columns, Found, Scene};
use crate::model::{Axis, FrameId, Measure, Pathway, PointRef, RequestKind};
use std::ops::Range;
use symbolic::Expr;
use words::{Notice, Text};

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
    (name, pathway, span): (&str, Pathway, &Range<usize>),
) -> Found<Path> {
    match pathway {
        Pathway::Along(e, measure) => {
            let value = resolver.resolve(scene, kinematics, e)?;
            scene.must_exist(value);
            let gradient = scene.gradient(value);
            let acts = located(scene, kinematics, resolver, (name, e), Given::Pathway(measure))?;
            let geometric = generalized(scene, kinematics, &acts);
            Ok(Path { value, acts, geometric, gradient })
        }
        Pathway::Distance(a, b) => Ok(distance(scene, kinematics, a, b)),
        Pathway::RelativeAngle(a, b) => relative_angle(scene, kinematics, (a, b), span),
    }
}

/// What a formula is taken by to find the force that belongs to it.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Given {
    /// The formula is a pathway.
    Pathway(Measure),
    /// A potential: by places and angles.
    Places,
    /// A dissipation function: by rates.
    Rates,
}

/// What a unit force by a formula does: `x(P)`, `angle(B)` in it (`vx(P)`, `omega(B)` for rates) are forces at P and moments on B, by ∂e/∂x(P);
/// what coordinates do beside them stays a generalized force.
pub fn located(
    scene: &mut Scene,
    kinematics: &mut Kinematics,
    resolver: &mut Resolver,
    (name, e): (&str, Expr),
    given: Given,
) -> Found<Vec<Act>> {
    let opened = scene.open(e);
    let model = scene.model;
    let symbols = scene.graph.symbols_in(&[opened]);
    let requests: Vec<_> = model.requests.iter().filter(|r| symbols.binary_search(&r.symbol).is_ok()).collect();
    let of_body = |kind: &RequestKind| match given {
        Given::Rates => matches!(kind, RequestKind::Velocity(..) | RequestKind::AngularVelocity(_)),
        _ => matches!(kind, RequestKind::Position(..) | RequestKind::Angle(_)),
    };
    let mut acts = Vec::new();
    let all = requests.iter().all(|r| of_body(&r.kind));
    for request in requests.iter().filter(|_| all) {
        let factor = scene.graph.derivative(opened, request.symbol);
        let factor = resolver.resolve(scene, kinematics, factor)?;
        let mut vector = |axis: Axis| unit_vector(scene, axis).map(|u| scene.graph.mul(factor, u));
        acts.push(match request.kind {
            RequestKind::Position(point, axis) | RequestKind::Velocity(point, axis) => Act::Point { point, force: vector(axis) },
            RequestKind::Angle(on) | RequestKind::AngularVelocity(on) => Act::Turn { on, moment: vector(Axis::Z) },
            _ => continue,
        });
    }
    let rest = if all { opened } else { resolver.resolve(scene, kinematics, e)? };
    let mut columns = Columns::new();
    for j in 0..=scene.n() {
        let d = match given {
            Given::Rates if j == scene.n() => continue,
            Given::Rates => scene.by_rate(rest, j),
            _ => scene.along(rest, j),
        };
        let d = resolver.resolve(scene, kinematics, d)?;
        if !scene.graph.is_zero(d) {
            columns.insert(j, d);
        }
    }
    if given == Given::Places {
        columns.remove(&scene.n());
    }
    if !columns.is_empty() {
        let of = match given {
            Given::Pathway(measure) => Formula::Pathway(columns.clone(), measure),
            _ => Formula::Function,
        };
        acts.push(Act::Along(Along { name: name.to_owned(), columns, of }));
    }
    Ok(acts)
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

/// Angle of b minus angle of a: in the plane, or about the one axis about which one turns that stands on the other.
pub fn relative_angle(scene: &mut Scene, kinematics: &mut Kinematics, (a, b): (FrameId, FrameId), span: &Range<usize>) -> Found<Path> {
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
    let still = [a, b].map(|f| kinematics.frames[f.index()].turning.is_empty());
    // the frame that turns, what it turns against, whether that is to be tried, the sign of the angle
    let ways = [(b, a, true, 1), (a, b, true, -1), (b, FrameId::GROUND, still[0], 1), (a, FrameId::GROUND, still[1], -1)];
    let found = ways.into_iter().filter(|way| way.2).find_map(|(child, parent, _, sign)| Some((turn_between(scene, child, parent)?, sign)));
    let Some((Turning { frame, axis, angle }, sign)) = found else {
        let [a, b] = [a, b].map(|f| &scene.model.frames[f.index()].name);
        return Err(Box::new(no_common_axis(a, b, span)));
    };
    let sign = scene.graph.int(sign);
    let value = scene.graph.mul(sign, angle);
    let gradient = scene.gradient(value);
    // the axis stands still in the frame that turns; the moment that grows the value turns b forwards and a backwards
    let along = unit_vector(scene, axis);
    let along = kinematics.in_ground_axes(scene, frame, &along).map(|e| scene.graph.mul(sign, e));
    let against = along.map(|e| scene.graph.neg(e));
    let acts = vec![Act::Turn { on: b, moment: along }, Act::Turn { on: a, moment: against }];
    Ok(Path { value, geometric: gradient.clone(), gradient, acts })
}

/// A turn of a frame against another about one axis.
struct Turning {
    /// The frame in whose axes the axis stands still.
    frame: FrameId,
    axis: Axis,
    angle: Expr,
}

/// The turn of a frame against one on which it stands, when all that varies between them turns about one axis; a constant rotation counts for nothing.
fn turn_between(scene: &mut Scene, child: FrameId, parent: FrameId) -> Option<Turning> {
    let model = scene.model;
    let (mut found, mut left): (Option<Turning>, bool) = (None, false);
    let mut here = child;
    while here != parent {
        if here == FrameId::GROUND {
            return None;
        }
        let frame = &model.frames[here.index()];
        let spin = frame.spin.and_then(|(axis, _)| scene.turns.iter().find(|t| t.frame == here.index()).map(|t| (axis, t.symbol)));
        let spin = spin.map(|(axis, symbol)| (axis, scene.graph.symbol(symbol)));
        let rotations: Vec<(Axis, Expr)> = frame.rotations.iter().copied().chain(spin).collect();
        for (k, (axis, angle)) in rotations.iter().enumerate().rev() {
            let angle = scene.open(*angle);
            let varies = !scene.gradient(angle).is_empty();
            match &mut found {
                Some(turning) if turning.axis == *axis && !left => turning.angle = scene.graph.add(turning.angle, angle),
                Some(_) if varies => return None,
                Some(_) => left = true,
                None if varies && rotations[k..].iter().all(|(other, _)| other == axis) => {
                    found = Some(Turning { frame: here, axis: *axis, angle });
                }
                None if varies => return None,
                None => {}
            }
        }
        here = frame.on;
    }
    found
}

/// A unit vector.
pub fn unit_vector(scene: &mut Scene, axis: Axis) -> [Expr; 3] {
    let (zero, one) = (scene.graph.zero(), scene.graph.one());
    let mut v = [zero; 3];
    v[axis.index()] = one;
    v
}

fn no_common_axis(a: &str, b: &str, span: &Range<usize>) -> Notice {
    Notice::file(
        "M102",
        span.clone(),
        Text::new(format!("no single angle between `{a}` and `{b}`"), format!("между `{a}` и `{b}` нет единственного угла")),
    )
    .why(
        "in space two bodies have a relative angle only when one stands on the other and turns about one axis",
        "в пространстве относительный угол определён, только если одно тело стоит на другом и поворачивается вокруг одной оси",
    )
    .help(
        "write the pathway as a formula, along = \"...\", or put the element between parent and child",
        "задайте координату элемента формулой, along = \"...\", или поставьте элемент между несущим телом и телом на нём",
    )
}
