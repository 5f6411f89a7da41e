//! Generalized forces of gravity, springs, dampers, applied forces and torques.
//!
//! Lagrange's way: potentials Π, dissipation function Φ, virtual power of the rest. Newton-Euler's way: every element is a pair of forces
//! (or torques) projected with the velocities of the points (or bodies) it acts on.

use super::connections::pretension;
use super::kinematics::Kinematics;
use super::pathways::{Given, located, resolve};
use super::requests::Resolver;
use super::scene::{Columns, Found, Scene, Vector};
use super::wrench::Act;
use crate::model::{Action, PointRef, Rest};
use std::collections::BTreeMap;
use std::ops::Range;
use symbolic::equations::Applied;
use symbolic::{Edge, Expr, Rational, Substitution, SymbolId};
use words::Notice;

/// A named term of an energy.
#[derive(Clone, Debug)]
pub struct Term {
    /// The element.
    pub name: String,
    /// The energy.
    pub energy: Expr,
}

/// What acts on the machine.
#[derive(Clone, Debug, Default)]
pub struct Loads {
    /// Terms of Π.
    pub potentials: Vec<Term>,
    /// Terms of Φ.
    pub dissipations: Vec<Term>,
    /// Generalized forces of all other loads, per direction.
    pub applied: Vec<Columns<Expr>>,
    /// Load of the file that each force and torque is a part of, its rows in `applied`, its actions in `acts`.
    pub named: Vec<(String, Range<usize>, Range<usize>)>,
    /// Newton-Euler: generalized forces of gravity and elements with a potential, per direction.
    pub conservative: Vec<Columns<Expr>>,
    /// Newton-Euler: generalized forces of dissipative elements, per direction.
    pub resisting: Vec<Columns<Expr>>,
    /// Power taken by dissipative elements.
    pub dissipated: Vec<Expr>,
    /// Power in the time direction: what moving supports and parameters that change with time put into potentials.
    pub potential_change: Vec<Expr>,
    /// Everything that acts, as forces and moments on bodies.
    pub acts: Vec<Act>,
    /// (force, extension) of each spring.
    pub springs: Vec<(Expr, Expr)>,
    /// (force, pathway) of each damper.
    pub dampers: Vec<(Expr, Expr)>,
}

/// Collects everything that acts.
pub fn collect(scene: &mut Scene, kinematics: &mut Kinematics, resolver: &mut Resolver) -> Result<Loads, Vec<Notice>> {
    let mut loads = Loads::default();
    let mut errors = Vec::new();
    gravity(scene, kinematics, &mut loads);
    let model = scene.model;
    for i in 0..model.springs.len() {
        errors.extend(spring(scene, kinematics, resolver, &mut loads, i).err().map(|d| *d));
    }
    for i in 0..model.dampers.len() {
        errors.extend(damper(scene, kinematics, resolver, &mut loads, i).err().map(|d| *d));
    }
    errors.extend(free_forms(scene, kinematics, resolver, &mut loads).err().map(|d| *d));
    errors.extend(applied(scene, kinematics, resolver, &mut loads).err().map(|d| *d));
    for connection in &model.connections {
        match pretension(scene, kinematics, resolver, connection) {
            Ok(None) => {}
            Ok(Some(pull)) => {
                loads.acts.extend(pull.acts);
                loads.applied.push(pull.forces);
            }
            Err(fault) => errors.push(*fault),
        }
    }
    if errors.is_empty() { Ok(loads) } else { Err(errors) }
}

/// Π = -m g·r_C; force m g at the centre.
fn gravity(scene: &mut Scene, kinematics: &mut Kinematics, loads: &mut Loads) {
    let model = scene.model;
    let Some(g) = model.gravity else { return };
    let g = scene.open_vector(g);
    for (i, frame) in model.frames.iter().enumerate() {
        let Some(mass) = frame.mass.as_ref().filter(|m| m.gravity) else { continue };
        if scene.graph.is_zero(mass.mass) {
            continue;
        }
        let center = PointRef::Center(crate::model::FrameId(i));
        let position = kinematics.position(scene, center);
        let height = scene.dot(&g, &position);
        let energy = scene.graph.mul(mass.mass, height);
        let energy = scene.graph.neg(energy);
        loads.potentials.push(Term { name: frame.name.clone(), energy });
        let weight = g.map(|g| scene.graph.mul(mass.mass, g));
        let columns = kinematics.jacobian(scene, center);
        let projected = project(scene, &weight, &columns);
        loads.conservative.push(projected);
        loads.acts.push(Act::Point { point: center, force: weight });
        let change = scene.along(energy, scene.n());
        loads.potential_change.push(change);
    }
}

