//! Eight motions under way.

use super::checks::{Checks, Inside};
use super::length::Lengths;
use crate::Mode;
use crate::audits::defect::looked_at;
use crate::integrate::taylor::{DEFECT, OF_RATES as ROUNDING};
use crate::integrate::{FOUR_TURNS, MOST_TURNS, Step, taken};
use algebra::gauss::EIGHT;
use algebra::simd::Lanes;
use algebra::sum::{Instant, two_sum};
use program::ensemble::{Ensemble, LANES, Layout, Rule, Span, Values};
use std::sync::Arc;

/// Steps taken back in a row before the motion is handed back.
const PATIENCE: u32 = 3;
/// Share of the prescribed velocities up to which one that changes at a switch does so by rounding of the instant.
const JUMP: f64 = 1e-13;

/// A motion that is put into a lane.
pub(crate) struct Fresh<'a> {
    pub numbers: &'a [f64],
    pub start: &'a [f64],
    pub modes: &'a [Mode],
    /// Instants of switches with the modes that hold behind them, ascending.
    pub switches: Vec<(f64, Vec<Mode>)>,
    pub until: f64,
}

/// How a lane stands.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub(crate) enum State {
    #[default]
    Idle,
    /// A step was taken.
    Under,
    /// The last one was taken.
    Done,
    /// The lane cannot go on.
    Lost,
}

/// What a lane has by itself.
#[derive(Clone, Debug, Default)]
struct Lane {
    state: State,
    now: Instant,
    start: Instant,
    modes: Vec<Mode>,
    switches: std::collections::VecDeque<(f64, Vec<Mode>)>,
    until: f64,
    steps: u64,
}

impl Lane {
    fn target(&self) -> f64 {
        self.switches.front().map_or(self.until, |(t, _)| t.min(self.until))
    }

    /// Where a step ends, and whether that is the instant to be hit; what rounding leaves up to it is no step.
    fn lands(&self, h: f64, limit: f64) -> (Instant, bool) {
        let (target, lands) = (self.target(), self.now.after(h));
        let full = h >= limit || lands.until(target).abs() <= 4.0 * f64::EPSILON * target.abs();
        (if full { Instant::at(target) } else { lands }, full)
    }
}

/// The motions.
#[derive(Debug)]
pub(crate) struct Flow {
    series: Ensemble,
    rule: Lengths,
    /// Of the ledger.
    points: Rule,
    checks: Checks,
    lanes: [Lane; LANES],
    coordinates: usize,
    /// States that only turn.
    freely: Vec<usize>,
    x: Vec<Lanes>,
    low: Vec<Lanes>,
    /// Turns taken off, in units of four.
    turns: Vec<Lanes>,
    /// The same at the start of the last step.
    before: [Vec<Lanes>; 3],
    guesses: Lanes,
    /// Lengths of the last steps.
    lengths: Lanes,
    next: [Vec<Lanes>; 3],
    changes: Vec<Lanes>,
    slopes: Vec<Lanes>,
    values: Values,
    inside: Values,
}

impl Flow {
    /// For machines of this layout, with the units of their states; `freely` are states that only turn.
    pub(crate) fn new(layout: &Arc<Layout>, tolerance: f64, (units, coordinates): (&[&str], usize), freely: Vec<usize>) -> Flow {
        let rule = Lengths::new(tolerance, units);
        let series = Ensemble::new(layout, rule.order);
        let zeros = || vec![[0.0; LANES]; units.len()];
        let (values, inside) = (series.values(), series.values());
        Flow {
            checks: Checks::new(units),
            lanes: Default::default(),
            coordinates,
            freely,
            x: zeros(),
            low: zeros(),
            turns: zeros(),
            before: [zeros(), zeros(), zeros()],
            guesses: [f64::INFINITY; LANES],
            lengths: [0.0; LANES],
            next: [zeros(), zeros(), zeros()],
            changes: zeros(),
            slopes: zeros(),
            values,
            inside,
            points: Rule::new(&EIGHT, rule.order),
            rule,
            series,
        }
    }

