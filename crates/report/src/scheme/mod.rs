//! Schemes of machines: a list of items, each a symbol of a table at a place, with labels that find their places by themselves. Nothing here knows mechanics:
//! whoever makes a scheme says which symbol stands where.
//!
//! Lengths are pixels of the picture; x runs to the right, y downwards. Angles are in radians, counter-clockwise as seen.

mod drawing;
mod ink;
mod labels;
pub mod moving;
mod place;
mod rides;
mod svg;
pub mod symbols;

pub use drawing::{Item, Label, LabelText, Scheme};
pub use ink::{Fill, Ink, P, Shape, Stroke, Weight, between, direction, distance, polar, tangent};
pub use moving::Moving;
pub use place::{Fit, Place, S};
pub use rides::{Drum, Rides, Via};
pub use symbols::{Symbol, TABLE};

use words::Language;

/// All symbols of the table with their names: the golden sheet.
pub fn sheet(language: Language) -> Scheme {
    const COLUMNS: usize = 6;
    const CELL: P = [150.0, 112.0];
    let mut scheme = Scheme::new("symbols", language.pick("Symbols of schemes", "Условные обозначения").into());
    for (i, symbol) in TABLE.iter().flat_map(|family| family.iter()).enumerate() {
        let corner = [(i % COLUMNS) as f64 * CELL[0] + CELL[0] / 2.0, (i / COLUMNS) as f64 * CELL[1] + 46.0];
        let place = (symbol.sample)().moved(corner);
        scheme.put(symbol.name, symbol.name, place);
        let words = LabelText::Words(language.pick(symbol.words.0, symbol.words.1).to_owned());
        let below = [corner[0], corner[1] + 50.0];
        scheme.label(Label { text: words, at: below, away: 0.0, side: None, rides: None });
    }
    scheme
}
