//! The printer: language, symbols, and the functions that callers use.

use super::classes::Classes;
use super::layout::{Identifier, Layout, Placement, Shape, Sign};
use super::set::{self, Form, Formula};
use super::{SymbolClass, names, text};
use symbolic::{Equations, Expr, Graph, Symbol, SymbolId};
use words::Language;

/// Prints expressions of one graph.
#[derive(Clone, Debug)]
pub struct Printer {
    pub(super) language: Language,
    pub(super) classes: Classes,
    /// The letter e is a variable here, so the exponential is written `exp`.
    pub(super) e_is_taken: bool,
    notation: Vec<(String, String)>,
    /// Names of parameters and coordinates.
    words: Vec<String>,
    width: Option<usize>,
    /// Parameters whose numbers are positive.
    positive: Vec<SymbolId>,
    /// Expressions whose sign is known, of the graph that is printed.
    signs: Vec<(Expr, Sign)>,
    /// Whether numbers are rounded to what a reader takes in.
    pub(super) rounded: bool,
    /// Symbols that are printed as numbers.
    values: Vec<(SymbolId, f64)>,
}

impl Printer {
    /// A printer that takes every symbol for a constant.
    pub fn new(language: Language) -> Printer {
        Printer {
            language,
            classes: Classes::default(),
            e_is_taken: false,
            notation: vec![],
            words: vec![],
            width: None,
            positive: vec![],
            signs: vec![],
            rounded: false,
            values: vec![],
        }
    }

    /// A printer that knows what the symbols of `equations` are and how the user wants to see them.
    pub fn of(equations: &Equations, language: Language) -> Printer {
        let graph = &equations.graph;
        let listed = equations.parameters.iter().map(|p| p.symbol).chain(equations.definitions.iter().map(|d| d.symbol));
        let listed = listed.chain(equations.coordinates.iter().map(|c| c.symbols[0]));
        let words: Vec<String> = listed.map(|s| graph.symbol_info(s).name.clone()).collect();
        let e_is_taken = words.iter().any(|word| word == "e");
        let mut positive: Vec<SymbolId> = equations.parameters.iter().filter(|p| p.value > 0.0).map(|p| p.symbol).collect();
        positive.sort();
        Printer {
            positive,
            classes: Classes::of(equations),
            e_is_taken,
            notation: equations.notation.clone(),
            words,
            ..Printer::new(language)
        }
    }

    /// The same printer in another language.
    pub fn with_language(mut self, language: Language) -> Printer {
        self.language = language;
        self
    }

    /// Symbols to print instead of names, as (name, symbol): `("mass", "m")`, `("shaft_speed", "ω_в")`.
    pub fn with_notation(mut self, notation: Vec<(String, String)>) -> Printer {
        self.notation = notation;
        self
    }

    /// The greatest length of a line, in characters of the text form (0.45 em of a formula that is set); longer formulas are broken at top-level signs, the sign
    /// repeated on the next line.
    pub fn with_width(mut self, width: usize) -> Printer {
        self.width = Some(width);
        self
    }

    /// Numbers in place of these symbols, so that a formula is followed by its substitution.
    pub fn with_values(mut self, mut values: Vec<(SymbolId, f64)>) -> Printer {
        values.sort_by_key(|(symbol, _)| *symbol);
        self.values = values;
        self
    }

    /// Expressions of the graph that is printed, or of one that grew out of it, whose sign is known: √((4 − s)²) is written 4 − s where that is positive.
    pub fn with_signs(mut self, mut signs: Vec<(Expr, Sign)>) -> Printer {
        signs.sort_by_key(|(e, _)| *e);
        self.signs = signs;
        self
    }

    /// The sign of an expression, where it is known.
    pub(super) fn sign_of(&self, e: Expr) -> Option<Sign> {
        self.signs.binary_search_by_key(&e, |(known, _)| *known).ok().map(|i| self.signs[i].1)
    }

    /// Numbers with all digits that a reader takes in, and no more: 0.333333 and not 1/3 of a long fraction.
    pub fn rounded(mut self) -> Printer {
        self.rounded = true;
        self
    }

    /// Whether a parameter has a positive number.
    pub(super) fn is_positive(&self, symbol: SymbolId) -> bool {
        self.positive.binary_search(&symbol).is_ok()
    }

    /// The number that stands for a symbol.
    pub(super) fn value_of(&self, symbol: SymbolId) -> Option<f64> {
        self.values.binary_search_by_key(&symbol, |(s, _)| *s).ok().map(|i| self.values[i].1)
    }

    /// Declares what a symbol is; `rank` orders the symbols of a class (the number of the coordinate).
    pub fn with_class(mut self, symbol: SymbolId, class: SymbolClass, rank: u32) -> Printer {
        self.classes.set(symbol, class, rank);
        self
    }

    /// A symbol alone.
    pub fn symbol(&self, graph: &Graph, symbol: SymbolId, form: Form) -> String {
        self.write(&self.symbol_layout(graph, symbol), form, Placement::Inline)
    }

    /// The layout of a symbol.
    pub fn symbol_layout(&self, graph: &Graph, symbol: SymbolId) -> Layout {
        Layout::Symbol(self.identifier(graph.symbol_info(symbol)))
    }

    /// A symbol for the axis of a plot: plain Unicode with dots above, `φ̇₁`.
    pub fn label(&self, graph: &Graph, symbol: SymbolId) -> String {
        text::label(&self.identifier(graph.symbol_info(symbol)))
    }

    /// Writes a layout.
    pub fn write(&self, layout: &Layout, form: Form, placement: Placement) -> String {
        set::write(layout, form, placement, self.width)
    }

    /// A layout on lines of its own, of the printer's width.
    pub fn block(&self, layout: Layout) -> Formula {
        Formula { layout, placement: Placement::Block, width: self.width }
    }

    /// A symbol as letter, dots and subscript.
    pub fn identifier(&self, symbol: &Symbol) -> Identifier {
        let mut identifier = self.named(self.notation_of(&symbol.name).unwrap_or(&symbol.name));
        identifier.primes = symbol.primes.saturating_add(identifier.primes);
        identifier
    }

    /// A written symbol (a name of the model, or what the user wants to see instead) as letter, dots and subscript.
    pub fn named(&self, name: &str) -> Identifier {
        let bare = name.trim_end_matches(['\'', '′']);
        let primes = name[bare.len()..].chars().count();
        Identifier { primes: u8::try_from(primes).unwrap_or(u8::MAX), ..names::identifier(bare, self.language) }
    }

    /// A name of the model as plain text, the way a reader sees it.
    pub fn shown(&self, name: &str) -> String {
        text::label(&self.named(self.notation_of(name).unwrap_or(name)))
    }

    /// Whether a parameter or coordinate of the model is printed so.
    pub(super) fn is_word(&self, shown: &str) -> bool {
        self.words.iter().any(|word| self.shown(word) == shown)
    }

    pub(super) fn notation_of(&self, name: &str) -> Option<&str> {
        self.notation.iter().find(|(n, _)| n == name).map(|(_, shown)| shown.as_str())
    }

    pub(super) fn pi(&self) -> Identifier {
        Identifier { base: "π".into(), shape: Shape::Upright, primes: 0, subscript: vec![] }
    }
}
