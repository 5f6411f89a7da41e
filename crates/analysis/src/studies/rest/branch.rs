//! A place of rest followed along a parameter p: h(q, p) = 0 from the value that the file gives outwards.
//!
//! ```text
//! q(p) smooth:        a chord (a parabola) and the places at its quarters agree, else the step is halved (natural continuation)
//! one real root -> 0: the number of growing motions without oscillation changes; p* by bisection
//! beyond p*:          q = q(p*) ± s v + ..., v the shape of that motion; s ~ √|p - p*| (pitchfork) or |p - p*| (exchange of stability)
//! gap or force -> 0:  a contact closes or opens; p* by bisection, beyond it the place that continues with another set of closed contacts
//! ```
//!
//! Where a stable place becomes unstable so, the stable place that parts from it is followed. Where halving does not make a step smooth, the place joins
//! another one there (its distance shrinks with the step) or ends (a fold); the machine falls from there to another place. What a machine is at p does not depend on the order of questions.
//!
//! *Source*: R. Seydel, Practical Bifurcation and Stability Analysis, ch. 2 and 5.

mod ends;
mod forks;
mod joins;
mod touches;

use super::contacts::{Contacts, Margin};
use crate::Fault;
use crate::fault::codes;
use crate::linear::{LinearMachine, Place, parts};
use crate::rest::sizes::Sizes;
use crate::studies::modes::{Kind, Mode, Normalisation, modes};
use algebra::arrange::Arrange;
use algebra::cholesky::positive_definite;

/// What becomes of the place at a value.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Event {
    /// It becomes unstable, and a stable one that parts from it is followed; how many stable ones part there.
    Forks(usize),
    /// It becomes unstable, and no stable one parts from it.
    Loses,
    /// It joins another one, which is followed.
    Joins,
    /// Contacts close or open.
    Touches,
    /// It ends, and the machine falls from there to another one, which is followed.
    Falls,
    /// It ends, and another one is taken, where there is one.
    Ends,
}

impl Event {
    /// Name in files.
    pub fn key(self) -> &'static str {
        match self {
            Event::Forks(_) => "forks",
            Event::Loses => "loses_stability",
            Event::Joins => "joins",
            Event::Touches => "contacts",
            Event::Falls => "falls",
            Event::Ends => "ends",
        }
    }
}

/// A change of the place that is followed.
#[derive(Clone, Debug, PartialEq)]
pub struct Change {
    /// Value of the parameter.
    pub value: f64,
    /// Whether the walk goes upwards there.
    pub upwards: bool,
    /// What happens.
    pub event: Event,
    /// q where it happens.
    pub at: Vec<f64>,
    /// q behind it as far as was looked, with the value there; none where there is no place.
    pub behind: Option<(f64, Vec<f64>)>,
    /// Reactions of contacts that close there.
    pub closes: Vec<String>,
    /// Reactions of contacts that open there.
    pub opens: Vec<String>,
}

/// What becomes of the way where other contacts close or open.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Beyond {
    /// It is followed with the equations of the other set.
    Followed,
    /// It ends there.
    Ends,
}

/// A place with the number of motions that grow there without oscillation.
#[derive(Clone, Debug)]
struct Spot {
    place: Place,
    unstable: usize,
    /// Contacts that are closed.
    closed: Vec<usize>,
    /// Contacts that cannot stand so.
    violated: Vec<usize>,
}

#[derive(Clone, Debug)]
struct Station {
    value: f64,
    spot: Option<Spot>,
    /// Whether the way from the last station is not smooth.
    parted: bool,
}

/// How the place depends on the parameter.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Way {
    /// Not at all, nor do the matrices.
    Fixed,
    /// Linear equations: one place for each value, and the matrices are the same in all places.
    Linear,
    /// It is followed.
    Followed,
}

/// A place of rest along a parameter.
#[derive(Clone, Debug)]
pub struct Branch {
    parameter: usize,
    home: f64,
    place: Place,
    way: Way,
    starts: Vec<Vec<f64>>,
    /// Downwards and upwards from home, each beginning there.
    arms: [Vec<Station>; 2],
    /// How far each coordinate has gone from home.
    reach: Vec<f64>,
    changes: Vec<Change>,
    /// Steps tried so far.
    steps: usize,
    contacts: Option<Contacts>,
    beyond: Beyond,
    /// Contacts that are closed at home, and where the walk is now.
    own: Vec<usize>,
    closed: Vec<usize>,
    /// Whether the machine runs into a pole behind the last station, downwards and upwards: no place is sought beyond.
    singular: [bool; 2],
    sizes: Sizes,
}

