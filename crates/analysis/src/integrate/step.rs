//! One accepted step: the Taylor polynomials of all states, which are the dense output.

use super::series::Series;
use crate::system::Motions;
use crate::{Mode, System};
use algebra::lanes;
use algebra::sum::Instant;
use program::{ABREAST, Lanes};

/// States whose polynomials are evaluated side by side: enough to hide that a product and a sum take some four cycles each.
const SIDE_BY_SIDE: usize = 4;
/// Share of the surroundings of a change point in which no force follows from the equations.
const IN_IT: f64 = 1e-3;
/// Share of the way to a change point, on both its sides, on which forces have fewer digits than audits ask for.
const BESIDE: f64 = 0.7;
/// Share of the largest component (or of the largest change) of a unit below which a smaller one of that unit is not resolved relatively.
pub(crate) const UNIT_SHARE: f64 = 1e-8;

/// 8π as a sum of two machine numbers.
pub(crate) const FOUR_TURNS: [f64; 2] = [8.0 * std::f64::consts::PI, 8.0 * 1.224_646_799_147_353_2e-16];

/// So many times four turns, high and low part.
pub(crate) fn taken(count: f64) -> [f64; 2] {
    let high = count * FOUR_TURNS[0];
    [high, count.mul_add(FOUR_TURNS[0], -high) + count * FOUR_TURNS[1]]
}

/// Taylor polynomials of a step, x_i(start + tau) = sum_k c_ik tau^k for 0 <= tau <= length.
#[derive(Clone, Debug, Default)]
pub struct Step {
    /// Where it begins.
    pub start: Instant,
    /// Length.
    pub length: f64,
    /// Where it ends: what must be hit exactly is hit, where start + length is off by rounding.
    pub(super) ends: Instant,
    /// Order of the polynomials.
    pub order: usize,
    /// Modes of the guards, constant inside the step.
    pub modes: Vec<Mode>,
    /// Whether the polynomials are those of the implicit method.
    pub implicit: bool,
    /// Coefficients, row i = state i, order + 1 each.
    pub(super) states: Series,
    /// Coefficients of the guards.
    pub(crate) guards: Series,
    /// What rounding cut from the state at the start; added to every value.
    pub(super) low: Vec<f64>,
    /// Full turns taken off the state, high and low part; empty when none.
    pub(super) turned: Vec<[f64; 2]>,
    /// A change point within it, closely behind its start (negative) or its end: how far it is, and how far around it conditions have too few digits to be closed or to
    /// give forces.
    pub(crate) change: Option<[f64; 2]>,
}

impl Step {
    /// Copies the last expansion of `system`.
    pub(super) fn take<S: System + ?Sized>(&mut self, system: &S, n_states: usize, n_guards: usize, order: usize) {
        self.order = order;
        self.implicit = false;
        self.states.reset(order + 1);
        self.guards.reset(order + 1);
        for i in 0..n_states {
            self.states.push(system.state(i));
        }
        for i in 0..n_guards {
            self.guards.push(system.guard(i));
        }
    }

    /// Begins a step that comes from a lane of an ensemble: start, end and length.
    pub(crate) fn begin_lane(&mut self, (start, ends, length): (Instant, Instant, f64), order: usize, modes: &[Mode]) {
        (self.start, self.ends, self.length, self.order) = (start, ends, length, order);
        self.modes.clear();
        self.modes.extend_from_slice(modes);
        self.states.reset(order + 1);
        self.low.clear();
        self.turned.clear();
    }

    /// Adds a state: its coefficients, and what rounding cut from its start.
    pub(crate) fn push_lane(&mut self, coefficients: impl Iterator<Item = f64>, low: f64) {
        self.states.extend(coefficients);
        self.low.push(low);
    }

    /// Adds the whole turns that were taken off the next state, in units of four.
    pub(crate) fn push_turns(&mut self, count: f64) {
        self.turned.push(taken(count));
    }

    /// End of the step.
    pub fn end(&self) -> Instant {
        self.ends
    }

    /// An instant of the step; its end exactly.
    pub fn instant(&self, tau: f64) -> Instant {
        if tau == self.length { self.ends } else { self.start.after(tau) }
    }

    /// Leaves the first part of it.
    pub fn shorten(&mut self, length: f64) {
        (self.length, self.ends) = (length, self.instant(length));
    }

