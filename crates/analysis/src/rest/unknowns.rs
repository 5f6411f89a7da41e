//! Unknown parameters from statics, with everything that holds: connections, ropes, supports, dry friction at its limit.
//!
//! ```text
//! forces, places, balances = 0        over q, λ, u                 see [`super::system`]
//! q_j = start_j(u)                    coordinates that are given, and others as far as the connections leave them open
//! F_k = ± μ_k |N_k|                   frictions about to slide: λ > 0 resists sliding forward
//! ```

use symbolic::Equations;
use symbolic::connections::Law;
use words::Text;

use super::admissible::Holds;
use super::newton::{self, worst};
use super::system::{Parts, RestSystem, Row, Rows};
use super::{closed_contacts, faults, hold};
use crate::Fault;
use crate::connections::assemble;
use crate::studies::unknowns::{force_unit, unbalanced, undetermined};
use algebra::qr::{self, norm};

/// Share of an unknown in a direction that changes no equation, above which it is open.
const OPEN: f64 = 1e-7;
/// Residual of the equations at the end.
const UNBALANCED: f64 = 1e-9;

/// A friction (by reaction) that is about to slide, forward (1) or backward (-1).
pub type Impending = (usize, f64);

/// What was found.
#[derive(Clone, Debug, Default)]
pub struct Found {
    /// Values of the unknowns.
    pub values: Vec<f64>,
    /// Remarks.
    pub notes: Vec<Text>,
}

/// Finds the parameters (by index) for which the start is a place of rest.
///
/// *Errors*: S036 an unknown that nothing determines or a force that nothing balances, S094 an unknown that friction leaves open, S062 and S093 where a rope
/// would push or a friction would have to exceed its limit, S082 a journal; faults of the assembly.
pub fn unknowns(equations: &Equations, parameters: &[usize], impending: &[Impending]) -> Result<Found, Fault> {
    if let Some(refused) = faults::journal_with_unknowns(equations) {
        return Err(refused);
    }
    let numbers: Vec<f64> = equations.parameters.iter().map(|p| p.value).collect();
    let start = if equations.coordinates.is_empty() { Vec::new() } else { assemble(equations, &numbers)?.start };
    let q = &start[..equations.coordinates.len()];
    let closed = closed_contacts(equations, q, &numbers)?;
    let mut parts = Parts::holding(equations, |r| closed.contains(&r));
    parts.unknowns = parameters.to_vec();
    let mut system = RestSystem::new(equations, parts, &numbers)?;
    let mut z = system.z(q);
    newton::balance(&mut system, &mut z)?;
    let kept = kept(equations, &mut system, &z)?;
    let given: Vec<bool> = equations.coordinates.iter().map(|c| c.given[0]).collect();
    let places: Vec<(usize, Option<f64>)> = kept.iter().map(|j| (*j, (!given[*j]).then_some(q[*j]))).collect();
    let limits = limit_rows(&system, impending);
    let choose = |rows: &Rows, z: &[f64]| chosen(rows, z, &places, &limits);
    let free: Vec<usize> = (0..system.width()).collect();
    let solved = newton::solve(&mut system, &mut z, &free, &choose);
    let all = system.at(&z)?;
    let rows = choose(&all, &z);
    determined(equations, &system, &rows, impending)?;
    if solved?.is_none() && worst(&rows, &z, system.n) > UNBALANCED {
        return Err(left_over(equations, &system, &all, &z));
    }
    let hold = hold(equations, &system, &all, &z);
    let judged = hold.judge();
    if matches!(judged, Holds::Slips(_)) && !impending.is_empty() {
        let unknown: Vec<&str> =
            parameters.iter().map(|p| equations.graph.symbol_info(equations.parameters[*p].symbol).name.as_str()).collect();
        let about: Vec<&str> = impending.iter().map(|(r, _)| equations.reactions[*r].name.as_str()).collect();
        return Err(faults::never_impending(&unknown.join(", "), &about.join(", ")));
    }
    if let Some(fault) = super::fault_of(equations, &system.reactions, &hold, &judged) {
        return Err(fault);
    }
    let first = system.n + system.reactions.len();
    Ok(Found { values: z[first..].to_vec(), notes: Vec::new() })
}

/// Coordinates that stand at their start: the given ones, and of the others, in their order, those that the places leave open.
fn kept(equations: &Equations, system: &mut RestSystem, z: &[f64]) -> Result<Vec<usize>, Fault> {
    let n = system.n;
    let rows = system.at(z)?;
    let mut vectors: Vec<Vec<f64>> = rows.places.iter().map(|r| r.slopes[..n].to_vec()).collect();
    let unit = |j: usize| (0..n).map(|k| if k == j { 1.0 } else { 0.0 }).collect::<Vec<f64>>();
    let coordinates = &equations.coordinates;
    let rank_of = |vectors: &[Vec<f64>]| {
        let scaled: Vec<f64> = vectors.iter().filter(|v| norm(v) > 0.0).flat_map(|v| v.iter().map(move |a| a / norm(v))).collect();
        qr::rank(&scaled, scaled.len() / n.max(1), n)
    };
    let mut kept: Vec<usize> = (0..n).filter(|j| coordinates[*j].given[0]).collect();
    vectors.extend(kept.iter().map(|j| unit(*j)));
    let mut rank = rank_of(&vectors);
    let others = (0..n).filter(|j| !coordinates[*j].given[0] && !coordinates[*j].guessed[0]);
    for j in others.chain((0..n).filter(|j| coordinates[*j].guessed[0] && !coordinates[*j].given[0])) {
        vectors.push(unit(j));
        let more = rank_of(&vectors);
        if more > rank {
            rank = more;
            kept.push(j);
        } else {
            vectors.pop();
        }
    }
    kept.sort_unstable();
    Ok(kept)
}

