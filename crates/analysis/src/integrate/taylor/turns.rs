//! Angles that only turn are kept small: whole turns are taken off and counted.
//!
//! An angle of 10 000 turns has an ulp of 7e-12; the sines in the equations would see every step's rounding, and a conservative machine would gain or lose
//! energy by it. Four turns at a time are taken off: 8π, high part exactly, low part into what the flow carries beside the state.

use super::flow::Flow;
use crate::System;
use crate::integrate::step::{FOUR_TURNS, taken};
use algebra::sum::two_sum;

/// More than so many at once would lose the digits that are to be kept.
pub(crate) const MOST_TURNS: f64 = 1024.0;

impl<S: System + ?Sized> Flow<'_, S> {
    /// Finds the angles to watch.
    pub(super) fn watch_turns(&mut self) {
        self.freely = (0..self.x.len()).filter(|&i| self.system.turns_freely(i)).collect();
        self.turns = vec![0.0; self.x.len()];
        self.shown.clone_from(&self.x);
    }

    /// Takes whole turns off the angles that have grown large; what was expanded there no longer belongs to the state.
    pub(super) fn take_turns_off(&mut self) {
        for k in 0..self.freely.len() {
            let i = self.freely[k];
            let count = (self.x[i] / FOUR_TURNS[0]).trunc();
            if count == 0.0 || count.abs() > MOST_TURNS {
                continue;
            }
            // a whole number of at most 11 bits: the product is cut by less than an ulp of the large angle, which the remainder returns
            let high = count * FOUR_TURNS[0];
            let cut = count.mul_add(FOUR_TURNS[0], -high);
            let (rest, lost) = two_sum(self.x[i], -high);
            let (x, low) = two_sum(rest, lost + (self.low[i] - (cut + count * FOUR_TURNS[1])));
            (self.x[i], self.low[i]) = (x, low);
            self.turns[i] += count;
            self.expanded = false;
        }
    }

    /// What was taken off state `i`.
    fn taken(&self, i: usize) -> [f64; 2] {
        taken(self.turns[i])
    }

    /// Tells the dense output of a step what was taken off.
    pub(super) fn note_turns(&mut self) {
        self.step.turned.clear();
        if self.turns.iter().any(|n| *n != 0.0) {
            for i in 0..self.x.len() {
                let taken = self.taken(i);
                self.step.turned.push(taken);
            }
        }
    }

    /// The state with its turns.
    pub(super) fn show_turns(&mut self) {
        self.shown.clone_from(&self.x);
        for k in 0..self.freely.len() {
            let i = self.freely[k];
            let [high, low] = self.taken(i);
            self.shown[i] = high + (self.x[i] + (self.low[i] + low));
        }
    }

    /// A state of the present step with its turns.
    pub(super) fn with_turns(&self, x: &[f64]) -> Vec<f64> {
        let mut shown = x.to_vec();
        for &i in &self.freely {
            let [high, low] = self.taken(i);
            shown[i] = high + (x[i] + low);
        }
        shown
    }
}
