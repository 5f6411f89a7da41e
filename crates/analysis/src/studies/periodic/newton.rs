//! The search: a trial run that shows scales, translations and the section; then turns, corrected by Newton's method.

use super::fundamental::{self, Blur};
use super::listener::{Listener, Stage};
use super::orbit::{Limit, Orbit, Section, follow};
use super::rest::{self, Left};
use super::spectrum::Turn;
use super::symmetry::{self, Reach, Symmetry};
use super::{Periodic, Return, closure, driven, interrupted, no_return, unsettled};
use crate::dataset::Audit;
use crate::numerics::rank::Qr;
use crate::taylor::{Flow, Options};
use crate::{Fault, Mode, System};
use std::f64::consts::TAU;
use symbolic::Text;

/// Steps of the trial run.
const TRIAL: usize = 150;
/// Turns before the search is given up.
pub(super) const TURNS: usize = 100;
/// Misses above this share of the range are not corrected but followed.
const FAR: f64 = 0.3;
/// A miss below this is rounding; above `ENOUGH` it is no return.
const EXACT: f64 = 2e-15;
const ENOUGH: f64 = 1e-10;
/// Share of a column below which Newton's matrix counts as singular: a family of periodic motions.
const SINGULAR: f64 = 1e-9;
/// The same for a forced machine, which is singular only at resonance.
const RESONANT: f64 = 1e-12;
/// A far correction is kept where it leaves this share of the miss: the map of a linear machine is met at once.
const AFFINE: f64 = 1e-3;
/// Shares of the period by which a turn may be followed further to end behind a switch.
const BEHIND: [f64; 4] = [0.0, 1e-14, 1e-13, 1e-12];
/// Units of the last place of its terms to which a force is known.
const ROUNDED: f64 = 64.0;
/// Share of its scale by which a coordinate at rest may move within a turn.
const RESTS: f64 = 1e-13;
/// Parts of a period that are tried as the least one.
const PARTS: usize = 12;

/// A turn that closes.
pub(super) struct Found<'o> {
    pub(super) orbit: Orbit,
    scales: Vec<f64>,
    symmetry: Symmetry,
    /// Translations of the laws alone, whether the conditions allow them or not.
    loose: Symmetry,
    /// States that can be chosen freely; the others follow from the conditions.
    free: Vec<usize>,
    /// Change of all states per change of the free ones, column by column.
    basis: Vec<Vec<f64>>,
    angles: Vec<bool>,
    /// Whether the motion is far smaller than in the first turn.
    pub(super) shrunk: bool,
    /// Who listens.
    listener: Listener<'o>,
}

/// How far a correction may lead.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Stride {
    /// Half of the scales at most.
    Careful,
    /// As far as the linear map says.
    Full,
}

/// What the search knows before the first turn.
struct Search<'s, 'o> {
    options: &'s Periodic<'o>,
    flow: Options,
    scales: Vec<f64>,
    symmetry: Symmetry,
    loose: Symmetry,
    /// States that are the same after a whole turn.
    angles: Vec<bool>,
    sections: Vec<Section>,
    /// State that defines the section; none for a given period.
    state: Option<usize>,
    /// Scales of the first turn.
    whole: Vec<f64>,
    /// Whether the motion is far smaller than in the first turn.
    shrunk: bool,
    name: Text,
}

