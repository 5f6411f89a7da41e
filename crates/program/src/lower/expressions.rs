//! Any expressions into a tape, by an iterative walk: the depth of the graph is bounded by memory, not by the stack.

use super::forms::Value;
use super::numbers::Numbers;
use crate::builder::Builder;
use crate::verify::verified;
use crate::{Bounded, By, Coefficient, Construct, Fault, GuardOrigin, Operation, Register, Root, Shape, Spare, Tape, Unary};
use rustc_hash::FxHashMap;
use std::f64::consts::PI;
use std::sync::Arc;
use symbolic::{Edge, Expr, Function, Graph, Node, Rational, SymbolId};

/// What the symbols of the expressions are. A symbol may be in one list only.
#[derive(Clone, Debug, Default)]
pub struct Inputs {
    /// Parameters, by slot.
    pub parameters: Vec<SymbolId>,
    /// Time.
    pub time: Option<SymbolId>,
    /// States, by slot.
    pub states: Vec<SymbolId>,
    /// Accelerations, by slot.
    pub accelerations: Vec<SymbolId>,
    /// Symbols that count as zero.
    pub zeros: Vec<SymbolId>,
    /// Symbols that stand for formulas.
    pub definitions: Vec<(SymbolId, Expr)>,
}

/// Lowers named expressions to a tape in which every switch goes by value.
///
/// *Errors*: P010 for a symbol without a meaning, P011 for definitions that form a cycle.
pub fn expressions(graph: &Graph, name: &str, inputs: &Inputs, roots: &[(String, Expr)]) -> Result<Tape, Fault> {
    Lowering::new(graph, inputs, Switches::Value).tape(name, roots)
}

#[derive(Clone, Copy)]
pub(super) enum Source {
    Parameter(u32),
    Time,
    State(u32),
    Acceleration(u32),
    Zero,
    Definition(Expr),
}

/// How the switches of a tape are decided.
#[derive(Clone, Copy)]
pub(super) enum Switches<'t> {
    /// By the values of their guards.
    Value,
    /// Each guard gets a number, its mode is an input.
    Collect,
    /// By mode where this table knows the guard, else by value.
    Known(&'t GuardTable),
}

/// The guards met so far.
#[derive(Default)]
pub(super) struct GuardTable {
    pub(super) guards: Vec<GuardOrigin>,
    /// Numbers of the guards of contacts and frictions, by reaction.
    pub(super) numbers: Vec<Option<Numbers>>,
    /// Guard and sign by the function divided by the absolute factor of its first term, taken positive.
    index: FxHashMap<GuardKey, (u32, bool)>,
}

/// A linear form up to a factor: the constant, then terms with factors.
#[derive(PartialEq, Eq, Hash)]
struct GuardKey(Rational, Vec<(Atom, Rational)>);

/// A term as powers of bases; a lone expression is its own first power.
type Atom = Box<[(Expr, Rational)]>;

pub(super) struct Lowering<'g, 't> {
    graph: &'g Graph,
    builder: Builder,
    sources: Vec<Option<Source>>,
    values: Vec<Option<Value>>,
    open: Vec<bool>,
    shape: Shape,
    switches: Switches<'t>,
    pub(super) table: GuardTable,
    guard_registers: Vec<Option<Register>>,
    bounds: Vec<Bounded>,
}

