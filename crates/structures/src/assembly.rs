//! From a frame to reduced matrices: freedoms, constraints, T with x = T q, and K = Tᵀ K_x T, M = Tᵀ M_x T as sparse entries.

use crate::constraints::{Elimination, Row, combine, eliminate};
use crate::elements;
use crate::freedoms::{Freedom, Freedoms, Part};
use crate::{Component, Frame, Place, RodKind, Scalar};

/// Where a constraint comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Bond {
    /// A support holds its first (0), second (1) axis or the turn (2).
    Support(usize, usize),
    /// A part of a rod keeps its length (0), stays straight (1), turns as one (2).
    Part(usize, usize),
    /// Nothing is attached to this freedom.
    Idle,
}

/// A frame with its constraints eliminated.
#[derive(Clone, Debug)]
pub struct Assembly<S> {
    /// Freedoms before elimination.
    pub freedoms: Freedoms<S>,
    /// Where each constraint comes from.
    pub bonds: Vec<Bond>,
    /// Each constraint over the freedoms.
    pub constraints: Vec<Row<S>>,
    /// What is left.
    pub elimination: Elimination<S>,
}

/// A symmetric sparse matrix: entries (row, column, value) of the lower triangle by row, each place once.
#[derive(Clone, Debug)]
pub struct Sparse<S> {
    /// Size.
    pub n: usize,
    /// Entries with row >= column.
    pub entries: Vec<(usize, usize, S)>,
}

impl<S: Scalar> Sparse<S> {
    /// Sums what stands at one place, in the order in which it was added.
    fn of(n: usize, mut list: Vec<(usize, usize, S)>) -> Sparse<S> {
        list.sort_by_key(|e| (e.0, e.1));
        let mut entries: Vec<(usize, usize, S)> = Vec::new();
        for (i, j, v) in list {
            match entries.last_mut() {
                Some(last) if (last.0, last.1) == (i, j) => last.2 = last.2.add(&v),
                _ => entries.push((i, j, v)),
            }
        }
        Sparse { n, entries }
    }
    /// All entries, row by row.
    pub fn dense(&self) -> Vec<S> {
        let mut out = vec![S::zero(); self.n * self.n];
        for (i, j, v) in &self.entries {
            out[i * self.n + j] = v.clone();
            out[j * self.n + i] = v.clone();
        }
        out
    }
    /// A x.
    pub fn apply(&self, x: &[S]) -> Vec<S> {
        let mut out = vec![S::zero(); self.n];
        for (i, j, v) in &self.entries {
            out[*i] = out[*i].add(&v.mul(&x[*j]));
            if i != j {
                out[*j] = out[*j].add(&v.mul(&x[*i]));
            }
        }
        out
    }
}

impl<S: Scalar> Assembly<S> {
    /// Counts freedoms and eliminates the constraints.
    pub fn of(frame: &Frame<S>) -> Assembly<S> {
        let freedoms = Freedoms::of(frame);
        let (mut bonds, mut constraints) = (Vec::new(), Vec::new());
        for (i, support) in frame.supports.iter().enumerate() {
            for k in (0..3).filter(|k| support.holds[*k]) {
                let [c, s] = &support.axis;
                let (x, y) = (3 * support.node, 3 * support.node + 1);
                bonds.push(Bond::Support(i, k));
                constraints.push(match k {
                    0 => vec![(x, c.clone()), (y, s.clone())],
                    1 => vec![(x, s.neg()), (y, c.clone())],
                    _ => vec![(x + 2, S::one())],
                });
            }
        }
        for i in (0..freedoms.used.len()).filter(|i| !freedoms.used[*i]) {
            // a held turn of a node without turn is held already
            let held = constraints.iter().any(|row: &Row<S>| row.len() == 1 && row[0].0 == i);
            if !held {
                bonds.push(Bond::Idle);
                constraints.push(vec![(i, S::one())]);
            }
        }
        for (i_part, part) in freedoms.parts.iter().enumerate() {
            let rod = &frame.rods[part.rod];
            let local = local_rows(frame, part);
            if rod.axial().is_none() {
                bonds.push(Bond::Part(i_part, 0));
                constraints.push(combine(&local[0], &S::one().neg(), &local[3]));
            }
            if matches!(rod.kind, RodKind::Rigid) {
                let across = combine(&local[4], &S::one().neg(), &local[1]);
                bonds.extend([Bond::Part(i_part, 1), Bond::Part(i_part, 2)]);
                constraints.push(combine(&across, &part.length.neg(), &local[2]));
                constraints.push(combine(&local[5], &S::one().neg(), &local[2]));
            }
        }
        constraints.iter_mut().for_each(|row| row.retain(|t| !t.1.is_zero()));
        let elimination = eliminate(freedoms.meaning.len(), &constraints, &|i| rank(&freedoms, i));
        Assembly { freedoms, bonds, constraints, elimination }
    }

