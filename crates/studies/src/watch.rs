//! What watches a long calculation from outside: a flag to stop it, listeners to its progress and to the ends of its phases. There is no clock here.

use std::sync::atomic::{AtomicBool, Ordering};
use words::Text;

/// A phase of a calculation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Lap {
    /// The file is read.
    Read,
    /// Equations are derived.
    Derive,
    /// The program is made.
    Lower,
    /// A study is carried out.
    Run,
}

/// Watches a calculation.
#[derive(Default)]
pub struct Watch<'a> {
    /// Set from outside to stop early.
    pub interrupt: Option<&'a AtomicBool>,
    /// Told the finished share of a study now and then.
    pub progress: Option<&'a mut dyn FnMut(f64)>,
    /// Told what a search does whose length nobody knows beforehand.
    pub doing: Option<&'a mut dyn FnMut(Text)>,
    /// Told the phase that has ended.
    pub ended: Option<&'a mut dyn FnMut(Lap)>,
    /// Whether each motion is computed once more with half the tolerance, as a check.
    pub halve_tolerance: bool,
    /// Whether a motion is repeated with other steps to see which digits hold.
    pub check: bool,
}

impl Watch<'_> {
    /// Whether the calculation is to end.
    pub fn is_interrupted(&self) -> bool {
        self.interrupt.is_some_and(|flag| flag.load(Ordering::Relaxed))
    }

    /// Ends a phase.
    pub fn lap(&mut self, phase: Lap) {
        if let Some(ended) = &mut self.ended {
            ended(phase);
        }
    }
}
