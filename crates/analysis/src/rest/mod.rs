//! Rest: equilibria, unknown loads and reactions of machines with connections, one-sided contacts and dry friction.
//!
//! One system of equations ([`system`]) serves all three; `newton` solves it, [`places`] finds equilibria on the surface of the connections,
//! [`admissible`] decides what ropes, contacts and friction can hold; [`search`] serves machines without connections. What small motions say about a place of
//! rest stands above, in `studies::rest`.

pub mod admissible;
mod doubles;
pub mod faults;
pub(crate) mod fine;
pub(crate) mod formulas;
pub(crate) mod limiting;
pub mod mean;
pub mod near;
pub(crate) mod newton;
pub mod numbers;
pub mod observed;
pub mod path;
pub mod places;
mod poles;
pub(crate) mod rows;
pub mod search;
mod settled;
pub mod sizes;
pub(crate) mod surfaces;
pub mod system;
pub mod unknowns;

use symbolic::Equations;
use symbolic::connections::Law;

use crate::Fault;
use crate::rest::admissible::{Hold, Holds, Limit};
use crate::rest::system::{Parts, RestSystem, Rows};

/// Gap of a contact, relative to the machine, that counts as closed.
pub(crate) const CLOSED: f64 = 1e-9;

/// Which contacts (by reaction) are closed at these coordinates.
///
/// *Errors*: a formula has no value there.
pub fn closed_contacts(equations: &Equations, q: &[f64], parameters: &[f64]) -> Result<Vec<usize>, Fault> {
    let mut system = RestSystem::new(equations, Parts::default(), parameters)?;
    if system.contacts.is_empty() {
        return Ok(Vec::new());
    }
    let z = system.z(q);
    let rows = system.at(&z)?;
    let closed = |(_, gap): &(&usize, &system::Row)| gap.value <= CLOSED * gap_size(gap, q);
    Ok(system.contacts.iter().zip(&rows.gaps).filter(closed).map(|(r, _)| *r).collect())
}

/// Size of the lengths that meet in a gap.
pub(crate) fn gap_size(gap: &system::Row, q: &[f64]) -> f64 {
    gap.slopes[..q.len()].iter().zip(q).map(|(s, q)| s.abs() * q.abs().max(1.0)).sum::<f64>().max(f64::MIN_POSITIVE)
}

/// What can hold at a place: the equations there, contacts and frictions.
pub(crate) fn hold(equations: &Equations, system: &RestSystem, rows: &Rows, z: &[f64]) -> Hold {
    let (n, k) = (system.n, system.reactions.len());
    let all = || rows.forces.iter().chain(&rows.balances);
    let constant = |row: &system::Row| row.value - (0..k).map(|c| row.slopes[n + c] * z[n + c]).sum::<f64>();
    let matrix: Vec<f64> = all().flat_map(|r| r.slopes[n..n + k].iter().copied()).collect();
    let right: Vec<f64> = all().map(|r| -constant(r)).collect();
    let mut hold = Hold::new(&matrix, &right, k);
    let column = |r: usize| system.reactions.iter().position(|own| *own == r);
    hold.contacts = (0..k).filter(|c| matches!(equations.reactions[system.reactions[*c]].law, Law::Contact { .. })).collect();
    for (r, (fixed, normal)) in system.frictions.iter().zip(&rows.limits) {
        let (Law::Friction(friction), Some(own)) = (&equations.reactions[*r].law, column(*r)) else { continue };
        let terms = || (0..k).filter(|c| normal.slopes[n + c] != 0.0).map(|c| (c, normal.slopes[n + c])).collect();
        let normal = friction.normal.as_ref().map(|_| (constant(normal), terms()));
        hold.limits.push(Limit { column: own, coefficient: fixed.value, normal });
    }
    hold
}

/// The fault of a machine that is not held; none when it is.
pub(crate) fn fault_of(equations: &Equations, reactions: &[usize], hold: &Hold, holds: &Holds) -> Option<Fault> {
    match holds {
        Holds::Between(_) => None,
        Holds::WrongSide(c) => {
            let reaction = &equations.reactions[reactions[*c]];
            let fault = if matches!(reaction.law, Law::Contact { tie: true, .. }) { Fault::rope_pushes } else { Fault::contact_pulls };
            Some(fault(&reaction.name, hold.some[*c], &reaction.unit))
        }
        Holds::Slips(times) => {
            let names: Vec<&str> = hold.limits.iter().map(|l| equations.reactions[reactions[l.column]].name.as_str()).collect();
            Some(faults::slips(&names.join(", "), *times))
        }
    }
}
