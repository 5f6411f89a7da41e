//! Machines with connections, written as energies and conditions; the equations follow by Lagrange's rule.
#![allow(dead_code)]

use std::sync::Arc;

use analysis::Machine;
use symbolic::connections::{Condition, Friction, Law, Reaction};
use symbolic::equations::{Coordinate, Output, Role};
use symbolic::{Derivation, Equations, Expr, Function, Graph, Matrix, Rational};
use words::Text;

/// A machine under construction.
pub struct Build {
    pub e: Equations,
}

impl Build {
    pub fn new() -> Build {
        Build { e: Equations { title: Text::same("linkage"), ..Equations::empty(Graph::new(), 0) } }
    }

    pub fn number(&mut self, value: f64) -> Expr {
        self.e.graph.number(Rational::from_f64(value).unwrap())
    }

    /// q and q' of a new coordinate; start and rate that are given are kept, guesses are not.
    pub fn coordinate(&mut self, name: &str, unit: &str, start: Start, rate: Start) -> [Expr; 2] {
        let symbols = [0, 1, 2].map(|primes| self.e.graph.symbol_id(name, primes));
        let given = [matches!(start, Start::Given(_)), matches!(rate, Start::Given(_))];
        let [start, rate] = [start, rate].map(|s| match s {
            Start::Given(v) | Start::Guess(v) => self.number(v),
        });
        self.e.coordinates.push(Coordinate {
            symbols,
            unit: unit.into(),
            label: Text::default(),
            start,
            rate,
            given,
            guessed: given.map(|g| !g),
        });
        let [q, v, _] = symbols.map(|s| self.e.graph.symbol(s));
        self.output(name, unit, q);
        self.output(&format!("{name}'"), &format!("{unit}/s"), v);
        [q, v]
    }

    pub fn output(&mut self, name: &str, unit: &str, formula: Expr) {
        let symbol = self.e.graph.symbol_id(&format!("output {name}"), 0);
        let (name, unit) = (name.to_owned(), unit.to_owned());
        self.e.outputs.push(Output { name, symbol, unit, display: None, label: Text::default(), role: Role::Named, formula });
    }

    pub fn add(&mut self, items: &[Expr]) -> Expr {
        self.e.graph.sum(items)
    }
    pub fn mul(&mut self, items: &[Expr]) -> Expr {
        self.e.graph.product(items)
    }
    pub fn times(&mut self, factor: f64, a: Expr) -> Expr {
        let factor = self.number(factor);
        self.e.graph.mul(factor, a)
    }
    pub fn sub(&mut self, a: Expr, b: Expr) -> Expr {
        self.e.graph.sub(a, b)
    }
    pub fn square(&mut self, a: Expr) -> Expr {
        self.e.graph.square(a)
    }
    pub fn sin(&mut self, a: Expr) -> Expr {
        self.e.graph.call(Function::Sin, &[a])
    }
    pub fn cos(&mut self, a: Expr) -> Expr {
        self.e.graph.call(Function::Cos, &[a])
    }
    /// d/dt over q, q', t.
    pub fn rate(&mut self, e: Expr) -> Expr {
        self.total(false).apply(&mut self.e.graph, e)
    }

    /// d/dt; with or without the terms with q''.
    fn total(&mut self, with_accelerations: bool) -> Derivation {
        let graph = &mut self.e.graph;
        let mut seeds = vec![(self.e.time, graph.one())];
        for c in &self.e.coordinates {
            seeds.push((c.symbols[0], graph.symbol(c.symbols[1])));
            if with_accelerations {
                seeds.push((c.symbols[1], graph.symbol(c.symbols[2])));
            }
        }
        Derivation::new(seeds)
    }

    /// A condition by its place, or by its rate where there is no place; returns its index.
    pub fn condition(&mut self, name: &str, place: Option<Expr>, rate: Option<Expr>) -> usize {
        let rate = rate.unwrap_or_else(|| place.map(|p| self.rate(p)).unwrap());
        let mut columns = vec![];
        for (j, c) in self.e.coordinates.iter().enumerate() {
            let column = self.e.graph.derivative(rate, c.symbols[1]);
            if !self.e.graph.is_zero(column) {
                columns.push((j, column));
            }
        }
        let remainder = self.rate(rate);
        self.e.conditions.push(Condition { name: Text::same(name), place, rate, columns, remainder, reaction: None });
        self.e.conditions.len() - 1
    }

