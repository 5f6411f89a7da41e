//! A rope or thread.

use super::paper::{Knife, Layer, Paper, Teller};
use super::part::{Grip, Held, Own, Rim, Rope};
use super::tie::Tie;
use mechanics::model::PointRef;
use symbolic::Expr;
use words::Text;

impl Tie for Rope<'_> {
    fn demand(&self, _: &Own, teller: &dyn Teller) -> Text {
        let list: Vec<String> = self.path.iter().map(|p| teller.point(*p)).collect();
        let list = list.join(", ");
        let (en, ru) = if self.slack { ("; it may go slack", "; может провисать") } else { ("", "") };
        Text::new(format!("inextensible rope: {list}{en}"), format!("нерастяжимая нить: {list}{ru}"))
    }
    fn grips(&self) -> Vec<Grip> {
        Grip::points(Held::Roped, self.path)
    }
    fn rims(&self, _: &Own) -> Vec<Rim> {
        let rim = |frame, radius| Rim { symbol: "drum", frame, center: PointRef::Origin(frame), radius };
        self.wound.iter().map(|drum| rim(drum.on, drum.radius)).collect()
    }
    fn place(&self) -> Option<(PointRef, Option<Expr>)> {
        self.path.get(self.path.len() / 2).map(|p| (*p, None))
    }
    fn draw(&self, layer: Layer, own: &Own, paper: &mut dyn Paper) {
        if layer == Layer::Ties {
            paper.rope(own, self);
        }
    }
    fn cut(&self, own: &Own, knife: &mut dyn Knife) {
        knife.rope(own, self);
    }
}
