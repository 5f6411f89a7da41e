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
//! Λ_n is the impulse of whatever presses the friction: a contact, a guide, a support. Frictions of a given force take no impulse, however large.
//!
//! With a tangential restitution ε of the contact a friction that sticks leaves u_t+ = -ε u_t-.
//!
//! **Several contacts** strike in sequence: the contact that closes fastest (those that close equally fast together), then again, until none closes. Or all
//! that close or stand strike together.
//! *Source*: B. Brogliato, Nonsmooth Mechanics, chapters 5 and 6; Glocker, Set-Valued Force Laws, chapters 7 to 9.

use program::Point;
use symbolic::connections::Impacts;

use super::conditions::{Conditions, Holds, backward, forward};
use crate::numerics::lu::Lu;
use crate::numerics::qr::Qr;
use crate::{Blow, Fault, Mode};

/// Share of the largest rate below which a closing rate is rounding.
pub(crate) const SILENT: f64 = 1e-13;
/// Contacts whose closing rates differ by less than this share strike together.
const TIE: f64 = 1e-9;
/// Most blows in one instant.
const MOST: usize = 20_000;
/// Most combinations of a blow that are tried one by one.
const COMBINED: usize = 20_000;
/// Rounding of rates and impulses of a blow.
const SLACK: f64 = 1e-10;

/// A contact or a friction that takes part.
struct Unit {
    guard: usize,
    row: usize,
    reaction: usize,
    law: Law,
}

enum Law {
    Contact {
        restitution: f64,
    },
    /// Coefficients while sliding and at rest, factors of the reactions in the normal force, tangential restitution of the contact that presses.
    Friction {
        kinetic: f64,
        fixed: f64,
        normal: Vec<(usize, f64)>,
        restitution: f64,
    },
}

/// What a unit does in a blow.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Part {
    /// The contact rebounds by its law, the friction sticks.
    Held,
    /// The contact takes no impulse.
    Out,
    /// The friction slides; sign of its impulse by that of the normal impulse.
    Slides(f64),
}

/// Units, their coupling and their rates.
struct Strike {
    units: Vec<Unit>,
    /// G, row by row.
    coupling: Vec<f64>,
    /// Normal impulse of each friction by the impulse of each unit; zero rows for contacts.
    pressure: Vec<f64>,
    /// dq' by unit.
    responses: Vec<Vec<f64>>,
    rates: Vec<f64>,
    impulses: Vec<f64>,
    /// Rate of each unit at the start of the instant, with the largest change it has had.
    sizes: Vec<f64>,
}

impl Conditions {
    /// See [`crate::System::impact`].
    pub(super) fn impact(&mut self, t: f64, x: &mut [f64], modes: &[Mode], closing: &[usize]) -> Result<Blow, Fault> {
        self.evaluate(t, x)?;
        let values = self.laws.evaluate(&Point { time: t, states: x, ..Point::default() })?.to_vec();
        let units = self.units(modes, closing, &values);
        let bilateral = Bilateral::new(self, t)?;
        let n = self.n;
        let (corrected, mut whole) = bilateral.response(self, &vec![0.0; n], &bilateral.rates(self))?;
        self.support_impulses(&corrected, &mut whole, &values);
        let mut responses = Vec::with_capacity(units.len());
        let mut reactions = Vec::with_capacity(units.len());
        for unit in &units {
            let force = self.push(unit.reaction).to_vec();
            let (change, mut impulses) = bilateral.response(self, &force, &vec![0.0; bilateral.rows.len()])?;
            impulses[unit.reaction] = 1.0;
            self.support_impulses(&change, &mut impulses, &values);
            responses.push(change);
            reactions.push(impulses);
        }
        let dot = |row: usize, change: &[f64]| self.column(row).iter().zip(change).map(|(j, v)| j * v).sum::<f64>();
        let count = units.len();
        let mut strike = Strike {
            coupling: (0..count * count).map(|k| dot(units[k / count].row, &responses[k % count])).collect(),
            pressure: (0..count * count).map(|k| pressure(&units[k / count], &reactions[k % count])).collect(),
            rates: units.iter().map(|u| self.rate(u.row) + dot(u.row, &corrected)).collect(),
            impulses: vec![0.0; count],
            sizes: vec![0.0; count],
            units,
            responses,
        };
        strike.follow(self.impacts, t)?;
        for i in 0..n {
            let change: f64 = strike.responses.iter().zip(&strike.impulses).map(|(r, p)| r[i] * p).sum();
            x[n + i] += corrected[i] + change;
        }
        for (row, p) in reactions.iter().zip(&strike.impulses) {
            whole.iter_mut().zip(row).for_each(|(sum, r)| *sum += r * p);
        }
        Ok(Blow { reactions: whole, ..strike.blow() })
    }

