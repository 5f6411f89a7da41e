//! Gauss-Newton for equations of rest: rows of different units, dependent rows and columns, steps that are halved until the rows get smaller.

use super::system::{RestSystem, Row, Rows};
use crate::Fault;
use algebra::qr::Qr;
use algebra::vectors::norm;

const STEPS: usize = 100;
/// Longest change of a coordinate in one step, SI.
const LONGEST: f64 = 0.5;
/// Steps in a row that are cut to the longest one before it grows: the place is far by its units.
const PATIENCE: usize = 30;
/// Row relative to the terms that meet in it.
pub(crate) const RESIDUAL: f64 = 1e-10;

/// The same where Newton's method ends: beside a fold, or a dead position of a linkage, a place that is open by more can rest where no closed one does.
pub(crate) const SOLVED: f64 = 1e-12;
/// Smallest share of the largest force to which a force is compared.
const SHARE: f64 = 1e-3;

/// Σ |∂row/∂z_j| |z_j| and the terms that cancel in the row.
fn size(row: &Row, z: &[f64]) -> f64 {
    row.terms + row.slopes.iter().zip(z).map(|(s, z)| (s * z).abs()).sum::<f64>()
}

/// Value of a row relative to the terms that meet in it.
pub(crate) fn relative(row: &Row, z: &[f64]) -> f64 {
    if row.value == 0.0 { 0.0 } else { row.value.abs() / size(row, z) }
}

/// The largest of these; forces are compared with the largest force too.
pub(crate) fn worst(rows: &[Row], z: &[f64]) -> f64 {
    let largest = rows.iter().filter(|r| r.is_force).fold(0.0_f64, |m, r| m.max(size(r, z)));
    rows.iter().fold(0.0_f64, |m, row| {
        let floor = if row.is_force { SHARE * largest } else { 0.0 };
        m.max(if row.value == 0.0 { 0.0 } else { row.value.abs() / size(row, z).max(floor) })
    })
}

/// Which rows of the system are solved, made from what it gives.
pub(super) type Choice<'c> = &'c dyn Fn(&Rows, &[f64]) -> Vec<Row>;

/// Moves the `free` components of z until the rows vanish; the rows there. Where columns depend on each other the dependent ones stay.
///
/// *Errors*: none converges (the fault says where formulas end), see [`RESIDUAL`].
pub(super) fn solve(system: &mut RestSystem, z: &mut Vec<f64>, free: &[usize], choose: Choice) -> Result<Option<Vec<Row>>, Fault> {
    let n = system.n;
    let mut rows = choose(&system.at(z)?, z);
    let scales = scales(system, &rows, z);
    let (mut reach, mut cut) = (LONGEST, 0);
    for _ in 0..STEPS {
        let (step, weights) = full_step(&rows, free, &scales);
        let length = |rows: &[Row]| norm(&rows.iter().zip(&weights).map(|(r, w)| r.value * w).collect::<Vec<_>>());
        let before = length(&rows);
        if before == 0.0 || free.is_empty() {
            break;
        }
        let longest = step.iter().zip(free).filter(|(_, j)| **j < n).fold(0.0_f64, |l, (s, _)| l.max(s.abs()));
        cut = if longest > reach { cut + 1 } else { 0 };
        reach *= if cut > PATIENCE { 2.0 } else { 1.0 };
        let mut share = if longest > reach { reach / longest } else { 1.0 };
        let accepted = loop {
            let mut next = z.clone();
            free.iter().zip(&step).for_each(|(j, s)| next[*j] += share * s);
            let there = system.at(&next).map(|all| choose(&all, &next));
            if let Ok(there) = there {
                let after = length(&there);
                if after < (1.0 - 0.1 * share) * before || (share == 1.0 && after < before) {
                    rows = there;
                    *z = next;
                    break true;
                }
            }
            share *= 0.5;
            // twenty halvings: no direction of descent
            if share < 1e-6 {
                break false;
            }
        };
        let still = step.iter().zip(free).all(|(s, j)| s.abs() <= 4.0 * f64::EPSILON * z[*j].abs());
        if !accepted || still {
            break;
        }
    }
    // the rounding of a rounding, where zero is meant
    for j in free {
        if z[*j].abs() <= f64::EPSILON * f64::EPSILON * scales[*j] {
            z[*j] = 0.0;
        }
    }
    rows = choose(&system.at(z)?, z);
    let (step, _) = full_step(&rows, free, &scales);
    Ok((worst(&rows, z) <= SOLVED && stands(&rows, z, free.iter().zip(&step).filter(|(j, _)| **j >= n))).then_some(rows))
}

