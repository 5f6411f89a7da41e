//! Jets: Taylor coefficients of the motion about a state.
//!
//! Every register r(t) of the dynamics is kept as a row of coefficients r_0, r_1, ... with r(t + h) = Σ r_k h^k. Order by order, each
//! operation gives its k-th coefficient from coefficients already known (the recurrences stand in `recurrences.rs`), and x' = f gives
//! x_{k+1} = f_k/(k+1). After N orders all states are polynomials of degree N (Jorba and Zou, A software package for the numerical
//! integration of ODEs by means of high-order Taylor methods, Experimental Mathematics 14, 2005).
//!
//! Memory: one vector. A row is stored twice, forwards and backwards, so that the Cauchy product Σ a_j b_{k-j} is a plain scalar
//! product of two contiguous runs. Runs are rounded up to whole groups of four; the backward copy is followed by zeros, which cancel
//! what the forward copy holds beyond order k (finite leftovers of earlier expansions). Sums have a fixed order, so results are the
//! same bits on every machine.

pub(crate) mod faithful;
mod plan;
mod recurrences;
pub(crate) mod steps;

use crate::guard::needed;
use crate::interpret::defective;
use crate::{Bound, Evaluator, Fault, Mode, NO_SERIES, NOT_FINITE, Operation, Point, Register, Unary};
use faithful::{Watch, Watched};
use plan::Plan;
use recurrences::Memory;
use steps::{Row, Step};
use words::Text;

/// What is nearer in time than this share of it is now: an instant is known to some units in its last place.
pub const RESOLUTION: f64 = 32.0 * f64::EPSILON;

/// Taylor expander of the dynamics, with its memory.
#[derive(Clone, Debug)]
pub struct Jets {
    plan: Plan,
    memory: Memory,
    evaluator: Evaluator,
    /// Steps on the branches that the present modes take.
    live: Vec<Step>,
    /// Those of them that guards need: one order more is wanted there.
    tail: Vec<Step>,
    /// Rows of the guards among them.
    guards: Vec<Row>,
    /// Check of a step against what the operations do inside it.
    watch: Watch,
    modes: Option<Vec<Mode>>,
    order: usize,
    largest: usize,
}

impl Bound {
    /// A Taylor expander of the dynamics for orders up to `order`.
    pub fn jets(&self, order: usize) -> Jets {
        Jets::new(self, order)
    }
}

impl Jets {
    /// An expander with room for `order`; it makes more room when asked for a higher one. Memory that fits the order stays in the cache.
    pub fn new(bound: &Bound, order: usize) -> Jets {
        let evaluator = bound.dynamics.clone();
        let plan = Plan::new(&evaluator);
        let memory = Memory::new(&plan, order);
        let (live, tail, guards, watch) = (Vec::new(), Vec::new(), Vec::new(), Watch::default());
        Jets { plan, memory, evaluator, live, tail, guards, watch, modes: None, order: 0, largest: order }
    }

    /// Expands the solution through (t, x) to `order`.
    ///
    /// *Errors*: P008 for wrong lengths, a domain error (P001 to P004), P005 or P009 for a mass matrix that is not positive, P007 where a value exists but
    /// no Taylor series, P006 for overflow.
    pub fn expand(&mut self, time: f64, states: &[f64], modes: &[Mode], order: usize) -> Result<(), Fault> {
        let shape = self.evaluator.tape().shape;
        if states.len() != self.plan.states.len() || modes.len() != shape.modes {
            let words = format!("{}, {} / {}, {}", states.len(), modes.len(), self.plan.states.len(), shape.modes);
            return Err(Fault::about("P008", words));
        }
        self.make_room(order);
        self.choose_branches(modes);
        self.order = order;
        self.memory.at_zero.clear();
        self.begin(time, states);
        if self.advance(0) && !self.begins_at_zero(time) {
            return Ok(());
        }
        if self.keep_at_zero_with_slopes(time, states, modes) {
            return Ok(());
        }
        self.memory.at_zero.clear();
        let fault = self.blame(time, states, modes);
        self.modes = None;
        Err(fault)
    }

