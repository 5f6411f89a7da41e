//! What the strands of a belt or chain pull along the line of the centres.
//!
//! ```text
//! sin β = (r_a ∓ r_b)/d            slope of the strands against the line, − of an open, + of a crossed belt; d the distance of the axes
//! T₁ − T₂ = F                      couples and forces F sin β across the line: `Line::acts` in `wheels.rs`
//! P = (T₁ + T₂) cos β              draws the axles together
//! ```
//!
//! F follows from the motion, the sum of the tensions from no law of the machine: it is twice the pretension of a belt (Poncelet: what one strand gains the other
//! loses), and ±F of a chain whose slack strand carries nothing. Where neither is given, P is an unknown that what holds an axle depends on.

use super::component::{Component, Pull};
use super::faults;
use super::pair::{Line, Pair, label, pair};
use crate::model::{Axis, Connection, ConnectionKind, Part, PointRef, Strands};
use crate::scene::kinematics::Kinematics;
use crate::scene::pathways::unit_vector;
use crate::scene::requests::Resolver;
use crate::scene::wrench::Act;
use crate::scene::{Columns, Found, Scene, Vector};
use symbolic::{Expr, Function, Rational};
use words::Text;

impl Pull {
    /// The force on the first wheel is `size` times the line of the centres.
    fn along(scene: &mut Scene, pair: &Pair, line: &Line, size: Expr) -> Pull {
        let force = line.between.map(|e| scene.graph.mul(size, e));
        // −size u·u' = −size/2 d(u²)/dt
        let half = scene.graph.scale(size, &Rational::HALF);
        let less = scene.graph.neg(half);
        let mut forces = Columns::new();
        for (j, slope) in scene.gradient(line.square) {
            let slope = scene.tidy(slope);
            if !scene.vanishes(slope) {
                forces.insert(j, scene.graph.mul(less, slope));
            }
        }
        Pull { acts: opposite(scene, pair, line.foot, force), forces }
    }

    /// Of one newton of (T₁ + T₂)/2: 2 cos β = 2 √(d² − (r_a ∓ r_b)²)/d.
    fn of_tension(scene: &mut Scene, connection: &Connection, pair: &Pair, line: Option<&Line>) -> Found<Pull> {
        let Some(line) = line else { return Err(faults::no_way_of_pull(connection)) };
        let [ra, rb] = pair.radii;
        let step = if pair.opposite { scene.graph.add(ra, rb) } else { scene.graph.sub(ra, rb) };
        let [square, apart] = scene.at_numbers([line.square, step]);
        // numbers that are not there, of unknowns for example, decide nothing
        if square <= apart * apart {
            return Err(faults::no_belt(connection, [square.sqrt(), apart.abs()]));
        }
        let rise = scene.graph.square(step);
        let run = scene.graph.sub(line.square, rise);
        let run = scene.tidy(run);
        let root = scene.graph.sqrt(run);
        let two = scene.graph.int(2);
        let double = scene.graph.mul(two, root);
        let size = scene.graph.div(double, line.square);
        Ok(Pull::along(scene, pair, line, size))
    }
}

fn opposite(scene: &mut Scene, pair: &Pair, foot: Vector, force: Vector) -> Vec<Act> {
    let against = force.map(|e| scene.graph.neg(e));
    vec![Act::Place { on: pair.a, at: foot, force }, Act::Point { point: PointRef::Origin(pair.b), force: against }]
}

/// The component of a belt or chain with what it pulls along the line: with its force, or by an unknown.
pub fn along_the_line(
    scene: &mut Scene,
    mut component: Component,
    (connection, strands): (&Connection, Strands),
    (pair, line): (&Pair, Option<&Line>),
) -> Found<Component> {
    match strands {
        Strands::Teeth | Strands::Pretension(_) => {}
        Strands::Slack { positive } => {
            let half = scene.graph.number(Rational::HALF);
            let share = if positive { half } else { scene.graph.neg(half) };
            let pull = Pull::of_tension(scene, connection, pair, line)?.times(scene, share);
            component.acts.extend(pull.acts);
            component.beside = pull.forces;
        }
        Strands::Open => component.open = open(scene, pair, line),
    }
    Ok(component)
}

