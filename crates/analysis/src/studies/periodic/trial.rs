//! The trial run: what a machine varies by, and for how long a motion as slow as it is followed.

use super::faults::interrupted;
use super::listener::Stage;
use super::options::{Periodic, Return};
use super::orbit::Orbit;
use crate::integrate::taylor::{Flow, Options};
use crate::studies::pace::{Doubled, may_strike};
use crate::studies::simulate::Grid;
use crate::{Fault, System};

/// Steps of the trial run.
const TRIAL: usize = 150;
/// Share of its scale by which a coordinate at rest may move within a turn.
const RESTS: f64 = 1e-13;

/// A trial run with the least scales, and the options with the time for which a motion as slow as it is followed.
pub(super) fn opened<'o, S: System + ?Sized>(
    system: &mut S,
    start: &[f64],
    options: &Periodic<'o>,
) -> Result<(Periodic<'o>, (Orbit, Vec<f64>)), Fault> {
    let (trial, floor) = trial(system, start, options, &flow(options))?;
    let longest = options.longest.max(patience(&trial, options));
    Ok((Periodic { longest, by: options.by.clone(), grid: Grid::Auto, outputs: None, ..*options }, (trial, floor)))
}

pub(super) fn flow(options: &Periodic<'_>) -> Options {
    Options { tolerance: options.tolerance, ..Options::default() }
}

/// How long a motion as slow as this one is followed to its return at least, s; a given period, even where it is a guess only, says more.
pub(super) fn patience(trial: &Orbit, options: &Periodic<'_>) -> f64 {
    let given = if let Return::Period(period) = options.by { GUESSES * period } else { 0.0 };
    trial.steps.iter().map(|step| STEPS * step.length).fold(given, f64::max)
}

/// A motion is followed to its return for so many of the longest steps of its trial: a step leads over about a radian of the quickest motion, and a turn of many thousands is none that is waited for.
const STEPS: f64 = 1e4;
/// And for so many of the given period.
const GUESSES: f64 = 100.0;
/// What moves takes more than one step within this time, s: thirty times the age of the universe.
const NEVER: f64 = 1e19;

/// Some steps after the time to settle. Only the first half counts, for the run may have ended before a singular place.
pub(super) fn trial<S: System + ?Sized>(
    system: &mut S,
    start: &[f64],
    options: &Periodic<'_>,
    with: &Options,
) -> Result<(Orbit, Vec<f64>), Fault> {
    let mut flow = Flow::start(system, 0.0, start, with)?;
    let mut floor = settle(&mut flow, options.settle, options)?;
    floor.iter_mut().for_each(|size| *size *= FLOOR);
    let (begin, x) = (flow.time(), flow.state().to_vec());
    let kept = |orbit: Orbit, end: f64| (halved(orbit, begin, end), floor.clone());
    // a forced machine that runs away from its regime does so within any longer time
    let enough = if let Return::Period(period) = options.by { PERIODS * period * options.returns.max(1) as f64 } else { f64::INFINITY };
    // however slow the machine is; where nothing moves, no time shows more than another
    let (most, mut horizon) = (enough.min(NEVER), options.longest.min(enough));
    loop {
        if let Ok(orbit) = steps(&mut flow, begin + horizon, options)
            && flow.time() < NEVER
            && (horizon >= most || orbit.steps.len() == TRIAL)
        {
            return Ok(kept(orbit, flow.time()));
        }
        flow = Flow::start(flow.release(), begin, &x, with)?;
        if horizon >= most {
            break;
        }
        horizon = (LONGER * horizon).min(most);
    }
    let orbit = steps(&mut flow, begin + options.longest.min(enough), options)?;
    Ok(kept(orbit, flow.time()))
}

/// The steps of a trial.
///
/// *Errors*: those of a motion that fails at once.
pub(super) fn steps<S: System + ?Sized>(flow: &mut Flow<'_, S>, end: f64, options: &Periodic<'_>) -> Result<Orbit, Fault> {
    let mut orbit = Orbit { first: flow.state().to_vec(), modes: [flow.modes().to_vec(), Vec::new()], ..Orbit::default() };
    while !flow.reached(end) && orbit.steps.len() < TRIAL && !interrupted(options) {
        if let Err(fault) = flow.advance(end) {
            // a motion that runs away shows scales before it does
            if orbit.steps.len() < 4 {
                return Err(fault);
            }
            break;
        }
        orbit.steps.push(flow.step().clone());
    }
    Ok(orbit)
}