    /// Continues the last expansion to a higher `order` with the coefficients it has. The result is that of [`Jets::expand`], bit for bit, which is called where there is
    /// nothing to continue: another point, other modes, no room, a power that is kept constant at its zero.
    ///
    /// *Errors*: those of [`Jets::expand`].
    pub fn extend(&mut self, time: f64, states: &[f64], modes: &[Mode], order: usize) -> Result<(), Fault> {
        let (from, memory) = (self.order, &self.memory);
        let is_here = states.len() == self.plan.states.len()
            && memory.get(self.plan.time, 0).to_bits() == time.to_bits()
            && self.plan.states.iter().zip(states).all(|(row, x)| memory.get(*row, 0).to_bits() == x.to_bits());
        let goes_on = is_here && from > 0 && from <= order && order <= self.largest && memory.at_zero.is_empty();
        if goes_on && self.modes.as_deref() == Some(modes) {
            self.order = order;
            if self.advance(from) && !self.begins_at_zero(time) {
                return Ok(());
            }
            // what was left half done is no ground for sums that read beyond the order in hand
            self.modes = None;
        }
        self.expand(time, states, modes, order)
    }

    fn make_room(&mut self, order: usize) {
        if order > self.largest {
            self.largest = order;
            self.memory = Memory::new(&self.plan, order);
            self.modes = None;
        }
    }

    /// [`Jets::keep_at_zero`] with the slopes that tell how far an argument is from zero in time, which an expansion to order 1 lacks.
    fn keep_at_zero_with_slopes(&mut self, time: f64, states: &[f64], modes: &[Mode]) -> bool {
        let order = self.order;
        if order == 0 {
            return self.keep_at_zero(time, states, modes);
        }
        self.make_room(2);
        self.choose_branches(modes);
        self.order = order.max(2);
        let kept = self.keep_at_zero(time, states, modes);
        self.order = order;
        kept
    }

    /// The longest step, at most `h`, over which the coefficients of the last expansion say what every operation does, within `tolerance` of the
    /// largest value that it takes: nothing that is flat at its start stays hidden. A root or power at zero is kept constant for no less than the
    /// resolution of time.
    pub fn faithful(&mut self, h: f64, tolerance: f64) -> f64 {
        let time = self.memory.get(self.plan.time, 0);
        self.watch.faithful(self.memory.rows(self.order), h, tolerance, RESOLUTION * time.abs())
    }

    /// Whether [`Jets::faithful`] has found a root or power at zero, which the step keeps constant.
    pub fn holds_powers(&self) -> bool {
        self.watch.held
    }

    /// Operations whose step had to be divided by [`Jets::faithful`] since the modes changed.
    pub fn looks(&self) -> u64 {
        self.watch.looks
    }

    /// Whether a root or power is nearer to zero than time is resolved.
    fn begins_at_zero(&self, time: f64) -> bool {
        self.order > 1 && self.watch.nodes.iter().any(|n| n.is_power() && self.memory.get(n.a, 0) != 0.0 && self.is_near(n, time))
    }

    fn is_near(&self, node: &Watched, time: f64) -> bool {
        let (a, slope) = (self.memory.get(node.a, 0), self.memory.get(node.a, 1));
        a.abs() < RESOLUTION * time.abs() * slope.abs()
    }

    /// Expands once more with the roots and powers whose argument is zero up to rounding, or as near as time is resolved, kept constant; false when
    /// there is none, or one of a truly negative number. Negative ones are taken for zero first, because the slopes may depend on them.
    fn keep_at_zero(&mut self, time: f64, states: &[f64], modes: &[Mode]) -> bool {
        // the registers tell how large rounding may be, even where a result has no value
        let _ = self.evaluator.evaluate(&Point { time, states, modes: Some(modes), ..Point::default() });
        let powers: Vec<Watched> = self.watch.nodes.iter().filter(|n| n.is_power()).copied().collect();
        let rounded = |jets: &Jets, n: &Watched| jets.memory.get(n.a, 0).abs() <= jets.rounding_under(n);
        let (mut negative, mut near) = (Vec::new(), Vec::new());
        for node in powers {
            let a = self.memory.get(node.a, 0);
            if a < 0.0 {
                negative.push(node);
            } else if a > 0.0 && (self.order > 1 && self.is_near(&node, time) || rounded(self, &node)) {
                near.push(node);
            }
        }
        self.memory.defect = None;
        self.memory.at_zero = negative.iter().chain(&near).map(|n| n.c).collect();
        if self.memory.at_zero.is_empty() {
            return false;
        }
        // products read beyond the order in hand: what the first attempt left there must not be nan
        self.memory.clear(&self.plan, modes);
        self.begin(time, states);
        if !self.advance(0) {
            return false;
        }
        negative.iter().all(|n| self.order > 1 && self.is_near(n, time) || rounded(self, n))
    }

