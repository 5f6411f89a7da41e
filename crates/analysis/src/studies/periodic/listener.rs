//! Who listens to a search whose length nobody knows beforehand: it is told what is done, and may ask for the end.

use crate::interrupt::is_set;
use std::sync::atomic::AtomicBool;

/// What a search does.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Stage {
    /// The motion is followed before the search: so far, s, of so much.
    Settling(f64, f64),
    /// The motion is followed to the section: time from the start of the turn, s.
    Following(f64),
    /// A turn has ended: its number, and by what share of its range it missed its start.
    Turned(usize, f64),
    /// The variations of a turn are followed: done share.
    Varying(f64),
}

/// A listener; by default nobody.
#[derive(Clone, Copy, Default)]
pub struct Listener<'a> {
    /// Set from outside to stop early.
    pub interrupt: Option<&'a AtomicBool>,
    /// Told what is done, often: whoever shows it chooses when.
    pub told: Option<&'a dyn Fn(Stage)>,
}

impl Listener<'_> {
    /// Tells what is done.
    pub(super) fn tell(&self, stage: Stage) {
        if let Some(told) = self.told {
            told(stage);
        }
    }

    /// Whether the search is to end.
    pub(super) fn is_interrupted(&self) -> bool {
        is_set(self.interrupt)
    }
}