/// From a start to a turn that closes.
pub(super) fn solve<'o, S: System + ?Sized>(system: &mut S, start: &[f64], options: &Periodic<'o>) -> Result<Found<'o>, Fault> {
    let flow = Options { tolerance: options.tolerance, ..Options::default() };
    let trial = trial(system, start, options, &flow)?;
    if interrupted(options) {
        return Err(unsettled(1.0, 0));
    }
    let (mut search, mut x) = prepare(system, start, trial, options, flow)?;
    if search.state.is_none()
        && let Some(found) = at_once(system, &mut search, &x)?
    {
        return Ok(found);
    }
    let mut best: Option<(f64, Found<'o>)> = None;
    let (mut follow_only, mut last) = (0_usize, f64::INFINITY);
    // where the motion itself went, beside a start that Newton's method proposes
    let mut went: Option<Vec<f64>> = None;
    for turn in 0..TURNS {
        if interrupted(options) {
            break;
        }
        tidy(&mut x, &search.scales);
        search.aim(&x);
        let outcome = follow(system, &x, &search.sections, options.limit(), &search.flow);
        let by_proposal = went.take();
        let (orbit, which) = match (outcome, by_proposal.clone()) {
            (Ok(Some(found)), _) => found,
            // the proposal stands inside a wall, outside of a domain or where nothing returns: it fails, not the file
            (_, Some(turn)) => {
                (x, follow_only) = (turn, 3);
                search.aim(&x);
                continue;
            }
            (Ok(None), None) => return Err(no_return(&search.name, options)),
            (Err(fault), None) => return Err(fault),
        };
        // a turn and a return are alternatives: the first to happen is the section from now on
        search.sections = vec![search.sections[which]];
        if turn == 0 {
            search.scales = scales(system, &orbit, search.symmetry.frame.as_ref());
            search.whole.clone_from(&search.scales);
        }
        let left = search.left(system, &orbit);
        if left == Some(Left::Little) {
            // the gaps before were measured in other scales
            (best, last) = (None, f64::INFINITY);
        }
        let found = search.found(system, orbit)?;
        if left == Some(Left::Rest) {
            match by_proposal {
                // a jump to a place that the motion itself leaves
                Some(turn) if !rest::attracts(system, &found, options.seed) => {
                    (x, follow_only) = (turn, 3);
                    search.aim(&x);
                    continue;
                }
                _ => return Err(rest::at_rest()),
            }
        }
        let gap = found.gap();
        let miss = found.miss(&gap, search.state);
        options.listener.tell(Stage::Turned(turn + 1, miss));
        let better = best.as_ref().is_none_or(|(least, _)| miss < *least);
        let settled = miss <= EXACT || (best.as_ref().is_some_and(|(least, _)| *least <= ENOUGH) && miss > 0.5 * last);
        let next_turn = found.next_start(&gap);
        let correct = miss <= FAR && follow_only == 0 && !settled;
        follow_only = follow_only.saturating_sub(1);
        if !better && miss > 2.0 * last && miss > ENOUGH {
            // the correction led away: a few turns instead
            follow_only = 3;
        }
        last = miss;
        let step = match correct.then(|| found.correction(system, &gap, search.state, Stride::Careful)) {
            // without a derivative the turns are followed
            Some(Err(fault)) if fault.code == "S054" || fault.code == "S055" => None,
            Some(step) => step?,
            None => None,
        };
        x = match step.and_then(|step| moved(system, &found, &step).ok()) {
            Some(proposed) => {
                went = Some(next_turn);
                proposed
            }
            None => next_turn,
        };
        search.aim(&x);
        if better {
            best = Some((miss, found));
        }
        if settled {
            break;
        }
    }
    match best {
        Some((miss, found)) if miss <= ENOUGH => Ok(found),
        Some((miss, _)) => Err(unsettled(miss, TURNS)),
        None => Err(unsettled(1.0, 0)),
    }
}

/// What a turn or a correction has left of a zero. A start on a switch (a dead centre, where the sliding turns) is on it exactly: the motion then decides on
/// which side it goes on, and not the sign of the rounding.
fn tidy(x: &mut [f64], scales: &[f64]) {
    x.iter_mut().zip(scales).filter(|(x, s)| x.abs() <= TIDY * **s).for_each(|(x, _)| *x = 0.0);
}

/// Share of its scale below which a state at the start of a turn is zero.
const TIDY: f64 = 1e-13;

/// The start of a turn after a correction.
fn moved<S: System + ?Sized>(system: &mut S, found: &Found<'_>, step: &[f64]) -> Result<Vec<f64>, Fault> {
    let mut x: Vec<f64> = found.orbit.first.iter().zip(step).map(|(x, d)| x + d).collect();
    system.project(0.0, &mut x, &found.orbit.modes[0])?;
    Ok(x)
}

/// Newton's step of full length from wherever the start is: a linear machine closes at once, however little damping it has. Where the machine is not
/// linear the step is forgotten, for it may lead to another regime than the motion does.
fn at_once<'o, S: System + ?Sized>(system: &mut S, search: &mut Search<'_, 'o>, x: &[f64]) -> Result<Option<Found<'o>>, Fault> {
    let (sections, limit) = (search.sections.clone(), search.options.limit());
    let Some((orbit, _)) = follow(system, x, &sections, limit, &search.flow)? else { return Ok(None) };
    let before = search.scales.clone();
    search.scales = scales(system, &orbit, None);
    let mut found = search.found(system, orbit)?;
    let mut miss = found.miss(&found.gap(), None);
    for step in 0..3 {
        if miss <= EXACT {
            return Ok(Some(found));
        }
        // where the motion cannot be varied from here, it is followed
        let Ok(Some(change)) = found.correction(system, &found.gap(), None, Stride::Full) else { break };
        let Ok(next) = moved(system, &found, &change) else { break };
        let Ok(Some((orbit, _))) = follow(system, &next, &sections, limit, &search.flow) else { break };
        // the gap is compared in the scales of the first turn, and counts in those of the last
        let now = search.found(system, orbit)?;
        let left = now.miss(&now.gap(), None);
        if step == 0 && left > AFFINE * miss {
            break;
        }
        let scales = scales(system, &now.orbit, None);
        let wider = Found { scales, ..now };
        let left = wider.miss(&wider.gap(), None);
        if step > 0 && left >= 0.5 * miss {
            break;
        }
        (found, miss) = (wider, left);
        search.scales.clone_from(&found.scales);
    }
    if miss <= ENOUGH {
        return Ok(Some(found));
    }
    search.scales = before;
    Ok(None)
}