    /// The reaction that owns the last condition; an output shows it under its name.
    fn own(&mut self, name: &str, unit: &str, sign: f64, law: Law) -> usize {
        let index = self.e.reactions.len();
        let condition = law.condition().unwrap();
        self.e.conditions[condition].reaction = Some(index);
        let columns = self.e.conditions[condition].columns.clone();
        let forces = columns.into_iter().map(|(j, e)| (j, self.times(sign, e))).collect();
        let symbol = self.e.graph.symbol_id(&format!("reaction {name}"), 0);
        self.e.reactions.push(Reaction {
            symbol,
            name: name.into(),
            unit: unit.into(),
            label: Text::same(name),
            forces,
            released: vec![],
            law,
        });
        let formula = self.e.graph.symbol(symbol);
        self.output(name, unit, formula);
        index
    }

    pub fn ideal(&mut self, name: &str, place: Expr) -> usize {
        let condition = self.condition(name, Some(place), None);
        self.own(name, "N", 1.0, Law::Ideal { condition })
    }

    pub fn contact(&mut self, name: &str, gap: Expr, restitution: f64) -> usize {
        let condition = self.condition(name, Some(gap), None);
        let restitution = self.number(restitution);
        let tangential = self.number(0.0);
        self.own(
            name,
            "N",
            1.0,
            Law::Contact { condition, gap, restitution, tangential, tie: name.starts_with("rope"), rebound: Default::default() },
        )
    }

    pub fn friction(&mut self, name: &str, sliding: Expr, fixed: f64, kinetic: f64) -> usize {
        let condition = self.condition(name, None, Some(sliding));
        let (fixed, kinetic) = (self.number(fixed), self.number(kinetic));
        let friction = Friction { condition, sliding, kinetic: [kinetic; 2], fixed, normal: None, across: None };
        self.own(name, "N", -1.0, Law::Friction(Box::new(friction)))
    }

    /// The friction is pressed by the force of another reaction.
    pub fn press(&mut self, friction: usize, normal: usize) {
        let (constant, one) = (self.e.graph.zero(), self.e.graph.one());
        if let Law::Friction(friction) = &mut self.e.reactions[friction].law {
            friction.normal = Some(symbolic::connections::Normal { constant, terms: vec![(normal, one)] });
        }
    }

    /// A prescribed motion: the condition belongs to no reaction.
    pub fn prescribe(&mut self, name: &str, place: Expr) {
        self.condition(name, Some(place), None);
    }

    /// An unknown force along a coordinate.
    pub fn motor(&mut self, name: &str, coordinate: usize) {
        let symbol = self.e.graph.symbol_id(&format!("reaction {name}"), 0);
        let one = self.e.graph.one();
        let forces = vec![(coordinate, one)];
        self.e.reactions.push(Reaction {
            symbol,
            name: name.into(),
            unit: "N m".into(),
            label: Text::same(name),
            forces,
            released: vec![],
            law: Law::Motor,
        });
        let formula = self.e.graph.symbol(symbol);
        self.output(name, "N m", formula);
    }

    /// Lagrange's equations from T, Π and generalized forces.
    pub fn lagrange(&mut self, kinetic: Expr, potential: Expr, loads: &[(usize, Expr)]) {
        let n = self.e.coordinates.len();
        let symbols: Vec<_> = self.e.coordinates.iter().map(|c| c.symbols).collect();
        let mut total = self.total(false);
        let g = &mut self.e.graph;
        let mut mass = Matrix::zeros(g, n, n);
        for i in 0..n {
            let momentum = g.derivative(kinetic, symbols[i][1]);
            for (j, s) in symbols.iter().enumerate() {
                let entry = g.derivative(momentum, s[1]);
                mass.set(i, j, entry);
            }
            let inertia = total.apply(g, momentum);
            let (by_place, fall) = (g.derivative(kinetic, symbols[i][0]), g.derivative(potential, symbols[i][0]));
            let mut terms = vec![by_place, g.neg(fall), g.neg(inertia)];
            terms.extend(loads.iter().filter(|l| l.0 == i).map(|l| l.1));
            let h = g.sum(&terms);
            self.e.force.push(h);
        }
        self.e.mass = mass;
        let energy = self.e.graph.add(kinetic, potential);
        self.e.energy.kinetic = kinetic;
        self.e.energy.potential = potential;
        self.e.energy.rate = self.total(true).apply(&mut self.e.graph, energy);
        self.output("E", "J", energy);
    }

