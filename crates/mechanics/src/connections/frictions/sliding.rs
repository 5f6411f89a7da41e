//! Dry friction by what it acts between.
//!
//! | kind | sliding speed v | normal force N |
//! |---|---|---|
//! | pathway | its rate | given |
//! | point A on body b along d | d·(v_A − velocity of the particle of b that is at A) | given |
//! | wheel on its track, body at a stop | the same at the contact point | that of the contact |
//! | rolling resistance | angular velocity of one body against the other | that of the contact; the lever takes the coefficient's place |
//! | journal of radius r | angular velocity of one body against the other | r \|R\|, R the force of the pin |
//! | rope over a drum | rate at which the length before it shrinks | T₁ + T₂, with tanh(μα/2) in place of μ |
//!
//! For the rope, T₁ before the drum and T₂ behind it: T₂ = T₁ exp(μα) is T₂ − T₁ = tanh(μα/2)·(T₁ + T₂), the same for both ways of sliding. T₂ − T₁ is the
//! friction itself, positive when it resists sliding along the path, so that T₁ + T₂ = 2 T₂ − λ.

use crate::connections::common::axes::axes_of;
use crate::connections::common::component::{Component, Nature, Rubbing, effort, path};
use crate::connections::common::{faults, held, tracks};
use crate::model::{Aim, Axis, Connection, ConnectionKind, FrameId, Part, Pathway, PointRef, Pressing, Slides};
use crate::scene::kinematics::{Kinematics, combine};
use crate::scene::pathways::{Path, relative_angle, unit_vector};
use crate::scene::requests::Resolver;
use crate::scene::start::near_start;
use crate::scene::wrench::{Act, frame_of, particle};
use crate::scene::{Found, Scene, Vector, is_spatial};
use symbolic::{Expr, Function, Rational};
use words::Text;

/// How two bodies slide, and what presses them.
struct Sliding {
    rate: Expr,
    /// Per unit of λ.
    acts: Vec<Act>,
    words: (&'static str, &'static str),
    letter: &'static str,
    unit: &'static str,
    /// Components of the normal force; none where the model gives it.
    normal: Vec<Expr>,
}

/// The component of a friction.
pub fn friction(scene: &mut Scene, kinematics: &mut Kinematics, resolver: &mut Resolver, connection: &Connection) -> Found<Component> {
    let ConnectionKind::Friction { slides, kinetic, speed, fixed, normal } = &connection.kind else {
        return Err(faults::of_another_kind(connection));
    };
    let law = [Some(*kinetic), *fixed];
    let mut own = None;
    let (sliding, [kinetic, fixed]) = match slides {
        Slides::Along(pathway) => (along(scene, kinematics, resolver, (connection, *pathway))?, law),
        Slides::Point { point, on, direction } => {
            let direction = aimed(scene, kinematics, resolver, direction)?;
            let at = kinematics.position(scene, *point);
            let body = frame_of(scene, *point);
            (touching(scene, kinematics, ([body, *on], at, direction)), law)
        }
        Slides::Contact { of, direction, radius } => {
            (at_contact(scene, kinematics, resolver, (connection, *of, direction.as_ref(), *radius))?, law)
        }
        Slides::Rolls { of } => (rolls(scene, kinematics, resolver, (connection, *of))?, law),
        Slides::Journal { of, radius } => {
            let radius = resolver.resolve(scene, kinematics, *radius)?;
            let lever = law.map(|e| e.map(|e| scene.graph.mul(e, radius)));
            (journal(scene, kinematics, resolver, (connection, *of))?, lever)
        }
        Slides::Belt { of, over, wrap } => {
            let (sliding, wrap) = belt(scene, kinematics, resolver, (connection, *of, *over, *wrap))?;
            own = Some(scene.graph.int(-1));
            let half = scene.graph.number(Rational::HALF);
            let share = law.map(|e| {
                e.map(|e| {
                    let turn = scene.graph.product(&[half, e, wrap]);
                    scene.graph.call(Function::Tanh, &[turn])
                })
            });
            (sliding, share)
        }
    };
    let normal = match normal {
        Pressing::Given => Vec::new(),
        Pressing::Formula(e) => vec![*e],
        Pressing::Contact if sliding.normal.is_empty() => return Err(faults::unpressed(connection)),
        Pressing::Contact => sliding.normal,
    };
    let kinetic = kinetic.unwrap_or_else(|| scene.graph.zero());
    let name = &connection.name;
    let label = Text::new(format!("{} {name}", sliding.words.0), format!("{} {name}", sliding.words.1));
    let nature = Nature::Friction(Rubbing { speed: *speed, kinetic, fixed, normal, own });
    let of = (Part::Force, sliding.letter, sliding.unit);
    Ok(Component { rate: Some(sliding.rate), negative: true, nature, ..Component::ideal(of, label, sliding.acts) })
}

