//! What stands before what.
//!
//! Factors: number, ratios, masses and forces, g, other constants, functions of time, coordinates, rates, accelerations; then bars,
//! cases, exponentials and named functions (`m l φ'' cos φ`).
//!
//! Terms of the left side of an equation of motion: the equation's own acceleration, then the others in the order of the coordinates.
//!
//! Terms of the right side: driving by time, products of rates (inertia forces), constant and affine loads, nonlinear functions of
//! position (gravity), springs (polynomials of position), dampers and friction.
//!
//! Terms of a derivative ∂T/∂q': the own rate first.
//!
//! Terms of any other sum: accelerations first, then from constants to rates (the other way round when rates are squared, as in an
//! energy), simple coefficients before varying ones (`l₀ − λ x`, `ω − φ'`, `m_x x'²/2 + m₁ (l₀ − λ x)² φ'²/2`).

use super::classes::{Classes, Standing, SymbolClass};
use std::collections::HashMap;
use symbolic::{Expr, Function, Graph, Node, Rational};

/// Which order the terms of a sum follow.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Side {
    /// Any sum.
    Plain,
    /// The argument of a sine: constants last.
    Angle,
    /// A sum with squares of rates.
    Quadratic,
    /// A derivative of an energy by the rate of this coordinate.
    Momentum(usize),
    /// Left side of the equation of motion of this coordinate.
    Left(usize),
    /// Right side of an equation of motion.
    Right,
}

/// What the order of terms needs to know of an expression.
#[derive(Clone, Debug, Default)]
pub(super) struct Traits {
    /// Highest class of its symbols.
    pub class: SymbolClass,
    /// First symbol in print order.
    pub first: Option<Standing>,
    /// Whether time occurs, openly or in a function of time.
    time: bool,
    /// Time derivatives of functions of time.
    time_primes: u8,
    /// Least and greatest degree in rates.
    rates: (u32, u32),
    /// Greatest degree in coordinates.
    coordinates: u32,
    /// Coordinates inside functions, roots or denominators.
    nonlinear: bool,
    /// Named functions, bars or cases.
    functions: bool,
    /// A function of rates.
    friction: bool,
    /// First coordinate whose acceleration occurs.
    acceleration: Option<u32>,
}

/// Traits of the parts of one graph, computed once each.
pub(super) struct Survey<'a> {
    graph: &'a Graph,
    classes: &'a Classes,
    known: HashMap<Expr, Traits>,
}

/// Deeper expressions are not looked into: a formula that deep is never read.
const DEPTH: usize = 400;
const DEGREE: u32 = 1000;

