//! What a motion does between the rows of its table: least and greatest values, and instants at which a formula passes zero.
//!
//! Both look at the dense output after a step is accepted and leave the motion alone. A state is a polynomial of the step. Any other quantity f is
//! sampled along the step and replaced by the polynomial through its values at Chebyshev's points ([`crate::proxies::proxy`]), on parts so short that no operation
//! behind f hides anything between the points (`behind.rs`); sign changes of the polynomial, or of its derivative, are isolated in Bernstein's form
//! ([`crossings`]), so that none is missed down to the rounding of its coefficients; an instant is then polished on f itself. The same polynomials give
//! integrals, hence means and works.

pub(crate) mod bridge;
pub(crate) mod course;
pub mod crossings;
pub mod endless;
pub mod extremes;
pub mod named;
mod peaks;
pub mod pushes;
mod search;
pub mod windows;

use std::borrow::Cow;
use std::sync::Arc;

use program::Behind;

use crate::integrate::Step;
use crate::proxies::proxy::Source;
use crate::{Fault, GuardKind, System};
use bridge::Bridge;

/// Samples of a step that are kept: those of its whole length.
const KNOWN: usize = 17;

/// Share of its size by which rounding has moved a state; the bound of what follows from it has a slack of its own.
const DRIFTED: f64 = 8.0 * f64::EPSILON;

/// Share of a step on either side of a place without values that is bridged: far enough for digits where M is singular like the square of the distance, and so near that
/// a cubic leaves twelve of them.
const AROUND: f64 = 1e-3;

/// A quantity along a step: which outputs, and room to evaluate them.
pub(crate) struct Along<'a, S: ?Sized> {
    step: &'a Step,
    system: &'a mut S,
    /// Where a part of the step begins and ends, when not all of it is looked at.
    part: Option<[f64; 2]>,
    /// Where the motion ends inside the step, or the length of the step or of its part.
    pub length: f64,
    x: Vec<f64>,
    all: Vec<f64>,
    /// The first samples of the step, by tau: events, contacts and extremes ask for the same.
    known: Vec<(f64, Vec<f64>)>,
    /// Over the last place at which values followed from no equation.
    bridge: Option<Bridge>,
}

/// What the equations say at a place.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Given {
    Values,
    Nothing,
}

