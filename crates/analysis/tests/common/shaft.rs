//! Card P3, pendulum on a rotating shaft, written out by hand with e = 0.
#![allow(dead_code)]

use std::sync::Arc;

use analysis::Machine;
use symbolic::equations::{Coordinate, Output, Parameter, Role};
use symbolic::{Edge, Equations, Expr, Function, Graph, Matrix, Rational};
use words::Text;

fn blank(graph: Graph) -> Equations {
    Equations { title: Text::same("P3"), ..Equations::empty(graph, 3) }
}

/// The machine for a pendulum of mass m.
pub fn shaft(m: f64) -> Machine {
    let mut e = blank(Graph::new());
    let zero = e.graph.zero();
    for (name, unit) in [("x", "m"), ("y", "m"), ("phi", "rad")] {
        let symbols = [0, 1, 2].map(|primes| e.graph.symbol_id(name, primes));
        let label = Text::default();
        e.coordinates.push(Coordinate {
            symbols,
            unit: unit.into(),
            label: label.clone(),
            start: zero,
            rate: zero,
            given: [true; 2],
            guessed: [false; 2],
        });
        for (primes, symbol) in symbols.into_iter().enumerate().take(2) {
            let formula = e.graph.symbol(symbol);
            let (unit, name) = (format!("{unit}{}", "/s".repeat(primes)), format!("{name}{}", "'".repeat(primes)));
            e.outputs.push(Output { name, symbol, unit, display: None, label: label.clone(), role: Role::Named, formula });
        }
    }
    let values = [("M", 10.0 + m), ("m", m), ("l", 0.05), ("c_x", 4e5), ("c_y", 1e5), ("b", 25.0), ("k", 1e-4), ("g", 9.81)];
    let p: Vec<Expr> = values
        .iter()
        .map(|&(name, value)| {
            let symbol = e.graph.symbol_id(name, 0);
            e.parameters.push(Parameter { symbol, value, rest: 0.0, written: String::new(), unit: String::new(), label: Text::default() });
            e.graph.symbol(symbol)
        })
        .collect();
    let [big_m, m, l, c_x, c_y, b, k, g] = p[..] else { unreachable!() };
    let q: Vec<[Expr; 2]> = e
        .coordinates
        .iter()
        .map(|c| [c.symbols[0], c.symbols[1]])
        .collect::<Vec<_>>()
        .iter()
        .map(|s| s.map(|s| e.graph.symbol(s)))
        .collect();
    let t = e.graph.symbol(e.time);
    let graph = &mut e.graph;
    let (sin, cos) = (graph.call(Function::Sin, &[q[2][0]]), graph.call(Function::Cos, &[q[2][0]]));
    let number = |graph: &mut Graph, n| graph.number(Rational::new(n, 1).unwrap());
    let (ten, thirty, top) = (number(graph, 10), number(graph, 30), number(graph, 300));
    let (late, ramp) = (graph.sub(t, ten), graph.mul(thirty, t));
    let omega = graph.switch(late, Edge::Closed, top, ramp);
    let ml = graph.mul(m, l);
    let entries = [big_m, zero, graph.mul(ml, cos), big_m, graph.mul(ml, sin), graph.mul(ml, l)];
    for (n, (i, j)) in [(0, 0), (0, 1), (0, 2), (1, 1), (1, 2), (2, 2)].into_iter().enumerate() {
        e.mass.set(i, j, entries[n]);
        e.mass.set(j, i, entries[n]);
    }
    let spin = graph.square(q[2][1]);
    let term = |graph: &mut Graph, sign: i64, factors: &[Expr]| {
        let product = graph.product(factors);
        graph.scale(product, &Rational::new(sign, 1).unwrap())
    };
    let lag = graph.sub(omega, q[2][1]);
    let x = [term(graph, 1, &[ml, spin, sin]), term(graph, -1, &[c_x, q[0][0]]), term(graph, -1, &[b, q[0][1]])];
    let y = [term(graph, -1, &[ml, spin, cos]), term(graph, -1, &[c_y, q[1][0]]), term(graph, -1, &[b, q[1][1]])];
    let phi = [term(graph, 1, &[k, lag]), term(graph, -1, &[ml, g, sin])];
    e.force = vec![graph.sum(&x), graph.sum(&y), graph.sum(&phi)];
    let program = Arc::new(program::lower::equations(&e).unwrap());
    let values = program.values.clone();
    Machine::new(&e, &program, &values, &[]).unwrap()
}