/// Pieces into which a range is cut at first.
const PIECES: usize = 32;
/// The same for a value beyond the range.
const FURTHER: usize = 4;
/// Distance of a place from its chord, relative to the chord, that is smooth.
const SMOOTH: f64 = 0.05;
/// Distance of a place from the parabola over its chord, relative to the larger of the two, that is smooth.
const BENT: f64 = 0.01;
/// The same relative to all that a coordinate has gone, and to its size: what is smaller is nothing to halve for.
const SLIGHT: f64 = 1e-8;
// of the size of the coordinate: what Newton leaves of it
const NOTHING: f64 = 1e-10;
/// Distance over a narrow step, relative to what the coordinate has gone, that is rounding: a root's is 1e-6.
const NOISE: f64 = 1e-8;
/// Places that are sought on the way at most; beyond that steps count as smooth.
const MOST: usize = 20_000;
/// Width of a step, relative to the values, that is not halved any more.
const NARROW: f64 = 1e-12;
/// Share of the way from home to which a fork is located, and below which its value is zero.
const ZERO: f64 = 1e-15;
/// Coordinates that are zero, in their units.
const NOUGHT: f64 = 1e-20;
/// Values that differ by less than this share are those of one change: places about a fork are known to the root of rounding.
const ONE: f64 = 1e-7;
/// Distance over such a step, relative to what the coordinate has gone, that is a root's and not a leap's.
const JOINED: f64 = 1e-2;
/// How far behind a fork, relative to the way from home, the places that part from it are sought.
const BEHIND: f64 = 1e-5;

impl Branch {
    /// The place at the value that the machine has now; `starts` are where rest is sought when it ends.
    pub fn new(machine: &LinearMachine, parameter: usize, place: &Place, starts: Vec<Vec<f64>>) -> Branch {
        let way = match () {
            () if !machine.depends_on(parameter) => Way::Fixed,
            () if machine.same_everywhere() => Way::Linear,
            () => Way::Followed,
        };
        let reach = vec![0.0; place.q.len()];
        let (home, place) = (machine.value(parameter), place.clone());
        Branch {
            parameter,
            home,
            place,
            way,
            starts,
            arms: Default::default(),
            reach,
            changes: Vec::new(),
            steps: 0,
            contacts: None,
            beyond: Beyond::Followed,
            own: Vec::new(),
            closed: Vec::new(),
            singular: [false; 2],
            sizes: Sizes::new(machine.coordinates().iter().map(|q| q.unit.as_str())),
        }
    }

    /// The same with the contacts of the machine, which has those closed that hold at home.
    pub fn with_contacts(mut self, contacts: Option<Contacts>, beyond: Beyond) -> Branch {
        self.own = contacts.as_ref().map(|c| c.held().to_vec()).unwrap_or_default();
        self.closed = self.own.clone();
        if contacts.is_some() {
            // the place need not move for a gap to close
            self.way = Way::Followed;
        }
        (self.contacts, self.beyond) = (contacts, beyond);
        self
    }

    /// Gives the machine the contacts that are closed at home.
    ///
    /// *Errors*: none that was not met before.
    pub fn leave(&mut self, machine: &mut LinearMachine) -> Result<(), Fault> {
        self.closed = self.own.clone();
        self.hold(machine)
    }

    fn hold(&mut self, machine: &mut LinearMachine) -> Result<(), Fault> {
        match &mut self.contacts {
            Some(contacts) => contacts.hold(machine, &self.closed),
            None => Ok(()),
        }
    }

    /// Index of the parameter.
    pub fn parameter(&self) -> usize {
        self.parameter
    }

    /// The value from which the place is followed.
    pub fn home(&self) -> f64 {
        self.home
    }

    /// The place there.
    pub fn home_place(&self) -> &Place {
        &self.place
    }

