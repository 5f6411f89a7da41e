//! Statics of a frame under loads: displacements, reactions, forces at the ends of rods, diagrams.
//!
//! K q = Tᵀ f gives the displacements of what deforms; K x - f are then the forces that the constraints provide, from which the reactions and
//! the forces in rods that do not deform follow ([`crate::constraints`]). Signs: normal force N positive in tension; with the rod seen from its
//! start to its end and y to its left, the shear force V = dM/dx and the bending moment M positive when the rod bends like a bowl (tension on
//! its right side); reactions act on the structure.

use crate::Fault;
use crate::assembly::Bond;
use crate::loads::{Carried, Loading, loading};
use crate::{Assembly, Frame, Load, RodKind, Scalar, dense, elements, faults};
use algebra::Trouble;
use algebra::arrange::Arrange;

/// The static state under loads.
#[derive(Clone, Debug)]
pub struct Statics<S> {
    /// Displacements of all freedoms.
    pub freedoms: Vec<S>,
    /// Reaction of each support along its first and second axis and its couple; 0 where it does not hold.
    pub reactions: Vec<[S; 3]>,
    /// Forces of the springs on each node.
    pub springs: Vec<[S; 3]>,
    /// Forces at the ends of each part, in its own axes, as the nodes exert them on the rod.
    pub ends: Vec<[S; 6]>,
    /// What each part carries.
    pub carried: Vec<Carried<S>>,
}

/// Section forces at a place of a rod.
#[derive(Clone, Debug, PartialEq)]
pub struct Station<S> {
    /// Distance from the start of the rod.
    pub s: S,
    /// Normal force.
    pub normal: S,
    /// Shear force.
    pub shear: S,
    /// Bending moment.
    pub moment: S,
}

/// Solves K q = f for the independent freedoms.
pub type Solver<'a, S> = dyn Fn(&[S]) -> Result<Vec<S>, Fault> + 'a;

/// Solves a structure that stands.
///
/// *Errors*: S053 when rods or supports that do not deform share the load in more than one way.
pub fn solve<S: Scalar>(frame: &Frame<S>, assembly: &Assembly<S>, loads: &[Load<S>], invert: &Solver<S>) -> Result<Statics<S>, Fault> {
    let loading = loading(assembly, frame, loads);
    let q = invert(&assembly.elimination.gather(&loading.forces))?;
    let freedoms = assembly.elimination.expand(&q);
    let residual = residual(frame, assembly, &freedoms, &loading);
    let multipliers = assembly.elimination.multipliers(&residual);
    let open = undetermined(frame, assembly, &multipliers);
    if !open.is_empty() {
        return Err(faults::undetermined(&open.join(", ")));
    }
    let multiplier = |i: usize| multipliers[i].clone().unwrap_or_else(S::zero);
    let mut reactions = vec![[S::zero(), S::zero(), S::zero()]; frame.supports.len()];
    let mut ends: Vec<[S; 6]> =
        assembly.freedoms.parts.iter().enumerate().map(|(i, _)| bent(frame, assembly, &loading, &freedoms, i)).collect();
    for (i, bond) in assembly.bonds.iter().enumerate() {
        match bond {
            Bond::Support(support, k) => reactions[*support][*k] = multiplier(i),
            Bond::Part(part, k) => {
                let pattern = pattern(*k, &assembly.freedoms.parts[*part].length);
                let lambda = multiplier(i);
                ends[*part].iter_mut().zip(&pattern).for_each(|(e, c)| *e = e.sub(&c.mul(&lambda)));
            }
            Bond::Idle => {}
        }
    }
    let spring = |i: usize, k: usize| frame.nodes[i].springs[k].mul(&freedoms[3 * i + k]).neg();
    let springs = (0..frame.nodes.len()).map(|i| [spring(i, 0), spring(i, 1), spring(i, 2)]).collect();
    Ok(Statics { freedoms, reactions, springs, ends, carried: loading.carried })
}

/// A constraint of a part over its own six displacements.
fn pattern<S: Scalar>(k: usize, l: &S) -> [S; 6] {
    let (z, one) = (S::zero, S::one);
    match k {
        0 => [one(), z(), z(), one().neg(), z(), z()],
        1 => [z(), one().neg(), l.neg(), z(), one(), z()],
        _ => [z(), z(), one().neg(), z(), z(), one()],
    }
}