    /// Coefficients of a state.
    pub fn coefficients(&self, state: usize) -> &[f64] {
        self.states.row(state)
    }

    /// A state at the start, with the whole turns that were taken off.
    pub fn start_value(&self, state: usize) -> f64 {
        let own = self.states.row(state)[0];
        match self.turned.get(state) {
            Some([high, low]) => high + (own + low),
            None => own,
        }
    }

    /// Whether `tau` is so near to a change point that forces have too few digits there.
    pub fn is_blind(&self, tau: f64) -> bool {
        self.change.is_some_and(|[to, around]| (tau - to).abs() < around)
    }

    /// The change point, with its surroundings, where `tau` is all but in it and values on both sides lie in the step.
    pub fn at_change_point(&self, tau: f64) -> Option<[f64; 2]> {
        self.around_change_point(tau).filter(|[to, around]| (tau - to).abs() <= IN_IT * around)
    }

    /// The change point, with its surroundings, where `tau` lies in these and values on both sides lie in the step.
    pub fn around_change_point(&self, tau: f64) -> Option<[f64; 2]> {
        let [to, around] = self.change.filter(|_| self.is_blind(tau))?;
        let between = to - 2.0 * around >= 0.0 && to + 2.0 * around <= self.length;
        between.then_some([to, around])
    }

    /// The same length, or the start of the step in place of one near a change point.
    pub fn beside_change_point(&self, tau: f64) -> f64 {
        match self.change {
            Some([to, _]) if to < 0.0 || (tau - to).abs() < BESIDE * to => 0.0,
            _ => tau,
        }
    }

    /// State at an instant of the step.
    pub fn state_at(&self, t: f64, x: &mut [f64]) {
        self.state_after(self.start.until(t), x);
    }

    /// State at `tau` after the start of the step.
    pub fn state_after(&self, tau: f64, x: &mut [f64]) {
        self.increments(tau, x);
        for (i, x_i) in x.iter_mut().enumerate() {
            *x_i = self.whole(i, self.states.row(i)[0], *x_i);
        }
    }

    /// One state at `tau` after the start of the step.
    pub fn value_after(&self, i: usize, tau: f64) -> f64 {
        let c = self.states.row(i);
        self.whole(i, c[0], increment(c, tau))
    }

    /// State and its time derivative at `tau` after the start of the step, as [`Step::state_after`] and [`Step::rate_after`] give them.
    pub fn motion_after(&self, tau: f64, x: &mut [f64], rate: &mut [f64]) {
        self.increments_and_slopes(tau, x, rate);
        for (i, x_i) in x.iter_mut().enumerate() {
            *x_i = self.whole(i, self.states.row(i)[0], *x_i);
        }
    }

    /// [`Step::motion_after`] at several places, at most [`ABREAST`], bit for bit.
    pub fn motions_after(&self, taus: &[f64], motions: &mut Motions) {
        let (n, count) = (self.states.n_rows(), taus.len().min(ABREAST));
        motions.count = count;
        motions.x.resize(n, [0.0; ABREAST]);
        motions.rates.resize(n, [0.0; ABREAST]);
        let taus: Lanes = std::array::from_fn(|lane| taus.get(lane).copied().unwrap_or_default());
        motions.times = taus.map(|tau| self.instant(tau).high);
        for (i, (x, rate)) in motions.x.iter_mut().zip(&mut motions.rates).enumerate() {
            let c = self.states.row(i);
            let [values, slopes] = horner(&c[1..], &taus);
            *rate = std::array::from_fn(|lane| values[lane] + taus[lane] * slopes[lane]);
            let (first, rest) = (c[0], self.low[i]);
            let own: Lanes = std::array::from_fn(|lane| first + (values[lane] * taus[lane] + rest));
            *x = match self.turned.get(i) {
                Some([high, low]) => own.map(|own| high + (own + low)),
                None => own,
            };
        }
    }

