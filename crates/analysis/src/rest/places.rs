//! Places of rest of a machine with connections.
//!
//! Equilibria are the points of the surface c(q) = 0 at which the forces have no component along it: h + Jᵀ λ = 0. Newton's method on (q, λ) from
//!
//! * the start and the guesses,
//! * with a range and one degree of freedom left: every change of sign of the force along the curve c(q) = 0, which is followed from the start in
//!   both directions to the ends of the range, through dead points (predictor along the tangent, corrector of least change);
//! * with a range and more freedom: places along the range and, by seeded random numbers, around them, drawn onto the surface.
//!
//! Every choice of closed contacts is tried that may be needed, and a place counts only where open gaps are not negative and closed contacts do not pull. With f
//! freedoms these are the choices of at most f contacts: where more are closed, -h = Σ λ_k ∂g_k with λ ≥ 0 has a solution with independent ∂g_k (Carathéodory).
//! While contacts are few all choices are tried. Where even those of at most f are too many, the smallest ones are, and from each place that does not count the
//! choice without the contacts that pull and with those that are pierced (principal pivoting, K. G. Murty, Linear Complementarity, ch. 4); a note says so.

use algebra::arrange::Arrange;
use algebra::elementary;
use symbolic::Equations;
use words::Text;

use super::fine::Sought;
use super::newton::{self, SOLVED, balance, worst};
use super::poles;
use super::search::{self, Equilibrium, Range};
use super::sizes::NOISE;
use super::system::{Parts, RestSystem, Row, Rows};
use super::{closed_contacts, faults, gap_size};
use crate::Fault;
use algebra::qr::{self, Qr};
use algebra::random::Random;
use algebra::vectors::norm;

/// Contacts of which every choice of closed ones is tried, more than the freedoms at once too: they tell where reactions are shared.
const CONTACTS: usize = 4;
/// Choices of closed contacts in whole sizes, and choices that follow from places that do not count.
const CHOICES: usize = 256;
/// Places along a range where several freedoms are left, and tries at each.
const PLACES: usize = 49;
const TRIES: usize = 4;
/// Step along a curve, rad or share of the machine's length.
const STRIDE: f64 = 0.01;
/// Distance of two places that are one, relative to the sizes of the coordinates.
const ONE: f64 = 1e-7;
/// Share of the coordinate of the range in a motion that does not lead along it.
const BESIDE: f64 = 1e-9;
/// Steps along a curve to either side.
const STRIDES: usize = 20_000;

/// A place of rest.
#[derive(Clone, Debug)]
pub struct Place {
    /// Coordinates.
    pub q: Vec<f64>,
    /// Every reaction of the equations; 0 for open contacts and for frictions, none for supports.
    pub reactions: Vec<Option<f64>>,
    /// Contacts (by reaction) that are closed.
    pub closed: Vec<usize>,
    /// Largest relative remainder of an equation.
    pub residual: f64,
    /// What coordinates, and then reactions, have below their last digits, where weak springs stand beside hard ones; else empty.
    pub below: Vec<f64>,
    /// Ends of what is one place but for rounding.
    pub(crate) flat: Option<[Vec<f64>; 2]>,
}

/// Places of rest and what there is to say about the search.
#[derive(Clone, Debug, Default)]
pub struct Places {
    /// Along the coordinate of the range, else in the order in which they were found.
    pub list: Vec<Place>,
    /// Remarks.
    pub notes: Vec<Text>,
    /// Whether the search along a range can have missed a place.
    pub open: bool,
    /// Places at which a force has a pole.
    poles: Vec<Vec<f64>>,
    /// Contacts, each with a place beside which its gap changes its sign along the range.
    touched: Vec<(usize, Vec<f64>)>,
}

