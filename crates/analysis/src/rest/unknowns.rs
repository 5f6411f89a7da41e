//! Unknown parameters from statics, with everything that holds: connections, ropes, supports, dry friction at its limit.
//!
//! ```text
//! forces, places, balances = 0        over q, λ, u                 see [`super::system`]
//! q_j = start_j(u)                    coordinates that are given, and others as far as the connections leave them open
//! F_k = ± μ_k |N_k|                   frictions about to slide: λ > 0 resists sliding forward
//! ```
//!
//! The sign of each N is at first that of the guess on the way. Where that ends nowhere or at what cannot hold, every set of signs is tried, each held fast:
//! F_k = ± μ_k σ_k N_k, which counts only with σ_k N_k ≥ 0.

use symbolic::Equations;
use symbolic::connections::Law;
use words::Text;

use super::admissible::Holds;
use super::faults::{force_unit, unbalanced, undetermined};
use super::newton::{self, worst};
use super::system::{Parts, RestSystem, Row, Rows};
use super::{closed_contacts, faults, hold};
use crate::Fault;
use crate::connections::assemble;
use algebra::qr;
use algebra::vectors::norm;

/// Share of an unknown in a direction that changes no equation, above which it is open.
const OPEN: f64 = 1e-7;
/// Residual of the equations at the end.
const UNBALANCED: f64 = 1e-9;

/// Frictions about to slide of which every set of signs of normal forces is tried.
const SIGNS: usize = 6;
/// A normal force of the other sign below this share of the largest is rounding.
const TURNED: f64 = 1e-9;

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
/// would push or a friction would have to exceed its limit, S082 a journal, S167 a friction on a surface that moves; faults of the assembly.
pub fn unknowns(equations: &Equations, parameters: &[usize], impending: &[Impending]) -> Result<Found, Fault> {
    if let Some(refused) = faults::journal_with_unknowns(equations) {
        return Err(refused);
    }
    let numbers: Vec<f64> = equations.parameters.iter().map(|p| p.value).collect();
    let start = if equations.coordinates.is_empty() { Vec::new() } else { assemble(equations, &numbers)?.start };
    let q = &start[..equations.coordinates.len()];
    if let Some(refused) = super::surfaces::moving(equations, &numbers, q)? {
        return Err(refused);
    }
    let closed = closed_contacts(equations, q, &numbers)?;
    let mut parts = Parts::holding(equations, |r| closed.contains(&r));
    parts.unknowns = parameters.to_vec();
    let mut system = RestSystem::new(equations, parts, &numbers)?;
    let mut z = system.z(q);
    newton::balance(&mut system, &mut z)?;
    let kept = kept(equations, &mut system, &z)?;
    let given: Vec<bool> = equations.coordinates.iter().map(|c| c.given[0]).collect();
    let start_of = |j: usize| if given[j] { None } else { Some(q[j]) };
    let follows = follows(&mut system, &z, &kept)?;
    let starts = Starts { all: (0..q.len()).map(start_of).collect(), kept, follows, on_rates: system.rate_only.clone() };
    let limits = limit_rows(&system, impending);
    let first = system.n + system.reactions.len();
    let mut search = Search { equations, system, start: z, starts, impending };
    let own = match search.with(&limits)? {
        Tried::Holds(z) => return Ok(Found { values: z[first..].to_vec(), notes: Vec::new() }),
        other => other,
    };
    let mut balanced = !matches!(own, Tried::Unbalanced(_));
    for set in signs(&limits) {
        match search.with(&set) {
            Ok(Tried::Holds(z)) => return Ok(Found { values: z[first..].to_vec(), notes: Vec::new() }),
            Ok(Tried::Refused(_) | Tried::Slips) => balanced = true,
            // this set leaves an unknown open, or its formulas end: it is none to answer with
            Ok(Tried::Unbalanced(_)) | Err(_) => {}
        }
    }
    match own {
        Tried::Refused(fault) => Err(fault),
        Tried::Unbalanced(fault) if !balanced => Err(fault),
        _ => Err(never(equations, parameters, impending)),
    }
}

/// No load slides it this way.
fn never(equations: &Equations, parameters: &[usize], impending: &[Impending]) -> Fault {
    let name = |p: &usize| equations.graph.symbol_info(equations.parameters[*p].symbol).name.as_str();
    let unknown: Vec<&str> = parameters.iter().map(name).collect();
    let about: Vec<&str> = impending.iter().map(|(r, _)| equations.reactions[*r].name.as_str()).collect();
    faults::never_impending(&unknown.join(", "), &about.join(", "))
}

/// What one choice of the signs of normal forces leads to.
enum Tried {
    /// A place of rest: z.
    Holds(Vec<f64>),
    /// Balanced, but a friction would exceed its limit, or a normal force has the other sign.
    Slips,
    /// Balanced, but something is on its wrong side.
    Refused(Fault),
    /// Not balanced.
    Unbalanced(Fault),
}

