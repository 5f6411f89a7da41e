//! Limiting equilibria: places of rest in a range of a coordinate at which given frictions are about to slide.
//!
//! ```text
//! forces, places, balances = 0,   F_k = ± μ_k |N_k|        over q, λ
//! q_j = start_j                                            for what these leave open, the coordinate of the range last
//! ```
//!
//! Every friction at its limit is one equation, which takes the place of a coordinate that friction would hold anywhere: so the ends of the ranges in which dry friction
//! holds a machine are found. The equations are solved by Newton's method from places all over the range. Where reactions are not unique they may be met inside such a
//! range, by one share of the load among many: there another share holds the machine further on. An end is where all admissible reactions have these limits.

use symbolic::Equations;
use symbolic::connections::Law;

use super::admissible::Holds;
use super::newton::{self, worst};
use super::search::Range;
use super::system::{Parts, RestSystem, Row, Rows};
use super::unknowns::{Impending, Limited, limit_rows, signs};
use super::{closed_contacts, faults, hold};
use crate::Fault;
use algebra::arrange::Arrange;
use algebra::qr;
use algebra::vectors::norm;

/// Intervals of the range; Newton's method begins at their ends.
const PARTS: usize = 64;
/// Residual of the equations at a place.
const UNBALANCED: f64 = 1e-9;
/// Places closer than this, relative to the range, are one.
const ALIKE: f64 = 1e-7;

/// Coordinates of the limiting equilibria, in the order of the range.
///
/// *Errors*: S127 none; faults of evaluation.
pub fn limiting(
    equations: &Equations,
    parameters: &[f64],
    start: &[f64],
    (range, impending): (Range, &[Impending]),
) -> Result<Vec<Vec<f64>>, Fault> {
    let n = equations.coordinates.len();
    let mut found: Vec<Vec<f64>> = Vec::new();
    for k in 0..=PARTS {
        let mut q = start[..n].to_vec();
        q[range.coordinate] = range.from + (range.to - range.from) * k as f64 / PARTS as f64;
        let places = from(equations, parameters, (start, &q), (range.coordinate, impending)).unwrap_or_default();
        for place in places {
            let inside = (range.from..=range.to).contains(&place[range.coordinate]);
            let close =
                // a range that is a point has no width of its own
                |a: &Vec<f64>| (0..n).all(|j| (a[j] - place[j]).abs() <= ALIKE * (range.to - range.from).max(1e-3 * place[j].abs()));
            if inside && !found.iter().any(close) {
                found.push(place);
            }
        }
    }
    found.arrange_by(|a, b| a[range.coordinate].total_cmp(&b[range.coordinate]));
    if found.is_empty() {
        let names: Vec<&str> = impending.iter().map(|(r, _)| equations.reactions[*r].name.as_str()).collect();
        let coordinate = &equations.graph.symbol_info(equations.coordinates[range.coordinate].symbols[0]).name;
        return Err(faults::no_limit(&names.join(", "), coordinate, [range.from, range.to]));
    }
    Ok(found)
}