/// Some steps after the time to settle. Only the first half counts, for the run may have ended before a singular place.
fn trial<S: System + ?Sized>(system: &mut S, start: &[f64], options: &Periodic<'_>, with: &Options) -> Result<Orbit, Fault> {
    let mut flow = Flow::start(system, 0.0, start, with)?;
    settle(&mut flow, options.settle, options)?;
    let begin = flow.time();
    let mut orbit = Orbit { first: flow.state().to_vec(), modes: [flow.modes().to_vec(), Vec::new()], ..Orbit::default() };
    let end = begin + options.longest;
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
    let half = begin + 0.5 * (flow.time() - begin);
    let kept = orbit.steps.iter().take_while(|s| s.end().high <= half).count();
    orbit.steps.truncate(kept.max(4));
    orbit.last = vec![0.0; start.len()];
    if let Some(step) = orbit.steps.last() {
        step.state_at(step.end().high, &mut orbit.last);
        orbit.modes[1] = step.modes.clone();
        orbit.period = step.end().high - begin;
    }
    Ok(orbit)
}

/// Follows the motion to the end of the time to settle.
///
/// *Errors*: S010 where that would take more steps than anybody waits for.
fn settle<S: System + ?Sized>(flow: &mut Flow<'_, S>, end: f64, options: &Periodic<'_>) -> Result<(), Fault> {
    while !flow.reached(end) && !interrupted(options) {
        flow.advance(end)?;
        options.listener.tell(Stage::Settling(flow.time(), end));
        let (steps, time) = (flow.work().steps as f64, flow.time());
        let needed = steps * (end / time);
        if steps > SAMPLE && needed > MOST {
            return Err(Fault::too_many_steps(&flow.fastest(), time, time / steps, needed));
        }
    }
    Ok(())
}

/// Steps after which the time to settle is judged, and the most that it may take.
const SAMPLE: f64 = 1000.0;
const MOST: f64 = 1e9;

/// What the states vary by.
fn scales<S: System + ?Sized>(system: &S, orbit: &Orbit, frame: Option<&Vec<f64>>) -> Vec<f64> {
    let n = system.n_coordinates();
    let still = vec![0.0; orbit.first.len()];
    let ranges = orbit.ranges(frame.unwrap_or(&still));
    let time = orbit.period.max(f64::MIN_POSITIVE);
    let mut out: Vec<f64> = Vec::new();
    for (i, &(range, size)) in ranges.iter().enumerate() {
        let is_rate = (n..2 * n).contains(&i);
        // a rate that moves its coordinate by no more than rounding is none
        let range = if is_rate && range * time <= RESTS * out[i - n] { 0.0 } else { range };
        let size = if range == 0.0 && is_rate && size * time <= RESTS * out[i - n] { 0.0 } else { size };
        let scale = match system.states()[i].unit.as_str() {
            "rad" => 1.0,
            _ if is_rate => range.max(0.1 * size),
            _ => range.max(1e-3 * size),
        };
        let resting = if is_rate { out[i - n] / time } else { 1.0 };
        out.push(if scale > 0.0 { scale } else { resting });
    }
    out
}

