//! A prescribed motion.

use super::paper::Teller;
use super::part::{Letter, Own};
use super::tie::Tie;
use mechanics::model::Pathway;
use symbolic::{Expr, Graph};
use words::Text;

pub(super) struct Motion {
    pub pathway: Pathway,
    pub value: Expr,
}

impl Tie for Motion {
    fn demand(&self, _: &Own, _: &dyn Teller) -> Text {
        Text::new("prescribed motion", "заданное движение")
    }
    fn pathway(&self) -> Option<Pathway> {
        Some(self.pathway)
    }
    fn letter(&self) -> Letter {
        Letter::Of(self.value)
    }
    fn is_still(&self, graph: &Graph) -> bool {
        graph.is_zero(self.value)
    }
}
