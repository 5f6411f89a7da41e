//! What a connection answers.

use super::paper::{Knife, Layer, Paper, Teller};
use super::part::{Grip, Letter, Limit, Own, Pair, Rim};
use mechanics::model::{Pathway, PointRef};
use symbolic::connections::Rebound;
use symbolic::{Expr, Graph};
use words::Text;

/// A connection as figures and sentences ask it; what most do not have is none.
pub(crate) trait Tie {
    /// What it demands, in words.
    fn demand(&self, own: &Own, teller: &dyn Teller) -> Text;

    /// What it takes hold of, and places that are seen.
    fn grips(&self) -> Vec<Grip> {
        Vec::new()
    }

    /// Wheels that it shows.
    fn rims(&self, _: &Own) -> Vec<Rim> {
        Vec::new()
    }

    /// Where it is, and how far below.
    fn place(&self) -> Option<(PointRef, Option<Expr>)> {
        None
    }

    /// Along what it acts.
    fn pathway(&self) -> Option<Pathway> {
        None
    }

    /// Its letter on that way.
    fn letter(&self) -> Letter {
        Letter::Usual
    }

    /// A second letter: of the kinetic friction where the static one has its own.
    fn second_letter(&self) -> Option<Expr> {
        None
    }

    /// Whether it holds its pathway at zero.
    fn is_still(&self, _: &Graph) -> bool {
        false
    }

    /// Where it begins to push.
    fn limit(&self) -> Option<Limit> {
        None
    }

    /// The wheels that turn together.
    fn pair(&self) -> Option<Pair> {
        None
    }

    /// Whether its force is no straight line over places and rates.
    fn is_bent(&self) -> bool {
        false
    }

    /// The law of its impacts, with the coefficient of restitution.
    fn impact(&self) -> Option<(Rebound, Expr)> {
        None
    }

    /// Draws what it has on a layer.
    fn draw(&self, _: Layer, _: &Own, _: &mut dyn Paper) {}

    /// Draws its reactions on a body alone.
    fn cut(&self, _: &Own, _: &mut dyn Knife) {}
}