impl<'a, S: System + ?Sized> Along<'a, S> {
    /// The step from its start to `length`.
    pub fn new(step: &'a Step, system: &'a mut S, length: f64) -> Along<'a, S> {
        let (n_x, n_out) = (system.states().len(), system.outputs().len());
        Along { step, system, part: None, length, x: vec![0.0; n_x], all: vec![0.0; n_out], known: Vec::new(), bridge: None }
    }

    /// The part of a step between two places; every `tau` counts from the first.
    pub fn part(step: &'a Step, system: &'a mut S, [from, to]: [f64; 2]) -> Along<'a, S> {
        Along { part: Some([from, to]), ..Along::new(step, system, to - from) }
    }

    /// The place in the step of what is `tau` from the start of the part; its end exactly.
    fn place(&self, tau: f64) -> f64 {
        place(self.part, self.length, tau)
    }

    /// Time at `tau` after the start.
    pub fn time(&self, tau: f64) -> f64 {
        self.step.instant(self.place(tau)).high
    }

    /// Time of what is `tau` after the start, apart from what is sampled.
    fn clock(&self) -> impl Fn(f64) -> f64 + use<'a, S> {
        let (step, part, length) = (self.step, self.part, self.length);
        move |tau| step.instant(place(part, length, tau)).high
    }

    /// All outputs at `tau`; not numbers where they have no value.
    pub fn outputs(&mut self, tau: f64) -> &[f64] {
        let mut row = std::mem::take(&mut self.all);
        let given = self.observe_at(self.place(tau), &mut row);
        self.bridged(tau, &mut row, given);
        self.all = row;
        &self.all
    }

    /// Outputs at a place of the step as the equations give them.
    fn observe_at(&mut self, place: f64, row: &mut [f64]) -> Given {
        self.step.state_after(place, &mut self.x);
        let t = self.step.instant(place).high;
        if self.system.observe(t, &self.x, &self.step.modes, row).is_ok() {
            return Given::Values;
        }
        row.fill(f64::NAN);
        Given::Nothing
    }

    /// Outputs, and all that is behind them, at a place of the step as the equations give them.
    fn sample_at(&mut self, place: f64, row: &mut Vec<f64>) -> Given {
        self.step.state_after(place, &mut self.x);
        let t = self.step.instant(place).high;
        if self.system.sample(t, &self.x, &self.step.modes, row).is_ok() {
            return Given::Values;
        }
        row.fill(f64::NAN);
        row.resize(self.all.len() + self.system.behind().width(), f64::NAN);
        Given::Nothing
    }

    /// Replaces what the equations do not give at `tau`, beside a change point or where the coordinates are singular, by what both sides give.
    fn bridged(&mut self, tau: f64, row: &mut [f64], given: Given) {
        let place = self.place(tau);
        let change = self.step.around_change_point(place);
        if given == Given::Values && change.is_none() {
            return;
        }
        if self.bridge.as_ref().is_none_or(|bridge| !bridge.covers(place)) {
            let Some(stretch) = change.or_else(|| self.stretch(place)) else { return };
            let off = self.rounding_at(Bridge::beside(stretch));
            self.bridge = Bridge::new(stretch, |place| self.side(place)).ok().map(|bridge| bridge.within(off));
        }
        let Some(bridge) = self.bridge.as_ref().filter(|bridge| bridge.covers(place)) else { return };
        let outputs = self.system.outputs().len();
        for (k, value) in row.iter_mut().enumerate() {
            // a state is a polynomial whatever the forces are
            let state = Some(k).filter(|k| *k < outputs).and_then(|k| self.system.state_of(k)).map(|i| self.step.value_after(i, place));
            *value = state.or_else(|| bridge.value(k, place)).unwrap_or(*value);
        }
    }

    /// What is bridged about a place at which nothing has a value, where both sides lie in the step.
    fn stretch(&self, place: f64) -> Option<[f64; 2]> {
        let around = AROUND * self.step.length;
        (place >= 2.0 * around && place + 2.0 * around <= self.step.length).then_some([place, around])
    }

    /// Rounding of the outputs at a place of the step.
    fn rounding_at(&mut self, place: f64) -> Vec<f64> {
        // a polynomial is rounded like its terms
        self.off_by(place, |c, length| f64::EPSILON * size(c, length))
    }

    /// How far the outputs are off at a place where a state is off by so much of its polynomial over the length.
    fn off_by(&mut self, place: f64, error: impl Fn(&[f64], f64) -> f64) -> Vec<f64> {
        self.step.state_after(place, &mut self.x);
        let (t, mut row) = (self.step.instant(place).high, Vec::new());
        let errors: Vec<f64> = (0..self.x.len()).map(|i| error(&self.polynomial(i), self.length)).collect();
        self.system.rounding((t, &self.x), &self.step.modes, &errors, &mut row);
        row
    }

    /// A row beside what is bridged, conditions kept.
    fn side(&mut self, place: f64) -> Result<Vec<f64>, Fault> {
        let t = self.step.instant(place).high;
        self.step.state_after(place, &mut self.x);
        self.system.project(t, &mut self.x, &self.step.modes)?;
        let mut row = Vec::new();
        self.system.sample(t, &self.x, &self.step.modes, &mut row)?;
        Ok(row)
    }

    /// Coefficients of a state.
    pub fn polynomial(&self, state: usize) -> Cow<'a, [f64]> {
        let c = self.step.coefficients(state);
        self.part.map_or(Cow::Borrowed(c), |[from, _]| Cow::Owned(moved(c, from)))
    }

    /// A state at the start, with its whole turns.
    pub fn start(&self, state: usize) -> f64 {
        self.part.map_or_else(|| self.step.start_value(state), |[from, _]| self.step.value_after(state, from))
    }

    /// All states at `tau`.
    pub fn whole_state(&mut self, tau: f64) -> Vec<f64> {
        self.step.state_after(self.place(tau), &mut self.x);
        self.x.clone()
    }

    /// A state at `tau`.
    pub fn state(&self, state: usize, tau: f64) -> f64 {
        self.step.value_after(state, self.place(tau))
    }
}

