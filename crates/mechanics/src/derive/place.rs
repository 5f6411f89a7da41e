//! The place of a load that is given by a formula of coordinates.
//!
//! Such a load has generalized forces Q_j and no point. It acts between the body that the coordinate moves and what this body stands on, along the
//! body's own displacement: with the columns v_j of the velocity of the body's origin and w_j of its angular velocity, both relative to what it
//! stands on,
//!
//! ```text
//! F = Σ_a v_a (G⁻¹ Q)_a,   G_ab = v_a·v_b     coordinates that shift the body
//! C = Σ_a w_a (H⁻¹ Q)_a,   H_ab = w_a·w_b     coordinates that turn it
//! ```
//!
//! What Q leaves open stays an unknown of the balances, a wrench that does no work on the coordinates: the moment of F about the origin, the body
//! among several that one coordinate moves, the force across the displacement where the pathway is not measured along it. A reaction that can be
//! told from these unknowns has its value; another has none.

use super::kinematics::Kinematics;
use super::pathways::unit_vector;
use super::scene::{Columns, Scene, Vector};
use super::wrench::{Act, Along, Formula, carrier};
use crate::model::{Axis, FrameId, Measure};
use std::collections::{BTreeMap, BTreeSet};
use symbolic::{Expr, Function, Node};

/// A wrench that a load may have besides what its formula says.
#[derive(Clone, Debug)]
pub struct Open {
    /// The load.
    pub name: String,
    /// Per unit.
    pub acts: Vec<Act>,
}

/// How a body moves on what it stands on.
struct Own {
    /// Velocity of the origin, ground axes, by coordinates that do not turn the body.
    shifts: Columns<Vector>,
    /// Angular velocity, by coordinates that do not shift the origin.
    turns: Columns<Vector>,
    /// Both, by coordinates that do both.
    both: Columns<(Vector, Vector)>,
}

/// Finds places; knows how every body moves.
pub struct Placer {
    own: Vec<Own>,
    spatial: bool,
    /// What loads leave open.
    pub open: Vec<Open>,
}

impl Placer {
    /// Looks at all frames.
    pub fn new(scene: &mut Scene, kinematics: &Kinematics, spatial: bool) -> Placer {
        let own = (0..scene.model.frames.len()).map(|i| own(scene, kinematics, FrameId(i))).collect();
        Placer { own, spatial, open: Vec::new() }
    }

    /// The actions with forces and moments in place of formulas.
    pub fn place(&mut self, scene: &mut Scene, kinematics: &mut Kinematics, acts: &[Act]) -> Vec<Act> {
        let mut placed = Vec::new();
        for act in acts {
            let Act::Along(along) = act else {
                placed.push(act.clone());
                continue;
            };
            for part in separate(scene, along) {
                placed.extend(self.part(scene, kinematics, &part));
            }
        }
        placed
    }

    fn part(&mut self, scene: &mut Scene, kinematics: &mut Kinematics, along: &Along) -> Vec<Act> {
        let mut by_frame: BTreeMap<FrameId, Columns<Expr>> = BTreeMap::new();
        let n = scene.n();
        for (&j, &force) in along.columns.range(..n) {
            let moved: Vec<FrameId> = (0..self.own.len()).map(FrameId).filter(|f| self.own[f.index()].has(j)).collect();
            let fitting: Vec<FrameId> = moved.iter().copied().filter(|f| self.fits(scene, along, (*f, j))).collect();
            let Some(&first) = fitting.first().or(moved.first()) else { continue };
            if moved.len() > 1 && fitting.len() != 1 {
                self.leave_sharing(scene, kinematics, &along.name, (j, &moved));
            }
            by_frame.entry(first).or_default().insert(j, force);
        }
        let chosen: BTreeSet<FrameId> = by_frame.keys().copied().collect();
        let mut acts = Vec::new();
        for (frame, forces) in by_frame {
            let nested = carriers(scene, frame).any(|f| chosen.contains(&f));
            acts.extend(self.act(scene, kinematics, along, (frame, &forces, nested)));
        }
        acts
    }

