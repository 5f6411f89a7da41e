//! A structure of a model file in numbers: machine numbers always, exact rationals where every quantity has one.

use mechanics::Model;
use mechanics::structure::{self as file, Structure};
use std::collections::HashMap;
use structures::{Action, Component, Displacement, Frame, Load, Node, Place, Rod, RodKind, Support};
use symbolic::{Expr, Graph, Node as Term, Rational, SymbolId};

/// A structure in numbers.
#[derive(Clone, Debug)]
pub struct Bound {
    /// Machine numbers; loads at t = 0.
    pub frame: Frame<f64>,
    /// Exact numbers, without loads that have none.
    pub exact: Option<Frame<Rational>>,
}

/// A constant, exact if possible.
#[derive(Clone, Debug, PartialEq)]
pub struct Factor {
    /// Machine number.
    pub value: f64,
    /// Exact.
    pub exact: Option<Rational>,
}

/// Numbers of expressions over constant parameters.
pub struct Numbers<'a> {
    graph: &'a Graph,
    exact: HashMap<SymbolId, Option<Rational>>,
    machine: Vec<f64>,
    memo: HashMap<Expr, Option<Rational>>,
}

impl<'a> Numbers<'a> {
    /// Numbers with the parameters of a model.
    pub fn of(model: &'a Model) -> Numbers<'a> {
        let mut numbers =
            Numbers { graph: &model.graph, exact: HashMap::new(), machine: vec![0.0; model.graph.symbol_count()], memo: HashMap::new() };
        for p in &model.parameters {
            let exact = numbers.exact(p.value.expr());
            numbers.exact.insert(p.symbol, exact);
            numbers.machine[p.symbol.index()] = p.number.unwrap_or(0.0);
        }
        numbers
    }

    /// The machine number, from the exact one when there is one.
    pub fn value(&mut self, e: Expr) -> f64 {
        match self.exact(e) {
            Some(exact) => exact.to_f64(),
            None => self.graph.evaluate(&[e], &|s| self.machine.get(s.index()).copied().unwrap_or(0.0))[0],
        }
    }

    /// The exact number.
    pub fn exact(&mut self, root: Expr) -> Option<Rational> {
        let mut stack = vec![root];
        while let Some(&e) = stack.last() {
            if self.memo.contains_key(&e) {
                stack.pop();
                continue;
            }
            let open: Vec<Expr> = self.graph.children(e).into_iter().filter(|c| !self.memo.contains_key(c)).collect();
            if open.is_empty() {
                let value = self.node(e);
                self.memo.insert(e, value);
                stack.pop();
            } else {
                stack.extend(open);
            }
        }
        self.memo[&root].clone()
    }

    fn node(&self, e: Expr) -> Option<Rational> {
        let known = |e: &Expr| self.memo[e].clone();
        match self.graph.node(e) {
            Term::Number(r) => Some(r.clone()),
            Term::Symbol(s) => self.exact.get(s).cloned().flatten(),
            Term::Sum { constant, terms } => terms.iter().try_fold(constant.clone(), |sum, (t, f)| Some(&sum + &(&known(t)? * f))),
            Term::Product { coefficient, factors } => {
                factors.iter().try_fold(coefficient.clone(), |p, (b, x)| Some(&p * &power(&known(b)?, x)?))
            }
            _ => None,
        }
    }

    /// The machine number with a symbol at a value.
    pub fn at(&self, e: Expr, symbol: SymbolId, value: f64) -> f64 {
        let known = |s: SymbolId| if s == symbol { value } else { self.machine.get(s.index()).copied().unwrap_or(0.0) };
        self.graph.evaluate(&[e], &known)[0]
    }

    /// Both numbers.
    pub fn factor(&mut self, e: Expr) -> Factor {
        Factor { value: self.value(e), exact: self.exact(e) }
    }
}

/// An exact power, roots only where they are rational.
fn power(base: &Rational, exponent: &Rational) -> Option<Rational> {
    if base.is_zero() {
        return (!exponent.is_negative() && !exponent.is_zero()).then_some(Rational::ZERO);
    }
    if let Some(n) = exponent.to_i64() {
        return base.pow(n);
    }
    let (n, d) = exponent.digits();
    base.root(d.parse().ok()?)?.pow(n.parse().ok()?)
}

/// Numbers of a structure.
pub fn bind(model: &Model, structure: &Structure) -> Bound {
    let mut numbers = Numbers::of(model);
    let mut frame = Frame::<f64>::default();
    let mut exact = Some(Frame::<Rational>::default());
    let mut put = |e: Exact| {
        let Exact { node, rod, support, displacement, load } = e;
        let Some(frame) = &mut exact else { return };
        frame.nodes.extend(node);
        frame.rods.extend(rod);
        frame.supports.extend(support);
        frame.displacements.extend(displacement);
        frame.loads.extend(load);
    };
    let mut complete = true;
    for node in &structure.nodes {
        let both = (node_of(node, &mut |e| Some(numbers.value(e))), node_of(node, &mut |e| numbers.exact(e)));
        frame.nodes.extend(both.0);
        complete &= both.1.is_some();
        put(Exact { node: both.1, ..Exact::default() });
    }
    for rod in &structure.rods {
        let d = difference(&structure.nodes, rod);
        let both =
            (rod_of(rod, d, &mut |e| Some(numbers.value(e)), &|a, b| a / b), rod_of(rod, d, &mut |e| numbers.exact(e), &|a, b| a / b));
        frame.rods.extend(both.0);
        complete &= both.1.is_some();
        put(Exact { rod: both.1, ..Exact::default() });
    }
    for support in &structure.supports {
        let (value, exact) = axis(&mut numbers, support.angle);
        let support = |axis| Support { name: support.name.clone(), node: support.node, holds: support.holds, axis };
        frame.supports.push(support(value));
        complete &= exact.is_some();
        put(Exact {
            support: exact.map(|axis| Support { name: support(value).name, node: support(value).node, holds: support(value).holds, axis }),
            ..Exact::default()
        });
    }
    for d in &structure.displacements {
        let symbol = model.notation.iter().find(|(n, _)| *n == d.name).map_or_else(|| d.name.clone(), |(_, s)| s.clone());
        let both = (displacement_of(d, &symbol, &mut |e| Some(numbers.value(e))), displacement_of(d, &symbol, &mut |e| numbers.exact(e)));
        frame.displacements.extend(both.0);
        complete &= both.1.is_some();
        put(Exact { displacement: both.1, ..Exact::default() });
    }
    for load in &structure.loads {
        frame.loads.extend(load_of(load, &mut |e| Some(numbers.value(e))));
        put(Exact { load: load_of(load, &mut |e| numbers.exact(e)), ..Exact::default() });
    }
    Bound { frame, exact: exact.filter(|_| complete) }
}

/// One exact item of any kind.
#[derive(Default)]
struct Exact {
    node: Option<Node<Rational>>,
    rod: Option<Rod<Rational>>,
    support: Option<Support<Rational>>,
    displacement: Option<Displacement<Rational>>,
    load: Option<Load<Rational>>,
}

fn node_of<S>(node: &file::Node, number: &mut dyn FnMut(Expr) -> Option<S>) -> Option<Node<S>> {
    let at = [number(node.at[0])?, number(node.at[1])?];
    let springs = [number(node.springs[0])?, number(node.springs[1])?, number(node.springs[2])?];
    Some(Node { name: node.name.clone(), at, mass: number(node.mass)?, inertia: number(node.inertia)?, springs })
}

/// Start and end of a rod, as expressions of their coordinates.
fn difference(nodes: &[file::Node], rod: &file::Rod) -> [[Expr; 2]; 2] {
    rod.ends.map(|i| nodes[i].at)
}

fn rod_of<S: structures::Scalar>(
    rod: &file::Rod,
    ends: [[Expr; 2]; 2],
    number: &mut dyn FnMut(Expr) -> Option<S>,
    _: &dyn Fn(&S, &S) -> S,
) -> Option<Rod<S>> {
    let length = number(rod.length)?;
    let mut along = |k: usize| Some(number(ends[1][k])?.sub(&number(ends[0][k])?).div(&length));
    let direction = [along(0)?, along(1)?];
    let mut option = |e: Option<Expr>| match e {
        Some(e) => Some(Some(number(e)?)),
        None => Some(None),
    };
    let (bending, axial) = (option(rod.bending)?, option(rod.axial)?);
    let kind = match bending {
        _ if rod.rigid => RodKind::Rigid,
        Some(bending) => RodKind::Beam { bending, axial },
        None => RodKind::Bar(axial),
    };
    let (mass, rotary) = (number(rod.mass)?, number(rod.rotary)?);
    let divisions = rod.divisions.unwrap_or(1);
    Some(Rod { name: rod.name.clone(), ends: rod.ends, length, direction, kind, mass, rotary, hinged: rod.hinged, divisions })
}

fn axis(numbers: &mut Numbers, angle: Expr) -> ([f64; 2], Option<[Rational; 2]>) {
    let value = numbers.value(angle);
    let (sin, cos) = algebra::elementary::sin_cos(value);
    let exact = numbers.exact(angle).filter(Rational::is_zero).map(|_| [Rational::ONE, Rational::ZERO]);
    (if exact.is_some() { [1.0, 0.0] } else { [cos, sin] }, exact)
}

fn place<S>(site: &file::Site, number: &mut dyn FnMut(Expr) -> Option<S>) -> Option<Place<S>> {
    Some(match site {
        file::Site::Node(i) => Place::Node(*i),
        file::Site::Rod(i, s) => Place::Rod(*i, number(*s)?),
    })
}

fn displacement_of<S>(d: &file::Displacement, symbol: &str, number: &mut dyn FnMut(Expr) -> Option<S>) -> Option<Displacement<S>> {
    let component = match d.direction {
        file::Direction::Along([x, y]) => Component::Along([number(x)?, number(y)?]),
        file::Direction::Turn => Component::Turn,
    };
    Some(Displacement {
        name: d.name.clone(),
        symbol: symbol.to_owned(),
        label: d.label.clone(),
        place: place(&d.site, number)?,
        component,
        loaded: d.loaded,
    })
}

fn load_of<S>(load: &file::Load, number: &mut dyn FnMut(Expr) -> Option<S>) -> Option<Load<S>> {
    let action = match &load.action {
        file::Action::Point { site, value } => {
            Action::Point { at: place(site, number)?, value: [number(value[0])?, number(value[1])?, number(value[2])?] }
        }
        file::Action::Distributed { rod, value: [start, end] } => {
            let value = [[number(start[0])?, number(start[1])?], [number(end[0])?, number(end[1])?]];
            Action::Distributed { rod: *rod, value }
        }
    };
    Some(Load { name: load.name.clone(), action })
}
