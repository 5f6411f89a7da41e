//! Machines with connections, built by hand. Conditions are differentiated here, forces follow from them by virtual work.

use super::*;
use symbolic::connections::{Balance, Condition, Friction, Law, Normal, Reaction};
use symbolic::{Derivation, Rational};

/// Σ ∂e/∂of · by.
fn along(e: &mut Equations, of: Expr, pairs: &[(SymbolId, Expr)]) -> Expr {
    let terms: Vec<Expr> = pairs
        .iter()
        .map(|(s, by)| {
            let partial = Derivation::partial(&mut e.graph, *s).apply(&mut e.graph, of);
            e.graph.mul(partial, *by)
        })
        .collect();
    e.graph.sum(&terms)
}

/// de/dt without the terms with q''.
fn rate_of(e: &mut Equations, of: Expr) -> Expr {
    let mut pairs = vec![(e.time, e.graph.one())];
    for c in e.coordinates.clone() {
        pairs.push((c.symbols[0], e.graph.symbol(c.symbols[1])));
    }
    along(e, of, &pairs)
}

/// ∂e/∂q'_j, nonzero ones.
pub fn by_rates(e: &mut Equations, of: Expr) -> Vec<(usize, Expr)> {
    let mut columns = Vec::new();
    for (j, c) in e.coordinates.clone().iter().enumerate() {
        let entry = Derivation::partial(&mut e.graph, c.symbols[1]).apply(&mut e.graph, of);
        if !e.graph.is_zero(entry) {
            columns.push((j, entry));
        }
    }
    columns
}

/// A condition on rates; returns its index.
pub fn rate_condition(e: &mut Equations, name: &str, place: Option<Expr>, rate: Expr) -> usize {
    let columns = by_rates(e, rate);
    let remainder = rate_of(e, rate);
    e.conditions.push(Condition { name: Text::same(name), place, rate, columns, remainder, reaction: None });
    e.conditions.len() - 1
}

/// place = 0; returns the index of the condition.
pub fn condition(e: &mut Equations, name: &str, place: Expr) -> usize {
    let rate = rate_of(e, place);
    rate_condition(e, name, Some(place), rate)
}

/// An unknown; returns its index.
pub fn reaction(e: &mut Equations, name: &str, forces: Vec<(usize, Expr)>, law: Law) -> usize {
    let symbol = e.graph.symbol_id(name, 0);
    let index = e.reactions.len();
    if let Some(c) = law.condition() {
        e.conditions[c].reaction = Some(index);
    }
    let (name, unit) = (name.to_owned(), "N".to_owned());
    e.reactions.push(Reaction { symbol, name, unit, label: Text::default(), forces, released: vec![], law });
    index
}

/// place = 0 held by a reaction whose force is `scale` ∂place/∂q.
pub fn connection(e: &mut Equations, name: &str, place: Expr, scale: i64) -> usize {
    let condition = condition(e, name, place);
    let forces = e.conditions[condition].columns.clone();
    let forces = forces.into_iter().map(|(j, c)| (j, e.graph.scale(c, &Rational::new(scale, 1).unwrap()))).collect();
    reaction(e, &format!("force({name})"), forces, Law::Ideal { condition })
}

pub fn friction(e: &mut Equations, name: &str, sliding: Expr, ([back, forth], fixed): ([Expr; 2], Expr), normal: Option<Normal>) -> usize {
    let condition = rate_condition(e, name, None, sliding);
    let forces = e.conditions[condition].columns.clone();
    let forces = forces.into_iter().map(|(j, c)| (j, e.graph.neg(c))).collect();
    let law = Friction { condition, sliding, kinetic: [back, forth], fixed, normal, across: None };
    reaction(e, &format!("friction({name})"), forces, Law::Friction(Box::new(law)))
}

