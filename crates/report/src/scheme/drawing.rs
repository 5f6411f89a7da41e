//! A scheme: symbols at places, letters beside them.

use super::ink::P;
use super::place::Place;
use super::rides::Rides;
use super::symbols::{self, Symbol};
use crate::rich::Rich;

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
