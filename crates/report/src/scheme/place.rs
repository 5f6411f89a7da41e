//! Where a symbol stands, and how it moves from there.

use super::ink::P;

/// The module: sizes of symbols are counted in it. 5 mm where a figure is as wide as a page A4.
pub const S: f64 = 22.0;

/// How an item moves with the machine.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fit {
    /// It keeps its direction: ground, guides. What carries it takes it along.
    Static,
    /// It moves with a body.
    Rigid,
    /// It lies between two ends and is drawn anew between them: springs, dampers, rods. What does not use [`Place::other`] finds there its length at rest.
    Stretch,
    /// It runs over wheels: belts, threads.
    Wrap,
    /// It belongs to the place that is drawn, as coordinates and dimensions do; a moving picture goes without it.
    Sign,
}

/// Where a symbol stands. What each number means to a symbol stands at the symbol; what a symbol does not use is zero.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Place {
    /// First anchor.
    pub at: P,
    /// Second anchor.
    pub to: P,
    /// Radius or half of a width.
    pub size: f64,
    /// A second radius or half of a height.
    pub other: f64,
    /// Direction, rad.
    pub turn: f64,
    /// Corners or points of a way.
    pub path: Vec<P>,
}

impl Place {
    /// The same elsewhere.
    #[must_use]
    pub fn moved(mut self, by: P) -> Place {
        let shift = |p: P| [p[0] + by[0], p[1] + by[1]];
        self.at = shift(self.at);
        self.to = shift(self.to);
        self.path = self.path.into_iter().map(shift).collect();
        self
    }
}
