//! Tokens to a tree.
//!
//! The tree lies flat in a vector, children before parents, sums and products with all their operands in one node: every later pass is
//! a loop over the vector and no formula, however long, can exhaust the stack. Only brackets, calls, signs and powers nest, and their
//! depth is limited.
//!
//! Precedence from loose to tight: `+ -`, then `* /` (from the left), sign, `^` (from the right; `-a^2` is -(a²), `a^-b` is allowed).

mod calls;

use super::kinematic::KinematicFunction;
use super::lex::{Spanned, Token, tokens};
use crate::units::{Dimension, Quantity, Unit};
use std::ops::Range;
use symbolic::{Function, Rational};
use words::Notice;

/// Deepest nesting of brackets, calls, signs and powers.
pub(super) const MAX_DEPTH: usize = 100;

/// Index of a node in a formula.
pub(crate) type NodeId = usize;

/// A node of a formula.
#[derive(Clone, Debug)]
pub(crate) enum Ast {
    Number(Rational),
    /// A number with a unit: `30 [rad/s^2]`.
    Quantity(Box<Quantity>),
    Name {
        name: String,
        primes: u8,
    },
    /// Summands; true when subtracted.
    Sum(Vec<(bool, NodeId)>),
    /// Factors; true when divided by.
    Product(Vec<(bool, NodeId)>),
    Power(NodeId, NodeId),
    Call(Function, Vec<NodeId>),
    Sqrt(NodeId),
    /// A kinematic function with the names in its brackets.
    Kinematic {
        function: &'static KinematicFunction,
        arguments: Vec<(Option<String>, String, Range<usize>)>,
    },
    /// `if(left < right, then, otherwise)`.
    If {
        comparison: Comparison,
        left: NodeId,
        right: NodeId,
        then: NodeId,
        otherwise: NodeId,
    },
}

/// How the sides of a condition compare.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Comparison {
    Less,
    LessEqual,
    Greater,
    GreaterEqual,
}

/// A parsed formula. The last node is the root.
#[derive(Clone, Debug)]
pub(crate) struct Formula {
    pub nodes: Vec<(Ast, Range<usize>)>,
}

impl Formula {
    /// A formula that is one quantity.
    pub(crate) fn quantity(quantity: Quantity, span: Range<usize>) -> Formula {
        let node = if quantity.has_unit { Ast::Quantity(Box::new(quantity)) } else { Ast::Number(quantity.number) };
        Formula { nodes: vec![(node, span)] }
    }
    pub(crate) fn root(&self) -> NodeId {
        self.nodes.len() - 1
    }
    /// The names it uses, with their places.
    pub(crate) fn names(&self) -> impl Iterator<Item = (&str, &Range<usize>)> {
        self.nodes.iter().filter_map(|(node, span)| match node {
            Ast::Name { name, .. } => Some((name.as_str(), span)),
            _ => None,
        })
    }
    /// Whether all numbers with units are of dimensions that this allows.
    pub(crate) fn has_units(&self, allowed: impl Fn(&Dimension) -> bool) -> bool {
        self.nodes.iter().all(|(node, _)| if let Ast::Quantity(q) = node { allowed(&q.unit.dimension) } else { true })
    }
    /// The number it is, when it is one number without a unit and not zero.
    pub(crate) fn bare_number(&self) -> Option<&Rational> {
        match &self.nodes[..] {
            [(Ast::Number(n), _)] => Some(n),
            _ => None,
        }
    }
    /// Whether it is one number other than zero, without a unit.
    pub(crate) fn is_bare_number(&self) -> bool {
        self.bare_number().is_some_and(|n| !n.is_zero())
    }
    /// Whether it is written as one number other than zero, perhaps with a sign, without a unit.
    pub(crate) fn lacks_unit(&self) -> bool {
        let mut value = false;
        let plain = self.nodes.iter().all(|(node, _)| match node {
            Ast::Number(n) => {
                value |= !n.is_zero();
                true
            }
            Ast::Sum(terms) => terms.len() == 1,
            _ => false,
        });
        plain && value
    }
    /// Whether it is made of numbers, some in a unit that is not the SI one; a part without a dimension (20 %) counts as a number.
    pub(crate) fn is_scaled(&self) -> bool {
        self.is_symbol_free() && self.nodes.iter().any(|(node, _)| matches!(node, Ast::Quantity(q) if q.unit.is_scaled()))
    }
    /// The place of its quantity, when only one stands in it.
    pub(crate) fn only_quantity(&self) -> Option<Range<usize>> {
        let mut places = self.nodes.iter().filter(|(node, _)| matches!(node, Ast::Quantity(_))).map(|(_, span)| span.clone());
        places.next().filter(|_| places.next().is_none())
    }
    /// Whether it contains nothing but numbers.
    pub(crate) fn is_symbol_free(&self) -> bool {
        self.nodes.iter().all(|(node, _)| match node {
            Ast::Name { name, .. } => name == "pi" || name == "π",
            Ast::Kinematic { .. } => false,
            _ => true,
        })
    }
    /// Whether a kinematic function stands in it.
    pub(crate) fn asks_the_machine(&self) -> bool {
        self.nodes.iter().any(|(node, _)| matches!(node, Ast::Kinematic { .. }))
    }
    /// Whether it is written as one number or quantity with an optional sign.
    pub(crate) fn is_literal(&self) -> bool {
        self.nodes.iter().all(|(node, _)| match node {
            Ast::Number(_) | Ast::Quantity(_) => true,
            Ast::Sum(terms) => terms.len() == 1,
            _ => false,
        })
    }
}

