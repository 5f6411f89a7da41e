//! Contacts that only touch at a place of rest: closed, and pressed by no force.
//!
//! A contact that presses holds small motions like a connection. One that is pressed by nothing does not: it only keeps them on one side,
//!
//! ```text
//! y: motions along the surface of the connections and of what presses,      a_k·y ≥ 0 of each contact k that touches
//!
//! V = ½ yᵀ K y + ... grows along all y that these allow      stable (Lagrange, Dirichlet)
//! V falls along one of them                                  unstable
//! ```
//!
//! The least yᵀ K y over unit vectors of that cone is taken at an eigenvector of K along a face of it, where some a_k·y = 0. Where it is zero, in one direction, the
//! force of higher order decides on the sides that are allowed ([`super::degenerate`]). Whether V falls is asked only where the active a_k are independent: only there does
//! a motion along a face belong to the machine whatever the gaps are to second order.
//!
//! A force that is not unique presses where some share of the load makes it press.
//!
//! *Source*: J. Nocedal, S. J. Wright, Numerical Optimization, 12.5 (critical cone, second-order conditions).

use super::contacts::SLACK;
use super::degenerate::{Sides, Way, along_one};
use super::stability::scales;
use crate::Fault;
use crate::linear::{LinearMachine, Matrices, Place, largest, parts};
use crate::rest::admissible::{Hold, Holds};
use crate::rest::newton::balance;
use crate::rest::places::{Place as Rest, is_noise};
use crate::rest::system::{Parts, RestSystem};
use crate::rest::{closed_contacts, hold};
use algebra::vectors::{dot, norm};
use algebra::{eigen, qr};
use symbolic::Equations;
use symbolic::connections::Law;
use words::Text;

/// Contacts that touch of which all faces are gone through.
const MOST: usize = 6;
/// Share of a slope that counts as none, and of the largest stiffness.
const NOTHING: f64 = 1e-9;

/// The contacts (by reaction) that are closed at a place of rest.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Standing {
    /// Those that hold small motions.
    pub pressing: Vec<usize>,
    /// Those that only touch, with the slopes of their gaps by the coordinates.
    pub touching: Vec<(usize, Vec<f64>)>,
}

/// How the closed contacts stand at a place of rest.
///
/// *Errors*: a formula without a value there.
pub fn standing(equations: &Equations, parameters: &[f64], place: &Rest) -> Result<Standing, Fault> {
    let mut closed = closed_contacts(equations, &place.q, parameters)?;
    closed.extend(&place.closed);
    closed.sort_unstable();
    closed.dedup();
    if closed.is_empty() {
        return Ok(Standing::default());
    }
    let mut parts = Parts::holding(equations, |r| closed.contains(&r));
    parts.reactions.retain(|r| !matches!(equations.reactions[*r].law, Law::Friction(_)));
    let mut system = RestSystem::new(equations, parts, parameters)?;
    let mut z = system.z(&place.q);
    balance(&mut system, &mut z)?;
    let rows = system.at(&z)?;
    let hold = hold(equations, &system, &rows, &z);
    let most = most(&hold);
    let unit = largest(&hold.some);
    let (n, sizes) = (system.n, system.sizes().at(&[&place.q]));
    let mut out = Standing::default();
    for r in closed {
        let column = system.reactions.iter().position(|own| *own == r);
        let force = column.map_or(0.0, |c| most[c]);
        column.into_iter().for_each(|c| z[n + c] = force);
        let presses = force > SLACK * unit && column.is_some_and(|c| !is_noise(&rows, &z, &sizes, n + c));
        let gap = system.contacts.iter().position(|own| *own == r).map(|k| rows.gaps[k].slopes[..n].to_vec());
        match gap.filter(|_| !presses) {
            Some(slopes) => out.touching.push((r, slopes)),
            None => out.pressing.push(r),
        }
    }
    Ok(out)
}

