//! A checked formula to an expression.

use super::parse::{Ast, Comparison, Formula, NodeId};
use super::scope::{EntryKind, Scope};
use crate::requests::{Request, RequestKind};
use crate::units::{Dimension, si_label};
use std::collections::HashSet;
use std::ops::Range;
use symbolic::{Edge, Expr, Graph, Node, Rational, SymbolId};
use words::Notice;

/// Exact numbers of formulas may not need more bits than machine numbers span.
const MAX_BITS: u64 = 2200;
/// Operands in all sums and products of a model: outputs of outputs could otherwise grow without bound.
const MAX_WORK: usize = 5_000_000;

/// The graph and what is still to be found by `derive`.
pub(crate) struct Builder {
    pub graph: Graph,
    pub time: SymbolId,
    pub requests: Vec<Request>,
    /// Symbols of parameters that occur in some formula.
    pub used: HashSet<SymbolId>,
    requested: HashSet<SymbolId>,
    work: usize,
}

impl Builder {
    pub(crate) fn new() -> Builder {
        let mut graph = Graph::new();
        let time = graph.symbol_id("t", 0);
        Builder { graph, time, requests: Vec::new(), used: HashSet::new(), requested: HashSet::new(), work: 0 }
    }

    fn request(&mut self, name: &str, primes: u8, kind: RequestKind, dimension: &Dimension) -> Expr {
        let symbol = self.graph.symbol_id(name, primes);
        if self.requested.insert(symbol) {
            self.requests.push(Request { symbol, kind, unit: si_label(dimension) });
        }
        self.graph.symbol(symbol)
    }
}

/// Builds the expression of a formula that passed its check.
pub(crate) fn lower(formula: &Formula, scope: &Scope, builder: &mut Builder) -> Result<Expr, Notice> {
    let mut values: Vec<Expr> = Vec::with_capacity(formula.nodes.len());
    for (node, span) in &formula.nodes {
        let value = build(node, span, &values, scope, builder)?;
        guard(value, span, builder)?;
        values.push(value);
    }
    Ok(values[formula.root()])
}

fn build(node: &Ast, span: &Range<usize>, values: &[Expr], scope: &Scope, builder: &mut Builder) -> Result<Expr, Notice> {
    let graph = &mut builder.graph;
    Ok(match node {
        Ast::Number(n) => graph.number(n.clone()),
        Ast::Quantity(q) => q.si(graph),
        Ast::Name { name, primes } => return name_value(name, *primes, scope, builder),
        Ast::Sum(terms) => {
            let items = signed(terms, values);
            builder.work += items.len();
            tree(&items, span, builder, &|graph, items| graph.linear(Rational::ZERO, items))?
        }
        Ast::Product(factors) => {
            let items = signed(factors, values);
            builder.work += items.len();
            tree(&items, span, builder, &|graph, items| graph.monomial(Rational::ONE, items))?
        }
        Ast::Power(base, exponent) => graph.power(values[*base], values[*exponent]),
        Ast::Sqrt(x) => graph.sqrt(values[*x]),
        Ast::Call(function, arguments) => {
            let arguments: Vec<Expr> = arguments.iter().map(|id| values[*id]).collect();
            if arguments.len() > function.arity() {
                // min and max of many
                let mut value = arguments[0];
                for x in &arguments[1..] {
                    value = graph.call(*function, &[value, *x]);
                }
                value
            } else {
                graph.call(*function, &arguments)
            }
        }
        Ast::Kinematic { function, arguments } => {
            let (kind, dimension) = scope.request(function, arguments, span)?;
            let argument = arguments.first().map_or("", |(_, name, _)| name);
            let name = format!("{}({})", function.name, scope.shown(argument, kind));
            builder.request(&name, 0, kind, &dimension.or_none())
        }
        Ast::If { comparison, left, right, then, otherwise } => {
            let (guard, edge) = switching(*comparison, values, *left, *right, graph);
            graph.switch(guard, edge, values[*then], values[*otherwise])
        }
    })
}

/// Operands with -1 where they are subtracted or divided by, else with 1.
fn signed(operands: &[(bool, NodeId)], values: &[Expr]) -> Vec<(Expr, Rational)> {
    operands.iter().map(|(inverse, id)| (values[*id], if *inverse { Rational::MINUS_ONE } else { Rational::ONE })).collect()
}

/// The guard of a condition and its edge: a <= b holds where b - a >= 0, a < b where b - a > 0.
fn switching(comparison: Comparison, values: &[Expr], left: NodeId, right: NodeId, graph: &mut Graph) -> (Expr, Edge) {
    let (a, b) = (values[left], values[right]);
    match comparison {
        Comparison::Less => (graph.sub(b, a), Edge::Open),
        Comparison::LessEqual => (graph.sub(b, a), Edge::Closed),
        Comparison::Greater => (graph.sub(a, b), Edge::Open),
        Comparison::GreaterEqual => (graph.sub(a, b), Edge::Closed),
    }
}

