//! Many places, shared out among threads: the same rows, to the last bit, for any number of them.
//!
//! Rows are done in blocks, whose size follows from the number of rows alone. Each block begins with the machine as it is given, so that no
//! row depends on who did which block.

use super::one::At;
use crate::watch::Spread;
use analysis::interrupt::is_set;
use std::ops::Range;
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

/// Rows of a block at most: what has been done is kept block by block.
const MOST: usize = 64;
/// Blocks into which few rows are divided, so that many threads find something to do.
const BLOCKS: usize = 64;
/// Blocks into which few rows in lanes are divided, and lanes.
const IN_LANES: usize = 8;
const LANES: usize = 8;
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

/// Rows of a block of so many rows that go in lanes: whole turns of all lanes, and few enough for several threads.
pub fn block_in_lanes(count: usize) -> usize {
    (count / IN_LANES).clamp(LANES, MOST) / LANES * LANES
}

/// Rows of a block of so many rows.
pub fn block(count: usize) -> usize {
    (count / BLOCKS).clamp(1, MOST)
}

/// The rows of a block one by one; fewer when it is interrupted.
pub fn one_by_one<T>(at: &mut At, rows: Range<usize>, interrupt: Option<&AtomicBool>, run: &dyn Fn(&mut At, usize) -> T) -> Vec<T> {
    let stopped = || is_set(interrupt);
    // a row that was interrupted on its way is none
    rows.take_while(|_| !stopped()).map_while(|row| Some(run(at, row)).filter(|_| !stopped())).collect()
}

/// Rows in order; fewer when it is interrupted. `run` makes those of a block.
pub fn rows<T: Send>(start: &At, rows: Range<usize>, shared: Shared<'_>, run: &(dyn Fn(&mut At, Range<usize>) -> Vec<T> + Sync)) -> Vec<T> {
    let blocks: Vec<Range<usize>> = rows.clone().step_by(shared.block).map(|from| from..(from + shared.block).min(rows.end)).collect();
    let done: Vec<Mutex<Vec<T>>> = blocks.iter().map(|_| Mutex::default()).collect();
    let next = AtomicUsize::new(0);
    let stopped = || is_set(shared.interrupt);
    let work = || {
        while let Some((k, rows)) = Some(next.fetch_add(1, Ordering::Relaxed)).and_then(|k| Some((k, blocks.get(k)?.clone()))) {
            let mut at = start.clone();
            let found = if stopped() { Vec::new() } else { run(&mut at, rows) };
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