/// The greatest value of each reaction.
fn most(hold: &Hold) -> Vec<f64> {
    let ranges = match hold.free.is_empty() {
        true => None,
        false => Some(hold.judge()),
    };
    let of = |c: usize| match &ranges {
        None => hold.some[c],
        Some(Holds::Between(ranges)) => ranges[c].1,
        Some(_) if hold.is_unique(c) => hold.some[c],
        Some(_) => f64::INFINITY,
    };
    (0..hold.some.len()).map(of).collect()
}

/// The slopes along the motions that are allowed, of length 1; none where the gap does not change along them.
fn reduced(slopes: &[f64], basis: Option<&(Vec<f64>, usize)>) -> Option<Vec<f64>> {
    let own: Vec<f64> = match basis {
        Some((z, k)) => (0..*k).map(|c| slopes.iter().enumerate().map(|(i, a)| a * z[i * k + c]).sum()).collect(),
        None => slopes.to_vec(),
    };
    (norm(&own) > NOTHING * norm(slopes)).then_some(own)
}

/// Whether one of these contacts keeps a motion that the machine has on one side.
///
/// *Errors*: a formula without a value there.
pub fn bounds(machine: &mut LinearMachine, place: &Place, touching: &[(usize, Vec<f64>)]) -> Result<bool, Fault> {
    let basis = machine.at(place)?.allowed();
    Ok(touching.iter().any(|(_, slopes)| reduced(slopes, basis.as_ref()).is_some()))
}

/// Whether the place is stable; none where that is not decided. The machine has the contacts that press as connections.
pub fn verdict(machine: &mut LinearMachine, place: &Place, touching: &[(usize, Vec<f64>)]) -> Option<bool> {
    let matrices = machine.at(place).ok()?;
    let basis = matrices.allowed();
    let along = basis.as_ref().map_or(matrices.clone(), |(z, k)| matrices.reduced(z, *k));
    let (_, odd) = parts(&along.stiffness, along.n);
    let (_, gyroscopic) = parts(&along.damping, along.n);
    if largest(&odd) > NOTHING * largest(&along.stiffness) {
        return None;
    }
    let calm = along.calm();
    let free = largest(&gyroscopic) == 0.0;
    let bounds: Vec<Option<Vec<f64>>> = touching.iter().map(|(_, slopes)| reduced(slopes, basis.as_ref())).collect();
    let blind = bounds.contains(&None);
    let energy = match energy(&along, &bounds.into_iter().flatten().collect::<Vec<_>>()) {
        Energy::Flat if !blind => {
            let slopes: Vec<&[f64]> = touching.iter().map(|(_, slopes)| &slopes[..]).collect();
            higher(machine, place, &slopes)
        }
        Energy::Falls if blind => Energy::Flat,
        found => found,
    };
    match energy {
        Energy::Grows if calm => Some(true),
        Energy::Falls if free => Some(false),
        _ => None,
    }
}

/// How the energy goes along the motions that are allowed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Energy {
    Grows,
    Falls,
    Flat,
}

/// The same to second order.
fn energy(along: &Matrices, bounds: &[Vec<f64>]) -> Energy {
    let n = along.n;
    if along.definite() == Some(true) {
        return Energy::Grows;
    }
    let units = scales(along);
    let (even, _) = parts(&(0..n * n).map(|p| units[p / n] * along.stiffness[p] * units[p % n]).collect::<Vec<_>>(), n);
    let bounds: Vec<Vec<f64>> = bounds
        .iter()
        .map(|a| {
            let own: Vec<f64> = a.iter().zip(&units).map(|(a, u)| a * u).collect();
            let length = norm(&own);
            own.iter().map(|a| a / length).collect()
        })
        .collect();
    if bounds.len() > MOST {
        return Energy::Flat;
    }
    let size = largest(&even);
    let mut worst = Energy::Grows;
    for set in 0..1_usize << bounds.len() {
        for (value, direction) in stationary((&even, n), &bounds, set) {
            let on: Vec<f64> = bounds.iter().filter(|a| dot(a, &direction).abs() <= NOTHING).flatten().copied().collect();
            let regular = qr::rank(&on, on.len() / n, n) == on.len() / n;
            if value < -NOTHING * size && regular {
                return Energy::Falls;
            }
            if value <= NOTHING * size {
                worst = Energy::Flat;
            }
        }
    }
    worst
}

