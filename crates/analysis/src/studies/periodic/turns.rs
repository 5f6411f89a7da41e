//! Whole turns after which the laws are the same: of one angle, or of several together.
//!
//! ```text
//! x → x + 2π n,      n whole numbers,      laws(x + 2π n) = laws(x)
//! ```
//!
//! An angle that the laws know by its sine and cosine turns alone. Two absolute angles with a spring between them turn together, one turn each; wheels in an
//! elastic mesh in the ratio of the gear. Which n is tried is read off the motion: what its angles gain in the ratio of whole numbers; whether the laws agree decides.

use super::orbit::Orbit;
use super::symmetry::{self, Symmetry};
use crate::{Fault, Since, System};
use algebra::qr::{DEPENDENT, Qr};
use std::f64::consts::TAU;

/// Most turns of the first of several angles that are tried together.
const MOST: usize = 8;
/// Angles are taken off where they are beyond so many turns.
const WOUND: f64 = 2.0;

/// Angles (by state) that turn together, with their numbers of turns; the first one's is positive.
type Turn = Vec<(usize, f64)>;

/// All whole turns that the laws do not feel.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Turns(Vec<Turn>);

impl Turns {
    /// Of the angles among coordinates and auxiliary states.
    pub(super) fn find<S: System + ?Sized>(system: &mut S, trial: &Orbit, scales: &[f64]) -> Result<Turns, Fault> {
        let n = system.n_coordinates();
        let angles: Vec<usize> = (0..trial.first.len()).filter(|i| !(n..2 * n).contains(i) && system.states()[*i].unit == "rad").collect();
        let (mut list, mut open) = (Vec::new(), Vec::new());
        for i in angles {
            let alone = vec![(i, 1.0)];
            if symmetry::turned(system, trial, &alone, scales)? { list.push(alone) } else { open.push(i) }
        }
        while let Some(&first) = open.first() {
            let found = together(system, trial, (first, &open), scales)?;
            let taken: Vec<usize> = found.iter().flatten().map(|t| t.0).chain([first]).collect();
            open.retain(|i| !taken.contains(i));
            list.extend(found);
        }
        Ok(Turns(list))
    }

    /// The angle after which a state alone, or with others, is where it was.
    pub(super) fn of(&self, state: usize) -> Option<f64> {
        self.0.iter().flatten().find(|t| t.0 == state).map(|t| TAU * t.1.abs())
    }

    /// Takes whole turns out of a change.
    pub(super) fn take_off(&self, change: &mut [f64]) {
        self.0.iter().for_each(|turn| unwind(turn, change));
    }

    /// Whether the laws do not feel the whole turns that are in this change.
    ///
    /// *Errors*: those of the equations.
    pub(super) fn unfelt<S: System + ?Sized>(&self, system: &mut S, orbit: &Orbit, scales: &[f64], change: &[f64]) -> Result<bool, Fault> {
        for turn in self.0.iter().filter(|turn| times(turn, change) != 0.0) {
            if !symmetry::turned(system, orbit, turn, scales)? {
                return Ok(false);
            }
        }
        Ok(true)
    }

    /// Takes whole turns off a state that has turned far; others keep theirs.
    pub(super) fn unwind(&self, x: &mut [f64]) {
        let far = |turn: &&Turn| x[turn[0].0].abs() > WOUND * TAU * turn[0].1;
        let wound: Vec<&Turn> = self.0.iter().filter(far).collect();
        wound.into_iter().for_each(|turn| unwind(turn, x));
    }

    /// Whole turns, by state, that give conditions on rates what they have gained since the start; none where whole turns do not.
    ///
    /// *Errors*: those of `kept`, which says what a state has gained.
    pub(super) fn wound(
        &self,
        start: &[f64],
        gained: &[f64],
        kept: &mut impl FnMut(&[f64]) -> Result<Vec<f64>, Fault>,
    ) -> Result<Option<Vec<f64>>, Fault> {
        let (rows, columns) = (gained.len(), self.0.len());
        let after = |counts: &[f64]| {
            let mut x = start.to_vec();
            self.0.iter().zip(counts).for_each(|(turn, times)| turn.iter().for_each(|(i, n)| x[*i] += times * n * TAU));
            x
        };
        let mut by = Vec::with_capacity(columns);
        for turn in 0..columns {
            let counts: Vec<f64> = (0..columns).map(|k| if k == turn { 1.0 } else { 0.0 }).collect();
            by.push(kept(&after(&counts))?);
        }
        let matrix: Vec<f64> = (0..rows * columns).map(|k| by[k % columns][k / columns]).collect();
        let counts: Vec<f64> = Qr::alike(&matrix, rows, columns, DEPENDENT).least_squares(gained).0.iter().map(|c| c.round()).collect();
        let there = after(&counts);
        let size = by.iter().flatten().fold(0.0_f64, |m, v| m.max(v.abs()));
        let left = kept(&there)?.iter().zip(gained).fold(0.0_f64, |m, (a, b)| m.max((a - b).abs()));
        Ok((left <= SAME * size).then(|| there.iter().zip(start).map(|(a, b)| a - b).collect()))
    }

