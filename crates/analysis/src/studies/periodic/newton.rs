//! The search: a trial run that shows scales, translations and the section; then turns, corrected by Newton's method.

use super::faults::{driven, interrupted, no_return, unsettled};
use super::found::{Found, Stride, beside_others, tangent};
use super::fundamental;
use super::listener::Stage;
use super::options::{Periodic, Return};
use super::orbit::{Orbit, Section, follow};
use super::own::{CLOSES, Plain};
use super::rest::{self, Left};
use super::symmetry::{self, Reach, Symmetry};
use super::turns::{self, Known, Turns};
use crate::integrate::taylor::{Flow, Options};
use crate::studies::simulate::Grid;
use crate::{Fault, System};
use words::Text;

/// Steps of the trial run.
const TRIAL: usize = 150;
/// Turns before the search is given up.
pub(super) const TURNS: usize = 100;
/// Misses above this share of the range are not corrected but followed.
const FAR: f64 = 0.3;
/// A miss below this is rounding: a few units in the last place of a state of size 1.
const EXACT: f64 = 2e-15;
/// A miss above this is no return; the audit `closure` allows as much.
pub(super) const ENOUGH: f64 = 1e-10;
/// A far correction is kept where it leaves this share of the miss: the map of a linear machine is met at once.
const AFFINE: f64 = 1e-3;
/// Share of its scale by which a coordinate at rest may move within a turn.
const RESTS: f64 = 1e-13;

/// What the search knows before the first turn.
pub(super) struct Search<'s, 'o> {
    pub(super) options: &'s Periodic<'o>,
    pub(super) flow: Options,
    pub(super) scales: Vec<f64>,
    pub(super) symmetry: Symmetry,
    loose: Symmetry,
    /// Whole turns that the laws do not feel.
    turns: Turns,
    /// Velocities of the angles that turn with the forcing.
    pub(super) carried: Vec<f64>,
    pub(super) sections: Vec<Section>,
    /// State that defines the section; none for a given period.
    pub(super) state: Option<usize>,
    /// Scales of the first turn.
    whole: Vec<f64>,
    /// Least scales.
    pub(super) floor: Vec<f64>,
    /// Whether the motion is far smaller than in the first turn.
    shrunk: bool,
    name: Text,
}

/// From a start to a turn that closes.
pub(super) fn solve<'o, S: System + ?Sized>(system: &mut S, start: &[f64], options: &Periodic<'o>) -> Result<Found<'o>, Fault> {
    let (slow, tried) = opened(system, start, options)?;
    if interrupted(options) {
        return Err(unsettled(1.0, 0));
    }
    let options = &slow;
    let (mut search, x) = prepare(system, start, tried, options)?;
    if search.state.is_none()
        && let Some(found) = at_once(system, &mut search, &x)?
    {
        return Ok(found);
    }
    let mut turns =
        Attempts { x, best: None, follow_only: 0, last: f64::INFINITY, patience: Patience::default(), went: None, plain: Plain::None };
    for turn in 0..TURNS {
        if interrupted(options) || turns.turn(system, &mut search, turn)? == Settled::Yes {
            break;
        }
    }
    match turns.best {
        Some((miss, found)) if miss <= ENOUGH => Ok(turns.plain.or(system, found, options.seed)),
        Some((miss, _)) => Err(unsettled(miss, TURNS)),
        None => Err(unsettled(1.0, 0)),
    }
}

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

fn flow(options: &Periodic<'_>) -> Options {
    Options { tolerance: options.tolerance, ..Options::default() }
}

/// The turns that a search has tried.
struct Attempts<'o> {
    /// Where the next one starts.
    x: Vec<f64>,
    /// The best so far with its miss.
    best: Option<(f64, Found<'o>)>,
    /// Turns that are followed without a correction.
    follow_only: usize,
    /// Miss of the last one.
    last: f64,
    patience: Patience,
    /// Where the motion itself went, beside a start that Newton's method proposes.
    went: Option<Vec<f64>>,
    /// A turn of the motion from the given start that closes.
    plain: Plain<'o>,
}

/// Whether a search is at its end.
#[derive(PartialEq)]
enum Settled {
    Yes,
    No,
}

