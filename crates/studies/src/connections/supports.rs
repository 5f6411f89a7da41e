//! A body that is held at a point.

use super::paper::{Knife, Layer, Paper, Teller};
use super::part::{Grip, Held, Own, Support};
use super::tie::Tie;
use mechanics::model::{PointRef, SupportDirection};
use symbolic::Expr;
use words::Text;

/// What a direction holds.
fn named(direction: &SupportDirection) -> (&'static str, &'static str) {
    match direction {
        SupportDirection::X => ("x", "x"),
        SupportDirection::Y => ("y", "y"),
        SupportDirection::Z => ("z", "z"),
        SupportDirection::TurnX => ("turn about x", "поворот вокруг x"),
        SupportDirection::TurnY => ("turn about y", "поворот вокруг y"),
        SupportDirection::TurnZ => ("turn", "поворот"),
    }
}

impl Tie for Support<'_> {
    fn demand(&self, _: &Own, teller: &dyn Teller) -> Text {
        let (en, ru): (Vec<&str>, Vec<&str>) = self.directions.iter().map(named).unzip();
        let (en, ru, point) = (en.join(", "), ru.join(", "), teller.point(self.at));
        Text::new(format!("support: {point}; held: {en}"), format!("опора: {point}; закреплено: {ru}"))
    }
    fn grips(&self) -> Vec<Grip> {
        vec![Grip::point(Held::Supported, self.at)]
    }
    fn place(&self) -> Option<(PointRef, Option<Expr>)> {
        Some((self.at, None))
    }
    fn draw(&self, layer: Layer, own: &Own, paper: &mut dyn Paper) {
        if layer == Layer::Supports {
            paper.support(own, self);
        }
    }
    fn cut(&self, own: &Own, knife: &mut dyn Knife) {
        knife.support(own, self);
    }
}
