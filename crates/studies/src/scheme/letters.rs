//! Letters of formulas: a symbol as it is, a short formula as it is written, anything else by the name of its element.

use crate::machine::Machine;
use report::formula::{Form, Printer};
use report::scheme::LabelText;
use symbolic::{Expr, Graph, Node};
use words::Language;

/// Longest formula beside a symbol.
const LONGEST: usize = 14;

/// Letters of a machine.
pub struct Letters<'a> {
    machine: &'a Machine,
    printer: Printer,
}

impl Letters<'_> {
    /// Letters in a language.
    pub fn new(machine: &Machine, language: Language) -> Letters<'_> {
        Letters { machine, printer: Printer::of(&machine.equations, language) }
    }

    /// The printed symbol of a name of the file.
    pub fn named(&self, name: &str) -> LabelText {
        let notation = &self.machine.model.notation;
        let shown = notation.iter().find(|(n, _)| n == name).map_or(name, |(_, symbol)| symbol);
        LabelText::Symbol(shown.to_owned())
    }

    /// The letter of a formula of the model that is nothing but a symbol.
    pub fn symbol(&self, e: Expr) -> Option<LabelText> {
        let graph = &self.machine.model.graph;
        let symbol = graph.as_symbol(e)?;
        Some(self.named(&graph.symbol_info(symbol).name))
    }

    /// What stands beside an element.
    pub fn of(&self, e: Expr, path: &str) -> LabelText {
        let graph = &self.machine.model.graph;
        if let Some(letter) = self.symbol(e) {
            return letter;
        }
        let free = graph.symbols_in(&[e]).is_empty();
        let text = self.printer.inline(graph, e, Form::Text);
        if !free && text.chars().count() <= LONGEST && !text.contains('\n') && !asks(graph, e) {
            return LabelText::Formula(text);
        }
        self.only(e).unwrap_or_else(|| self.load(path))
    }

    /// The letter of a formula that has one parameter only.
    fn only(&self, e: Expr) -> Option<LabelText> {
        let graph = &self.machine.model.graph;
        let symbols = graph.symbols_in(&[e]);
        let mut parameters = self.machine.model.parameters.iter().filter(|p| symbols.binary_search(&p.symbol).is_ok());
        let first = parameters.next()?;
        parameters.next().is_none().then(|| self.named(&first.name))
    }

    /// A letter for a force that the file does not name, other than all letters of the machine.
    pub fn free(&self, wanted: &str) -> LabelText {
        let equations = &self.machine.equations;
        let shown = |name: &str| equations.notation.iter().find(|(n, _)| n == name).map_or(name, |(_, shown)| shown).to_owned();
        let outputs = equations.outputs.iter().map(|o| shown(&o.name));
        let parameters = self.machine.model.parameters.iter().map(|p| shown(&p.name));
        let taken: Vec<String> = outputs.chain(parameters).collect();
        let mut letter = wanted.to_owned();
        while taken.contains(&letter) {
            letter.insert(1, '\'');
        }
        LabelText::Symbol(letter)
    }

    /// The usual letter of an element without one of its own, from its place in the file; numbered where the file has several.
    pub fn load(&self, path: &str) -> LabelText {
        let (table, name) = path.split_once('.').unwrap_or(("", path));
        if is_letter(name) {
            return self.named(name);
        }
        let letter = crate::shown::find(table).map_or("", |row| row.letter);
        let model = &self.machine.model;
        let elements = model.elements.iter().map(|e| e.path.clone());
        let connections = model.connections.iter().map(|c| format!("{}.{}", c.table, c.name));
        let same: Vec<String> = elements.chain(connections).filter(|p| p.split('.').next() == Some(table)).collect();
        match same.iter().position(|p| p == path) {
            _ if letter.is_empty() => self.named(name),
            Some(i) if same.len() > 1 => LabelText::Symbol(format!("{letter}_{}", i + 1)),
            _ => LabelText::Symbol(letter.to_owned()),
        }
    }
}

/// Whether a name of the file can stand in a figure: a letter with its indices, a Greek one, not a word.
fn is_letter(name: &str) -> bool {
    let letters = name.chars().filter(|c| c.is_alphabetic()).count();
    let greek = report::symbol::plain(name, Language::En) != name;
    letters <= 3 && (greek || !crate::naming::is_word(name))
}

/// Whether a formula asks the machine for something: its placeholders are no letters.
fn asks(graph: &Graph, e: Expr) -> bool {
    graph.reachable(&[e]).into_iter().any(|e| match graph.node(e) {
        Node::Switch { .. } => true,
        Node::Symbol(s) => graph.symbol_info(*s).name.contains('('),
        _ => false,
    })
}
