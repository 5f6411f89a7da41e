//! The map of a turn beside a regime, as those need it who follow regimes along a parameter: where a start leads after a time, by how much it misses
//! itself, and what becomes of small changes of it.

use super::found::{Found, tangent};
use super::fundamental::{self, Blur, Meeting};
use super::options::{Multiplier, Periodic};
use super::orbit::{Limit, Orbit, Section, follow};
use super::spectrum::spectrum;
use super::symmetry::Symmetry;
use super::turns::{self, Known, Turns};
use super::variation::Care;
use super::{newton, trial};
use crate::integrate::Step;
use crate::integrate::crossings::{Change, Switch};
use crate::integrate::taylor::{Flow, Options};
use crate::{Fault, Mode, Since, System};

/// What a regime tells of all its neighbours: scales, symmetries, whole turns that the laws do not feel.
pub(in crate::studies) struct Shooting<'o> {
    found: Found<'o>,
    flow: Options,
    seed: u64,
    /// Whole turns of the states at the start since the machine was assembled.
    wound: Vec<f64>,
    /// Whether conditions of connections tie the states.
    tied: bool,
}

/// A turn of given length.
pub(in crate::studies) struct Turned<'o>(Found<'o>);

/// What a turn does to small changes of its start.
pub(in crate::studies) struct Varied {
    /// States that have to come back and can be chosen freely.
    pub(in crate::studies) states: Vec<usize>,
    /// Change of all states per change of each of these, column by column.
    pub(in crate::studies) basis: Vec<Vec<f64>>,
    /// Change at the end per change of the start, of these states in their scales, row by row.
    pub(in crate::studies) matrix: Vec<f64>,
    /// Rates at the end of the turn, of all states.
    pub(in crate::studies) rates: Vec<f64>,
    /// By how much the end misses the start in what follows from these, in scales: whole turns of angles in mesh that the laws feel.
    pub(in crate::studies) off: f64,
    /// By how much Liouville's formula is missed.
    pub(in crate::studies) liouville: f64,
    /// Largest first; none where the turn has no derivative by its start.
    pub(in crate::studies) multipliers: Option<Vec<Multiplier>>,
}

impl<'o> Shooting<'o> {
    /// The regime near a start.
    ///
    /// *Errors*: those of the study `periodic`.
    pub(in crate::studies) fn new<S: System + ?Sized>(system: &mut S, start: &[f64], options: &Periodic<'o>) -> Result<Self, Fault> {
        let found = newton::solve(system, start, options)?;
        let flow = Options { tolerance: options.tolerance, span: found.orbit.period, ..Options::default() };
        let wound = vec![0.0; start.len()];
        Ok(Shooting { found, flow, seed: options.seed, wound, tied: system.is_tied() })
    }

    /// Counts conditions on rates from this state, as which the machine was assembled; between it and the regime are whole turns, or what stays as it is.
    ///
    /// *Errors*: a formula of connections without a value on the way.
    pub(in crate::studies) fn assembled<S: System + ?Sized>(&mut self, system: &mut S, state: &[f64]) -> Result<(), Fault> {
        let Found { orbit, turns, .. } = &self.found;
        let since = Since { t: 0.0, x: state, closed: &orbit.closed() };
        let mut kept = |x: &[f64]| system.kept(0.0, x, &orbit.modes[0], since);
        let gained = kept(&orbit.first)?;
        if gained.iter().any(|c| *c != 0.0) {
            let apart = || orbit.first.iter().zip(state).map(|(x, begin)| x - begin).collect();
            self.wound = turns.wound(state, &gained, &mut kept)?.unwrap_or_else(apart);
        }
        Ok(())
    }

