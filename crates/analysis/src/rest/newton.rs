//! Gauss-Newton for equations of rest: rows of different units, dependent rows and columns, steps that are halved until the rows get smaller.

use super::system::{RestSystem, Row, Rows};
use crate::Fault;
use algebra::qr::{Qr, norm};

const STEPS: usize = 100;
/// Longest change of a coordinate in one step, SI.
const LONGEST: f64 = 0.5;
/// Row relative to the terms that meet in it.
pub(crate) const RESIDUAL: f64 = 1e-10;

/// Smallest share of the largest force to which a force is compared.
const SHARE: f64 = 1e-3;

/// Σ |∂row/∂z_j| |z_j|, coordinates counted as at least 1 rad or 1 m.
fn size(row: &Row, z: &[f64], n: usize) -> f64 {
    let term = |(j, s): (usize, &f64)| s.abs() * if j < n { z[j].abs().max(1.0) } else { z[j].abs() };
    row.slopes.iter().enumerate().map(term).sum()
}

/// Value of a row relative to the terms that meet in it.
pub(super) fn relative(row: &Row, z: &[f64], n: usize) -> f64 {
    if row.value == 0.0 { 0.0 } else { row.value.abs() / size(row, z, n) }
}

/// The largest of these; forces are compared with the largest force too.
pub(crate) fn worst(rows: &[Row], z: &[f64], n: usize) -> f64 {
    let largest = rows.iter().filter(|r| r.is_force).fold(0.0_f64, |m, r| m.max(size(r, z, n)));
    rows.iter().fold(0.0_f64, |m, row| {
        let floor = if row.is_force { SHARE * largest } else { 0.0 };
        m.max(if row.value == 0.0 { 0.0 } else { row.value.abs() / size(row, z, n).max(floor) })
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
    for _ in 0..STEPS {
        let scale: Vec<f64> = rows.iter().map(|r| free.iter().fold(0.0_f64, |m, j| m.max(r.slopes[*j].abs()))).collect();
        let weight = |i: usize| if scale[i] > 0.0 { 1.0 / scale[i] } else { 1.0 };
        let (m, k) = (rows.len(), free.len());
        let matrix: Vec<f64> = (0..m * k).map(|p| rows[p / k].slopes[free[p % k]] * weight(p / k)).collect();
        let right: Vec<f64> = (0..m).map(|i| -rows[i].value * weight(i)).collect();
        let before = norm(&right);
        if before == 0.0 || k == 0 {
            break;
        }
        let (step, _) = Qr::new(&matrix, m, k).least_squares(&right);
        let longest = step.iter().zip(free).filter(|(_, j)| **j < n).fold(0.0_f64, |l, (s, _)| l.max(s.abs()));
        let mut share = if longest > LONGEST { LONGEST / longest } else { 1.0 };
        let accepted = loop {
            let mut next = z.clone();
            free.iter().zip(&step).for_each(|(j, s)| next[*j] += share * s);
            let there = system.at(&next).map(|all| choose(&all, &next));
            if let Ok(there) = there {
                let after = norm(&there.iter().enumerate().map(|(i, r)| r.value * weight(i)).collect::<Vec<_>>());
                if after < (1.0 - 0.1 * share) * before || (share == 1.0 && after < before) {
                    rows = there;
                    *z = next;
                    break true;
                }
            }
            share *= 0.5;
            if share < 1e-6 {
                break false;
            }
        };
        let still = step.iter().zip(free).all(|(s, j)| s.abs() <= 4.0 * f64::EPSILON * z[*j].abs());
        if !accepted || still {
            break;
        }
    }
    rows = choose(&system.at(z)?, z);
    Ok((worst(&rows, z, n) <= RESIDUAL).then_some(rows))
}

/// Reactions that balance best at these coordinates, put into z.
pub(crate) fn balance(system: &mut RestSystem, z: &mut [f64]) -> Result<(), Fault> {
    let (n, k) = (system.n, system.reactions.len());
    z[n..n + k].fill(0.0);
    let rows = system.at(z)?;
    let all: Vec<&Row> = rows.forces.iter().chain(&rows.balances).collect();
    let size = |r: &Row| r.slopes[n..n + k].iter().fold(0.0_f64, |m, s| m.max(s.abs()));
    let weight = |r: &Row| if size(r) > 0.0 { 1.0 / size(r) } else { 1.0 };
    if k == 0 {
        return Ok(());
    }
    let matrix: Vec<f64> = all.iter().flat_map(|r| r.slopes[n..n + k].iter().map(move |s| s * weight(r))).collect();
    let right: Vec<f64> = all.iter().map(|r| -r.value * weight(r)).collect();
    z[n..n + k].copy_from_slice(&Qr::new(&matrix, all.len(), k).least_squares(&right).0);
    Ok(())
}