/// All places that the options ask for; `start` is an assembled place.
///
/// *Errors*: a formula has no value at the start.
pub fn places(equations: &Equations, parameters: &[f64], start: &[f64], options: &Equilibrium) -> Result<Places, Fault> {
    let n = equations.coordinates.len();
    let own = closed_contacts(equations, &start[..n], parameters)?;
    let mut found = Places::default();
    let mut wandering = Vec::new();
    let (mut waiting, all) = choices(equations, parameters, start, &own)?;
    if own.len() == 1 && options.over.is_some() {
        // once more, from where the way with all contacts open meets it
        waiting.push(own.clone());
    }
    let (mut next, mut pivots) = (0, 0);
    while let Some(closed) = waiting.get(next).cloned() {
        next += 1;
        let parts = Parts::holding(equations, |r| closed.contains(&r)).smooth(equations);
        let system = RestSystem::new(equations, parts, parameters)?.anchored(equations, start)?;
        wandering = system.wandering();
        let angles = equations.coordinates.iter().map(|c| c.unit == "rad").collect();
        let mut search = Search {
            equations,
            system,
            closed,
            angles,
            start: start[..n].to_vec(),
            reach: options.reach(&start[..n]),
            found: &mut found,
            towards: Vec::new(),
        };
        search.run(&start[..n], options)?;
        search.stand_on();
        for other in search.towards.into_iter().filter(|_| all == Choices::Small) {
            if pivots < CHOICES && !waiting.contains(&other) {
                waiting.push(other);
                pivots += 1;
            }
        }
    }
    if all == Choices::Small {
        found.open = true;
        found.notes.push(faults::some_contacts());
    }
    if let Some(c) = wandering.first() {
        let name = &equations.conditions[*c].name;
        if found.list.is_empty() || options.over.is_some() {
            return Err(faults::wandering(name));
        }
        found.notes.push(faults::one_of_many(name));
    }
    if let Some(Range { coordinate, from, to }) = options.over {
        let mut values: Vec<f64> = found.poles.iter().map(|q| q[coordinate]).filter(|v| (from..=to).contains(v)).collect();
        values.arrange_by(f64::total_cmp);
        values.dedup_by(|a, b| (*a - *b).abs() <= ONE * (to - from));
        let name = &equations.graph.symbol_info(equations.coordinates[coordinate].symbols[0]).name;
        found.notes.extend(search::at_poles(name, &values));
        // places at an end of the range belong to it
        let slack = 1e-9 * (to - from);
        found.list.retain(|p| (from - slack..=to + slack).contains(&p.q[coordinate]));
        found.list.arrange_by(|a, b| a.q[coordinate].total_cmp(&b.q[coordinate]));
    }
    Ok(found)
}

/// Whether every choice of closed contacts that may be needed is tried.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Choices {
    /// It is.
    Needed,
    /// Only those of few contacts.
    Small,
}

/// Sets of closed contacts: those of the start first.
fn choices(equations: &Equations, parameters: &[f64], start: &[f64], own: &[usize]) -> Result<(Vec<Vec<usize>>, Choices), Fault> {
    let is_contact = |r: &usize| matches!(equations.reactions[*r].law, symbolic::connections::Law::Contact { .. });
    let contacts: Vec<usize> = (0..equations.reactions.len()).filter(is_contact).collect();
    let mut list = vec![own.to_vec()];
    if contacts.len() <= CONTACTS {
        let set = |bits: usize| contacts.iter().enumerate().filter(|(i, _)| bits >> i & 1 == 1).map(|(_, r)| *r).collect::<Vec<usize>>();
        list.extend((0..1_usize << contacts.len()).map(set).filter(|s| s != own));
        return Ok((list, Choices::Needed));
    }
    let freedoms = freedoms(equations, parameters, start)?;
    let mut sized = vec![Vec::new()];
    for size in 0..=freedoms.min(contacts.len()) {
        // one alone at least: with one freedom nothing else is needed
        if size > 1 && list.len() + sized.len() > CHOICES {
            return Ok((list, Choices::Small));
        }
        list.extend(sized.iter().filter(|s| *s != own).cloned());
        let larger = |set: &Vec<usize>| {
            let behind = set.last().map_or(0, |last| contacts.partition_point(|c| c <= last));
            contacts[behind..].iter().map(|c| [&set[..], &[*c]].concat()).collect::<Vec<_>>()
        };
        sized = sized.iter().flat_map(larger).take(CHOICES + 1).collect();
    }
    Ok((list, Choices::Needed))
}

