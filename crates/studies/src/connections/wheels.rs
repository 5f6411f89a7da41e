//! Two wheels that turn together: belts, chains, gears.

use super::paper::{Knife, Layer, Paper, Teller};
use super::part::{Own, Pair, Rim};
use super::tie::Tie;
use crate::shown::find;
use mechanics::model::PointRef;
use words::Text;

impl Tie for Pair {
    fn demand(&self, own: &Own, teller: &dyn Teller) -> Text {
        let [a, b] = self.between.map(|f| teller.body(f));
        let (en, ru) = find(own.table).map_or(("", ""), |row| if self.opposite { row.opposite } else { row.called });
        Text::new(format!("{en}: {a}, {b}"), format!("{ru}: {a}, {b}"))
    }
    fn rims(&self, own: &Own) -> Vec<Rim> {
        let symbol = find(own.table).map_or("", |row| row.wheel);
        let rim = |k: usize| Rim { symbol, frame: self.between[k], center: PointRef::Origin(self.between[k]), radius: self.radii[k] };
        vec![rim(0), rim(1)]
    }
    fn pair(&self) -> Option<Pair> {
        Some(*self)
    }
    fn draw(&self, layer: Layer, own: &Own, paper: &mut dyn Paper) {
        if layer == Layer::Ties {
            paper.pair(own, self);
        }
    }
    fn cut(&self, own: &Own, knife: &mut dyn Knife) {
        knife.pair(own, self);
    }
}
