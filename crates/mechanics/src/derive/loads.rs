//! Generalized forces of gravity and of all elements, which meet the derivation here as a [`Stage`].
//!
//! Lagrange's way: potentials Π, dissipation function Φ, virtual power of the rest. Newton-Euler's way: every element is a pair of forces
//! (or torques) projected with the velocities of the points (or bodies) it acts on.

use crate::connections::pretension;
use crate::model::{Element, FrameId, Pathway, PointRef, Push, Stage, Way};
use crate::scene::kinematics::Kinematics;
use crate::scene::pathways::{Given, Path, located, resolve};
use crate::scene::requests::Resolver;
use crate::scene::start::at_start;
use crate::scene::wrench::Act;
use crate::scene::{Columns, Found, Scene, Vector};
use std::collections::BTreeMap;
use std::ops::Range;
use symbolic::equations::Applied;
use symbolic::{Expr, Graph};
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
    /// What each element tells of itself, by its handle.
    pub told: Vec<Vec<Expr>>,
}

/// Collects everything that acts.
///
/// *Errors*: those of all elements.
pub fn collect(scene: &mut Scene, kinematics: &mut Kinematics, resolver: &mut Resolver) -> Result<Loads, Vec<Notice>> {
    let mut loads = Loads::default();
    let mut errors = Vec::new();
    gravity(scene, kinematics, &mut loads);
    let model = scene.model;
    loads.told = vec![Vec::new(); model.elements.len()];
    for (id, element) in model.acting() {
        let (applied, acting) = (loads.applied.len(), loads.acts.len());
        let mut stage = At { scene, kinematics, resolver, loads: &mut loads, element, ways: Vec::new() };
        match element.law.act(&mut stage) {
            Ok(told) => loads.told[id.0] = told,
            Err(fault) => errors.push(*fault),
        }
        if loads.applied.len() > applied {
            loads.named.push((element.path.clone(), applied..loads.applied.len(), acting..loads.acts.len()));
        }
    }
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
        let center = PointRef::Center(FrameId(i));
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

/// factor·gradient.
fn scaled(scene: &mut Scene, factor: Expr, gradient: &Columns<Expr>) -> Columns<Expr> {
    gradient.iter().map(|(j, d)| (*j, scene.graph.mul(factor, *d))).collect()
}

/// A derivation as one element sees it.
struct At<'d, 's, 'm> {
    scene: &'d mut Scene<'m>,
    kinematics: &'d mut Kinematics,
    resolver: &'d mut Resolver,
    loads: &'s mut Loads,
    element: &'m Element,
    ways: Vec<Path>,
}

impl At<'_, '_, '_> {
    /// A force along a pathway on bodies and, by geometry, in each direction.
    fn put(&mut self, push: Push) -> Columns<Expr> {
        let path = &self.ways[push.way.number];
        self.loads.act(self.scene, push.force, &path.acts);
        scaled(self.scene, push.force, &path.geometric)
    }
}

impl Stage for At<'_, '_, '_> {
    fn graph(&mut self) -> &mut Graph {
        &mut self.scene.graph
    }

    fn open(&mut self, e: Expr) -> Found<Expr> {
        self.resolver.resolve(self.scene, self.kinematics, e)
    }

    fn way(&mut self, pathway: Pathway) -> Found<Way> {
        let path = resolve(self.scene, self.kinematics, self.resolver, (&self.element.name, pathway, &self.element.span))?;
        let way = Way { value: path.value, number: self.ways.len() };
        self.ways.push(path);
        Ok(way)
    }

    fn rates(&mut self, way: Way) -> [Expr; 2] {
        let path = &self.ways[way.number];
        [self.scene.rate_of(&path.gradient), self.scene.rate_of(&path.geometric)]
    }

    fn rate_of(&mut self, e: Expr) -> Expr {
        let gradient = self.scene.gradient(e);
        self.scene.rate_of(&gradient)
    }

    fn at_start(&mut self, e: Expr) -> Expr {
        at_start(self.scene, &self.element.name, e)
    }

    fn in_ground_axes(&mut self, axes: FrameId, v: Vector) -> Vector {
        self.kinematics.in_ground_axes(self.scene, axes, &v)
    }

    fn store(&mut self, energy: Expr, force: Push) {
        self.loads.potentials.push(Term { name: self.element.name.clone(), energy });
        let projected = self.put(force);
        self.loads.conservative.push(projected);
        let change = self.scene.along(energy, self.scene.n());
        self.loads.potential_change.push(change);
    }

    fn dissipate(&mut self, function: Expr, force: Push) {
        self.loads.dissipations.push(Term { name: self.element.name.clone(), energy: function });
        let projected = self.put(force);
        self.loads.resisting.push(projected);
        // the power that the force takes out, from velocities
        let rate = self.scene.rate_of(&self.ways[force.way.number].geometric);
        let against = self.scene.graph.neg(force.force);
        let power = self.scene.graph.mul(against, rate);
        self.loads.dissipated.push(power);
    }

    fn push(&mut self, push: Push) {
        let path = &self.ways[push.way.number];
        self.loads.act(self.scene, push.force, &path.acts);
        let columns = scaled(self.scene, push.force, &path.gradient);
        self.loads.applied.push(columns);
    }

    fn pull(&mut self, at: PointRef, force: Vector) {
        let columns = self.kinematics.jacobian(self.scene, at);
        self.loads.acts.push(Act::Point { point: at, force });
        let projected = project(self.scene, &force, &columns);
        self.loads.applied.push(projected);
    }

    fn turn(&mut self, on: FrameId, moment: Vector) {
        let columns = self.kinematics.turning_in_ground_axes(self.scene, on);
        let projected = project(self.scene, &moment, &columns);
        self.loads.acts.push(Act::Turn { on, moment });
        self.loads.applied.push(projected);
    }

    fn store_by_places(&mut self, formula: Expr) -> Found<()> {
        let energy = self.open(formula)?;
        self.loads.potentials.push(Term { name: self.element.name.clone(), energy });
        let mut gradient = self.scene.gradient(energy);
        let change = gradient.remove(&self.scene.n()).unwrap_or(self.scene.graph.zero());
        self.loads.potential_change.push(change);
        let minus = self.scene.graph.int(-1);
        let projected = scaled(self.scene, minus, &gradient);
        let acts = located(self.scene, self.kinematics, self.resolver, (&self.element.name, formula), Given::Places)?;
        self.loads.act(self.scene, minus, &acts);
        self.loads.conservative.push(projected);
        Ok(())
    }

    fn dissipate_by_rates(&mut self, formula: Expr) -> Found<()> {
        let function = self.open(formula)?;
        self.loads.dissipations.push(Term { name: self.element.name.clone(), energy: function });
        let (mut projected, mut power) = (Columns::new(), Vec::new());
        for j in 0..self.scene.n() {
            let force = self.scene.by_rate(function, j);
            if self.scene.graph.is_zero(force) {
                continue;
            }
            let rate = self.scene.rate(j);
            power.push(self.scene.graph.mul(force, rate));
            projected.insert(j, self.scene.graph.neg(force));
        }
        let minus = self.scene.graph.int(-1);
        let acts = located(self.scene, self.kinematics, self.resolver, (&self.element.name, formula), Given::Rates)?;
        self.loads.act(self.scene, minus, &acts);
        self.loads.resisting.push(projected);
        self.loads.dissipated.extend(power);
        Ok(())
    }
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