    /// Changes on the way, by value.
    pub fn changes(&self) -> Vec<Change> {
        let mut list = self.changes.clone();
        for change in &mut list {
            let arm = &self.arms[usize::from(change.upwards)];
            let next =
                self.changes.iter().filter(|c| c.upwards == change.upwards && between(change.value, c.value, usize::from(change.upwards)));
            let end = next.map(|c| c.value).min_by(|a, b| (a - change.value).abs().total_cmp(&(b - change.value).abs()));
            let behind = arm.iter().filter(|s| between(change.value, s.value, usize::from(change.upwards)));
            let last = behind.take_while(|s| end.is_none_or(|e| between(s.value, e, usize::from(change.upwards)))).last();
            change.behind = last.and_then(|s| s.spot.as_ref().map(|spot| (s.value, spot.place.q.clone())));
        }
        list.arrange_by(|a, b| a.value.total_cmp(&b.value));
        list
    }

    /// Follows the place over a range at once.
    ///
    /// *Errors*: formulas without a value.
    pub fn cover(&mut self, machine: &mut LinearMachine, ends: [f64; 2]) -> Result<(), Fault> {
        if self.way == Way::Followed {
            for end in ends {
                self.extend(machine, end, PIECES)?;
            }
        }
        Ok(())
    }

    /// The place at a value, which the machine has from then on; none where there is none.
    ///
    /// *Errors*: formulas without a value.
    pub fn place(&mut self, machine: &mut LinearMachine, value: f64) -> Result<Option<Place>, Fault> {
        match self.way {
            Way::Fixed => {
                machine.set(self.parameter, value)?;
                return Ok(Some(self.place.clone()));
            }
            Way::Linear => return self.settled(machine, value, &self.place.q.clone()),
            Way::Followed => {}
        }
        self.extend(machine, value, FURTHER)?;
        let arm = &self.arms[usize::from(value > self.home)];
        let k =
            arm.iter().position(|s| s.value == value || !between(s.value, value, usize::from(value > self.home))).unwrap_or(arm.len() - 1);
        let station = arm[k].clone();
        let Some(outer) = &station.spot else {
            machine.set(self.parameter, value)?;
            return Ok(None);
        };
        self.closed = outer.closed.clone();
        if station.value == value {
            self.hold(machine)?;
            machine.set(self.parameter, value)?;
            return Ok(Some(outer.place.clone()));
        }
        let arm = &self.arms[usize::from(value > self.home)];
        let inner = arm[k - 1].spot.as_ref().filter(|_| !station.parted);
        let share = (value - arm[k - 1].value) / (station.value - arm[k - 1].value);
        let guess = inner.map_or(outer.place.q.clone(), |inner| mixed(&inner.place.q, &outer.place.q, share));
        self.settled(machine, value, &guess)
    }

    /// Whether the matrices or the place depend on the parameter.
    pub fn moves(&self) -> bool {
        self.way != Way::Fixed
    }

    fn settled(&mut self, machine: &mut LinearMachine, value: f64, guess: &[f64]) -> Result<Option<Place>, Fault> {
        self.hold(machine)?;
        machine.set(self.parameter, value)?;
        match machine.settle(guess) {
            Ok(mut place) => {
                // Newton's method closes in on a triple root at zero without end
                place.q.iter_mut().filter(|q| q.abs() <= NOUGHT).for_each(|q| *q = 0.0);
                Ok(Some(place))
            }
            Err(fault) if fault.code == codes::NO_REST => Ok(None),
            Err(fault) => Err(fault),
        }
    }

    fn spot(&mut self, machine: &mut LinearMachine, value: f64, guess: &[f64]) -> Result<Option<Spot>, Fault> {
        let Some(place) = self.settled(machine, value, guess)? else { return Ok(None) };
        let unstable = diverging(machine, &place)?.len();
        let margins = self.margins(machine, &place)?;
        let violated = margins.iter().filter(|m| m.is_violated()).map(|m| m.contact).collect();
        Ok(Some(Spot { place, unstable, closed: self.closed.clone(), violated }))
    }

    fn margins(&mut self, machine: &mut LinearMachine, place: &Place) -> Result<Vec<Margin>, Fault> {
        match &mut self.contacts {
            Some(contacts) => contacts.margins(machine, place),
            None => Ok(Vec::new()),
        }
    }