/// Share of the largest force by which a further step may change the reactions.
const STANDS: f64 = 1e-2;

/// Whether the reactions have come to stand: what a further step makes of them. In a dead position of a linkage c ~ u v with u λ finite: every place near it
/// solves the equations to any limit as u, v → 0 and λ → ∞, and Newton's method goes on doubling λ there.
fn stands<'s>(rows: &[Row], z: &[f64], reactions: impl Iterator<Item = (&'s usize, &'s f64)>) -> bool {
    let largest = rows.iter().filter(|r| r.is_force).fold(0.0_f64, |m, r| m.max(size(r, z)));
    let mut forces = reactions.flat_map(|(j, s)| rows.iter().filter(|r| r.is_force).map(move |r| (r.slopes[*j] * s).abs()));
    forces.all(|force| force <= STANDS * largest)
}

/// With what each component of z compares: coordinates with their sizes, a reaction with that of the loads which it bears, an unknown parameter with its own
/// number. Steps are then the same in all units: the pull of milligrams counts beside the lengths of rods.
fn scales(system: &RestSystem, rows: &[Row], z: &[f64]) -> Vec<f64> {
    let (n, k) = (system.n, system.reactions.len());
    let mut scales = system.sizes().at(&[&z[..n]]);
    let load = |row: &Row| row.terms + row.slopes.iter().zip(&z[..n]).map(|(s, q)| (s * q).abs()).sum::<f64>();
    let forces: Vec<(&Row, f64)> = rows.iter().filter(|r| r.is_force).map(|r| (r, load(r))).collect();
    let borne = |j: usize| {
        let [shares, squares] =
            forces.iter().fold([0.0, 0.0], |[a, b], (r, load)| [a + r.slopes[j].abs() * load, b + r.slopes[j] * r.slopes[j]]);
        if squares > 0.0 { shares / squares } else { 0.0 }
    };
    scales.extend((n..n + k).map(borne));
    scales.extend(z[n + k..].iter().map(|u| u.abs()));
    scales.iter_mut().filter(|s| !(s.is_finite() && **s > 0.0)).for_each(|s| *s = 1.0);
    scales
}

/// Newton's step of least squares in weighted rows, and the weights.
fn full_step(rows: &[Row], free: &[usize], scales: &[f64]) -> (Vec<f64>, Vec<f64>) {
    let weights: Vec<f64> = rows.iter().map(|r| weight(r, free, scales)).collect();
    let (m, k) = (rows.len(), free.len());
    let matrix: Vec<f64> = (0..m * k).map(|p| rows[p / k].slopes[free[p % k]] * scales[free[p % k]] * weights[p / k]).collect();
    let right: Vec<f64> = (0..m).map(|i| -rows[i].value * weights[i]).collect();
    let mut step = if k == 0 { Vec::new() } else { Qr::new(&matrix, m, k).least_squares(&right).0 };
    step.iter_mut().zip(free).for_each(|(s, j)| *s *= scales[*j]);
    (step, weights)
}

fn weight(row: &Row, free: &[usize], scales: &[f64]) -> f64 {
    let scale = free.iter().fold(0.0_f64, |m, j| m.max((row.slopes[*j] * scales[*j]).abs()));
    if scale > 0.0 { 1.0 / scale } else { 1.0 }
}

/// Reactions that balance best at these coordinates, put into z.
pub(crate) fn balance(system: &mut RestSystem, z: &mut [f64]) -> Result<(), Fault> {
    let (n, k) = (system.n, system.reactions.len());
    z[n..n + k].fill(0.0);
    let rows = system.at(z)?;
    let all: Vec<&Row> = rows.forces.iter().chain(&rows.balances).collect();
    // forces by the work that they do over the sizes of their coordinates: a row in which a reaction all but vanishes counts for what it is
    let sizes = system.sizes().at(&[&z[..n]]);
    let size = |r: &Row| r.slopes[n..n + k].iter().fold(0.0_f64, |m, s| m.max(s.abs()));
    let own = |r: &Row| if size(r) > 0.0 { 1.0 / size(r) } else { 1.0 };
    let weights: Vec<f64> = sizes.into_iter().chain(rows.balances.iter().map(own)).collect();
    if k == 0 {
        return Ok(());
    }
    let matrix: Vec<f64> = all.iter().zip(&weights).flat_map(|(r, w)| r.slopes[n..n + k].iter().map(move |s| s * w)).collect();
    let right: Vec<f64> = all.iter().zip(&weights).map(|(r, w)| -r.value * w).collect();
    z[n..n + k].copy_from_slice(&Qr::new(&matrix, all.len(), k).least_squares(&right).0);
    Ok(())
}
