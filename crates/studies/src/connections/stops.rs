//! A one-sided stop.

use super::paper::Teller;
use super::part::{Limit, Own};
use super::tie::Tie;
use mechanics::model::Pathway;
use symbolic::Expr;
use symbolic::connections::Rebound;
use words::Text;

pub(super) struct Stop {
    pub gap: Pathway,
    pub limit: Limit,
    pub restitution: Expr,
    pub rebound: Rebound,
}

impl Tie for Stop {
    fn demand(&self, _: &Own, _: &dyn Teller) -> Text {
        Text::new("one-sided stop", "односторонний упор")
    }
    fn pathway(&self) -> Option<Pathway> {
        Some(self.gap)
    }
    fn limit(&self) -> Option<Limit> {
        Some(self.limit)
    }
    fn is_bent(&self) -> bool {
        true
    }
    fn impact(&self) -> Option<(Rebound, Expr)> {
        Some((self.rebound, self.restitution))
    }
}
