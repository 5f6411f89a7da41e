//! A drive whose force realises a motion.

use super::paper::Teller;
use super::part::{Letter, Own};
use super::tie::Tie;
use mechanics::model::Pathway;
use words::Text;

pub(super) struct Motor {
    pub pathway: Pathway,
}

impl Tie for Motor {
    fn demand(&self, _: &Own, teller: &dyn Teller) -> Text {
        match self.pathway {
            Pathway::RelativeAngle(a, b) => {
                let (a, b) = (teller.body(a), teller.body(b));
                Text::new(format!("motor: {a}, {b}"), format!("двигатель: {a}, {b}"))
            }
            _ => Text::new("motor", "двигатель"),
        }
    }
    fn pathway(&self) -> Option<Pathway> {
        Some(self.pathway)
    }
    fn letter(&self) -> Letter {
        Letter::Drive
    }
}
