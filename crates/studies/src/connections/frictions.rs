//! A dry friction.

use super::paper::{Layer, Paper, Teller};
use super::part::{Letter, Own};
use super::tie::Tie;
use mechanics::model::{Pathway, Slides};
use symbolic::Expr;
use words::Text;

pub(super) struct Friction<'m> {
    pub slides: &'m Slides,
    pub kinetic: Expr,
    pub fixed: Option<Expr>,
}

impl Tie for Friction<'_> {
    fn demand(&self, _: &Own, _: &dyn Teller) -> Text {
        match self.slides {
            Slides::Along(_) => Text::new("dry friction", "сухое трение"),
            Slides::Point { .. } => Text::new("dry friction at a point", "сухое трение в точке"),
            Slides::Contact { .. } => Text::new("dry friction of a contact", "сухое трение в контакте"),
            Slides::Rolls { .. } => Text::new("rolling friction", "трение качения"),
            Slides::Journal { .. } => Text::new("friction of a journal", "трение в цапфе"),
            Slides::Belt { .. } => Text::new("friction of a rope on a drum", "трение каната о барабан"),
        }
    }
    fn pathway(&self) -> Option<Pathway> {
        if let Slides::Along(pathway) = self.slides { Some(*pathway) } else { None }
    }
    fn letter(&self) -> Letter {
        Letter::Of(self.fixed.unwrap_or(self.kinetic))
    }
    fn second_letter(&self) -> Option<Expr> {
        self.fixed.map(|_| self.kinetic)
    }
    fn is_bent(&self) -> bool {
        true
    }
    fn draw(&self, layer: Layer, own: &Own, paper: &mut dyn Paper) {
        match (layer, self.slides) {
            (Layer::Rubbed, Slides::Point { point, .. }) => paper.rubbed(own, *point),
            (Layer::Loads, Slides::Contact { of, .. } | Slides::Rolls { of } | Slides::Journal { of, .. } | Slides::Belt { of, .. }) => {
                paper.rubs_in(own, *of)
            }
            _ => {}
        }
    }
}