    /// Small motions beside a place of rest, whose period is near a given one.
    ///
    /// *Errors*: those of the start.
    pub(in crate::studies) fn beside<S: System + ?Sized>(
        system: &mut S,
        x: &[f64],
        (scales, period): (&[f64], f64),
        options: &Periodic<'o>,
    ) -> Result<Self, Fault> {
        let flow = Options { tolerance: options.tolerance, span: period, ..Options::default() };
        let modes = Flow::start(system, 0.0, x, &flow)?.modes().to_vec();
        let symmetry = Symmetry { frame: Some(vec![0.0; x.len()]), ..Symmetry::default() };
        let orbit = Orbit { first: x.to_vec(), last: x.to_vec(), period, modes: [modes.clone(), modes], ..Orbit::default() };
        let found = Found {
            orbit,
            coordinates: system.n_coordinates(),
            scales: scales.to_vec(),
            loose: symmetry.clone(),
            symmetry,
            free: Vec::new(),
            basis: Vec::new(),
            turns: Turns::default(),
            carried: vec![0.0; x.len()],
            shrunk: false,
            own: false,
            listener: options.listener,
        };
        let wound = vec![0.0; x.len()];
        Ok(Shooting { found, flow, seed: options.seed, wound, tied: system.is_tied() })
    }

    /// State at the start and period.
    pub(in crate::studies) fn regime(&self) -> (&[f64], f64) {
        (&self.found.orbit.first, self.found.orbit.period)
    }

    /// Whether conditions of connections tie the states.
    pub(in crate::studies) fn is_tied(&self) -> bool {
        self.tied
    }

    /// Whether time occurs in the equations.
    pub(in crate::studies) fn is_driven(&self) -> bool {
        self.found.is_driven()
    }

    /// Whether the motion repeats only in a frame that moves.
    pub(in crate::studies) fn drifts(&self) -> bool {
        self.found.symmetry.frame.as_ref().is_some_and(|frame| frame.iter().any(|v| *v != 0.0))
    }

    /// What the states vary by.
    pub(in crate::studies) fn scales(&self) -> &[f64] {
        &self.found.scales
    }

    /// Takes larger scales where a regime has become larger than all before it.
    pub(in crate::studies) fn widen<S: System + ?Sized>(&mut self, system: &S, turned: &Turned<'_>) {
        let now = trial::scales(system, &turned.0.orbit, None, &[]);
        self.found.scales.iter_mut().zip(now).for_each(|(scale, now)| *scale = scale.max(now));
    }

    /// Takes scales that are no smaller than these.
    pub(in crate::studies) fn raise(&mut self, least: &[f64]) {
        self.found.scales.iter_mut().zip(least).for_each(|(scale, least)| *scale = scale.max(least.abs()));
    }

    /// The motion from a state over a time.
    ///
    /// *Errors*: those of a motion; S042 after an interruption.
    pub(in crate::studies) fn turn<S: System + ?Sized>(&self, system: &mut S, x: &[f64], period: f64) -> Result<Turned<'o>, Fault> {
        let limit = Limit { time: period, listener: self.found.listener };
        let flow = Options { span: period, ..self.flow.clone() };
        let (orbit, _) = follow(system, x, &[Section::Time(period)], limit, &flow)?.ok_or_else(|| super::faults::unsettled(1.0, 1))?;
        // what follows is told from what is free by the directions of the start
        let (free, basis) = match self.found.symmetry.followers.is_empty() {
            true => (Vec::new(), Vec::new()),
            false => {
                let closed = orbit.closed();
                let place = (orbit.since(&closed), &orbit.modes[0][..]);
                tangent(system, place, &self.found.scales, None, &self.found.symmetry)?
            }
        };
        Ok(Turned(Found {
            orbit,
            coordinates: self.found.coordinates,
            scales: self.found.scales.clone(),
            symmetry: self.found.symmetry.clone(),
            loose: self.found.loose.clone(),
            free,
            basis,
            turns: self.found.turns.clone(),
            carried: self.carried_in(period),
            shrunk: false,
            own: false,
            listener: self.found.listener,
        }))
    }

    /// Puts a start back onto the conditions of connections of a machine that was assembled so.
    ///
    /// *Errors*: they cannot be met nearby.
    pub(in crate::studies) fn seat<S: System + ?Sized>(&self, system: &mut S, x: &mut [f64], assembled: &[f64]) -> Result<(), Fault> {
        let from: Vec<f64> = assembled.iter().zip(&self.wound).map(|(x, turns)| x + turns).collect();
        let closed = self.found.orbit.closed();
        system.rejoin(0.0, x, &self.found.orbit.modes[0], Since { t: 0.0, x: &from, closed: &closed }).map(|_| ())
    }

    /// What becomes of small changes.
    ///
    /// *Errors*: S054 and S055 where there is no derivative, S122 over a change point.
    pub(in crate::studies) fn vary<S: System + ?Sized>(&self, system: &mut S, turned: &mut Turned<'_>) -> Result<Varied, Fault> {
        let found = &mut turned.0;
        let closed = found.orbit.closed();
        let place = (found.orbit.since(&closed), &found.orbit.modes[0][..]);
        let (free, basis) = tangent(system, place, &found.scales, None, &found.symmetry)?;
        (found.free, found.basis) = (free, basis);
        let (turn, blur) = found.turn(system)?;
        let multipliers = if blur == Blur::None { Some(spectrum(&turn, self.seed)?.multipliers) } else { None };
        let states = found.returning(None);
        let column = |j: &usize| found.free.iter().position(|i| i == j).map(|k| found.basis[k].clone()).unwrap_or_default();
        let basis = states.iter().map(column).collect();
        let rates = found.flow_at_end(system)?;
        let off = found.off(&found.gap());
        Ok(Varied { states, basis, off, liouville: turn.liouville, matrix: turn.matrix, rates, multipliers })
    }
}