/// force·column for every direction.
pub fn project(scene: &mut Scene, force: &Vector, columns: &Columns<Vector>) -> Columns<Expr> {
    columns.iter().map(|(j, column)| (*j, scene.dot(force, column))).collect()
}

/// Π = c (δ - rest)²/2 + preload (δ - rest); force c (δ - rest) + preload against growing δ.
fn spring(scene: &mut Scene, kinematics: &mut Kinematics, resolver: &mut Resolver, loads: &mut Loads, index: usize) -> Found<()> {
    let model = scene.model;
    let spring = &model.springs[index];
    let path = resolve(scene, kinematics, resolver, (&spring.name, spring.pathway, &spring.span))?;
    let [stiffness, preload] = [spring.stiffness, spring.preload].map(|e| resolver.resolve(scene, kinematics, e));
    let (stiffness, preload) = (stiffness?, preload?);
    let rest = match spring.rest {
        Rest::Value(e) => resolver.resolve(scene, kinematics, e)?,
        Rest::Start => at_start(scene, &spring.name, path.value),
    };
    let extension = scene.graph.sub(path.value, rest);
    let acting = match spring.backlash {
        Some(play) => {
            let play = resolver.resolve(scene, kinematics, play)?;
            beyond_play(scene, extension, play)
        }
        None => extension,
    };
    let square = scene.graph.square(acting);
    let elastic = scene.graph.monomial(Rational::HALF, &[(stiffness, Rational::ONE), (square, Rational::ONE)]);
    let constant = scene.graph.mul(preload, extension);
    let energy = scene.graph.add(elastic, constant);
    loads.potentials.push(Term { name: spring.name.clone(), energy });
    let force = scene.graph.mul(stiffness, acting);
    let force = scene.graph.add(force, preload);
    loads.springs.push((force, extension));
    let against = scene.graph.neg(force);
    let projected = scaled(scene, against, &path.geometric);
    loads.conservative.push(projected);
    loads.act(scene, against, &path.acts);
    let change = scene.along(energy, scene.n());
    loads.potential_change.push(change);
    Ok(())
}

/// What an extension e has beyond a play of width δ: e - δ/2 above it, e + δ/2 below it, 0 within.
fn beyond_play(scene: &mut Scene, extension: Expr, play: Expr) -> Expr {
    let graph = &mut scene.graph;
    let half = graph.scale(play, &Rational::HALF);
    let (above, below, zero) = (graph.sub(extension, half), graph.add(extension, half), graph.zero());
    let under = graph.neg(below);
    let otherwise = graph.switch(under, Edge::Open, below, zero);
    graph.switch(above, Edge::Open, above, otherwise)
}

/// factor·gradient.
fn scaled(scene: &mut Scene, factor: Expr, gradient: &Columns<Expr>) -> Columns<Expr> {
    gradient.iter().map(|(j, d)| (*j, scene.graph.mul(factor, *d))).collect()
}

/// The value of an expression of the element `user` at the start of the motion.
pub fn at_start(scene: &mut Scene, user: &str, e: Expr) -> Expr {
    let used = scene.graph.symbols_in(&[e]);
    let coordinates = &scene.model.coordinates;
    let used: Vec<usize> = (0..coordinates.len()).filter(|j| used.contains(&coordinates[*j].symbols[0])).collect();
    let places = used.into_iter().map(|j| (coordinates[j].symbols[0], scene.place_at_start(j, user))).collect();
    put_start(scene, places, e)
}

/// The same at the values of the file, guesses as they are: for choices that are the same around it.
pub fn near_start(scene: &mut Scene, e: Expr) -> Expr {
    let places = scene.model.coordinates.iter().map(|c| (c.symbols[0], c.start)).collect();
    put_start(scene, places, e)
}