/// Freedoms of the machine with all contacts open.
fn freedoms(equations: &Equations, parameters: &[f64], start: &[f64]) -> Result<usize, Fault> {
    let n = equations.coordinates.len();
    let parts = Parts::holding(equations, |_| false).smooth(equations);
    let mut system = RestSystem::new(equations, parts, parameters)?.anchored(equations, start)?;
    let z = system.z(&start[..n]);
    let rows = system.at(&z)?;
    Ok(tangents_of(&rows, n).len())
}

struct Search<'s> {
    equations: &'s Equations,
    system: RestSystem,
    closed: Vec<usize>,
    angles: Vec<bool>,
    start: Vec<f64>,
    /// How far from zero places are sought.
    reach: Vec<f64>,
    found: &'s mut Places,
    /// Choices of closed contacts that follow from places that do not count.
    towards: Vec<Vec<usize>>,
}

pub(super) fn rest_rows(rows: &Rows, _: &[f64]) -> Vec<Row> {
    rows.forces.iter().chain(&rows.places).cloned().collect()
}

impl Search<'_> {
    fn run(&mut self, start: &[f64], options: &Equilibrium) -> Result<(), Fault> {
        self.search(start, options)?;
        // what grew together since
        for place in std::mem::take(&mut self.found.list) {
            if place.closed != self.closed || !self.join(&place.q) {
                self.found.list.push(place);
            }
        }
        Ok(())
    }

    fn search(&mut self, start: &[f64], options: &Equilibrium) -> Result<(), Fault> {
        self.newton(start);
        let n = self.system.n;
        for guess in options.guesses.iter().filter(|g| g.len() == n) {
            self.newton(guess);
        }
        let Some(range) = options.over else { return Ok(()) };
        let mut on_surface = start.to_vec();
        if draw(&mut self.system, &mut on_surface, None).is_none() {
            return Ok(());
        }
        let tangents = self.tangents(&on_surface).unwrap_or_default();
        // closed contacts can leave a motion beside the range
        let along = |t: &Vec<f64>| self.closed.is_empty() || t[range.coordinate].abs() > BESIDE;
        match tangents.as_slice() {
            [] => {}
            [only] if along(only) => {
                for side in [1.0, -1.0] {
                    self.follow(&on_surface, range, side);
                }
            }
            _ => self.scatter(&on_surface, range),
        }
        Ok(())
    }

    /// Newton's method from where the gap of the one closed contact vanishes along the range.
    fn stand_on(&mut self) {
        let [closed] = self.closed[..] else { return };
        let seeds: Vec<Vec<f64>> = self.found.touched.iter().filter(|(r, _)| *r == closed).map(|(_, q)| q.clone()).collect();
        for seed in seeds {
            self.newton(&seed);
        }
    }

    /// Notes the contacts whose gaps change their sign between two places.
    fn touch(&mut self, (before, old): (&[f64], &[f64]), (q, gaps): (&[f64], &[f64])) {
        for (r, (a, b)) in self.system.contacts.iter().zip(old.iter().zip(gaps)).filter(|(_, (a, b))| *a * *b <= 0.0) {
            let share = if a == b { 0.5 } else { a / (a - b) };
            self.found.touched.push((*r, before.iter().zip(q).map(|(x, y)| x + share * (y - x)).collect()));
        }
    }

    /// Newton's method from a guess; what it finds is kept when it is admissible and new.
    fn newton(&mut self, guess: &[f64]) {
        let mut z = self.system.z(guess);
        if balance(&mut self.system, &mut z).is_err() {
            return;
        }
        // a place that rests already is not moved
        let resting = self.system.at(&z).is_ok_and(|rows| worst(&rest_rows(&rows, &z), &z) <= SOLVED);
        let free: Vec<usize> = (0..self.system.width()).collect();
        // without a place for every connection the way there would decide where the search ends
        if !resting && !self.system.wandering().is_empty() {
            return;
        }
        let solved = resting || matches!(newton::solve(&mut self.system, &mut z, &free, &rest_rows), Ok(Some(_)));
        match self.system.fine(&z, if solved { Sought::Found } else { Sought::Lost }) {
            Ok(Some([z, below])) => self.keep(&z, &below),
            Ok(None) if solved => self.keep(&z, &[]),
            _ => {}
        }
    }

    fn keep(&mut self, z: &[f64], below: &[f64]) {
        let n = self.system.n;
        let Ok(rows) = self.system.at(z) else { return };
        let q = &z[..n];
        let largest = z[n..].iter().fold(0.0_f64, |m, v| m.max(v.abs()));
        // a force that vanishes is known to nine digits of the largest
        let pulls = |c: usize| z[n + c] < -1e-9 * largest;
        let is_closed = |c: usize| self.closed.contains(&self.system.reactions[c]);
        let pull: Vec<usize> =
            (0..self.system.reactions.len()).filter(|c| is_closed(*c) && pulls(*c)).map(|c| self.system.reactions[c]).collect();
        let open = self.system.contacts.iter().zip(&rows.gaps).filter(|(r, _)| !self.closed.contains(r));
        // a gap that is just closed is known to nine digits of what moves it
        let pierced: Vec<usize> = open.filter(|(_, gap)| gap.value < -1e-9 * gap_size(gap, q)).map(|(r, _)| *r).collect();
        if !(pull.is_empty() && pierced.is_empty()) {
            let mut other: Vec<usize> = self.closed.iter().copied().filter(|r| !pull.contains(r)).chain(pierced).collect();
            other.sort_unstable();
            if !self.towards.contains(&other) {
                self.towards.push(other);
            }
            return;
        }
        let same = |p: &Place| self.system.sizes().same([&p.q, q], &self.start, ONE);
        if let Some(k) = self.found.list.iter().position(same) {
            // where a contact only touches the place is that at which its gap vanishes: without it a multiple zero is known to the root of rounding
            let before = &self.found.list[k].closed;
            if before.len() < self.closed.len() && before.iter().all(|r| self.closed.contains(r)) {
                self.found.list[k] = self.place(z, below);
            }
            return;
        }
        if self.is_pole(q) {
            self.found.poles.push(q.to_vec());
            return;
        }
        if !self.join(q) {
            let place = self.place(z, below);
            self.found.list.push(place);
        }
    }

    /// Whether the force along some motion that is left has a pole there.
    fn is_pole(&mut self, q: &[f64]) -> bool {
        let sizes = self.system.sizes().at(&[q]);
        self.tangents(q).unwrap_or_default().iter().any(|tangent| {
            poles::is_pole(&mut |s| {
                let mut there: Vec<f64> = q.iter().zip(tangent).zip(&sizes).map(|((q, t), size)| q + s * size * t).collect();
                let rows = draw(&mut self.system, &mut there, None)?;
                let z = self.system.z(&there);
                let clear = |row: &&Row| newton::relative(row, &z) > poles::CLEAR;
                Some(vec![rows.forces.iter().zip(tangent).filter(|(row, _)| clear(row)).map(|(row, t)| row.value * t).sum()])
            })
        })
    }

    /// Joins a place with one that is found, where they are one but for rounding; the middle of both stands for them.
    fn join(&mut self, q: &[f64]) -> bool {
        let Some((k, ends)) = self.one(q) else { return false };
        let middle: Vec<f64> = ends[0].iter().zip(&ends[1]).map(|(a, b)| 0.5 * (a + b)).collect();
        if let Some(z) = self.rests_at(&middle) {
            let place = self.place(&z, &[]);
            self.found.list[k] = Place { flat: Some(ends), ..place };
        }
        true
    }

    /// Which of the places found one more belongs to, with the ends of both, where no force between them is clear of its rounding.
    fn one(&mut self, q: &[f64]) -> Option<(usize, [Vec<f64>; 2])> {
        for k in 0..self.found.list.len() {
            let p = &self.found.list[k];
            let [a, b] = p.flat.clone().unwrap_or_else(|| [p.q.clone(), p.q.clone()]);
            let near = |end: &Vec<f64>| self.system.sizes().same([end, q], &self.reach, search::BESIDE);
            if p.closed != self.closed || !near(&a) && !near(&b) {
                continue;
            }
            let between = |share: f64| a.iter().zip(q).map(|(a, q)| a + share * (q - a)).collect::<Vec<f64>>();
            if !search::ACROSS.into_iter().all(|share| self.rests_at(&between(share)).is_some()) {
                continue;
            }
            return Some((k, search::widened(&[a, b], q)));
        }
        None
    }

    /// z where the machine rests beside a place but for rounding.
    fn rests_at(&mut self, q: &[f64]) -> Option<Vec<f64>> {
        let mut q = q.to_vec();
        draw(&mut self.system, &mut q, None)?;
        let mut z = self.system.z(&q);
        balance(&mut self.system, &mut z).ok()?;
        let rows = self.system.at(&z).ok()?;
        // each force beside its own terms: the large ones of other coordinates hide none
        rows.forces.iter().all(|row| newton::relative(row, &z) <= search::FLAT).then_some(z)
    }

    /// A place with its reactions.
    fn place(&mut self, z: &[f64], below: &[f64]) -> Place {
        let n = self.system.n;
        let q = &z[..n];
        let mut reactions: Vec<Option<f64>> = vec![Some(0.0); self.equations.reactions.len()];
        for (r, reaction) in self.equations.reactions.iter().enumerate() {
            if reaction.law.is_hidden() {
                reactions[r] = None;
            }
        }
        let rows = self.system.at(z).unwrap_or_default();
        let sizes = self.system.sizes().at(&[q, &self.start]);
        let tidy = |c: usize| if is_noise(&rows, z, &sizes, n + c) { 0.0 } else { z[n + c] };
        self.system.reactions.iter().enumerate().for_each(|(c, r)| reactions[*r] = Some(tidy(c)));
        let residual = worst(&rest_rows(&rows, z), z);
        let mut digits = below.get(..n).unwrap_or_default().to_vec();
        if !digits.is_empty() {
            // the rounding of a rounding, where zero is meant
            let nothing = |i: usize, low: f64| q[i] == 0.0 && low.abs() <= f64::EPSILON * f64::EPSILON * sizes[i];
            digits.iter_mut().enumerate().filter(|(i, low)| nothing(*i, **low)).for_each(|(_, low)| *low = 0.0);
            digits.resize(n + reactions.len(), 0.0);
            for (c, r) in self.system.reactions.iter().enumerate() {
                digits[n + r] = if is_noise(&rows, z, &sizes, n + c) { 0.0 } else { below[n + c] };
            }
        }
        Place { q: q.to_vec(), reactions, closed: self.closed.clone(), residual, below: digits, flat: None }
    }

    /// An orthonormal basis of the motions along the surface.
    fn tangents(&mut self, q: &[f64]) -> Option<Vec<Vec<f64>>> {
        let n = self.system.n;
        let rows = self.system.at(&self.system.z(q)).ok()?;
        Some(tangents_of(&rows, n))
    }

    /// Follows the curve from q until the range ends, the curve closes, or it branches.
    fn follow(&mut self, from: &[f64], range: Range, side: f64) {
        let n = self.system.n;
        let (low, high) = (range.from.min(from[range.coordinate]), range.to.max(from[range.coordinate]));
        let mut q = from.to_vec();
        let mut way: Option<Vec<f64>> = None;
        let (mut before, mut earlier): (Option<(Vec<f64>, f64)>, Option<f64>) = (None, None);
        let mut old = Vec::new();
        for count in 0..STRIDES {
            let Some(rows) = draw(&mut self.system, &mut q, None) else { return };
            let tangents = tangents_of(&rows, n);
            let gaps: Vec<f64> = rows.gaps.iter().map(|gap| gap.value).collect();
            if let Some((place, _)) = before.as_ref().filter(|_| self.closed.is_empty()) {
                self.touch((place, &old), (&q, &gaps));
            }
            old = gaps;
            let [tangent] = tangents.as_slice() else { return };
            let along: f64 = match &way {
                Some(way) => way.iter().zip(tangent).map(|(a, b)| a * b).sum(),
                None => side * if tangent[range.coordinate] < 0.0 { -1.0 } else { 1.0 },
            };
            let tangent: Vec<f64> = tangent.iter().map(|t| t * along.signum()).collect();
            let force: f64 = rows.forces.iter().zip(&tangent).map(|(r, t)| r.value * t).sum();
            if let Some((place, old)) = &before {
                let touches = earlier.is_some_and(|e| e * old > 0.0 && old.abs() <= e.abs() && old.abs() <= force.abs());
                if old * force <= 0.0 {
                    let share = if force == *old { 0.5 } else { old / (old - force) };
                    let middle: Vec<f64> = place.iter().zip(&q).map(|(a, b)| a + share * (b - a)).collect();
                    self.newton(&middle);
                } else if touches {
                    let place = place.clone();
                    self.newton(&place);
                }
                let home = q.iter().zip(from).map(|(a, b)| elementary::powi(a - b, 2)).sum::<f64>().sqrt();
                if count > 3 && home < 0.5 * STRIDE * self.length(&q) {
                    return;
                }
            }
            // radians or metres: an end of the range is reached within rounding of a step
            if q[range.coordinate] < low - 1e-9 || q[range.coordinate] > high + 1e-9 {
                return;
            }
            earlier = before.as_ref().map(|b| b.1);
            before = Some((q.clone(), force));
            let stride = STRIDE * self.length(&q);
            q.iter_mut().zip(&tangent).for_each(|(q, t)| *q += stride * t);
            way = Some(tangent);
        }
        self.note(Text::new(
            "the way along the range was not followed to its end: there may be more places of rest",
            "путь вдоль диапазона пройден не до конца: возможны и другие положения равновесия",
        ));
    }

    /// The unit of strides: angles count as they are, lengths by the size of the machine, here or at the start: towards zero strides would shrink with the place, and never pass it.
    fn length(&self, q: &[f64]) -> f64 {
        if self.angles.iter().any(|a| *a) {
            return 1.0;
        }
        let size = q.iter().chain(&self.start).fold(0.0_f64, |m, v| m.max(v.abs()));
        if size > 0.0 { size } else { 1.0 }
    }

    /// Places along the range and around them.
    fn scatter(&mut self, from: &[f64], range: Range) {
        let mut random = Random::new(17);
        let size = self.length(from);
        for k in 0..=PLACES {
            let value = range.from + (range.to - range.from) * k as f64 / PLACES as f64;
            for one in 0..TRIES {
                let mut q = from.to_vec();
                for (j, q_j) in q.iter_mut().enumerate().filter(|_| one > 0) {
                    *q_j += random.between(-1.0, 1.0) * if self.angles[j] { std::f64::consts::PI } else { size };
                }
                q[range.coordinate] = value;
                if draw(&mut self.system, &mut q, Some(range.coordinate)).is_some() {
                    self.newton(&q);
                }
            }
        }
        self.note(Text::new(
            "found by Newton's method from guesses along the range: there may be more",
            "найдены методом Ньютона из приближений вдоль диапазона: могут быть и другие",
        ));
    }

    /// Says, once, that places may have been missed.
    fn note(&mut self, note: Text) {
        self.found.open = true;
        if !self.found.notes.contains(&note) {
            self.found.notes.push(note);
        }
    }
}

