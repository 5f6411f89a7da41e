//! Whole turns after which the laws are the same: of one angle, or of several together.
//!
//! ```text
//! x → x + 2π n,      n whole numbers,      laws(x + 2π n) = laws(x)
//! ```
//!
//! An angle that the laws know by its sine and cosine turns alone. Two absolute angles with a spring between them turn together, one turn each; wheels in an
//! elastic mesh in the ratio of the gear. Which n is tried is read off the motion: what its angles gain in the ratio of whole numbers; whether the laws agree decides.

use super::orbit::Orbit;
use super::symmetry;
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

    /// The same for a state that has turned far; others keep theirs.
    pub(super) fn unwind(&self, x: &mut [f64]) {
        let far = |turn: &&Turn| x[turn[0].0].abs() > WOUND * TAU * turn[0].1;
        let wound: Vec<&Turn> = self.0.iter().filter(far).collect();
        wound.into_iter().for_each(|turn| unwind(turn, x));
    }
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
    (turns, scales): (&Turns, &[f64]),
) -> Result<Option<Vec<f64>>, Fault> {
    let n = system.n_coordinates();
    let standing = vec![0.0; trial.first.len()];
    if symmetry::repeats(system, trial, (period, &standing), scales)? {
        return Ok(Some(standing));
    }
    let angle = |i: &usize| !(n..2 * n).contains(i) && system.states()[*i].unit == "rad" && turns.of(*i).is_none();
    let open: Vec<usize> = (0..trial.first.len()).filter(angle).collect();
    let of_motion: Vec<f64> = open.iter().map(|&i| ((trial.last[i] - trial.first[i]) / elapsed * period / TAU).round()).collect();
    for counts in [of_motion, vec![1.0; open.len()], vec![-1.0; open.len()]] {
        let mut velocities = standing.clone();
        open.iter().zip(counts).for_each(|(&i, count)| velocities[i] = count * TAU / period);
        if velocities.iter().any(|v| *v != 0.0) && symmetry::repeats(system, trial, (period, &velocities), scales)? {
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
