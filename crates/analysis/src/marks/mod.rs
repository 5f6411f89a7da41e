//! What a motion does between the rows of its table: least and greatest values, and instants at which a formula passes zero.
//!
//! Both look at the dense output after a step is accepted and leave the motion alone. A state is a polynomial of the step. Any other quantity f is
//! sampled along the step and replaced by the polynomial through its values at Chebyshev's points ([`proxy`]), on parts so short that no operation
//! behind f hides anything between the points (`behind.rs`); sign changes of the polynomial, or of its derivative, are isolated in Bernstein's form
//! ([`crossings`]), so that none is missed down to the rounding of its coefficients; an instant is then polished on f itself. The same polynomials give
//! integrals, hence means and works.

pub(crate) mod behind;
pub(crate) mod course;
pub mod crossings;
pub mod extremes;
pub mod named;
pub mod proxy;
pub mod pushes;

use std::sync::Arc;

use program::Behind;

use crate::taylor::Step;
use crate::{System, dataset::Extreme};
use proxy::Source;

/// A quantity along a step: which outputs, and room to evaluate them.
pub(crate) struct Along<'a, S: ?Sized> {
    step: &'a Step,
    system: &'a mut S,
    /// Where the motion ends inside the step, or the step's length.
    pub length: f64,
    x: Vec<f64>,
    all: Vec<f64>,
}

impl<'a, S: System + ?Sized> Along<'a, S> {
    /// The step from its start to `length`.
    pub fn new(step: &'a Step, system: &'a mut S, length: f64) -> Along<'a, S> {
        let (n_x, n_out) = (system.states().len(), system.outputs().len());
        Along { step, system, length, x: vec![0.0; n_x], all: vec![0.0; n_out] }
    }

    /// Time at `tau` after the start of the step.
    pub fn time(&self, tau: f64) -> f64 {
        self.step.instant(tau).high
    }

    /// All outputs at `tau`; not numbers where they have no value.
    pub fn outputs(&mut self, tau: f64) -> &[f64] {
        self.step.state_after(tau, &mut self.x);
        let t = self.time(tau);
        if self.system.observe(t, &self.x, &self.step.modes, &mut self.all).is_err() {
            self.all.fill(f64::NAN);
        }
        &self.all
    }

    /// Coefficients of a state.
    pub fn polynomial(&self, state: usize) -> &'a [f64] {
        self.step.coefficients(state)
    }

    /// A state at the start, with its whole turns.
    pub fn start(&self, state: usize) -> f64 {
        self.step.start_value(state)
    }

    /// All states at `tau`.
    pub fn whole_state(&mut self, tau: f64) -> Vec<f64> {
        self.step.state_after(tau, &mut self.x);
        self.x.clone()
    }

    /// A state at `tau`.
    pub fn state(&mut self, state: usize, tau: f64) -> f64 {
        self.step.state_after(tau, &mut self.x);
        self.x[state]
    }
}

impl<S: System + ?Sized> Source for Along<'_, S> {
    fn sample(&mut self, tau: f64) -> Vec<f64> {
        self.step.state_after(tau, &mut self.x);
        let (t, mut row) = (self.time(tau), Vec::new());
        if self.system.sample(t, &self.x, &self.step.modes, &mut row).is_err() {
            row.fill(f64::NAN);
            row.resize(self.all.len() + self.system.behind().width(), f64::NAN);
        }
        row
    }

    fn rounding(&mut self, tau: f64) -> Vec<f64> {
        self.step.state_after(tau, &mut self.x);
        let (t, mut row) = (self.time(tau), Vec::new());
        // a polynomial is rounded like its terms
        let size = |i: usize| self.polynomial(i).iter().rev().fold(0.0, |sum, c| sum * self.length + c.abs());
        let errors: Vec<f64> = (0..self.x.len()).map(|i| f64::EPSILON * size(i)).collect();
        self.system.rounding((t, &self.x), &self.step.modes, &errors, &mut row);
        row
    }

    fn behind(&mut self) -> (usize, Arc<Behind>) {
        (self.all.len(), self.system.behind())
    }

    fn resolution(&self) -> f64 {
        4.0 * f64::EPSILON * self.time(self.length).abs()
    }
}

/// Root of f in [a, b], where it changes its sign: the secant with halved weight (Illinois), kept to halving every third time.
pub(crate) fn bracketed(f: &mut dyn FnMut(f64) -> f64, (mut a, mut fa): (f64, f64), (mut b, mut fb): (f64, f64)) -> f64 {
    for i in 0..120 {
        let secant = b - fb * (b - a) / (fb - fa);
        let c = if i % 3 == 2 || !(secant > a && secant < b) { 0.5 * (a + b) } else { secant };
        if c <= a || c >= b || b - a <= f64::EPSILON * b.abs() {
            break;
        }
        let fc = f(c);
        if fc == 0.0 || fc.is_nan() {
            return c;
        }
        if (fc > 0.0) == (fb > 0.0) {
            (b, fb, fa) = (c, fc, 0.5 * fa);
        } else {
            (a, fa, fb) = (c, fc, 0.5 * fb);
        }
    }
    if fa.abs() < fb.abs() { a } else { b }
}

/// Empty extremes of the columns with these indices.
pub(crate) fn unknown(columns: usize) -> Vec<Extreme> {
    let none = Extreme { min: f64::INFINITY, max: f64::NEG_INFINITY, ..Extreme::default() };
    (0..columns).map(|j| Extreme { column: j + 1, ..none.clone() }).collect()
}