fn prepare<'s, 'o, S: System + ?Sized>(
    system: &mut S,
    start: &[f64],
    mut trial: Orbit,
    options: &'s Periodic<'o>,
    flow: Options,
) -> Result<(Search<'s, 'o>, Vec<f64>), Fault> {
    let elapsed = trial.period;
    // about a radian a step
    trial.period = elapsed.min(6.0 * elapsed / trial.steps.len().max(1) as f64).max(f64::MIN_POSITIVE);
    let first_scales = scales(system, &trial, None);
    let named = match &options.by {
        Return::State(name) => Some(state_named(system, name)?),
        _ => None,
    };
    let symmetry = symmetry::find(system, &trial, &first_scales, named, Reach::Possible)?;
    let loose = symmetry::find(system, &trial, &first_scales, named, Reach::Any)?;
    let scales = scales(system, &trial, symmetry.frame.as_ref());
    let angles = angles(system, &trial, &scales)?;
    let mut search = Search {
        options,
        flow: Options { span: trial.period, ..flow },
        scales,
        symmetry,
        loose,
        angles,
        sections: Vec::new(),
        state: None,
        whole: Vec::new(),
        shrunk: false,
        name: Text::default(),
    };
    let mut x = trial.first.clone();
    if let (Some(frame), true) = (&search.symmetry.frame, options.settle > 0.0) {
        // the same motion at t = 0
        x.iter_mut().zip(frame).for_each(|(x, v)| *x -= v * options.settle);
    }
    let rests = search.symmetry.frame.as_ref().is_some_and(|frame| still(&trial, frame, &search.scales));
    if let (true, Return::Period(_)) = (rests, &options.by) {
        // a machine at rest repeats after any time: the one that is given
        search.symmetry.frame = None;
        search.symmetry.shifts = Vec::new();
    }
    match (&search.symmetry.frame, &options.by) {
        (None, Return::Period(period)) => {
            if !symmetry::repeats(system, &trial, *period, &search.scales)? {
                return Err(driven(Some(*period)));
            }
            if options.settle > 0.0 {
                x = settled_phase(system, start, *period, options, &search.flow)?;
            }
            search.sections = vec![Section::Time(*period * options.returns as f64)];
            search.name = Text::new("the motion", "движение");
        }
        (None, _) => return Err(driven(None)),
        (Some(frame), _) => {
            let state = named.map_or_else(|| search.automatic(system, &trial, &x), Ok)?;
            let frame = frame.clone();
            search.state = Some(state);
            search.name = Text::same(format!("`{}`", system.states()[state].name));
            x = transversal(system, &trial, x, state, &frame, &search)?;
            search.aim_first(system, &x, &frame)?;
            if options.settle > 0.0 && named.is_some() {
                x = search.in_phase(system, x, start)?;
            }
            search.take_turns_off(&mut x);
            search.aim(&x);
        }
    }
    Ok((search, x))
}

/// Whether nothing moves in a frame.
fn still(trial: &Orbit, frame: &[f64], scales: &[f64]) -> bool {
    let moves = |s: &crate::taylor::Step, i: usize| (s.coefficients(i)[1] - frame[i]).abs() * trial.period > 1e-9 * scales[i];
    trial.steps.iter().all(|s| (0..scales.len()).all(|i| !moves(s, i)))
}

/// The state after whole periods of the forcing, as if at t = 0.
fn settled_phase<S: System + ?Sized>(
    system: &mut S,
    start: &[f64],
    period: f64,
    options: &Periodic<'_>,
    with: &Options,
) -> Result<Vec<f64>, Fault> {
    let whole = (options.settle / period).ceil() * period;
    let mut flow = Flow::start(system, 0.0, start, with)?;
    settle(&mut flow, whole, options)?;
    Ok(flow.state().to_vec())
}

fn state_named<S: System + ?Sized>(system: &S, name: &str) -> Result<usize, Fault> {
    let known: Vec<String> = system.states().iter().map(|q| q.name.clone()).collect();
    known.iter().position(|n| n == name).ok_or_else(|| Fault::unknown_output(name, &known))
}

/// Which coordinates and auxiliary states are angles that the laws know up to whole turns.
fn angles<S: System + ?Sized>(system: &mut S, trial: &Orbit, scales: &[f64]) -> Result<Vec<bool>, Fault> {
    let n = system.n_coordinates();
    let mut out = Vec::new();
    for i in 0..trial.first.len() {
        let is_angle = !(n..2 * n).contains(&i) && system.states()[i].unit == "rad";
        out.push(is_angle && symmetry::turns(system, trial, i, scales)?);
    }
    Ok(out)
}

/// A place of the motion at which the section's state really moves.
fn transversal<S: System + ?Sized>(
    system: &mut S,
    trial: &Orbit,
    x: Vec<f64>,
    state: usize,
    frame: &[f64],
    search: &Search<'_, '_>,
) -> Result<Vec<f64>, Fault> {
    let speed = |c: &[f64]| (c[1] - frame[state]).abs();
    let fastest = trial.steps.iter().map(|s| speed(s.coefficients(state))).fold(0.0, f64::max);
    let modes = Flow::start(system, 0.0, &x, &search.flow)?.modes().to_vec();
    let own = (fundamental::rates(system, 0.0, &x, &modes)?[state] - frame[state]).abs();
    if own > 1e-3 * fastest || fastest == 0.0 {
        return Ok(x);
    }
    let moving = trial.steps.iter().find(|s| speed(s.coefficients(state)) > 0.3 * fastest);
    let Some(step) = moving else { return Ok(x) };
    let t = step.start.high;
    Ok((0..x.len()).map(|i| step.start_value(i) - frame[i] * t).collect())
}

