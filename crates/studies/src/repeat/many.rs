//! Many places, shared out among threads: the same rows, to the last bit, for any number of them.
//!
//! Rows are done in blocks, whose size follows from the number of rows alone. Each block begins with the machine as it is given and without a memory of the rows before, so that no
//! row depends on who did which block.

use super::one::At;
use super::repeated::Repeated;
use crate::Finds;
use crate::watch::Spread;
use std::ops::Range;
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

/// Rows of a block where each is the guess of the next: long enough for regimes to be followed.
const FOLLOWED: usize = 64;
/// Blocks into which few rows are divided, so that many threads find something to do.
const BLOCKS: usize = 64;
/// Blocks a thread has before progress is told.
const EACH: usize = 4;

/// How rows are shared out.
#[derive(Clone, Copy, Debug)]
pub struct Shared<'a> {
    /// Number of threads, 1 at least.
    pub threads: usize,
    /// Rows of a block.
    pub block: usize,
    /// Set from outside to stop early.
    pub interrupt: Option<&'a AtomicBool>,
    /// Runs a work on so many threads at once; without it there is one.
    pub spread: Option<Spread>,
}

impl Shared<'_> {
    /// Rows after which progress is told.
    pub fn batch(&self) -> usize {
        self.block * self.threads * EACH
    }
}

/// Rows of a block of so many rows.
pub fn block(repeated: &Repeated, at: &At, count: usize) -> usize {
    match at.machine.origin.studies.finds(repeated.base.kind) {
        Finds::Regime => FOLLOWED,
        _ => (count / BLOCKS).clamp(1, FOLLOWED),
    }
}

/// Rows in order; fewer when it is interrupted.
pub fn rows<T: Send>(start: &At, rows: Range<usize>, shared: Shared<'_>, run: &(dyn Fn(&mut At, usize) -> T + Sync)) -> Vec<T> {
    let blocks: Vec<Range<usize>> = rows.clone().step_by(shared.block).map(|from| from..(from + shared.block).min(rows.end)).collect();
    let done: Vec<Mutex<Vec<T>>> = blocks.iter().map(|_| Mutex::default()).collect();
    let next = AtomicUsize::new(0);
    let stopped = || shared.interrupt.is_some_and(|flag| flag.load(Ordering::Relaxed));
    let work = || {
        while let Some((k, rows)) = Some(next.fetch_add(1, Ordering::Relaxed)).and_then(|k| Some((k, blocks.get(k)?.clone()))) {
            let mut at = start.clone();
            // a row that was interrupted on its way is none
            let one = |row: usize| Some(run(&mut at, row)).filter(|_| !stopped());
            let found: Vec<T> = rows.take_while(|_| !stopped()).map_while(one).collect();
            if let Ok(mut place) = done[k].lock() {
                *place = found;
            }
        }
    };
    match shared.spread.filter(|_| shared.threads > 1) {
        Some(spread) => spread(shared.threads.min(blocks.len()), &work),
        None => work(),
    }
    let mut all = Vec::with_capacity(rows.len());
    for (block, found) in blocks.iter().zip(done) {
        let found = found.into_inner().unwrap_or_default();
        let whole = found.len() == block.len();
        all.extend(found);
        if !whole {
            break;
        }
    }
    all
}
