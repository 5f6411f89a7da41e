//! Connections: what each demands of the motion and what its reactions do.
//!
//! Every connection is a list of [`Component`]s, each a scalar condition with a scalar reaction; what each kind gives stands in its file of `connections/`.
//! Lagrange's side takes the generalized force of a reaction from the condition by differentiation; Newton-Euler's side from the forces
//! and moments on the bodies. A condition that holds by the choice of the coordinates (a crank turned by its own angle stays on its
//! axle anyway) has no place among the conditions of the motion: its reaction follows from the balance of the body when it is
//! released there (`release.rs`).

mod connected;
mod free;
mod letters;
mod release;
mod sums;
mod transmissions;

pub(super) use letters::letters;

pub use connected::Connected;

use super::inertial;
use super::loads::Loads;
use super::place::{Open, Opening, Placer};
use crate::connections::common::{faults, pair};
use crate::connections::{self, Component, Nature, Rubbing};
use crate::model::{Connection, ConnectionKind, FrameId, Part, Slides};
use crate::scene::kinematics::Kinematics;
use crate::scene::requests::Resolver;
use crate::scene::wrench::{Act, generalized};
use crate::scene::{Columns, Found, Scene};
use algebra::arrange::Arrange;
use std::collections::BTreeSet;
use symbolic::connections::{Condition, Friction, Law, Normal, Reaction, Released};
use symbolic::{Expr, Substitution, SymbolId};
use words::{Notice, Text};

/// Finds conditions and reactions of all connections; balances come later, when the loads are known.
///
/// *Errors*: those of all connections.
pub fn connect(scene: &mut Scene, kinematics: &mut Kinematics, resolver: &mut Resolver) -> Result<Connected, Vec<Notice>> {
    let model = scene.model;
    let mut connected = Connected { taken: taken_names(scene), ..Connected::default() };
    let mut errors = Vec::new();
    // frictions ask for reactions of others
    let (frictions, others): (Vec<usize>, Vec<usize>) =
        (0..model.connections.len()).partition(|i| matches!(model.connections[*i].kind, ConnectionKind::Friction { .. }));
    let mut frictions = frictions;
    frictions.arrange_by_key(|i| connections::frictions::order(&model.connections[*i], model));
    for i in others.into_iter().chain(frictions) {
        let connection = &model.connections[i];
        match connections::components(scene, kinematics, resolver, connection) {
            Ok(list) => {
                for mut component in list {
                    let (doubts, before) = (std::mem::take(&mut component.doubts), connected.conditions.len());
                    connected.pulls.extend(std::mem::take(&mut component.open).into_iter().map(|pull| (i, pull)));
                    let added = connected.add(scene, kinematics, resolver, (i, connection, component));
                    errors.extend(added.err().map(|d| placed(*d, connection)));
                    let own = before..connected.conditions.len();
                    connected.doubts.extend(doubts.into_iter().map(|doubt| (doubt, own.clone())));
                }
            }
            Err(diagnostic) => errors.push(placed(*diagnostic, connection)),
        }
    }
    errors.extend(motors_match(model));
    errors.extend(connected.justified(scene));
    if errors.is_empty() { Ok(connected) } else { Err(errors) }
}

/// What is said of a formula of a connection points at the connection, unless it has a place of its own.
fn placed(mut diagnostic: Notice, connection: &Connection) -> Notice {
    if diagnostic.place == words::Place::File(0..0) {
        diagnostic.place = words::Place::File(connection.span.clone());
    }
    diagnostic
}

/// Names that formulas use already.
fn taken_names(scene: &Scene) -> BTreeSet<String> {
    let model = scene.model;
    (model.parameters.iter().map(|p| p.name.clone()))
        .chain(model.coordinates.iter().map(|c| c.name.clone()))
        .chain(model.outputs.iter().map(|o| o.name.clone()))
        .collect()
}

/// A component as its rates show it.
struct Shape {
    rate: Expr,
    columns: Vec<(usize, Expr)>,
}