    /// [`increment`] of every state. Horner's rule waits for its last sum at each coefficient, so several states are worked through side by side.
    fn increments(&self, tau: f64, into: &mut [f64]) {
        let mut groups = into.chunks_exact_mut(SIDE_BY_SIDE);
        let mut i = 0;
        for group in &mut groups {
            let rows: [&[f64]; SIDE_BY_SIDE] = std::array::from_fn(|lane| self.states.row(i + lane));
            let mut sums = [0.0; SIDE_BY_SIDE];
            for k in (1..rows[0].len()).rev() {
                for lane in 0..SIDE_BY_SIDE {
                    sums[lane] = sums[lane] * tau + rows[lane][k];
                }
            }
            group.iter_mut().zip(sums).for_each(|(change, sum)| *change = sum * tau);
            i += SIDE_BY_SIDE;
        }
        for (k, change) in groups.into_remainder().iter_mut().enumerate() {
            *change = increment(self.states.row(i + k), tau);
        }
    }

    /// [`increment_and_slope`] of every state, side by side too.
    pub(super) fn increments_and_slopes(&self, tau: f64, changes: &mut [f64], slopes: &mut [f64]) {
        let mut i = 0;
        while i + SIDE_BY_SIDE <= changes.len() {
            let rows: [&[f64]; SIDE_BY_SIDE] = std::array::from_fn(|lane| self.states.row(i + lane));
            let (mut values, mut rates) = ([0.0; SIDE_BY_SIDE], [0.0; SIDE_BY_SIDE]);
            for k in (1..rows[0].len()).rev() {
                for lane in 0..SIDE_BY_SIDE {
                    rates[lane] = rates[lane] * tau + values[lane];
                    values[lane] = values[lane] * tau + rows[lane][k];
                }
            }
            for lane in 0..SIDE_BY_SIDE {
                (changes[i + lane], slopes[i + lane]) = (values[lane] * tau, values[lane] + tau * rates[lane]);
            }
            i += SIDE_BY_SIDE;
        }
        for i in i..changes.len() {
            (changes[i], slopes[i]) = increment_and_slope(self.states.row(i), tau);
        }
    }

    /// The value of a state from its coefficient 0 and its change.
    fn whole(&self, i: usize, first: f64, change: f64) -> f64 {
        match self.turned.get(i) {
            Some([high, low]) => high + ((first + (change + self.low[i])) + low),
            None => first + (change + self.low[i]),
        }
    }

    /// Time derivative of the state at an instant of the step, from the polynomials.
    pub fn rate_at(&self, t: f64, rate: &mut [f64]) {
        self.rate_after(self.start.until(t), rate);
    }

    /// The same at `tau` after the start of the step.
    pub fn rate_after(&self, tau: f64, rate: &mut [f64]) {
        for (i, r) in rate.iter_mut().enumerate() {
            *r = slope(self.states.row(i), tau);
        }
    }
}

/// x(tau) - x(0), Horner from the highest coefficient; the large constant term is kept out so that it cannot swallow digits.
#[inline]
pub(super) fn increment(c: &[f64], tau: f64) -> f64 {
    c[1..].iter().rev().fold(0.0, |sum, &c_k| sum * tau + c_k) * tau
}

/// x(tau) - x(0) and x'(tau) in one pass: x = x(0) + tau V(tau) gives x' = V + tau V'.
#[inline]
pub(crate) fn increment_and_slope(c: &[f64], tau: f64) -> (f64, f64) {
    let (mut value, mut rate) = (0.0, 0.0);
    for &c_k in c[1..].iter().rev() {
        rate = rate * tau + value;
        value = value * tau + c_k;
    }
    (value * tau, value + tau * rate)
}

/// The polynomial with these coefficients, and its derivative, at several places.
fn horner(c: &[f64], taus: &Lanes) -> [Lanes; 2] {
    let (mut values, mut slopes) = ([0.0; ABREAST], [0.0; ABREAST]);
    let groups = values.as_chunks_mut().0.iter_mut().zip(slopes.as_chunks_mut().0).zip(taus.as_chunks().0);
    groups.for_each(|((value, slope), taus)| [*value, *slope] = lanes::horner(c, taus));
    [values, slopes]
}

/// x'(tau).
#[inline]
pub(super) fn slope(c: &[f64], tau: f64) -> f64 {
    increment_and_slope(c, tau).1
}

/// sum k |c_k| tau^(k-1): how large the terms are that meet in x'.
pub(super) fn slope_size(c: &[f64], tau: f64) -> f64 {
    (1..c.len()).rev().fold(0.0, |sum, k| sum * tau + k as f64 * c[k].abs())
}
