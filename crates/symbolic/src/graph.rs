//! The hash-consed expression graph.
//!
//! An [`Expr`] is a handle to a node of one [`Graph`]. Equal expressions are the same node, so equality is an integer comparison and
//! shared parts are stored and evaluated once. Nodes are immutable and only refer to older nodes: index order is a topological order.

use crate::Rational;
use rustc_hash::{FxBuildHasher, FxHashMap};
use std::borrow::Cow;
use std::fmt;
use std::hash::BuildHasher;

/// Handle of an expression; meaningful with the graph that made it.
#[derive(Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Expr(pub(crate) u32);

impl Expr {
    /// Position in the graph, usable as an index into tables of length [`Graph::len`].
    pub fn index(self) -> usize {
        self.0 as usize
    }
}
impl fmt::Debug for Expr {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "%{}", self.0)
    }
}

/// Handle of a symbol.
#[derive(Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Debug)]
pub struct SymbolId(pub(crate) u32);

impl SymbolId {
    /// Position in creation order.
    pub fn index(self) -> usize {
        self.0 as usize
    }
}

/// A symbol: a name and the number of time derivatives taken of it (`phi''` is `phi` with two).
#[derive(Clone, PartialEq, Eq, Hash, Debug)]
pub struct Symbol {
    /// Name as in the model file, without primes.
    pub name: String,
    /// Number of primes.
    pub primes: u8,
}

/// Functions of the language. `Atan2(y, x)`, `Min` and `Max` take two arguments, the others one.
#[derive(Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Debug)]
#[allow(missing_docs)]
pub enum Function {
    Sin,
    Cos,
    Tan,
    Asin,
    Acos,
    Atan,
    Atan2,
    Sinh,
    Cosh,
    Tanh,
    Asinh,
    Acosh,
    Atanh,
    Exp,
    Log,
    Abs,
    Sign,
    Min,
    Max,
}

impl Function {
    /// Every function with its name in model files.
    pub const ALL: [(Function, &'static str); 19] = [
        (Function::Sin, "sin"),
        (Function::Cos, "cos"),
        (Function::Tan, "tan"),
        (Function::Asin, "asin"),
        (Function::Acos, "acos"),
        (Function::Atan, "atan"),
        (Function::Atan2, "atan2"),
        (Function::Sinh, "sinh"),
        (Function::Cosh, "cosh"),
        (Function::Tanh, "tanh"),
        (Function::Asinh, "asinh"),
        (Function::Acosh, "acosh"),
        (Function::Atanh, "atanh"),
        (Function::Exp, "exp"),
        (Function::Log, "log"),
        (Function::Abs, "abs"),
        (Function::Sign, "sign"),
        (Function::Min, "min"),
        (Function::Max, "max"),
    ];
    /// The name in model files.
    pub fn name(self) -> &'static str {
        Self::ALL.iter().find(|(f, _)| *f == self).map_or("?", |(_, n)| n)
    }
    /// The function of that name.
    pub fn from_name(name: &str) -> Option<Function> {
        Self::ALL.iter().find(|(_, n)| *n == name).map(|(f, _)| *f)
    }
    /// Number of arguments.
    pub fn arity(self) -> usize {
        match self {
            Function::Atan2 | Function::Min | Function::Max => 2,
            _ => 1,
        }
    }
}

/// What an expression is. Canonical: see the constructors in `build.rs`.
#[derive(Clone, PartialEq, Eq, Hash, Debug)]
pub enum Node {
    /// An exact number.
    Number(Rational),
    /// The number π.
    Pi,
    /// A symbol.
    Symbol(SymbolId),
    /// constant + Σ factor·term. At least two summands (counting a non-zero constant). Terms are sorted by [`Expr`], distinct, not
    /// numbers, not sums, not products with a coefficient other than 1; factors are not zero.
    Sum {
        /// The number.
        constant: Rational,
        /// (term, factor).
        terms: Box<[(Expr, Rational)]>,
    },
    /// coefficient·Π base^exponent. Bases are sorted, distinct, not products, not numbers (but see below); exponents are not zero;
    /// the coefficient is not zero; never a single base with exponent 1 and coefficient 1. A positive number may be a base with a
    /// fractional exponent between 0 and 1 (√2). Division is exponent -1, the square root is exponent 1/2.
    Product {
        /// The number in front.
        coefficient: Rational,
        /// (base, exponent).
        factors: Box<[(Expr, Rational)]>,
    },
    /// base^exponent with an exponent that is not a number.
    Power {
        /// Base.
        base: Expr,
        /// Exponent.
        exponent: Expr,
    },
    /// A function call.
    Call {
        /// Which.
        function: Function,
        /// Arguments, as many as [`Function::arity`].
        arguments: Box<[Expr]>,
    },
    /// `then` where guard >= 0 (guard > 0 with an open edge), else `otherwise`.
    Switch {
        /// The switching function.
        guard: Expr,
        /// Which side guard = 0 belongs to.
        edge: Edge,
        /// Value on the positive side.
        then: Expr,
        /// Value on the other side.
        otherwise: Expr,
    },
}