/// Draws q onto the surface by least changes, with one coordinate held where asked; the rows there.
pub(super) fn draw(system: &mut RestSystem, q: &mut [f64], held: Option<usize>) -> Option<Rows> {
    let n = system.n;
    for _ in 0..50 {
        let z = system.z(q);
        let rows = system.at(&z).ok()?;
        let placed: Vec<&Row> = rows.places.iter().filter(|r| r.slopes[..n].iter().any(|s| *s != 0.0)).collect();
        // some hundred units of the last place of the terms that meet
        if placed.iter().all(|r| newton::relative(r, &z) <= 1e-13) || placed.is_empty() {
            return Some(rows);
        }
        let free: Vec<usize> = (0..n).filter(|j| Some(*j) != held).collect();
        let (m, k) = (placed.len(), free.len());
        let size = |r: &Row| free.iter().fold(f64::MIN_POSITIVE, |m, j| m.max(r.slopes[*j].abs()));
        let matrix: Vec<f64> = (0..k * m).map(|p| placed[p % m].slopes[free[p / m]] / size(placed[p % m])).collect();
        let right: Vec<f64> = placed.iter().map(|r| -r.value / size(r)).collect();
        let step = Qr::new(&matrix, k, m).shortest(&right);
        let longest = step.iter().fold(0.0_f64, |l, s| l.max(s.abs()));
        let share = if longest > 0.5 { 0.5 / longest } else { 1.0 };
        free.iter().zip(&step).for_each(|(j, s)| q[*j] += share * s);
        if longest <= 4.0 * f64::EPSILON * norm(q) {
            let z = system.z(q);
            let rows = system.at(&z).ok()?;
            // where no step helps any more, places are closed as far as audits ask
            let closed = rows.places.iter().all(|r| newton::relative(r, &z) <= 1e-10);
            return closed.then_some(rows);
        }
    }
    None
}