impl<'a> Survey<'a> {
    pub fn new(graph: &'a Graph, classes: &'a Classes) -> Survey<'a> {
        Survey { graph, classes, known: HashMap::new() }
    }

    pub fn traits(&mut self, e: Expr) -> Traits {
        self.traits_at(e, 0)
    }

    fn traits_at(&mut self, e: Expr, depth: usize) -> Traits {
        if let Some(known) = self.known.get(&e) {
            return known.clone();
        }
        if depth > DEPTH {
            return Traits::default();
        }
        let graph = self.graph;
        let traits = match graph.node(e) {
            Node::Number(_) | Node::Pi => Traits::default(),
            Node::Symbol(s) => self.symbol(self.classes.standing(graph, *s), graph.symbol_info(*s).primes),
            Node::Sum { constant, terms } => self.sum(constant, terms, depth),
            Node::Product { factors, .. } => self.product(factors, depth),
            Node::Power { .. } | Node::Call { .. } | Node::Switch { .. } => self.opaque(e, depth),
        };
        self.known.insert(e, traits.clone());
        traits
    }

    fn symbol(&self, standing: Standing, primes: u8) -> Traits {
        let mut traits = Traits { class: standing.class, first: Some(standing), ..Traits::default() };
        match standing.class {
            SymbolClass::Constant => {}
            SymbolClass::TimeFunction => {
                traits.time = true;
                traits.time_primes = primes;
            }
            SymbolClass::Time | SymbolClass::Auxiliary => traits.time = true,
            SymbolClass::Coordinate => traits.coordinates = 1,
            SymbolClass::Rate => traits.rates = (1, 1),
            SymbolClass::Acceleration => traits.acceleration = Some(standing.rank),
        }
        traits
    }

    fn sum(&mut self, constant: &Rational, terms: &[(Expr, Rational)], depth: usize) -> Traits {
        let mut all: Option<Traits> = (!constant.is_zero()).then(Traits::default);
        for (term, _) in terms {
            let one = self.traits_at(*term, depth + 1);
            all = Some(match all {
                None => one,
                Some(mut all) => {
                    all.absorb(&one);
                    all.rates = (all.rates.0.min(one.rates.0), all.rates.1.max(one.rates.1));
                    all.coordinates = all.coordinates.max(one.coordinates);
                    all
                }
            });
        }
        all.unwrap_or_default()
    }

    fn product(&mut self, factors: &[(Expr, Rational)], depth: usize) -> Traits {
        let mut all = Traits::default();
        for (base, exponent) in factors {
            let one = self.traits_at(*base, depth + 1);
            all.absorb(&one);
            match exponent.to_i64().and_then(|n| u32::try_from(n).ok()) {
                Some(n) => {
                    let raised = |d: u32| d.saturating_mul(n).min(DEGREE);
                    all.rates = (all.rates.0 + raised(one.rates.0), all.rates.1 + raised(one.rates.1));
                    all.coordinates += raised(one.coordinates);
                }
                None => {
                    all.nonlinear |= one.coordinates > 0;
                    all.friction |= one.rates.1 > 0;
                }
            }
        }
        all.rates = (all.rates.0.min(DEGREE), all.rates.1.min(DEGREE));
        all.coordinates = all.coordinates.min(DEGREE);
        all
    }

    /// Functions, cases and symbolic powers: degrees turn into flags.
    fn opaque(&mut self, e: Expr, depth: usize) -> Traits {
        let mut all = Traits { functions: true, ..Traits::default() };
        for child in self.graph.children(e) {
            let one = self.traits_at(child, depth + 1);
            all.absorb(&one);
            all.nonlinear |= one.coordinates > 0;
            all.friction |= one.rates.1 > 0;
        }
        all
    }
}

impl Traits {
    fn absorb(&mut self, part: &Traits) {
        self.class = self.class.max(part.class);
        self.first = [self.first, part.first].into_iter().flatten().min();
        self.time |= part.time;
        self.time_primes = self.time_primes.max(part.time_primes);
        self.nonlinear |= part.nonlinear;
        self.functions |= part.functions;
        self.friction |= part.friction;
        self.acceleration = [self.acceleration, part.acceleration].into_iter().flatten().min();
    }

    /// Place of a term on the right side.
    fn load(&self) -> u8 {
        let state = self.class >= SymbolClass::Coordinate;
        if self.friction {
            7
        } else if self.time {
            u8::from(state)
        } else if self.rates.0 >= 2 {
            2
        } else if !state || self.rates == (0, 1) {
            3
        } else if self.rates.1 > 0 {
            6
        } else if self.nonlinear {
            4
        } else {
            5
        }
    }
}

/// Sort key of a term; the fields are compared in turn.
#[derive(PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct TermKey {
    leader: u32,
    category: u8,
    functions: bool,
    varying: bool,
    time_primes: u8,
    degree: u32,
    /// Symbols that are not constant, higher powers first.
    state: Vec<(Standing, i64)>,
    /// Sum of the exponents of constants: `J + m l²`.
    weight: u64,
    constants: Vec<Standing>,
    tie: Expr,
}

/// The symbols among the factors of a term.
#[derive(Default)]
struct Letters {
    /// Those that are not constant, with minus their exponent.
    state: Vec<(Standing, i64)>,
    /// Constants (and sums of constants, by their first), with the size of the exponent.
    constants: Vec<(Standing, u64)>,
}