    /// Whether the pathway is measured along the displacement that the coordinate gives to the body.
    fn fits(&self, scene: &mut Scene, along: &Along, (frame, j): (FrameId, usize)) -> bool {
        let Formula::Pathway(gradient, measure) = &along.of else { return false };
        let Some(&slope) = gradient.get(&j) else { return false };
        let own = &self.own[frame.index()];
        let column = match measure {
            Measure::Length => own.shifts.get(&j).or(own.both.get(&j).map(|b| &b.0)),
            Measure::Angle => own.turns.get(&j).or(own.both.get(&j).map(|b| &b.1)),
            Measure::Other => None,
        };
        let Some(column) = column.copied() else { return false };
        let (square, length) = (scene.graph.square(slope), scene.dot(&column, &column));
        let difference = scene.graph.sub(square, length);
        let difference = scene.tidy(difference);
        scene.graph.is_zero(difference)
    }

    /// Several bodies move with one coordinate: any of them may take the load.
    fn leave_sharing(&mut self, scene: &mut Scene, kinematics: &mut Kinematics, name: &str, (j, moved): (usize, &[FrameId])) {
        let one = scene.graph.one();
        let unit = |this: &Placer, scene: &mut Scene, f: FrameId| this.wrench(scene, kinematics, f, &Columns::from([(j, one)]));
        let Some((first, others)) = moved.split_first() else { return };
        let minus = scene.graph.int(-1);
        let given: Vec<Act> = unit(self, scene, *first).iter().map(|act| act.times(scene, minus)).collect();
        for other in others {
            let acts = unit(self, scene, *other).into_iter().chain(given.iter().cloned()).collect();
            self.leave(name, acts);
        }
        for frame in others {
            self.leave_everything_across(scene, kinematics, name, *frame);
        }
    }

    /// The wrench with these generalized forces on a body: along its own displacement.
    fn wrench(&self, scene: &mut Scene, kinematics: &Kinematics, frame: FrameId, forces: &Columns<Expr>) -> Vec<Act> {
        let own = &self.own[frame.index()];
        let mut acts = Vec::new();
        let force = dual(scene, &own.shifts, forces);
        acts.extend(force.map(|force| pair_of_forces(scene, kinematics, frame, force)).into_iter().flatten());
        let moment = dual(scene, &own.turns, forces);
        acts.extend(moment.map(|moment| pair_of_moments(scene, frame, moment)).into_iter().flatten());
        for (j, (shift, _)) in own.both.iter().filter(|(j, _)| forces.contains_key(j)) {
            let force = dual(scene, &Columns::from([(*j, *shift)]), forces);
            acts.extend(force.map(|force| pair_of_forces(scene, kinematics, frame, force)).into_iter().flatten());
        }
        acts
    }

    fn act(
        &mut self,
        scene: &mut Scene,
        kinematics: &mut Kinematics,
        along: &Along,
        (frame, forces, nested): (FrameId, &Columns<Expr>, bool),
    ) -> Vec<Act> {
        let own = &self.own[frame.index()];
        if !own.both.is_empty() {
            return self.screw(scene, kinematics, along, (frame, forces));
        }
        let shifts: Columns<Vector> = own.shifts.clone();
        let turns: Columns<Vector> = own.turns.clone();
        let acts = self.wrench(scene, kinematics, frame, forces);
        if forces.keys().any(|j| shifts.contains_key(j)) {
            self.leave_moments(scene, &along.name, (frame, &turns));
            if nested || !self.is_measured_along(scene, along, &shifts) {
                self.leave_forces(scene, kinematics, &along.name, (frame, &shifts));
            }
        }
        // a couple turns about the body's own axes; a force that turns it has a part at the axle and, in space, across the axes
        if forces.keys().any(|j| turns.contains_key(j)) && is_a_force(scene, along, &turns) {
            self.leave_moments(scene, &along.name, (frame, &turns));
            self.leave_forces(scene, kinematics, &along.name, (frame, &shifts));
        }
        acts
    }