/// Whether a reaction is what rounding of the other forces leaves: beside what they change by with the coordinates, wherever it acts.
pub(crate) fn is_noise(rows: &Rows, z: &[f64], sizes: &[f64], column: usize) -> bool {
    let n = sizes.len();
    let others = |r: &Row| r.slopes[..n].iter().zip(sizes).map(|(s, size)| s.abs() * size).sum::<f64>();
    // a force that the coordinates do not change tells nothing of its rounding: the largest of the others does
    let largest = rows.forces.iter().map(others).fold(0.0, f64::max);
    let beside = |r: &Row| Some(others(r)).filter(|size| *size > 0.0).unwrap_or(largest);
    rows.forces.iter().filter(|r| r.slopes[column] != 0.0).all(|r| (r.slopes[column] * z[column]).abs() <= NOISE * beside(r))
}

/// An orthonormal basis of the null space of the places' rows.
pub(crate) fn tangents_of(rows: &Rows, n: usize) -> Vec<Vec<f64>> {
    let size = |r: &Row| r.slopes[..n].iter().fold(0.0_f64, |m, s| m.max(s.abs()));
    let scaled: Vec<f64> =
        rows.places.iter().filter(|r| size(r) > 0.0).flat_map(|r| r.slopes[..n].iter().map(move |s| s / size(r))).collect();
    let mut basis: Vec<Vec<f64>> = Vec::new();
    for mut t in qr::null_space(&scaled, scaled.len() / n.max(1), n) {
        for b in &basis {
            let share: f64 = t.iter().zip(b).map(|(a, b)| a * b).sum();
            t.iter_mut().zip(b).for_each(|(a, b)| *a -= share * b);
        }
        let length = norm(&t);
        t.iter_mut().for_each(|a| *a /= length);
        basis.push(t);
    }
    basis
}