    /// Walks outwards to a value, at first in pieces.
    fn extend(&mut self, machine: &mut LinearMachine, to: f64, pieces: usize) -> Result<(), Fault> {
        let side = usize::from(to > self.home);
        if self.arms[side].is_empty() {
            self.closed = self.own.clone();
            let spot = self.spot(machine, self.home, &self.place.q.clone())?;
            // contacts that the place itself leaves in doubt stand as they were found
            let spot = spot.map(|s| Spot { violated: Vec::new(), ..s });
            self.arms[side].push(Station { value: self.home, spot, parted: false });
        }
        let from = self.last(side).value;
        if !between(from, to, side) {
            return Ok(());
        }
        for k in 1..=pieces {
            let value = if k == pieces { to } else { from + (to - from) * k as f64 / pieces as f64 };
            if between(self.last(side).value, value, side) {
                self.cell(machine, side, value)?;
            }
        }
        Ok(())
    }

    fn last(&self, side: usize) -> Station {
        self.arms[side].last().cloned().unwrap_or(Station { value: self.home, spot: None, parted: false })
    }

    /// From the last station to a value, halved until it is smooth or narrow.
    fn cell(&mut self, machine: &mut LinearMachine, side: usize, to: f64) -> Result<(), Fault> {
        self.steps += 1;
        let a = self.last(side);
        let Some(here) = &a.spot else {
            let spot = if self.has_ended(side) { None } else { self.anew(machine, to, (None, None))?.0 };
            self.push(side, Station { value: to, spot, parted: true });
            return Ok(());
        };
        self.closed = here.closed.clone();
        let there = self.spot(machine, to, &here.place.q)?;
        let middle = 0.5 * (a.value + to);
        if (to - a.value).abs() <= NARROW * to.abs().max(a.value.abs()).max((to - self.home).abs()) || middle == a.value || middle == to {
            return self.singular(machine, side, Station { value: to, spot: there, parted: true });
        }
        let mut next = None;
        if let Some(spot) = there
            && (self.steps > MOST || self.smooth(machine, here, (&spot, to), a.value)?)
        {
            next = Some(spot);
        } else if let Some(ahead) = self.ahead(side, to)
            && let Some(spot) = self.spot(machine, to, &ahead)?
            && self.smooth(machine, here, (&spot, to), a.value)?
        {
            next = Some(spot);
        }
        if let Some(spot) = next {
            let forks = here.unstable == 0 && spot.unstable > 0;
            let station = Station { value: to, spot: Some(spot), parted: false };
            return match station.spot.as_ref().is_some_and(|s| !s.violated.is_empty()) {
                true => self.touch(machine, side, station),
                false if forks => self.fork(machine, side, station),
                false => {
                    self.push(side, station);
                    Ok(())
                }
            };
        }
        self.cell(machine, side, middle)?;
        self.walk(machine, side, to)
    }

    /// The place at a value on the straight way through the last two stations. It leads past a change point of the connections, where reactions grow without
    /// bound and Newton's method from this side does not arrive on the other.
    fn ahead(&self, side: usize, to: f64) -> Option<Vec<f64>> {
        let [.., before, last] = self.arms[side].as_slice() else { return None };
        let (a, b) = (before.spot.as_ref()?, last.spot.as_ref()?);
        let share = (to - before.value) / (last.value - before.value);
        (!last.parted && share.is_finite()).then(|| mixed(&a.place.q, &b.place.q, share))
    }

    /// Whether the places at the quarters lie where the chord or a parabola has its own. A root √p that begins within the step meets neither; a coordinate
    /// that turns round is a parabola over a chord of nothing.
    fn smooth(&mut self, machine: &mut LinearMachine, a: &Spot, (b, to): (&Spot, f64), from: f64) -> Result<bool, Fault> {
        let mut off: Vec<Vec<f64>> = Vec::new();
        for share in [0.5, 0.75, 0.25] {
            let chord = mixed(&a.place.q, &b.place.q, share);
            let Some(m) = self.spot(machine, from + share * (to - from), &chord)? else { return Ok(false) };
            if m.unstable != a.unstable && m.unstable != b.unstable || b.violated.is_empty() && !m.violated.is_empty() {
                return Ok(false);
            }
            off.push(m.place.q.iter().zip(&chord).map(|(m, c)| m - c).collect());
        }
        let (a, b) = (&a.place.q, &b.place.q);
        let sizes = self.sizes.at(&[a, b, &self.place.q]);
        let within = |i: usize| {
            let (span, half) = ((b[i] - a[i]).abs(), off[0][i]);
            let slight = SLIGHT * self.reach[i].max(span).max(half.abs()) + NOTHING * sizes[i];
            let straight = off.iter().all(|off| off[i].abs() <= SMOOTH * span + slight);
            let bent = || off[1..].iter().all(|off| (off[i] - 0.75 * half).abs() <= BENT * span.max(half.abs()) + slight);
            straight || bent()
        };
        Ok((0..a.len()).all(within))
    }