impl<'o> Attempts<'o> {
    /// One turn, and where the next one starts.
    fn turn<S: System + ?Sized>(&mut self, system: &mut S, search: &mut Search<'_, 'o>, turn: usize) -> Result<Settled, Fault> {
        let options = search.options;
        tidy(&mut self.x, &search.scales);
        search.aim(&self.x);
        let outcome = follow(system, &self.x, &search.sections, options.limit(), &search.flow);
        let by_proposal = self.went.take();
        let (orbit, which) = match (outcome, by_proposal.clone()) {
            (Ok(Some(found)), _) => found,
            // the proposal stands inside a wall, outside of a domain or where nothing returns: it fails, not the file
            (_, Some(turn)) => return Ok(self.back(search, turn)),
            (Ok(None), None) => return Err(no_return(&search.name, options)),
            (Err(fault), None) => return Err(fault),
        };
        // a turn and a return are alternatives: the first to happen is the section from now on
        search.sections = vec![search.sections[which]];
        if turn == 0 {
            search.scales = scales(system, &orbit, search.symmetry.frame.as_ref(), &search.floor);
            search.whole.clone_from(&search.scales);
        }
        let left = search.left(system, &orbit);
        if left == Some(Left::Little) {
            // the gaps before were measured in other scales
            (self.best, self.last) = (None, f64::INFINITY);
        }
        let found = search.found(system, orbit)?;
        if left == Some(Left::Rest) {
            return match by_proposal {
                // a jump to a place that the motion itself leaves
                Some(turn) if !rest::attracts(system, &found, options.seed) => Ok(self.back(search, turn)),
                _ => Err(rest::at_rest()),
            };
        }
        let gap = found.gap();
        let miss = found.miss(&gap, search.state);
        options.listener.tell(Stage::Turned(turn + 1, miss));
        self.judge(system, search, (found, gap, miss), by_proposal.as_deref())
    }

    /// The motion itself goes on for some turns from where it went.
    fn back(&mut self, search: &mut Search<'_, 'o>, turn: Vec<f64>) -> Settled {
        (self.x, self.follow_only) = (turn, FOLLOWED);
        search.aim(&self.x);
        Settled::No
    }

