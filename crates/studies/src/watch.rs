//! What watches a long calculation from outside: a flag to stop it, listeners to its progress and to the ends of its phases. There is no clock here.

use analysis::interrupt::is_set;
pub use analysis::studies::simulate::Kept;
use std::sync::atomic::AtomicBool;
use words::{Notice, Text};

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

/// What runs a work on so many threads at once: there are none below the command line.
pub type Spread = fn(usize, &(dyn Fn() + Sync));

/// Keeps lines where they outlive the process.
pub trait Keeper {
    /// The lines of an earlier run, in order; the last may be torn.
    fn lines(&self) -> &[String];

    /// Leaves the first so many of them.
    ///
    /// # Errors
    /// The disk refuses.
    fn cut(&mut self, lines: usize) -> Result<(), Notice>;

    /// Adds lines. After a crash they are there, or all but some of the first.
    ///
    /// # Errors
    /// The disk refuses.
    fn add(&mut self, lines: &str) -> Result<(), Notice>;
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
    /// What is kept of a motion beside its rows.
    pub kept: Kept,
    /// Threads of a study of many runs; 0 counts as 1. The results do not depend on it.
    pub threads: usize,
    /// Runs a work on so many threads at once, until all have done with it.
    pub spread: Option<Spread>,
    /// Keeps the rows of a study of many runs.
    pub keeper: Option<&'a mut dyn Keeper>,
    /// Which part of how many of a study of many runs is done, counted from 1.
    pub shard: Option<[usize; 2]>,
}

impl Watch<'_> {
    /// Whether the calculation is to end.
    pub fn is_interrupted(&self) -> bool {
        is_set(self.interrupt)
    }

    /// The same with a keeper of rows.
    pub fn with_keeper<'b>(&'b mut self, keeper: Option<&'b mut dyn Keeper>) -> Watch<'b> {
        Watch {
            interrupt: self.interrupt,
            progress: self.progress.as_mut().map(|p| &mut **p as &mut dyn FnMut(f64)),
            doing: self.doing.as_mut().map(|d| &mut **d as &mut dyn FnMut(Text)),
            ended: self.ended.as_mut().map(|e| &mut **e as &mut dyn FnMut(Lap)),
            halve_tolerance: self.halve_tolerance,
            check: self.check,
            kept: self.kept,
            threads: self.threads,
            spread: self.spread,
            keeper,
            shard: self.shard,
        }
    }

    /// Ends a phase.
    pub fn lap(&mut self, phase: Lap) {
        if let Some(ended) = &mut self.ended {
            ended(phase);
        }
    }
}
