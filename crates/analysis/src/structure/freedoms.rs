//! Degrees of freedom before constraints: x, y and turn of each node, own turns of hinged rod ends, and the inner nodes of divided rods,
//! whose displacements are counted along and across the rod, so that an inextensible rod stays one unknown along itself.

use super::{Frame, RodKind, Scalar};

/// A rod or a part of a divided one.
#[derive(Clone, Debug)]
pub struct Part<S> {
    /// The rod.
    pub rod: usize,
    /// Distance of its start from the start of the rod.
    pub from: S,
    /// Its length.
    pub length: S,
    /// Freedoms at start and end: two displacements and the turn each.
    pub freedoms: [usize; 6],
    /// Whether the displacements at start and end are along x and y; otherwise along and across the rod.
    pub ground_axes: [bool; 2],
}

/// What a freedom is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Freedom {
    /// Displacement of a node along x (0), y (1), or its turn (2).
    Node(usize, usize),
    /// Own turn of a hinged end (0 start, 1 end) of a rod.
    Hinge(usize, usize),
    /// Displacement along (0), across (1), or turn (2) at the end of part `.1` of rod `.0`.
    Inner(usize, usize, usize),
}

/// All freedoms of a frame.
#[derive(Clone, Debug)]
pub struct Freedoms<S> {
    /// Meaning of each.
    pub meaning: Vec<Freedom>,
    /// Parts of rods, in the order of rods.
    pub parts: Vec<Part<S>>,
    /// For each freedom whether anything is attached to it that gives it a meaning.
    pub used: Vec<bool>,
}

impl<S: Scalar> Freedoms<S> {
    /// Counts the freedoms of a frame.
    pub fn of(frame: &Frame<S>) -> Freedoms<S> {
        let meaning = (0..frame.nodes.len()).flat_map(|i| (0..3).map(move |k| Freedom::Node(i, k))).collect();
        let mut freedoms = Freedoms { meaning, parts: Vec::new(), used: Vec::new() };
        for i_rod in 0..frame.rods.len() {
            freedoms.rod(frame, i_rod);
        }
        freedoms.mark(frame);
        freedoms
    }

    fn add(&mut self, freedom: Freedom) -> usize {
        self.meaning.push(freedom);
        self.meaning.len() - 1
    }

    fn rod(&mut self, frame: &Frame<S>, i_rod: usize) {
        let rod = &frame.rods[i_rod];
        let n = if rod.is_bar() || matches!(rod.kind, RodKind::Rigid) { 1 } else { rod.divisions.max(1) };
        let length = rod.length.div(&S::ratio(n as i64, 1));
        let turn = |freedoms: &mut Freedoms<S>, end: usize| match rod.hinged[end] || rod.is_bar() {
            true => freedoms.add(Freedom::Hinge(i_rod, end)),
            false => 3 * rod.ends[end] + 2,
        };
        let mut start = [3 * rod.ends[0], 3 * rod.ends[0] + 1, turn(self, 0)];
        for i_part in 0..n {
            let last = i_part + 1 == n;
            let end = match last {
                true => [3 * rod.ends[1], 3 * rod.ends[1] + 1, turn(self, 1)],
                false => [0, 1, 2].map(|k| self.add(Freedom::Inner(i_rod, i_part, k))),
            };
            let freedoms = [start[0], start[1], start[2], end[0], end[1], end[2]];
            let from = length.mul(&S::ratio(i_part as i64, 1));
            self.parts.push(Part { rod: i_rod, from, length: length.clone(), freedoms, ground_axes: [i_part == 0, last] });
            start = end;
        }
    }

    /// A turn means something when a rod, a spring or an inertia is fixed to it; the turns of bars mean nothing.
    fn mark(&mut self, frame: &Frame<S>) {
        let mut used: Vec<bool> = self.meaning.iter().map(|f| !matches!(f, Freedom::Node(_, 2) | Freedom::Hinge(..))).collect();
        for part in &self.parts {
            if !frame.rods[part.rod].is_bar() {
                [2, 5].into_iter().for_each(|k| used[part.freedoms[k]] = true);
            }
        }
        for (i, node) in frame.nodes.iter().enumerate() {
            used[3 * i + 2] |= !node.inertia.is_zero() || !node.springs[2].is_zero();
        }
        self.used = used;
    }

    /// The part of a rod at a distance from its start, and the distance from the start of the part.
    pub fn part_at(&self, rod: usize, at: &S) -> Option<(&Part<S>, S)> {
        let mut found = None;
        for part in self.parts.iter().filter(|p| p.rod == rod) {
            if found.is_none() || part.from.value() <= at.value() {
                found = Some((part, at.sub(&part.from)));
            }
        }
        found
    }
}
