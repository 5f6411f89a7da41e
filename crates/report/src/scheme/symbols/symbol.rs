//! A symbol, and places for the sheet of all symbols.

use crate::scheme::{Fit, Ink, Place};

/// A symbol.
#[derive(Debug)]
pub struct Symbol {
    /// Its name.
    pub name: &'static str,
    /// What it stands for, English and Russian.
    pub words: (&'static str, &'static str),
    /// How it moves.
    pub fit: Fit,
    /// Draws it.
    pub draw: fn(&Place, &mut Ink),
    /// A place for the sheet of all symbols.
    pub sample: fn() -> Place,
}

/// One anchor in the middle.
pub(crate) fn middle() -> Place {
    Place::default()
}

/// Two anchors from left to right.
pub(crate) fn across() -> Place {
    Place { at: [-50.0, 0.0], to: [50.0, 0.0], ..Place::default() }
}
