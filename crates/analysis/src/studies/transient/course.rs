//! Least, greatest and mean values of the closed form, phase by phase.

use std::sync::Arc;

use program::Behind;

use super::phase::{Phase, modes};
use super::walk::Walk;
use crate::dataset::{Column, Extreme, Overall};
use crate::marks::Line;
use crate::marks::course::Course;
use crate::proxies::proxy::{Proxies, Source};
use crate::{Mode, System};

/// Extremes, integrals and last values of the chosen outputs, with the rows of their table; the names of those that could not be followed everywhere come third.
pub(super) fn course<S: System + ?Sized>(
    system: &mut S,
    phases: &[Phase],
    chosen: &[usize],
    table: &[Column],
) -> (Vec<Extreme>, Vec<Overall>, Vec<String>) {
    let mut course = Course::new(chosen.len(), Proxies::default());
    let mut ends = [vec![f64::NAN; chosen.len()], vec![f64::NAN; chosen.len()]];
    for (i, phase) in phases.iter().enumerate() {
        let length = phase.end - phase.start;
        let mut closed = Closed { system, phase, chosen, walk: Walk::new(&phase.motion, length) };
        course.add(&mut closed, length, &|tau| phase.start + tau);
        if i == 0 {
            ends[0].copy_from_slice(&closed.sample(0.0)[..chosen.len()]);
        }
        ends[1].copy_from_slice(&closed.sample(length)[..chosen.len()]);
    }
    // of what is rounding every row has another value
    for (k, column) in table[1..].iter().enumerate() {
        table[0].values.iter().zip(&column.values).for_each(|(t, value)| course.offer(k, *t, *value));
    }
    let lost = course.lost().into_iter().map(|k| system.outputs()[chosen[k]].name.clone()).collect();
    (course.found(), course.overall([&ends[0], &ends[1]]), lost)
}

/// The closed form of a phase.
pub(super) struct Closed<'c, S: ?Sized> {
    pub(super) system: &'c mut S,
    pub(super) phase: &'c Phase,
    pub(super) chosen: &'c [usize],
    pub(super) walk: Walk<'c>,
}

impl<S: System + ?Sized> Closed<'_, S> {
    /// The state `tau` after the start of the phase, and its modes.
    fn there(&mut self, tau: f64) -> (Vec<f64>, Vec<Mode>) {
        let t = self.phase.start + tau;
        let turns = self.phase.form.turns.iter().map(|turn| turn.at(t));
        let x: Vec<f64> = self.walk.state(tau).into_iter().chain(turns).collect();
        let modes = modes(self.system, self.phase, t, &x);
        (x, modes)
    }
}

impl<S: System + ?Sized> Line for Closed<'_, S> {
    fn length(&self) -> f64 {
        self.phase.end - self.phase.start
    }
    fn instant(&self, tau: f64) -> f64 {
        self.phase.start + tau
    }
    fn output(&mut self, tau: f64, output: usize) -> f64 {
        self.chosen.iter().position(|c| *c == output).map_or(f64::NAN, |k| self.sample(tau)[k])
    }
    fn doubt(&mut self, _: f64) -> Vec<f64> {
        Vec::new()
    }
    fn has_contacts(&self) -> bool {
        false
    }
}

impl<S: System + ?Sized> Source for Closed<'_, S> {
    fn sample(&mut self, tau: f64) -> Vec<f64> {
        let (phase, t) = (self.phase, self.phase.start + tau);
        let (x, modes) = self.there(tau);
        phase.accelerate(self.system, t, &x);
        let count = self.system.outputs().len();
        let mut row = Vec::new();
        match self.system.sample(t, &x, &modes, &mut row) {
            Ok(()) => self.chosen.iter().map(|&i| row[i]).chain(row[count..].iter().copied()).collect(),
            Err(_) => vec![f64::NAN; self.chosen.len() + self.system.behind().width()],
        }
    }

    fn rounding(&mut self, tau: f64) -> Vec<f64> {
        let (x, modes) = self.there(tau);
        // a closed form is rounded like its value
        let errors: Vec<f64> = x.iter().map(|v| f64::EPSILON * v.abs()).collect();
        let mut row = Vec::new();
        self.system.rounding((self.phase.start + tau, &x), &modes, &errors, &mut row);
        self.chosen.iter().filter_map(|&i| row.get(i).copied()).collect()
    }

    fn behind(&mut self) -> (usize, Arc<Behind>) {
        (self.chosen.len(), Arc::new(self.system.behind().chosen(self.chosen)))
    }

    fn resolution(&self) -> f64 {
        4.0 * f64::EPSILON * self.phase.end.abs()
    }
}