impl Connected {
    fn add(
        &mut self,
        scene: &mut Scene,
        kinematics: &mut Kinematics,
        resolver: &mut Resolver,
        (index, connection, mut component): (usize, &Connection, Component),
    ) -> Found<()> {
        component.label = connection.named(&component.label);
        let shape = shape(scene, &component);
        let symbol = component.part.map(|_| self.name(scene, component.letter, &connection.name));
        let acting = self.reactions.len();
        let Some(law) = self.law(scene, kinematics, resolver, (connection, &component, &shape))? else {
            self.condition(scene, (&component, shape), None);
            return Ok(());
        };
        let forces = match law {
            Law::Support => Vec::new(),
            Law::Motor => {
                let columns = generalized(scene, kinematics, &component.acts);
                columns.into_iter().filter(|(j, _)| *j < scene.n()).collect()
            }
            _ => {
                let own = if component.negative { negated(scene, &shape.columns) } else { shape.columns.clone() };
                beside(scene, own, &component.beside)
            }
        };
        if law.condition().is_some() {
            self.condition(scene, (&component, shape), Some(acting));
        }
        let geometric = generalized(scene, kinematics, &component.acts);
        let (Some(symbol), Some(part)) = (symbol, component.part) else { return Ok(()) };
        let value = scene.graph.symbol(symbol);
        resolver.reactions.insert((index, part), value);
        for (part, tension) in connections::tensions(scene, kinematics, resolver, (connection, value))? {
            resolver.reactions.insert((index, part), tension);
        }
        // a friction at a wheel is its tangential force, the other way round
        if let ConnectionKind::Friction { slides: Slides::Contact { of, .. }, .. } = connection.kind {
            let tangential = scene.graph.neg(value);
            resolver.reactions.insert((of, Part::Tangential), tangential);
        }
        let name = format!("{}({})", part.name(), connection.name);
        self.reactions.push(Reaction {
            symbol,
            name,
            unit: if component.unit.is_empty() { connection.unit.clone() } else { component.unit.to_owned() },
            label: component.label.clone(),
            forces,
            released: Vec::new(),
            law,
        });
        self.geometric.push(geometric);
        self.acts.push(component.acts);
        Ok(())
    }

    /// The law of the reaction, none of a prescribed motion; what holds bodies together that the coordinates never part releases them.
    fn law(
        &mut self,
        scene: &mut Scene,
        kinematics: &mut Kinematics,
        resolver: &mut Resolver,
        (connection, component, shape): (&Connection, &Component, &Shape),
    ) -> Found<Option<Law>> {
        let condition = self.conditions.len();
        Ok(Some(match component.nature {
            Nature::Motor => Law::Motor,
            Nature::Ideal if shape.columns.is_empty() => {
                if component.acts.iter().all(|act| matches!(act, Act::Along(_))) {
                    return Err(no_coordinate(connection));
                }
                self.release(scene, &component.acts);
                Law::Support
            }
            // a rope of a structure at rest: statics asks whether it pulls
            Nature::Contact { gap, restitution: [restitution, tangential], tie: true, rebound } if scene.n() == 0 => {
                self.release(scene, &component.acts);
                Law::Contact { condition, gap, restitution, tangential, tie: true, rebound }
            }
            _ if shape.columns.is_empty() => return Err(no_coordinate(connection)),
            Nature::Motion => return Ok(None),
            Nature::Ideal => Law::Ideal { condition },
            Nature::Contact { gap, restitution: [restitution, tangential], tie, rebound } => {
                Law::Contact { condition, gap, restitution, tangential, tie, rebound }
            }
            Nature::Rough => Law::Rough { condition, contact: self.reactions.len().saturating_sub(1) },
            Nature::Friction(ref rubbing) => {
                let found = self.friction(scene, kinematics, resolver, (shape.rate, rubbing))?;
                if self.is_curved(scene, &found) {
                    return Err(faults::curved_normal(connection));
                }
                found
            }
        }))
    }

    /// Faults of the doubts whose coordinates no other connection holds; where one does, the rate may vanish by it.
    fn justified(&mut self, scene: &mut Scene) -> Vec<Notice> {
        let doubts = std::mem::take(&mut self.doubts);
        let holds = |c: &Condition| c.reaction.is_some_and(|r| matches!(self.reactions[r].law, Law::Ideal { .. }));
        let mut found = Vec::new();
        for (doubt, own) in doubts {
            let others = self.conditions.iter().enumerate().filter(|(k, c)| !own.contains(k) && holds(c));
            let held: BTreeSet<usize> = others.flat_map(|(_, c)| c.columns.iter().map(|(j, _)| *j)).collect();
            let moving = |scene: &mut Scene, j: usize| {
                let slope = scene.by_rate(doubt.rate, j);
                !scene.vanishes(slope)
            };
            if !held.iter().any(|j| moving(scene, *j)) {
                found.push(doubt.fault);
            }
        }
        found
    }