/// The first half of a trial.
fn halved(mut orbit: Orbit, begin: f64, end: f64) -> Orbit {
    let half = begin + 0.5 * (end - begin);
    let kept = orbit.steps.iter().take_while(|s| s.end().high <= half).count();
    orbit.steps.truncate(kept.max(4));
    orbit.last = vec![0.0; orbit.first.len()];
    if let Some(step) = orbit.steps.last() {
        step.state_at(step.end().high, &mut orbit.last);
        orbit.modes[1] = step.modes.clone();
        orbit.period = step.end().high - begin;
    }
    orbit
}

/// How many times longer the next trial may last, where one has shown less than its steps: beside a time without end the limit at which something that is carried along begins to slide is
/// rounding.
const LONGER: f64 = 1e4;
/// Periods of a forced machine that a trial lasts at most; the first half of it counts.
const PERIODS: f64 = 4.0;
/// Share of its largest value while the motion settled, and of the largest scale of its unit, below which a state has no scale of its own: what has died away to
/// rounding still varies, and says nothing.
const FLOOR: f64 = 1e-9;

/// Follows the motion to the end of the time to settle. The largest magnitude of each state at the ends of its steps.
///
/// *Errors*: S010 where that would take more steps than anybody waits for.
pub(super) fn settle<S: System + ?Sized>(flow: &mut Flow<'_, S>, end: f64, options: &Periodic<'_>) -> Result<Vec<f64>, Fault> {
    let mut sizes: Vec<f64> = flow.state().iter().map(|x| x.abs()).collect();
    let mut doubled = Doubled::default();
    while !flow.reached(end) && !interrupted(options) {
        flow.advance(end)?;
        sizes.iter_mut().zip(flow.state()).for_each(|(size, x)| *size = size.max(x.abs()));
        options.listener.tell(Stage::Settling(flow.time(), end));
        let (steps, time) = (flow.work().steps as f64, flow.time());
        let needed = steps * (end / time);
        if steps > SAMPLE && needed > MOST {
            return Err(Fault::too_many_steps(&flow.fastest(), time, time / steps, needed));
        }
        if let Some((took, needed)) = doubled.look((flow.work().steps, time), (end, MOST)).filter(|_| !may_strike(flow.system())) {
            return Err(Fault::ever_more_steps(&flow.fastest(), time, took, needed));
        }
    }
    Ok(sizes)
}

/// Steps after which the time to settle is judged, and the most that it may take.
const SAMPLE: f64 = 1000.0;
const MOST: f64 = 1e9;

/// What the states vary by, at least `floor`.
pub(super) fn scales<S: System + ?Sized>(system: &S, orbit: &Orbit, frame: Option<&Vec<f64>>, floor: &[f64]) -> Vec<f64> {
    let n = system.n_coordinates();
    let still = vec![0.0; orbit.first.len()];
    let ranges = orbit.ranges(frame.unwrap_or(&still));
    let time = orbit.period.max(f64::MIN_POSITIVE);
    let (mut out, mut moves): (Vec<f64>, Vec<bool>) = (Vec::new(), Vec::new());
    for (i, &(range, size)) in ranges.iter().enumerate() {
        let is_rate = (n..2 * n).contains(&i);
        // a rate that moves its coordinate by no more than rounding is none
        let range = if is_rate && range * time <= RESTS * out[i - n] { 0.0 } else { range };
        let size = if range == 0.0 && is_rate && size * time <= RESTS * out[i - n] { 0.0 } else { size };
        let scale = match system.states()[i].unit.as_str() {
            "rad" => 1.0,
            // in step with its coordinate: entries of very different size cost the multipliers their digits
            _ if is_rate => {
                if range > 0.0 {
                    range.max(0.1 * size).max(0.1 * out[i - n] / time)
                } else {
                    0.1 * size
                }
            }
            // a coordinate that hardly moves has a thousandth of its place as its scale
            _ => range.max(1e-3 * size),
        };
        let resting = if is_rate { out[i - n] / time } else { 1.0 };
        moves.push(scale > 0.0);
        out.push(if scale > 0.0 { scale.max(floor.get(i).copied().unwrap_or(0.0)) } else { resting });
    }
    // a state whose regime is zero varies by rounding of the others
    let unit = |i: usize| system.states()[i].unit.as_str();
    let largest = |i: usize| (0..out.len()).filter(|&j| moves[j] && unit(j) == unit(i)).map(|j| out[j]).fold(0.0, f64::max);
    let least: Vec<f64> = (0..out.len()).map(|i| FLOOR * largest(i)).collect();
    out.iter_mut().zip(&least).for_each(|(scale, least)| *scale = scale.max(*least));
    out
}