const DRY: (&str, &str) = ("dry friction", "сухое трение");

fn along(
    scene: &mut Scene,
    kinematics: &mut Kinematics,
    resolver: &mut Resolver,
    (connection, pathway): (&Connection, Pathway),
) -> Found<Sliding> {
    let path = path(scene, kinematics, resolver, connection, pathway)?;
    let (letter, unit) = effort(pathway, "M", "F");
    Ok(turning_or_moving(scene, &path, (letter, unit), DRY))
}

/// Friction against the growth of a pathway.
fn turning_or_moving(
    scene: &mut Scene,
    path: &Path,
    (letter, unit): (&'static str, &'static str),
    words: (&'static str, &'static str),
) -> Sliding {
    let minus = scene.graph.int(-1);
    let acts = path.acts.iter().map(|act| act.times(scene, minus)).collect();
    Sliding { rate: scene.rate_of(&path.gradient), acts, words, letter, unit, normal: Vec::new() }
}

/// The particles of two bodies at a place slide along a direction.
fn touching(scene: &mut Scene, kinematics: &mut Kinematics, ([a, b], at, direction): ([FrameId; 2], Vector, Vector)) -> Sliding {
    let columns = [particle(scene, kinematics, a, &at), particle(scene, kinematics, b, &at)];
    let [own, other] = columns.map(|c| combine(scene, &c));
    let speed = scene.minus(&own, &other);
    let rate = scene.dot(&direction, &speed);
    let rate = scene.tidy(rate);
    let against = direction.map(|e| scene.graph.neg(e));
    let acts = vec![Act::Place { on: a, at, force: against }, Act::Place { on: b, at, force: direction }];
    Sliding { rate, acts, words: DRY, letter: "F", unit: "N", normal: Vec::new() }
}

/// A unit vector in ground axes.
fn aimed(scene: &mut Scene, kinematics: &mut Kinematics, resolver: &mut Resolver, aim: &Aim) -> Found<Vector> {
    let mut vector = aim.vector;
    for e in &mut vector {
        *e = resolver.resolve(scene, kinematics, *e)?;
    }
    let unit = normalised(scene, &vector);
    Ok(kinematics.in_ground_axes(scene, aim.axes, &unit))
}

fn length(scene: &mut Scene, v: &Vector) -> Expr {
    let square = scene.dot(v, v);
    let square = scene.tidy(square);
    scene.graph.sqrt(square)
}

fn normalised(scene: &mut Scene, v: &Vector) -> Vector {
    let size = length(scene, v);
    v.map(|e| scene.graph.div(e, size))
}

/// Where a body touches another at a stop.
struct Touch {
    /// The body that the stop pushes, the other one.
    bodies: [FrameId; 2],
    /// The point of the stop, ground coordinates.
    at: Vector,
    /// Unit vector of the force on the body.
    normal: Vector,
    /// Normal force per unit of the stop's force.
    size: Expr,
}

