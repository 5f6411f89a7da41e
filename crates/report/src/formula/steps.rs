//! Left sides of the written derivation: T₁, ∂T/∂φ', d/dt ∂T/∂φ'.

use super::classes::SymbolClass;
use super::layout::{Layout, Shape};
use super::names;
use super::order::Side;
use super::printer::Printer;
use symbolic::equations::StepName;
use symbolic::{Expr, Graph};

impl Printer {
    /// The layout of a left side.
    pub fn step_name(&self, graph: &Graph, name: &StepName) -> Layout {
        match name {
            StepName::Quantity { letter, index } => self.quantity(letter, index),
            StepName::Partial { of, by } => self.partial(graph, of, *by),
            StepName::TimeDerivativeOfPartial { of, by } => {
                let by_time = fraction(Layout::Words("d".into()), Layout::Row(vec![Layout::Words("d".into()), self.quantity("t", "")]));
                Layout::Row(vec![by_time, Layout::Words(" ".into()), self.partial(graph, of, *by)])
            }
            StepName::Formula(e) => self.layout(graph, *e),
        }
    }

    /// The order of the terms on the right of this left side.
    pub(super) fn step_side(&self, graph: &Graph, name: &StepName) -> Side {
        let own = |by: Expr| {
            let standing = self.classes.standing(graph, graph.as_symbol(by)?);
            (standing.class == SymbolClass::Rate).then_some(standing.rank as usize)
        };
        match name {
            StepName::Partial { by, .. } => own(*by).map_or(Side::Plain, Side::Momentum),
            StepName::TimeDerivativeOfPartial { by, .. } => own(*by).map_or(Side::Plain, Side::Left),
            _ => Side::Plain,
        }
    }

    /// `v^2` with the index `C` is the square of v with the subscript C.
    fn quantity(&self, letter: &str, index: &str) -> Layout {
        let (letter, exponent) = letter.split_once('^').unwrap_or((letter, ""));
        let mut identifier = names::identifier(letter, self.language);
        // an index is the name of a body or coordinate: the user's symbol of that name, else the name itself
        let index = self.notation_of(index).unwrap_or(index);
        names::append_index(&mut identifier.subscript, index, self.language);
        if letter == "Π" || letter == "Φ" {
            identifier.shape = Shape::Upright;
        }
        let symbol = Layout::Symbol(identifier);
        if exponent.is_empty() { symbol } else { Layout::Power(Box::new(symbol), Box::new(Layout::digits(exponent))) }
    }

    fn partial(&self, graph: &Graph, of: &str, by: Expr) -> Layout {
        let d = || Layout::Words("∂".into());
        fraction(Layout::Row(vec![d(), self.quantity(of, "")]), Layout::Row(vec![d(), self.layout(graph, by)]))
    }
}

fn fraction(above: Layout, below: Layout) -> Layout {
    Layout::Fraction(Box::new(above), Box::new(below))
}