/// gap >= 0 with restitution 1/2.
pub fn contact(e: &mut Equations, name: &str, gap: Expr) -> usize {
    let condition = condition(e, name, gap);
    let forces = e.conditions[condition].columns.clone();
    let restitution = e.graph.number(ratio(1, 2));
    reaction(
        e,
        &format!("force({name})"),
        forces,
        Law::Contact { condition, gap, restitution, tangential: restitution, tie: false, rebound: Default::default() },
    )
}

pub fn balance(e: &mut Equations, name: &str, columns: Vec<(usize, Expr)>, rest: Expr, released: &[(usize, Expr)]) {
    let index = e.balances.len();
    e.balances.push(Balance { name: Text::same(name), columns, rest, carried: None });
    for (reaction, factor) in released {
        e.reactions[*reaction].released.push((index, *factor));
    }
}

/// Diagonal masses.
pub fn masses(e: &mut Equations, m: &[Expr]) {
    e.mass = Matrix::zeros(&mut e.graph, m.len(), m.len());
    m.iter().enumerate().for_each(|(i, m)| e.mass.set(i, i, *m));
}

/// A point of mass m on a rod of length l, coordinates x, y (up); force(rod) is a tension.
pub fn cartesian_pendulum() -> Equations {
    let mut e = empty(Graph::new());
    let (m, g, l) = (parameter(&mut e, "m", 0.7), parameter(&mut e, "g", 9.81), parameter(&mut e, "l", 0.6));
    let ((x, _), (y, _)) = (coordinate(&mut e, "x"), coordinate(&mut e, "y"));
    masses(&mut e, &[m, m]);
    let weight = e.graph.mul(m, g);
    e.force = vec![e.graph.zero(), e.graph.neg(weight)];
    let place = {
        let (xx, yy) = (e.graph.square(x), e.graph.square(y));
        let square = e.graph.add(xx, yy);
        let length = e.graph.sqrt(square);
        e.graph.sub(length, l)
    };
    connection(&mut e, "rod", place, -1);
    e
}

/// Crank r turned about the origin (inertia J, torque over time), rod l with mass m_r at its middle, slider of mass m_s with a spring: coordinates phi, psi
/// (rod's angle down from the line), x. r sin phi = l sin psi, x = r cos phi + l cos psi.
pub fn slider_crank() -> Equations {
    let mut e = empty(Graph::new());
    let values = [("r", 0.1), ("l", 0.35), ("J", 0.02), ("m_r", 0.8), ("J_r", 0.004), ("m_s", 1.3), ("c", 40.0), ("M", 2.0)];
    let [r, l, inertia, m_r, j_r, m_s, c, torque] = values.map(|(name, v)| parameter(&mut e, name, v));
    let ((phi, w), (psi, _), (x, _)) = (coordinate(&mut e, "phi"), coordinate(&mut e, "psi"), coordinate(&mut e, "x"));
    let time = e.graph.symbol(e.time);
    let g = &mut e.graph;
    let sine = |g: &mut Graph, a: Expr| g.call(Function::Sin, &[a]);
    let cosine = |g: &mut Graph, a: Expr| g.call(Function::Cos, &[a]);
    // middle of the rod: (x - l/2 cos psi, l/2 sin psi)
    let half = g.scale(l, &ratio(1, 2));
    let sp = sine(g, psi);
    let lever = g.product(&[m_r, half, sp]);
    let square = g.square(half);
    let own = g.mul(m_r, square);
    let around = g.add(j_r, own);
    let total = g.add(m_r, m_s);
    let zero = g.zero();
    let mass = [vec![inertia, zero, zero], vec![zero, around, lever], vec![zero, lever, total]];
    let rate = g.symbol(e.coordinates[1].symbols[1]);
    let (cp, rr) = (cosine(g, psi), g.square(rate));
    let swing = g.product(&[m_r, half, cp, rr]);
    let swing = g.neg(swing);
    let spring = g.mul(c, x);
    let slider = g.sub(swing, spring);
    let st = sine(g, time);
    let drive = g.mul(torque, st);
    let drive = g.sub(drive, w);
    e.mass = Matrix::from_rows(&mass);
    e.force = vec![drive, zero, slider];
    let g = &mut e.graph;
    let (sf, cf) = (sine(g, phi), cosine(g, phi));
    let (up, down) = (g.mul(r, sf), g.mul(l, sp));
    let height = g.sub(up, down);
    let (a, b) = (g.mul(r, cf), g.mul(l, cp));
    let reach = g.sum(&[a, b]);
    let along = g.sub(reach, x);
    connection(&mut e, "pin, y", height, 1);
    connection(&mut e, "pin, x", along, 1);
    e
}

