//! One-sided contacts of a machine whose place of rest is followed along a parameter: which are closed, and up to where they may be.
//!
//! ```text
//! closed:  λ ≥ 0, the contact is a lasting connection of small motions
//! open:    gap ≥ 0, the contact is gone
//! ```
//!
//! Where one of these comes to zero the set of closed contacts changes, and with it the equations of small motions: a machine for every set.

use algebra::arrange::Arrange;
use std::sync::Arc;

use symbolic::Equations;
use symbolic::connections::Law;
use symbolic::linear::About;

use super::stability::with_closed;
use crate::Fault;
use crate::linear::{LinearMachine, Place};
use crate::rest::mean::Resting;
use crate::rest::system::{Parts, RestSystem};
use crate::rest::{CLOSED, gap_size};

/// Contacts of which every set of closed ones may be tried.
const MOST: usize = 6;
/// A force of a closed contact below this share of the largest reaction is none: places of rest are known to some ten digits.
pub const SLACK: f64 = 1e-9;
/// The same relative to what the machine's stiffnesses make of a unit of its coordinates: rounding.
const ROUNDING: f64 = 1e-14;
/// Share of a scale below which a force or a gap counts as about to vanish.
const ABOUT: f64 = 1e-5;

/// How a contact stands at a place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Margin {
    /// Index of the reaction.
    pub contact: usize,
    /// Force of a closed contact, gap of an open one; not negative where the contact may stand so.
    pub value: f64,
    /// Rounding of that value.
    pub rounding: f64,
    /// Size with which it compares.
    pub scale: f64,
}

impl Margin {
    /// Whether the contact cannot stand so.
    pub fn is_violated(&self) -> bool {
        self.value < -self.rounding
    }
}

/// The contacts of a machine, and its linear machines for sets of closed ones.
#[derive(Clone, Debug)]
pub struct Contacts {
    equations: Arc<Equations>,
    resting: Resting,
    gaps: RestSystem,
    /// Set of the machine that is in use.
    held: Vec<usize>,
    /// Machines that are not in use.
    others: Vec<(Vec<usize>, LinearMachine)>,
}

impl Contacts {
    /// Of equations of motion and the contacts that the machine in use has closed; none where there are no contacts.
    ///
    /// *Errors*: formulas outside their domain.
    pub fn new(equations: &Equations, closed: &[usize]) -> Result<Option<Contacts>, Fault> {
        if !equations.reactions.iter().any(|r| matches!(r.law, Law::Contact { .. })) {
            return Ok(None);
        }
        let mut resting = Resting::new(equations)?;
        let own: Vec<f64> = equations.parameters.iter().map(|p| p.value).collect();
        let values = resting.values(&own)?;
        let gaps = RestSystem::new(resting.equations(), Parts::default(), &values)?;
        Ok(Some(Contacts { equations: Arc::new(equations.clone()), resting, gaps, held: closed.to_vec(), others: Vec::new() }))
    }

    /// Contacts (by reaction) that the machine in use has closed.
    pub fn held(&self) -> &[usize] {
        &self.held
    }

    /// The name of a contact's reaction.
    pub fn name(&self, contact: usize) -> &str {
        &self.equations.reactions[contact].name
    }

    /// Puts the machine with these contacts closed in place of the one in use, with the same numbers.
    ///
    /// *Errors*: formulas outside their domain.
    pub fn hold(&mut self, machine: &mut LinearMachine, closed: &[usize]) -> Result<(), Fault> {
        if self.held == closed {
            return Ok(());
        }
        let mut next = match self.others.iter().position(|(set, _)| set == closed) {
            Some(k) => self.others.swap_remove(k).1,
            None => LinearMachine::new(&Arc::new(with_closed(&self.equations, closed)), About::Rest)?.seeking_as(machine),
        };
        next.renumber(machine.numbers())?;
        let last = std::mem::replace(machine, next);
        self.others.push((std::mem::replace(&mut self.held, closed.to_vec()), last));
        Ok(())
    }

    /// How every contact stands at a place of the machine in use.
    ///
    /// *Errors*: a gap without a value there.
    pub fn margins(&mut self, machine: &mut LinearMachine, place: &Place) -> Result<Vec<Margin>, Fault> {
        let values = self.resting.values(machine.numbers())?;
        self.gaps.set(&values, &[])?;
        let rows = self.gaps.at(&self.gaps.z(&place.q))?;
        let matrices = machine.at(place)?;
        let n = place.q.len();
        let stiff = |i: usize| (0..n).map(|j| (matrices.stiffness[i * n + j] * place.q[j].abs().max(1.0)).abs()).sum::<f64>();
        let stiffest = (0..n).map(stiff).fold(0.0, f64::max);
        let largest = place.multipliers.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
        let multipliers = &machine.linear().multipliers;
        let one = |(contact, gap): (&usize, &crate::rest::system::Row)| {
            let symbol = self.equations.reactions[*contact].symbol;
            let force = multipliers.iter().position(|m| *m == symbol).filter(|_| self.held.contains(contact));
            match force {
                Some(k) => {
                    let rounding = (SLACK * largest).max(ROUNDING * stiffest);
                    Margin { contact: *contact, value: place.multipliers[k], rounding, scale: largest.max(ROUNDING * stiffest) }
                }
                None => {
                    let size = gap_size(gap, &place.q);
                    Margin { contact: *contact, value: gap.value, rounding: CLOSED * size, scale: size }
                }
            }
        };
        Ok(self.gaps.contacts.iter().zip(&rows.gaps).map(one).collect())
    }

    /// Sets of closed contacts that may follow on one of which these are the margins where it ends, least changes first.
    pub fn successors(&self, margins: &[Margin], violated: &[usize]) -> Vec<Vec<usize>> {
        let about = |m: &&Margin| !violated.contains(&m.contact) && m.value.abs() <= ABOUT * m.scale;
        let mut active = violated.to_vec();
        active.extend(margins.iter().filter(about).map(|m| m.contact));
        active.truncate(MOST.max(violated.len()));
        let mut sets: Vec<Vec<usize>> = vec![violated.to_vec()];
        if active.len() <= MOST {
            let subset = |bits: usize| active.iter().enumerate().filter(|(i, _)| bits >> i & 1 == 1).map(|(_, c)| *c).collect();
            let mut all: Vec<Vec<usize>> = (1..1_usize << active.len()).map(subset).collect();
            all.arrange_by_key(Vec::len);
            sets.extend(all.into_iter().filter(|s| *s != violated));
        }
        sets.iter().map(|changed| self.toggled(changed)).collect()
    }

    /// Every set of closed contacts while they are few, that of the machine in use first.
    pub fn all(&self) -> Vec<Vec<usize>> {
        let contacts = &self.gaps.contacts;
        let mut list = vec![self.held.clone()];
        if contacts.len() <= MOST {
            let subset = |bits: usize| contacts.iter().enumerate().filter(|(i, _)| bits >> i & 1 == 1).map(|(_, c)| *c).collect();
            list.extend((0..1_usize << contacts.len()).map(subset).filter(|s: &Vec<usize>| *s != self.held));
        }
        list
    }

    fn toggled(&self, changed: &[usize]) -> Vec<usize> {
        let all = self.gaps.contacts.iter();
        all.filter(|c| self.held.contains(c) != changed.contains(c)).copied().collect()
    }
}