/// Which side of a switch its edge, guard = 0, belongs to.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Edge {
    /// To the side above: guard >= 0.
    Closed,
    /// To the side below: guard > 0.
    Open,
}

/// The owner of expressions.
#[derive(Clone, Debug, Default)]
pub struct Graph {
    nodes: Vec<Node>,
    /// The youngest node of each hash. Nodes themselves are kept once: those of a large machine are most of its memory.
    index: FxHashMap<u64, Expr>,
    /// For each node the next older one with its hash.
    older: Vec<Option<Expr>>,
    symbols: Vec<Symbol>,
    symbol_index: FxHashMap<Symbol, SymbolId>,
}

impl Node {
    /// Whether it has another law on both sides of a value: a switch, |x|, sgn x, min, max.
    pub fn switches(&self) -> bool {
        match self {
            Node::Switch { .. } => true,
            Node::Call { function, .. } => matches!(function, Function::Abs | Function::Sign | Function::Min | Function::Max),
            _ => false,
        }
    }
}

impl Graph {
    /// An empty graph.
    pub fn new() -> Graph {
        Graph::default()
    }
    /// Number of nodes.
    pub fn len(&self) -> usize {
        self.nodes.len()
    }
    /// Whether nothing has been built.
    pub fn is_empty(&self) -> bool {
        self.nodes.is_empty()
    }
    /// What `e` is.
    pub fn node(&self, e: Expr) -> &Node {
        &self.nodes[e.index()]
    }
    /// The name of a symbol.
    pub fn symbol_info(&self, s: SymbolId) -> &Symbol {
        &self.symbols[s.index()]
    }
    /// Number of symbols.
    pub fn symbol_count(&self) -> usize {
        self.symbols.len()
    }

    /// Interns a node that is already canonical.
    pub(crate) fn intern(&mut self, node: Node) -> Expr {
        let hash = FxBuildHasher.hash_one(&node);
        if let Some(e) = self.hashed(hash, &node) {
            return e;
        }
        let e = Expr(u32::try_from(self.nodes.len()).expect("fewer than 2^32 expressions fit in memory"));
        self.nodes.push(node);
        self.older.push(self.index.insert(hash, e));
        e
    }

    /// The expression that a node is, if it has been built.
    fn hashed(&self, hash: u64, node: &Node) -> Option<Expr> {
        let mut at = self.index.get(&hash).copied();
        while let Some(e) = at {
            if self.node(e) == node {
                return Some(e);
            }
            at = self.older[e.index()];
        }
        None
    }

    /// Zero, and the graph that has it: this one, unless zero was never built.
    pub fn with_zero(&self) -> (Cow<'_, Graph>, Expr) {
        let zero = Node::Number(Rational::ZERO);
        match self.hashed(FxBuildHasher.hash_one(&zero), &zero) {
            Some(zero) => (Cow::Borrowed(self), zero),
            None => {
                let mut own = self.clone();
                let zero = own.zero();
                (Cow::Owned(own), zero)
            }
        }
    }

    /// The symbol `name` with so many primes.
    pub fn symbol_id(&mut self, name: &str, primes: u8) -> SymbolId {
        let symbol = Symbol { name: name.to_owned(), primes };
        if let Some(&id) = self.symbol_index.get(&symbol) {
            return id;
        }
        let id = SymbolId(u32::try_from(self.symbols.len()).expect("fewer than 2^32 symbols fit in memory"));
        self.symbols.push(symbol.clone());
        self.symbol_index.insert(symbol, id);
        id
    }
    /// The symbol as an expression.
    pub fn symbol(&mut self, id: SymbolId) -> Expr {
        self.intern(Node::Symbol(id))
    }
    /// A symbol by name, as an expression.
    pub fn var(&mut self, name: &str) -> Expr {
        let id = self.symbol_id(name, 0);
        self.symbol(id)
    }

    /// The direct operands of `e`.
    pub fn children(&self, e: Expr) -> Vec<Expr> {
        let mut found = Vec::new();
        self.for_each_child(e, |c| found.push(c));
        found
    }
}