    /// What a turn that returned says: whether it is the last one, and whether the next one starts where it ended or where a correction leads.
    fn judge<S: System + ?Sized>(
        &mut self,
        system: &mut S,
        search: &mut Search<'_, 'o>,
        (found, gap, miss): (Found<'o>, Vec<f64>, f64),
        by_proposal: Option<&[f64]>,
    ) -> Result<Settled, Fault> {
        if matches!(self.plain, Plain::None) && miss <= CLOSES {
            self.plain = Plain::Turn(Box::new(Found { own: true, ..found.clone() }));
        }
        let better = self.best.as_ref().is_none_or(|(least, _)| miss < *least);
        let settled = miss <= EXACT || (self.best.as_ref().is_some_and(|(least, _)| *least <= ENOUGH) && miss > 0.5 * self.last);
        let next_turn = found.next_start(system, &gap);
        self.follow_only = self.follow_only.max(self.patience.after(if better {
            Came::Nearer
        } else {
            Came::NoNearer { corrected: by_proposal.is_some() }
        }));
        let correct = miss <= FAR && self.follow_only == 0 && !settled;
        self.follow_only = self.follow_only.saturating_sub(1);
        if !better && miss > 2.0 * self.last && miss > ENOUGH {
            // the correction led away: a few turns instead
            self.follow_only = FOLLOWED;
        }
        self.last = miss;
        let step = match correct.then(|| found.correction(system, &gap, search.state, Stride::Careful)) {
            // without a derivative the turns are followed
            Some(Err(fault)) if fault.code == "S054" || fault.code == "S055" => None,
            Some(step) => step?,
            None => None,
        };
        self.x = match step.and_then(|step| moved(system, &found, &step).ok()) {
            Some(proposed) => {
                if matches!(self.plain, Plain::None) {
                    self.plain = Plain::Left;
                }
                self.went = Some(next_turn);
                proposed
            }
            None => next_turn,
        };
        search.aim(&self.x);
        if better {
            self.best = Some((miss, found));
        }
        Ok(if settled { Settled::Yes } else { Settled::No })
    }
}

/// Turns that the motion is followed where a proposal has failed.
const FOLLOWED: usize = 3;

/// How corrections do. Where the turn has no good derivative (infinitely many impacts in it) they come no nearer, while the motion itself may.
#[derive(Default)]
struct Patience {
    /// Corrections in a row that came no nearer than the best turn.
    vain: usize,
    /// How often turns have been followed for that.
    rounds: u32,
}

/// What a turn has brought.
enum Came {
    /// The least miss so far.
    Nearer,
    /// Not that; whether a correction began the turn.
    NoNearer { corrected: bool },
}

impl Patience {
    /// Turns to follow without a correction.
    fn after(&mut self, came: Came) -> usize {
        self.vain = match came {
            Came::Nearer => 0,
            Came::NoNearer { corrected: true } => self.vain + 1,
            Came::NoNearer { corrected: false } => self.vain,
        };
        if self.vain < VAIN {
            return 0;
        }
        self.vain = 0;
        self.rounds += 1;
        4 << self.rounds.min(3)
    }
}

/// Corrections in a row that may come no nearer.
const VAIN: usize = 2;

/// What a turn or a correction has left of a zero. A start on a switch (a dead centre, where the sliding turns) is on it exactly: the motion then decides on
/// which side it goes on, and not the sign of the rounding.
pub(super) fn tidy(x: &mut [f64], scales: &[f64]) {
    x.iter_mut().zip(scales).filter(|(x, s)| x.abs() <= TIDY * **s).for_each(|(x, _)| *x = 0.0);
}

/// Share of its scale below which a state at the start of a turn is zero.
const TIDY: f64 = 1e-13;

/// The start of a turn after a correction.
fn moved<S: System + ?Sized>(system: &mut S, found: &Found<'_>, step: &[f64]) -> Result<Vec<f64>, Fault> {
    let mut x: Vec<f64> = found.orbit.first.iter().zip(step).map(|(x, d)| x + d).collect();
    let closed = found.orbit.closed();
    system.rejoin(0.0, &mut x, &found.orbit.modes[0], found.orbit.since(&closed))?;
    Ok(x)
}

/// Newton's step of full length from wherever the start is: a linear machine closes at once, however little damping it has. Where the machine is not
/// linear the step is forgotten, for it may lead to another regime than the motion does.
fn at_once<'o, S: System + ?Sized>(system: &mut S, search: &mut Search<'_, 'o>, x: &[f64]) -> Result<Option<Found<'o>>, Fault> {
    let (sections, limit) = (search.sections.clone(), search.options.limit());
    let Some((orbit, _)) = follow(system, x, &sections, limit, &search.flow)? else { return Ok(None) };
    let before = search.scales.clone();
    search.scales = scales(system, &orbit, None, &search.floor);
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
        let scales = scales(system, &now.orbit, None, &search.floor);
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

/// How long a motion as slow as this one is followed to its return at least, s; a given period, even where it is a guess only, says more.
fn patience(trial: &Orbit, options: &Periodic<'_>) -> f64 {
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
fn trial<S: System + ?Sized>(system: &mut S, start: &[f64], options: &Periodic<'_>, with: &Options) -> Result<(Orbit, Vec<f64>), Fault> {
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
fn steps<S: System + ?Sized>(flow: &mut Flow<'_, S>, end: f64, options: &Periodic<'_>) -> Result<Orbit, Fault> {
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
fn settle<S: System + ?Sized>(flow: &mut Flow<'_, S>, end: f64, options: &Periodic<'_>) -> Result<Vec<f64>, Fault> {
    let mut sizes: Vec<f64> = flow.state().iter().map(|x| x.abs()).collect();
    while !flow.reached(end) && !interrupted(options) {
        flow.advance(end)?;
        sizes.iter_mut().zip(flow.state()).for_each(|(size, x)| *size = size.max(x.abs()));
        options.listener.tell(Stage::Settling(flow.time(), end));
        let (steps, time) = (flow.work().steps as f64, flow.time());
        let needed = steps * (end / time);
        if steps > SAMPLE && needed > MOST {
            return Err(Fault::too_many_steps(&flow.fastest(), time, time / steps, needed));
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

pub(super) fn prepare<'s, 'o, S: System + ?Sized>(
    system: &mut S,
    start: &[f64],
    (mut trial, floor): (Orbit, Vec<f64>),
    options: &'s Periodic<'o>,
) -> Result<(Search<'s, 'o>, Vec<f64>), Fault> {
    let elapsed = trial.period;
    // about a radian a step
    trial.period = elapsed.min(6.0 * elapsed / trial.steps.len().max(1) as f64).max(f64::MIN_POSITIVE);
    let (mut search, named) = begin(system, (&trial, floor), options, flow(options))?;
    let mut x = trial.first.clone();
    if let (Some(frame), true) = (&search.symmetry.frame, options.settle > 0.0) {
        // the same motion at t = 0
        x.iter_mut().zip(frame).for_each(|(x, v)| *x -= v * options.settle);
    }
    let rests = search.symmetry.frame.as_ref().is_some_and(|frame| still(&trial, frame, &search.scales));
    if let (true, Return::Period(_)) = (rests, &options.by) {
        // a machine at rest repeats after any time: the one that is given
        search.symmetry = Symmetry::default();
    }
    match (&search.symmetry.frame, &options.by) {
        (None, Return::Period(period)) => {
            let known = Known { turns: &search.turns, loose: &search.loose, scales: &search.scales };
            search.carried = turns::carried(system, (&trial, elapsed), *period, &known)?.ok_or_else(|| driven(Some(*period)))?;
            if options.settle > 0.0 {
                x = settled_phase(system, start, (*period, &search.carried), options, &search.flow)?;
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
            x = transversal(system, &trial, x, (state, &frame), &search)?;
            search.aim_first(system, &x, &frame)?;
            if options.settle > 0.0 && named.is_some() {
                x = search.in_phase(system, x, start)?;
            }
        }
    }
    // whole turns that angles made while the motion settled go, and with them no digits
    search.turns.unwind(&mut x);
    search.aim(&x);
    Ok((search, x))
}

/// What is known of the motion before it is aimed at a section, and the state of the section where the file names it.
fn begin<'s, 'o, S: System + ?Sized>(
    system: &mut S,
    (trial, mut floor): (&Orbit, Vec<f64>),
    options: &'s Periodic<'o>,
    flow: Options,
) -> Result<(Search<'s, 'o>, Option<usize>), Fault> {
    let mut first_scales = scales(system, trial, None, &floor);
    if system.margin(0.0, &trial.first).is_some() {
        // a coordinate that rests at zero has the rounding of those that connections move with it
        floor.resize(first_scales.len(), 0.0);
        let raised = beside_others(system, &first_scales);
        (0..raised.len()).filter(|&i| raised[i] > first_scales[i]).for_each(|i| floor[i] = floor[i].max(raised[i]));
        first_scales = raised;
    }
    let named = match &options.by {
        Return::State(name) => Some(state_named(system, name)?),
        _ => None,
    };
    let symmetry = symmetry::find(system, trial, &first_scales, named, Reach::Possible)?;
    let loose = symmetry::find(system, trial, &first_scales, named, Reach::Any)?;
    let symmetry = symmetry.followed(&loose, &first_scales);
    let scales = scales(system, trial, symmetry.frame.as_ref(), &floor);
    let turns = Turns::find(system, trial, &scales)?;
    let search = Search {
        options,
        flow: Options { span: trial.period, ..flow },
        scales,
        symmetry,
        loose,
        turns,
        carried: vec![0.0; trial.first.len()],
        sections: Vec::new(),
        state: None,
        whole: Vec::new(),
        floor,
        shrunk: false,
        name: Text::default(),
    };
    Ok((search, named))
}

/// Whether nothing moves in a frame.
fn still(trial: &Orbit, frame: &[f64], scales: &[f64]) -> bool {
    // nine digits below what varies nothing moves
    let moves = |s: &crate::integrate::Step, i: usize| (s.coefficients(i)[1] - frame[i]).abs() * trial.period > 1e-9 * scales[i];
    trial.steps.iter().all(|s| (0..scales.len()).all(|i| !moves(s, i)))
}

/// The state after whole periods of the forcing, as if at t = 0.
fn settled_phase<S: System + ?Sized>(
    system: &mut S,
    start: &[f64],
    (period, carried): (f64, &[f64]),
    options: &Periodic<'_>,
    with: &Options,
) -> Result<Vec<f64>, Fault> {
    let whole = (options.settle / period).ceil() * period;
    let mut flow = Flow::start(system, 0.0, start, with)?;
    settle(&mut flow, whole, options)?;
    let (mut x, modes) = (flow.state().to_vec(), flow.modes().to_vec());
    x.iter_mut().zip(carried).for_each(|(x, v)| *x -= v * whole);
    let settled = x.clone();
    // the phase of many periods carries a rounding by which what lies on a shaken table would begin inside it
    if system.project(0.0, &mut x, &modes).and_then(|_| system.polish(0.0, &mut x, &modes)).is_err() {
        return Ok(settled);
    }
    Ok(x)
}

fn state_named<S: System + ?Sized>(system: &S, name: &str) -> Result<usize, Fault> {
    let known: Vec<String> = system.states().iter().map(|q| q.name.clone()).collect();
    known.iter().position(|n| n == name).ok_or_else(|| Fault::unknown_output(name, &known))
}

/// A place of the motion at which the section's state really moves.
fn transversal<S: System + ?Sized>(
    system: &mut S,
    trial: &Orbit,
    x: Vec<f64>,
    (state, frame): (usize, &[f64]),
    search: &Search<'_, '_>,
) -> Result<Vec<f64>, Fault> {
    let speed = |c: &[f64]| (c[1] - frame[state]).abs();
    let fastest = trial.steps.iter().map(|s| speed(s.coefficients(state))).fold(0.0, f64::max);
    let modes = Flow::start(system, 0.0, &x, &search.flow)?.modes().to_vec();
    let own = (fundamental::rates(system, 0.0, &x, &modes)?[state] - frame[state]).abs();
    // a section that is passed this slowly has no instant with digits
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
        let turning = |i: &usize| self.turns.of(*i).is_some_and(|turn| ranges[*i].0 > turn);
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
        if let Some(whole) = self.turns.of(state) {
            let turn = sign * whole * count as f64;
            self.sections.push(Section::Level { state, level: x[state] + turn, drift, sign, count: 1, turn });
        }
        Ok(())
    }

    /// The next state in which the section's angle is what it is at the start of the file, whole turns apart.
    fn in_phase<S: System + ?Sized>(&self, system: &mut S, x: Vec<f64>, start: &[f64]) -> Result<Vec<f64>, Fault> {
        let state = self.state.filter(|&i| self.symmetry.frame.as_ref().is_some_and(|f| f[i] == 0.0));
        let Some((state, whole)) = state.and_then(|i| Some((i, self.turns.of(i)?))) else { return Ok(x) };
        let Some(Section::Level { sign, .. }) = self.sections.first() else { return Ok(x) };
        let ahead = (sign * (start[state] - x[state])).rem_euclid(whole);
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

    /// What is left of the motion; where little is, it gets scales of its own. None in a given period: a place of rest is a regime of that period.
    fn left<S: System + ?Sized>(&mut self, system: &S, orbit: &Orbit) -> Option<Left> {
        self.state?;
        let first = 2 * system.n_coordinates();
        let alone = |shift: &[f64], pivot: usize| shift.iter().enumerate().all(|(i, v)| i == pivot || *v == 0.0);
        let apart: Vec<usize> = self.symmetry.shifts.iter().filter(|(p, shift)| *p >= first && alone(shift, *p)).map(|s| s.0).collect();
        if rest::left(orbit, &self.whole, &apart) == Left::Rest {
            return Some(Left::Rest);
        }
        let left = rest::left(orbit, &self.scales, &apart);
        if left != Left::Motion {
            self.shrunk = true;
            self.scales = scales(system, orbit, self.symmetry.frame.as_ref(), &self.floor);
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

    pub(super) fn found<S: System + ?Sized>(&self, system: &mut S, orbit: Orbit) -> Result<Found<'o>, Fault> {
        let closed = orbit.closed();
        let place = (orbit.since(&closed), &orbit.modes[0][..]);
        let (free, basis) = tangent(system, place, &self.scales, self.state, &self.symmetry)?;
        Ok(Found {
            orbit,
            coordinates: system.n_coordinates(),
            scales: self.scales.clone(),
            symmetry: self.symmetry.clone(),
            loose: self.loose.clone(),
            free,
            basis,
            turns: self.turns.clone(),
            carried: self.carried.clone(),
            shrunk: self.shrunk,
            own: false,
            listener: self.options.listener,
        })
    }
}
