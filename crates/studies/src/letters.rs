//! Quantities of a model that print alike: m1 and m_1, phi and φ, two equal `symbol`.

use mechanics::Model;
use report::formula::Printer;
use std::collections::HashMap;
use std::ops::Range;
use symbolic::{Node, SymbolId};
use words::{Language, Notice, Text, letters};

/// A warning for each quantity that is printed as an earlier one with another name.
pub fn printed_alike(model: &Model) -> Vec<Notice> {
    let printer = Printer::new(Language::En).with_notation(model.notation.clone());
    let mut first: HashMap<String, Named> = HashMap::new();
    let mut found = Vec::new();
    for named in all(model) {
        let shown = printer.shown(named.name);
        match first.get(&shown) {
            Some(other) if other.is_confused_with(&named) => found.push(warning(other, &named, &shown)),
            Some(_) => {}
            None => {
                first.insert(shown, named);
            }
        }
    }
    found
}

/// A quantity of the model: its name, its symbol, its place.
struct Named<'a> {
    name: &'a str,
    symbol: SymbolId,
    span: Range<usize>,
}

impl Named<'_> {
    /// An output may repeat a parameter by value; letters that look alike have a warning of their own.
    fn is_confused_with(&self, other: &Named) -> bool {
        self.symbol != other.symbol && self.name != other.name && letters::skeleton(self.name) != letters::skeleton(other.name)
    }
}

/// Coordinates, parameters and outputs; an output that only shows another quantity has its symbol.
fn all(model: &Model) -> impl Iterator<Item = Named<'_>> {
    let coordinates = model.coordinates.iter().map(|c| Named { name: &c.name, symbol: c.symbols[0], span: c.span.clone() });
    let parameters = model.parameters.iter().filter_map(|p| Some(Named { name: &p.name, symbol: p.symbol, span: p.span.clone()? }));
    let outputs = model.outputs.iter().map(|o| {
        let symbol = match model.graph.node(o.formula) {
            Node::Symbol(shown) => *shown,
            _ => o.symbol,
        };
        Named { name: &o.name, symbol, span: o.span.clone() }
    });
    coordinates.chain(parameters).chain(outputs)
}

fn warning(other: &Named, named: &Named, shown: &str) -> Notice {
    let (other, name, place, span) = (other.name, named.name, other.span.clone(), named.span.clone());
    let what = Text::new(
        format!("`{other}` and `{name}` are printed alike: {shown}"),
        format!("`{other}` и `{name}` печатаются одинаково: {shown}"),
    );
    Notice::file("M141", span, what)
        .warning()
        .why("the printed equations do not tell them apart", "по печатным уравнениям их не различить")
        .help("rename one, or give it another symbol = \"...\"", "переименуйте одну или задайте ей другое symbol = \"...\"")
        .related(place, Text::new("the other one", "другая величина"))
}
