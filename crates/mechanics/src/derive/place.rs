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
//!
//! A coordinate that moves several bodies does so by a transmission. Where no connection declares it, its wrenches are unknown in the same way.

use crate::model::{Axis, FrameId, Measure, PointRef};
use crate::scene::kinematics::Kinematics;
use crate::scene::pathways::unit_vector;
use crate::scene::wrench::{Act, Along, Formula, carrier};
use crate::scene::{Columns, Scene, Vector, is_spatial};
use std::collections::{BTreeMap, BTreeSet};
use symbolic::{Expr, Function, Node};

/// A wrench that a load may have besides what its formula says, or that a transmission may have.
#[derive(Clone, Debug)]
pub struct Open {
    /// What has it.
    pub of: Opening,
    /// Per unit.
    pub acts: Vec<Act>,
}

/// Whose wrench is open.
#[derive(Clone, PartialEq, Debug)]
pub enum Opening {
    /// A load.
    Load(String),
    /// What makes bodies follow one coordinate.
    Transmission {
        /// The coordinate.
        coordinate: String,
        /// Names of the bodies.
        bodies: Vec<String>,
    },
}

impl Opening {
    /// The load or the coordinate.
    pub fn name(&self) -> &str {
        match self {
            Opening::Load(name) => name,
            Opening::Transmission { coordinate, .. } => coordinate,
        }
    }
}

