//! Random expressions: no panic, balanced brackets and tags, same input same bytes.

use super::book::shaft;
use crate::formula::{Form, Printer};
use symbolic::{Edge, Expr, Function, Graph, Rational};
use words::Language;

/// xorshift64*: the seed is fixed, so a failure repeats.
pub struct Dice(pub u64);

impl Dice {
    fn roll(&mut self, sides: usize) -> usize {
        self.0 ^= self.0 >> 12;
        self.0 ^= self.0 << 25;
        self.0 ^= self.0 >> 27;
        (self.0.wrapping_mul(0x2545_f491_4f6c_dd1d) >> 33) as usize % sides
    }
    fn number(&mut self) -> Rational {
        let whole = |v: usize| i64::try_from(v).unwrap();
        Rational::new(whole(self.roll(2000)) - 1000, whole(self.roll(30)) + 1).unwrap()
    }
}

pub const NAMES: [&str; 14] = ["m", "l", "g", "omega", "t", "psi", "x", "phi", "M_r", "c_x", "phi1", "vx(A)", "масса", "a<b&\"c_%"];

pub fn grow(graph: &mut Graph, dice: &mut Dice, pool: &[Expr]) -> Expr {
    let a = pool[dice.roll(pool.len())];
    let b = pool[dice.roll(pool.len())];
    match dice.roll(11) {
        0 => {
            let r = dice.number();
            graph.number(r)
        }
        1 => {
            let id = graph.symbol_id(NAMES[dice.roll(NAMES.len())], dice.roll(5) as u8);
            graph.symbol(id)
        }
        2 => graph.add(a, b),
        3 => graph.sub(a, b),
        4 | 5 => graph.mul(a, b),
        6 if !graph.is_zero(b) => graph.div(a, b),
        7 => {
            let (function, _) = Function::ALL[dice.roll(Function::ALL.len())];
            graph.call(function, &[a, b][..function.arity()])
        }
        8 if !graph.is_zero(a) => {
            let exponent = Rational::new(dice.roll(9) as i64 - 4, dice.roll(4) as i64 + 1).unwrap();
            graph.pow(a, &exponent)
        }
        9 => graph.switch(a, if dice.roll(2) == 0 { Edge::Open } else { Edge::Closed }, b, a),
        10 if !graph.is_zero(a) && graph.as_number(b).is_none() => graph.power(a, b),
        _ => graph.pi(),
    }
}

fn brackets_balance(text: &str) {
    let mut open = vec![];
    for c in text.chars() {
        match c {
            '(' | '{' => open.push(c),
            ')' => assert_eq!(open.pop(), Some('('), "{text}"),
            '}' => assert_eq!(open.pop(), Some('{'), "{text}"),
            _ => {}
        }
    }
    assert!(open.is_empty(), "{text}");
}

/// Tags close in order, attributes are quoted, and no bare ampersand is left.
pub fn well_formed(markup: &str) {
    let mut open: Vec<&str> = vec![];
    let mut rest = markup;
    while let Some(start) = rest.find('<') {
        assert!(!rest[..start].contains('>'), "{markup}");
        let end = start + rest[start..].find('>').unwrap();
        let tag = &rest[start + 1..end];
        assert_eq!(tag.matches('"').count() % 2, 0, "{tag}");
        if let Some(name) = tag.strip_prefix('/') {
            assert_eq!(open.pop(), Some(name), "{markup}");
        } else if !tag.ends_with('/') {
            open.push(tag.split(' ').next().unwrap());
        }
        rest = &rest[end + 1..];
    }
    assert!(open.is_empty() && rest.is_empty(), "{markup}");
    for entity in markup.split('&').skip(1) {
        assert!(["lt;", "gt;", "amp;", "quot;"].iter().any(|e| entity.starts_with(e)), "{markup}");
    }
}

/// Elements with a fixed number of children have exactly that many; a wrong number makes browsers show an error.
pub fn arity_holds(markup: &str) {
    let mut counts: Vec<(String, usize)> = vec![(String::new(), 0)];
    let mut rest = markup;
    while let Some(start) = rest.find('<') {
        let end = start + rest[start..].find('>').unwrap();
        let tag = &rest[start + 1..end];
        rest = &rest[end + 1..];
        if tag.starts_with('/') {
            let (name, n) = counts.pop().unwrap();
            let expected = match name.as_str() {
                "mfrac" | "msub" | "msup" | "mover" | "mroot" => 2,
                "msubsup" => 3,
                _ => n,
            };
            assert_eq!(n, expected, "{name} in {markup}");
        } else {
            counts.last_mut().unwrap().1 += 1;
            if !tag.ends_with('/') {
                counts.push((tag.split(' ').next().unwrap().to_owned(), 0));
            }
        }
    }
}

#[test]
fn random_expressions_print() {
    let mut dice = Dice(0x5eed);
    for round in 0..60 {
        let (mut graph, printer) = shaft();
        let mut pool = vec![graph.one()];
        for name in NAMES {
            pool.push(graph.var(name));
        }
        for _ in 0..40 {
            let e = grow(&mut graph, &mut dice, &pool);
            pool.push(e);
            check(&graph, &printer, e);
            if round % 3 == 0 {
                check(&graph, &printer.clone().with_language(Language::Ru).with_width(30), e);
            }
        }
    }
}

fn check(graph: &Graph, printer: &Printer, e: Expr) {
    let text = printer.expression(graph, e, Form::Text);
    brackets_balance(&text);
    let latex = printer.expression(graph, e, Form::Latex);
    brackets_balance(&latex.replace("\\{", "").replace("\\}", ""));
    assert_eq!(latex.matches("\\left").count(), latex.matches("\\right").count(), "{latex}");
    let mathml = printer.expression(graph, e, Form::MathMl);
    well_formed(&mathml);
    arity_holds(&mathml);
    assert_eq!(text, printer.expression(graph, e, Form::Text));
}

#[test]
fn shared_parts_do_not_explode() {
    let (mut graph, printer) = shaft();
    let mut e = graph.var("x");
    for i in 0..200 {
        let y = graph.var(&format!("a{i}"));
        let sine = graph.call(Function::Sin, &[e]);
        let cosine = graph.call(Function::Cos, &[e]);
        let product = graph.mul(sine, y);
        e = graph.add(product, cosine);
    }
    let text = printer.expression(&graph, e, Form::Text);
    assert!(text.contains('…') && text.len() < 2_000_000, "{}", text.len());
}

#[test]
fn deep_expressions_end_with_an_ellipsis() {
    let (mut graph, printer) = shaft();
    let mut e = graph.var("x");
    for _ in 0..100_000 {
        e = graph.call(Function::Exp, &[e]);
    }
    for form in [Form::Text, Form::Latex, Form::MathMl] {
        assert!(printer.expression(&graph, e, form).contains(if form == Form::Latex { "\\ldots" } else { "…" }));
    }
}