/// F = ± μ |N| of a friction.
pub(super) fn limit_row(rows: &Rows, z: &[f64], (friction, column, direction): (usize, usize, f64)) -> Row {
    let (fixed, normal) = &rows.limits[friction];
    let sign = direction * if normal.value < 0.0 { -1.0 } else { 1.0 };
    let slope = |j: usize| -sign * (fixed.slopes[j] * normal.value + fixed.value * normal.slopes[j]);
    let mut row = Row { value: z[column] - sign * fixed.value * normal.value, slopes: (0..z.len()).map(slope).collect(), is_force: true };
    row.slopes[column] += 1.0;
    row
}

/// (index among the frictions, column of the friction's force in z, direction).
pub(super) fn limit_rows(system: &RestSystem, impending: &[Impending]) -> Vec<(usize, usize, f64)> {
    let place = |(r, direction): &Impending| {
        let friction = system.frictions.iter().position(|f| f == r)?;
        let column = system.reactions.iter().position(|own| own == r)?;
        Some((friction, system.n + column, *direction))
    };
    impending.iter().filter_map(place).collect()
}

fn chosen(rows: &Rows, z: &[f64], places: &[(usize, Option<f64>)], limits: &[(usize, usize, f64)]) -> Vec<Row> {
    let mut all: Vec<Row> = rows.forces.iter().chain(&rows.places).chain(&rows.balances).cloned().collect();
    for (j, value) in places {
        // q_j - start_j(u)
        let mut row = match value {
            Some(value) => Row { value: *value, slopes: vec![0.0; z.len()], is_force: false },
            None => rows.starts[*j].clone(),
        };
        row.value = z[*j] - row.value;
        row.slopes.iter_mut().for_each(|s| *s = -*s);
        row.slopes[*j] += 1.0;
        all.push(row);
    }
    all.extend(limits.iter().map(|limit| limit_row(rows, z, *limit)));
    all
}

/// No direction that changes no row may contain an unknown.
fn determined(equations: &Equations, system: &RestSystem, rows: &[Row], impending: &[Impending]) -> Result<(), Fault> {
    let width = system.width();
    let size = |r: &Row| r.slopes.iter().fold(0.0_f64, |m, s| m.max(s.abs()));
    let scaled: Vec<Vec<f64>> = rows.iter().filter(|r| size(r) > 0.0).map(|r| r.slopes.iter().map(|s| s / size(r)).collect()).collect();
    let columns: Vec<f64> = (0..width).map(|j| scaled.iter().fold(0.0_f64, |m, r| m.max(r[j].abs()))).collect();
    let entry = |r: &Vec<f64>, j: usize| if columns[j] > 0.0 { r[j] / columns[j] } else { 0.0 };
    let matrix: Vec<f64> = scaled.iter().flat_map(|r| (0..width).map(move |j| entry(r, j))).collect();
    let first = system.n + system.reactions.len();
    let name = |u: usize| equations.graph.symbol_info(equations.parameters[system.unknowns[u]].symbol).name.clone();
    if let Some(u) = (0..system.unknowns.len()).find(|u| columns[first + u] == 0.0) {
        return Err(undetermined(&name(u)));
    }
    for direction in qr::null_space(&matrix, scaled.len(), width) {
        let length = norm(&direction);
        let Some(u) = (0..system.unknowns.len()).find(|u| direction[first + u].abs() > OPEN * length) else { continue };
        let by_friction = system.frictions.iter().find(|r| {
            let column = system.reactions.iter().position(|own| own == *r);
            !impending.iter().any(|(i, _)| i == *r) && column.is_some_and(|c| direction[system.n + c].abs() > OPEN * length)
        });
        return Err(match by_friction {
            Some(r) => faults::open(&name(u), plain(&equations.reactions[*r].name)),
            None => undetermined(&name(u)),
        });
    }
    Ok(())
}

/// `force(floor)` is the friction `floor`.
fn plain(reaction: &str) -> &str {
    reaction.split_once('(').and_then(|(_, rest)| rest.strip_suffix(')')).unwrap_or(reaction)
}

/// The force that nothing balances.
fn left_over(equations: &Equations, system: &RestSystem, rows: &Rows, z: &[f64]) -> Fault {
    let n = system.n;
    let coordinate = |i: usize| equations.graph.symbol_info(equations.coordinates[i].symbols[0]).name.clone();
    let worst_of = |rows: &[Row]| {
        let at = |i: usize| newton::relative(&rows[i], z, n);
        (0..rows.len()).max_by(|a, b| at(*a).total_cmp(&at(*b))).map(|i| (i, at(i)))
    };
    match (worst_of(&rows.forces), worst_of(&rows.balances)) {
        (Some((i, force)), other) if other.is_none_or(|(_, b)| force >= b) => {
            unbalanced(&coordinate(i), rows.forces[i].value, force_unit(&equations.coordinates[i].unit))
        }
        (_, Some((i, _))) => unbalanced(&equations.balances[i].name.en, rows.balances[i].value, ""),
        _ => unbalanced("-", 0.0, ""),
    }
}

/// The reaction of the friction of this name.
pub fn friction_named(equations: &Equations, name: &str) -> Option<usize> {
    equations.reactions.iter().position(|r| matches!(r.law, Law::Friction(_)) && plain(&r.name) == name)
}
