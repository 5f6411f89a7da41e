//! Parameters and coordinates as they are written, before their formulas are checked.

use crate::formula::{Formula, Kind};
use crate::reader::Raw;
use crate::units::Unit;
use std::ops::Range;
use words::Text;

/// A coordinate before its start values are read.
pub(super) struct RawCoordinate<'a> {
    pub name: String,
    pub span: Range<usize>,
    pub dimension: Kind,
    /// whether numbers without a unit would be taken for another unit than the one named
    pub scaled: Option<String>,
    pub start: Option<Raw<'a>>,
    pub rate: Option<Raw<'a>>,
    /// guesses, where start and rate are found from the connections
    pub guesses: [Option<Raw<'a>>; 2],
    pub label: Text,
}

/// A parameter before its formula is checked.
pub(super) struct RawParameter<'a> {
    pub name: String,
    pub span: Option<Range<usize>>,
    pub raw: Raw<'a>,
    /// what the command line sets in its place
    pub by_hand: Option<Raw<'a>>,
    /// with its place and as written
    pub unit: Option<(Unit, Range<usize>, String)>,
    pub label: Text,
}

/// The names that a formula uses.
pub(super) fn names_of<'r>(raw: &'r Raw) -> impl Iterator<Item = &'r str> {
    raw.formula.iter().flat_map(Formula::names).map(|(name, _)| name)
}