    /// One coordinate that both shifts and turns: a length acts at the origin, an angle by a couple; of anything else the place is open.
    fn screw(
        &mut self,
        scene: &mut Scene,
        kinematics: &mut Kinematics,
        along: &Along,
        (frame, forces): (FrameId, &Columns<Expr>),
    ) -> Vec<Act> {
        let own = &self.own[frame.index()];
        let single = own.both.len() == 1 && own.shifts.is_empty() && own.turns.is_empty();
        let fits = single && forces.keys().all(|j| self.fits(scene, along, (frame, *j)));
        let by_angle = matches!(&along.of, Formula::Pathway(_, Measure::Angle));
        let own = &self.own[frame.index()];
        if fits && by_angle {
            let turns: Columns<Vector> = own.both.iter().map(|(j, b)| (*j, b.1)).collect();
            let moment = dual(scene, &turns, forces);
            return moment.map(|moment| pair_of_moments(scene, frame, moment)).into_iter().flatten().collect();
        }
        let acts = self.wrench(scene, kinematics, frame, forces);
        if !fits {
            self.leave_everything(scene, kinematics, &along.name, frame);
        }
        acts
    }

    /// Whether the pathway changes in a constant ratio to the way of the origin; a function has no direction of its own.
    fn is_measured_along(&self, scene: &mut Scene, along: &Along, shifts: &Columns<Vector>) -> bool {
        let Formula::Pathway(gradient, _) = &along.of else { return true };
        let Some(slope) = dual(scene, shifts, gradient) else { return true };
        let square = scene.dot(&slope, &slope);
        let square = scene.tidy(square);
        let changes = scene.gradient(square);
        let n = scene.n();
        let mut changes = changes.into_iter().filter(|(j, _)| *j < n);
        changes.all(|(_, e)| {
            let e = scene.tidy(e);
            scene.graph.is_zero(e)
        })
    }

    /// Moments about axes about which the body does not turn by its own coordinates.
    fn leave_moments(&mut self, scene: &mut Scene, name: &str, (frame, turns): (FrameId, &Columns<Vector>)) {
        for axis in self.moments() {
            if let Some(moment) = across(scene, turns, *axis) {
                let acts = pair_of_moments(scene, frame, moment);
                self.leave(name, acts.to_vec());
            }
        }
    }

    /// Forces across the body's own displacement.
    fn leave_forces(&mut self, scene: &mut Scene, kinematics: &Kinematics, name: &str, (frame, shifts): (FrameId, &Columns<Vector>)) {
        for axis in self.forces() {
            if let Some(force) = across(scene, shifts, *axis) {
                let acts = pair_of_forces(scene, kinematics, frame, force);
                self.leave(name, acts.to_vec());
            }
        }
    }

    fn leave_everything_across(&mut self, scene: &mut Scene, kinematics: &Kinematics, name: &str, frame: FrameId) {
        let own = &self.own[frame.index()];
        if !own.both.is_empty() {
            return self.leave_everything(scene, kinematics, name, frame);
        }
        let (shifts, turns) = (own.shifts.clone(), own.turns.clone());
        if !shifts.is_empty() {
            self.leave_moments(scene, name, (frame, &turns));
        }
        if !turns.is_empty() {
            self.leave_forces(scene, kinematics, name, (frame, &shifts));
        }
    }

    fn leave_everything(&mut self, scene: &mut Scene, kinematics: &Kinematics, name: &str, frame: FrameId) {
        self.leave_forces(scene, kinematics, name, (frame, &Columns::new()));
        self.leave_moments(scene, name, (frame, &Columns::new()));
    }