    /// Number of independent freedoms.
    pub fn n(&self) -> usize {
        self.elimination.free.len()
    }

    /// Displacement i along or across at the ends of a part, over the independent freedoms.
    fn reduced_rows(&self, frame: &Frame<S>, part: &Part<S>) -> [Row<S>; 6] {
        local_rows(frame, part).map(|row| row.iter().fold(Vec::new(), |sum, (i, c)| combine(&sum, c, &self.elimination.transform[*i])))
    }

    pub(crate) fn gather(&self, frame: &Frame<S>, matrix: &dyn Fn(&Part<S>) -> Vec<S>, diagonal: Vec<(usize, S)>) -> Sparse<S> {
        let mut list: Vec<(usize, usize, S)> = Vec::new();
        let mut add = |i: usize, j: usize, v: S| list.push((i, j, v));
        for part in &self.freedoms.parts {
            let element = matrix(part);
            if element.iter().all(S::is_zero) {
                continue;
            }
            let rows = self.reduced_rows(frame, part);
            for a in 0..6 {
                for b in 0..6 {
                    let k = &element[6 * a + b];
                    if k.is_zero() {
                        continue;
                    }
                    for (i, ci) in &rows[a] {
                        let scaled = k.mul(ci);
                        rows[b].iter().filter(|t| t.0 <= *i).for_each(|(j, cj)| add(*i, *j, scaled.mul(cj)));
                    }
                }
            }
        }
        for (freedom, value) in diagonal.into_iter().filter(|d| !d.1.is_zero()) {
            let row = &self.elimination.transform[freedom];
            for (i, ci) in row {
                row.iter().filter(|t| t.0 <= *i).for_each(|(j, cj)| add(*i, *j, value.mul(ci).mul(cj)));
            }
        }
        Sparse::of(self.n(), list)
    }

    /// Stiffness over the independent freedoms.
    pub fn stiffness(&self, frame: &Frame<S>) -> Sparse<S> {
        let springs = frame.nodes.iter().enumerate().flat_map(|(i, n)| (0..3).map(move |k| (3 * i + k, n.springs[k].clone())));
        self.gather(frame, &|part| elements::stiffness(&frame.rods[part.rod], &part.length), springs.collect())
    }

    /// Mass over the independent freedoms.
    pub fn mass(&self, frame: &Frame<S>) -> Sparse<S> {
        let lumped = frame.nodes.iter().enumerate();
        let lumped = lumped.flat_map(|(i, n)| [(3 * i, n.mass.clone()), (3 * i + 1, n.mass.clone()), (3 * i + 2, n.inertia.clone())]);
        self.gather(frame, &|part| elements::mass(&frame.rods[part.rod], &part.length), lumped.collect())
    }

