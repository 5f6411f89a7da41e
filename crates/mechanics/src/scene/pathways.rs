//! Pathways: one scalar through which an element acts, its rate, and its derivatives in all directions.
//!
//! Each is found twice, independently: by differentiation of the scalar (Lagrange) and by geometry from velocities of points and
//! bodies (Newton-Euler).

use super::kinematics::Kinematics;
use super::requests::Resolver;
use super::turns::{RelativeTurn, relative_turn};
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

/// Angle of b minus angle of a: in the plane, or about the one axis about which they turn against each other ([`super::turns`]).
pub fn relative_angle(scene: &mut Scene, kinematics: &mut Kinematics, (a, b): (FrameId, FrameId), span: &Range<usize>) -> Found<Path> {
    let (fa, fb) = (&kinematics.frames[a.index()], &kinematics.frames[b.index()]);
    let (value, along) = if let (Some(pa), Some(pb)) = (fa.plane_angle, fb.plane_angle) {
        (scene.graph.sub(pb, pa), unit_vector(scene, Axis::Z))
    } else {
        let Some(RelativeTurn { frame, axis, value }) = relative_turn(scene, kinematics, (a, b)) else {
            let [a, b] = [a, b].map(|f| &scene.model.frames[f.index()].name);
            return Err(Box::new(no_common_axis(a, b, span)));
        };
        let axis = unit_vector(scene, axis);
        (value, kinematics.in_ground_axes(scene, frame, &axis))
    };
    let gradient = scene.gradient(value);
    // the moment that grows the value turns b forwards and a backwards, whichever of them carries the other
    let against = along.map(|e| scene.graph.neg(e));
    let acts = vec![Act::Turn { on: b, moment: along }, Act::Turn { on: a, moment: against }];
    let geometric = generalized(scene, kinematics, &acts);
    Ok(Path { value, gradient, geometric, acts })
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
        "in space two bodies have a relative angle only when they turn against each other about one axis: one stands on the other, or the rotations of both are the same up to that axis",
        "в пространстве относительный угол определён, только если тела поворачиваются относительно друг друга вокруг одной оси: одно стоит на другом или повороты обоих до этой оси одинаковы",
    )
    .help(
        "let one body stand on the other (`on`), give both the same rotations up to their common axis, or, where the element takes one, write a formula, along = \"...\"",
        "поставьте одно тело на другое (`on`), задайте обоим одинаковые повороты до общей оси или, если элемент это допускает, формулу along = \"...\"",
    )
}