    fn push(&mut self, side: usize, station: Station) {
        if let Some(spot) = &station.spot {
            self.reach.iter_mut().zip(spot.place.q.iter().zip(&self.place.q)).for_each(|(r, (q, home))| *r = r.max((q - home).abs()));
        }
        self.arms[side].push(station);
    }

    fn change(&mut self, side: usize, value: f64, event: Event, at: &[f64]) {
        let gone = self.arms[side].last().map_or(0.0, |s| (s.value - self.home).abs()).max(self.home.abs());
        let value = if value.abs() <= 2.0 * ZERO * gone { 0.0 } else { value };
        let (closes, opens) = Default::default();
        self.changes.push(Change { value, upwards: side == 1, event, at: at.to_vec(), behind: None, closes, opens });
    }

    /// Whether the way ended where other contacts close or open.
    fn has_ended(&self, side: usize) -> bool {
        self.singular[side]
            || self.beyond == Beyond::Ends && self.changes.iter().any(|c| c.upwards == (side == 1) && c.event == Event::Touches)
    }

    /// On to a value.
    fn walk(&mut self, machine: &mut LinearMachine, side: usize, to: f64) -> Result<(), Fault> {
        while between(self.last(side).value, to, side) {
            self.cell(machine, side, to)?;
        }
        Ok(())
    }

    /// A smooth step without contacts that change, through a fork if there is one.
    fn push_or_walk(&mut self, machine: &mut LinearMachine, side: usize, to: Station) -> Result<(), Fault> {
        let stable = |s: &Station| s.spot.as_ref().is_some_and(|s| s.unstable == 0);
        if stable(&self.last(side)) && !stable(&to) {
            return self.fork(machine, side, to);
        }
        self.push(side, Station { spot: to.spot.map(|s| Spot { violated: Vec::new(), ..s }), ..to });
        Ok(())
    }
}

/// Distance of places that are one, relative to the sizes of the coordinates.
const ONE_PLACE: f64 = 1e-9;

/// Guesses beside a fork, each a third of the last: down to 3^-16 = 2e-8 of the unit.
const SEEDS: usize = 17;

/// Motions that grow without oscillation at a place, with the parameters as they are.
pub(super) fn diverging(machine: &mut LinearMachine, place: &Place) -> Result<Vec<Mode>, Fault> {
    let matrices = machine.at(place)?;
    if matrices.drift.is_empty() {
        let along = matrices.allowed().map_or_else(|| matrices.clone(), |(z, k)| matrices.reduced(&z, k));
        if along.n == 0 || positive_definite(&parts(&along.stiffness, along.n).0, along.n) == Some(true) {
            return Ok(Vec::new());
        }
    }
    // bodies without mass have no roots, and nothing to say here
    let found = modes(&matrices, machine.coordinates(), Normalisation::Largest);
    Ok(found.map_or(Vec::new(), |f| f.modes.into_iter().filter(|m| m.kind == Kind::Divergence).collect()))
}

/// Share of its frequency from which an oscillation grows: one that neither grows nor dies away has roots to eleven digits.
const GROWS: f64 = 1e-9;

/// Whether an oscillation grows at a place.
pub(super) fn flutters(machine: &mut LinearMachine, place: &Place) -> Result<bool, Fault> {
    let matrices = machine.at(place)?;
    let found = modes(&matrices, machine.coordinates(), Normalisation::Largest);
    Ok(found.is_ok_and(|f| f.modes.iter().any(|m| m.kind == Kind::Oscillation && m.root.0 > GROWS * m.root.1.abs())))
}

/// Whether `b` lies strictly behind `a` on an arm: 1 goes upwards, 0 downwards.
fn between(a: f64, b: f64, arm: usize) -> bool {
    if arm == 1 { b > a } else { b < a }
}

fn mixed(a: &[f64], b: &[f64], share: f64) -> Vec<f64> {
    a.iter().zip(b).map(|(a, b)| a + share * (b - a)).collect()
}

fn distance(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b) * (a - b)).sum::<f64>().sqrt()
}