/// Forces at the ends of a part from its deformation and its loads.
fn bent<S: Scalar>(frame: &Frame<S>, assembly: &Assembly<S>, loading: &Loading<S>, x: &[S], i_part: usize) -> [S; 6] {
    let part = &assembly.freedoms.parts[i_part];
    let rod = &frame.rods[part.rod];
    let (k, u) = (elements::stiffness(rod, &part.length), assembly.local(frame, part, x));
    let mut out: [S; 6] = std::array::from_fn(|a| (0..6).fold(S::zero(), |sum, b| sum.add(&k[6 * a + b].mul(&u[b]))));
    let carried = &loading.carried[i_part];
    for q in &carried.distributed {
        let shares = elements::distributed(rod, &part.length, q);
        out.iter_mut().zip(&shares).for_each(|(e, s)| *e = e.sub(s));
    }
    for (at, force) in &carried.points {
        let shape = elements::shape(rod, &part.length, at);
        for (a, e) in out.iter_mut().enumerate() {
            (0..3).for_each(|k| *e = e.sub(&shape[k][a].mul(&force[k])));
        }
    }
    out
}

/// K x - f over all freedoms.
fn residual<S: Scalar>(frame: &Frame<S>, assembly: &Assembly<S>, x: &[S], loading: &Loading<S>) -> Vec<S> {
    let mut out: Vec<S> = loading.forces.iter().map(S::neg).collect();
    for part in &assembly.freedoms.parts {
        let rod = &frame.rods[part.rod];
        let (k, u) = (elements::stiffness(rod, &part.length), assembly.local(frame, part, x));
        for (a, row) in crate::assembly::local_rows(frame, part).iter().enumerate() {
            let force = (0..6).fold(S::zero(), |sum, b| sum.add(&k[6 * a + b].mul(&u[b])));
            row.iter().for_each(|(i, c)| out[*i] = out[*i].add(&c.mul(&force)));
        }
    }
    for (i, node) in frame.nodes.iter().enumerate() {
        (0..3).for_each(|k| out[3 * i + k] = out[3 * i + k].add(&node.springs[k].mul(&x[3 * i + k])));
    }
    out
}

/// Names of rods and supports whose forces statics does not give.
fn undetermined<S: Scalar>(frame: &Frame<S>, assembly: &Assembly<S>, multipliers: &[Option<S>]) -> Vec<String> {
    let mut names: Vec<String> = Vec::new();
    for (bond, multiplier) in assembly.bonds.iter().zip(multipliers) {
        if multiplier.is_none()
            && let Some(name) = crate::reduced::bond_name(frame, assembly, *bond)
            && !names.contains(&name)
        {
            names.push(name);
        }
    }
    names
}

/// A solver of K q = f by dense elimination.
///
/// *Errors*: of the solver: a singular matrix, which is a mechanism.
pub fn dense_solver<S: Scalar>(frame: &Frame<S>, assembly: &Assembly<S>) -> impl Fn(&[S]) -> Result<Vec<S>, Fault> {
    let n = assembly.n();
    let k = assembly.stiffness(frame).dense();
    move |f: &[S]| {
        let motion = words::Text::new("the stiffness matrix is singular", "матрица жёсткости вырождена");
        dense::solve(&k, n, f, 1).ok_or_else(|| faults::mechanism("?", &motion, 1))
    }
}

/// A solver of K q = f by sparse factors.
///
/// *Errors*: a mechanism.
pub fn sparse_solver(frame: &Frame<f64>, assembly: &Assembly<f64>) -> Result<impl Fn(&[f64]) -> Result<Vec<f64>, Fault>, Fault> {
    let matrix = crate::lowest::compressed(&assembly.stiffness(frame))?;
    let factored = matrix.factor().map_err(|trouble| match trouble {
        Trouble::Pivot(pivot) => {
            let (node, words) = crate::equilibrium::describe(frame, assembly, &assembly.elimination.expand(&pivot.motion));
            faults::mechanism(&node, &words, 1)
        }
        trouble => crate::matrices::told(trouble),
    })?;
    Ok(move |f: &[f64]| {
        let mut q = f.to_vec();
        factored.solve(&mut q, 1);
        Ok(q)
    })
}