impl<'o> Search<'_, 'o> {
    /// An angle that turns, otherwise the state that moves most in its scale.
    fn automatic<S: System + ?Sized>(&self, system: &mut S, trial: &Orbit, x: &[f64]) -> Result<usize, Fault> {
        let still = vec![0.0; x.len()];
        let frame = self.symmetry.frame.as_ref().unwrap_or(&still);
        let ranges = trial.ranges(frame);
        let shifted = |i: usize| self.symmetry.shifts.iter().any(|(p, _)| *p == i);
        let turning = |i: &usize| self.angles[*i] && ranges[*i].0 > TAU;
        if let Some(i) = (0..system.n_coordinates()).find(|i| turning(i) && !shifted(*i)) {
            return Ok(i);
        }
        let modes = Flow::start(system, 0.0, x, &self.flow)?.modes().to_vec();
        let rates = fundamental::rates(system, 0.0, x, &modes)?;
        let speed = |i: usize| if shifted(i) { -1.0 } else { (rates[i] - frame[i]).abs() / self.scales[i] };
        let n = system.n_coordinates();
        let best = |range: &mut dyn Iterator<Item = usize>| range.max_by(|&a, &b| speed(a).total_cmp(&speed(b)));
        // a coordinate unless it turns just here: a rate may stand still for a while where something sticks
        let usual = |i: usize| trial.steps.iter().map(|s| (s.coefficients(i)[1] - frame[i]).abs()).fold(0.0, f64::max) / self.scales[i];
        let moving = best(&mut (0..n).chain(2 * n..x.len())).filter(|&i| speed(i) > 0.02 * usual(i) && speed(i) > 0.0);
        // an angle that the laws do not feel brings nothing back unless nothing else moves
        let free = || (0..n).find(turning);
        Ok(moving.or_else(free).or_else(|| best(&mut (0..x.len()))).unwrap_or(0))
    }

    /// The sections through x: the same value again in the same direction, or a turn further.
    fn aim_first<S: System + ?Sized>(&mut self, system: &mut S, x: &[f64], frame: &[f64]) -> Result<(), Fault> {
        let Some(state) = self.state else { return Ok(()) };
        let modes = Flow::start(system, 0.0, x, &self.flow)?.modes().to_vec();
        let speed = fundamental::rates(system, 0.0, x, &modes)?[state] - frame[state];
        let sign = if speed < 0.0 { -1.0 } else { 1.0 };
        let drift = frame[state];
        let count = self.options.returns.max(1);
        self.sections = vec![Section::Level { state, level: x[state], drift, sign, count, turn: 0.0 }];
        if self.angles[state] {
            let turn = sign * TAU * count as f64;
            self.sections.push(Section::Level { state, level: x[state] + turn, drift, sign, count: 1, turn });
        }
        Ok(())
    }

    /// The next state in which the section's angle is what it is at the start of the file, whole turns apart.
    fn in_phase<S: System + ?Sized>(&self, system: &mut S, x: Vec<f64>, start: &[f64]) -> Result<Vec<f64>, Fault> {
        let Some(state) = self.state.filter(|&i| self.angles[i] && self.symmetry.frame.as_ref().is_some_and(|f| f[i] == 0.0)) else {
            return Ok(x);
        };
        let Some(Section::Level { sign, .. }) = self.sections.first() else { return Ok(x) };
        let ahead = (sign * (start[state] - x[state])).rem_euclid(TAU);
        let level = x[state] + sign * ahead;
        let section = Section::Level { state, level, drift: 0.0, sign: *sign, count: 1, turn: 0.0 };
        match follow(system, &x, &[section], self.options.limit(), &self.flow)? {
            Some((mut orbit, _)) if ahead > 0.0 => {
                orbit.last[state] = level;
                Ok(orbit.last)
            }
            _ => Ok(x),
        }
    }

    /// Angles lose the whole turns that they made while the motion settled, and with them no digits.
    fn take_turns_off(&self, x: &mut [f64]) {
        let turns = self.angles.iter().zip(x).filter(|(angle, x)| **angle && x.abs() > 2.0 * TAU);
        turns.for_each(|(_, x)| *x -= TAU * (*x / TAU).round());
    }

    /// What is left of the motion; where little is, it gets scales of its own. None in a given period: a place of rest is a regime of that period.
    fn left<S: System + ?Sized>(&mut self, system: &S, orbit: &Orbit) -> Option<Left> {
        self.state?;
        if rest::left(orbit, &self.whole) == Left::Rest {
            return Some(Left::Rest);
        }
        let left = rest::left(orbit, &self.scales);
        if left != Left::Motion {
            self.shrunk = true;
            self.scales = scales(system, orbit, self.symmetry.frame.as_ref());
            return Some(Left::Little);
        }
        Some(left)
    }

    /// Moves the sections through the next start.
    fn aim(&mut self, x: &[f64]) {
        for section in &mut self.sections {
            if let Section::Level { state, level, turn, .. } = section {
                *level = x[*state] + *turn;
            }
        }
    }

    fn found<S: System + ?Sized>(&self, system: &mut S, orbit: Orbit) -> Result<Found<'o>, Fault> {
        let (free, basis) = tangent(system, &orbit.first, &orbit.modes[0], &self.scales, self.state, &self.symmetry)?;
        Ok(Found {
            orbit,
            scales: self.scales.clone(),
            symmetry: self.symmetry.clone(),
            loose: self.loose.clone(),
            free,
            basis,
            angles: self.angles.clone(),
            shrunk: self.shrunk,
            listener: self.options.listener,
        })
    }
}