/// Where the machine stands.
struct Starts {
    /// Numbers of the coordinates that are not given; those of the others follow from the unknowns.
    all: Vec<Option<f64>>,
    /// Coordinates that stand there.
    kept: Vec<usize>,
    /// Which others follow from these by conditions that have a place, wherever the unknowns lead.
    follows: Vec<bool>,
    /// Which places are those of conditions on rates.
    on_rates: Vec<bool>,
}

impl Starts {
    /// Start of a coordinate as a row over the unknowns.
    fn row(&self, rows: &Rows, j: usize) -> Row {
        match self.all[j] {
            Some(value) => Row { value, slopes: vec![0.0; rows.starts[j].slopes.len()], terms: 1.0, is_force: false },
            None => rows.starts[j].clone(),
        }
    }

    /// q_j - start_j(u)
    fn away(&self, rows: &Rows, z: &[f64], j: usize) -> Row {
        let mut row = self.row(rows, j);
        row.terms = row.terms.max(1.0);
        row.value = z[j] - row.value;
        row.slopes.iter_mut().for_each(|s| *s = -*s);
        row.slopes[j] += 1.0;
        row
    }

    /// Conditions on rates hold from the start on, wherever the unknowns move it: J (q - start(u)) = 0, which ends at q = start(u) where all coordinates stand.
    fn place(&self, rows: &Rows, z: &[f64], c: usize) -> Row {
        let own = &rows.places[c];
        if !self.on_rates[c] {
            return own.clone();
        }
        let mut row = Row { value: 0.0, slopes: vec![0.0; z.len()], ..own.clone() };
        for j in (0..self.all.len()).filter(|j| own.slopes[*j] != 0.0 && !self.follows[*j]) {
            let away = self.away(rows, z, j);
            row.value += own.slopes[j] * away.value;
            row.slopes.iter_mut().zip(&away.slopes).for_each(|(s, a)| *s += own.slopes[j] * a);
        }
        row
    }
}

struct Search<'s> {
    equations: &'s Equations,
    system: RestSystem,
    /// z of the guess.
    start: Vec<f64>,
    starts: Starts,
    impending: &'s [Impending],
}

impl Search<'_> {
    /// *Errors*: S036, S094 an unknown that stays open; formulas outside their domain.
    fn with(&mut self, limits: &[Limited]) -> Result<Tried, Fault> {
        let (starts, system) = (&self.starts, &mut self.system);
        let choose = |rows: &Rows, z: &[f64]| chosen(rows, z, starts, limits);
        let free: Vec<usize> = (0..system.width()).collect();
        let mut z = self.start.clone();
        let solved = newton::solve(system, &mut z, &free, &choose);
        let all = system.at(&z)?;
        let rows = choose(&all, &z);
        determined(self.equations, system, &rows, self.impending)?;
        if solved?.is_none() && worst(&rows, &z) > UNBALANCED {
            // what stays may stay in the limits alone
            let without = chosen(&all, &z, starts, &[]);
            let by_limits = !limits.is_empty() && worst(&without, &z) <= UNBALANCED;
            return Ok(if by_limits { Tried::Slips } else { Tried::Unbalanced(left_over(self.equations, &all, &z)) });
        }
        if limits.iter().any(|limit| limit.is_turned(&all)) {
            return Ok(Tried::Slips);
        }
        let hold = hold(self.equations, system, &all, &z);
        let judged = hold.judge();
        if matches!(judged, Holds::Slips(_)) && !self.impending.is_empty() {
            return Ok(Tried::Slips);
        }
        Ok(super::fault_of(self.equations, &system.reactions, &hold, &judged).map_or(Tried::Holds(z), Tried::Refused))
    }
}

/// Every set of signs of the normal forces of these frictions, pressed ones first; none where there are too many.
pub(super) fn signs(limits: &[Limited]) -> Vec<Vec<Limited>> {
    if limits.is_empty() || limits.len() > SIGNS {
        return Vec::new();
    }
    let sign = |set: usize, k: usize| if set >> k & 1 == 1 { -1.0 } else { 1.0 };
    let one = |set: usize| limits.iter().enumerate().map(|(k, l)| Limited { sign: Some(sign(set, k)), ..*l }).collect();
    (0..1_usize << limits.len()).map(one).collect()
}