    /// X_A, or the first of X_A2, X_A3, ... that is free.
    fn name(&mut self, scene: &mut Scene, letter: &str, name: &str) -> SymbolId {
        let mut wanted = format!("{letter}_{name}");
        let mut k = 2;
        while !self.taken.insert(wanted.clone()) {
            wanted = format!("{letter}_{name}{k}");
            k += 1;
        }
        scene.graph.symbol_id(&wanted, 0)
    }

    fn condition(&mut self, scene: &mut Scene, (component, shape): (&Component, Shape), reaction: Option<usize>) {
        let remainder = without_accelerations(scene, shape.rate);
        self.conditions.push(Condition {
            name: component.label.clone(),
            place: component.place.map(|e| scene.tidy(e)),
            rate: shape.rate,
            columns: shape.columns,
            remainder,
            reaction,
        });
    }

    /// Releases the bodies that the actions hold together, and those between them and their last common carrier. A structure that stands in one position is
    /// cut where reactions are declared only: what else joins its bodies stays whole.
    fn release(&mut self, scene: &Scene, acts: &[Act]) {
        let frames: Vec<FrameId> = acts.iter().filter_map(|act| act.frame(scene)).collect();
        for frame in &frames {
            for other in &frames {
                let frames = if scene.n() == 0 { release::parted } else { release::between };
                self.released.extend(frames(scene, *frame, *other));
            }
        }
    }

    fn friction(
        &self,
        scene: &mut Scene,
        kinematics: &mut Kinematics,
        resolver: &mut Resolver,
        (sliding, rubbing): (Expr, &Rubbing),
    ) -> Found<Law> {
        let zero = scene.graph.zero();
        let minus = scene.graph.neg(sliding);
        let at = |scene: &mut Scene, e: Expr, u: Expr| Substitution::new([(rubbing.speed, u)]).apply(&mut scene.graph, e);
        let kinetic = resolver.resolve(scene, kinematics, rubbing.kinetic)?;
        let mut sides = [at(scene, kinetic, minus), at(scene, kinetic, sliding)];
        let mut limit = match rubbing.fixed {
            Some(e) => resolver.resolve(scene, kinematics, e)?,
            None => at(scene, kinetic, zero),
        };
        let mut normals = Vec::new();
        for e in &rubbing.normal {
            let e = resolver.resolve(scene, kinematics, *e)?;
            normals.push(self.linear(scene, e));
        }
        if let (Some(own), Some(first)) = (rubbing.own, normals.first_mut()) {
            first.terms.push((self.reactions.len(), own));
        }
        let mut normals = normals.into_iter();
        let (mut normal, across) = (normals.next(), normals.next());
        if let Some(given) = normal.take_if(|n| n.terms.is_empty() && across.is_none()) {
            let size = scene.graph.call(symbolic::Function::Abs, &[given.constant]);
            sides = sides.map(|e| scene.graph.mul(e, size));
            limit = scene.graph.mul(limit, size);
        }
        let condition = self.conditions.len();
        Ok(Law::Friction(Box::new(Friction { condition, sliding, kinetic: sides, fixed: limit, normal, across })))
    }

    /// What reactions give to a formula that is linear in them.
    fn linear(&self, scene: &mut Scene, e: Expr) -> Normal {
        let zero = scene.graph.zero();
        let mut terms = Vec::new();
        for (k, reaction) in self.reactions.iter().enumerate() {
            let factor = scene.graph.derivative(e, reaction.symbol);
            if !scene.graph.is_zero(factor) {
                terms.push((k, factor));
            }
        }
        let constant = Substitution::new(self.reactions.iter().map(|r| (r.symbol, zero))).apply(&mut scene.graph, e);
        Normal { constant, terms }
    }

    /// Whether the normal force of a friction is not linear in the reactions.
    fn is_curved(&self, scene: &Scene, law: &Law) -> bool {
        let Law::Friction(friction) = law else { return false };
        let mut terms = friction.components().flat_map(|normal| &normal.terms);
        let of_reaction = |s: SymbolId| self.reactions.iter().any(|r| r.symbol == s);
        terms.any(|(_, factor)| scene.graph.contains(*factor, of_reaction))
    }