    fn leave(&mut self, name: &str, acts: Vec<Act>) {
        if !self.open.iter().any(|o| o.acts == acts) {
            self.open.push(Open { name: name.to_owned(), acts });
        }
    }

    fn forces(&self) -> &'static [Axis] {
        if self.spatial { &[Axis::X, Axis::Y, Axis::Z] } else { &[Axis::X, Axis::Y] }
    }
    fn moments(&self) -> &'static [Axis] {
        if self.spatial { &[Axis::X, Axis::Y, Axis::Z] } else { &[Axis::Z] }
    }
}

impl Own {
    fn has(&self, j: usize) -> bool {
        self.shifts.contains_key(&j) || self.turns.contains_key(&j) || self.both.contains_key(&j)
    }
}

/// Motion of a frame on what it stands on, by its own coordinates.
fn own(scene: &mut Scene, kinematics: &Kinematics, frame: FrameId) -> Own {
    let mut own = Own { shifts: Columns::new(), turns: Columns::new(), both: Columns::new() };
    if frame == FrameId::GROUND {
        return own;
    }
    let model = scene.model;
    let local = match model.frames[frame.index()].origin {
        crate::model::Origin::Vector(v) => v,
        crate::model::Origin::Point(p) => model.points[p.index()].at,
    };
    let local = scene.open_vector(local);
    let mut shifts: Columns<Vector> = Columns::new();
    for (i, component) in local.iter().enumerate() {
        for (j, derivative) in scene.gradient(*component) {
            let zero = scene.zero_vector();
            shifts.entry(j).or_insert(zero)[i] = derivative;
        }
    }
    let base = carrier(model, frame);
    let shifts: Columns<Vector> = shifts.into_iter().map(|(j, v)| (j, kinematics.in_ground_axes(scene, base, &v))).collect();
    let mut turns = kinematics.turning_in_ground_axes(scene, frame);
    for (j, w) in kinematics.turning_in_ground_axes(scene, model.frames[frame.index()].on) {
        let zero = scene.zero_vector();
        let column = turns.entry(j).or_insert(zero);
        *column = scene.minus(column, &w);
    }
    let n = scene.n();
    for j in 0..n {
        let zero = scene.zero_vector();
        let mut of = |columns: &Columns<Vector>| columns.get(&j).copied().unwrap_or(zero).map(|e| scene.tidy(e));
        let (v, w) = (of(&shifts), of(&turns));
        match (v != zero, w != zero) {
            (true, true) => drop(own.both.insert(j, (v, w))),
            (true, false) => drop(own.shifts.insert(j, v)),
            (false, true) => drop(own.turns.insert(j, w)),
            (false, false) => {}
        }
    }
    own
}

/// What a frame stands on, down to the ground.
fn carriers<'s>(scene: &'s Scene, frame: FrameId) -> impl Iterator<Item = FrameId> + 's {
    let below = |f: &FrameId| (*f != FrameId::GROUND).then(|| carrier(scene.model, *f));
    std::iter::successors(below(&frame), move |f| below(f))
}

/// Σ_a column_a (G⁻¹ Q)_a with G_ab = column_a·column_b; none where no force is on these columns. At most three columns, as space has dimensions.
fn dual(scene: &mut Scene, columns: &Columns<Vector>, forces: &Columns<Expr>) -> Option<Vector> {
    if !columns.keys().any(|j| forces.contains_key(j)) {
        return None;
    }
    // Gram-Schmidt: e_a from v_a less its shares of the earlier; q_a alike
    let mut basis: Vec<(Vector, Expr, Expr)> = Vec::new();
    let mut sum = scene.zero_vector();
    for (j, column) in columns {
        let mut e = *column;
        let mut q = forces.get(j).copied().unwrap_or_else(|| scene.graph.zero());
        for (b, square, force) in &basis {
            let share = scene.dot(b, column);
            let share = scene.graph.div(share, *square);
            let share = scene.tidy(share);
            let part = b.map(|c| scene.graph.mul(share, c));
            e = scene.minus(&e, &part);
            let part = scene.graph.mul(share, *force);
            q = scene.graph.sub(q, part);
        }
        let e = e.map(|c| scene.tidy(c));
        let square = scene.dot(&e, &e);
        let square = scene.tidy(square);
        if scene.graph.is_zero(square) {
            continue;
        }
        let size = scene.graph.div(q, square);
        let part = e.map(|c| scene.graph.mul(size, c));
        sum = scene.plus(&sum, &part);
        basis.push((e, square, q));
    }
    Some(sum)
}

