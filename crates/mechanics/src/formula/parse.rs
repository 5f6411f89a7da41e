//! Tokens to a tree.
//!
//! The tree lies flat in a vector, children before parents, sums and products with all their operands in one node: every later pass is
//! a loop over the vector and no formula, however long, can exhaust the stack. Only brackets, calls, signs and powers nest, and their
//! depth is limited.
//!
//! Precedence from loose to tight: `+ -`, then `* /` (from the left), sign, `^` (from the right; `-a^2` is -(a²), `a^-b` is allowed).

use super::kinematic::KinematicFunction;
use super::lex::{Spanned, Token, tokens};
use crate::units::{Quantity, Unit};
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

/// What `if` decides by.
enum Condition {
    Compare(Comparison, NodeId, NodeId),
    And(Box<(Condition, Condition)>),
    Or(Box<(Condition, Condition)>),
    Not(Box<Condition>),
}

/// How many arguments a function takes.
#[derive(Clone, Copy)]
enum Arity {
    Exactly(usize),
    AtLeast(usize),
}

impl Arity {
    fn words(self) -> (String, String) {
        match self {
            Arity::Exactly(0) => ("no argument".into(), "нет".into()),
            Arity::Exactly(1) => ("one argument".into(), "1".into()),
            Arity::Exactly(n) => (format!("{n} arguments"), n.to_string()),
            Arity::AtLeast(n) => (format!("{n} or more arguments"), format!("{n} и больше")),
        }
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

    /// Functions made of others: lg x = log x/log 10, cbrt x = sign(x) |x|^(1/3).
    fn composed(&mut self, name: &str, span: Range<usize>) -> Result<NodeId, Notice> {
        let open = self.span();
        self.advance();
        let arguments = self.arguments(&open)?;
        let [x] = arguments[..] else {
            return Err(self.arity(name, Arity::Exactly(1), arguments.len(), span));
        };
        let from = span.start;
        let factors = if name == "cbrt" {
            let size = self.push(Ast::Call(Function::Abs, vec![x]), from);
            let third = Rational::from(3).recip().unwrap_or(Rational::ONE);
            let third = self.push(Ast::Number(third), from);
            let root = self.push(Ast::Power(size, third), from);
            let sign = self.push(Ast::Call(Function::Sign, vec![x]), from);
            vec![(false, sign), (false, root)]
        } else {
            let above = self.push(Ast::Call(Function::Log, vec![x]), from);
            let ten = self.push(Ast::Number(Rational::from(10)), from);
            let below = self.push(Ast::Call(Function::Log, vec![ten]), from);
            vec![(false, above), (true, below)]
        };
        Ok(self.push(Ast::Product(factors), from))
    }

    /// The fault of `1,450,000 N`: commas that group digits.
    fn grouped(&self, from: usize) -> Option<Notice> {
        let text = &self.text[from..];
        let end = text.find(|c: char| !c.is_ascii_digit() && c != ',').unwrap_or(text.len());
        let mut groups = text[..end].split(',');
        let first = groups.next()?;
        let rest: Vec<&str> = groups.collect();
        let grouped = rest.len() >= 2 && (1..=3).contains(&first.len()) && rest.iter().all(|g| g.len() == 3);
        grouped.then(|| {
            let (written, plain) = (&text[..end], text[..end].replace(',', ""));
            Notice::piece(
                "M031",
                from..from + end,
                format!("commas between groups of digits: `{written}`"),
                format!("запятые между группами цифр: `{written}`"),
            )
            .why("a comma is a decimal mark or separates arguments", "запятая — десятичный знак или разделитель аргументов")
            .help(format!("write `{plain}`"), format!("напишите `{plain}`"))
        })
    }

    fn call(&mut self, name: &str, span: Range<usize>) -> Result<NodeId, Notice> {
        if name == "if" {
            return self.conditional(span);
        }
        if let Some(function) = self.functions.iter().find(|f| f.name == name) {
            return self.kinematic(function, span);
        }
        if let "lg" | "log10" | "cbrt" = name {
            return self.composed(name, span);
        }
        let function = Function::from_name(if name == "ln" { "log" } else { name });
        if function.is_none() && name != "sqrt" {
            return Err(unknown_function(name, span, self.functions));
        }
        let open = self.span();
        self.advance();
        let arguments = self.arguments(&open)?;
        let arity = function.map_or(1, Function::arity);
        let many = matches!(function, Some(Function::Min | Function::Max)) && arguments.len() > 2;
        if arguments.len() != arity && !many {
            let many = matches!(function, Some(Function::Min | Function::Max));
            let wanted = if many { Arity::AtLeast(arity) } else { Arity::Exactly(arity) };
            return Err(self.arity(name, wanted, arguments.len(), span));
        }
        Ok(match function {
            None => self.push(Ast::Sqrt(arguments[0]), span.start),
            Some(f) => self.push(Ast::Call(f, arguments), span.start),
        })
    }

    fn arity(&self, name: &str, wanted: Arity, got: usize, span: Range<usize>) -> Notice {
        let whole = span.start..self.tokens[self.at.saturating_sub(1)].1.end;
        let (en, ru) = wanted.words();
        let fault = Notice::piece(
            "M034",
            whole,
            format!("{name}(...) takes {en}, {got} given"),
            format!("функция {name}(...) принимает аргументов: {ru}, дано: {got}"),
        );
        if matches!(wanted, Arity::Exactly(n) if got > n) {
            return fault.help(
                "a comma separates arguments; the decimal mark in formulas is a point: 2.5",
                "запятая разделяет аргументы; дробная часть отделяется точкой: `2.5`",
            );
        }
        fault
    }

    fn arguments(&mut self, open: &Range<usize>) -> Result<Vec<NodeId>, Notice> {
        let mut arguments = Vec::new();
        if self.take(&Token::Close) {
            return Ok(arguments);
        }
        self.calls += 1;
        loop {
            arguments.push(self.deeper(Self::sum)?);
            if !self.take(&Token::Comma) {
                break;
            }
        }
        self.calls -= 1;
        self.close(open)?;
        Ok(arguments)
    }

    fn conditional(&mut self, span: Range<usize>) -> Result<NodeId, Notice> {
        let open = self.span();
        self.advance();
        let condition = self.either()?;
        let mut branch = || {
            if !self.take(&Token::Comma) {
                return Err(self.unexpected("`,`: if(condition, value, other value)", "`,`: if(условие, значение, другое значение)"));
            }
            self.deeper(Self::sum)
        };
        let (then, otherwise) = (branch()?, branch()?);
        self.close(&open)?;
        Ok(self.choose(&condition, (then, otherwise), span.start))
    }

    /// Conditions joined by `or`.
    fn either(&mut self) -> Result<Condition, Notice> {
        let mut condition = self.both()?;
        while self.take(&Token::Name("or".into(), 0)) {
            condition = Condition::Or(Box::new((condition, self.both()?)));
        }
        Ok(condition)
    }

    /// Conditions joined by `and`, which binds closer.
    fn both(&mut self) -> Result<Condition, Notice> {
        let mut condition = self.single()?;
        while self.take(&Token::Name("and".into(), 0)) {
            condition = Condition::And(Box::new((condition, self.single()?)));
        }
        Ok(condition)
    }

    /// A comparison, `not` before a condition, or conditions in brackets.
    fn single(&mut self) -> Result<Condition, Notice> {
        if self.take(&Token::Name("not".into(), 0)) {
            return Ok(Condition::Not(Box::new(self.deeper(Self::single)?)));
        }
        let open = self.span();
        if *self.peek() == Token::Open && self.brackets_hold_condition() {
            self.advance();
            let inner = self.deeper(Self::either)?;
            self.close(&open)?;
            return Ok(inner);
        }
        let left = self.deeper(Self::sum)?;
        let comparison = match self.peek() {
            Token::Less => Comparison::Less,
            Token::LessEqual => Comparison::LessEqual,
            Token::Greater => Comparison::Greater,
            Token::GreaterEqual => Comparison::GreaterEqual,
            _ => return Err(self.unexpected("a comparison < <= > >=", "сравнение < <= > >=")),
        };
        self.advance();
        let right = self.deeper(Self::sum)?;
        Ok(Condition::Compare(comparison, left, right))
    }

    /// Whether a comparison stands directly inside the brackets that open here.
    fn brackets_hold_condition(&self) -> bool {
        let mut depth = 0usize;
        for (token, _) in &self.tokens[self.at..] {
            match token {
                Token::Open => depth += 1,
                Token::Close if depth <= 1 => return false,
                Token::Close => depth -= 1,
                Token::Less | Token::LessEqual | Token::Greater | Token::GreaterEqual if depth == 1 => return true,
                // `((a < b) or (c < d))`: what joins conditions shows that these brackets hold some
                Token::Name(word, 0) if depth == 1 && matches!(word.as_str(), "and" | "or" | "not") => return true,
                _ => {}
            }
        }
        false
    }

    /// Nested choices between two values: if(a and b, x, y) is if(a, if(b, x, y), y).
    fn choose(&mut self, condition: &Condition, (then, otherwise): (NodeId, NodeId), from: usize) -> NodeId {
        match condition {
            Condition::Compare(comparison, left, right) => {
                self.push(Ast::If { comparison: *comparison, left: *left, right: *right, then, otherwise }, from)
            }
            Condition::And(parts) => {
                let inner = self.choose(&parts.1, (then, otherwise), from);
                self.choose(&parts.0, (inner, otherwise), from)
            }
            Condition::Or(parts) => {
                let inner = self.choose(&parts.1, (then, otherwise), from);
                self.choose(&parts.0, (then, inner), from)
            }
            Condition::Not(inner) => self.choose(inner, (otherwise, then), from),
        }
    }

    /// The arguments of kinematic functions are names: `x(A)`, `force(springs.front)`.
    fn kinematic(&mut self, function: &'static KinematicFunction, span: Range<usize>) -> Result<NodeId, Notice> {
        let open = self.span();
        self.advance();
        let mut arguments = Vec::new();
        while *self.peek() != Token::Close {
            let place = self.span();
            let Token::Name(first, 0) = self.advance() else {
                self.at = self.at.saturating_sub(1);
                return Err(self.unexpected("the name of a point, body or element", "имя точки, тела или элемента"));
            };
            if self.take(&Token::Dot) {
                let end = self.span().end;
                let Token::Name(second, 0) = self.advance() else {
                    return Err(self.unexpected("a name after the point", "имя после точки"));
                };
                arguments.push((Some(first), second, place.start..end));
            } else {
                arguments.push((None, first, place));
            }
            if !self.take(&Token::Comma) {
                break;
            }
        }
        self.close(&open)?;
        let name = function.name;
        let allowed = function.arity();
        if !allowed.contains(&arguments.len()) {
            return Err(self.arity(name, Arity::Exactly(*allowed.end()), arguments.len(), span));
        }
        Ok(self.push(Ast::Kinematic { function, arguments }, span.start))
    }
}

/// What to write for a function that the language does not have; a nearer name would mean another value.
fn instead(name: &str) -> Option<(&'static str, &'static str)> {
    Some(match name {
        "log2" => ("write log(x)/log(2)", "напишите log(x)/log(2)"),
        "cot" | "ctg" | "cotan" => ("write 1/tan(x)", "напишите 1/tan(x)"),
        "sec" => ("write 1/cos(x)", "напишите 1/cos(x)"),
        "csc" | "cosec" => ("write 1/sin(x)", "напишите 1/sin(x)"),
        "pow" => ("write x^n", "напишите x^n"),
        "sqr" => ("write x^2", "напишите x^2"),
        "floor" | "ceil" | "round" | "mod" | "frac" | "int" => (
            "write the pieces with if(t < t1, ..., ...); a square wave is if(sin(2*pi*t/T) > 0, 1, -1), a triangular one asin(sin(2*pi*t/T))*2/pi",
            "запишите участки через if(t < t1, ..., ...); прямоугольная волна — if(sin(2*pi*t/T) > 0, 1, -1), треугольная — asin(sin(2*pi*t/T))*2/pi",
        ),
        _ => return None,
    })
}

fn unknown_function(name: &str, span: Range<usize>, functions: &[&'static KinematicFunction]) -> Notice {
    let known = Function::ALL.iter().map(|(_, n)| *n).chain(["sqrt", "if"]).chain(functions.iter().map(|f| f.name));
    let fault = Notice::piece("M033", span, format!("unknown function `{name}`"), format!("неизвестная функция `{name}`"));
    if let Some((en, ru)) = instead(name) {
        let fault = match name {
            "floor" | "ceil" | "round" | "mod" | "frac" | "int" => fault.why(
                "it jumps at every whole number: no jump may be stepped over, so each must stand in the formula as a condition that is located",
                "она имеет скачок в каждом целом числе: ни один скачок нельзя перешагнуть, поэтому каждый должен быть записан условием, момент которого отыскивается",
            ),
            _ => fault,
        };
        return fault.help(en, ru);
    }
    let other = match name {
        "fabs" => Some("abs"),
        "tg" => Some("tan"),
        "arctg" | "arctan" => Some("atan"),
        "arcsin" => Some("asin"),
        "arccos" => Some("acos"),
        "arsinh" | "arcsinh" | "arsh" => Some("asinh"),
        "arcosh" | "arccosh" | "arch" => Some("acosh"),
        "artanh" | "arctanh" | "arth" => Some("atanh"),
        "sh" => Some("sinh"),
        "ch" => Some("cosh"),
        "th" => Some("tanh"),
        "sgn" | "signum" => Some("sign"),
        _ => words::nearest(name, known),
    };
    match other {
        Some(near) => fault.help(format!("did you mean `{near}`?"), format!("может быть, `{near}`?")),
        None => fault.help(format!("to multiply write `{name}*(...)`"), format!("произведение запишите так: `{name}*(...)`")),
    }
}