    /// How a lane stands after the last step.
    pub(crate) fn state(&self, lane: usize) -> State {
        self.lanes[lane].state
    }

    /// Steps of the motion in a lane.
    pub(crate) fn steps(&self, lane: usize) -> u64 {
        self.lanes[lane].steps
    }

    /// Where the last step ended.
    pub(crate) fn ends(&self, lane: usize) -> Instant {
        self.lanes[lane].now
    }

    /// Where the last step began, and its length.
    pub(crate) fn span(&self, lane: usize) -> (Instant, f64) {
        (self.lanes[lane].start, self.lengths[lane])
    }

    /// Largest shares that the energy ledger and the defect inside of steps have found.
    pub(crate) fn found(&self, lane: usize) -> [f64; 2] {
        self.checks.found(lane)
    }

    /// Puts a motion into a lane.
    pub(crate) fn put(&mut self, lane: usize, fresh: Fresh<'_>) {
        self.series.load(lane, fresh.numbers);
        self.series.set_modes(lane, fresh.modes);
        for (i, value) in fresh.start.iter().enumerate() {
            (self.x[i][lane], self.low[i][lane], self.turns[i][lane]) = (*value, 0.0, 0.0);
        }
        self.take_turns_off(lane);
        self.guesses[lane] = f64::INFINITY;
        self.lanes[lane] = Lane {
            state: State::Under,
            modes: fresh.modes.to_vec(),
            switches: fresh.switches.into(),
            until: fresh.until,
            ..Lane::default()
        };
        self.evaluate_here();
        if !self.values.sound()[lane] {
            self.lanes[lane].state = State::Lost;
        }
        self.checks.begin(lane, &self.values);
    }

    /// Empties a lane.
    pub(crate) fn take(&mut self, lane: usize) {
        self.lanes[lane].state = State::Idle;
        self.series.rest(lane);
    }

    fn busy(&self) -> [bool; LANES] {
        std::array::from_fn(|lane| self.lanes[lane].state == State::Under)
    }

    fn evaluate_here(&mut self) {
        let times = std::array::from_fn(|lane| self.lanes[lane].now.high);
        self.series.evaluate(&times, &self.x, &mut self.values);
    }

    /// One step in each lane that is under way.
    pub(crate) fn advance(&mut self) {
        let busy = self.busy();
        let finite = self.series.expand(&self.values);
        let limits: Lanes = std::array::from_fn(|lane| self.lanes[lane].now.until(self.lanes[lane].target()).max(0.0));
        let found = self.rule.lengths(&self.series, &self.guesses, &limits, &busy);
        let mut h: Lanes = std::array::from_fn(|lane| if busy[lane] { found[lane] } else { 0.0 });
        for lane in (0..LANES).filter(|lane| busy[*lane]) {
            if !finite[lane] || h[lane].is_nan() {
                self.lose(lane, &mut h);
            }
        }
        self.guesses = h;
        let believed = self.series.faithful(&h, self.rule.tolerance);
        for lane in (0..LANES).filter(|lane| busy[*lane]) {
            match believed[lane] {
                Some(shorter) => h[lane] = shorter,
                None => self.lose(lane, &mut h),
            }
        }
        self.land(&mut h, &limits);
        self.lengths = h;
        self.check();
        self.arrive();
    }

    /// A lane that cannot go on stands still from here.
    fn lose(&mut self, lane: usize, h: &mut Lanes) {
        self.lanes[lane].state = State::Lost;
        h[lane] = 0.0;
    }