/// Makes one expression of many operands.
type Join = dyn Fn(&mut Graph, &[(Expr, Rational)]) -> Expr;

/// Joins many operands in halves, looking at each part: the numbers in it must not grow without bound.
fn tree(items: &[(Expr, Rational)], span: &Range<usize>, builder: &mut Builder, join: &Join) -> Result<Expr, Notice> {
    if items.len() <= 64 {
        let value = join(&mut builder.graph, items);
        guard(value, span, builder)?;
        return Ok(value);
    }
    let (first, second) = items.split_at(items.len() / 2);
    let halves = [(tree(first, span, builder, join)?, Rational::ONE), (tree(second, span, builder, join)?, Rational::ONE)];
    Ok(join(&mut builder.graph, &halves))
}

fn name_value(name: &str, primes: u8, scope: &Scope, builder: &mut Builder) -> Result<Expr, Notice> {
    let fallback = |builder: &mut Builder| builder.graph.zero();
    if name == "pi" || name == "π" {
        return Ok(builder.graph.pi());
    }
    if name == "t" {
        return Ok(builder.graph.symbol(builder.time));
    }
    let Some(entry) = scope.get(name) else { return Ok(fallback(builder)) };
    let of = match entry.kind {
        EntryKind::Coordinate(symbols) => {
            let symbol = symbols[usize::from(primes.min(2))];
            builder.used.insert(symbol);
            return Ok(builder.graph.symbol(symbol));
        }
        EntryKind::Parameter(symbol) => {
            builder.used.insert(symbol);
            builder.graph.symbol(symbol)
        }
        EntryKind::Output(Some(formula)) => formula,
        EntryKind::Output(None) => fallback(builder),
    };
    if primes == 0 {
        return Ok(of);
    }
    if entry.depends.is_constant() {
        return Ok(fallback(builder));
    }
    let dimension = entry.dimension.or_none().per_time(primes);
    Ok(builder.request(name, primes, RequestKind::TimeDerivative { of, order: primes }, &dimension))
}

/// Whether a function of numbers alone is infinite or undefined.
fn has_no_value(value: Expr, graph: &Graph) -> bool {
    let number = |e: Expr| match graph.node(e) {
        Node::Number(r) => Some(r.to_f64()),
        _ => None,
    };
    let operands: Vec<Expr> = match graph.node(value) {
        Node::Call { arguments, .. } => arguments.to_vec(),
        Node::Power { base, exponent } => vec![*base, *exponent],
        _ => return false,
    };
    let known = |e: Expr| number(e).unwrap_or(f64::NAN);
    operands.iter().all(|e| number(*e).is_some()) && !graph.evaluate_node(value, &|_| f64::NAN, &known).is_finite()
}

/// Refuses numbers that outgrow all machine numbers, powers of zero, and formulas that outgrow memory.
fn guard(value: Expr, span: &Range<usize>, builder: &mut Builder) -> Result<(), Notice> {
    let fits = |r: &Rational| r.bits() <= MAX_BITS;
    let fine = match builder.graph.node(value) {
        Node::Number(r) => fits(r) && r.to_f64().is_finite(),
        Node::Sum { constant, terms } => {
            builder.work += terms.len();
            fits(constant) && terms.iter().all(|t| fits(&t.1))
        }
        Node::Product { coefficient, factors } => {
            builder.work += factors.len();
            if factors.iter().any(|(base, e)| e.is_negative() && builder.graph.is_zero(*base)) {
                return Err(Notice::piece("M042", span.clone(), "division by zero", "деление на нуль")
                    .why("the divisor cancels to zero", "делитель тождественно равен нулю"));
            }
            fits(coefficient) && factors.iter().all(|f| fits(&f.1))
        }
        // a factor of zero in front would hide it
        Node::Call { .. } | Node::Power { .. } if has_no_value(value, &builder.graph) => {
            return Err(Notice::piece("M042", span.clone(), "this has no finite value", "у этого выражения нет конечного значения")
                .why("the root or logarithm of what has none", "корень или логарифм числа, у которого его нет"));
        }
        _ => true,
    };
    if !fine {
        return Err(crate::units::out_of_range(span.clone()));
    }
    if builder.work > MAX_WORK {
        return Err(Notice::piece(
            "M069",
            span.clone(),
            format!("the formulas of the model expand to more than {MAX_WORK} terms"),
            format!("формулы модели раскрываются более чем в {MAX_WORK} слагаемых"),
        )
        .help("use parameters for shared parts: they are not expanded", "общие части задайте параметрами: они не раскрываются"));
    }
    Ok(())
}
