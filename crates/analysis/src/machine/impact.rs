//! Impacts: rates jump while positions stand still.
//!
//! With impulses Λ of contacts and frictions ("units"), bilateral conditions kept (J_b q' = 0 before and after):
//!
//! ```text
//! | M   -F_b | | dq'_j |   | f_j |
//! | J_b   0  | | Λ_bj  | = |  0  |          response to a unit impulse of unit j, f_j its generalized force
//! u+ = u- + G Λ,   G_ij = J_i dq'_j          rates of the gaps and sliding speeds; surfaces may move in time
//! contact   0 <= Λ,  u+ >= -e u-,  Λ (u+ + e u-) = 0                         Newton
//! friction  |Λ_t| <= μ |Λ_n|,  u_t+ = 0 or Λ_t = ±μ Λ_n with Λ_t u_t+ >= 0    Coulomb, over the whole impact
//! ```
//!
//! Λ_n is the impulse of whatever presses the friction: a contact, a guide, a support; of a journal both components, |Λ_n| = √(Λ_x² + Λ_y²), whose
//! direction is found by repetition. Frictions of a given force take no impulse, however large. What is rough (a wheel that rolls while it touches)
//! does not slip afterwards, whatever that takes.
//!
//! With a tangential restitution ε of the contact a friction that sticks leaves u_t+ = -ε u_t-.
//!
//! Poisson's restitution: `phases.rs`.
//!
//! **Energy.** A blow does the work Σ ± Λ (u- + u+)/2, + for contacts, - for frictions (λ > 0 resists). Impulses of rigid bodies cannot give energy, but a ratio of
//! rates asked for at an eccentric contact with friction may (Kane's paradox), and so may ratios that differ among contacts that strike together. Such a blow
//! is refused.
//!
//! **Several contacts** strike in sequence: the contact that closes fastest (those that close equally fast together), then again, until none closes. Or all
//! that close or stand strike together.
//! *Source*: B. Brogliato, Nonsmooth Mechanics, chapters 5 and 6; Glocker, Set-Valued Force Laws, chapters 7 to 9.

use algebra::lu::Lu;
use program::{Bound, Point};

use super::bilateral::Bilateral;
use super::conditions::{Conditions, Holds};
use super::strike::{Law, Strike, Unit, pressure};
use super::ties::RATE;
use crate::{Blow, Fault, Mode};

/// What a jump of prescribed velocities gives.
#[derive(Clone, Copy, Debug)]
pub(super) struct Kick<'k> {
    /// Generalized impulses, by coordinate.
    pub impulses: &'k [f64],
    /// Change of the momentum that prescribed motions carry, by balance of the released bodies.
    pub carried: &'k [f64],
}

impl Conditions {
    /// See [`crate::System::impact`].
    pub(super) fn impact(
        &mut self,
        (t, x): (f64, &mut [f64]),
        (modes, bound): (&[Mode], &Bound),
        closing: &[usize],
    ) -> Result<Blow, Fault> {
        self.evaluate_in((t, x), (modes, bound))?;
        self.struck((t, x), modes, closing, None)
    }