/// Eigenvectors along the face on which the bounds of a set are met, of length 1, that lie within the others; with yᵀ K y.
fn stationary((even, n): (&[f64], usize), bounds: &[Vec<f64>], set: usize) -> Vec<(f64, Vec<f64>)> {
    let met: Vec<f64> = bounds.iter().enumerate().filter(|(k, _)| set >> k & 1 == 1).flat_map(|(_, a)| a.iter().copied()).collect();
    let basis: Vec<Vec<f64>> = if met.is_empty() {
        (0..n).map(|i| (0..n).map(|j| f64::from(u8::from(i == j))).collect()).collect()
    } else {
        qr::null_space(&met, met.len() / n, n)
    };
    let k = basis.len();
    let form = |a: &dyn Fn(&[f64], &[f64]) -> f64| -> Vec<f64> { (0..k * k).map(|p| a(&basis[p / k], &basis[p % k])).collect() };
    let stiff = form(&|a, b| even.chunks(n).zip(a).map(|(row, a)| a * dot(row, b)).sum());
    let Ok(found) = eigen::symmetric(k, &stiff, &form(&dot)) else { return Vec::new() };
    let mut out = Vec::new();
    for (j, value) in found.values.iter().enumerate() {
        let own: Vec<f64> = (0..n).map(|i| basis.iter().zip(found.shape(j)).map(|(b, y)| b[i] * y).sum()).collect();
        let length = norm(&own);
        for sign in [length.recip(), -length.recip()] {
            let y: Vec<f64> = own.iter().map(|v| sign * v).collect();
            if bounds.iter().all(|a| dot(a, &y) >= -NOTHING) {
                out.push((*value, y));
            }
        }
    }
    out
}

/// The same by the forces of higher order, along the only direction without stiffness.
fn higher(machine: &mut LinearMachine, place: &Place, slopes: &[&[f64]]) -> Energy {
    let mut across = false;
    let mut sides = |shape: &[f64]| {
        let mut sides = Sides::Both;
        for a in slopes {
            let along = dot(a, shape);
            across |= along.abs() <= NOTHING * norm(a) * norm(shape);
            sides = sides.within(along);
        }
        sides
    };
    match along_one(machine, place, &mut sides) {
        Some(Way::Rises) => Energy::Grows,
        // beside a contact that the direction does not leave the other motions are bounded, too
        Some(Way::Falls) if !across => Energy::Falls,
        _ => Energy::Flat,
    }
}

/// What is to be said of such places: the contacts by their labels, and the verdicts.
pub fn remark(labels: &[&Text], verdicts: &[Option<bool>]) -> Text {
    let list = |pick: fn(&Text) -> &str| labels.iter().map(|label| pick(label)).collect::<Vec<_>>().join(", ");
    let (en, ru) = match !verdicts.contains(&None) {
        true => (
            "whether the place is stable is told by the energy along those that are allowed",
            "об устойчивости судят по энергии на допустимых движениях",
        ),
        false => ("whether the place is stable is not decided", "вопрос об устойчивости не решён"),
    };
    Text::new(
        format!(
            "a one-sided contact is closed at a place of rest and presses with no force ({}): it only touches, small motions are one-sided and have no roots; {en}",
            list(|t| &t.en)
        ),
        format!(
            "односторонняя связь в положении равновесия замкнута, но не нагружена ({}): она лишь касается, малые движения односторонние и корней не имеют; {ru}",
            list(|t| &t.ru)
        ),
    )
}