/// Outputs along a piece of a motion, sampled and one by one.
pub(crate) trait Line: Source {
    /// Where the piece ends.
    fn length(&self) -> f64;
    /// Time at `tau` after its start, s.
    fn instant(&self, tau: f64) -> f64;
    /// An output at `tau`; not a number where it has no value.
    fn output(&mut self, tau: f64, output: usize) -> f64;
    /// What an output may be off by where the states are those of a long motion; empty when unknown.
    fn doubt(&mut self, tau: f64) -> Vec<f64>;
    /// Whether contacts may close in the motion.
    fn has_contacts(&self) -> bool;
}

impl<S: System + ?Sized> Line for Along<'_, S> {
    fn length(&self) -> f64 {
        self.length
    }
    fn instant(&self, tau: f64) -> f64 {
        self.time(tau)
    }
    fn output(&mut self, tau: f64, output: usize) -> f64 {
        self.outputs(tau)[output]
    }
    fn doubt(&mut self, tau: f64) -> Vec<f64> {
        let (place, instant) = (self.place(tau), f64::EPSILON * self.time(tau).abs());
        self.off_by(place, |c, length| DRIFTED * size(c, length) + instant * slope(c, length))
    }
    fn has_contacts(&self) -> bool {
        self.system.guards().iter().any(|guard| matches!(guard.kind, GuardKind::Contact { .. }))
    }
}

impl<S: System + ?Sized> Source for Along<'_, S> {
    fn sample(&mut self, tau: f64) -> Vec<f64> {
        if let Some((_, row)) = self.known.iter().find(|(at, _)| *at == tau) {
            return row.clone();
        }
        let mut row = Vec::new();
        let given = self.sample_at(self.place(tau), &mut row);
        self.bridged(tau, &mut row, given);
        if self.known.len() < KNOWN {
            self.known.push((tau, row.clone()));
        }
        row
    }

    fn value(&mut self, tau: f64, of: usize) -> f64 {
        self.outputs(tau)[of]
    }

    fn rounding(&mut self, tau: f64) -> Vec<f64> {
        self.rounding_at(self.place(tau))
    }

    fn behind(&mut self) -> (usize, Arc<Behind>) {
        (self.all.len(), self.system.behind())
    }

    fn resolution(&self) -> f64 {
        4.0 * f64::EPSILON * self.time(self.length).abs()
    }
}

/// The place in a step of what is `tau` from the start of the part; the end of the part exactly.
fn place(part: Option<[f64; 2]>, length: f64, tau: f64) -> f64 {
    match part {
        None => tau,
        Some([_, to]) if tau == length => to,
        Some([from, _]) => from + tau,
    }
}

/// The coefficients of Σ c_k τ^k about `from`: Horner's scheme, again and again (Taylor's shift).
fn moved(c: &[f64], from: f64) -> Vec<f64> {
    let mut c = c.to_vec();
    for k in 0..c.len() {
        for i in (k..c.len() - 1).rev() {
            c[i] += from * c[i + 1];
        }
    }
    c
}

/// Σ k |c_k| h^(k-1).
fn slope(c: &[f64], h: f64) -> f64 {
    c.iter().enumerate().skip(1).rev().fold(0.0, |sum, (k, c)| sum * h + k as f64 * c.abs())
}

/// Σ |c_k| h^k.
fn size(c: &[f64], h: f64) -> f64 {
    c.iter().rev().fold(0.0, |sum, c| sum * h + c.abs())
}

