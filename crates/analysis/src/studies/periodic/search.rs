//! What a search knows before its first turn: the symmetries of the machine, whole turns of its angles, and the section through which the motion returns.

use super::faults::driven;
use super::found::{Found, beside_others, tangent};
use super::fundamental;
use super::options::{Periodic, Return};
use super::orbit::{Orbit, Section, follow};
use super::rest::{self, Left};
use super::symmetry::{self, Reach, Symmetry};
use super::trial::{flow, scales, settle};
use super::turns::{self, Known, Turns};
use crate::integrate::taylor::{Flow, Options};
use crate::{Fault, System};
use words::Text;

/// What the search knows before the first turn.
pub(super) struct Search<'s, 'o> {
    pub(super) options: &'s Periodic<'o>,
    pub(super) flow: Options,
    pub(super) scales: Vec<f64>,
    pub(super) symmetry: Symmetry,
    loose: Symmetry,
    /// Whole turns that the laws do not feel.
    pub(super) turns: Turns,
    /// Velocities of the angles that turn with the forcing.
    pub(super) carried: Vec<f64>,
    pub(super) sections: Vec<Section>,
    /// State that defines the section; none for a given period.
    pub(super) state: Option<usize>,
    /// Scales of the first turn.
    pub(super) whole: Vec<f64>,
    /// Least scales.
    pub(super) floor: Vec<f64>,
    /// Whether the motion is far smaller than in the first turn.
    shrunk: bool,
    pub(super) name: Text,
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
pub(super) fn begin<'s, 'o, S: System + ?Sized>(
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
pub(super) fn still(trial: &Orbit, frame: &[f64], scales: &[f64]) -> bool {
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
    pub(super) fn left<S: System + ?Sized>(&mut self, system: &S, orbit: &Orbit) -> Option<Left> {
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
    pub(super) fn aim(&mut self, x: &[f64]) {
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