/// A part of a turn.
pub(in crate::studies) struct Passage {
    orbit: Orbit,
}

impl Passage {
    /// Its steps.
    pub(in crate::studies) fn steps(&self) -> &[Step] {
        &self.orbit.steps
    }

    /// Where it ends.
    pub(in crate::studies) fn end(&self) -> &[f64] {
        &self.orbit.last
    }

    /// Least and greatest value of each of the first n states, whose rates are the next n.
    pub(in crate::studies) fn extremes(&self, n: usize) -> Vec<[f64; 2]> {
        (0..n).map(|i| extremes(&self.orbit, i, n + i)).collect()
    }
}

/// The turn of these parts.
fn joined(parts: &[Passage], period: f64) -> Option<Orbit> {
    let (begin, end) = (parts.first()?, parts.last()?);
    let steps = parts.iter().flat_map(|part| part.orbit.steps.iter().cloned()).collect();
    let modes = [begin.orbit.modes[0].clone(), end.orbit.modes[1].clone()];
    Some(Orbit { steps, first: begin.orbit.first.clone(), last: end.orbit.last.clone(), period, modes, ..Orbit::default() })
}

/// What a part of a turn does to small changes: a matrix in scales, row by row, by how much Liouville's formula is missed, and what the entries may err by as a share of the largest.
pub(in crate::studies) struct Carried {
    pub(in crate::studies) matrix: Vec<f64>,
    pub(in crate::studies) liouville: f64,
    pub(in crate::studies) doubt: f64,
}

