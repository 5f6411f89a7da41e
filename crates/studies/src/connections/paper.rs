//! What drawings and sentences do for a connection: the connection says what is to be drawn, told or cut, they know where and how.

use super::part::{Guide, Own, Pair, Rolls, Rope, Support};
use mechanics::model::{FrameId, PointRef};
use symbolic::Expr;

/// Layers of a scheme, the lowest first.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Layer {
    /// What wheels roll on.
    Tracks,
    /// Where points rub.
    Rubbed,
    /// Rods, ropes, belts, gears.
    Ties,
    Supports,
    Joints,
    /// Conditions and frictions with their letters.
    Loads,
}

/// A scheme that is drawn.
pub(crate) trait Paper {
    /// A hinge where two points coincide.
    fn pin(&mut self, own: &Own, between: [PointRef; 2]);
    /// A rigid joint of two points.
    fn weld(&mut self, own: &Own, between: [PointRef; 2]);
    /// A slider on its line.
    fn guide(&mut self, own: &Own, guide: &Guide);
    /// A rod between two points.
    fn rod(&mut self, own: &Own, between: [PointRef; 2]);
    /// The hinges at its ends.
    fn ends_of_rod(&mut self, own: &Own, between: [PointRef; 2]);
    fn rope(&mut self, own: &Own, rope: &Rope);
    /// A belt, a chain, gears.
    fn pair(&mut self, own: &Own, pair: &Pair);
    /// What a wheel rolls on.
    fn track(&mut self, own: &Own, rolls: &Rolls);
    fn support(&mut self, own: &Own, support: &Support);
    /// A point that rubs on a body.
    fn rubbed(&mut self, own: &Own, point: PointRef);
    /// A friction in another connection, by its number.
    fn rubs_in(&mut self, own: &Own, connection: usize);
    /// A condition that a formula vanishes.
    fn condition(&mut self, own: &Own, zero: Expr);
}

/// A body that is drawn alone: reactions in place of what is cut. Each draws nothing where the body is not one of the partners.
pub(crate) trait Knife {
    /// Components of a force along axes.
    fn pin(&mut self, own: &Own, between: [PointRef; 2], axes: FrameId);
    /// The same with a moment.
    fn weld(&mut self, own: &Own, between: [PointRef; 2], axes: FrameId);
    /// The normal force of a line, with a moment where the body may not turn.
    fn guide(&mut self, own: &Own, guide: &Guide);
    /// A force along the line of two points.
    fn pull(&mut self, own: &Own, between: [PointRef; 2]);
    /// Forces of a rope at its points and drums.
    fn rope(&mut self, own: &Own, rope: &Rope);
    /// The force of a tooth or belt.
    fn pair(&mut self, own: &Own, pair: &Pair);
    /// Forces at the contact of a wheel with its track.
    fn rolls(&mut self, own: &Own, rolls: &Rolls);
    fn support(&mut self, own: &Own, support: &Support);
}

/// How points and bodies are called.
pub(crate) trait Teller {
    fn point(&self, point: PointRef) -> String;
    fn body(&self, frame: FrameId) -> String;
}