    /// The balances of released bodies, and what each reaction gives there; what loads by formulas leave open joins the reactions.
    pub fn balance(&mut self, scene: &mut Scene, kinematics: &mut Kinematics, loads: &Loads, inertial: &[Act]) {
        self.free = Released { bodies: free::bodies(scene, kinematics), ..Released::default() };
        self.leave_pulls(scene, kinematics);
        if self.released.is_empty() {
            free::act(scene, kinematics, &loads.acts, inertial, self);
            return;
        }
        let (every, momenta) = (loads, inertial::carried(scene, kinematics));
        let mut placer = Placer::new(scene, kinematics);
        let named: Vec<Vec<Act>> =
            loads.named.iter().map(|(_, _, acts)| placer.place(scene, kinematics, &loads.acts[acts.clone()])).collect();
        let loads = placer.place(scene, kinematics, &loads.acts);
        let coupled = placer.place(scene, kinematics, &free::without_bodies(inertial));
        let (raw, inertial) = (inertial, placer.place(scene, kinematics, inertial));
        self.acts = self.acts.iter().map(|acts| placer.place(scene, kinematics, acts)).collect();
        transmissions::leave_open(scene, kinematics, &mut placer, (&loads, &inertial), self);
        let frames: Vec<FrameId> = self.released.iter().copied().collect();
        for open in std::mem::take(&mut placer.open) {
            if release::is_felt(scene, kinematics, &frames, &open.acts) {
                self.leave_open(scene, open);
            }
        }
        self.applied = vec![Vec::new(); named.len()];
        let displacements = release::displacements(scene, kinematics, &placer, self);
        self.free.frames = free::frames(scene, kinematics, &displacements, (&loads, &coupled, self));
        for (frame, displacement) in displacements {
            for (list, acts) in self.applied.iter_mut().zip(&named) {
                let work = release::total_work(scene, kinematics, acts, (frame, &displacement));
                if !scene.graph.is_zero(work) {
                    list.push((self.balances.len(), work));
                }
            }
            release::balance(scene, kinematics, (frame, &displacement), (&loads, &inertial, &momenta), self);
        }
        free::act(scene, kinematics, &every.acts, raw, self);
    }

    /// The sums of tensions that are not known and that a released body or a coordinate feels.
    fn leave_pulls(&mut self, scene: &mut Scene, kinematics: &Kinematics) {
        let frames: Vec<FrameId> = self.released.iter().copied().collect();
        for (of, pull) in std::mem::take(&mut self.pulls) {
            let forces: Vec<(usize, Expr)> = pull.forces.range(..scene.n()).map(|(j, e)| (*j, *e)).collect();
            if forces.is_empty() && !release::is_felt(scene, kinematics, &frames, &pull.acts) {
                continue;
            }
            let connection = &scene.model.connections[of];
            let symbol = self.name(scene, "T", &connection.name);
            let name = format!("{}.{}", connection.table, connection.name);
            let (unit, label) = ("N".to_owned(), pair::label(connection));
            self.reactions.push(Reaction { symbol, name, unit, label, forces, released: Vec::new(), law: Law::Tension });
            self.geometric.push(Columns::new());
            self.acts.push(pull.acts);
        }
    }

    /// An unknown of the balances that is no reaction.
    fn leave_open(&mut self, scene: &mut Scene, open: Open) {
        let symbol = self.name(scene, "place", open.of.name());
        let name = open.of.name().to_owned();
        let (label, law) = match open.of {
            Opening::Load(name) => (Text::new(format!("place of {name}"), format!("место приложения {name}")), Law::Place),
            Opening::Transmission { bodies, .. } => (Text::same(bodies.join(", ")), Law::Transmission),
        };
        let (forces, released) = (Vec::new(), Vec::new());
        self.reactions.push(Reaction { symbol, name, unit: String::new(), label, forces, released, law });
        self.geometric.push(Columns::new());
        self.acts.push(open.acts);
    }
}

