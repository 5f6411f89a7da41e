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

use algebra::elementary;
use program::Point;
use symbolic::connections::{Impacts, Rebound};
use words::Text;

use super::conditions::{Conditions, Holds};
use super::ties::RATE;
use crate::fault::connections::Gaining;
use crate::{Blow, Fault, Mode};
use algebra::cholesky::Cholesky;
use algebra::lu::Lu;
use algebra::qr::Qr;

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

/// Work of a blow on the bodies, relative to the terms that meet in it, that rounding makes.
const GAIN: f64 = 1e-9;

/// Most repetitions for the direction of a normal impulse, and where they end.
const TURNS: usize = 200;
const TURNED: f64 = 1e-15;

/// A contact or a friction that takes part.
pub(super) struct Unit {
    guard: usize,
    row: usize,
    reaction: usize,
    pub(super) law: Law,
    name: Text,
    /// Rounding of its rate.
    rounding: f64,
}

pub(super) enum Law {
    Contact {
        restitution: f64,
        rebound: Rebound,
    },
    /// Coefficients while sliding and at rest, factors of the reactions in both components of the normal force, tangential restitution of the contact
    /// that presses.
    Friction {
        kinetic: f64,
        fixed: f64,
        normal: [Vec<(usize, f64)>; 2],
        restitution: f64,
    },
    /// No slip at the contact of the same guard.
    Rough,
}

/// Components of a normal impulse.
type Pressure = [f64; 2];

/// What a unit does in a blow.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Part {
    /// The contact rebounds by its law, the friction sticks.
    Held,
    /// The contact takes no impulse.
    Out,
    /// The friction slides; sign of its impulse by that of the normal impulse.
    Slides(f64),
}

/// Units, their coupling and their rates.
pub(super) struct Strike {
    pub(super) units: Vec<Unit>,
    /// G, row by row.
    pub(super) coupling: Vec<f64>,
    /// Normal impulse of each friction by the impulse of each unit; zero rows for contacts.
    pressure: Vec<Pressure>,
    /// dq' by unit.
    responses: Vec<Vec<f64>>,
    pub(super) rates: Vec<f64>,
    impulses: Vec<f64>,
    /// Rate of each unit at the start of the instant, with the largest change it has had.
    pub(super) sizes: Vec<f64>,
    phased: bool,
}

impl Conditions {
    /// See [`crate::System::impact`].
    pub(super) fn impact(&mut self, t: f64, x: &mut [f64], modes: &[Mode], closing: &[usize]) -> Result<Blow, Fault> {
        let kick = vec![0.0; self.n];
        self.struck((t, x), modes, closing, &kick)
    }