impl<'g, 't> Lowering<'g, 't> {
    pub(super) fn new(graph: &'g Graph, inputs: &Inputs, switches: Switches<'t>) -> Lowering<'g, 't> {
        let mut sources = vec![None; graph.symbol_count()];
        let mut set = |s: SymbolId, source: Source| sources[s.index()] = Some(source);
        inputs.definitions.iter().for_each(|(s, e)| set(*s, Source::Definition(*e)));
        (0..).zip(&inputs.parameters).for_each(|(i, s)| set(*s, Source::Parameter(i)));
        (0..).zip(&inputs.states).for_each(|(i, s)| set(*s, Source::State(i)));
        (0..).zip(&inputs.accelerations).for_each(|(i, s)| set(*s, Source::Acceleration(i)));
        inputs.time.into_iter().for_each(|s| set(s, Source::Time));
        inputs.zeros.iter().for_each(|s| set(*s, Source::Zero));
        let shape = Shape {
            parameters: inputs.parameters.len(),
            states: inputs.states.len(),
            accelerations: inputs.accelerations.len(),
            modes: match switches {
                Switches::Known(table) => table.guards.len(),
                _ => 0,
            },
        };
        Lowering {
            graph,
            builder: Builder::default(),
            sources,
            values: vec![None; graph.len()],
            open: vec![false; graph.len()],
            shape,
            switches,
            table: GuardTable::default(),
            guard_registers: vec![None; shape.modes],
            bounds: Vec::new(),
        }
    }

    /// The tape of named expressions.
    pub(super) fn tape(mut self, name: &str, roots: &[(String, Expr)]) -> Result<Tape, Fault> {
        let mut named = Vec::with_capacity(roots.len());
        for (name, e) in roots {
            named.push(Root { name: name.clone(), register: self.register(*e)? });
        }
        Ok(self.finish(name, named)?.0)
    }

    /// The register of an expression.
    pub(super) fn register(&mut self, e: Expr) -> Result<Register, Fault> {
        let value = self.value(e)?;
        Ok(self.builder.whole(value))
    }

    /// A = M⁻¹ h.
    pub(super) fn solve(&mut self, matrix: Vec<Option<Register>>, right: Vec<Register>) -> Register {
        self.builder.push(Operation::Solve { matrix: matrix.into(), right: right.into() })
    }

    /// x with A x = b.
    pub(super) fn system(&mut self, matrix: Vec<Option<Register>>, right: Vec<Register>, spare: Option<Arc<Spare>>) -> Register {
        self.builder.push(Operation::System { matrix: matrix.into(), right: right.into(), spare })
    }

    pub(super) fn literal(&mut self, value: f64) -> Value {
        Value::Constant(self.builder.number(value))
    }

    pub(super) fn sum(&mut self, items: &[(f64, Value)]) -> Value {
        self.builder.sum(0.0, items)
    }

    pub(super) fn times(&mut self, a: Value, b: Value) -> Value {
        self.builder.times(a, b)
    }

    /// The square root of a value that does not vanish.
    pub(super) fn root(&mut self, a: Value) -> Value {
        let a = self.builder.whole(a);
        let root = self.builder.unary(Unary::SquareRoot, a);
        self.builder.classify(root)
    }

    /// A register as a value.
    pub(super) fn classify(&self, r: Register) -> Value {
        self.builder.classify(r)
    }

    /// a/b.
    pub(super) fn quotient(&mut self, a: Value, b: Value) -> Value {
        let (a, b) = (self.builder.whole(a), self.builder.whole(b));
        let quotient = self.builder.divide(a, b);
        self.builder.classify(quotient)
    }

    pub(super) fn negative(&mut self, e: Expr) -> Result<Value, Fault> {
        let value = self.value(e)?;
        Ok(self.sum(&[(-1.0, value)]))
    }

    pub(super) fn branch(&mut self, by: By, sides: [Value; 3]) -> Value {
        self.builder.branch(by, sides)
    }

    pub(super) fn whole(&mut self, value: Value) -> Register {
        self.builder.whole(value)
    }

    /// An input of that slot.
    pub(super) fn acceleration(&mut self, slot: usize) -> Value {
        Value::Plain(self.builder.push(Operation::Acceleration(slot as u32)))
    }

    /// The number that the next guard gets.
    pub(super) fn next_guard(&self) -> usize {
        self.table.guards.len()
    }

    /// A guard whose function is computed later.
    pub(super) fn reserve(&mut self, guard: GuardOrigin) -> u32 {
        self.table.guards.push(guard);
        self.guard_registers.push(None);
        self.table.guards.len() as u32 - 1
    }

