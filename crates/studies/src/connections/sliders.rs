//! A point on a straight line: a slider on its guide, a pin in its slot.

use super::paper::{Knife, Layer, Paper, Teller};
use super::part::{Grip, Guide, Held, Own};
use super::tie::Tie;
use words::Text;

impl Tie for Guide {
    fn demand(&self, _: &Own, teller: &dyn Teller) -> Text {
        let (p, line) = (teller.point(self.point), teller.body(self.on));
        let (en, ru) = if self.turns { ("", "") } else { (", without turning", ", без поворота") };
        Text::new(format!("{p} stays on a straight guide: {line}{en}"), format!("{p} движется по прямой направляющей: {line}{ru}"))
    }
    fn grips(&self) -> Vec<Grip> {
        let mut grips = vec![Grip::point(Held::Slides, self.point), Grip::frame(Held::Guides, self.on)];
        grips.extend(self.through.map(|p| Grip::point(Held::Seen, p)));
        grips
    }
    fn draw(&self, layer: Layer, own: &Own, paper: &mut dyn Paper) {
        if layer == Layer::Joints {
            paper.guide(own, self);
        }
    }
    fn cut(&self, own: &Own, knife: &mut dyn Knife) {
        knife.guide(own, self);
    }
}