    /// The same with the last numbers, and generalized impulses given beside, at a jump of prescribed velocities.
    pub(super) fn struck(
        &mut self,
        (t, x): (f64, &mut [f64]),
        modes: &[Mode],
        closing: &[usize],
        kick: Option<Kick<'_>>,
    ) -> Result<Blow, Fault> {
        let values = self.laws.evaluate(&Point { time: t, states: x, ..Point::default() })?.to_vec();
        let units = self.units((modes, closing), &x[self.n..2 * self.n], &values);
        let bilateral = Bilateral::new(self, t)?;
        let n = self.n;
        let still = vec![0.0; n];
        let given = kick.map_or(&still[..], |kick| kick.impulses);
        let (corrected, mut whole) = bilateral.response(self, given, &bilateral.rates(self))?;
        self.support_impulses(&corrected, &mut whole, (&values, kick.map_or(&[], |kick| kick.carried)));
        let mut responses = Vec::with_capacity(units.len());
        let mut reactions = Vec::with_capacity(units.len());
        for unit in &units {
            let force = self.push(unit.reaction).to_vec();
            let (change, mut impulses) = bilateral.response(self, &force, &bilateral.unmoved())?;
            impulses[unit.reaction] = 1.0;
            self.support_impulses(&change, &mut impulses, (&values, &[]));
            responses.push(change);
            reactions.push(impulses);
        }
        let dot = |row: usize, change: &[f64]| self.column(row).iter().zip(change).map(|(j, v)| j * v).sum::<f64>();
        let count = units.len();
        // what holds has no rate, whatever the sign of its rounding, unless its surface has jumped
        let stands = |unit: &Unit| kick.is_none() && modes[unit.guard] == Mode::Zero;
        let rate = |unit: &Unit| if stands(unit) { 0.0 } else { self.rate(unit.row) + dot(unit.row, &corrected) };
        let mut strike = Strike {
            coupling: (0..count * count).map(|k| dot(units[k / count].row, &responses[k % count])).collect(),
            pressure: (0..count * count).map(|k| pressure(&units[k / count], &reactions[k % count])).collect(),
            rates: units.iter().map(rate).collect(),
            noise: units.iter().map(|unit| unit.rounding).collect(),
            impulses: vec![0.0; count],
            sizes: vec![0.0; count],
            carried: units.iter().map(|unit| if kick.is_some() { pressure(unit, &whole) } else { [0.0; 2] }).collect(),
            blows: Vec::new(),
            phased: false,
            work: Default::default(),
            units,
            responses,
        };
        let (before, rates) = (strike.rates.clone(), x[n..2 * n].to_vec());
        strike.follow(self.impacts, t)?;
        let start: Vec<f64> = rates.iter().zip(&corrected).map(|(v, c)| v + c).collect();
        let blows = strike.blows_from(&start, &reactions);
        strike.move_on(&strike.impulses, &start, &mut x[n..2 * n]);
        for (row, p) in reactions.iter().zip(&strike.impulses) {
            whole.iter_mut().zip(row).for_each(|(sum, r)| *sum += r * p);
        }
        let jump: Vec<f64> = (0..n).map(|i| x[n + i] - rates[i]).collect();
        self.drop_rounding(&rates, &jump, &mut whole);
        Ok(Blow { reactions: whole, law: self.impacts, blows, ..strike.blow(&before) })
    }

    /// Impulses that change every momentum by no more than its rounding are none.
    fn drop_rounding(&self, rates: &[f64], jump: &[f64], impulses: &mut [f64]) {
        let n = self.n;
        let mass = &self.values[self.roots.mass.clone()];
        let entry = |i: usize, j: usize| mass[i.max(j) * (i.max(j) + 1) / 2 + i.min(j)].abs();
        let mut sizes: Vec<f64> = (0..n).map(|i| (0..n).map(|j| entry(i, j) * (rates[j].abs() + jump[j].abs())).sum()).collect();
        for (r, p) in impulses.iter().enumerate().filter(|(_, p)| **p != 0.0) {
            sizes.iter_mut().zip(self.push(r)).for_each(|(size, f)| *size += (f * p).abs());
        }
        for r in (0..impulses.len()).filter(|r| !self.supports.contains(r)) {
            let felt = sizes.iter().zip(self.push(r)).any(|(size, f)| (f * impulses[r]).abs() > RATE * size);
            impulses[r] = if felt { impulses[r] } else { 0.0 };
        }
    }