    /// Ends of the steps, shorter until the equations hold there.
    fn land(&mut self, h: &mut Lanes, limits: &Lanes) {
        let mut tries = [0; LANES];
        loop {
            self.evaluate_ends(h, limits);
            let busy = self.busy();
            let mut again = false;
            for lane in (0..LANES).filter(|lane| busy[*lane]) {
                if !self.values.sound()[lane] {
                    self.lose(lane, h);
                    continue;
                }
                if self.holds(lane, h[lane]) {
                    continue;
                }
                tries[lane] += 1;
                h[lane] *= 0.5;
                self.guesses[lane] = h[lane];
                again = true;
                if tries[lane] > PATIENCE {
                    self.lose(lane, h);
                }
            }
            for lane in (0..LANES).filter(|lane| busy[*lane]) {
                let t = self.lanes[lane].now.high;
                // the scalar path knows what a step is worth that does not move the time
                if h[lane] < limits[lane] && h[lane] <= 4.0 * f64::EPSILON * t.abs() {
                    self.lose(lane, h);
                }
            }
            if !again {
                return;
            }
        }
    }

    /// States at the ends with their turns taken off, and values there.
    fn evaluate_ends(&mut self, h: &Lanes, limits: &Lanes) {
        self.series.motion(h, &mut self.changes, &mut self.slopes);
        let (n_x, [x, low, turns]) = (self.x.len(), &mut self.next);
        for i in 0..n_x {
            for lane in 0..LANES {
                (x[i][lane], low[i][lane]) = two_sum(self.x[i][lane], self.changes[i][lane] + self.low[i][lane]);
            }
            turns[i] = self.turns[i];
        }
        for k in 0..self.freely.len() {
            let i = self.freely[k];
            let [x, low, turns] = &mut self.next;
            for lane in 0..LANES {
                reduce(&mut x[i][lane], &mut low[i][lane], &mut turns[i][lane]);
            }
        }
        let times = std::array::from_fn(|lane| self.lanes[lane].lands(h[lane], limits[lane]).0.high);
        self.series.evaluate(&times, &self.next[0], &mut self.values);
    }

    /// Whether the rates at the end of a step are the slopes of its polynomials.
    fn holds(&self, lane: usize, h: f64) -> bool {
        let tolerance = self.rule.tolerance;
        (0..self.x.len()).all(|i| {
            let (slope, rate) = (self.slopes[i][lane], self.values.rate(i)[lane]);
            let off = h * (slope - rate).abs();
            let truncation = tolerance * self.rule.scale[i][lane];
            off <= DEFECT * truncation || {
                // how large the terms are that meet in the slope
                let c = self.series.state(i);
                let size = (1..c.len()).rev().fold(0.0, |sum, k| sum * h + k as f64 * c[k][lane].abs());
                off <= DEFECT * (truncation + ROUNDING * f64::EPSILON * h * (size + rate.abs()))
            }
        })
    }

    /// The checks of the steps taken.
    fn check(&mut self) {
        let times = [|t: Instant| t.high, |t: Instant| t.low].map(|part| std::array::from_fn(|lane| part(self.lanes[lane].now)));
        let span = Span { times: [&times[0], &times[1]], states: [&self.x, &self.low], lengths: &self.lengths };
        let works = self.series.works(&span, &self.points, &mut self.inside);
        self.checks.book(&self.values, &works);
        let share = |lane: usize| looked_at(self.lanes[lane].steps + 1);
        self.look_inside(&std::array::from_fn(|lane| share(lane) * self.lengths[lane]));
        self.checks.compare(&Inside {
            values: &self.inside,
            states: &self.changes,
            slopes: &self.slopes,
            lengths: &self.lengths,
            coordinates: self.coordinates,
        });
    }

    /// States, slopes and values at a point inside of the steps.
    fn look_inside(&mut self, taus: &Lanes) {
        self.series.motion(taus, &mut self.changes, &mut self.slopes);
        for i in 0..self.x.len() {
            let (x, low, change) = (&self.x[i], &self.low[i], &mut self.changes[i]);
            (0..LANES).for_each(|lane| change[lane] = x[lane] + (change[lane] + low[lane]));
        }
        let times = std::array::from_fn(|lane| self.lanes[lane].now.after(taus[lane]).high);
        self.series.evaluate_rates(&times, &self.changes, &mut self.inside);
    }

