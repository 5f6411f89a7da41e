//! Matrices of one straight rod in its own axes: displacements (u1, v1, turn1, u2, v2, turn2), u along, v across, turns counter-clockwise.
//!
//! Between its ends the rod takes the static shape of an unloaded rod (linear along, cubic across), hence
//!
//! ```text
//! across: K = EI/l³ [12 6l -12 6l; 6l 4l² -6l 2l²; ...]      M = ρA l/420 [156 22l 54 -13l; 22l 4l² 13l -3l²; ...]
//! along:  K = EA/l [1 -1; -1 1]                              M = ρA l/6 [2 1; 1 2]
//! turning of sections:                                       M = ρI/(30 l) [36 3l -36 3l; 3l 4l² -3l -l²; ...]
//! ```
//!
//! *Source*: R. W. Clough, J. Penzien, Dynamics of Structures, 10-4; the same follows from ∫ EI N''ᵀN'' dx and ∫ ρA NᵀN dx, which a test does.

use crate::{Rod, RodKind, Scalar};

/// 6 x 6, row by row.
pub type Square<S> = Vec<S>;

fn place<S: Scalar>(out: &mut Square<S>, rows: &[usize], factor: &S, values: &[S]) {
    let n = rows.len();
    for (a, i) in rows.iter().enumerate() {
        for (b, j) in rows.iter().enumerate() {
            out[6 * i + j] = out[6 * i + j].add(&factor.mul(&values[a * n + b]));
        }
    }
}

/// Symmetric matrix across the rod from the pattern [a, b l, c, d l; e l², -d l, f l²; a, -b l; e l²].
fn across<S: Scalar>(pattern: [i64; 6], l: &S) -> Vec<S> {
    let [a, b, c, d, e, f] = pattern.map(|n| S::ratio(n, 1));
    let (bl, dl) = (b.mul(l), d.mul(l));
    let (el, fl) = (e.mul(l).mul(l), f.mul(l).mul(l));
    let rows = [
        [a.clone(), bl.clone(), c.clone(), dl.clone()],
        [bl.clone(), el.clone(), dl.neg(), fl.clone()],
        [c, dl.neg(), a, bl.neg()],
        [dl, fl, bl.neg(), el],
    ];
    rows.concat()
}

/// Stiffness of a part of a rod of this length.
pub fn stiffness<S: Scalar>(rod: &Rod<S>, l: &S) -> Square<S> {
    let mut out = vec![S::zero(); 36];
    let one = S::one();
    if let RodKind::Beam { bending, .. } = &rod.kind {
        place(&mut out, &[1, 2, 4, 5], &bending.div(&l.mul(l).mul(l)), &across([12, 6, -12, 6, 4, 2], l));
    }
    if let Some(axial) = rod.axial() {
        place(&mut out, &[0, 3], &axial.div(l), &[one.clone(), one.neg(), one.neg(), one]);
    }
    out
}

/// Mass of a part of a rod of this length.
pub fn mass<S: Scalar>(rod: &Rod<S>, l: &S) -> Square<S> {
    let mut out = vec![S::zero(); 36];
    let m = rod.mass.mul(l);
    let linear = [2, 1, 1, 2].map(|n| S::ratio(n, 6));
    if !m.is_zero() {
        place(&mut out, &[0, 3], &m, &linear);
        if rod.is_bar() {
            place(&mut out, &[1, 4], &m, &linear);
        } else {
            place(&mut out, &[1, 2, 4, 5], &m.div(&S::ratio(420, 1)), &across([156, 22, 54, -13, 4, -3], l));
        }
    }
    if !rod.rotary.is_zero() && !rod.is_bar() {
        place(&mut out, &[1, 2, 4, 5], &rod.rotary.div(&S::ratio(30, 1).mul(l)), &across([36, 3, -36, 3, 4, -1], l));
    }
    out
}

/// Displacements along and across and the turn at the distance x from the start, as combinations of the six displacements.
pub fn shape<S: Scalar>(rod: &Rod<S>, l: &S, x: &S) -> [[S; 6]; 3] {
    let z = || S::zero();
    let xi = x.div(l);
    let rest = S::one().sub(&xi);
    let along = [rest.clone(), z(), z(), xi.clone(), z(), z()];
    let slope = S::one().div(l);
    if rod.is_bar() {
        return [along, [z(), rest, z(), z(), xi, z()], [z(), slope.neg(), z(), z(), slope, z()]];
    }
    let int = |n| S::ratio(n, 1);
    let (x2, x3) = (xi.mul(&xi), xi.mul(&xi).mul(&xi));
    let poly = |a: i64, b: i64, c: i64, d: i64| int(a).add(&int(b).mul(&xi)).add(&int(c).mul(&x2)).add(&int(d).mul(&x3));
    let across = [z(), poly(1, 0, -3, 2), poly(0, 1, -2, 1).mul(l), z(), poly(0, 0, 3, -2), poly(0, 0, -1, 1).mul(l)];
    let turn = [z(), poly(0, -6, 6, 0).mul(&slope), poly(1, -4, 3, 0), z(), poly(0, 6, -6, 0).mul(&slope), poly(0, -2, 3, 0)];
    [along, across, turn]
}

/// Forces at the ends that do the same work as a load along the rod that goes linearly from `q[0]` at the start to `q[1]` at the end,
/// components along and across: ∫ Nᵀ q dx.
pub fn distributed<S: Scalar>(rod: &Rod<S>, l: &S, q: &[[S; 2]; 2]) -> [S; 6] {
    let mix = |k: usize, a: i64, b: i64, d: i64| S::ratio(a, d).mul(&q[0][k]).add(&S::ratio(b, d).mul(&q[1][k])).mul(l);
    if rod.is_bar() {
        return [mix(0, 2, 1, 6), mix(1, 2, 1, 6), S::zero(), mix(0, 1, 2, 6), mix(1, 1, 2, 6), S::zero()];
    }
    [mix(0, 2, 1, 6), mix(1, 7, 3, 20), mix(1, 3, 2, 60).mul(l), mix(0, 1, 2, 6), mix(1, 3, 7, 20), mix(1, 2, 3, 60).mul(l).neg()]
}
