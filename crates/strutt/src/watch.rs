//! What watches a long calculation: a flag to stop it, a listener to its progress, a clock for its phases.

use crate::wording::Word;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};
use words::Text;

/// Watches a calculation.
pub struct Watch<'a> {
    /// Set from outside to stop early.
    pub interrupt: Option<&'a AtomicBool>,
    /// Told the finished share of a study now and then.
    pub progress: Option<&'a mut dyn FnMut(f64)>,
    /// Told what a search does whose length nobody knows beforehand.
    pub doing: Option<&'a mut dyn FnMut(Text)>,
    /// Whether each motion is computed once more with half the tolerance, as a check.
    pub halve_tolerance: bool,
    /// Whether a motion is repeated with other steps to see which digits hold.
    pub check: bool,
    laps: Vec<(Word, Duration)>,
    start: Instant,
    last: Instant,
}

impl Default for Watch<'_> {
    fn default() -> Self {
        let now = Instant::now();
        Watch {
            interrupt: None,
            progress: None,
            doing: None,
            halve_tolerance: false,
            check: false,
            laps: Vec::new(),
            start: now,
            last: now,
        }
    }
}

impl Watch<'_> {
    /// Whether the calculation is to end.
    pub fn is_interrupted(&self) -> bool {
        self.interrupt.is_some_and(|flag| flag.load(Ordering::Relaxed))
    }

    /// Ends a phase.
    pub fn lap(&mut self, phase: Word) {
        let now = Instant::now();
        self.laps.push((phase, now - self.last));
        self.last = now;
    }

    /// Phases with their times; equal phases are added.
    pub fn laps(&self) -> Vec<(Word, Duration)> {
        let mut out: Vec<(Word, Duration)> = Vec::new();
        for (phase, time) in &self.laps {
            match out.iter_mut().find(|(p, _)| p == phase) {
                Some((_, sum)) => *sum += *time,
                None => out.push((*phase, *time)),
            }
        }
        out
    }

    /// Time since the start.
    pub fn total(&self) -> Duration {
        self.last - self.start
    }
}