impl Shooting<'_> {
    /// The motion between two instants; none where something switches on the way.
    ///
    /// *Errors*: those of a motion; S042 after an interruption.
    pub(in crate::studies) fn passage<S: System + ?Sized>(
        &self,
        system: &mut S,
        x: &[f64],
        [from, to]: [f64; 2],
    ) -> Result<Option<Passage>, Fault> {
        let mut flow = Flow::start(system, from, x, &Options { span: to - from, ..self.flow.clone() })?;
        let mut orbit = Orbit { first: flow.state().to_vec(), modes: [flow.modes().to_vec(), Vec::new()], ..Orbit::default() };
        while !flow.reached(to) {
            if self.found.listener.is_interrupted() {
                return Err(super::faults::unsettled(1.0, 1));
            }
            flow.advance(to)?;
            if !flow.switches().is_empty() {
                return Ok(None);
            }
            orbit.steps.push(flow.step().clone());
        }
        // variations take steps by the whole period
        orbit.period = self.found.orbit.period.max(to - from);
        (orbit.last, orbit.modes[1]) = (flow.state().to_vec(), flow.modes().to_vec());
        Ok(Some(Passage { orbit }))
    }

    /// What a part of a turn does to small changes of all states.
    ///
    /// *Errors*: those of the variational equations.
    pub(in crate::studies) fn carried<S: System + ?Sized>(&self, system: &mut S, passage: &Passage) -> Result<Carried, Fault> {
        let scales = &self.found.scales;
        let mut found = fundamental::of_orbit(system, &passage.orbit, scales, (Care::Multipliers, self.found.listener))?;
        found.matrix.scale(scales);
        Ok(Carried { matrix: found.matrix.values, liouville: found.liouville, doubt: found.doubt })
    }

    /// Whether the laws repeat after a turn that is known in parts.
    ///
    /// *Errors*: those of the equations.
    pub(in crate::studies) fn laws_repeat<S: System + ?Sized>(
        &self,
        system: &mut S,
        parts: &[Passage],
        period: f64,
    ) -> Result<bool, Fault> {
        let Some(orbit) = joined(parts, period) else { return Ok(false) };
        let known = Known { turns: &self.found.turns, loose: &self.found.loose, scales: &self.found.scales };
        turns::repeats(system, (&orbit, period), (period, &self.carried_in(period)), &known)
    }

    /// Whether the laws do not feel the whole turns that the states gain in a turn that is known in parts.
    ///
    /// *Errors*: those of the equations.
    pub(in crate::studies) fn turns_are_unfelt<S: System + ?Sized>(
        &self,
        system: &mut S,
        (parts, period): (&[Passage], f64),
        gain: &[f64],
    ) -> Result<bool, Fault> {
        let Some(orbit) = joined(parts, period) else { return Ok(true) };
        self.found.turns.unfelt(system, &orbit, &self.found.scales, gain)
    }

    /// Velocities of the angles that turn with the forcing: the same whole turns in another period.
    fn carried_in(&self, period: f64) -> Vec<f64> {
        self.found.carried.iter().map(|v| v * self.found.orbit.period / period).collect()
    }

    /// The steps of a turn, and what the states gain in it: whole turns.
    pub(in crate::studies) fn laid<S: System + ?Sized>(
        &self,
        system: &mut S,
        x: &[f64],
        period: f64,
    ) -> Result<(Vec<Step>, Vec<f64>), Fault> {
        let turned = self.turn(system, x, period)?.0;
        let gap = turned.gap();
        let gain = (0..x.len()).map(|i| turned.orbit.last[i] - turned.orbit.first[i] - gap[i]).collect();
        Ok((turned.orbit.steps, gain))
    }
}

/// States that connections leave free at a time and state, and the change of all states with each of them.
///
/// *Errors*: those of the connections.
pub(in crate::studies) fn tangent_of<S: System + ?Sized>(
    system: &mut S,
    (t, x, modes): (f64, &[f64], &[Mode]),
    scales: &[f64],
) -> Result<(Vec<usize>, Vec<Vec<f64>>), Fault> {
    tangent(system, (Since { t, x, closed: &[] }, modes), scales, None, &Symmetry::default())
}

/// Parts of a step at which a rate is looked at for a change of its sign.
const PARTS: usize = 12;
/// Halvings of such a part: to the last bit of the time within it.
const HALVINGS: usize = 54;

