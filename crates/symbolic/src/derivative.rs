//! Derivatives.
//!
//! One rule serves partial and total derivatives: a derivation D is known on symbols, and on everything else by linearity, the product
//! rule and the chain rule. ∂/∂q is the derivation with D q = 1 and D of all other symbols 0; d/dt has D t = 1, D q = q', D q' = q''.

use crate::{Edge, Expr, Function, Graph, Node, Rational, SymbolId};
use rustc_hash::FxHashMap;

/// A derivation; remembers its results, so apply one derivation to many expressions.
#[derive(Debug, Default)]
pub struct Derivation {
    seeds: FxHashMap<SymbolId, Expr>,
    memo: FxHashMap<Expr, Expr>,
}

impl Derivation {
    /// The derivation with these values on symbols and 0 on all others.
    pub fn new(seeds: impl IntoIterator<Item = (SymbolId, Expr)>) -> Derivation {
        Derivation { seeds: seeds.into_iter().collect(), memo: FxHashMap::default() }
    }

    /// ∂/∂symbol.
    pub fn partial(graph: &mut Graph, symbol: SymbolId) -> Derivation {
        Derivation::new([(symbol, graph.one())])
    }

    /// ∂/∂symbol where definitions are functions of it, each of earlier ones: D d is the derivative of its formula.
    pub fn through(graph: &mut Graph, definitions: &[(SymbolId, Expr)], symbol: SymbolId) -> Derivation {
        let mut known = vec![(symbol, graph.one())];
        for (definition, formula) in definitions {
            let inner = Derivation::new(known.iter().copied()).apply(graph, *formula);
            if !graph.is_zero(inner) {
                known.push((*definition, inner));
            }
        }
        Derivation::new(known)
    }

    /// D e. Switches are differentiated branch by branch, sign x has derivative 0: the result holds off the switching surface.
    pub fn apply(&mut self, graph: &mut Graph, e: Expr) -> Expr {
        if let Some(&known) = self.memo.get(&e) {
            return known;
        }
        for e in graph.pending(&[e], &self.memo) {
            let derivative = self.step(graph, e);
            self.memo.insert(e, derivative);
        }
        self.memo[&e]
    }

    /// D e when D of all operands is known.
    fn step(&self, graph: &mut Graph, e: Expr) -> Expr {
        // of a long sum nearly all terms stand still
        if let Node::Sum { terms, .. } = graph.node(e) {
            let moving = terms.iter().map(|(t, f)| (self.memo[t], f)).filter(|(d, _)| !graph.is_zero(*d));
            let terms: Vec<_> = moving.map(|(d, f)| (d, f.clone())).collect();
            return graph.linear(Rational::ZERO, &terms);
        }
        match graph.node(e).clone() {
            Node::Number(_) | Node::Pi => graph.zero(),
            Node::Symbol(s) => self.seeds.get(&s).copied().unwrap_or_else(|| graph.zero()),
            Node::Sum { .. } => graph.zero(),
            Node::Product { coefficient, factors } => self.product(graph, &coefficient, &factors),
            Node::Power { base, exponent } => self.power(graph, e, base, exponent),
            Node::Call { function, arguments } => self.call(graph, e, function, &arguments),
            Node::Switch { guard, edge, then, otherwise } => graph.switch(guard, edge, self.memo[&then], self.memo[&otherwise]),
        }
    }

    /// D Π b^n = Σ n b^(n-1) D b Π others
    fn product(&self, graph: &mut Graph, coefficient: &Rational, factors: &[(Expr, Rational)]) -> Expr {
        let mut terms = Vec::new();
        for (i, (base, exponent)) in factors.iter().enumerate() {
            let inner = self.memo[base];
            if graph.is_zero(inner) {
                continue;
            }
            let mut items = factors.to_vec();
            items[i].1 = exponent - &Rational::ONE;
            items.push((inner, Rational::ONE));
            terms.push(graph.monomial(coefficient * exponent, &items));
        }
        graph.sum(&terms)
    }