/// x'' = -sign(x) with E = x'^2/2 + |x| and the second derivation x'' + sign(x).
pub fn relay() -> Machine {
    let mut e = blank(Graph::new());
    let zero = e.graph.zero();
    let symbols = [0, 1, 2].map(|primes| e.graph.symbol_id("x", primes));
    e.coordinates.push(Coordinate {
        symbols,
        unit: "m".into(),
        label: Text::default(),
        start: zero,
        rate: zero,
        given: [true; 2],
        guessed: [false; 2],
    });
    let [x, v, a] = symbols.map(|s| e.graph.symbol(s));
    let graph = &mut e.graph;
    let one = graph.one();
    e.mass = Matrix::zeros(graph, 1, 1);
    e.mass.set(0, 0, one);
    let sign = graph.call(Function::Sign, &[x]);
    e.force = vec![graph.neg(sign)];
    e.second = vec![graph.add(a, sign)];
    let (kinetic, restoring) = (graph.mul(v, a), graph.mul(sign, v));
    e.energy.rate = graph.add(kinetic, restoring);
    e.outputs.push(Output {
        name: "a".into(),
        symbol: symbols[2],
        unit: "m/s^2".into(),
        display: None,
        label: Text::default(),
        role: Role::Acceleration,
        formula: a,
    });
    let program = Arc::new(program::lower::equations(&e).unwrap());
    Machine::new(&e, &program, &[], &[Text::same("sign(x)")]).unwrap()
}

/// One coordinate x with a mass and a force made from (x, x', t).
pub fn single(make: impl Fn(&mut Graph, [Expr; 3]) -> (Expr, Expr)) -> Machine {
    let mut e = blank(Graph::new());
    let zero = e.graph.zero();
    let symbols = [0, 1, 2].map(|primes| e.graph.symbol_id("x", primes));
    e.coordinates.push(Coordinate {
        symbols,
        unit: "m".into(),
        label: Text::default(),
        start: zero,
        rate: zero,
        given: [true; 2],
        guessed: [false; 2],
    });
    let (x, v, t) = (e.graph.symbol(symbols[0]), e.graph.symbol(symbols[1]), e.graph.symbol(e.time));
    let (mass, force) = make(&mut e.graph, [x, v, t]);
    e.mass = Matrix::zeros(&mut e.graph, 1, 1);
    e.mass.set(0, 0, mass);
    e.force = vec![force];
    for (name, formula) in [("x", x), ("v", v)] {
        let (label, symbol) = (Text::default(), symbols[0]);
        e.outputs.push(Output { name: name.into(), symbol, unit: "m".into(), display: None, label, role: Role::Named, formula });
    }
    let program = Arc::new(program::lower::equations(&e).unwrap());
    let names = vec![Text::same("switch"); program.guards.len()];
    Machine::new(&e, &program, &[], &names).unwrap()
}

/// Double pendulum of unit masses and rods, g = 9.81, with E / (m l^2).
pub fn double_pendulum() -> Machine {
    let mut e = blank(Graph::new());
    let zero = e.graph.zero();
    for name in ["a", "b"] {
        let symbols = [0, 1, 2].map(|primes| e.graph.symbol_id(name, primes));
        e.coordinates.push(Coordinate {
            symbols,
            unit: "rad".into(),
            label: Text::default(),
            start: zero,
            rate: zero,
            given: [true; 2],
            guessed: [false; 2],
        });
    }
    let symbols: Vec<_> = e.coordinates.iter().map(|c| c.symbols).collect();
    let graph = &mut e.graph;
    let [a, b] = [0, 1].map(|i| [0, 1].map(|k| graph.symbol(symbols[i][k])));
    let number = |graph: &mut Graph, n, d| graph.number(Rational::new(n, d).unwrap());
    let (one, two, g) = (graph.one(), number(graph, 2, 1), number(graph, 981, 100));
    let difference = graph.sub(a[0], b[0]);
    let (sin, cos) = (graph.call(Function::Sin, &[difference]), graph.call(Function::Cos, &[difference]));
    let [weight_a, weight_b] = [a, b].map(|q| {
        let sine = graph.call(Function::Sin, &[q[0]]);
        graph.mul(g, sine)
    });
    let weight_a = graph.mul(two, weight_a);
    let (square_a, square_b) = (graph.square(a[1]), graph.square(b[1]));
    let (pull_a, pull_b) = (graph.mul(sin, square_b), graph.mul(sin, square_a));
    let first = graph.add(pull_a, weight_a);
    e.force = vec![graph.neg(first), graph.sub(pull_b, weight_b)];
    e.mass = Matrix::from_rows(&[vec![two, cos], vec![cos, one]]);
    let program = Arc::new(program::lower::equations(&e).unwrap());
    Machine::new(&e, &program, &[], &[]).unwrap()
}
