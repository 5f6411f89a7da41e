//! A wheel on a line or a circle, a gear on a rack.

use super::paper::{Knife, Layer, Paper, Teller};
use super::part::{Grip, Held, Own, Rim, Rolls};
use super::tie::Tie;
use crate::shown::find;
use mechanics::model::{PointRef, Track};
use symbolic::Expr;
use words::Text;

impl Tie for Rolls {
    fn demand(&self, _: &Own, teller: &dyn Teller) -> Text {
        let (wheel, on) = (teller.body(self.wheel), teller.body(self.on));
        Text::new(format!("rolling without slip: {wheel} on {on}"), format!("качение без проскальзывания: {wheel}, опора – {on}"))
    }
    fn grips(&self) -> Vec<Grip> {
        let mut grips = vec![Grip::frame(Held::Rolled, self.on)];
        if let Track::Circle { center, .. } = self.track {
            grips.push(Grip::point(Held::Seen, center));
        }
        grips
    }
    fn rims(&self, own: &Own) -> Vec<Rim> {
        let symbol = find(own.table).map_or("", |row| row.wheel);
        vec![Rim { symbol, frame: self.wheel, center: self.center, radius: self.radius }]
    }
    fn place(&self) -> Option<(PointRef, Option<Expr>)> {
        Some((self.center, Some(self.radius)))
    }
    fn draw(&self, layer: Layer, own: &Own, paper: &mut dyn Paper) {
        if layer == Layer::Tracks {
            paper.track(own, self);
        }
    }
    fn cut(&self, own: &Own, knife: &mut dyn Knife) {
        knife.rolls(own, self);
    }
}