fn at_contact(
    scene: &mut Scene,
    kinematics: &mut Kinematics,
    resolver: &mut Resolver,
    (connection, of, direction, radius): (&Connection, usize, Option<&Aim>, Option<Expr>),
) -> Found<Sliding> {
    let contact = &scene.model.connections[of];
    if let ConnectionKind::Rolling { .. } = contact.kind {
        let first = scene
            .model
            .connections
            .iter()
            .find(|c| matches!(&c.kind, ConnectionKind::Friction { slides: Slides::Contact { of: same, .. }, .. } if *same == of));
        if first.is_some_and(|first| first.name != connection.name) {
            return Err(faults::two_frictions(connection, &contact.name));
        }
        let (rate, acts) = tracks::slip(scene, kinematics, resolver, contact)?;
        let minus = scene.graph.int(-1);
        let acts = acts.iter().map(|act| act.times(scene, minus)).collect();
        let normal = resolver.reactions.get(&(of, Part::Normal)).copied().into_iter().collect();
        return Ok(Sliding { rate, acts, words: DRY, letter: "F", unit: "N", normal });
    }
    let touch = touch(scene, kinematics, resolver, (connection, of))?;
    let at = match radius {
        Some(radius) => {
            let radius = resolver.resolve(scene, kinematics, radius)?;
            let arm = touch.normal.map(|e| scene.graph.mul(radius, e));
            scene.minus(&touch.at, &arm)
        }
        None if touches_itself(scene, kinematics, resolver, contact)? => touch.at,
        None => return Err(faults::where_it_touches(connection, &contact.name)),
    };
    let direction = match direction {
        Some(aim) => aimed(scene, kinematics, resolver, aim)?,
        None if is_spatial(scene.model) => return Err(faults::directions_in_space(connection)),
        None => {
            let axis = unit_vector(scene, Axis::Z);
            scene.cross(&touch.normal, &axis)
        }
    };
    let sliding = touching(scene, kinematics, (touch.bodies, at, direction));
    Ok(Sliding { normal: pressed(scene, resolver, (of, touch.size)), ..sliding })
}

/// Whether the point of a stop itself is at the surface when the stop is closed: its limit is zero.
fn touches_itself(scene: &mut Scene, kinematics: &mut Kinematics, resolver: &mut Resolver, stop: &Connection) -> Found<bool> {
    let ConnectionKind::Stop { clearance, .. } = stop.kind else { return Ok(false) };
    let clearance = resolver.resolve(scene, kinematics, clearance)?;
    Ok(scene.graph.is_zero(clearance))
}

/// The normal force of a stop from its reaction.
fn pressed(scene: &mut Scene, resolver: &Resolver, (of, size): (usize, Expr)) -> Vec<Expr> {
    let force = resolver.reactions.get(&(of, Part::Force)).copied();
    force.map(|e| scene.graph.mul(size, e)).into_iter().collect()
}

/// Body, place and direction of the force of a stop, when they follow from points.
fn touch(scene: &mut Scene, kinematics: &mut Kinematics, resolver: &mut Resolver, (connection, of): (&Connection, usize)) -> Found<Touch> {
    let stop = &scene.model.connections[of];
    let unknown = || faults::no_place(connection, &stop.name);
    let ConnectionKind::Stop { gap, above, .. } = stop.kind else { return Err(unknown()) };
    let path = path(scene, kinematics, resolver, stop, gap)?;
    let mut forces: Vec<(PointRef, Vector)> = Vec::new();
    for act in &path.acts {
        let Act::Point { point, force } = act else { return Err(unknown()) };
        match forces.iter_mut().find(|(p, _)| p == point) {
            Some((_, sum)) => *sum = scene.plus(sum, force),
            None => forces.push((*point, *force)),
        }
    }
    let (pushed, other) = match forces[..] {
        [own] => (own, FrameId::GROUND),
        [a, b] => {
            let sum = scene.plus(&a.1, &b.1);
            if !sum.iter().all(|e| scene.vanishes(*e)) {
                return Err(unknown());
            }
            let (first, second) = if frame_of(scene, a.0) == FrameId::GROUND { (b, a) } else { (a, b) };
            (first, frame_of(scene, second.0))
        }
        _ => return Err(unknown()),
    };
    let body = frame_of(scene, pushed.0);
    if body == other {
        return Err(unknown());
    }
    let force = if above { pushed.1 } else { pushed.1.map(|e| scene.graph.neg(e)) };
    let size = length(scene, &force);
    let normal = force.map(|e| scene.graph.div(e, size));
    let at = kinematics.position(scene, pushed.0);
    Ok(Touch { bodies: [body, other], at, normal, size })
}