/// Rate and columns of a component, in textbook form, so that what cancels is seen to vanish.
fn shape(scene: &mut Scene, component: &Component) -> Shape {
    let mut columns = Vec::new();
    let rate = match (component.rate, component.place) {
        (Some(rate), _) => scene.open(rate),
        (None, Some(place)) => scene.total(place),
        (None, None) => scene.graph.zero(),
    };
    match component.place {
        Some(place) if component.rate.is_none() => {
            for (j, e) in scene.gradient(place) {
                let e = scene.tidy(e);
                if j < scene.n() && !scene.vanishes(e) {
                    columns.push((j, e));
                }
            }
        }
        _ => {
            for j in 0..scene.n() {
                let e = scene.by_rate(rate, j);
                let e = scene.tidy(e);
                if !scene.vanishes(e) {
                    columns.push((j, e));
                }
            }
        }
    }
    Shape { rate, columns }
}

fn negated(scene: &mut Scene, columns: &[(usize, Expr)]) -> Vec<(usize, Expr)> {
    columns.iter().map(|(j, e)| (*j, scene.graph.neg(*e))).collect()
}

/// With the generalized forces that no condition shows.
fn beside(scene: &mut Scene, mut forces: Vec<(usize, Expr)>, more: &Columns<Expr>) -> Vec<(usize, Expr)> {
    for (&j, &e) in more.range(..scene.n()) {
        match forces.iter_mut().find(|(i, _)| *i == j) {
            Some((_, sum)) => *sum = scene.graph.add(*sum, e),
            None => forces.push((j, e)),
        }
    }
    forces.arrange_by_key(|(j, _)| *j);
    forces
}

/// d(rate)/dt with q'' = 0.
fn without_accelerations(scene: &mut Scene, rate: Expr) -> Expr {
    let derivative = scene.total(rate);
    let zero = scene.graph.zero();
    let still: Vec<(SymbolId, Expr)> = scene.model.coordinates.iter().map(|c| (c.symbols[2], zero)).collect();
    let rest = Substitution::new(still).apply(&mut scene.graph, derivative);
    scene.tidy(rest)
}

fn no_coordinate(connection: &Connection) -> Box<Notice> {
    let name = &connection.name;
    Box::new(
        Notice::file(
            "M104",
            connection.span.clone(),
            Text::new(
                format!("`{}.{name}` demands something that no coordinate can change", connection.table),
                format!("`{}.{name}` требует того, что не зависит ни от одной координаты", connection.table),
            ),
        )
        .why(
            "everything it connects stands still or moves in a prescribed way",
            "всё, что она соединяет, неподвижно или движется заданным образом",
        )
        .help(
            "let a coordinate move one of the partners, or remove it",
            "пусть одно из соединяемых тел движется по координате, или уберите связь",
        ),
    )
}

/// As many motors as prescribed motions.
fn motors_match(model: &crate::model::Model) -> Option<Notice> {
    let of = |wanted: fn(&ConnectionKind) -> bool| model.connections.iter().filter(move |c| wanted(&c.kind));
    let motions: Vec<&Connection> = of(|k| matches!(k, ConnectionKind::Motion { .. })).collect();
    let motors: Vec<&Connection> = of(|k| matches!(k, ConnectionKind::Motor { .. })).collect();
    if motions.len() == motors.len() {
        return None;
    }
    let (n, m) = (motions.len(), motors.len());
    let last = motions.last().or(motors.last())?;
    let names = |list: &[&Connection]| list.iter().map(|c| format!("`{}`", c.name)).collect::<Vec<_>>().join(", ");
    let none = |s: String| if s.is_empty() { "-".to_owned() } else { s };
    let (prescribed, driven) = (none(names(&motions)), none(names(&motors)));
    Some(
        Notice::file(
            "M105",
            last.span.clone(),
            Text::new(
                format!("{n} prescribed motion(s), {m} motor(s): the numbers must be equal"),
                format!("заданных движений: {n}, двигателей: {m}; их должно быть поровну"),
            ),
        )
        .why(
            format!("each prescribed motion takes one degree of freedom and one unknown force or torque realises it; motions: {prescribed}; motors: {driven}"),
            format!("каждое заданное движение отнимает степень свободы, и его осуществляет одна неизвестная сила или момент; движения: {prescribed}; двигатели: {driven}"),
        )
        .help(
            if n > m { "add a motor to [motors] or remove a motion" } else { "prescribe one more motion in [motions] or remove a motor" },
            if n > m { "добавьте двигатель в [motors] или уберите движение" } else { "задайте ещё одно движение в [motions] или уберите двигатель" },
        ),
    )
}
