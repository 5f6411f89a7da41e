//! A small reader of formulas, so that the tests can state them as text.

use symbolic::{Edge, Expr, Function, Graph, Rational};

pub fn read(graph: &mut Graph, text: &str) -> Expr {
    let mut reader = Reader { graph, rest: text };
    let e = reader.sum();
    assert_eq!(reader.rest.trim(), "", "unread rest of {text}");
    e
}

struct Reader<'a> {
    graph: &'a mut Graph,
    rest: &'a str,
}

impl Reader<'_> {
    fn eat(&mut self, mark: &str) -> bool {
        self.rest = self.rest.trim_start();
        match self.rest.strip_prefix(mark) {
            Some(rest) => {
                self.rest = rest;
                true
            }
            None => false,
        }
    }

    fn sum(&mut self) -> Expr {
        let mut value = if self.eat("-") {
            let first = self.product();
            self.graph.neg(first)
        } else {
            self.product()
        };
        loop {
            if self.eat("+") {
                let next = self.product();
                value = self.graph.add(value, next);
            } else if self.eat("-") {
                let next = self.product();
                value = self.graph.sub(value, next);
            } else {
                return value;
            }
        }
    }

    fn product(&mut self) -> Expr {
        let mut value = self.power();
        loop {
            if self.eat("*") {
                let next = self.power();
                value = self.graph.mul(value, next);
            } else if self.eat("/") {
                let next = self.power();
                value = self.graph.div(value, next);
            } else {
                return value;
            }
        }
    }

    fn power(&mut self) -> Expr {
        let base = self.atom();
        if self.eat("^") {
            let exponent = if self.eat("-") {
                let e = self.power();
                self.graph.neg(e)
            } else {
                self.power()
            };
            return self.graph.power(base, exponent);
        }
        base
    }

    fn take(&mut self, accept: impl Fn(char) -> bool) -> &str {
        self.rest = self.rest.trim_start();
        let end = self.rest.find(|c| !accept(c)).unwrap_or(self.rest.len());
        let (taken, rest) = self.rest.split_at(end);
        self.rest = rest;
        taken
    }

    fn arguments(&mut self) -> Vec<Expr> {
        let mut arguments = vec![];
        while !self.eat(")") {
            arguments.push(self.sum());
            self.eat(",");
        }
        arguments
    }

    fn atom(&mut self) -> Expr {
        if self.eat("(") {
            let inner = self.sum();
            assert!(self.eat(")"), "missing ) before {}", self.rest);
            return inner;
        }
        self.rest = self.rest.trim_start();
        if self.rest.starts_with(|c: char| c.is_ascii_digit()) {
            let digits = self.take(|c| c.is_ascii_digit() || c == '.').to_owned();
            return self.graph.number(Rational::parse_decimal(&digits).unwrap());
        }
        let name = self.take(|c| c.is_alphanumeric() || c == '_').to_owned();
        assert!(!name.is_empty(), "expected a name at {}", self.rest);
        if self.eat("(") {
            let arguments = self.arguments();
            return match (name.as_str(), &arguments[..]) {
                ("sqrt", [x]) => self.graph.sqrt(*x),
                ("switch", [guard, then, otherwise]) => self.graph.switch(*guard, Edge::Closed, *then, *otherwise),
                ("strict", [guard, then, otherwise]) => self.graph.switch(*guard, Edge::Open, *then, *otherwise),
                _ => self.graph.call(Function::from_name(&name).unwrap(), &arguments),
            };
        }
        if name == "pi" {
            return self.graph.pi();
        }
        let primes = self.take(|c| c == '\'').len() as u8;
        let id = self.graph.symbol_id(&name, primes);
        self.graph.symbol(id)
    }
}
