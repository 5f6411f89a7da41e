//! What kind of quantity a symbol is, which decides where it stands in a formula.

use symbolic::{Equations, Expr, Graph, Node, SymbolId};

/// What a symbol depends on, in the order in which factors are written.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Default)]
pub enum SymbolClass {
    /// A parameter, or a formula of parameters.
    #[default]
    Constant,
    /// A prescribed function of time.
    TimeFunction,
    /// Time.
    Time,
    /// An auxiliary state (the turn angle of a shaft with prescribed speed).
    Auxiliary,
    /// A generalized coordinate.
    Coordinate,
    /// Its rate.
    Rate,
    /// Its second derivative.
    Acceleration,
}

/// Place of a symbol among all symbols: the derived order is the order in print.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Standing {
    pub class: SymbolClass,
    /// Among constants the kind of quantity (see [`constant_rank`]); otherwise the number of the coordinate.
    pub rank: u32,
    /// Order of creation.
    pub index: usize,
}

/// Textbooks write `μ m g l`: ratios, then what carries mass or force, then g, then geometry.
const RATIO: u32 = 0;
const MASS: u32 = 1;
const GRAVITY: u32 = 2;
const OTHER: u32 = 3;

/// The class and rank of every symbol of one graph.
#[derive(Clone, Debug, Default)]
pub(super) struct Classes {
    entries: Vec<Option<(SymbolClass, u32)>>,
}

impl Classes {
    /// Reads the classes from the lists of `equations`.
    pub fn of(equations: &Equations) -> Classes {
        let mut classes = Classes::default();
        for p in &equations.parameters {
            let name = &equations.graph.symbol_info(p.symbol).name;
            classes.set(p.symbol, SymbolClass::Constant, constant_rank(name, &p.unit));
        }
        classes.set(equations.time, SymbolClass::Time, 0);
        for (i, a) in equations.auxiliaries.iter().enumerate() {
            classes.set(a.symbol, SymbolClass::Auxiliary, i as u32);
        }
        for (i, c) in equations.coordinates.iter().enumerate() {
            let [q, qd, qdd] = c.symbols;
            classes.set(q, SymbolClass::Coordinate, i as u32);
            classes.set(qd, SymbolClass::Rate, i as u32);
            classes.set(qdd, SymbolClass::Acceleration, i as u32);
        }
        for d in &equations.definitions {
            let name = &equations.graph.symbol_info(d.symbol).name;
            match classes.highest(&equations.graph, d.formula) {
                SymbolClass::Constant => classes.set(d.symbol, SymbolClass::Constant, constant_rank(name, &d.unit)),
                SymbolClass::TimeFunction | SymbolClass::Time | SymbolClass::Auxiliary => {
                    classes.set(d.symbol, SymbolClass::TimeFunction, 0);
                }
                state => classes.set(d.symbol, state, u32::MAX),
            }
        }
        classes
    }

    /// Declares a symbol.
    pub fn set(&mut self, symbol: SymbolId, class: SymbolClass, rank: u32) {
        let i = symbol.index();
        if self.entries.len() <= i {
            self.entries.resize(i + 1, None);
        }
        self.entries[i] = Some((class, rank));
    }

    /// Where the symbol stands; an undeclared one is a constant.
    pub fn standing(&self, graph: &Graph, symbol: SymbolId) -> Standing {
        let index = symbol.index();
        let known = self.entries.get(index).copied().flatten();
        let (class, rank) = known.unwrap_or_else(|| (SymbolClass::Constant, constant_rank(&graph.symbol_info(symbol).name, "")));
        Standing { class, rank, index }
    }

    fn highest(&self, graph: &Graph, e: Expr) -> SymbolClass {
        let mut seen = std::collections::HashSet::new();
        let mut stack = vec![e];
        let mut highest = SymbolClass::Constant;
        while let Some(e) = stack.pop() {
            if !seen.insert(e) {
                continue;
            }
            match graph.node(e) {
                Node::Symbol(s) => highest = highest.max(self.standing(graph, *s).class),
                _ => stack.extend(graph.children(e)),
            }
        }
        highest
    }
}

fn constant_rank(name: &str, unit: &str) -> u32 {
    const CARRIES_MASS: [&str; 9] = ["kg", "g", "t", "N", "kN", "MN", "J", "W", "Pa"];
    if name == "g" {
        GRAVITY
    } else if unit == "1" {
        RATIO
    } else if unit.split(|c: char| !c.is_alphabetic()).any(|u| CARRIES_MASS.contains(&u)) {
        MASS
    } else {
        OTHER
    }
}