impl Turned<'_> {
    /// By how much the states miss their start, SI.
    pub(in crate::studies) fn gap(&self) -> Vec<f64> {
        self.0.gap()
    }

    /// Takes other scales.
    pub(in crate::studies) fn rescale(&mut self, scales: &[f64]) {
        self.0.scales = scales.to_vec();
    }

    /// Duration.
    pub(in crate::studies) fn period(&self) -> f64 {
        self.0.orbit.period
    }

    /// The guards that switch in the turn, by number: where the turn begins does not matter. The rebounds of a contact that comes to rest are not counted: how many
    /// of them without end are followed is no matter of the motion.
    pub(in crate::studies) fn switches(&self) -> Vec<usize> {
        let all = || self.0.orbit.jumps.iter().flat_map(|jump| &jump.switches);
        let rebounds = |s: &Switch| matches!(s.change, Change::Impact { .. }) && s.after == Mode::Positive;
        let closes = |guard: usize| all().any(|s| s.guard == guard && s.before == Mode::Positive && s.after == Mode::Zero);
        let counts = |s: &&Switch| !(rebounds(s) && closes(s.guard));
        let mut list: Vec<usize> = all().filter(counts).map(|s| s.guard).collect();
        list.sort_unstable();
        list
    }

    /// The guard that is met most slowly; none where all instants of switches are fixed.
    ///
    /// *Errors*: those of the equations.
    pub(in crate::studies) fn slowest<S: System + ?Sized>(&self, system: &mut S) -> Result<Option<Meeting>, Fault> {
        let mut slowest: Option<Meeting> = None;
        for jump in &self.0.orbit.jumps {
            for meeting in fundamental::met(system, jump, &self.0.scales)? {
                if slowest.is_none_or(|least| meeting.rate < least.rate) {
                    slowest = Some(meeting);
                }
            }
        }
        Ok(slowest)
    }

    /// How near to its ends something switches that the states move, as a share of the period; none where nothing does. A load that switches by time alone does so at the same share of
    /// each period, and may at its start: what is free does not change there.
    ///
    /// *Errors*: those of the equations.
    pub(in crate::studies) fn edge<S: System + ?Sized>(&self, system: &mut S) -> Result<Option<f64>, Fault> {
        let period = self.0.orbit.period;
        let mut edge: Option<f64> = None;
        for jump in &self.0.orbit.jumps {
            let away = jump.t.min(period - jump.t).abs() / period;
            if edge.is_none_or(|least| away < least)
                && fundamental::met(system, jump, &self.0.scales)?.iter().any(|meeting| meeting.felt > 0.0)
            {
                edge = Some(away);
            }
        }
        Ok(edge)
    }

    /// Whether what holds at its start holds at its end: sticking frictions, closed contacts.
    pub(in crate::studies) fn holds_on(&self) -> bool {
        let [begin, end] = &self.0.orbit.modes;
        let held = |mode: &Mode| *mode == Mode::Zero;
        begin.iter().map(held).eq(end.iter().map(held))
    }

    /// Whether the laws repeat after the turn.
    ///
    /// *Errors*: those of the equations.
    pub(in crate::studies) fn laws_repeat<S: System + ?Sized>(&self, system: &mut S) -> Result<bool, Fault> {
        self.0.laws_repeat(system, self.0.orbit.period)
    }

    /// Whether the laws do not feel the whole turns that its angles have made.
    ///
    /// *Errors*: those of the equations.
    pub(in crate::studies) fn turns_are_unfelt<S: System + ?Sized>(&self, system: &mut S) -> Result<bool, Fault> {
        self.0.turns_are_unfelt(system)
    }

    /// Least and greatest value of each of the first n states, whose rates are the next n.
    pub(in crate::studies) fn extremes(&self, n: usize) -> Vec<[f64; 2]> {
        (0..n).map(|i| extremes(&self.0.orbit, i, n + i)).collect()
    }
}

/// Least and greatest value of a state along the turn, `rate` being its derivative.
fn extremes(orbit: &Orbit, state: usize, rate: usize) -> [f64; 2] {
    let mut ends = [orbit.last[state]; 2];
    let mut see = |x: f64| ends = [ends[0].min(x), ends[1].max(x)];
    for step in &orbit.steps {
        see(step.value_after(state, 0.0));
        let speed = |tau: f64| step.value_after(rate, tau);
        for part in 0..PARTS {
            let at = |k: usize| step.length * (part + k) as f64 / PARTS as f64;
            let (mut low, mut high) = (at(0), at(1));
            let rises = speed(low) < 0.0;
            if (speed(high) < 0.0) == rises {
                continue;
            }
            for _ in 0..HALVINGS {
                let middle = 0.5 * (low + high);
                if (speed(middle) < 0.0) == rises { low = middle } else { high = middle }
            }
            see(step.value_after(state, high));
        }
    }
    ends
}
