//! Single numbers that a study found.

use super::view::View;
use analysis::Quantity;
use report::table::Column;
use report::{Cell, Table, Word};
use words::Text;

/// Significant digits of a fact in a terminal: it stands alone and is compared.
const DIGITS: usize = 8;
/// The same on a page, as many as all its tables have at most.
const PAGE_DIGITS: usize = 6;

/// A single number that a study found.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Fact {
    /// Name in JSON, symbol, unit, what it is.
    pub quantity: Quantity,
    /// The number, SI.
    pub value: f64,
    /// Words in its place or behind it.
    pub words: Text,
}

impl Fact {
    /// A number with its name in files, symbol, unit and meaning.
    pub fn new(name: &str, symbol: &str, unit: &str, value: f64, label: Text) -> Fact {
        let quantity = Quantity { symbol: symbol.into(), label, ..Quantity::new(name, unit) };
        Fact { quantity, value, words: Text::default() }
    }
    /// The same with words.
    pub fn with_words(mut self, words: Text) -> Fact {
        self.words = words;
        self
    }
}

/// The numbers that have a meaning for readers, as a table.
pub fn table(facts: &[Fact], view: &View) -> Option<Table> {
    let language = view.language;
    let digits = if view.is_page() { PAGE_DIGITS } else { DIGITS };
    let shown: Vec<&Fact> = facts.iter().filter(|f| !f.quantity.label.en.is_empty()).collect();
    if shown.is_empty() {
        return None;
    }
    let heads = [Word::Symbol, Word::Value, Word::Unit, Word::Description];
    let mut table = Table::new(heads.map(|w| Column::new(language.word(w))).into());
    for fact in shown {
        let words = language.text(&fact.words);
        let label = language.text(&fact.quantity.label);
        let label = if words.is_empty() { label.to_owned() } else { format!("{label}: {words}") };
        let number = if fact.value.is_nan() { Cell::Empty } else { Cell::number(fact.value, digits, language) };
        table.row(vec![
            Cell::symbol(&fact.quantity.symbol),
            number,
            Cell::words(report::unit::print(&fact.quantity.unit, language)),
            Cell::words(label),
        ]);
    }
    Some(table)
}
