//! Loads as forces on freedoms, and what each part of a rod carries between its ends.

use crate::constraints::Row;
use crate::freedoms::Part;
use crate::{Action, Assembly, Component, Frame, Load, Place, Scalar, elements};

/// What a part of a rod carries, in its own axes.
#[derive(Clone, Debug)]
pub struct Carried<S> {
    /// Distributed loads along and across, at its start and end.
    pub distributed: Vec<[[S; 2]; 2]>,
    /// Concentrated: distance from its start, force along, force across, couple.
    pub points: Vec<(S, [S; 3])>,
}

impl<S> Default for Carried<S> {
    fn default() -> Carried<S> {
        Carried { distributed: Vec::new(), points: Vec::new() }
    }
}

impl<S: Scalar> Carried<S> {
    /// Nothing at all.
    pub fn is_empty(&self) -> bool {
        self.distributed.is_empty() && self.points.is_empty()
    }
}

/// Loads of a frame on its freedoms.
#[derive(Clone, Debug)]
pub struct Loading<S> {
    /// Force on each freedom, including the shares of loads between nodes.
    pub forces: Vec<S>,
    /// What each part carries.
    pub carried: Vec<Carried<S>>,
}

/// Loads on freedoms and parts.
pub fn loading<S: Scalar>(assembly: &Assembly<S>, frame: &Frame<S>, loads: &[Load<S>]) -> Loading<S> {
    let n = assembly.freedoms.meaning.len();
    let mut loading = Loading { forces: vec![S::zero(); n], carried: vec![Carried::default(); assembly.freedoms.parts.len()] };
    for load in loads {
        match &load.action {
            Action::Point { at, value } => loading.point(assembly, frame, at, value),
            Action::Distributed { rod, value } => loading.spread(assembly, frame, *rod, value),
        }
    }
    loading
}

impl<S: Scalar> Loading<S> {
    fn add(&mut self, row: &Row<S>, factor: &S) {
        row.iter().for_each(|(i, c)| self.forces[*i] = self.forces[*i].add(&c.mul(factor)));
    }

    fn point(&mut self, assembly: &Assembly<S>, frame: &Frame<S>, at: &Place<S>, value: &[S; 3]) {
        let (x, y) = (Component::Along([S::one(), S::zero()]), Component::Along([S::zero(), S::one()]));
        for (component, factor) in [x, y, Component::Turn].iter().zip(value) {
            if !factor.is_zero() {
                self.add(&assembly.functional(frame, at, component), factor);
            }
        }
        if let Place::Rod(rod, s) = at
            && let Some((part, x)) = assembly.freedoms.part_at(*rod, s)
        {
            let [a, b] = turned(frame, *rod, &[value[0].clone(), value[1].clone()]);
            let i_part = index_of(assembly, part);
            self.carried[i_part].points.push((x, [a, b, value[2].clone()]));
        }
    }

    fn spread(&mut self, assembly: &Assembly<S>, frame: &Frame<S>, rod: usize, value: &[[S; 2]; 2]) {
        let ends = [turned(frame, rod, &value[0]), turned(frame, rod, &value[1])];
        let length = &frame.rods[rod].length;
        for (i_part, part) in assembly.freedoms.parts.iter().enumerate().filter(|p| p.1.rod == rod) {
            let at = |s: &S| {
                let share = s.div(length);
                [0, 1].map(|k| ends[0][k].add(&share.mul(&ends[1][k].sub(&ends[0][k]))))
            };
            let q = [at(&part.from), at(&part.from.add(&part.length))];
            let shares = elements::distributed(&frame.rods[rod], &part.length, &q);
            for (row, share) in crate::assembly::local_rows(frame, part).iter().zip(&shares) {
                self.add(row, share);
            }
            self.carried[i_part].distributed.push(q);
        }
    }
}

/// Components along and across a rod of a vector in ground axes.
fn turned<S: Scalar>(frame: &Frame<S>, rod: usize, v: &[S; 2]) -> [S; 2] {
    let [c, s] = &frame.rods[rod].direction;
    [c.mul(&v[0]).add(&s.mul(&v[1])), c.mul(&v[1]).sub(&s.mul(&v[0]))]
}

fn index_of<S>(assembly: &Assembly<S>, part: &Part<S>) -> usize {
    assembly.freedoms.parts.iter().position(|p| std::ptr::eq(p, part)).unwrap_or(0)
}