    /// Adds the whole turns that are nearest to what the states gain, and so many more of each.
    fn add(&self, x: &mut [f64], (gains, more): (&[f64], f64)) {
        for turn in &self.0 {
            let (first, count) = turn[0];
            let times = (gains[first] / (TAU * count)).round() + more;
            turn.iter().for_each(|(i, n)| x[*i] += times * n * TAU);
        }
    }
}

/// What is known of the laws beside a motion.
pub(super) struct Known<'a> {
    pub(super) turns: &'a Turns,
    /// Translations that the laws do not feel.
    pub(super) loose: &'a Symmetry,
    /// What the states vary by.
    pub(super) scales: &'a [f64],
}

/// States that are conditions' and come back to this share of their scales are the same: a projection leaves less.
const SAME: f64 = 1e-8;
/// Places along the motion at which the conditions are held against those of a later instant.
const PLACES: usize = 12;

/// Whether the machine is the same after this time, while states are carried along with these velocities: its laws, and its conditions. A crank that turns by w t is elsewhere until it has made
/// whole turns, and what the laws say of its angle says nothing of time alone.
pub(super) fn repeats<S: System + ?Sized>(
    system: &mut S,
    (orbit, elapsed): (&Orbit, f64),
    (period, carried): (f64, &[f64]),
    known: &Known<'_>,
) -> Result<bool, Fault> {
    Ok(symmetry::repeats(system, orbit, (period, carried), known.scales)? && kept(system, (orbit, elapsed), (period, carried), known))
}

/// Whether states of the motion keep to the conditions of a later instant, but for whole turns and translations that the laws do not feel.
fn kept<S: System + ?Sized>(system: &mut S, (orbit, elapsed): (&Orbit, f64), (period, carried): (f64, &[f64]), known: &Known<'_>) -> bool {
    let begin = orbit.steps.first().map_or(0.0, |s| s.start.high);
    // rounding of the end of a period
    let within = |t: f64| t + period <= begin + elapsed * (1.0 + SAME);
    let stride = orbit.steps.len().div_ceil(PLACES).max(1);
    let closed = orbit.closed();
    orbit.steps.iter().step_by(stride).filter(|s| s.start.high == begin || within(s.start.high)).all(|step| {
        let (t, n) = (step.start.high, orbit.first.len());
        let x: Vec<f64> = (0..n).map(|i| step.start_value(i)).collect();
        // by the motion where it is known for so long, else by its mean
        let far = within(t).then(|| orbit.state_at((t + period).min(begin + elapsed)));
        let gain = |i: usize| far.as_ref().map_or((orbit.last[i] - orbit.first[i]) / elapsed * period, |y| y[i] - x[i]);
        let gains: Vec<f64> = (0..n).map(|i| gain(i) - carried[i] * period).collect();
        let (begun, start) = far.as_ref().map_or((t, &x[..]), |y| (t + period, &y[..]));
        let from = Since { t: begun, x: start, closed: &closed };
        let carried: Vec<f64> = x.iter().zip(carried).map(|(x, v)| x + v * period).collect();
        let mut change = |there: &[f64]| -> Option<Vec<f64>> {
            let mut held = there.to_vec();
            system.rejoin(t + period, &mut held, &step.modes, from).ok()?;
            Some(held.iter().zip(there).map(|(a, b)| a - b).collect())
        };
        let mut keeps = |there: &[f64]| {
            let Some(mut change) = change(there) else { return false };
            known.turns.take_off(&mut change);
            symmetry::clear_shifts(known.loose, &mut change);
            change.iter().zip(known.scales).all(|(change, scale)| change.abs() <= SAME * scale)
        };
        let nearby = if far.is_some() { &[0.0][..] } else { &[0.0, 1.0, -1.0] };
        let turned = |more: &f64| {
            let mut there = carried.clone();
            known.turns.add(&mut there, (&gains, *more));
            there
        };
        // those that the motion gains, or none: what a wheel gains on its way to a regime need not be its turns in it
        nearby.iter().map(turned).chain([carried.clone()]).any(|there| keeps(&there))
    })
}

/// How often a turn is in a change.
fn times(turn: &Turn, change: &[f64]) -> f64 {
    let (first, count) = turn[0];
    (change[first] / (TAU * count)).round()
}

fn unwind(turn: &Turn, change: &mut [f64]) {
    let times = times(turn, change);
    turn.iter().for_each(|(i, n)| change[*i] -= times * n * TAU);
}