fn put_start(scene: &mut Scene, places: Vec<(SymbolId, Expr)>, e: Expr) -> Expr {
    let model = scene.model;
    let zero = scene.graph.zero();
    // formulas of time at t = 0, each over constants and earlier ones
    let mut map: Vec<(SymbolId, Expr)> = vec![(model.time, zero)];
    for parameter in model.parameters.iter().filter(|p| p.class == crate::model::Class::Time) {
        let value = Substitution::new(map.iter().copied()).apply(&mut scene.graph, parameter.value.expr());
        map.push((parameter.symbol, value));
    }
    map.extend(scene.turns.iter().map(|t| (t.symbol, zero)));
    map.extend(places);
    Substitution::new(map).apply(&mut scene.graph, e)
}

/// Φ = b δ'²/2; force b δ' against growing δ.
fn damper(scene: &mut Scene, kinematics: &mut Kinematics, resolver: &mut Resolver, loads: &mut Loads, index: usize) -> Found<()> {
    let model = scene.model;
    let damper = &model.dampers[index];
    let path = resolve(scene, kinematics, resolver, (&damper.name, damper.pathway, &damper.span))?;
    let damping = resolver.resolve(scene, kinematics, damper.damping)?;
    let rate = scene.rate_of(&path.gradient);
    let square = scene.graph.square(rate);
    let energy = scene.graph.monomial(Rational::HALF, &[(damping, Rational::ONE), (square, Rational::ONE)]);
    loads.dissipations.push(Term { name: damper.name.clone(), energy });
    // the rate once more, from geometry
    let rate = scene.rate_of(&path.geometric);
    let force = scene.graph.mul(damping, rate);
    loads.dampers.push((force, path.value));
    let against = scene.graph.neg(force);
    let projected = scaled(scene, against, &path.geometric);
    loads.resisting.push(projected);
    loads.act(scene, against, &path.acts);
    let power = scene.graph.mul(force, rate);
    loads.dissipated.push(power);
    Ok(())
}

/// Free-form potentials and Rayleigh functions: there is no geometry to find their forces in another way.
fn free_forms(scene: &mut Scene, kinematics: &mut Kinematics, resolver: &mut Resolver, loads: &mut Loads) -> Found<()> {
    let model = scene.model;
    for potential in &model.potentials {
        let energy = resolver.resolve(scene, kinematics, potential.energy)?;
        loads.potentials.push(Term { name: potential.name.clone(), energy });
        let mut gradient = scene.gradient(energy);
        let change = gradient.remove(&scene.n()).unwrap_or(scene.graph.zero());
        loads.potential_change.push(change);
        let minus = scene.graph.int(-1);
        let projected = scaled(scene, minus, &gradient);
        let acts = located(scene, kinematics, resolver, (&potential.name, potential.energy), Given::Places)?;
        loads.act(scene, minus, &acts);
        loads.conservative.push(projected);
    }
    for dissipation in &model.dissipations {
        let function = resolver.resolve(scene, kinematics, dissipation.function)?;
        loads.dissipations.push(Term { name: dissipation.name.clone(), energy: function });
        let (mut projected, mut power) = (Columns::new(), Vec::new());
        for j in 0..scene.n() {
            let force = scene.by_rate(function, j);
            if scene.graph.is_zero(force) {
                continue;
            }
            let rate = scene.rate(j);
            power.push(scene.graph.mul(force, rate));
            projected.insert(j, scene.graph.neg(force));
        }
        let minus = scene.graph.int(-1);
        let acts = located(scene, kinematics, resolver, (&dissipation.name, dissipation.function), Given::Rates)?;
        loads.act(scene, minus, &acts);
        loads.resisting.push(projected);
        loads.dissipated.extend(power);
    }
    Ok(())
}