/// The places that Newton's method finds from here and that hold, one for each set of signs of the normal forces at most. The sign is that of the place
/// found, not of the guess; beyond [`SIGNS`] frictions it is that on the way.
fn from(
    equations: &Equations,
    parameters: &[f64],
    (start, q): (&[f64], &[f64]),
    (over, impending): (usize, &[Impending]),
) -> Result<Vec<Vec<f64>>, Fault> {
    // what presses a friction at its limit is closed there, wherever the search begins
    let pressing = impending.iter().flat_map(|(r, _)| pressed_by(equations, *r));
    let closed: Vec<usize> = closed_contacts(equations, q, parameters)?.into_iter().chain(pressing).collect();
    let mut system = RestSystem::new(equations, Parts::holding(equations, |r| closed.contains(&r)), parameters)?;
    let mut z = system.z(q);
    newton::balance(&mut system, &mut z)?;
    let limits = limit_rows(&system, impending);
    let rows = system.at(&z)?;
    let kept = kept(equations, &equations_of(&rows, &z, &limits), over);
    let free: Vec<usize> = (0..system.width()).collect();
    let sets = match signs(&limits) {
        sets if sets.is_empty() => vec![limits],
        sets => sets,
    };
    let mut found = Vec::new();
    for limits in sets {
        let choose = |rows: &Rows, z: &[f64]| {
            let mut all = equations_of(rows, z, &limits);
            all.extend(kept.iter().map(|j| Row {
                value: z[*j] - start[*j],
                slopes: (0..z.len()).map(|i| if i == *j { 1.0 } else { 0.0 }).collect(),
                terms: 1.0,
                is_force: false,
            }));
            all
        };
        let mut z = z.clone();
        // formulas may end on the way with one set and not with another
        if newton::solve(&mut system, &mut z, &free, &choose).is_err() {
            continue;
        }
        let Ok(all) = system.at(&z) else { continue };
        if worst(&choose(&all, &z), &z) > UNBALANCED || limits.iter().any(|limit| limit.is_turned(&all)) {
            continue;
        }
        let hold = hold(equations, &system, &all, &z);
        let column = |r: usize| system.reactions.iter().position(|own| *own == r);
        let at_limit = |(r, side): &Impending| column(*r).is_none_or(|column| hold.is_at_limit(column, *side));
        if matches!(hold.judge(), Holds::Between(_)) && impending.iter().all(at_limit) {
            found.push(z[..system.n].to_vec());
        }
    }
    Ok(found)
}

/// The contacts that press a friction.
fn pressed_by(equations: &Equations, friction: usize) -> Vec<usize> {
    let Law::Friction(friction) = &equations.reactions[friction].law else { return Vec::new() };
    let terms = friction.components().flat_map(|normal| normal.terms.iter().map(|(k, _)| *k));
    terms.filter(|k| matches!(equations.reactions[*k].law, Law::Contact { .. })).collect()
}

/// Forces, places, balances and limits.
fn equations_of(rows: &Rows, z: &[f64], limits: &[Limited]) -> Vec<Row> {
    let own = rows.forces.iter().chain(&rows.places).chain(&rows.balances).cloned();
    own.chain(limits.iter().map(|limit| limit.row(rows, z))).collect()
}

/// Coordinates that the equations leave open: those that are given first, that of the range last.
fn kept(equations: &Equations, rows: &[Row], over: usize) -> Vec<usize> {
    let n = equations.coordinates.len();
    let width = rows.first().map_or(n, |r| r.slopes.len());
    let columns: Vec<f64> = (0..width).map(|j| rows.iter().fold(0.0_f64, |m, r| m.max(r.slopes[j].abs()))).collect();
    let scaled = |slopes: &[f64]| -> Vec<f64> {
        let row: Vec<f64> = slopes.iter().zip(&columns).map(|(s, c)| if *c > 0.0 { s / c } else { *s }).collect();
        let length = norm(&row);
        row.into_iter().map(|s| if length > 0.0 { s / length } else { s }).collect()
    };
    let mut matrix: Vec<f64> = rows.iter().flat_map(|r| scaled(&r.slopes)).collect();
    let rank_of = |matrix: &[f64]| qr::rank(matrix, matrix.len() / width.max(1), width);
    let mut rank = rank_of(&matrix);
    let given = |j: &usize| equations.coordinates[*j].given[0];
    let order = (0..n).filter(|j| given(j) && *j != over).chain((0..n).filter(|j| !given(j) && *j != over)).chain([over]);
    let mut kept = Vec::new();
    for j in order {
        let before = matrix.len();
        matrix.extend((0..width).map(|i| if i == j { 1.0 } else { 0.0 }));
        let more = rank_of(&matrix);
        if more > rank {
            rank = more;
            kept.push(j);
        } else {
            matrix.truncate(before);
        }
    }
    kept
}