/// States that can be chosen freely under the conditions, and the change of all states with each of them.
fn tangent<S: System + ?Sized>(
    system: &mut S,
    x: &[f64],
    modes: &[Mode],
    scales: &[f64],
    first: Option<usize>,
    symmetry: &Symmetry,
) -> Result<(Vec<usize>, Vec<Vec<f64>>), Fault> {
    let n = x.len();
    let rows = fundamental::derivative(x, scales, |place| {
        let mut place = place.to_vec();
        system.project(0.0, &mut place, modes)?;
        Ok(place)
    })?;
    // scaled: entry (i, j) is the change of state i in its scale for a change of state j in its scale
    let p: Vec<f64> = (0..n * n).map(|k| rows[k / n][k % n] * scales[k % n] / scales[k / n]).collect();
    let weight = |i: usize| match first {
        Some(state) if state == i => 1e3,
        _ if symmetry.shifts.iter().any(|(pivot, _)| *pivot == i) => 1e2,
        _ => 1.0,
    };
    let transposed: Vec<f64> = (0..n * n).map(|k| p[(k % n) * n + k / n] * weight(k % n)).collect();
    let mut free = Qr::new(n, n, &transposed, 1e-9).independent().to_vec();
    free.sort_unstable();
    let columns = Qr::new(n, n, &p, 1e-7).independent().to_vec();
    let r = free.len().min(columns.len());
    free.truncate(r);
    // B = P_columns (P_free,columns)^-1
    let square: Vec<f64> = free.iter().flat_map(|&i| columns[..r].iter().map(move |&j| (i, j))).map(|(i, j)| p[i * n + j]).collect();
    let qr = Qr::new(r, r, &square, 1e-12);
    let mut basis = Vec::with_capacity(r);
    for k in 0..r {
        let unit: Vec<f64> = (0..r).map(|i| if i == k { 1.0 } else { 0.0 }).collect();
        let c = qr.least_squares(&unit).0;
        let size = scales[free[k]];
        let column: Vec<f64> =
            (0..n).map(|i| c.iter().zip(&columns).map(|(c, &j)| c * p[i * n + j]).sum::<f64>() * scales[i] / size).collect();
        basis.push(column);
    }
    Ok((free, basis))
}