    /// A component of displacement at a place over all freedoms.
    pub fn functional(&self, frame: &Frame<S>, place: &Place<S>, component: &Component<S>) -> Row<S> {
        match (place, component) {
            (Place::Node(i), Component::Along([c, s])) => {
                let row = vec![(3 * i, c.clone()), (3 * i + 1, s.clone())];
                row.into_iter().filter(|t| !t.1.is_zero()).collect()
            }
            (Place::Node(i), Component::Turn) => vec![(3 * i + 2, S::one())],
            (Place::Rod(rod, at), component) => {
                let Some((part, x)) = self.freedoms.part_at(*rod, at) else { return Vec::new() };
                let rod = &frame.rods[*rod];
                let [along, across, turn] = elements::shape(rod, &part.length, &x);
                let weights: Vec<S> = match component {
                    Component::Turn => turn.to_vec(),
                    Component::Along([c, s]) => {
                        let [rc, rs] = &rod.direction;
                        // components of the wanted direction along and across the rod
                        let (a, b) = (c.mul(rc).add(&s.mul(rs)), s.mul(rc).sub(&c.mul(rs)));
                        (0..6).map(|k| a.mul(&along[k]).add(&b.mul(&across[k]))).collect()
                    }
                };
                let local = local_rows(frame, part);
                weights.iter().zip(&local).filter(|t| !t.0.is_zero()).fold(Vec::new(), |sum, (w, row)| combine(&sum, w, row))
            }
        }
    }

    /// Displacements of a part in its own axes from all freedoms.
    pub fn local(&self, frame: &Frame<S>, part: &Part<S>, x: &[S]) -> [S; 6] {
        local_rows(frame, part).map(|row| row.iter().fold(S::zero(), |sum, (i, c)| sum.add(&c.mul(&x[*i]))))
    }

    /// A name for an independent freedom: `x(B)`, `turn(C)`.
    pub fn name(&self, frame: &Frame<S>, i: usize) -> String {
        name_of(frame, self.freedoms.meaning[self.elimination.free[i]])
    }
}

/// A name for a freedom.
pub fn name_of<S>(frame: &Frame<S>, freedom: Freedom) -> String {
    const COMPONENTS: [&str; 3] = ["x", "y", "turn"];
    match freedom {
        Freedom::Node(i, k) => format!("{}({})", COMPONENTS[k], frame.nodes[i].name),
        Freedom::Hinge(rod, end) => format!("turn({} at {})", frame.rods[rod].name, frame.nodes[frame.rods[rod].ends[end]].name),
        Freedom::Inner(rod, i, k) => format!("{}({}, {})", ["along", "across", "turn"][k], frame.rods[rod].name, i + 1),
    }
}

/// Of two freedoms that a constraint ties, the later node's follows; translations before turns, inner nodes before all.
fn rank<S>(freedoms: &Freedoms<S>, i: usize) -> usize {
    let turn = matches!(freedoms.meaning[i], Freedom::Node(_, 2) | Freedom::Inner(_, _, 2));
    if turn { i } else { i + freedoms.meaning.len() }
}

/// The six displacements of a part in its own axes over all freedoms.
pub fn local_rows<S: Scalar>(frame: &Frame<S>, part: &Part<S>) -> [Row<S>; 6] {
    let [c, s] = &frame.rods[part.rod].direction;
    let row = |k: usize| {
        let (end, component) = (k / 3, k % 3);
        let [x, y, turn] = [0, 1, 2].map(|j| part.freedoms[3 * end + j]);
        let both = |a: S, b: S| {
            let mut row: Row<S> = vec![(x, a), (y, b)];
            row.retain(|t| !t.1.is_zero());
            row
        };
        match (component, part.ground_axes[end]) {
            (2, _) => vec![(turn, S::one())],
            (0, true) => both(c.clone(), s.clone()),
            (_, true) => both(s.neg(), c.clone()),
            (0, false) => vec![(x, S::one())],
            _ => vec![(y, S::one())],
        }
    };
    [0, 1, 2, 3, 4, 5].map(row)
}