/// Parses a formula over the kinematic functions that there are.
pub(crate) fn parse(text: &str, functions: &[&'static KinematicFunction]) -> Result<Formula, Notice> {
    let tokens = tokens(text)?;
    let mut parser = Parser { text, functions, tokens, at: 0, nodes: Vec::new(), depth: 0, calls: 0 };
    parser.sum()?;
    match parser.peek() {
        Token::End => Ok(Formula { nodes: parser.nodes }),
        _ => Err(parser.unexpected("an operator or the end", "знак действия или конец формулы")),
    }
}

struct Parser<'a> {
    text: &'a str,
    functions: &'a [&'static KinematicFunction],
    tokens: Vec<Spanned>,
    at: usize,
    nodes: Vec<(Ast, Range<usize>)>,
    depth: usize,
    /// how many function brackets are open: there a comma separates arguments
    calls: usize,
}

impl Parser<'_> {
    fn peek(&self) -> &Token {
        &self.tokens[self.at].0
    }
    fn span(&self) -> Range<usize> {
        self.tokens[self.at].1.clone()
    }
    fn advance(&mut self) -> Token {
        let token = self.tokens[self.at].0.clone();
        if self.at + 1 < self.tokens.len() {
            self.at += 1;
        }
        token
    }
    fn take(&mut self, token: &Token) -> bool {
        let found = self.peek() == token;
        if found {
            self.advance();
        }
        found
    }
    fn push(&mut self, node: Ast, from: usize) -> NodeId {
        let to = self.tokens[self.at.saturating_sub(1)].1.end;
        self.nodes.push((node, from..to.max(from)));
        self.nodes.len() - 1
    }
    fn deeper<T>(&mut self, inner: impl FnOnce(&mut Self) -> Result<T, Notice>) -> Result<T, Notice> {
        self.depth += 1;
        if self.depth > MAX_DEPTH {
            return Err(Notice::piece(
                "M032",
                self.span(),
                format!("the formula is nested deeper than {MAX_DEPTH} levels"),
                format!("вложенность формулы больше {MAX_DEPTH} уровней"),
            )
            .help("name inner parts as parameters or outputs", "вынесите внутренние части в параметры или выходные величины"));
        }
        let result = inner(self);
        self.depth -= 1;
        result
    }

    fn sum(&mut self) -> Result<NodeId, Notice> {
        let from = self.span().start;
        let first = self.product()?;
        let mut terms = vec![(false, first)];
        loop {
            let negative = match self.peek() {
                Token::Plus => false,
                Token::Minus => true,
                _ => break,
            };
            self.advance();
            terms.push((negative, self.product()?));
        }
        Ok(if terms.len() == 1 { first } else { self.push(Ast::Sum(terms), from) })
    }

    fn product(&mut self) -> Result<NodeId, Notice> {
        let from = self.span().start;
        let first = self.signed()?;
        let mut factors = vec![(false, first)];
        loop {
            let inverse = match self.peek() {
                Token::Star => false,
                Token::Slash => true,
                _ => break,
            };
            self.advance();
            factors.push((inverse, self.signed()?));
        }
        Ok(if factors.len() == 1 { first } else { self.push(Ast::Product(factors), from) })
    }

    fn signed(&mut self) -> Result<NodeId, Notice> {
        let from = self.span().start;
        match self.peek() {
            Token::Plus => {
                self.advance();
                self.deeper(Self::signed)
            }
            Token::Minus => {
                self.advance();
                let inner = self.deeper(Self::signed)?;
                Ok(self.push(Ast::Sum(vec![(true, inner)]), from))
            }
            _ => self.power(),
        }
    }

    fn power(&mut self) -> Result<NodeId, Notice> {
        let from = self.span().start;
        let base = self.primary()?;
        if !self.take(&Token::Caret) {
            return Ok(base);
        }
        let exponent = self.deeper(Self::signed)?;
        Ok(self.push(Ast::Power(base, exponent), from))
    }

    fn primary(&mut self) -> Result<NodeId, Notice> {
        let span = self.span();
        match self.peek().clone() {
            Token::Number(value) => {
                self.advance();
                self.number(value, span)
            }
            Token::Name(name, primes) => {
                self.advance();
                if primes == 0 && *self.peek() == Token::Open {
                    return self.call(&name, span);
                }
                self.no_juxtaposition(&span)?;
                Ok(self.push(Ast::Name { name, primes }, span.start))
            }
            Token::Open => {
                self.advance();
                let calls = std::mem::take(&mut self.calls);
                let inner = self.deeper(Self::sum)?;
                self.calls = calls;
                self.close(&span)?;
                Ok(inner)
            }
            Token::Unit(_) => Err(Notice::piece("M030", span, "a unit stands without a number", "единица стоит без числа")
                .help("write `1 [m]`", "напишите `1 [м]`")),
            _ => Err(self.unexpected("a number, a name or `(`", "число, имя или `(`")),
        }
    }

    fn number(&mut self, number: Rational, span: Range<usize>) -> Result<NodeId, Notice> {
        let Token::Unit(unit) = self.peek().clone() else {
            self.no_juxtaposition(&span)?;
            return Ok(self.push(Ast::Number(number), span.start));
        };
        let unit: Unit = *unit;
        self.advance();
        if *self.peek() == Token::Caret {
            return Err(Notice::piece(
                "M030",
                self.span(),
                "it is not clear what this power applies to",
                "неясно, к чему относится эта степень",
            )
            .help("write `3 [m^2]` or `(3 [m])^2`", "напишите `3 [м^2]` или `(3 [м])^2`"));
        }
        let quantity = Quantity { number, unit, has_unit: true };
        let value = quantity.to_f64();
        if !value.is_finite() {
            return Err(crate::units::out_of_range(span));
        }
        Ok(self.push(Ast::Quantity(Box::new(quantity)), span.start))
    }

    /// `20 g` and `2 x` are neither products nor quantities inside a formula.
    fn no_juxtaposition(&self, before: &Range<usize>) -> Result<(), Notice> {
        let next = self.span();
        let written = &self.text[before.start..next.end.max(before.start)];
        let left = &self.text[before.clone()];
        let right = &self.text[next.clone()];
        match self.peek() {
            Token::Name(word, 0) if matches!(word.as_str(), "and" | "or") => Ok(()),
            Token::Name(..) if self.is_exponent() => Err(Notice::piece(
                "M035",
                before.start..next.end,
                format!("`{written}`: a unit follows a power"),
                format!("`{written}`: единица стоит после степени"),
            )
            .help(
                format!("write 10^3 as 1e3: `1e{left} {right}`; in a formula `10^{left}*1 [{right}]`"),
                format!("запишите 10^3 как 1e3: `1e{left} {right}`; в формуле `10^{left}*1 [{right}]`"),
            )),
            Token::Name(..) | Token::Number(_) if left.starts_with(|c: char| c.is_ascii_digit() || c == '.') => {
                let fault = Notice::piece(
                    "M035",
                    before.start..next.end,
                    format!("`{written}`: nothing joins the number and what follows"),
                    format!("`{written}`: между числом и тем, что за ним, нет знака"),
                );
                Err(match crate::units::parse_unit(right) {
                    Ok(_) => fault.help(
                        format!("a unit in a formula stands in square brackets: `{left} [{right}]`; a product is written `{left}*{right}`"),
                        format!("единица в формуле стоит в квадратных скобках: `{left} [{right}]`; произведение пишут `{left}*{right}`"),
                    ),
                    Err(_) => {
                        fault.help(format!("write a product as `{left}*{right}`"), format!("запишите произведение: `{left}*{right}`"))
                    }
                })
            }
            Token::Name(..) | Token::Number(_) => Err(Notice::piece(
                "M030",
                next,
                format!("nothing joins `{left}` and `{right}`"),
                format!("между `{left}` и `{right}` нет знака действия"),
            )
            .help(format!("write a product as `{left}*{right}`"), format!("запишите произведение: `{left}*{right}`"))),
            Token::Unit(_) => Err(Notice::piece("M030", next, "a unit stands after a name", "единица стоит после имени").help(
                "names already carry their units; brackets follow numbers only",
                "имена уже несут свои единицы; скобки ставят только после чисел",
            )),
            _ => Ok(()),
        }
    }

    /// Whether the number just read is the exponent of ten: `10^3 N`.
    fn is_exponent(&self) -> bool {
        let before = |n: usize| self.at.checked_sub(n).map(|i| &self.tokens[i].0);
        let signed = matches!(before(2), Some(Token::Minus));
        let (caret, base) = if signed { (before(3), before(4)) } else { (before(2), before(3)) };
        matches!(caret, Some(Token::Caret)) && matches!(base, Some(Token::Number(n)) if n.to_i64() == Some(10))
    }

    fn close(&mut self, open: &Range<usize>) -> Result<(), Notice> {
        if self.take(&Token::Close) {
            return Ok(());
        }
        if *self.peek() == Token::End {
            return Err(Notice::piece("M030", open.clone(), "`(` is never closed", "скобка `(` не закрыта"));
        }
        Err(self.unexpected("`)`", "`)`"))
    }

    fn unexpected(&self, en: &str, ru: &str) -> Notice {
        let span = self.span();
        if *self.peek() == Token::Comma
            && let Some(fault) = self.decimal_comma()
        {
            return fault;
        }
        let (found_en, found_ru) = match self.peek() {
            Token::End => ("the formula ends".to_owned(), "формула кончилась".to_owned()),
            _ => (format!("found `{}`", &self.text[span.clone()]), format!("стоит `{}`", &self.text[span.clone()])),
        };
        let span = if span.is_empty() { self.last_char() } else { span };
        let fault = Notice::piece("M030", span, format!("expected {en}, {found_en}"), format!("ожидается {ru}, {found_ru}"));
        match self.peek() {
            Token::Less | Token::LessEqual | Token::Greater | Token::GreaterEqual => fault.help(
                "a comparison stands only first in if(a < b, value, other value)",
                "сравнение стоит только на первом месте в if(a < b, значение, другое значение)",
            ),
            Token::Comma => fault.help(
                "commas separate the arguments of functions; the decimal mark in formulas is a point",
                "запятая разделяет аргументы функций; дробная часть в формулах отделяется точкой",
            ),
            _ => fault,
        }
    }

    /// The last character, so that "the formula ends" has something to point at.
    fn last_char(&self) -> Range<usize> {
        let end = self.text.trim_end().len();
        let start = self.text[..end].char_indices().next_back().map_or(0, |(i, _)| i);
        start..end
    }

    /// The fault of `2,5` outside of function brackets.
    fn decimal_comma(&self) -> Option<Notice> {
        let before = self.at.checked_sub(1).map(|i| &self.tokens[i])?;
        let after = self.tokens.get(self.at + 1)?;
        let comma = self.span();
        let numbers = matches!(before.0, Token::Number(_)) && matches!(after.0, Token::Number(_));
        if !numbers || before.1.end != comma.start || comma.end != after.1.start {
            return None;
        }
        let span = before.1.start..after.1.end;
        if let Some(fault) = self.grouped(before.1.start) {
            return Some(fault);
        }
        let (left, right) = (&self.text[before.1.clone()], &self.text[after.1.clone()]);
        Some(
            Notice::piece(
                "M031",
                span,
                format!("decimal comma in a formula: `{left},{right}`"),
                format!("запятая в числе внутри формулы: `{left},{right}`"),
            )
            .why(
                "in formulas a comma separates arguments; decimal commas are for quantity strings such as \"12,5 kg\"",
                "в формулах запятая разделяет аргументы; дробная запятая допустима в строках-величинах, например \"12,5 кг\"",
            )
            .help(format!("write `{left}.{right}`"), format!("напишите `{left}.{right}`")),
        )
    }
}
