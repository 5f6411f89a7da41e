//! Calls in a formula: functions with their arguments, `if` with its conditions, functions that ask the machine.

use super::{Ast, Comparison, NodeId, Parser};
use crate::formula::kinematic::KinematicFunction;
use crate::formula::lex::Token;
use std::ops::Range;
use symbolic::{Function, Rational};
use words::Notice;

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

impl Parser<'_> {
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
    pub(super) fn grouped(&self, from: usize) -> Option<Notice> {
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

    pub(super) fn call(&mut self, name: &str, span: Range<usize>) -> Result<NodeId, Notice> {
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
