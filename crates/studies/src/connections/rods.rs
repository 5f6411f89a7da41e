//! A massless rigid rod.

use super::paper::{Knife, Layer, Paper, Teller};
use super::part::{Grip, Held, Own};
use super::tie::Tie;
use mechanics::model::PointRef;
use words::Text;

pub(super) struct Rod {
    pub between: [PointRef; 2],
}

impl Tie for Rod {
    fn demand(&self, _: &Own, teller: &dyn Teller) -> Text {
        let [a, b] = self.between.map(|p| teller.point(p));
        Text::new(format!("massless rigid rod: {a}, {b}"), format!("невесомый жёсткий стержень: {a}, {b}"))
    }
    fn grips(&self) -> Vec<Grip> {
        Grip::points(Held::Linked, &self.between)
    }
    fn draw(&self, layer: Layer, own: &Own, paper: &mut dyn Paper) {
        match layer {
            Layer::Ties => paper.rod(own, self.between),
            Layer::Joints => paper.ends_of_rod(own, self.between),
            _ => {}
        }
    }
    fn cut(&self, own: &Own, knife: &mut dyn Knife) {
        knife.pull(own, self.between);
    }
}