impl Found<'_> {
    /// The state as it would be at t = 0, had the motion begun earlier.
    pub(super) fn at_time_zero(&self, (t, mut x): (f64, Vec<f64>)) -> Vec<f64> {
        if let Some(frame) = &self.symmetry.frame {
            x.iter_mut().zip(frame).for_each(|(x, v)| *x -= v * t);
        }
        x
    }

    /// last - first less drift and whole turns, the shifts taken out.
    fn gap(&self) -> Vec<f64> {
        let mut gap = self.raw_gap();
        clear_shifts(&self.symmetry, &mut gap);
        gap
    }

    fn raw_gap(&self) -> Vec<f64> {
        let frame = self.symmetry.frame.as_deref();
        let period = self.orbit.period;
        (0..self.orbit.first.len())
            .map(|i| {
                let change = self.orbit.last[i] - self.orbit.first[i] - frame.map_or(0.0, |f| f[i] * period);
                if self.angles[i] { change - TAU * (change / TAU).round() } else { change }
            })
            .collect()
    }

    /// States that have to come back: free, not the section's, not translations.
    pub(super) fn returning(&self, section: Option<usize>) -> Vec<usize> {
        let pivot = |i: usize| self.symmetry.shifts.iter().any(|(p, _)| *p == i);
        self.free.iter().copied().filter(|&i| Some(i) != section && !pivot(i)).collect()
    }

    /// Largest gap in scales.
    fn miss(&self, gap: &[f64], section: Option<usize>) -> f64 {
        self.returning(section).iter().map(|&i| gap[i].abs() / self.scales[i]).fold(0.0, f64::max)
    }

    /// The end of the turn, as the start of another one.
    fn next_start(&self, gap: &[f64]) -> Vec<f64> {
        self.orbit.first.iter().zip(gap).map(|(x, g)| x + g).collect()
    }

    /// Rates at the end in the moving frame.
    fn flow_at_end<S: System + ?Sized>(&self, system: &mut S) -> Result<Vec<f64>, Fault> {
        let mut rates = fundamental::rates(system, self.orbit.period, &self.orbit.last, &self.orbit.modes[1])?;
        if let Some(frame) = &self.symmetry.frame {
            rates.iter_mut().zip(frame).for_each(|(r, v)| *r -= v);
        }
        Ok(rates)
    }

    /// Newton's step of the start; none when nothing has to return.
    fn correction<S: System + ?Sized>(
        &self,
        system: &mut S,
        gap: &[f64],
        section: Option<usize>,
        reach: Stride,
    ) -> Result<Option<Vec<f64>>, Fault> {
        let returning = self.returning(section);
        if returning.is_empty() {
            return Ok(None);
        }
        let matrix = fundamental::of_orbit(system, &self.orbit, &self.scales, self.listener)?.matrix;
        let rates = self.flow_at_end(system)?;
        let m = returning.len();
        let mut square = vec![0.0; m * m];
        for (column, &j) in returning.iter().enumerate() {
            let k = self.free.iter().position(|&i| i == j).unwrap_or(0);
            let mut change = matrix.apply(&self.basis[k]);
            if let Some(s) = section {
                let later = -change[s] / rates[s];
                change.iter_mut().zip(&rates).for_each(|(c, r)| *c += r * later);
            }
            clear_shifts(&self.symmetry, &mut change);
            for (row, &i) in returning.iter().enumerate() {
                let unit = if i == j { 1.0 } else { 0.0 };
                square[row * m + column] = (change[i] - unit) * self.scales[j] / self.scales[i];
            }
        }
        let right: Vec<f64> = returning.iter().map(|&i| -gap[i] / self.scales[i]).collect();
        let singular = if self.symmetry.frame.is_some() { SINGULAR } else { RESONANT };
        let (y, _) = Qr::new(m, m, &square, singular).least_squares(&right);
        let largest = y.iter().fold(0.0_f64, |l, v| l.max(v.abs()));
        if !largest.is_finite() {
            return Ok(None);
        }
        let damping = if reach == Stride::Careful && largest > 0.5 { 0.5 / largest } else { 1.0 };
        let mut step = vec![0.0; gap.len()];
        for (y, &j) in y.iter().zip(&returning) {
            let k = self.free.iter().position(|&i| i == j).unwrap_or(0);
            step.iter_mut().zip(&self.basis[k]).for_each(|(s, b)| *s += damping * y * self.scales[j] * b);
        }
        Ok(Some(step))
    }

    /// What the turn does to small changes of the states that have to come back, in scales, and what leaves that undefined.
    pub(super) fn turn<S: System + ?Sized>(&self, system: &mut S) -> Result<(Turn, Blur), Fault> {
        let whole = fundamental::of_orbit(system, &self.orbit, &self.scales, self.listener)?;
        let states = self.returning(None);
        let n = states.len();
        let mut matrix = vec![0.0; n * n];
        for (column, &j) in states.iter().enumerate() {
            let k = self.free.iter().position(|&i| i == j).unwrap_or(0);
            let mut change = whole.matrix.apply(&self.basis[k]);
            clear_shifts(&self.symmetry, &mut change);
            // in scales: eigenvalues are the same, rounding is not
            states.iter().enumerate().for_each(|(row, &i)| matrix[row * n + column] = change[i] * self.scales[j] / self.scales[i]);
        }
        let flow = self.flow_at_start(system)?;
        // what connections or translations take out has no part in the matrix, but in the determinant
        let log_determinant = whole.log_determinant.filter(|_| n == self.orbit.first.len());
        let loses_one = whole.singular && n == self.orbit.first.len();
        Ok((Turn { n, matrix, flow, log_determinant, loses_one, liouville: whole.liouville, doubt: whole.doubt }, whole.blur))
    }

    /// Rates at the start of the states that have to come back, in the moving frame and in scales; none when time is not free or nothing moves in it.
    fn flow_at_start<S: System + ?Sized>(&self, system: &mut S) -> Result<Option<Vec<f64>>, Fault> {
        let Some(frame) = &self.symmetry.frame else { return Ok(None) };
        let mut rates = fundamental::rates(system, 0.0, &self.orbit.first, &self.orbit.modes[0])?;
        rates.iter_mut().zip(frame).for_each(|(r, v)| *r -= v);
        clear_shifts(&self.symmetry, &mut rates);
        let flow: Vec<f64> = self.returning(None).iter().map(|&i| rates[i] * self.orbit.period / self.scales[i]).collect();
        Ok(flow.iter().any(|f| f.abs() > 1e-9).then_some(flow))
    }

    /// How many times a period of this turn holds the least one, and how many times the forces repeat in it.
    pub(super) fn repeats<S: System + ?Sized>(&self, system: &mut S) -> Result<(usize, usize), Fault> {
        let (mut motion, mut forces) = (1, 1);
        if self.symmetry.frame.is_some() && self.flow_at_start(system)?.is_none() {
            return Ok((1, 1));
        }
        for k in 2..=PARTS {
            let part = self.orbit.period / k as f64;
            let laws = match &self.symmetry.frame {
                Some(_) => false,
                None => symmetry::repeats(system, &self.orbit, part, &self.scales)?,
            };
            if laws {
                forces = k;
            }
            if (laws || self.symmetry.frame.is_some()) && self.comes_back_after(part) {
                motion = k;
            }
        }
        Ok((motion, forces))
    }

    /// Whether the state at that instant is the one at the start.
    fn comes_back_after(&self, t: f64) -> bool {
        let frame = self.symmetry.frame.as_deref();
        let mut gap: Vec<f64> = self.orbit.state_at(t).iter().zip(&self.orbit.first).map(|(a, b)| a - b).collect();
        for (i, gap) in gap.iter_mut().enumerate() {
            *gap -= frame.map_or(0.0, |f| f[i] * t);
            if self.angles[i] {
                *gap -= TAU * (*gap / TAU).round();
            }
        }
        clear_shifts(&self.symmetry, &mut gap);
        self.miss(&gap, None) < 1e-8
    }

    /// Whether time occurs in the equations.
    pub(super) fn is_driven(&self) -> bool {
        self.symmetry.frame.is_none()
    }

    /// The same motion followed for one period from another of its states.
    pub(super) fn shifted<S: System + ?Sized>(self, system: &mut S, x: &[f64], options: &Periodic<'_>) -> Result<Self, Fault> {
        let flow = Options { tolerance: options.tolerance, ..Options::default() };
        let period = self.orbit.period;
        let mut ended: Option<Orbit> = None;
        // a start on a switch is behind it; so must the end be, which rounding may have put before it
        for late in BEHIND {
            let end = period * (1.0 + late);
            let limit = Limit { time: end, listener: options.listener };
            let Some((orbit, _)) = follow(system, x, &[Section::Time(end)], limit, &flow)? else { break };
            let same = orbit.modes[0] == orbit.modes[1];
            if same || ended.is_none() {
                ended = Some(orbit);
            }
            if same {
                break;
            }
        }
        let orbit = ended.ok_or_else(|| unsettled(1.0, 1))?;
        let (free, basis) = tangent(system, &orbit.first, &orbit.modes[0], &self.scales, None, &self.symmetry)?;
        Ok(Found { orbit, free, basis, ..self })
    }

    /// Largest difference of the start from another state, in scales.
    pub(super) fn away_from(&self, x: &[f64]) -> f64 {
        self.orbit.first.iter().zip(x).zip(&self.scales).map(|((a, b), s)| ((a - b) / s).abs()).fold(0.0, f64::max)
    }

    /// The check that all states and their rates come back.
    pub(super) fn closure<S: System + ?Sized>(&self, system: &mut S) -> Result<Audit, Fault> {
        let mut gap = self.raw_gap();
        // what follows from the free states may have gone on, where the laws do not feel it
        clear_shifts(&self.loose, &mut gap);
        let n = system.n_coordinates();
        let places = gap.iter().zip(&self.scales).map(|(g, s)| (g / s).abs()).fold(0.0, f64::max);
        let first = fundamental::rates(system, 0.0, &self.orbit.first, &self.orbit.modes[0])?;
        let last = fundamental::rates(system, self.orbit.period, &self.orbit.last, &self.orbit.modes[1])?;
        let size = (n..2 * n).map(|i| self.scales[i] / self.orbit.period * TAU + first[i].abs());
        // forces that cancel are known to the rounding of their terms
        let mut slopes = Vec::new();
        let known = fundamental::slopes(system, 0.0, &self.orbit.first, &self.orbit.modes[0], &self.scales, &mut slopes).is_ok();
        let width = self.orbit.first.len() + 1;
        let terms = |i: usize| -> f64 { slopes[i * width..].iter().zip(&self.orbit.first).map(|(a, x)| (a * x).abs()).sum() };
        let rounding = |i: usize| if known && terms(i).is_finite() { ROUNDED * f64::EPSILON * terms(i) } else { 0.0 };
        let off = |i: usize| ((last[i] - first[i]).abs() - rounding(i)).max(0.0);
        let rates = (n..2 * n).zip(size).map(|(i, s)| off(i) / s).fold(0.0, f64::max);
        // in modes that differ (a start on a switch) the accelerations need not agree
        let same = self.orbit.modes[0] == self.orbit.modes[1];
        Ok(closure(if same { places.max(rates) } else { places }))
    }
}

/// Takes the translations out of a change.
fn clear_shifts(symmetry: &Symmetry, change: &mut [f64]) {
    for (pivot, shift) in &symmetry.shifts {
        let amount = change[*pivot];
        change.iter_mut().zip(shift).for_each(|(c, s)| *c -= amount * s);
    }
}