    /// Goes to the ends; where a formula of time switches, other modes hold from there on.
    fn arrive(&mut self) {
        let limits: Lanes = std::array::from_fn(|lane| self.lanes[lane].now.until(self.lanes[lane].target()).max(0.0));
        let ended = std::mem::replace(&mut self.before, std::mem::take(&mut self.next));
        self.next = ended;
        // before: the ends; what stands here are the starts
        let [x, low, turns] = &mut self.before;
        std::mem::swap(&mut self.x, x);
        std::mem::swap(&mut self.low, low);
        std::mem::swap(&mut self.turns, turns);
        let mut switched = Vec::new();
        for (lane, own) in self.lanes.iter_mut().enumerate() {
            if own.state != State::Under {
                continue;
            }
            let h = self.lengths[lane];
            let target = own.target();
            let (lands, full) = own.lands(h, limits[lane]);
            (own.start, own.now) = (own.now, lands);
            own.steps += 1;
            if !full {
                continue;
            }
            if target >= own.until {
                own.state = State::Done;
                // the end is no switch
                continue;
            }
            if let Some((_, modes)) = own.switches.pop_front() {
                own.modes = modes;
                switched.push(lane);
            }
        }
        for lane in &switched {
            self.series.set_modes(*lane, &self.lanes[*lane].modes);
        }
        if switched.is_empty() {
            return;
        }
        let before: Vec<Lanes> = self.values.prescribed().copied().collect();
        self.evaluate_here();
        for lane in switched {
            self.checks.switch(lane, &self.values);
            let size = before.iter().chain(self.values.prescribed()).fold(0.0_f64, |m, v| m.max(v[lane].abs()));
            // velocities that jump strike, which is the business of the scalar path
            let jumps = before.iter().zip(self.values.prescribed()).any(|(a, b)| (a[lane] - b[lane]).abs() > JUMP * size);
            if jumps || !self.values.sound()[lane] {
                self.lanes[lane].state = State::Lost;
            }
        }
    }

    fn take_turns_off(&mut self, lane: usize) {
        for k in 0..self.freely.len() {
            let i = self.freely[k];
            reduce(&mut self.x[i][lane], &mut self.low[i][lane], &mut self.turns[i][lane]);
        }
    }

    /// The last step of a lane as the scalar path has it; its modes are those before a switch at its end.
    pub(crate) fn step(&self, lane: usize, modes: &[Mode], into: &mut Step) {
        let own = &self.lanes[lane];
        into.begin_lane((own.start, own.now, self.lengths[lane]), self.rule.order, modes);
        let [x, low, turns] = &self.before;
        let turning = self.freely.iter().any(|i| turns[*i][lane] != 0.0);
        for i in 0..x.len() {
            into.push_lane(self.series.state(i).iter().map(|c| c[lane]), low[i][lane]);
            if turning {
                into.push_turns(turns[i][lane]);
            }
        }
    }

    /// The state of a lane with its turns.
    pub(crate) fn shown(&self, lane: usize, into: &mut [f64]) {
        for (i, shown) in into.iter_mut().enumerate() {
            *shown = self.x[i][lane];
        }
        for &i in &self.freely {
            let [high, low] = taken(self.turns[i][lane]);
            into[i] = high + (self.x[i][lane] + (self.low[i][lane] + low));
        }
    }

    /// The modes of a lane.
    pub(crate) fn modes(&self, lane: usize) -> &[Mode] {
        &self.lanes[lane].modes
    }
}

/// Takes whole turns, four at a time, off an angle that has grown large; see `integrate::taylor::turns`.
#[inline]
fn reduce(x: &mut f64, low: &mut f64, turns: &mut f64) {
    let count = (*x / FOUR_TURNS[0]).trunc();
    if count == 0.0 || count.is_nan() || count.abs() > MOST_TURNS {
        return;
    }
    let high = count * FOUR_TURNS[0];
    let cut = count.mul_add(FOUR_TURNS[0], -high);
    let (rest, lost) = two_sum(*x, -high);
    (*x, *low) = two_sum(rest, lost + (*low - (cut + count * FOUR_TURNS[1])));
    *turns += count;
}
