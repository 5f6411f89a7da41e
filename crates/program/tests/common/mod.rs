//! Equations built by hand.
#![allow(dead_code)]

pub mod mechanisms;

use symbolic::equations::{Auxiliary, Coordinate, Definition, Output, Parameter, Role};
use symbolic::{Equations, Expr, Function, Graph, Matrix, Rational, SymbolId};
use words::Text;

/// Equations without coordinates, over `graph`, with time `t`.
pub fn empty(graph: Graph) -> Equations {
    Equations::empty(graph, 0)
}

pub fn parameter(e: &mut Equations, name: &str, value: f64) -> Expr {
    let symbol = e.graph.symbol_id(name, 0);
    e.parameters.push(Parameter { symbol, value, rest: 0.0, written: String::new(), unit: String::new(), label: Text::default() });
    e.graph.symbol(symbol)
}

/// q, q'.
pub fn coordinate(e: &mut Equations, name: &str) -> (Expr, Expr) {
    let symbols = [0, 1, 2].map(|primes| e.graph.symbol_id(name, primes));
    let zero = e.graph.zero();
    e.coordinates.push(Coordinate {
        symbols,
        unit: String::new(),
        label: Text::default(),
        start: zero,
        rate: zero,
        given: [true; 2],
        guessed: [false; 2],
    });
    (e.graph.symbol(symbols[0]), e.graph.symbol(symbols[1]))
}

pub fn auxiliary(e: &mut Equations, name: &str, rate: Expr) -> Expr {
    let symbol = e.graph.symbol_id(name, 0);
    let start = e.graph.zero();
    e.auxiliaries.push(Auxiliary { symbol, unit: String::new(), label: Text::default(), rate, start });
    e.graph.symbol(symbol)
}

pub fn definition(e: &mut Equations, name: &str, formula: Expr) -> Expr {
    let symbol: SymbolId = e.graph.symbol_id(name, 0);
    e.definitions.push(Definition { symbol, formula, unit: String::new(), label: Text::default(), shown: true });
    e.graph.symbol(symbol)
}

pub fn output(e: &mut Equations, name: &str, formula: Expr) {
    let symbol = e.graph.symbol_id(name, 0);
    let (name, unit) = (name.to_owned(), String::new());
    e.outputs.push(Output { name, symbol, unit, display: None, label: Text::default(), role: Role::Named, formula });
}

pub fn ratio(n: i64, d: i64) -> Rational {
    Rational::new(n, d).unwrap()
}

/// Plane chain of n point masses on massless rods, absolute angles, symbols m_i, l_i:
/// M_ij = Σ_{k>=max(i,j)} m_k l_i l_j cos(φ_i - φ_j), h_i = -Σ_j (...) sin(φ_i - φ_j) φ_j'² - Σ_{k>=i} m_k g l_i sin φ_i.
pub fn pendulum_chain(n: usize) -> Equations {
    let mut e = empty(Graph::new());
    let g = parameter(&mut e, "g", 9.81);
    let m: Vec<Expr> = (0..n).map(|i| parameter(&mut e, &format!("m_{i}"), 1.0 + i as f64 * 0.01)).collect();
    let l: Vec<Expr> = (0..n).map(|i| parameter(&mut e, &format!("l_{i}"), 0.5 + i as f64 * 0.003)).collect();
    let q: Vec<(Expr, Expr)> = (0..n).map(|i| coordinate(&mut e, &format!("phi_{i}"))).collect();
    let graph = &mut e.graph;
    let below: Vec<Expr> = (0..n).map(|i| graph.sum(&m[i..])).collect();
    let mut mass = Matrix::zeros(graph, n, n);
    let mut forces = vec![Vec::new(); n];
    for i in 0..n {
        for j in 0..n {
            let difference = graph.sub(q[i].0, q[j].0);
            let factor = graph.product(&[below[i.max(j)], l[i], l[j]]);
            let cosine = graph.call(Function::Cos, &[difference]);
            let entry = graph.mul(factor, cosine);
            mass.set(i, j, entry);
            if i != j {
                let sine = graph.call(Function::Sin, &[difference]);
                let square = graph.square(q[j].1);
                let term = graph.product(&[factor, sine, square]);
                forces[i].push(graph.neg(term));
            }
        }
        let sine = graph.call(Function::Sin, &[q[i].0]);
        let weight = graph.product(&[below[i], g, l[i], sine]);
        forces[i].push(graph.neg(weight));
    }
    e.mass = mass;
    e.force = forces.iter().map(|f| e.graph.sum(f)).collect();
    e
}

/// Σ c_k h^k.
pub fn horner(c: &[f64], h: f64) -> f64 {
    c.iter().rev().fold(0.0, |sum, c| sum * h + c)
}