/// The part of an axis of the ground that is perpendicular to all columns; none where nothing is left.
fn across(scene: &mut Scene, columns: &Columns<Vector>, axis: Axis) -> Option<Vector> {
    let unit = unit_vector(scene, axis);
    let work: Columns<Expr> = columns.iter().map(|(j, column)| (*j, column[axis.index()])).collect();
    let rest = match dual(scene, columns, &work) {
        Some(along) => scene.minus(&unit, &along),
        None => unit,
    };
    let rest = rest.map(|e| scene.tidy(e));
    rest.iter().any(|e| !scene.graph.is_zero(*e)).then_some(rest)
}

fn pair_of_forces(scene: &mut Scene, kinematics: &Kinematics, frame: FrameId, force: Vector) -> [Act; 2] {
    let at = kinematics.frames[frame.index()].origin;
    let against = force.map(|e| scene.graph.neg(e));
    [Act::Place { on: frame, at, force }, Act::Place { on: carrier(scene.model, frame), at, force: against }]
}

fn pair_of_moments(scene: &mut Scene, frame: FrameId, moment: Vector) -> [Act; 2] {
    let against = moment.map(|e| scene.graph.neg(e));
    [Act::Turn { on: frame, moment }, Act::Turn { on: scene.model.frames[frame.index()].on, moment: against }]
}

/// Whether a generalized force on an angle may be that of a force and not of a couple: the pathway is no angle, or the function follows the places
/// of points (it is periodic in the angle).
fn is_a_force(scene: &mut Scene, along: &Along, turns: &Columns<Vector>) -> bool {
    if let Formula::Pathway(_, measure) = &along.of {
        return *measure != Measure::Angle;
    }
    let forces: Vec<Expr> = along.columns.iter().filter(|(j, _)| turns.contains_key(j)).map(|(_, e)| *e).collect();
    let angles: Vec<_> = turns.keys().map(|j| scene.model.coordinates[*j].symbols[0]).collect();
    scene.graph.reachable(&forces).into_iter().any(|e| match scene.graph.node(e) {
        Node::Call { function: Function::Sin | Function::Cos, .. } => angles.iter().any(|a| scene.graph.contains(e, |s| s == *a)),
        _ => false,
    })
}

/// A function falls into the parts that do not know of each other.
fn separate(scene: &mut Scene, along: &Along) -> Vec<Along> {
    if matches!(along.of, Formula::Pathway(..)) {
        return vec![along.clone()];
    }
    let mut parts: Vec<(BTreeSet<usize>, Columns<Expr>)> = Vec::new();
    for (&j, &force) in &along.columns {
        let mut touched: BTreeSet<usize> = BTreeSet::from([j]);
        for (k, c) in scene.model.coordinates.iter().enumerate() {
            if scene.graph.contains(force, |s| c.symbols.contains(&s)) {
                touched.insert(k);
            }
        }
        let mut columns = Columns::from([(j, force)]);
        parts.retain(|(others, more)| {
            let joined = !others.is_disjoint(&touched);
            if joined {
                touched.extend(others);
                columns.extend(more.iter().map(|(k, e)| (*k, *e)));
            }
            !joined
        });
        parts.push((touched, columns));
    }
    parts.into_iter().map(|(_, columns)| Along { columns, ..along.clone() }).collect()
}