    /// A guard of its own at that register. Formulas that switch on the same function share it.
    pub(super) fn surface(&mut self, guard: GuardOrigin, register: Register) -> u32 {
        let (key, positive) = guard_key(self.graph, &guard);
        let number = self.reserve(guard);
        self.guard_registers[number as usize] = Some(register);
        self.table.index.entry(key).or_insert((number, positive));
        number
    }

    pub(super) fn bound(&mut self, bound: Bounded) {
        self.bounds.push(bound);
    }

    pub(super) fn define_guard(&mut self, guard: u32, value: Value) {
        let register = self.builder.whole(value);
        self.guard_registers[guard as usize] = Some(register);
    }

    /// Whether the register is known to hold zero.
    pub(super) fn is_zero(&self, r: Register) -> bool {
        self.builder.literal(r) == Some(0.0)
    }

    /// The state of that slot.
    pub(super) fn state(&mut self, slot: usize) -> Register {
        self.builder.push(Operation::State(slot as u32))
    }

    /// The tape with these roots, and the guards met.
    pub(super) fn finish(self, name: &str, roots: Vec<Root>) -> Result<(Tape, GuardTable), Fault> {
        let mut shape = self.shape;
        let guards = self.guard_registers;
        shape.modes = guards.len();
        let tape = Tape { name: name.to_owned(), shape, guards, bounds: self.bounds, roots, ..Tape::default() };
        Ok((verified(self.builder.finish(tape))?, self.table))
    }

    /// Values of everything below `e`, operands first.
    pub(super) fn value(&mut self, root: Expr) -> Result<Value, Fault> {
        let mut stack = vec![root];
        while let Some(&e) = stack.last() {
            if self.values[e.index()].is_some() {
                stack.pop();
            } else if self.open[e.index()] {
                stack.pop();
                let value = self.step(e);
                self.values[e.index()] = Some(value);
            } else {
                self.open[e.index()] = true;
                self.push_operands(e, &mut stack)?;
            }
        }
        Ok(self.known(root))
    }