impl Survey<'_> {
    /// The order for a plain sum of these terms.
    pub fn settle_side(&mut self, terms: &[(Expr, Rational)], side: Side) -> Side {
        let squares = side == Side::Plain && terms.iter().any(|t| self.traits(t.0).rates.1 >= 2);
        if squares { Side::Quadratic } else { side }
    }

    /// The key of a term of a sum.
    pub fn term_key(&mut self, term: Expr, side: Side) -> TermKey {
        let traits = self.traits(term);
        let Letters { state, constants } = self.letters(term);
        let leader = match side {
            Side::Momentum(_) => state.iter().find(|s| s.0.class == SymbolClass::Rate).map(|s| s.0.rank),
            _ => traits.acceleration,
        };
        let leader = match (side, leader) {
            (Side::Left(own) | Side::Momentum(own), Some(i)) if i as usize == own => 0,
            (_, Some(i)) => i.saturating_add(1),
            (_, None) => u32::MAX,
        };
        let category = match side {
            Side::Right => traits.load(),
            Side::Angle if traits.class == SymbolClass::Constant => u8::MAX,
            Side::Quadratic => u8::MAX - u8::try_from(traits.rates.1).unwrap_or(u8::MAX),
            _ => traits.class as u8,
        };
        TermKey {
            leader,
            category,
            functions: traits.functions,
            varying: traits.class >= SymbolClass::Rate && (traits.coordinates > 0 || traits.nonlinear),
            time_primes: traits.time_primes,
            degree: if traits.rates.1 > 0 { traits.rates.1 } else { traits.coordinates },
            state,
            weight: constants.iter().map(|c| c.1).sum(),
            constants: constants.into_iter().map(|c| c.0).collect(),
            tie: term,
        }
    }

    /// The symbols among the factors of a term.
    fn letters(&mut self, term: Expr) -> Letters {
        let graph = self.graph;
        let one = [(term, Rational::ONE)];
        let factors: &[(Expr, Rational)] = match graph.node(term) {
            Node::Product { factors, .. } => factors,
            _ => &one,
        };
        let Letters { mut state, mut constants } = Letters::default();
        for (base, exponent) in factors {
            let traits = self.traits(*base);
            let Some(first) = traits.first else { continue };
            if traits.class == SymbolClass::Constant {
                constants.push((first, exponent.to_i64().map_or(1, |n| n.unsigned_abs().min(1000))));
            } else if let Node::Symbol(_) = graph.node(*base) {
                state.push((first, -exponent.to_i64().unwrap_or(0)));
            }
        }
        state.sort_by(|a, b| b.0.class.cmp(&a.0.class).then(a.cmp(b)));
        constants.sort();
        Letters { state, constants }
    }

    /// The key of a factor of a product.
    pub fn factor_key(&mut self, base: Expr) -> FactorKey {
        let traits = self.traits(base);
        let (group, function) = match self.graph.node(base) {
            Node::Number(_) => (0, 0),
            Node::Pi => (1, 0),
            Node::Call { function: Function::Abs, .. } => (3, 0),
            Node::Switch { .. } => (4, 0),
            Node::Call { function: Function::Exp, .. } => (5, 0),
            Node::Call { function, .. } => (6, *function as u8),
            _ => (2, 0),
        };
        let composite = !matches!(self.graph.node(base), Node::Symbol(_)) && traits.class != SymbolClass::Constant;
        FactorKey { group, class: traits.class, composite, first: traits.first, argument: self.argument(base), function, tie: base }
    }

    fn argument(&self, base: Expr) -> Expr {
        match self.graph.node(base) {
            Node::Call { arguments, .. } => arguments[0],
            _ => base,
        }
    }
}

/// Sort key of a factor; the fields are compared in turn.
#[derive(PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct FactorKey {
    group: u8,
    class: SymbolClass,
    composite: bool,
    first: Option<Standing>,
    argument: Expr,
    function: u8,
    tie: Expr,
}
