//! A condition written as a formula.

use super::paper::{Layer, Paper, Teller};
use super::part::Own;
use super::tie::Tie;
use symbolic::Expr;
use words::Text;

pub(super) struct Constraint {
    pub zero: Expr,
    pub on_rates: bool,
}

impl Tie for Constraint {
    fn demand(&self, _: &Own, _: &dyn Teller) -> Text {
        match self.on_rates {
            true => Text::new("condition on velocities", "условие на скорости"),
            false => Text::new("condition on positions", "условие на координаты"),
        }
    }
    fn draw(&self, layer: Layer, own: &Own, paper: &mut dyn Paper) {
        if layer == Layer::Loads {
            paper.condition(own, self.zero);
        }
    }
}