    /// Contacts that are handed over or closed, and every friction that follows a normal force.
    fn units(&self, modes: &[Mode], closing: &[usize], laws: &[f64]) -> Vec<Unit> {
        let mut units = Vec::new();
        for (index, row) in self.rows.iter().enumerate() {
            let Some(reaction) = row.reaction else { continue };
            match row.holds {
                Holds::Closed(guard, contact) if closing.contains(&guard) || modes[guard] == Mode::Zero => {
                    let restitution = self.values[self.roots.restitutions.start + 2 * contact];
                    units.push(Unit { guard, row: index, reaction, law: Law::Contact { restitution } });
                }
                Holds::Sticking(guard, friction) => {
                    let width = 2 + self.reactions;
                    let start = self.law_roots.frictions.start + friction * width;
                    let (own, factors) = laws[start..start + width].split_at(2);
                    let normal: Vec<(usize, f64)> = factors.iter().copied().enumerate().filter(|(_, f)| *f != 0.0).collect();
                    if !normal.is_empty() {
                        let restitution = self.tangential(&normal);
                        let law = Law::Friction { kinetic: own[0], fixed: own[1], normal, restitution };
                        units.push(Unit { guard, row: index, reaction, law });
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
    fn push(&self, reaction: usize) -> &[f64] {
        let start = self.roots.forces.start + reaction * self.n;
        &self.values[start..start + self.n]
    }

    /// Impulses of supports that press frictions, from the balances of the released bodies.
    fn support_impulses(&self, change: &[f64], impulses: &mut [f64], laws: &[f64]) {
        let (n, count) = (self.n, self.supports.len());
        if count == 0 {
            return;
        }
        let width = n + self.reactions;
        let row = |b: usize| &laws[self.law_roots.balances.start + b * width..][..width];
        let mut matrix = vec![0.0; count * count];
        let mut right = vec![0.0; count];
        for b in 0..count {
            let (inertia, released) = row(b).split_at(n);
            right[b] = inertia.iter().zip(change).map(|(m, v)| m * v).sum::<f64>();
            right[b] -= released.iter().zip(impulses.iter()).map(|(f, p)| f * p).sum::<f64>();
            for (k, s) in self.supports.iter().enumerate() {
                matrix[b * count + k] = released[*s];
            }
        }
        if let Some(solution) = Lu::new(&matrix, count).solve(&right) {
            self.supports.iter().zip(solution).for_each(|(s, p)| impulses[*s] = p);
        }
    }
}

fn pressure(unit: &Unit, reactions: &[f64]) -> f64 {
    match &unit.law {
        Law::Contact { .. } => 0.0,
        Law::Friction { normal, .. } => normal.iter().map(|(k, factor)| factor * reactions[*k]).sum(),
    }
}

/// The conditions that hold through an impact, factored.
struct Bilateral {
    rows: Vec<usize>,
    /// The reaction of each row, and the sign of its force along the row's gradient.
    reactions: Vec<Option<(usize, f64)>>,
    way: Way,
}

enum Way {
    Regular(Lu),
    /// Conditions that repeat each other: rates are unique, of the impulses one choice is taken. C of M = C C', C^-1 J_b' factored.
    Repeated {
        factor: Vec<f64>,
        columns: Vec<f64>,
        qr: Qr,
    },
}

impl Bilateral {
    fn new(c: &mut Conditions, t: f64) -> Result<Bilateral, Fault> {
        c.activate_ideal();
        let n = c.n;
        let rows = c.active.clone();
        let m = rows.len();
        let size = n + m;
        let mut matrix = vec![0.0; size * size];
        let mass = &c.values[c.roots.mass.clone()];
        for i in 0..n {
            for j in 0..n {
                matrix[i * size + j] = mass[i.max(j) * (i.max(j) + 1) / 2 + i.min(j)];
            }
        }
        let mut motors = c.motors.iter().copied();
        let mut reactions = Vec::with_capacity(m);
        for (k, &row) in rows.iter().enumerate() {
            let column = c.column(row);
            matrix[(n + k) * size..(n + k) * size + n].copy_from_slice(column);
            let reaction = c.rows[row].reaction.or_else(|| motors.next());
            let pushes = reaction.map_or(column, |r| c.push(r));
            (0..n).for_each(|i| matrix[i * size + n + k] = -pushes[i]);
            let along: f64 = pushes.iter().zip(column).map(|(p, j)| p * j).sum();
            reactions.push(reaction.map(|r| (r, along.signum())));
        }
        let lu = Lu::new(&matrix, size);
        if size == 0 || lu.solve(&vec![0.0; size]).is_some() {
            return Ok(Bilateral { rows, reactions, way: Way::Regular(lu) });
        }
        if !c.motors.is_empty() {
            return Err(Fault::undetermined_impact(t));
        }
        let factor = c.metric();
        let mut columns = vec![0.0; n * m];
        for (k, &row) in rows.iter().enumerate() {
            let mut a = c.column(row).to_vec();
            forward(&factor, n, &mut a);
            (0..n).for_each(|i| columns[i * m + k] = a[i]);
        }
        let qr = Qr::new(&columns, n, m);
        Ok(Bilateral { rows, reactions, way: Way::Repeated { factor, columns, qr } })
    }

    /// What the rates of the rows still lack.
    fn rates(&self, c: &Conditions) -> Vec<f64> {
        self.rows.iter().map(|&row| -c.rate(row)).collect()
    }

    /// Change of the rates under generalized impulses, the rows changed by `wanted`, and the impulses of all reactions.
    fn response(&self, c: &Conditions, force: &[f64], wanted: &[f64]) -> Result<(Vec<f64>, Vec<f64>), Fault> {
        let n = c.n;
        let mut impulses = vec![0.0; c.reactions];
        let (change, own) = match &self.way {
            Way::Regular(lu) => {
                let right = [force, wanted].concat();
                let solution = lu.solve(&right).unwrap_or(right);
                (solution[..n].to_vec(), solution[n..].to_vec())
            }
            Way::Repeated { factor, columns, qr } => {
                let m = self.rows.len();
                let mut y = force.to_vec();
                forward(factor, n, &mut y);
                let (own, _) = qr.least_squares(&y);
                let shortest = qr.shortest(wanted);
                for i in 0..n {
                    y[i] += shortest[i] - (0..m).map(|k| columns[i * m + k] * own[k]).sum::<f64>();
                }
                backward(factor, n, &mut y);
                let signs = self.reactions.iter().map(|r| r.map_or(1.0, |(_, sign)| -sign));
                (y, own.iter().zip(signs).map(|(p, sign)| p * sign).collect())
            }
        };
        for (reaction, p) in self.reactions.iter().zip(own) {
            if let Some((r, _)) = reaction {
                impulses[*r] = p;
            }
        }
        Ok((change, impulses))
    }
}

impl Strike {
    fn is_contact(&self, i: usize) -> bool {
        matches!(self.units[i].law, Law::Contact { .. })
    }

    fn contacts(&self) -> Vec<usize> {
        (0..self.units.len()).filter(|&i| self.is_contact(i)).collect()
    }

    fn follow(&mut self, law: Impacts, t: f64) -> Result<(), Fault> {
        let contacts = self.contacts();
        let scale = contacts.iter().fold(0.0_f64, |m, &i| m.max(self.rates[i].abs()));
        self.sizes.clone_from(&self.rates.iter().map(|u| u.abs()).collect());
        for _ in 0..MOST {
            let worst = contacts.iter().fold(0.0_f64, |m, &i| m.min(self.rates[i]));
            if worst >= -SILENT * scale {
                return Ok(());
            }
            let most = match law {
                Impacts::InSequence => (1.0 - TIE) * worst,
                Impacts::Together => SILENT * scale,
            };
            let taking: Vec<usize> = contacts.iter().copied().filter(|&i| self.rates[i] <= most).collect();
            self.strike(&taking, t)?;
        }
        Err(Fault::endless_impacts(t))
    }

    /// One blow at these contacts, with the frictions that they press.
    fn strike(&mut self, taking: &[usize], t: f64) -> Result<(), Fault> {
        let count = self.units.len();
        let presses = |i: usize| taking.iter().any(|&j| self.pressure[i * count + j] != 0.0);
        let frictions = (0..count).filter(|&i| !self.is_contact(i) && presses(i));
        let set: Vec<usize> = taking.iter().copied().chain(frictions).collect();
        let Some(impulses) = self.solve(&set) else { return Err(Fault::undetermined_impact(t)) };
        for (i, rate) in self.rates.iter_mut().enumerate() {
            let change: f64 = set.iter().zip(&impulses).map(|(&j, p)| self.coupling[i * count + j] * p).sum();
            self.sizes[i] = self.sizes[i].max(change.abs());
            *rate += change;
        }
        set.iter().zip(impulses).for_each(|(&j, p)| self.impulses[j] += p);
        Ok(())
    }

    /// Impulses of a blow: rebound and sticking first, then what the result asks for, then all combinations.
    fn solve(&self, set: &[usize]) -> Option<Vec<f64>> {
        let mut parts = vec![Part::Held; set.len()];
        let mut tried: Vec<Vec<Part>> = Vec::new();
        while !tried.contains(&parts) && tried.len() < 8 * set.len() + 8 {
            tried.push(parts.clone());
            let Some(impulses) = self.impulses_of(set, &parts) else { break };
            match self.objection(set, &parts, &impulses) {
                None => return Some(impulses),
                Some((k, part)) => parts[k] = part,
            }
        }
        let options = |k: usize| if self.is_contact(set[k]) { 2 } else { 3 };
        let total = (0..set.len()).try_fold(1_usize, |product, k| product.checked_mul(options(k)).filter(|p| *p <= COMBINED))?;
        (0..total).find_map(|code| {
            let mut digits = code;
            for (k, part) in parts.iter_mut().enumerate() {
                *part = match (digits % options(k), self.is_contact(set[k])) {
                    (0, _) => Part::Held,
                    (_, true) => Part::Out,
                    (1, false) => Part::Slides(1.0),
                    _ => Part::Slides(-1.0),
                };
                digits /= options(k);
            }
            self.impulses_of(set, &parts).filter(|impulses| self.objection(set, &parts, impulses).is_none())
        })
    }

    /// Impulses in given parts; none where these repeat each other.
    fn impulses_of(&self, set: &[usize], parts: &[Part]) -> Option<Vec<f64>> {
        let (count, size) = (self.units.len(), set.len());
        let mut matrix = vec![0.0; size * size];
        let mut right = vec![0.0; size];
        for (k, (&i, part)) in set.iter().zip(parts).enumerate() {
            let row = &mut matrix[k * size..(k + 1) * size];
            match (part, &self.units[i].law) {
                (Part::Held, law) => {
                    row.iter_mut().zip(set).for_each(|(a, &j)| *a = self.coupling[i * count + j]);
                    let (Law::Contact { restitution } | Law::Friction { restitution, .. }) = law;
                    right[k] = -(1.0 + restitution) * self.rates[i];
                }
                (Part::Slides(sign), Law::Friction { kinetic, .. }) => {
                    row.iter_mut().zip(set).for_each(|(a, &j)| *a = -sign * kinetic * self.pressure[i * count + j]);
                    row[k] += 1.0;
                }
                _ => row[k] = 1.0,
            }
        }
        Lu::new(&matrix, size).solve(&right)
    }

    /// The part that violates its law most, and what it should be instead.
    fn objection(&self, set: &[usize], parts: &[Part], impulses: &[f64]) -> Option<(usize, Part)> {
        let count = self.units.len();
        let sum = |table: &[f64], i: usize| set.iter().zip(impulses).map(|(&j, p)| table[i * count + j] * p).sum::<f64>();
        let terms = |table: &[f64], i: usize| set.iter().zip(impulses).map(|(&j, p)| (table[i * count + j] * p).abs()).sum::<f64>();
        let largest = impulses.iter().fold(0.0_f64, |m, p| m.max(p.abs()));
        let mut worst: Option<(usize, Part, f64)> = None;
        for (k, (&i, part)) in set.iter().zip(parts).enumerate() {
            let after = self.rates[i] + sum(&self.coupling, i);
            let size = self.rates[i].abs() + terms(&self.coupling, i);
            let (excess, instead) = match (part, &self.units[i].law) {
                (Part::Held, Law::Contact { .. }) => (-impulses[k] / largest, Part::Out),
                (_, Law::Contact { restitution }) => ((-restitution * self.rates[i] - after) / size, Part::Held),
                (Part::Held, Law::Friction { kinetic, fixed, .. }) => {
                    let still = self.rates[i].abs() <= SILENT * self.sizes[i];
                    let limit = if still { fixed } else { kinetic } * sum(&self.pressure, i).abs();
                    let positive = impulses[k] * sum(&self.pressure, i) >= 0.0;
                    ((impulses[k].abs() - limit) / largest, Part::Slides(if positive { 1.0 } else { -1.0 }))
                }
                // what nothing presses gives nothing
                (_, Law::Friction { .. }) if impulses[k].abs() <= SLACK * largest => continue,
                // friction acts against the sliding that it leaves, beside the rebound that it would give
                (_, Law::Friction { restitution, .. }) => {
                    (-(after + restitution * self.rates[i]) * impulses[k].signum() / size, Part::Held)
                }
            };
            if excess > SLACK && worst.is_none_or(|(_, _, most)| excess > most) {
                worst = Some((k, instead, excess));
            }
        }
        worst.map(|(k, part, _)| (k, part))
    }

    fn blow(&self) -> Blow {
        let units = || self.units.iter().enumerate();
        let stops = |i: usize| self.impulses[i] != 0.0 && self.rates[i].abs() <= 1e-12 * self.sizes[i];
        Blow {
            impulses: units().map(|(i, unit)| (unit.guard, self.impulses[i])).filter(|(_, p)| *p != 0.0).collect(),
            stuck: units().filter(|(i, _)| !self.is_contact(*i) && stops(*i)).map(|(_, unit)| unit.guard).collect(),
            reactions: Vec::new(),
        }
    }
}