    /// All connections take part.
    pub fn machine(&self) -> Machine {
        let program = Arc::new(program::lower::equations(&self.e).unwrap());
        let values = program.values.clone();
        Machine::new(&self.e, &program, &values, &[]).unwrap()
    }
}

/// A value at the start.
#[derive(Clone, Copy, Debug)]
pub enum Start {
    Given(f64),
    Guess(f64),
}

/// Points of a plane linkage: (x, y) + length (cos, sin) of an angle.
pub fn along(b: &mut Build, from: [Expr; 2], length: f64, angle: Expr) -> [Expr; 2] {
    let (c, s) = (b.cos(angle), b.sin(angle));
    let (dx, dy) = (b.times(length, c), b.times(length, s));
    [b.add(&[from[0], dx]), b.add(&[from[1], dy])]
}

/// m v²/2 of a point.
pub fn kinetic_energy(b: &mut Build, mass: f64, point: [Expr; 2]) -> Expr {
    kinetic(b, mass, point)
}

/// m v²/2 of a point.
pub fn kinetic(b: &mut Build, mass: f64, point: [Expr; 2]) -> Expr {
    let [vx, vy] = point.map(|p| b.rate(p));
    let (x, y) = (b.square(vx), b.square(vy));
    let sum = b.add(&[x, y]);
    b.times(0.5 * mass, sum)
}

/// Slider-crank: crank 0.1, rod 0.3, point masses at the pin and the slider, wheel on the crank. Coordinates phi, psi, x.
pub fn slider_crank(omega: f64) -> Build {
    let mut b = Build::new();
    let [phi, w] = b.coordinate("phi", "rad", Start::Given(0.3), Start::Given(omega));
    let [psi, _] = b.coordinate("psi", "rad", Start::Guess(-0.1), Start::Guess(0.0));
    let [x, _] = b.coordinate("x", "m", Start::Guess(0.4), Start::Guess(0.0));
    let zero = b.e.graph.zero();
    let pin = along(&mut b, [zero, zero], 0.1, phi);
    let end = along(&mut b, pin, 0.3, psi);
    let middle = along(&mut b, pin, 0.15, psi);
    let slider = [x, zero];
    let parts = [kinetic(&mut b, 0.5, pin), kinetic(&mut b, 0.4, middle), kinetic(&mut b, 0.8, slider)];
    let spin = b.square(w);
    let wheel = b.times(0.5 * 0.02, spin);
    let psi_rate = b.rate(psi);
    let psi_square = b.square(psi_rate);
    let rod = b.times(0.5 * 0.003, psi_square);
    let t = b.add(&[parts[0], parts[1], parts[2], wheel, rod]);
    // gravity along -y
    let heights = [b.times(0.5 * 9.81, pin[1]), b.times(0.4 * 9.81, middle[1])];
    let v = b.add(&heights);
    b.lagrange(t, v, &[]);
    let along_x = b.sub(end[0], x);
    b.ideal("pin B, x", along_x);
    b.ideal("pin B, y", end[1]);
    b
}

/// Four-bar: crank 0.1, coupler 0.35, rocker 0.3, ground 0.3; masses at the pins. Coordinates a, b, c from x.
pub fn four_bar(omega: f64) -> Build {
    let mut b = Build::new();
    let [a, w] = b.coordinate("a", "rad", Start::Given(0.3), Start::Given(omega));
    let [c, _] = b.coordinate("b", "rad", Start::Guess(0.8), Start::Guess(0.0));
    let [d, _] = b.coordinate("c", "rad", Start::Guess(1.5), Start::Guess(0.0));
    let zero = b.e.graph.zero();
    let ground = b.number(0.3);
    let first = along(&mut b, [zero, zero], 0.1, a);
    let second = along(&mut b, first, 0.35, c);
    let other = along(&mut b, [ground, zero], 0.3, d);
    let spin = b.square(w);
    let parts = [kinetic(&mut b, 0.5, first), kinetic(&mut b, 0.4, other), b.times(0.5 * 0.02, spin)];
    let coupler = b.rate(c);
    let coupler = b.square(coupler);
    let coupler = b.times(0.5 * 0.002, coupler);
    let t = b.add(&[parts[0], parts[1], parts[2], coupler]);
    let heights = [b.times(0.5 * 9.81, first[1]), b.times(0.4 * 9.81, other[1])];
    let v = b.add(&heights);
    b.lagrange(t, v, &[]);
    for (k, name) in ["pin B, x", "pin B, y"].into_iter().enumerate() {
        let place = b.sub(second[k], other[k]);
        b.ideal(name, place);
    }
    b
}