/// A unit of the unknown P; in each direction across the axis where there is no line.
fn open(scene: &mut Scene, pair: &Pair, line: Option<&Line>) -> Vec<Pull> {
    let Some(line) = line else {
        let list = [Axis::X, Axis::Y, Axis::Z].map(|axis| {
            let way = unit_vector(scene, axis);
            scene.cross(&pair.axis, &way)
        });
        let zero = scene.zero_vector();
        let ways = list.into_iter().filter(|way| *way != zero).collect::<Vec<_>>();
        return ways.into_iter().map(|force| Pull { acts: at_axles(scene, pair, force), forces: Columns::new() }).collect();
    };
    let distance = scene.graph.sqrt(line.square);
    let one = scene.graph.one();
    let size = scene.graph.div(one, distance);
    vec![Pull::along(scene, pair, line, size)]
}

fn at_axles(scene: &mut Scene, pair: &Pair, force: Vector) -> Vec<Act> {
    let against = force.map(|e| scene.graph.neg(e));
    vec![Act::Point { point: PointRef::Origin(pair.a), force }, Act::Point { point: PointRef::Origin(pair.b), force: against }]
}

/// What the pretension of a belt does; none of other connections.
///
/// *Errors*: M129 wheels that are drawn at one place, M130 circles that no belt fits.
pub fn pretension(scene: &mut Scene, kinematics: &mut Kinematics, resolver: &mut Resolver, connection: &Connection) -> Found<Option<Pull>> {
    let ConnectionKind::Wheels { strands: Strands::Pretension(tension), .. } = &connection.kind else { return Ok(None) };
    let tension = resolver.resolve(scene, kinematics, *tension)?;
    let Some(pair) = pair(scene, kinematics, resolver, connection)? else { return Ok(None) };
    let line = Line::new(scene, kinematics, &pair);
    let pull = Pull::of_tension(scene, connection, &pair, line.as_ref())?;
    Ok(Some(pull.times(scene, tension)))
}

/// Both tensions, F0 ± |F|/2 of a belt, where they are known.
pub fn tensions(
    scene: &mut Scene,
    kinematics: &mut Kinematics,
    resolver: &mut Resolver,
    (connection, force): (&Connection, Expr),
) -> Found<Vec<(Part, Expr)>> {
    let ConnectionKind::Wheels { strands, .. } = &connection.kind else { return Ok(Vec::new()) };
    Ok(match *strands {
        Strands::Teeth | Strands::Open => Vec::new(),
        Strands::Pretension(tension) => {
            let tension = resolver.resolve(scene, kinematics, tension)?;
            let size = scene.graph.call(Function::Abs, &[force]);
            let half = scene.graph.scale(size, &Rational::HALF);
            vec![(Part::Tight, scene.graph.add(tension, half)), (Part::Slack, scene.graph.sub(tension, half))]
        }
        Strands::Slack { positive } => {
            let tight = if positive { force } else { scene.graph.neg(force) };
            vec![(Part::Tight, tight), (Part::Slack, scene.graph.zero())]
        }
    })
}

/// Tensions that must not become negative: of both strands of a belt, of the tight one of a chain.
pub fn watched(scene: &mut Scene, resolver: &Resolver, (index, connection): (usize, &Connection)) -> Vec<(Expr, Text)> {
    let (Some(&force), ConnectionKind::Wheels { strands, .. }) = (resolver.reactions.get(&(index, Part::Force)), &connection.kind) else {
        return Vec::new();
    };
    let list = match *strands {
        Strands::Teeth | Strands::Open => Vec::new(),
        Strands::Pretension(tension) => {
            let half = scene.graph.scale(force, &Rational::HALF);
            vec![scene.graph.sub(tension, half), scene.graph.add(tension, half)]
        }
        Strands::Slack { positive } => vec![if positive { force } else { scene.graph.neg(force) }],
    };
    list.into_iter().map(|e| (e, label(connection))).collect()
}