    pub(super) fn graph(&self) -> &'g Graph {
        self.graph
    }

    pub(super) fn source(&self, s: SymbolId) -> Option<Source> {
        self.sources[s.index()]
    }

    /// Whether a lowered formula is one over parameters only.
    pub(super) fn is_still(&self, e: Expr) -> bool {
        matches!(self.known(e), Value::Constant(_))
    }

    /// base^p.
    pub(super) fn power(&mut self, base: Value, p: &Rational) -> Value {
        self.builder.product(1.0, &[(base, p)])
    }

    /// A smooth function of one argument.
    pub(super) fn smooth(&mut self, function: Function, argument: Value) -> Value {
        self.builder.function(function, &[argument])
    }

    /// What has been lowered.
    pub(super) fn known(&self, e: Expr) -> Value {
        self.values[e.index()].unwrap_or(Value::Plain(Register(0)))
    }

    fn push_operands(&self, e: Expr, stack: &mut Vec<Expr>) -> Result<(), Fault> {
        let graph = self.graph;
        let mut cycle = false;
        let mut push = |operand: Expr| {
            if self.values[operand.index()].is_none() {
                cycle |= self.open[operand.index()];
                stack.push(operand);
            }
        };
        match graph.node(e) {
            Node::Number(_) | Node::Pi => {}
            Node::Symbol(s) => match self.sources[s.index()] {
                Some(Source::Definition(formula)) => push(formula),
                Some(_) => {}
                None => return Err(Fault::about("P010", symbol_name(graph, *s)).at(Some(e))),
            },
            Node::Sum { terms: pairs, .. } | Node::Product { factors: pairs, .. } => pairs.iter().rev().for_each(|p| push(p.0)),
            Node::Power { base, exponent } => [*exponent, *base].into_iter().for_each(push),
            Node::Call { arguments, .. } => arguments.iter().rev().for_each(|a| push(*a)),
            Node::Switch { guard, then, otherwise, .. } => [*otherwise, *then, *guard].into_iter().for_each(push),
        }
        // an open operand is an ancestor: only definitions can lead back to one
        if cycle {
            let name = graph.as_symbol(e).map_or_else(|| format!("{e:?}"), |s| symbol_name(graph, s));
            return Err(Fault::about("P011", name).at(Some(e)));
        }
        Ok(())
    }

    /// The value of a node whose operands are known.
    fn step(&mut self, e: Expr) -> Value {
        self.builder.origin = Some(e);
        let graph = self.graph;
        match graph.node(e) {
            Node::Number(r) => Value::Constant(self.builder.number(r.to_f64())),
            Node::Pi => Value::Constant(self.builder.number(std::f64::consts::PI)),
            Node::Symbol(s) => self.symbol(*s),
            Node::Sum { constant, terms } => {
                let items: Vec<_> = terms.iter().map(|(t, f)| (f.to_f64(), self.known(*t))).collect();
                self.builder.sum(constant.to_f64(), &items)
            }
            Node::Product { coefficient, factors } => {
                let items: Vec<_> = factors.iter().map(|(b, p)| (self.known(*b), p)).collect();
                self.builder.product(coefficient.to_f64(), &items)
            }
            Node::Power { base, exponent } => self.builder.general_power(self.known(*base), self.known(*exponent)),
            Node::Call { function, arguments } => self.call(*function, arguments),
            Node::Switch { guard, edge, then, otherwise } => {
                let (then, otherwise) = (self.known(*then), self.known(*otherwise));
                let middle = if *edge == Edge::Open { otherwise } else { then };
                self.switch(Construct::If, (*guard, None), [otherwise, middle, then])
            }
        }
    }

    fn symbol(&mut self, s: SymbolId) -> Value {
        let register = match self.sources[s.index()] {
            Some(Source::Parameter(i)) => self.builder.push(Operation::Parameter(i)),
            Some(Source::Time) => self.builder.push(Operation::Time),
            Some(Source::State(i)) => self.builder.push(Operation::State(i)),
            Some(Source::Acceleration(i)) => self.builder.push(Operation::Acceleration(i)),
            Some(Source::Definition(e)) => return self.known(e),
            Some(Source::Zero) | None => self.builder.number(0.0),
        };
        self.builder.classify(register)
    }

    fn call(&mut self, function: Function, arguments: &[Expr]) -> Value {
        let values: Vec<Value> = arguments.iter().map(|a| self.known(*a)).collect();
        let mut literal = |x: f64| Value::Constant(self.builder.number(x));
        match function {
            Function::Sign => {
                let sides = [literal(-1.0), literal(0.0), literal(1.0)];
                self.switch(Construct::Sign, (arguments[0], None), sides)
            }
            Function::Abs => {
                let zero = literal(0.0);
                let minus = self.builder.sum(0.0, &[(-1.0, values[0])]);
                self.switch(Construct::Abs, (arguments[0], None), [minus, zero, values[0]])
            }
            Function::Min => self.switch(Construct::Min, (arguments[0], Some(arguments[1])), [values[0], values[0], values[1]]),
            Function::Max => self.switch(Construct::Max, (arguments[0], Some(arguments[1])), [values[1], values[0], values[0]]),
            Function::Atan2 if !self.is_right(arguments[1]) => self.angle((arguments[0], arguments[1]), &values),
            smooth => self.builder.function(smooth, &values),
        }
    }

    /// Whether a formula is a positive number.
    fn is_right(&self, e: Expr) -> bool {
        matches!(self.graph.node(e), Node::Number(r) if !r.is_negative() && !r.is_zero())
    }

    /// The angle of the point (x, y). Left of the origin, where it jumps by 2π as y changes its sign, it is taken about ±π on the side of y that holds: at the
    /// instant of the change y is rounding, and its own sign would say nothing.
    fn angle(&mut self, (y, x): (Expr, Expr), values: &[Value]) -> Value {
        let angle = self.builder.function(Function::Atan2, values);
        let behind: Vec<Value> = values.iter().map(|v| self.builder.sum(0.0, &[(-1.0, *v)])).collect();
        let behind = self.builder.function(Function::Atan2, &behind);
        let [upper, lower] = [PI, -PI].map(|half| self.builder.sum(half, &[(1.0, behind)]));
        let left = self.switch(Construct::Sign, (y, None), [lower, angle, upper]);
        self.switch(Construct::Sign, (x, None), [left, angle, angle])
    }

    /// sides[sign(left - right)].
    fn switch(&mut self, kind: Construct, (left, right): (Expr, Option<Expr>), sides: [Value; 3]) -> Value {
        let mut items = vec![(1.0, self.known(left))];
        items.extend(right.map(|r| (-1.0, self.known(r))));
        let difference = self.sign_of(left, right).unwrap_or_else(|| self.builder.sum(0.0, &items));
        let guard = self.builder.whole(difference);
        if self.builder.is_constant(guard) {
            return self.builder.branch(By::Value(guard), sides);
        }
        let Some((index, same)) = self.guard_index(GuardOrigin { kind, left, right }, guard) else {
            return self.builder.branch(By::Value(guard), sides);
        };
        let sides = if same { sides } else { [sides[2], sides[1], sides[0]] };
        self.builder.branch(By::Mode(index), sides)
    }

    /// The number of a guard and whether the function has the sign of the numbered one.
    fn guard_index(&mut self, guard: GuardOrigin, register: Register) -> Option<(u32, bool)> {
        if matches!(self.switches, Switches::Value) {
            return None;
        }
        let (key, positive) = guard_key(self.graph, &guard);
        match self.switches {
            Switches::Known(table) => {
                let (index, sign) = *table.index.get(&key)?;
                if self.guard_registers[index as usize].is_none() {
                    let factor = if sign == positive { 1.0 } else { -1.0 };
                    self.guard_registers[index as usize] =
                        Some(self.builder.linear(Coefficient::number(0.0), vec![(Coefficient::number(factor), register)]));
                }
                Some((index, sign == positive))
            }
            _ => {
                let table = &mut self.table;
                let next = table.guards.len() as u32;
                let (index, sign) = *table.index.entry(key).or_insert((next, positive));
                if index == next {
                    table.guards.push(guard);
                    self.guard_registers.push(Some(register));
                }
                Some((index, sign == positive))
            }
        }
    }
}