    /// D b^x = b^x log b D x + x b^(x-1) D b; without a denominator, so that it has a value at b = 0
    fn power(&self, graph: &mut Graph, e: Expr, base: Expr, exponent: Expr) -> Expr {
        let (db, dx) = (self.memo[&base], self.memo[&exponent]);
        let log = graph.call(Function::Log, &[base]);
        let growth = graph.mul(dx, log);
        let first = graph.mul(e, growth);
        let one = graph.one();
        let less = graph.sub(exponent, one);
        let lower = graph.power(base, less);
        let slope = graph.mul(exponent, lower);
        let second = graph.mul(slope, db);
        graph.add(first, second)
    }

    fn call(&self, graph: &mut Graph, e: Expr, function: Function, arguments: &[Expr]) -> Expr {
        let inner: Vec<Expr> = arguments.iter().map(|a| self.memo[a]).collect();
        if inner.iter().all(|d| graph.is_zero(*d)) {
            return graph.zero();
        }
        let x = arguments[0];
        if let [x, y] = *arguments {
            return binary(graph, function, (x, y), (inner[0], inner[1]));
        }
        let outer = unary(graph, e, function, x);
        graph.mul(outer, inner[0])
    }
}

/// df/dx, where e = f(x).
fn unary(graph: &mut Graph, e: Expr, function: Function, x: Expr) -> Expr {
    let one = graph.one();
    match function {
        Function::Sin => graph.call(Function::Cos, &[x]),
        Function::Cos => {
            let sine = graph.call(Function::Sin, &[x]);
            graph.neg(sine)
        }
        // tan' = 1 + tan²
        Function::Tan => {
            let square = graph.square(e);
            graph.add(one, square)
        }
        // tanh' = 1 - tanh²
        Function::Tanh => {
            let square = graph.square(e);
            graph.sub(one, square)
        }
        Function::Asin | Function::Acos => {
            let square = graph.square(x);
            let rest = graph.sub(one, square);
            let root = graph.pow(rest, &-&Rational::HALF);
            if function == Function::Asin { root } else { graph.neg(root) }
        }
        Function::Atan => {
            let square = graph.square(x);
            let rest = graph.add(one, square);
            graph.div(one, rest)
        }
        Function::Asinh | Function::Acosh => {
            let square = graph.square(x);
            let inner = if function == Function::Asinh { graph.add(square, one) } else { graph.sub(square, one) };
            graph.pow(inner, &-&Rational::HALF)
        }
        Function::Atanh => {
            let square = graph.square(x);
            let rest = graph.sub(one, square);
            graph.div(one, rest)
        }
        Function::Sinh => graph.call(Function::Cosh, &[x]),
        Function::Cosh => graph.call(Function::Sinh, &[x]),
        Function::Exp => e,
        Function::Log => graph.div(one, x),
        Function::Abs => graph.call(Function::Sign, &[x]),
        Function::Sign | Function::Atan2 | Function::Min | Function::Max => graph.zero(),
    }
}

/// D f(x, y).
fn binary(graph: &mut Graph, function: Function, (x, y): (Expr, Expr), (dx, dy): (Expr, Expr)) -> Expr {
    match function {
        // atan2(x, y)' = (y x' - x y') / (x² + y²)
        Function::Atan2 => {
            let (a, b) = (graph.mul(y, dx), graph.mul(x, dy));
            let top = graph.sub(a, b);
            let (xx, yy) = (graph.square(x), graph.square(y));
            let bottom = graph.add(xx, yy);
            graph.div(top, bottom)
        }
        Function::Min => {
            let guard = graph.sub(y, x);
            graph.switch(guard, Edge::Closed, dx, dy)
        }
        _ => {
            let guard = graph.sub(x, y);
            graph.switch(guard, Edge::Closed, dx, dy)
        }
    }
}

impl Graph {
    /// ∂e/∂symbol.
    ///
    /// ```
    /// let mut g = symbolic::Graph::new();
    /// let x = g.var("x");
    /// let square = g.square(x);
    /// let id = g.symbol_id("x", 0);
    /// let expected = { let two = g.int(2); g.mul(two, x) };
    /// assert_eq!(g.derivative(square, id), expected);
    /// ```
    pub fn derivative(&mut self, e: Expr, symbol: SymbolId) -> Expr {
        Derivation::partial(self, symbol).apply(self, e)
    }
}