/// Forces and torques that have no potential: virtual power.
fn applied(scene: &mut Scene, kinematics: &mut Kinematics, resolver: &mut Resolver, loads: &mut Loads) -> Found<()> {
    let model = scene.model;
    for force in &model.forces {
        let acting = loads.acts.len();
        let columns = match &force.action {
            Action::AtPoint { at, value, axes } => {
                let value = resolve_vector(scene, kinematics, resolver, *value)?;
                let vector = kinematics.in_ground_axes(scene, *axes, &value);
                let columns = kinematics.jacobian(scene, *at);
                loads.acts.push(Act::Point { point: *at, force: vector });
                project(scene, &vector, &columns)
            }
            Action::OnPathway { pathway, value } => {
                let path = resolve(scene, kinematics, resolver, (&force.name, *pathway, &force.span))?;
                let value = resolver.resolve(scene, kinematics, *value)?;
                loads.act(scene, value, &path.acts);
                scaled(scene, value, &path.gradient)
            }
        };
        loads.applied.push(columns);
        loads.named.push((force.load.clone(), loads.applied.len() - 1..loads.applied.len(), acting..loads.acts.len()));
    }
    for torque in &model.torques {
        let (first, acting) = (loads.applied.len(), loads.acts.len());
        let value = resolve_vector(scene, kinematics, resolver, torque.value)?;
        let vector = kinematics.in_ground_axes(scene, torque.axes, &value);
        let columns = kinematics.turning_in_ground_axes(scene, torque.on);
        let action = project(scene, &vector, &columns);
        loads.acts.push(Act::Turn { on: torque.on, moment: vector });
        loads.applied.push(action);
        if let Some(body) = torque.reaction {
            let columns = kinematics.turning_in_ground_axes(scene, body);
            let opposite = vector.map(|e| scene.graph.neg(e));
            let reaction = project(scene, &opposite, &columns);
            loads.acts.push(Act::Turn { on: body, moment: opposite });
            loads.applied.push(reaction);
        }
        loads.named.push((format!("torques.{}", torque.name), first..loads.applied.len(), acting..loads.acts.len()));
    }
    Ok(())
}

fn resolve_vector(scene: &mut Scene, kinematics: &mut Kinematics, resolver: &mut Resolver, v: Vector) -> Found<Vector> {
    let [x, y, z] = v.map(|e| resolver.resolve(scene, kinematics, e));
    Ok([x?, y?, z?])
}

impl Loads {
    /// The generalized forces of each load, and their work in the balances. A load may be made of several forces: resultants of a distributed one, what one on
    /// a frame gives to each of its coordinates.
    pub fn by_name(&self, scene: &mut Scene, released: &[Vec<(usize, Expr)>]) -> Vec<Applied> {
        let mut paths: Vec<&String> = Vec::new();
        for (path, _, _) in &self.named {
            if !paths.contains(&path) {
                paths.push(path);
            }
        }
        let n = scene.n();
        let one = |path: &String| {
            let parts: Vec<usize> = (0..self.named.len()).filter(|k| self.named[*k].0 == *path).collect();
            let rows: Vec<Columns<Expr>> = parts.iter().flat_map(|k| self.applied[self.named[*k].1.clone()].iter().cloned()).collect();
            let forces: Vec<(usize, Expr)> = (0..n).map(|j| (j, Loads::in_direction(scene, &rows, j))).collect();
            let forces = forces.into_iter().filter(|(_, e)| !scene.graph.is_zero(*e)).collect();
            let mut works: BTreeMap<usize, Vec<Expr>> = BTreeMap::new();
            for (balance, work) in parts.iter().filter_map(|k| released.get(*k)).flatten() {
                works.entry(*balance).or_default().push(*work);
            }
            let released = works.into_iter().map(|(balance, works)| (balance, scene.graph.sum(&works))).collect();
            Applied { path: path.clone(), forces, released }
        };
        paths.into_iter().map(one).collect()
    }
    /// Notes actions times a factor.
    fn act(&mut self, scene: &mut Scene, factor: Expr, acts: &[Act]) {
        self.acts.extend(acts.iter().map(|act| act.times(scene, factor)));
    }
    /// Σ of the terms of a list of columns in one direction.
    pub fn in_direction(scene: &mut Scene, list: &[Columns<Expr>], direction: usize) -> Expr {
        let terms: Vec<Expr> = list.iter().filter_map(|c| c.get(&direction).copied()).collect();
        scene.graph.sum(&terms)
    }
    /// Σ of energies.
    pub fn total(scene: &mut Scene, terms: &[Term]) -> Expr {
        let terms: Vec<Expr> = terms.iter().map(|t| t.energy).collect();
        scene.graph.sum(&terms)
    }
}