/// A moment against the turning of one body on another.
fn rolls(
    scene: &mut Scene,
    kinematics: &mut Kinematics,
    resolver: &mut Resolver,
    (connection, of): (&Connection, usize),
) -> Found<Sliding> {
    let contact = &scene.model.connections[of];
    let (bodies, axis, normal) = match contact.kind {
        ConnectionKind::Rolling { wheel, on, .. } => {
            let normal = resolver.reactions.get(&(of, Part::Normal)).copied().into_iter().collect();
            ([wheel, on], axes_of(scene, kinematics, on)[2], normal)
        }
        _ if is_spatial(scene.model) => return Err(faults::directions_in_space(connection)),
        _ => {
            let touch = touch(scene, kinematics, resolver, (connection, of))?;
            (touch.bodies, unit_vector(scene, Axis::Z), pressed(scene, resolver, (of, touch.size)))
        }
    };
    let turning = bodies.map(|f| {
        let columns = kinematics.turning_in_ground_axes(scene, f);
        combine(scene, &columns)
    });
    let turning = scene.minus(&turning[0], &turning[1]);
    let rate = scene.dot(&axis, &turning);
    let rate = scene.tidy(rate);
    let against = axis.map(|e| scene.graph.neg(e));
    let acts = vec![Act::Turn { on: bodies[0], moment: against }, Act::Turn { on: bodies[1], moment: axis }];
    Ok(Sliding { rate, acts, words: ("rolling resistance", "трение качения"), letter: "M", unit: "N m", normal })
}

/// The second body turns on the first; a body on what its support holds it to.
fn journal(
    scene: &mut Scene,
    kinematics: &mut Kinematics,
    resolver: &mut Resolver,
    (connection, of): (&Connection, usize),
) -> Found<Sliding> {
    if is_spatial(scene.model) {
        return Err(faults::directions_in_space(connection));
    }
    let bodies = match &scene.model.connections[of].kind {
        ConnectionKind::Pin { between, .. } => between.map(|p| frame_of(scene, p)),
        // the journal is part of what gets the opposite of the force
        ConnectionKind::Support { at, on, .. } => {
            let support = &scene.model.connections[of];
            [on.map_or_else(|| held::at_place(scene, support, *at), Ok)?, frame_of(scene, *at)]
        }
        _ => return Err(faults::unpressed(connection)),
    };
    let path = relative_angle(scene, kinematics, (bodies[0], bodies[1]), &connection.span)?;
    let sliding = turning_or_moving(scene, &path, ("M", "N m"), ("journal friction", "трение в цапфе"));
    let normal: Vec<Expr> =
        [Part::ForceX, Part::ForceY].into_iter().filter_map(|part| resolver.reactions.get(&(of, part)).copied()).collect();
    if normal.len() < 2 {
        return Err(faults::unpressed(connection));
    }
    Ok(Sliding { normal, ..sliding })
}

