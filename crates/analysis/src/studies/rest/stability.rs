//! Whether a place of rest is stable, from small motions M y'' + B y' + C y = 0 along the surface of the connections.
//!
//! | roots | verdict |
//! |---|---|
//! | one with positive real part | unstable |
//! | all with negative real parts | stable (Lyapunov's first method) |
//! | on the axis; C symmetric and positive definite, B without negative damping | stable (Lagrange, Dirichlet: the energy is a minimum) |
//! | on the axis; C symmetric with a negative direction, no gyroscopic forces | unstable (Kelvin, Chetaev) |
//! | on the axis; C singular otherwise | neutral to first order: small motions do not decide ([`super::degenerate`] does) |
//! | on the axis; held by gyroscopic or circulatory forces alone | small motions do not decide |
//!
//! Matrices are compared in coordinates in which the stiffnesses on the diagonal are 1.
//!
//! Where bodies without mass leave no roots the energy decides alone. *Source*: D. R. Merkin, Introduction to the Theory of Stability, ch. 3 and 6.

use symbolic::Equations;
use symbolic::connections::Law;

use crate::linear::{By, Graded, Matrices, largest, parts};
use crate::studies::modes::Mode;
use algebra::cholesky::positive_definite;
use algebra::{eigen, elementary, qr};

/// Real parts below this share of their own root count as none.
const AXIS: f64 = 1e-9;

/// The equations with closed contacts as lasting connections, and dry friction and open contacts gone: what small motions are taken of.
pub fn with_closed(equations: &Equations, closed: &[usize]) -> Equations {
    let mut out = equations.clone();
    for (r, reaction) in out.reactions.iter_mut().enumerate() {
        let contact = if let Law::Rough { contact, .. } = reaction.law { contact } else { r };
        if let Law::Contact { condition, .. } | Law::Rough { condition, .. } = reaction.law
            && closed.contains(&contact)
        {
            reaction.law = Law::Ideal { condition };
        }
    }
    out
}

/// The verdict: stable, unstable, or undecided; `modes` are its roots (none where there are none to be had), each measured by
/// itself: a slow growth beside a fast oscillation is one. The matrices are those along the surface.
pub fn verdict(along: &Matrices, modes: &[Mode]) -> Option<bool> {
    let n = along.n;
    if n == 0 {
        return Some(true);
    }
    let along = &alike(along);
    let share = |m: &Mode| if m.root.0 == 0.0 { 0.0 } else { m.root.0 / elementary::hypot(m.root.0, m.root.1) };
    let growth = modes.iter().map(share).reduce(f64::max).unwrap_or(0.0);
    if growth > AXIS {
        return Some(false);
    }
    if growth < -AXIS {
        return Some(true);
    }
    let (even, odd) = parts(&along.stiffness, n);
    let (_, gyroscopic) = parts(&along.damping, n);
    let scale = largest(&along.stiffness);
    if scale > 0.0 && largest(&odd) <= AXIS * scale && largest(&gyroscopic) == 0.0 && falls(&even, n) {
        return Some(false);
    }
    if scale == 0.0 || largest(&odd) > AXIS * scale || free_directions(along) > 0 {
        return None;
    }
    match positive_definite(&even, n) {
        Some(true) if along.calm() => Some(true),
        Some(false) if largest(&gyroscopic) == 0.0 => Some(false),
        _ => None,
    }
}

/// Whether the energy falls in some direction, free ones beside it or not.
fn falls(even: &[f64], n: usize) -> bool {
    let unit: Vec<f64> = (0..n * n).map(|p| f64::from(u8::from(p / n == p % n))).collect();
    let Ok(found) = eigen::symmetric(n, even, &unit) else { return false };
    let largest = found.values.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
    found.values.iter().any(|v| *v < -AXIS * largest)
}

/// The same in coordinates whose stiffnesses are alike: a soft spring beside a hard one is none the less there.
fn scaled(along: &Matrices) -> Matrices {
    let (n, units) = (along.n, scales(along));
    let diagonal: Vec<f64> = (0..n * n).map(|p| if p / n == p % n { units[p / n] } else { 0.0 }).collect();
    along.reduced(&diagonal, n)
}

/// Units of these coordinates.
pub(super) fn scales(along: &Matrices) -> Vec<f64> {
    let n = along.n;
    let own = |i: usize| along.stiffness[i * n + i].abs();
    let row = |i: usize| largest(&along.stiffness[i * n..(i + 1) * n]);
    let size = |i: usize| [own(i), row(i), 1.0].into_iter().find(|v| *v > 0.0).unwrap_or(1.0);
    (0..n).map(|i| size(i).sqrt().recip()).collect()
}

/// The same where each direction has a stiffness of its own size; weak springs beside hard ones have it in directions of their own.
fn alike(along: &Matrices) -> Matrices {
    match along.graded() {
        Some(Graded { matrices, by: By::Stiffness, .. }) => matrices,
        Some(Graded { matrices, by: By::Damping, .. }) => scaled(&matrices),
        None => scaled(along),
    }
}

/// Directions along the surface that no stiffness resists.
pub fn free_directions(along: &Matrices) -> usize {
    let along = &alike(along);
    let n = along.n;
    let scale = largest(&along.stiffness);
    if scale == 0.0 {
        return n;
    }
    n - qr::rank(&along.stiffness, n, n)
}
