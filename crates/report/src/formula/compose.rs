//! Expression to layout.

use super::layout::{Bracket, Layout, Sign};
use super::numeral::{Numeral, numeral};
use super::order::{Side, Survey};
use super::printer::Printer;
use symbolic::{Expr, Graph, Node, Rational, SymbolId};

/// A formula of more boxes, or nested deeper, is cut with an ellipsis: shared parts would otherwise be written out without bound.
const BOXES: usize = 20_000;
const DEPTH: usize = 60;

/// The state of one composition.
pub(super) struct Composer<'a> {
    pub graph: &'a Graph,
    pub printer: &'a Printer,
    pub survey: Survey<'a>,
    boxes: usize,
    depth: usize,
}

impl<'a> Composer<'a> {
    pub fn new(graph: &'a Graph, printer: &'a Printer) -> Composer<'a> {
        Composer { graph, printer, survey: Survey::new(graph, &printer.classes), boxes: 0, depth: 0 }
    }

    /// The layout of `e` with a sign before it.
    pub fn compose(&mut self, e: Expr, sign: Sign, side: Side) -> Layout {
        self.boxes += 1;
        if self.boxes > BOXES || self.depth > DEPTH {
            return Layout::Words("…".into());
        }
        self.depth += 1;
        let layout = self.node(e, sign, side);
        self.depth -= 1;
        layout
    }

    fn node(&mut self, e: Expr, sign: Sign, side: Side) -> Layout {
        let graph = self.graph;
        let one = match sign {
            Sign::Plus => Rational::ONE,
            Sign::Minus => Rational::MINUS_ONE,
        };
        match graph.node(e) {
            Node::Sum { constant, terms } => self.sum((constant, terms), sign, side),
            Node::Product { coefficient, factors } => {
                let (sign, body) = self.product(&(coefficient * &one), factors);
                Layout::signed(sign, body)
            }
            Node::Number(r) => {
                let r = r * &one;
                Layout::signed(sign_of(&r), self.number(&r))
            }
            _ => {
                let (sign, body) = self.product(&one, &[(e, Rational::ONE)]);
                Layout::signed(sign, body)
            }
        }
    }

    /// A constant and terms with a sign before the whole.
    pub fn sum(&mut self, (constant, terms): (&Rational, &[(Expr, Rational)]), sign: Sign, side: Side) -> Layout {
        let mut items = Vec::with_capacity(terms.len() + 1);
        let ordered = self.ordered(terms, side);
        for (term, factor) in ordered {
            let factor = if sign == Sign::Minus { -&factor } else { factor };
            let factors = match self.graph.node(term) {
                Node::Product { factors, .. } => factors.to_vec(),
                _ => vec![(term, Rational::ONE)],
            };
            items.push(self.product(&factor, &factors));
        }
        if !constant.is_zero() {
            let item = (if sign == Sign::Minus { sign_of(constant).flipped() } else { sign_of(constant) }, self.number(constant));
            items.insert(if side == Side::Plain { 0 } else { items.len() }, item);
        }
        // a sum starts with a positive term when it has one
        if let Some(i) = items.iter().position(|t| t.0 == Sign::Plus) {
            items[..=i].rotate_right(1);
        }
        Layout::Sum(items)
    }

    fn ordered(&mut self, terms: &[(Expr, Rational)], side: Side) -> Vec<(Expr, Rational)> {
        let side = self.survey.settle_side(terms, side);
        let mut ordered = terms.to_vec();
        ordered.sort_by_cached_key(|(term, _)| self.survey.term_key(*term, side));
        ordered
    }

    /// Whether the first term in print order has a minus.
    pub fn leads_negative(&mut self, e: Expr, side: Side) -> bool {
        match self.graph.node(e) {
            Node::Sum { constant, .. } if side == Side::Plain && !constant.is_zero() => constant.is_negative(),
            Node::Sum { terms, .. } => self.ordered(terms, side).first().is_some_and(|t| t.1.is_negative()),
            _ => false,
        }
    }

    /// How |r| is written.
    pub fn numeral(&self, r: &Rational) -> Numeral {
        match self.printer.rounded {
            true => Numeral::Plain(super::numeral::size(r.to_f64(), self.printer.language)),
            false => numeral(r, self.printer.language),
        }
    }

    /// |r|.
    pub fn number(&self, r: &Rational) -> Layout {
        match self.numeral(r) {
            Numeral::Plain(number) => number,
            Numeral::Ratio(n, d) => Layout::Fraction(Box::new(n), Box::new(d)),
        }
    }

    pub fn symbol(&self, id: SymbolId) -> Layout {
        match self.printer.value_of(id) {
            Some(value) => super::numeral::factor(value, self.printer.language),
            None => Layout::Symbol(self.printer.identifier(self.graph.symbol_info(id))),
        }
    }

    /// A base under an exponent: brackets around everything that is not one box.
    pub fn base(&mut self, e: Expr, sign: Sign) -> Layout {
        let layout = self.compose(e, sign, Side::Plain);
        match layout {
            Layout::Symbol(_) | Layout::Words(_) | Layout::Fence(..) | Layout::Number { exponent: None, .. } => layout,
            other => Layout::Fence(Bracket::Round, Box::new(other)),
        }
    }
}

fn sign_of(r: &Rational) -> Sign {
    if r.is_negative() { Sign::Minus } else { Sign::Plus }
}
