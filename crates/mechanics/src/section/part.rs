//! A part of a section: an outline that is added or taken out.

use super::outline::Outline;
use std::ops::Range;

/// A part in numbers, SI.
#[derive(Clone, Debug)]
pub struct Part {
    /// What it is called in messages: `rectangle`.
    pub kind: &'static str,
    /// Its outline in the axes of the section.
    pub outline: Outline,
    /// Its own area.
    pub area: f64,
    /// Its own centroid in the axes of the section.
    pub centroid: [f64; 2],
    /// Whether it is taken out.
    pub removed: bool,
    /// Place in the file.
    pub span: Range<usize>,
}