impl<S: Scalar> Statics<S> {
    /// The same in machine numbers.
    pub fn machine(&self) -> Statics<f64> {
        let three = |f: &[S; 3]| [f[0].value(), f[1].value(), f[2].value()];
        let carried = |c: &Carried<S>| Carried {
            distributed: c.distributed.iter().map(|q| [[q[0][0].value(), q[0][1].value()], [q[1][0].value(), q[1][1].value()]]).collect(),
            points: c.points.iter().map(|(x, f)| (x.value(), three(f))).collect(),
        };
        Statics {
            freedoms: self.freedoms.iter().map(S::value).collect(),
            reactions: self.reactions.iter().map(three).collect(),
            springs: self.springs.iter().map(three).collect(),
            ends: self.ends.iter().map(|e| std::array::from_fn(|k| e[k].value())).collect(),
            carried: self.carried.iter().map(carried).collect(),
        }
    }

    /// Section forces along a rod: at the ends of parts, on both sides of concentrated loads, and `between` places between those where a
    /// distributed load makes the diagrams curved.
    pub fn stations(&self, assembly: &Assembly<S>, rod: usize, between: usize) -> Vec<Station<S>> {
        let mut out = Vec::new();
        for (i, part) in assembly.freedoms.parts.iter().enumerate().filter(|p| p.1.rod == rod) {
            let carried = &self.carried[i];
            let mut cuts: Vec<S> = carried.points.iter().map(|p| p.0.clone()).collect();
            cuts.push(part.length.clone());
            cuts.arrange_by(|a, b| a.value().total_cmp(&b.value()));
            let mut from = S::zero();
            for (passed, cut) in cuts.into_iter().enumerate() {
                let pieces = if carried.distributed.is_empty() { 1 } else { between + 1 };
                for k in 0..=pieces {
                    let x = from.add(&cut.sub(&from).mul(&S::ratio(k as i64, pieces as i64)));
                    let mut station = self.section(i, carried, (&x, &part.length), passed);
                    station.s = part.from.add(&x);
                    if out.last() != Some(&station) {
                        out.push(station);
                    }
                }
                from = cut;
            }
        }
        out
    }

    /// Section forces of a part at x of its length behind the first `passed` concentrated loads (by distance).
    fn section(&self, i_part: usize, carried: &Carried<S>, (x, length): (&S, &S), passed: usize) -> Station<S> {
        let e = &self.ends[i_part];
        let mut normal = e[0].neg();
        let mut shear = e[1].clone();
        let mut moment = e[1].mul(x).sub(&e[2]);
        for q in &carried.distributed {
            // load from 0 to x: trapezium of q0 and q(x)
            let at = |k: usize| q[0][k].add(&q[1][k].sub(&q[0][k]).mul(x).div(length));
            let half = S::ratio(1, 2);
            normal = normal.sub(&q[0][0].add(&at(0)).mul(x).mul(&half));
            shear = shear.add(&q[0][1].add(&at(1)).mul(x).mul(&half));
            // moment of the trapezium about its end: x²(2 q0 + q(x))/6
            moment = moment.add(&q[0][1].mul(&S::ratio(2, 1)).add(&at(1)).mul(x).mul(x).div(&S::ratio(6, 1)));
        }
        let mut points: Vec<&(S, [S; 3])> = carried.points.iter().collect();
        points.arrange_by(|a, b| a.0.value().total_cmp(&b.0.value()));
        for (at, force) in points.into_iter().take(passed) {
            normal = normal.sub(&force[0]);
            shear = shear.add(&force[1]);
            moment = moment.add(&force[1].mul(&x.sub(at))).sub(&force[2]);
        }
        Station { s: S::zero(), normal, shear, moment }
    }

    /// Normal force at the start of a rod, tension positive.
    pub fn normal(&self, assembly: &Assembly<S>, rod: usize) -> S {
        let part = assembly.freedoms.parts.iter().position(|p| p.rod == rod);
        part.map_or_else(S::zero, |i| self.ends[i][0].neg())
    }
}