    /// Contacts that are handed over or closed, and every friction that follows a normal force.
    fn units(&self, (modes, closing): (&[Mode], &[usize]), rates: &[f64], laws: &[f64]) -> Vec<Unit> {
        let mut units = Vec::new();
        for (index, row) in self.rows.iter().enumerate() {
            let Some(reaction) = row.reaction else { continue };
            let rounding = RATE * self.rate_size(index, rates);
            let unit = |guard: usize, law: Law| Unit { guard, row: index, reaction, law, name: row.name.clone(), rounding };
            match row.holds {
                Holds::Closed(guard, contact) if closing.contains(&guard) || modes[guard] == Mode::Zero => {
                    let restitution = self.values[self.roots.restitutions.start + 2 * contact];
                    let rebound = self.rebounds[contact];
                    units.push(unit(guard, Law::Contact { restitution, rebound }));
                }
                Holds::Rough(guard) if closing.contains(&guard) || modes[guard] == Mode::Zero => {
                    units.push(unit(guard, Law::Rough));
                }
                Holds::Sticking(guard, friction) => {
                    let width = 2 + 2 * self.reactions;
                    let start = self.law_roots.frictions.start + friction * width;
                    let (own, factors) = laws[start..start + width].split_at(2);
                    let pressing =
                        |part: &[f64]| part.iter().copied().enumerate().filter(|(_, f)| *f != 0.0).collect::<Vec<(usize, f64)>>();
                    let (first, second) = factors.split_at(self.reactions);
                    let normal = [pressing(first), pressing(second)];
                    if !normal[0].is_empty() {
                        let restitution = self.tangential(&normal[0]);
                        units.push(unit(guard, Law::Friction { kinetic: own[0], fixed: own[1], normal, restitution }));
                    }
                }
                _ => {}
            }
        }
        units
    }

    /// Tangential restitution of the first contact among the reactions that press.
    fn tangential(&self, normal: &[(usize, f64)]) -> f64 {
        let contact = |row: &super::conditions::Row| match (row.holds, row.reaction) {
            (Holds::Closed(_, contact), Some(r)) if normal.iter().any(|(k, _)| *k == r) => Some(contact),
            _ => None,
        };
        self.rows.iter().find_map(contact).map_or(0.0, |contact| self.values[self.roots.restitutions.start + 2 * contact + 1])
    }

    /// Generalized force per unit of a reaction.
    pub(super) fn push(&self, reaction: usize) -> &[f64] {
        let start = self.roots.forces.start + reaction * self.n;
        &self.values[start..start + self.n]
    }

    /// Impulses of supports that press frictions.
    fn support_impulses(&self, change: &[f64], impulses: &mut [f64], (laws, carried): (&[f64], &[f64])) {
        let rows = &laws[self.law_roots.balances.clone()];
        balances(rows, (&self.supports, carried), change, impulses);
    }
}

/// Impulses of supports from the balances of the released bodies, whose rows hold inertia by coordinate, shares of the reactions, and the momentum of prescribed
/// motions, of which `carried` is the change.
pub(super) fn balances(rows: &[f64], (supports, carried): (&[usize], &[f64]), change: &[f64], impulses: &mut [f64]) {
    let (n, count) = (change.len(), supports.len());
    let width = n + impulses.len() + 1;
    let mut matrix = vec![0.0; count * count];
    let mut right = vec![0.0; count];
    for s in supports {
        impulses[*s] = 0.0;
    }
    for (b, row) in rows.chunks(width).take(count).enumerate() {
        let (inertia, released) = row.split_at(n);
        right[b] = inertia.iter().zip(change).map(|(m, v)| m * v).sum::<f64>() + carried.get(b).copied().unwrap_or(0.0);
        right[b] -= released.iter().zip(impulses.iter()).map(|(f, p)| f * p).sum::<f64>();
        for (k, s) in supports.iter().enumerate() {
            matrix[b * count + k] = released[*s];
        }
    }
    if let Some(solution) = Lu::new(&matrix, count).solve(&right) {
        supports.iter().zip(solution).for_each(|(s, p)| impulses[*s] = p);
    }
}
