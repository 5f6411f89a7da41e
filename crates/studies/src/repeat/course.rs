//! Rows one behind the other: those of an earlier run first, then fresh ones, which are kept.

use super::gathered::Row;
use super::journal::{self, Head};
use crate::watch::Watch;
use std::ops::Range;
use words::Notice;

/// Rows of an earlier run that are still to be taken.
pub(crate) struct Course {
    earlier: std::vec::IntoIter<Row>,
}

impl Course {
    /// What the keeper of a watch has of an earlier run; what is torn there is cut off.
    ///
    /// # Errors
    /// The rows are of another study (S148) or damaged (S149); the disk refuses.
    pub(crate) fn begin(watch: &mut Watch, head: &Head) -> Result<Course, Notice> {
        let Some(keeper) = &mut watch.keeper else { return Ok(Course { earlier: Vec::new().into_iter() }) };
        let (earlier, kept) = journal::earlier(keeper.lines(), head)?;
        keeper.cut(kept)?;
        if kept == 0 {
            keeper.add(&head.line())?;
        }
        Ok(Course { earlier: earlier.into_iter() })
    }

    /// Rows of an earlier run that are left.
    pub(crate) fn left(&self) -> usize {
        self.earlier.len()
    }

    /// The rows of these places; fewer when it is interrupted.
    ///
    /// # Errors
    /// The disk refuses.
    pub(crate) fn rows(
        &mut self,
        watch: &mut Watch,
        places: Range<usize>,
        run: &dyn Fn(Range<usize>) -> Vec<Row>,
    ) -> Result<Vec<Row>, Notice> {
        let mut found: Vec<Row> = self.earlier.by_ref().take(places.len()).collect();
        let first = places.start + found.len();
        if first < places.end {
            let fresh = run(first..places.end);
            if let Some(keeper) = &mut watch.keeper {
                let lines: String = fresh.iter().zip(first..).map(|(row, place)| journal::line(place, row)).collect();
                keeper.add(&lines)?;
            }
            found.extend(fresh);
        }
        Ok(found)
    }
}