    /// The same with generalized impulses given beside.
    pub(super) fn struck(&mut self, (t, x): (f64, &mut [f64]), modes: &[Mode], closing: &[usize], kick: &[f64]) -> Result<Blow, Fault> {
        self.evaluate(t, x)?;
        let values = self.laws.evaluate(&Point { time: t, states: x, ..Point::default() })?.to_vec();
        let units = self.units((modes, closing), &x[self.n..2 * self.n], &values);
        let bilateral = Bilateral::new(self, t)?;
        let n = self.n;
        let (corrected, mut whole) = bilateral.response(self, kick, &bilateral.rates(self))?;
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
            phased: false,
            units,
            responses,
        };
        let (before, rates) = (strike.rates.clone(), x[n..2 * n].to_vec());
        strike.follow(self.impacts, t)?;
        for i in 0..n {
            let change: f64 = strike.responses.iter().zip(&strike.impulses).map(|(r, p)| r[i] * p).sum();
            x[n + i] += corrected[i] + change;
        }
        for (row, p) in reactions.iter().zip(&strike.impulses) {
            whole.iter_mut().zip(row).for_each(|(sum, r)| *sum += r * p);
        }
        let jump: Vec<f64> = (0..n).map(|i| x[n + i] - rates[i]).collect();
        self.drop_rounding(&rates, &jump, &mut whole);
        Ok(Blow { reactions: whole, ..strike.blow(&before) })
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
    fn support_impulses(&self, change: &[f64], impulses: &mut [f64], laws: &[f64]) {
        let rows = &laws[self.law_roots.balances.clone()];
        balances(rows, (&self.supports, &[]), change, impulses);
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

fn pressure(unit: &Unit, reactions: &[f64]) -> Pressure {
    match &unit.law {
        Law::Contact { .. } | Law::Rough => [0.0; 2],
        Law::Friction { normal, .. } => normal.each_ref().map(|terms| terms.iter().map(|(k, factor)| factor * reactions[*k]).sum()),
    }
}

/// The conditions that hold through an impact, factored.
pub(super) struct Bilateral {
    rows: Vec<usize>,
    /// The reaction of each row, and the sign of its force along the row's gradient.
    reactions: Vec<Option<(usize, f64)>>,
    way: Way,
}

enum Way {
    Regular(Lu),
    /// Conditions that repeat each other: rates are unique, of the impulses one choice is taken. C of M = C C', C^-1 J_b' factored.
    Repeated {
        factor: Cholesky,
        columns: Vec<f64>,
        qr: Qr,
    },
}

impl Bilateral {
    pub(super) fn new(c: &mut Conditions, t: f64) -> Result<Bilateral, Fault> {
        c.activate_ideal();
        let n = c.n;
        if c.has_repeated() {
            let columns = c.measured();
            let mut chosen = c.independent(&columns).independent().to_vec();
            chosen.sort_unstable();
            c.active = chosen.into_iter().map(|k| c.active[k]).collect();
        }
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
            factor.forward(&mut a);
            (0..n).for_each(|i| columns[i * m + k] = a[i]);
        }
        let qr = Qr::new(&columns, n, m);
        Ok(Bilateral { rows, reactions, way: Way::Repeated { factor, columns, qr } })
    }

    /// No change of the rows.
    pub(super) fn unmoved(&self) -> Vec<f64> {
        vec![0.0; self.rows.len()]
    }

    /// What the rates of the rows still lack.
    fn rates(&self, c: &Conditions) -> Vec<f64> {
        self.rows.iter().map(|&row| -c.rate(row)).collect()
    }

    /// Change of the rates under generalized impulses, the rows changed by `wanted`, and the impulses of all reactions.
    pub(super) fn response(&self, c: &Conditions, force: &[f64], wanted: &[f64]) -> Result<(Vec<f64>, Vec<f64>), Fault> {
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
                factor.forward(&mut y);
                let (own, _) = qr.least_squares(&y);
                let shortest = qr.shortest(wanted);
                for i in 0..n {
                    y[i] += shortest[i] - (0..m).map(|k| columns[i * m + k] * own[k]).sum::<f64>();
                }
                factor.backward(&mut y);
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
    pub(super) fn is_contact(&self, i: usize) -> bool {
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
                if self.roll_on(t)? {
                    continue;
                }
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

    /// One blow at these contacts, with what slides or is rough there.
    fn strike(&mut self, taking: &[usize], t: f64) -> Result<(), Fault> {
        let set = self.set(taking);
        let before = [self.rates.clone(), self.impulses.clone()];
        let by_phases = taking.iter().any(|&i| matches!(self.units[i].law, Law::Contact { rebound: Rebound::Poisson, .. }));
        self.phased |= by_phases;
        if by_phases {
            self.strike_by_phases(taking, &set, t)?;
        } else {
            let goal: Vec<Goal> = set.iter().map(|&i| self.by_newton(i)).collect();
            let Some(impulses) = self.solve(&set, &goal) else { return Err(Fault::undetermined_impact(t)) };
            self.take(&set, &impulses);
        }
        self.refuse_gain(taking, &set, &before)
    }

    /// Refuses a blow that gives energy. What it is compared with are the terms of its work.
    fn refuse_gain(&self, taking: &[usize], set: &[usize], [rates, impulses]: &[Vec<f64>; 2]) -> Result<(), Fault> {
        let count = self.units.len();
        let (mut gain, mut size) = (0.0, 0.0);
        for &i in set {
            let given = self.impulses[i] - impulses[i];
            gain += 0.5 * self.coupling[i * count + i].signum() * given * (rates[i] + self.rates[i]);
            size += 0.5 * given.abs() * (GAIN * (rates[i].abs() + self.rates[i].abs()) + 2.0 * self.units[i].rounding);
        }
        if gain <= size {
            return Ok(());
        }
        let rubs = set.iter().any(|&i| matches!(self.units[i].law, Law::Friction { .. }) && self.impulses[i] != impulses[i]);
        let phases = |i: usize| matches!(self.units[i].law, Law::Contact { rebound: Rebound::Poisson, .. });
        let cause = match taking {
            _ if taking.iter().all(|&i| phases(i)) => Gaining::Otherwise,
            [_] if !rubs => Gaining::Otherwise,
            _ if rubs => Gaining::Friction,
            _ => Gaining::Several,
        };
        let names: Vec<&Text> = taking.iter().map(|&i| &self.units[i].name).collect();
        Err(Fault::energetic_impact(&names, gain, cause))
    }

    /// What is rough at contacts that stay closed stops slipping, once no contact closes any more; whether something did slip.
    fn roll_on(&mut self, t: f64) -> Result<bool, Fault> {
        let still = |i: usize| self.rates[i].abs() <= SILENT * self.sizes[i];
        let contact = |guard: usize| (0..self.units.len()).find(|&i| self.is_contact(i) && self.units[i].guard == guard);
        let slips = |i: &usize| matches!(self.units[*i].law, Law::Rough) && contact(self.units[*i].guard).is_some_and(still);
        let rough: Vec<usize> = (0..self.units.len()).filter(slips).collect();
        if rough.iter().all(|&i| still(i)) {
            return Ok(false);
        }
        let closed: Vec<usize> = self.contacts().into_iter().filter(|&i| still(i)).collect();
        let others = self.set(&closed).into_iter().filter(|i| !rough.contains(i)).collect::<Vec<_>>();
        let set: Vec<usize> = others.into_iter().chain(rough).collect();
        let goal: Vec<Goal> = set.iter().map(|&i| Goal { rate: 0.0, change: -self.rates[i], impulse: 0.0 }).collect();
        let Some(impulses) = self.solve(&set, &goal) else { return Err(Fault::undetermined_impact(t)) };
        self.take(&set, &impulses);
        Ok(true)
    }

    /// Units of a blow: the contacts, frictions that they press, what is rough at them.
    fn set(&self, taking: &[usize]) -> Vec<usize> {
        let count = self.units.len();
        let presses = |i: usize| taking.iter().any(|&j| self.pressure[i * count + j] != [0.0; 2]);
        let struck = |guard: usize| taking.iter().any(|&j| self.units[j].guard == guard);
        let others = (0..count).filter(|&i| match self.units[i].law {
            Law::Contact { .. } => false,
            Law::Friction { .. } => presses(i),
            Law::Rough => struck(self.units[i].guard),
        });
        taking.iter().copied().chain(others).collect()
    }

    /// What Newton's law asks of a unit.
    fn by_newton(&self, i: usize) -> Goal {
        let restitution = match self.units[i].law {
            Law::Contact { restitution, .. } | Law::Friction { restitution, .. } => restitution,
            Law::Rough => 0.0,
        };
        Goal { rate: -restitution * self.rates[i], change: -(1.0 + restitution) * self.rates[i], impulse: 0.0 }
    }

    /// Adds impulses of a set.
    pub(super) fn take(&mut self, set: &[usize], impulses: &[f64]) {
        let count = self.units.len();
        for (i, rate) in self.rates.iter_mut().enumerate() {
            let change: f64 = set.iter().zip(impulses).map(|(&j, p)| self.coupling[i * count + j] * p).sum();
            self.sizes[i] = self.sizes[i].max(change.abs());
            *rate += change;
        }
        set.iter().zip(impulses).for_each(|(&j, p)| self.impulses[j] += p);
    }

    /// Impulses of a blow: rebound and sticking first, then what the result asks for, then all combinations.
    pub(super) fn solve(&self, set: &[usize], goal: &[Goal]) -> Option<Vec<f64>> {
        let mut parts = vec![Part::Held; set.len()];
        let mut tried: Vec<Vec<Part>> = Vec::new();
        while !tried.contains(&parts) && tried.len() < 8 * set.len() + 8 {
            tried.push(parts.clone());
            let Some(impulses) = self.impulses_of((set, goal), &parts) else { break };
            match self.objection((set, goal), &parts, &impulses) {
                None => return Some(impulses),
                Some((k, part)) => parts[k] = part,
            }
        }
        let options = |k: usize| match self.units[set[k]].law {
            Law::Contact { .. } => 2,
            Law::Friction { .. } => 3,
            Law::Rough => 1,
        };
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
            self.impulses_of((set, goal), &parts).filter(|impulses| self.objection((set, goal), &parts, impulses).is_none())
        })
    }

    /// Impulses in given parts; none where these repeat each other. Directions of normal impulses with two components are repeated until they stay.
    pub(super) fn impulses_of(&self, (set, goal): (&[usize], &[Goal]), parts: &[Part]) -> Option<Vec<f64>> {
        let mut along = vec![[1.0, 0.0]; set.len()];
        for _ in 0..TURNS {
            let impulses = self.impulses_along((set, goal), parts, &along)?;
            let next: Vec<Pressure> = set.iter().map(|&i| self.direction(i, self.pressed(i, set, &impulses))).collect();
            let turn = along.iter().zip(&next).fold(0.0_f64, |m, (a, b)| m.max((a[0] - b[0]).abs()).max((a[1] - b[1]).abs()));
            if turn <= TURNED {
                return Some(impulses);
            }
            along = next;
        }
        None
    }

    /// Unit vector of a normal impulse; one component alone keeps its axis.
    fn direction(&self, i: usize, pressed: Pressure) -> Pressure {
        let size = elementary::hypot(pressed[0], pressed[1]);
        match &self.units[i].law {
            Law::Friction { normal, .. } if !normal[1].is_empty() && size > 0.0 => pressed.map(|p| p / size),
            _ => [1.0, 0.0],
        }
    }

    /// Normal impulse of a friction.
    pub(super) fn pressed(&self, i: usize, set: &[usize], impulses: &[f64]) -> Pressure {
        let count = self.units.len();
        let part = |axis: usize| set.iter().zip(impulses).map(|(&j, p)| self.pressure[i * count + j][axis] * p).sum();
        [part(0), part(1)]
    }

    /// The same along its direction.
    pub(super) fn normal(&self, i: usize, set: &[usize], impulses: &[f64]) -> f64 {
        let pressed = self.pressed(i, set, impulses);
        let along = self.direction(i, pressed);
        along[0] * pressed[0] + along[1] * pressed[1]
    }

    fn impulses_along(&self, (set, goal): (&[usize], &[Goal]), parts: &[Part], along: &[Pressure]) -> Option<Vec<f64>> {
        let (count, size) = (self.units.len(), set.len());
        let mut matrix = vec![0.0; size * size];
        let mut right = vec![0.0; size];
        for (k, (&i, part)) in set.iter().zip(parts).enumerate() {
            let row = &mut matrix[k * size..(k + 1) * size];
            match (part, &self.units[i].law) {
                (Part::Held, _) => {
                    row.iter_mut().zip(set).for_each(|(a, &j)| *a = self.coupling[i * count + j]);
                    right[k] = goal[k].change;
                }
                (Part::Slides(sign), Law::Friction { kinetic, .. }) => {
                    let normal = |j: usize| along[k][0] * self.pressure[i * count + j][0] + along[k][1] * self.pressure[i * count + j][1];
                    row.iter_mut().zip(set).for_each(|(a, &j)| *a = -sign * kinetic * normal(j));
                    row[k] += 1.0;
                }
                _ => {
                    row[k] = 1.0;
                    right[k] = goal[k].impulse;
                }
            }
        }
        Lu::new(&matrix, size).solve(&right)
    }

    /// The part that violates its law most, and what it should be instead.
    fn objection(&self, (set, goal): (&[usize], &[Goal]), parts: &[Part], impulses: &[f64]) -> Option<(usize, Part)> {
        let count = self.units.len();
        let sum = |i: usize| set.iter().zip(impulses).map(|(&j, p)| self.coupling[i * count + j] * p).sum::<f64>();
        let terms = |i: usize| set.iter().zip(impulses).map(|(&j, p)| (self.coupling[i * count + j] * p).abs()).sum::<f64>();
        let largest = impulses.iter().fold(0.0_f64, |m, p| m.max(p.abs()));
        let mut worst: Option<(usize, Part, f64)> = None;
        for (k, (&i, part)) in set.iter().zip(parts).enumerate() {
            let after = self.rates[i] + sum(i);
            let size = self.rates[i].abs() + terms(i);
            let (excess, instead) = match (part, &self.units[i].law) {
                (_, Law::Rough) => continue,
                (Part::Held, Law::Contact { .. }) => ((goal[k].impulse - impulses[k]) / largest, Part::Out),
                (_, Law::Contact { .. }) => ((goal[k].rate - after) / size, Part::Held),
                (Part::Held, Law::Friction { kinetic, fixed, .. }) => {
                    let still = self.rates[i].abs() <= SILENT * self.sizes[i];
                    let pressed = self.normal(i, set, impulses);
                    let limit = if still { fixed } else { kinetic } * pressed.abs();
                    let positive = impulses[k] * pressed >= 0.0;
                    ((impulses[k].abs() - limit) / largest, Part::Slides(if positive { 1.0 } else { -1.0 }))
                }
                // what nothing presses gives nothing
                (_, Law::Friction { .. }) if impulses[k].abs() <= SLACK * largest => continue,
                // friction acts against the sliding that it leaves, beside the rebound that it would give
                (_, Law::Friction { .. }) => (-(after - goal[k].rate) * impulses[k].signum() / size, Part::Held),
            };
            if excess > SLACK && worst.is_none_or(|(_, _, most)| excess > most) {
                worst = Some((k, instead, excess));
            }
        }
        worst.map(|(k, part, _)| (k, part))
    }

    fn blow(&self, before: &[f64]) -> Blow {
        let units = || self.units.iter().enumerate().filter(|(_, unit)| !matches!(unit.law, Law::Rough));
        let stops = |i: usize| self.impulses[i] != 0.0 && self.rates[i].abs() <= 1e-12 * self.sizes[i];
        Blow {
            rates: units().map(|(i, unit)| (unit.guard, before[i])).collect(),
            impulses: units().map(|(i, unit)| (unit.guard, self.impulses[i])).filter(|(_, p)| *p != 0.0).collect(),
            stuck: units().filter(|(i, _)| !self.is_contact(*i) && stops(*i)).map(|(_, unit)| unit.guard).collect(),
            phased: self.phased,
            silent: units().filter(|(i, _)| self.is_silent(*i, before[*i])).map(|(_, unit)| unit.guard).collect(),
            reactions: Vec::new(),
        }
    }

    /// Whether what happened to a unit is rounding: of the rates that meet in its own, and of the largest impulse of the instant. In the metric of the kinetic
    /// energy an impulse has the size Λ √G, and what it changes at a unit with G_ii is at most √G_ii times that.
    fn is_silent(&self, i: usize, before: f64) -> bool {
        let count = self.units.len();
        let own = |j: usize| self.coupling[j * count + j].abs();
        let largest = (0..count).fold(0.0_f64, |m, j| m.max(self.impulses[j].abs() * own(j).sqrt()));
        let rounding = self.units[i].rounding.max(RATE * own(i).sqrt() * largest);
        before.abs().max(self.rates[i].abs()).max(self.impulses[i].abs() * own(i)) <= rounding
    }
}

/// What a blow must reach: a contact at least this rate, or no more than this impulse; a friction this rate, if its limit allows.
#[derive(Clone, Copy, Debug)]
pub(super) struct Goal {
    pub rate: f64,
    /// `rate` less the present one.
    pub change: f64,
    pub impulse: f64,
}
