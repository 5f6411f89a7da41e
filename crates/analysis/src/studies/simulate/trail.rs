//! The way of a motion for pictures: states inside of each step, few enough for any motion.

use crate::dataset::Trail;
use crate::integrate::Step;

/// States of a step; it spans about a radian of the quickest oscillation.
const PARTS: usize = 8;
/// States that are kept: beyond them every second one goes, and from then on as many are passed over.
const MOST: usize = 30_000;

/// Takes the states.
#[derive(Clone, Debug)]
pub(super) struct Recorder {
    trail: Trail,
    /// Of so many states one is kept.
    stride: usize,
    /// States passed over since the last one.
    passed: usize,
    x: Vec<f64>,
    /// The end of the last step.
    end: f64,
}

impl Recorder {
    pub fn new(names: Vec<String>) -> Recorder {
        Recorder { x: vec![0.0; names.len()], trail: Trail { names, ..Trail::default() }, stride: 1, passed: 0, end: f64::NEG_INFINITY }
    }

    /// The states of a step up to `end` after its start.
    pub fn step(&mut self, step: &Step, end: f64) {
        if end <= 0.0 {
            return;
        }
        for i in 0..PARTS {
            let tau = end * i as f64 / PARTS as f64;
            self.passed += 1;
            if self.passed >= self.stride || self.trail.times.is_empty() {
                self.passed = 0;
                step.state_after(tau, &mut self.x);
                self.put(step.instant(tau).high);
            }
        }
        step.state_after(end, &mut self.x);
        self.end = step.instant(end).high;
    }

    fn put(&mut self, t: f64) {
        if self.trail.times.last().is_some_and(|last| *last >= t) {
            return;
        }
        self.trail.times.push(t);
        self.trail.states.extend_from_slice(&self.x);
        if self.trail.times.len() >= MOST {
            self.halve();
        }
    }

    fn halve(&mut self) {
        let n = self.x.len();
        let kept: Vec<usize> = (0..self.trail.times.len()).step_by(2).collect();
        self.trail.states = kept.iter().flat_map(|k| self.trail.states[k * n..(k + 1) * n].iter().copied()).collect();
        self.trail.times = kept.iter().map(|k| self.trail.times[*k]).collect();
        self.stride *= 2;
    }

    /// The trail with the state at its end.
    pub fn close(mut self) -> Trail {
        if self.end.is_finite() {
            self.put(self.end);
        }
        self.trail
    }
}