/// Velocities, by state, of what the forcing carries along: angles that make whole turns with each of its periods (a wheel behind a spring on a shaft with the angle w t, which the laws
/// know by f - w t and by sin f), and coordinates that conditions prescribe (x = v t over a wavy road, whose waves come back after λ/v). Turns of the motion are tried, then one forwards
/// and one backwards; the states all stay where no turn is wanted.
///
/// *Errors*: none where the laws do not repeat so.
pub(super) fn carried<S: System + ?Sized>(
    system: &mut S,
    (trial, elapsed): (&Orbit, f64),
    period: f64,
    known: &Known<'_>,
) -> Result<Option<Vec<f64>>, Fault> {
    let n = system.n_coordinates();
    let standing = vec![0.0; trial.first.len()];
    if repeats(system, (trial, elapsed), (period, &standing), known)? {
        return Ok(Some(standing));
    }
    let angle = |i: &usize| !(n..2 * n).contains(i) && system.states()[*i].unit == "rad" && known.turns.of(*i).is_none();
    let angles: Vec<usize> = (0..trial.first.len()).filter(angle).collect();
    let of_motion: Vec<f64> = angles.iter().map(|&i| ((trial.last[i] - trial.first[i]) / elapsed * period / TAU).round()).collect();
    let mut tried = Vec::new();
    for counts in [of_motion, vec![1.0; angles.len()], vec![-1.0; angles.len()]] {
        let mut velocities = standing.clone();
        angles.iter().zip(counts).for_each(|(&i, count)| velocities[i] = count * TAU / period);
        tried.push(velocities);
    }
    let prescribed = prescribed(system, trial, period, known);
    tried.push(with_them(&prescribed, known.loose));
    tried.push(prescribed);
    for velocities in tried.into_iter().filter(|velocities| velocities.iter().any(|v| *v != 0.0)) {
        if repeats(system, (trial, elapsed), (period, &velocities), known)? {
            return Ok(Some(velocities));
        }
    }
    Ok(None)
}

/// Mean velocities over a period of coordinates that conditions prescribe: moved, they go back to where they were.
fn prescribed<S: System + ?Sized>(system: &mut S, trial: &Orbit, period: f64, known: &Known<'_>) -> Vec<f64> {
    let (x, modes, mut velocities) = (&trial.first, &trial.modes[0], vec![0.0; trial.first.len()]);
    let begin = trial.steps.first().map_or(0.0, |s| s.start.high);
    let since = Since { t: begin, x, closed: &trial.closed() };
    let mut later = x.clone();
    if system.rejoin(begin + period, &mut later, modes, since).is_err() {
        return velocities;
    }
    let n = system.n_coordinates();
    for i in (0..n).filter(|i| later[*i] != x[*i]) {
        let mut aside = x.clone();
        aside[i] += ASIDE * known.scales[i];
        let back = system.rejoin(begin, &mut aside, modes, since).is_ok();
        if back && (aside[i] - x[i]).abs() <= SAME * ASIDE * known.scales[i] {
            velocities[i] = (later[i] - x[i]) / period;
        }
    }
    velocities
}

/// The same with what the laws know only beside them: a mass that a drive drags along by a spring goes on with it.
fn with_them(prescribed: &[f64], loose: &Symmetry) -> Vec<f64> {
    let mut velocities = vec![0.0; prescribed.len()];
    for (i, v) in prescribed.iter().enumerate().filter(|(_, v)| **v != 0.0) {
        match loose.shifts.iter().find(|(_, shift)| shift[i] != 0.0) {
            Some((_, shift)) => velocities.iter_mut().zip(shift).for_each(|(sum, s)| *sum += v / shift[i] * s),
            None => velocities[i] += v,
        }
    }
    velocities
}

/// Share of its scale by which a coordinate is moved to see whether conditions prescribe it.
const ASIDE: f64 = 1e-3;

/// The least turn of an angle with others that the laws do not feel: in the ratios of the motion, else once each.
fn together<S: System + ?Sized>(
    system: &mut S,
    trial: &Orbit,
    (first, open): (usize, &[usize]),
    scales: &[f64],
) -> Result<Option<Turn>, Fault> {
    let gains: Vec<f64> = open.iter().map(|&i| trial.last[i] - trial.first[i]).collect();
    let own = trial.last[first] - trial.first[first];
    let of_motion = (1..=MOST).map(|k| gains.iter().map(|g| (g / own * k as f64).round()).collect::<Vec<f64>>());
    let once = std::iter::once(vec![1.0; open.len()]);
    for counts in of_motion.chain(once).filter(|c| c.iter().all(|n| n.is_finite())) {
        let mut turn: Turn = open.iter().copied().zip(counts).filter(|t| t.1 != 0.0).collect();
        turn.sort_by_key(|t| t.0 != first);
        if turn.first().is_none_or(|t| t.0 != first) || !symmetry::turned(system, trial, &turn, scales)? {
            continue;
        }
        // angles that turn beside it by themselves do not belong to it
        for i in open.iter().filter(|i| **i != first) {
            let fewer: Turn = turn.iter().copied().filter(|t| t.0 != *i).collect();
            if fewer.len() < turn.len() && symmetry::turned(system, trial, &fewer, scales)? {
                turn = fewer;
            }
        }
        return Ok(Some(turn));
    }
    Ok(None)
}
