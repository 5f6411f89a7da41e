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
use crate::{Fault, System};
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

    /// Takes whole turns off a state that has turned far; others keep theirs.
    pub(super) fn unwind(&self, x: &mut [f64]) {
        let far = |turn: &&Turn| x[turn[0].0].abs() > WOUND * TAU * turn[0].1;
        let wound: Vec<&Turn> = self.0.iter().filter(far).collect();
        wound.into_iter().for_each(|turn| unwind(turn, x));
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
    orbit.steps.iter().step_by(stride).filter(|s| s.start.high == begin || within(s.start.high)).all(|step| {
        let (t, n) = (step.start.high, orbit.first.len());
        let x: Vec<f64> = (0..n).map(|i| step.start_value(i)).collect();
        // by the motion where it is known for so long, else by its mean
        let far = within(t).then(|| orbit.state_at((t + period).min(begin + elapsed)));
        let gain = |i: usize| far.as_ref().map_or((orbit.last[i] - orbit.first[i]) / elapsed * period, |y| y[i] - x[i]);
        let gains: Vec<f64> = (0..n).map(|i| gain(i) - carried[i] * period).collect();
        let nearby = if far.is_some() { &[0.0][..] } else { &[0.0, 1.0, -1.0] };
        nearby.iter().any(|more| {
            let mut there: Vec<f64> = x.iter().zip(carried).map(|(x, v)| x + v * period).collect();
            known.turns.add(&mut there, (&gains, *more));
            let mut held = there.clone();
            if system.project(t + period, &mut held, &step.modes).is_err() {
                return false;
            }
            let mut change: Vec<f64> = held.iter().zip(&there).map(|(a, b)| a - b).collect();
            known.turns.take_off(&mut change);
            symmetry::clear_shifts(known.loose, &mut change);
            change.iter().zip(known.scales).all(|(change, scale)| change.abs() <= SAME * scale)
        })
    })
}

fn unwind(turn: &Turn, change: &mut [f64]) {
    let (first, count) = turn[0];
    let times = (change[first] / (TAU * count)).round();
    turn.iter().for_each(|(i, n)| change[*i] -= times * n * TAU);
}

/// Velocities, by state, of the angles that make whole turns with each period of the forcing: a wheel behind a spring on a shaft with the angle w t, which the laws
/// know by f - w t and by sin f. Those of the motion are tried, then a turn forwards and backwards; the states all stay where no turn is wanted.
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
    let open: Vec<usize> = (0..trial.first.len()).filter(angle).collect();
    let of_motion: Vec<f64> = open.iter().map(|&i| ((trial.last[i] - trial.first[i]) / elapsed * period / TAU).round()).collect();
    for counts in [of_motion, vec![1.0; open.len()], vec![-1.0; open.len()]] {
        let mut velocities = standing.clone();
        open.iter().zip(counts).for_each(|(&i, count)| velocities[i] = count * TAU / period);
        if velocities.iter().any(|v| *v != 0.0) && repeats(system, (trial, elapsed), (period, &velocities), known)? {
            return Ok(Some(velocities));
        }
    }
    Ok(None)
}

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