/// A state of the slider-crank at a crank angle.
pub fn slider_crank_state(phi: f64, w: f64) -> [f64; 6] {
    let (r, l) = (0.1, 0.35_f64);
    let psi = (r * phi.sin() / l).asin();
    let rate = r * w * phi.cos() / (l * psi.cos());
    [phi, psi, r * phi.cos() + l * psi.cos(), w, rate, -r * w * phi.sin() - l * rate * psi.sin()]
}

/// A block on an incline of angle a with dry friction; forces are limits in newtons.
pub fn block() -> Equations {
    let mut e = empty(Graph::new());
    let values = [("m", 1.7), ("g", 9.81), ("a", 0.3), ("F_k", 4.0), ("F_s", 6.0)];
    let [m, g, a, kinetic, fixed] = values.map(|(name, v)| parameter(&mut e, name, v));
    let (_, v) = coordinate(&mut e, "x");
    masses(&mut e, &[m]);
    let sine = e.graph.call(Function::Sin, &[a]);
    e.force = vec![e.graph.product(&[m, g, sine])];
    friction(&mut e, "block", v, ([kinetic, kinetic], fixed), None);
    e
}

/// Two weights on a rope over a fixed pulley, coordinates downwards; force(rope) is the tension.
pub fn atwood(first: f64, second: f64) -> Equations {
    let mut e = empty(Graph::new());
    let [m1, m2, g, length] = [("m_1", first), ("m_2", second), ("g", 9.81), ("l", 3.0)].map(|(name, v)| parameter(&mut e, name, v));
    let ((x, _), (y, _)) = (coordinate(&mut e, "x"), coordinate(&mut e, "y"));
    masses(&mut e, &[m1, m2]);
    e.force = vec![e.graph.mul(m1, g), e.graph.mul(m2, g)];
    let sum = e.graph.add(x, y);
    let place = e.graph.sub(sum, length);
    connection(&mut e, "rope", place, -1);
    e
}

/// The chain of [`pendulum_chain`] in Cartesian coordinates (y up): n rods, 2n coordinates x_0, y_0, x_1, ...
pub fn rod_chain(n: usize) -> Equations {
    let mut e = empty(Graph::new());
    let g = parameter(&mut e, "g", 9.81);
    let m: Vec<Expr> = (0..n).map(|i| parameter(&mut e, &format!("m_{i}"), 1.0 + i as f64 * 0.01)).collect();
    let l: Vec<Expr> = (0..n).map(|i| parameter(&mut e, &format!("l_{i}"), 0.5 + i as f64 * 0.003)).collect();
    let q: Vec<[Expr; 2]> = (0..n).map(|i| ["x", "y"].map(|c| coordinate(&mut e, &format!("{c}_{i}")).0)).collect();
    masses(&mut e, &m.iter().flat_map(|m| [*m; 2]).collect::<Vec<_>>());
    for m in m {
        let weight = e.graph.mul(m, g);
        let pair = [e.graph.zero(), e.graph.neg(weight)];
        e.force.extend(pair);
    }
    for i in 0..n {
        let squares = [0, 1].map(|k| {
            let difference = if i > 0 { e.graph.sub(q[i][k], q[i - 1][k]) } else { q[i][k] };
            e.graph.square(difference)
        });
        let square = e.graph.sum(&squares);
        let length = e.graph.sqrt(square);
        let place = e.graph.sub(length, l[i]);
        connection(&mut e, &format!("rod {i}"), place, -1);
    }
    e
}
