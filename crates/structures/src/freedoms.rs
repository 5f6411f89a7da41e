//! Degrees of freedom before constraints: x, y and turn of each node, own turns of hinged rod ends, and the inner nodes of divided rods,
//! whose displacements are counted along and across the rod, so that an inextensible rod stays one unknown along itself.
//!
//! A rod is also divided where one of its displacements has a name: between nodes it takes the shape of an unloaded rod, which is the truth
//! about its own flexibility only at nodes.

use crate::{Frame, Place, RodKind, Scalar};
use algebra::arrange::Arrange;

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
        let pieces = pieces(frame, i_rod);
        let n = pieces.len();
        let turn = |freedoms: &mut Freedoms<S>, end: usize| match rod.hinged[end] || rod.is_bar() {
            true => freedoms.add(Freedom::Hinge(i_rod, end)),
            false => 3 * rod.ends[end] + 2,
        };
        let mut start = [3 * rod.ends[0], 3 * rod.ends[0] + 1, turn(self, 0)];
        for (i_part, (from, length)) in pieces.into_iter().enumerate() {
            let last = i_part + 1 == n;
            let end = match last {
                true => [3 * rod.ends[1], 3 * rod.ends[1] + 1, turn(self, 1)],
                false => [0, 1, 2].map(|k| self.add(Freedom::Inner(i_rod, i_part, k))),
            };
            let freedoms = [start[0], start[1], start[2], end[0], end[1], end[2]];
            self.parts.push(Part { rod: i_rod, from, length, freedoms, ground_axes: [i_part == 0, last] });
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

/// Share of the length of a rod below which two places are one.
const SAME: f64 = 1e-9;

/// An end of a part of a rod.
struct Cut<S> {
    at: S,
    /// Which of the equal divisions it is; none for the place of a named displacement.
    division: Option<usize>,
}

/// Start and length of the parts of a rod: equal parts, and cuts at the places of its named displacements. A division next to such a place
/// moves onto it, so that no part is a sliver.
fn pieces<S: Scalar>(frame: &Frame<S>, i_rod: usize) -> Vec<(S, S)> {
    let rod = &frame.rods[i_rod];
    let bends = matches!(rod.kind, RodKind::Beam { .. });
    let n = if bends { rod.divisions.max(1) } else { 1 };
    let part = rod.length.div(&S::ratio(n as i64, 1));
    let mut cuts: Vec<Cut<S>> = (0..n).map(|i| Cut { at: part.mul(&S::ratio(i as i64, 1)), division: Some(i) }).collect();
    cuts.push(Cut { at: rod.length.clone(), division: Some(n) });
    let named = frame.displacements.iter().filter_map(|d| match &d.place {
        Place::Rod(i, at) if *i == i_rod && bends => Some(at),
        _ => None,
    });
    let mut kept = Vec::new();
    for at in named.filter(|at| at.value() > 0.0 && at.value() < rod.length.value()) {
        let gap = |cut: &Cut<S>| cut.at.sub(at).size();
        let near = (0..cuts.len()).min_by(|i, j| gap(&cuts[*i]).total_cmp(&gap(&cuts[*j]))).unwrap_or(0);
        let (distance, division) = (gap(&cuts[near]), cuts[near].division);
        let inner = division.is_some_and(|k| k > 0 && k < n && !kept.contains(&k));
        if distance <= SAME * rod.length.size() {
            kept.extend(division);
        } else if inner && distance < 0.125 * part.size() {
            cuts[near] = Cut { at: at.clone(), division: None };
        } else {
            cuts.push(Cut { at: at.clone(), division: None });
            cuts.arrange_by(|a, b| a.at.value().total_cmp(&b.at.value()));
        }
    }
    // equal parts are equal to the last digit
    let length = |pair: &[Cut<S>]| match (pair[0].division, pair[1].division) {
        (Some(_), Some(_)) => part.clone(),
        _ => pair[1].at.sub(&pair[0].at),
    };
    cuts.windows(2).map(|pair| (pair[0].at.clone(), length(pair))).collect()
}