/// How a body moves on what it stands on.
pub struct Own {
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
    pub fn new(scene: &mut Scene, kinematics: &Kinematics) -> Placer {
        let own = (0..scene.model.frames.len()).map(|i| own(scene, kinematics, FrameId(i))).collect();
        Placer { own, spatial: is_spatial(scene.model), open: Vec::new() }
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

    /// Leaves the wrenches open by which a coordinate moves several bodies at once.
    pub fn transmit(&mut self, scene: &mut Scene, kinematics: &mut Kinematics, (j, moved): (usize, &[FrameId])) {
        let bodies = moved.iter().map(|f| scene.model.frames[f.index()].name.clone()).collect();
        let of = Opening::Transmission { coordinate: scene.model.coordinates[j].name.clone(), bodies };
        self.leave_sharing(scene, kinematics, &of, (j, moved, &[]));
    }

    fn part(&mut self, scene: &mut Scene, kinematics: &mut Kinematics, along: &Along) -> Vec<Act> {
        let mut by_frame: BTreeMap<FrameId, Columns<Expr>> = BTreeMap::new();
        let mut touched: BTreeSet<FrameId> = BTreeSet::new();
        let of = Opening::Load(along.name.clone());
        let (n, mut measured) = (scene.n(), true);
        for (&j, &force) in along.columns.range(..n) {
            let moved = self.moved(j);
            let fitting: Vec<FrameId> = moved.iter().copied().filter(|f| self.fits(scene, along, (*f, j))).collect();
            let Some(&first) = fitting.first().or(moved.first()) else { continue };
            measured &= fitting.len() == 1;
            if moved.len() > 1 && fitting.len() != 1 {
                self.leave_sharing(scene, kinematics, &of, (j, &moved, &fitting));
                touched.extend(&moved);
            }
            touched.insert(first);
            by_frame.entry(first).or_default().insert(j, force);
        }
        let mut acts = Vec::new();
        for (frame, forces) in by_frame {
            acts.extend(self.act(scene, kinematics, along, (frame, &forces)));
        }
        if touched.len() > 1 && !measured {
            self.leave_between(scene, kinematics, along, &touched);
        }
        acts
    }

    /// The frames that a coordinate moves on what they stand on.
    pub fn moved(&self, j: usize) -> Vec<FrameId> {
        (0..self.own.len()).map(FrameId).filter(|f| self.own[f.index()].has(j)).collect()
    }

    /// How a frame moves on what it stands on.
    pub fn own(&self, frame: FrameId) -> &Own {
        &self.own[frame.index()]
    }

    /// A load on several bodies whose pathway is not the sum of their ways: it may act between two of them, or between one and the ground, and
    /// then in any direction that the displacements of all of them span.
    fn leave_between(&mut self, scene: &mut Scene, kinematics: &mut Kinematics, along: &Along, touched: &BTreeSet<FrameId>) {
        let couples = touched.iter().all(|f| self.own[f.index()].turns_only());
        if couples && !touched.iter().any(|f| is_a_force(scene, along, &self.own[f.index()].turns.clone())) {
            return;
        }
        let mut directions: Vec<Vector> = Vec::new();
        for frame in touched {
            let own = &self.own[frame.index()];
            let (shifts, straight) = (own.shifts.clone(), own.shifts_only());
            if !straight || !self.is_measured_along(scene, along, &shifts) {
                directions = self.forces().iter().map(|axis| unit_vector(scene, *axis)).collect();
                break;
            }
            directions.extend(shifts.values());
        }
        let of = Opening::Load(along.name.clone());
        for frame in touched {
            let own = self.own[frame.index()].shifts.clone();
            let n = scene.n();
            let mut whole = kinematics.jacobian(scene, PointRef::Origin(*frame));
            whole.remove(&n);
            let mut turning = kinematics.turning_in_ground_axes(scene, *frame);
            turning.remove(&n);
            for direction in &directions {
                if let Some(force) = perpendicular(scene, &own, direction) {
                    let acts = pair_of_forces(scene, kinematics, *frame, force);
                    self.leave(&of, acts.to_vec());
                }
                if let Some(force) = perpendicular(scene, &whole, direction) {
                    let at = kinematics.frames[frame.index()].origin;
                    self.leave(&of, vec![Act::Place { on: *frame, at, force }]);
                }
            }
            for axis in self.moments() {
                if let Some(moment) = across(scene, &turning, *axis) {
                    self.leave(&of, vec![Act::Turn { on: *frame, moment }]);
                }
            }
        }
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
        scene.vanishes(difference)
    }

    /// Several bodies move with one coordinate: any of them may take the load, along its displacement if the pathway fits it, else in any direction. What goes over from one to another has no work in
    /// sum: with the own displacements (v, w) of both it is (v_b², w_b²) (v_a, w_a) against (v_a², w_a²) (v_b, w_b), no quotient at dead positions.
    fn leave_sharing(
        &mut self,
        scene: &mut Scene,
        kinematics: &mut Kinematics,
        of: &Opening,
        (j, moved, fitting): (usize, &[FrameId], &[FrameId]),
    ) {
        let Some((first, others)) = moved.split_first() else { return };
        let minus = scene.graph.int(-1);
        for other in others {
            let columns = [*first, *other].map(|f| self.own[f.index()].column(scene, j));
            let [Some(a), Some(b)] = columns else { continue };
            let sizes = [a, b].map(|(v, w)| {
                let main = if v == scene.zero_vector() { w } else { v };
                let square = scene.dot(&main, &main);
                scene.tidy(square)
            });
            let taken = scene.graph.mul(minus, sizes[1]);
            let mut acts = pull(scene, kinematics, *first, a, taken);
            acts.extend(pull(scene, kinematics, *other, b, sizes[0]));
            self.leave(of, acts);
        }
        for frame in moved {
            let own = &self.own[frame.index()];
            if fitting.contains(frame) && own.shifts_only() {
                self.leave_moments(scene, of, (*frame, &Columns::new()));
            } else {
                self.leave_everything_across(scene, kinematics, of, *frame);
            }
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
        (frame, forces): (FrameId, &Columns<Expr>),
    ) -> Vec<Act> {
        let own = &self.own[frame.index()];
        if !own.both.is_empty() {
            return self.screw(scene, kinematics, along, (frame, forces));
        }
        let shifts: Columns<Vector> = own.shifts.clone();
        let turns: Columns<Vector> = own.turns.clone();
        let acts = self.wrench(scene, kinematics, frame, forces);
        let of = Opening::Load(along.name.clone());
        if forces.keys().any(|j| shifts.contains_key(j)) {
            self.leave_moments(scene, &of, (frame, &turns));
            if !self.is_measured_along(scene, along, &shifts) {
                self.leave_forces(scene, kinematics, &of, (frame, &shifts));
            }
        }
        // a couple turns about the body's own axes; a force that turns it has a part at the axle and, in space, across the axes
        if forces.keys().any(|j| turns.contains_key(j)) && is_a_force(scene, along, &turns) {
            self.leave_moments(scene, &of, (frame, &turns));
            self.leave_forces(scene, kinematics, &of, (frame, &shifts));
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
            self.leave_everything(scene, kinematics, &Opening::Load(along.name.clone()), frame);
        }
        acts
    }

    /// Whether the pathway is measured along the way of the origin: a length equals this way, anything else changes in a constant ratio to it. A
    /// function has no direction of its own.
    fn is_measured_along(&self, scene: &mut Scene, along: &Along, shifts: &Columns<Vector>) -> bool {
        let Formula::Pathway(gradient, measure) = &along.of else { return true };
        let Some(slope) = dual(scene, shifts, gradient) else { return true };
        let square = scene.dot(&slope, &slope);
        if *measure == Measure::Length {
            let one = scene.graph.one();
            let difference = scene.graph.sub(square, one);
            return scene.vanishes(difference);
        }
        let square = scene.tidy(square);
        let changes = scene.gradient(square);
        let n = scene.n();
        let mut changes = changes.into_iter().filter(|(j, _)| *j < n);
        changes.all(|(_, e)| scene.vanishes(e))
    }

    /// Moments about axes about which the body does not turn by its own coordinates.
    fn leave_moments(&mut self, scene: &mut Scene, of: &Opening, (frame, turns): (FrameId, &Columns<Vector>)) {
        for axis in self.moments() {
            if let Some(moment) = across(scene, turns, *axis) {
                let acts = pair_of_moments(scene, frame, moment);
                self.leave(of, acts.to_vec());
            }
        }
    }

    /// Forces across the body's own displacement.
    fn leave_forces(&mut self, scene: &mut Scene, kinematics: &Kinematics, of: &Opening, (frame, shifts): (FrameId, &Columns<Vector>)) {
        for axis in self.forces() {
            if let Some(force) = across(scene, shifts, *axis) {
                let acts = pair_of_forces(scene, kinematics, frame, force);
                self.leave(of, acts.to_vec());
            }
        }
    }

    fn leave_everything_across(&mut self, scene: &mut Scene, kinematics: &Kinematics, of: &Opening, frame: FrameId) {
        let own = &self.own[frame.index()];
        if !own.both.is_empty() {
            return self.leave_everything(scene, kinematics, of, frame);
        }
        let (shifts, turns) = (own.shifts.clone(), own.turns.clone());
        self.leave_moments(scene, of, (frame, &turns));
        self.leave_forces(scene, kinematics, of, (frame, &shifts));
    }

    fn leave_everything(&mut self, scene: &mut Scene, kinematics: &Kinematics, of: &Opening, frame: FrameId) {
        self.leave_forces(scene, kinematics, of, (frame, &Columns::new()));
        self.leave_moments(scene, of, (frame, &Columns::new()));
    }

    fn leave(&mut self, of: &Opening, acts: Vec<Act>) {
        if !self.open.iter().any(|o| o.acts == acts) {
            self.open.push(Open { of: of.clone(), acts });
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
    /// The displacement by a coordinate: velocity of the origin and angular velocity per unit of its rate, ground axes.
    pub fn column(&self, scene: &mut Scene, j: usize) -> Option<(Vector, Vector)> {
        let zero = scene.zero_vector();
        let shift = self.shifts.get(&j).map(|v| (*v, zero));
        shift.or(self.turns.get(&j).map(|w| (zero, *w))).or(self.both.get(&j).copied())
    }
    /// The coordinates.
    pub fn coordinates(&self) -> BTreeSet<usize> {
        self.shifts.keys().chain(self.turns.keys()).chain(self.both.keys()).copied().collect()
    }
    fn shifts_only(&self) -> bool {
        self.turns.is_empty() && self.both.is_empty()
    }
    fn turns_only(&self) -> bool {
        self.shifts.is_empty() && self.both.is_empty()
    }
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
        if scene.vanishes(square) {
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
    perpendicular(scene, columns, &unit)
}

/// The part of a vector that is perpendicular to all columns, times a factor that leaves no quotient; none where nothing is left.
fn perpendicular(scene: &mut Scene, columns: &Columns<Vector>, vector: &Vector) -> Option<Vector> {
    let mut span: Vec<Vector> = Vec::new();
    for column in columns.values() {
        span.push(*column);
        if scene.rank(&span) < span.len() {
            span.pop();
        }
    }
    let rest = match span[..] {
        [] => *vector,
        // a² u - a (a·u)
        [a] => {
            let (square, share) = (scene.dot(&a, &a), scene.dot(&a, vector));
            let (whole, along) = (vector.map(|e| scene.graph.mul(square, e)), a.map(|e| scene.graph.mul(share, e)));
            scene.minus(&whole, &along)
        }
        // c (c·u) with c = a × b
        [a, b] => {
            let normal = scene.cross(&a, &b);
            let share = scene.dot(&normal, vector);
            normal.map(|e| scene.graph.mul(share, e))
        }
        _ => return None,
    };
    let rest = rest.map(|e| scene.tidy(e));
    let left = rest.map(|e| !scene.vanishes(e));
    left.contains(&true).then_some(rest)
}

/// A force along the shift of a frame, a moment where it only turns, times a factor.
fn pull(scene: &mut Scene, kinematics: &Kinematics, frame: FrameId, (shift, turn): (Vector, Vector), factor: Expr) -> Vec<Act> {
    if shift == scene.zero_vector() {
        let moment = turn.map(|e| scene.graph.mul(factor, e));
        return pair_of_moments(scene, frame, moment).to_vec();
    }
    let force = shift.map(|e| scene.graph.mul(factor, e));
    pair_of_forces(scene, kinematics, frame, force).to_vec()
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