/// The rope slides along its path, from the first end to the last; with its angle of contact.
fn belt(
    scene: &mut Scene,
    kinematics: &mut Kinematics,
    resolver: &mut Resolver,
    (connection, of, over, wrap): (&Connection, usize, [PointRef; 2], Option<Expr>),
) -> Found<(Sliding, Expr)> {
    let rope = &scene.model.connections[of];
    let ConnectionKind::Rope { path, wound, .. } = &rope.kind else { return Err(faults::unpressed(connection)) };
    let index = |p: PointRef| path.iter().position(|own| *own == p);
    let inside = |[a, b]: [usize; 2]| 0 < a && a <= b && b + 1 < path.len();
    // each passage has tensions of its own
    if over.iter().any(|p| path.iter().filter(|own| *own == p).count() > 1) {
        return Err(faults::passed_twice(connection, &rope.name));
    }
    let Some(ends) = index(over[0]).zip(index(over[1])).map(|(a, b)| [a, b]).filter(|ends| inside(*ends) && wound.is_empty()) else {
        return Err(faults::not_on_the_rope(connection, &rope.name));
    };
    let mut before = Vec::new();
    let mut acts = Vec::new();
    for pair in path[..=ends[0]].windows(2) {
        let (size, unit) = run(scene, kinematics, [pair[0], pair[1]]);
        let opposite = unit.map(|e| scene.graph.neg(e));
        // friction that resists sliding along the path leaves less tension before the drum
        acts.push(Act::Point { point: pair[0], force: opposite });
        acts.push(Act::Point { point: pair[1], force: unit });
        before.push(size);
    }
    let before = scene.graph.sum(&before);
    let wrap = match wrap {
        Some(wrap) => resolver.resolve(scene, kinematics, wrap)?,
        None if is_spatial(scene.model) => return Err(faults::directions_in_space(connection)),
        None => {
            // the first and the last direction alone do not tell 90° from 270°, nor that an S rubs at both of its bends
            let turns: Vec<Expr> =
                (ends[0]..=ends[1]).map(|k| turned(scene, kinematics, [[path[k - 1], path[k]], [path[k], path[k + 1]]])).collect();
            scene.graph.sum(&turns)
        }
    };
    // behind the drum: the rope's own tension, less what later drums of the same rope take
    let mut behind = vec![resolver.reactions.get(&(of, Part::Force)).copied().unwrap_or_else(|| scene.graph.zero())];
    for (i, other) in scene.model.connections.iter().enumerate() {
        if let ConnectionKind::Friction { slides: Slides::Belt { of: same, over, .. }, .. } = &other.kind
            && *same == of
            && index(over[0]).is_some_and(|k| k > ends[1])
        {
            let later = resolver.reactions.get(&(i, Part::Force)).copied();
            behind.extend(later.map(|e| scene.graph.neg(e)));
        }
    }
    let behind = scene.graph.sum(&behind);
    let two = scene.graph.int(2);
    let normal = vec![scene.graph.mul(two, behind)];
    let grows = scene.total(before);
    let rate = scene.graph.neg(grows);
    Ok((Sliding { rate, acts, words: ("belt friction", "трение каната"), letter: "F", unit: "N", normal }, wrap))
}

/// Length and direction of a straight piece of a rope.
fn run(scene: &mut Scene, kinematics: &mut Kinematics, [a, b]: [PointRef; 2]) -> (Expr, Vector) {
    let (ra, rb) = (kinematics.position(scene, a), kinematics.position(scene, b));
    let between = scene.minus(&rb, &ra);
    let size = length(scene, &between);
    (size, between.map(|e| scene.graph.div(e, size)))
}

/// Angle by which a rope turns from one run to the next, 0 ... 2π: π − atan2(s c, −d) with the sine c and the cosine d of the turn, s the sign of c at the
/// start. Runs that are parallel at the start make half a turn when they stay so.
fn turned(scene: &mut Scene, kinematics: &mut Kinematics, runs: [[PointRef; 2]; 2]) -> Expr {
    let [(_, u), (_, w)] = runs.map(|pair| run(scene, kinematics, pair));
    let sine = scene.cross(&u, &w)[2];
    let sine = scene.tidy(sine);
    let cosine = scene.dot(&u, &w);
    let cosine = scene.tidy(cosine);
    let start = near_start(scene, sine);
    let sign = scene.graph.call(Function::Sign, &[start]);
    let sine = scene.graph.mul(sign, sine);
    let back = scene.graph.neg(cosine);
    let angle = scene.graph.call(Function::Atan2, &[sine, back]);
    let pi = scene.graph.pi();
    scene.graph.sub(pi, angle)
}

/// Drums of one rope in the order in which their tensions become known: the last first; other frictions before.
pub fn order(connection: &Connection, model: &crate::model::Model) -> (bool, std::cmp::Reverse<usize>) {
    let ConnectionKind::Friction { slides: Slides::Belt { of, over, .. }, .. } = &connection.kind else {
        return (false, std::cmp::Reverse(0));
    };
    let ConnectionKind::Rope { path, .. } = &model.connections[*of].kind else { return (true, std::cmp::Reverse(0)) };
    (true, std::cmp::Reverse(path.iter().position(|p| *p == over[0]).unwrap_or(0)))
}