/// Root of f in [a, b], where it changes its sign: the secant, of an end that stays with halved weight (Illinois), and the middle where three values have not
/// brought the ends four times nearer. Where the secant meets an end the root is there to rounding: a place beside that end, at twice the distance of the last
/// time, closes it in.
///
/// *Source*: M. Dowell, P. Jarratt, A modified regula falsi method for computing the root of an equation, BIT 11 (1971) 168-174.
pub(crate) fn bracketed(f: &mut dyn FnMut(f64) -> f64, (mut a, mut fa): (f64, f64), (mut b, mut fb): (f64, f64)) -> f64 {
    let (mut weights, mut beside, mut width) = ([fa, fb], 1.0, b - a);
    let mut kept = None;
    for i in 0..120 {
        let slow = i % 3 == 2 && b - a > 0.25 * width;
        width = if i % 3 == 2 { b - a } else { width };
        let tick = beside * f64::EPSILON * a.abs().max(b.abs());
        let secant = b - weights[1] * (b - a) / (weights[1] - weights[0]);
        let (low, high) = (a + tick, b - tick);
        let c = if slow || secant.is_nan() || low >= high { 0.5 * (a + b) } else { secant.clamp(low, high) };
        beside *= if c == low || c == high { 2.0 } else { 1.0 };
        if c <= a || c >= b || b - a <= f64::EPSILON * b.abs() {
            break;
        }
        let fc = f(c);
        if fc == 0.0 || fc.is_nan() {
            return c;
        }
        let end = usize::from((fc > 0.0) == (fb > 0.0));
        if end == 1 {
            (b, fb) = (c, fc)
        } else {
            (a, fa) = (c, fc)
        }
        weights[end] = fc;
        weights[1 - end] *= if kept == Some(1 - end) { 0.5 } else { 1.0 };
        kept = Some(1 - end);
    }
    if fa.abs() < fb.abs() { a } else { b }
}

#[cfg(test)]
mod tests {
    use super::bracketed;

    /// Number of values and place, for a function that changes its sign between a and b.
    fn root(f: impl Fn(f64) -> f64, a: f64, b: f64) -> (u32, f64) {
        let mut count = 0;
        let ends = [f(a), f(b)];
        let mut counted = |x: f64| {
            count += 1;
            f(x)
        };
        let x = bracketed(&mut counted, (a, ends[0]), (b, ends[1]));
        (count, x)
    }

    #[test]
    fn a_root_is_met_to_rounding_in_few_values() {
        type Case = (fn(f64) -> f64, f64, f64, f64);
        let cases: [Case; 4] = [
            (|x| x.cos(), 0.0, 3.0, std::f64::consts::FRAC_PI_2),
            (|x| x.powi(3) - 2.0, 0.0, 8.0, 2.0_f64.cbrt()),
            (|x| (20.0 * (x - 0.7)).tanh(), 0.0, 1.0, 0.7),
            (|x| x.exp() - 1e-9_f64.exp(), 0.0, 1.0, 1e-9),
        ];
        for (f, a, b, exact) in cases {
            let (count, x) = root(f, a, b);
            // a value of f is known to eps, and so is its zero beside 1
            assert!((x - exact).abs() <= 4.0 * f64::EPSILON * exact.max(f64::from(u8::from(exact < 1e-3))), "{x} {exact}");
            assert!(count <= 30, "{count} for {exact}");
        }
    }

    #[test]
    fn a_jump_and_a_flat_root_are_closed_in() {
        let (_, x) = root(|x| if x < 0.3 { -1.0 } else { 5.0 }, 0.0, 1.0);
        assert!((x - 0.3).abs() <= 4.0 * f64::EPSILON);
        let (count, x) = root(|x| (x - 0.4).powi(5), 0.0, 1.0);
        // a zero of fifth order is closed in by halving: as far as the count allows
        assert!((x - 0.4).abs() < 1e-9 && count <= 120);
    }
}