impl Statics<f64> {
    /// The stations of a rod with those where the bending moment (V = 0), the shear force and the normal force (no load across, or along) have their extremes between
    /// them.
    pub fn diagram(&self, assembly: &Assembly<f64>, rod: usize, between: usize) -> Vec<Station<f64>> {
        let mut out = self.stations(assembly, rod, between);
        for (i, part) in assembly.freedoms.parts.iter().enumerate().filter(|p| p.1.rod == rod) {
            let mut cuts: Vec<f64> = self.carried[i].points.iter().map(|p| p.0).chain([part.length]).collect();
            cuts.sort_by(f64::total_cmp);
            let mut from = 0.0;
            for (passed, cut) in cuts.into_iter().enumerate() {
                for x in self.turning(i, [from, cut], passed, part.length) {
                    let mut station = self.section(i, &self.carried[i], (&x, &part.length), passed);
                    station.s = part.from + x;
                    let at = out.partition_point(|s| s.s <= station.s);
                    // a station that is there already, but for the rounding of its distance
                    let near = |s: &Station<f64>| (s.s - station.s).abs() <= 1e-12 * part.length;
                    if !out[at.saturating_sub(1)..].iter().take(2).any(near) {
                        out.insert(at, station);
                    }
                }
                from = cut;
            }
        }
        out
    }

    /// Places inside a stretch without concentrated loads where the shear force, the load across or that along vanishes: V' = q, N' = -p, both linear.
    fn turning(&self, i_part: usize, [from, to]: [f64; 2], passed: usize, length: f64) -> Vec<f64> {
        let carried = &self.carried[i_part];
        let load = |k: usize| {
            let sum = |end: usize| carried.distributed.iter().map(|q| q[end][k]).sum::<f64>();
            let slope = (sum(1) - sum(0)) / length;
            [sum(0) + slope * from, slope]
        };
        let ([along, change], [here, slope]) = (load(0), load(1));
        let shear = self.section(i_part, carried, (&from, &length), passed).shear;
        let mut steps = vec![-along / change, -here / slope];
        // V + q s + q' s²/2 = 0, the form without cancellation
        let root = here * here - 2.0 * slope * shear;
        if root >= 0.0 {
            let sum = -(here + root.sqrt().copysign(here));
            steps.extend([sum / slope, 2.0 * shear / sum]);
        }
        steps.retain(|s| s.is_finite() && *s > 0.0 && *s < to - from);
        steps.sort_by(f64::total_cmp);
        steps.dedup();
        steps.into_iter().map(|s| from + s).collect()
    }
}

/// ∫ M_i M_j/EI dx along a rod from two diagrams with the same stations, linear between them: (2ab + 2cd + ad + bc) l/6 EI on each piece.
pub fn product<S: Scalar>(kind: &RodKind<S>, first: &[Station<S>], second: &[Station<S>]) -> S {
    let RodKind::Beam { bending, axial } = kind else {
        return match kind {
            RodKind::Bar(Some(axial)) => stretch(axial, first, second),
            _ => S::zero(),
        };
    };
    let mut sum = S::zero();
    for (a, b) in first.windows(2).zip(second.windows(2)) {
        let l = a[1].s.sub(&a[0].s);
        let two = S::ratio(2, 1);
        let (m, n, p, q) = (&a[0].moment, &a[1].moment, &b[0].moment, &b[1].moment);
        let terms = two.mul(m).mul(p).add(&two.mul(n).mul(q)).add(&m.mul(q)).add(&n.mul(p));
        sum = sum.add(&terms.mul(&l).div(&S::ratio(6, 1)).div(bending));
    }
    match axial {
        Some(axial) => sum.add(&stretch(axial, first, second)),
        None => sum,
    }
}

fn stretch<S: Scalar>(axial: &S, first: &[Station<S>], second: &[Station<S>]) -> S {
    let pieces = first.windows(2).zip(second.windows(2));
    pieces.fold(S::zero(), |sum, (a, b)| sum.add(&a[1].s.sub(&a[0].s).mul(&a[0].normal).mul(&b[0].normal).div(axial)))
}
