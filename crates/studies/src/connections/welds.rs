//! A rigid joint.

use super::paper::{Knife, Layer, Paper, Teller};
use super::part::{Grip, Held, Own};
use super::tie::Tie;
use mechanics::model::{FrameId, PointRef};
use symbolic::Expr;
use words::Text;

pub(super) struct Weld {
    pub between: [PointRef; 2],
    pub axes: FrameId,
}

impl Tie for Weld {
    fn demand(&self, _: &Own, teller: &dyn Teller) -> Text {
        let [a, b] = self.between.map(|p| teller.point(p));
        Text::new(format!("rigid joint: {a}, {b}"), format!("жёсткое соединение: {a}, {b}"))
    }
    fn grips(&self) -> Vec<Grip> {
        Grip::points(Held::Fixed, &self.between)
    }
    fn place(&self) -> Option<(PointRef, Option<Expr>)> {
        Some((self.between[0], None))
    }
    fn draw(&self, layer: Layer, own: &Own, paper: &mut dyn Paper) {
        if layer == Layer::Joints {
            paper.weld(own, self.between);
        }
    }
    fn cut(&self, own: &Own, knife: &mut dyn Knife) {
        knife.weld(own, self.between, self.axes);
    }
}
