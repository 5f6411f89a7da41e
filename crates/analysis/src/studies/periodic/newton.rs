//! The search: turns of the motion, corrected by Newton's method until one closes.

use super::faults::{interrupted, no_return, unsettled};
use super::found::{Found, Stride};
use super::listener::Stage;
use super::options::Periodic;
use super::orbit::follow;
use super::own::{CLOSES, Plain};
use super::rest::{self, Left};
use super::search::{Search, prepare};
use super::trial::{opened, scales};
use crate::fault::codes;
use crate::{Fault, System};

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
            Some(Err(fault)) if fault.code == codes::NO_DERIVATIVE || fault.code == codes::NO_VARIATIONS => None,
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