    /// Rounding of the argument of a power, by the last evaluation.
    fn rounding_under(&self, node: &Watched) -> f64 {
        let tape = self.evaluator.tape();
        let argument = tape.body.iter().find(|i| self.plan.row_of(i.into) == Some(node.c)).and_then(|i| match i.operation {
            Operation::Unary(Unary::SquareRoot, a) | Operation::Power(a, _) => Some(a),
            _ => None,
        });
        argument.map_or(0.0, |a| self.evaluator.rounding(a))
    }

    /// Coefficients x_i[0..=order] of state `i`.
    pub fn state(&self, i: usize) -> &[f64] {
        self.memory.row(self.plan.states[i], self.order)
    }

    /// Coefficients [0..order], one less than those of states, of the reaction `Program::solved[i]`. An expansion to order 0 gives none.
    pub fn reaction(&self, i: usize) -> &[f64] {
        &self.memory.row(self.plan.extra[i], self.order)[..self.order]
    }

    /// Coefficients [0..=order] of guard `i`; meaningless while the guard is not active.
    pub fn guard(&self, i: usize) -> &[f64] {
        self.memory.row(self.plan.guards[i], self.order)
    }

    /// The order of the last expansion.
    pub fn order(&self) -> usize {
        self.order
    }

    /// Multiplications that order k costs, and the number of steps, on the present branches.
    pub fn work(&self, k: usize) -> (usize, usize) {
        (self.live.iter().map(|s| s.multiplications(k, &self.plan)).sum(), self.live.len())
    }

    fn choose_branches(&mut self, modes: &[Mode]) {
        if self.modes.as_deref() == Some(modes) {
            return;
        }
        let (wanted, active) = needed(&self.evaluator, modes);
        self.live = self.plan.steps(modes, &wanted);
        self.tail = self.plan.guard_steps(&self.live, &active);
        self.guards = self.plan.active_guards(&self.tail);
        self.watch = Watch::new(self.plan.watched(&self.live), self.plan.count as usize);
        self.memory.clear(&self.plan, modes);
        self.modes = Some(modes.to_vec());
    }

    /// Takes the point to expand about.
    fn begin(&mut self, time: f64, states: &[f64]) {
        let memory = &mut self.memory;
        memory.defect = None;
        memory.start(self.plan.time, time, 1.0);
        for (row, x) in self.plan.states.iter().zip(states) {
            memory.put(*row, 0, *x);
        }
    }

    /// Fills all rows from order `from` on, those of guards up to the order of the states; false when something is not finite or the mass matrix is singular.
    fn advance(&mut self, from: usize) -> bool {
        let memory = &mut self.memory;
        let mut sound = true;
        for k in from..self.order {
            if k == 0 {
                self.live.iter().for_each(|step| memory.begin(step, &self.plan));
            } else {
                self.live.iter().for_each(|step| memory.advance(step, k, &self.plan));
            }
            sound &= memory.raise(&self.plan, k);
        }
        for step in &self.tail {
            match self.order {
                0 => memory.begin(step, &self.plan),
                k => memory.advance(step, k, &self.plan),
            }
        }
        sound && memory.defect.is_none() && self.guards_are_finite()
    }

    fn guards_are_finite(&self) -> bool {
        self.guards.iter().all(|row| self.memory.row(*row, self.order).iter().all(|v| v.is_finite()))
    }

    /// The cause of a failed expansion: at order 0 the interpreter knows it; above, the first step with sound operands and an unsound result.
    fn blame(&mut self, time: f64, states: &[f64], modes: &[Mode]) -> Fault {
        if let Some((row, defect)) = self.memory.defect {
            let tape = self.evaluator.tape();
            let into = tape.body.iter().map(|i| i.into).find(|into| self.plan.row_of(*into) == Some(row));
            return defective(tape, into.unwrap_or(Register(0)), defect);
        }
        let point = Point { time, states, modes: Some(modes), ..Point::default() };
        if let Err(fault) = self.evaluator.evaluate(&point) {
            return fault;
        }
        let tape = self.evaluator.tape().clone();
        let first = (1..=self.order).find_map(|k| {
            let step = self.live.iter().find(|s| !self.memory.get(s.row(), k).is_finite())?;
            tape.body.iter().find(|i| self.plan.row_of(i.into) == Some(step.row()))
        });
        let Some(instruction) = first else {
            return Fault::about(NOT_FINITE, tape.name.clone());
        };
        let code = match &instruction.operation {
            Operation::Unary(..) | Operation::Power(..) | Operation::Divide(..) | Operation::Atan2(..) => NO_SERIES,
            _ => NOT_FINITE,
        };
        let name = tape.roots.iter().find(|r| r.register >= instruction.into).map_or_else(String::new, |r| r.name.clone());
        Fault::new(code, &Text::same(name)).at(instruction.origin)
    }
}