fn symbol_name(graph: &Graph, s: SymbolId) -> String {
    let symbol = graph.symbol_info(s);
    format!("{}{}", symbol.name, "'".repeat(usize::from(symbol.primes)))
}

/// The powers of a term and its number times `factor`.
fn atom(graph: &Graph, e: Expr, factor: &Rational) -> (Atom, Rational) {
    match graph.node(e) {
        Node::Product { coefficient, factors } => (factors.clone(), coefficient * factor),
        _ => (Box::from([(e, Rational::ONE)]), factor.clone()),
    }
}

/// left - right divided by the absolute factor of its first term and made positive there; the flag tells whether it was positive.
fn guard_key(graph: &Graph, guard: &GuardOrigin) -> (GuardKey, bool) {
    let mut constant = Rational::ZERO;
    let mut terms: Vec<(Atom, Rational)> = Vec::new();
    for (e, sign) in [(Some(guard.left), Rational::ONE), (guard.right, Rational::MINUS_ONE)] {
        let Some(e) = e else { continue };
        match graph.node(e) {
            Node::Number(r) => constant = &constant + &(r * &sign),
            Node::Sum { constant: c, terms: inner } => {
                constant = &constant + &(c * &sign);
                terms.extend(inner.iter().map(|(t, f)| atom(graph, *t, &(f * &sign))));
            }
            _ => terms.push(atom(graph, e, &sign)),
        }
    }
    terms.sort();
    terms.dedup_by(|later, earlier| {
        let same = later.0 == earlier.0;
        if same {
            earlier.1 = &earlier.1 + &later.1;
        }
        same
    });
    terms.retain(|t| !t.1.is_zero());
    let Some(first) = terms.first().map(|t| t.1.clone()) else {
        return (GuardKey(constant, terms), true);
    };
    let scaled = terms.into_iter().map(|(a, f)| (a, &f / &first)).collect();
    (GuardKey(&constant / &first, scaled), !first.is_negative())
}
