//! Schemes of machines: a list of items, each a symbol of a table at a place, with labels that find their places by themselves. Nothing here knows mechanics:
//! whoever makes a scheme says which symbol stands where.
//!
//! Lengths are pixels of the picture; x runs to the right, y downwards. Angles are in radians, counter-clockwise as seen.

mod ink;
mod labels;
pub mod moving;
mod rides;
mod svg;
pub mod symbols;

pub use ink::{Fill, Ink, P, Shape, Stroke, Weight, between, direction, distance, polar, tangent};
pub use moving::Moving;
pub use rides::{Drum, Rides, Via};
pub use symbols::{Symbol, TABLE};

use crate::rich::Rich;
use words::Language;

/// The module: sizes of symbols are counted in it. 5 mm where a figure is as wide as a page A4.
pub const S: f64 = 22.0;

/// How an item moves with the machine.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fit {
    /// It keeps its direction: ground, guides. What carries it takes it along.
    Static,
    /// It moves with a body.
    Rigid,
    /// It lies between two ends and is drawn anew between them: springs, dampers, rods. What does not use [`Place::other`] finds there its length at rest.
    Stretch,
    /// It runs over wheels: belts, threads.
    Wrap,
    /// It belongs to the place that is drawn, as coordinates and dimensions do; a moving picture goes without it.
    Sign,
}

/// Where a symbol stands. What each number means to a symbol stands at the symbol; what a symbol does not use is zero.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Place {
    /// First anchor.
    pub at: P,
    /// Second anchor.
    pub to: P,
    /// Radius or half of a width.
    pub size: f64,
    /// A second radius or half of a height.
    pub other: f64,
    /// Direction, rad.
    pub turn: f64,
    /// Corners or points of a way.
    pub path: Vec<P>,
}

/// A symbol at its place.
#[derive(Clone, Debug)]
pub struct Item {
    /// What it shows, as in the file: `springs.c1`; of a body, `bodies.crank`.
    pub path: String,
    /// The symbol.
    pub symbol: &'static Symbol,
    /// Where.
    pub place: Place,
    /// What carries it.
    pub rides: Rides,
}

/// Words or letters beside something.
#[derive(Clone, Debug)]
pub struct Label {
    /// Name of a symbol as in formulas (`phi_1`), words, or a number of a body.
    pub text: LabelText,
    /// What it belongs to.
    pub at: P,
    /// Free distance from there.
    pub away: f64,
    /// The side it should be on, rad; none where all are equal.
    pub side: Option<f64>,
    /// What carries it; none for letters of coordinates and dimensions, which a moving picture goes without.
    pub rides: Option<Rides>,
}

/// What a label says.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum LabelText {
    /// A symbol, set as in formulas.
    Symbol(String),
    /// A short formula as text.
    Formula(String),
    /// Words as they are.
    Words(String),
    /// The number of a body, in a circle.
    Number(usize),
}

/// A scheme.
#[derive(Clone, Debug)]
pub struct Scheme {
    /// Stem of the names of its files.
    pub name: String,
    /// Words below it.
    pub title: Rich,
    /// Symbols, the ones behind first.
    pub items: Vec<Item>,
    /// Labels, the important ones first.
    pub labels: Vec<Label>,
    /// What it shows, in words, a line each: for readers that see no pictures.
    pub summary: Vec<String>,
}

impl Scheme {
    /// A scheme with nothing in it.
    pub fn new(name: &str, title: Rich) -> Scheme {
        Scheme { name: name.to_owned(), title, items: Vec::new(), labels: Vec::new(), summary: Vec::new() }
    }

    /// Adds a symbol that stands still; a name that is not in the table adds nothing.
    pub fn put(&mut self, symbol: &str, path: &str, place: Place) {
        self.carried(symbol, path, (place, Rides::default()));
    }

    /// Adds a symbol with what carries it.
    pub fn carried(&mut self, symbol: &str, path: &str, (place, rides): (Place, Rides)) {
        let Some(symbol) = symbols::find(symbol) else { return };
        self.items.push(Item { path: path.to_owned(), symbol, place, rides });
    }

    /// Adds a label.
    pub fn label(&mut self, label: Label) {
        self.labels.push(label);
    }

    /// The picture as an SVG document.
    pub fn svg(&self, language: Language) -> String {
        svg::write(self, language)
    }

    /// What it shows in words, one line.
    pub fn told(&self) -> String {
        self.summary.join("; ")
    }
}

impl Label {
    /// A symbol beside a place.
    pub fn symbol(name: &str, at: P, away: f64) -> Label {
        Label { text: LabelText::Symbol(name.to_owned()), at, away, side: None, rides: None }
    }

    /// On this side if possible.
    #[must_use]
    pub fn towards(self, side: f64) -> Label {
        Label { side: Some(side), ..self }
    }
}

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

impl Place {
    /// The same elsewhere.
    #[must_use]
    pub fn moved(mut self, by: P) -> Place {
        let shift = |p: P| [p[0] + by[0], p[1] + by[1]];
        self.at = shift(self.at);
        self.to = shift(self.to);
        self.path = self.path.into_iter().map(shift).collect();
        self
    }
}