/// Which coordinates follow from those that stand by conditions that have a place.
fn follows(system: &mut RestSystem, z: &[f64], kept: &[usize]) -> Result<Vec<bool>, Fault> {
    let n = system.n;
    let rows = system.at(z)?;
    let unit = |j: usize| (0..n).map(|k| if k == j { 1.0 } else { 0.0 }).collect::<Vec<f64>>();
    let placed = rows.places.iter().zip(&system.rate_only).filter(|(_, only)| !**only).map(|(r, _)| r.slopes[..n].to_vec());
    let mut vectors: Vec<Vec<f64>> = placed.chain(kept.iter().map(|j| unit(*j))).collect();
    let rank = rank_of(&vectors, n);
    let mut follow = |j: usize| {
        vectors.push(unit(j));
        let more = rank_of(&vectors, n);
        vectors.pop();
        more == rank && !kept.contains(&j)
    };
    Ok((0..n).map(&mut follow).collect())
}

/// Rank of directions, each scaled to length one.
fn rank_of(vectors: &[Vec<f64>], n: usize) -> usize {
    let scaled: Vec<f64> = vectors.iter().filter(|v| norm(v) > 0.0).flat_map(|v| v.iter().map(move |a| a / norm(v))).collect();
    qr::rank(&scaled, scaled.len() / n.max(1), n)
}

/// Coordinates that stand at their start: the given ones, and of the others, in their order, those that the places leave open.
fn kept(equations: &Equations, system: &mut RestSystem, z: &[f64]) -> Result<Vec<usize>, Fault> {
    let n = system.n;
    let rows = system.at(z)?;
    let mut vectors: Vec<Vec<f64>> = rows.places.iter().map(|r| r.slopes[..n].to_vec()).collect();
    let unit = |j: usize| (0..n).map(|k| if k == j { 1.0 } else { 0.0 }).collect::<Vec<f64>>();
    let coordinates = &equations.coordinates;
    let mut kept: Vec<usize> = (0..n).filter(|j| coordinates[*j].given[0]).collect();
    vectors.extend(kept.iter().map(|j| unit(*j)));
    let mut rank = rank_of(&vectors, n);
    let others = (0..n).filter(|j| !coordinates[*j].given[0] && !coordinates[*j].guessed[0]);
    for j in others.chain((0..n).filter(|j| coordinates[*j].guessed[0] && !coordinates[*j].given[0])) {
        vectors.push(unit(j));
        let more = rank_of(&vectors, n);
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

/// A friction at its limit.
#[derive(Clone, Copy, Debug)]
pub(super) struct Limited {
    /// Index among the frictions of the system.
    friction: usize,
    /// Column of its force in z.
    column: usize,
    /// Forward 1, backward -1.
    direction: f64,
    /// Sign of the normal force; none: as it is where the row is asked.
    sign: Option<f64>,
}

impl Limited {
    /// F = ± μ |N|.
    pub(super) fn row(&self, rows: &Rows, z: &[f64]) -> Row {
        let (fixed, normal) = &rows.limits[self.friction];
        let sign = self.direction * self.sign.unwrap_or(if normal.value < 0.0 { -1.0 } else { 1.0 });
        let terms = fixed.terms * normal.value.abs() + fixed.value.abs() * normal.terms;
        let slope = |j: usize| -sign * (fixed.slopes[j] * normal.value + fixed.value * normal.slopes[j]);
        let mut row = Row {
            value: z[self.column] - sign * fixed.value * normal.value,
            slopes: (0..z.len()).map(slope).collect(),
            terms,
            is_force: true,
        };
        row.slopes[self.column] += 1.0;
        row
    }

    /// Whether the normal force has the other sign than was taken.
    pub(super) fn is_turned(&self, rows: &Rows) -> bool {
        let size = rows.limits.iter().fold(0.0_f64, |m, (_, normal)| m.max(normal.value.abs()));
        self.sign.is_some_and(|sign| sign * rows.limits[self.friction].1.value < -TURNED * size)
    }
}

/// These frictions at their limits.
pub(super) fn limit_rows(system: &RestSystem, impending: &[Impending]) -> Vec<Limited> {
    let place = |(r, direction): &Impending| {
        let friction = system.frictions.iter().position(|f| f == r)?;
        let column = system.reactions.iter().position(|own| own == r)?;
        Some(Limited { friction, column: system.n + column, direction: *direction, sign: None })
    };
    impending.iter().filter_map(place).collect()
}

fn chosen(rows: &Rows, z: &[f64], starts: &Starts, limits: &[Limited]) -> Vec<Row> {
    let mut all = rows.forces.clone();
    all.extend((0..rows.places.len()).map(|c| starts.place(rows, z, c)));
    all.extend(rows.balances.iter().cloned());
    all.extend(starts.kept.iter().map(|j| starts.away(rows, z, *j)));
    all.extend(limits.iter().map(|limit| limit.row(rows, z)));
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
fn left_over(equations: &Equations, rows: &Rows, z: &[f64]) -> Fault {
    let coordinate = |i: usize| equations.graph.symbol_info(equations.coordinates[i].symbols[0]).name.clone();
    let worst_of = |rows: &[Row]| {
        let at = |i: usize| newton::relative(&rows[i], z);
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
