//! A mechanism with one degree of freedom as one equation over its leading coordinate φ.
//!
//! The conditions J(q) q' = 0 give every rate as q_k' = u_k φ' with the transfer functions u_k(q), u = 1 for φ itself. With T = q'ᵀ M q'/2, generalized
//! forces Q_k and u' = Σ_k u_k ∂u/∂q_k,
//!
//! ```text
//! J(φ) = uᵀ M u                    reduced inertia, T = J φ'²/2
//! M(φ, φ', t) = Σ u_k Q_k          reduced moment, from M φ' = Σ Q_k q_k'; ideal reactions do no work
//! J φ'' + J' φ'²/2 = M             J' = dJ/dφ = Σ u_k ∂J/∂q_k
//! ```
//!
//! *Source*: I. I. Artobolevskii, Theory of Mechanisms and Machines, ch. on the motion of a machine under given forces.

use crate::connections::Law;
use crate::{Derivation, Equations, Expr, Graph, Substitution, SymbolId, Textbook};

/// The transfer function of a coordinate.
#[derive(Clone, Copy, Debug)]
pub struct Ratio {
    /// Index of the coordinate.
    pub coordinate: usize,
    /// Its letter.
    pub symbol: SymbolId,
    /// Its formula over coordinates and letters of ratios before it.
    pub formula: Expr,
    /// The same over coordinates alone.
    pub whole: Expr,
}

/// The equation of the machine.
#[derive(Clone, Debug)]
pub struct Reduced {
    /// Owner of the expressions.
    pub graph: Graph,
    /// Index of the leading coordinate.
    pub leading: usize,
    /// Transfer functions of the others, in the order in which they follow from one another.
    pub ratios: Vec<Ratio>,
    /// J over coordinates and letters of ratios.
    pub inertia: Expr,
    /// J over coordinates alone.
    pub whole: Expr,
    /// dJ/dφ over coordinates alone.
    pub slope: Expr,
    /// M over coordinates, φ', time and letters of ratios.
    pub moment: Expr,
    /// M over coordinates, φ' and time.
    pub whole_moment: Expr,
}

/// More nodes than this are not substituted into one another.
const LARGEST: usize = 4000;

/// The equation over a leading coordinate; none where the machine has not one degree of freedom, where friction or drives take part, or where the
/// conditions are not solved one after another.
pub fn reduce(equations: &Equations, leading: usize) -> Option<Reduced> {
    let n = equations.coordinates.len();
    if n < 2 || equations.conditions.len() + 1 != n || !is_ideal(equations) {
        return None;
    }
    let mut graph = equations.graph.clone();
    let ratios = ratios(equations, leading, &mut graph)?;
    let letters: Vec<Expr> = letters(&mut graph, n, &ratios);
    let mut whole: Vec<Expr> = vec![graph.one(); n];
    ratios.iter().for_each(|r| whole[r.coordinate] = r.whole);
    let powers = powers(equations, leading, (&letters, &whole), &mut graph);
    let constants = equations.parameters.iter().map(|p| p.symbol);
    let mut textbook = Textbook::new(&mut graph, constants, &[]);
    let inertia = quadratic(equations, &letters, &mut graph);
    let whole_inertia = quadratic(equations, &whole, &mut graph);
    let slope = along(equations, whole_inertia, &whole, &mut graph);
    if graph.reachable(&[whole_inertia, slope]).len() > LARGEST {
        return None;
    }
    let [inertia, moment] = [inertia, powers[0]].map(|e| textbook.tidy(&mut graph, e));
    let [whole, slope, whole_moment] = [whole_inertia, slope, powers[1]].map(|e| textbook.tidy(&mut graph, e));
    Some(Reduced { graph, leading, ratios, inertia, whole, slope, moment, whole_moment })
}

/// Whether every condition has an ideal reaction, or that of a taut rope or closed contact, and nothing else acts that is not given.
fn is_ideal(equations: &Equations) -> bool {
    let conditions = equations.conditions.iter().all(|c| c.reaction.is_some());
    let laws = |law: &Law| !matches!(law, Law::Friction(_) | Law::Motor | Law::Rough { .. });
    conditions && equations.auxiliaries.is_empty() && equations.reactions.iter().all(|r| laws(&r.law))
}

/// Letters of the coordinates' ratios, 1 for the leading one; a ratio that is a constant stands for itself.
fn letters(graph: &mut Graph, n: usize, ratios: &[Ratio]) -> Vec<Expr> {
    let mut letters = vec![graph.one(); n];
    for ratio in ratios {
        letters[ratio.coordinate] = graph.symbol(ratio.symbol);
    }
    letters
}

/// Solves the conditions one after another: a row with one unknown, or two rows with the same two.
fn ratios(equations: &Equations, leading: usize, graph: &mut Graph) -> Option<Vec<Ratio>> {
    let mut rows: Vec<Vec<(usize, Expr)>> = equations.conditions.iter().map(|c| c.columns.clone()).collect();
    if !rests(equations, graph) {
        return None;
    }
    let mut found: Vec<Ratio> = Vec::new();
    while !rows.is_empty() {
        let unknown = |row: &[(usize, Expr)], found: &[Ratio]| -> Vec<usize> {
            let known = |j: usize| j == leading || found.iter().any(|r| r.coordinate == j);
            row.iter().map(|(j, _)| *j).filter(|j| !known(*j)).collect()
        };
        let open: Vec<Vec<usize>> = rows.iter().map(|row| unknown(row, &found)).collect();
        if let Some(i) = open.iter().position(|list| list.len() == 1) {
            let (row, j) = (rows.remove(i), open[i][0]);
            let (pivot, rest) = parted(equations, graph, (&row, leading), &[j], &found)?;
            let negative = graph.neg(rest);
            let formula = tidied(equations, graph, [negative, pivot[0]]);
            found.push(ratio(equations, graph, (j, formula), &found));
            continue;
        }
        let pair = |list: &&Vec<usize>| list.len() == 2;
        let (i, k) = (0..rows.len()).flat_map(|i| (i + 1..rows.len()).map(move |k| (i, k))).find(|(i, k)| {
            pair(&&open[*i]) && {
                let (mut a, mut b) = (open[*i].clone(), open[*k].clone());
                a.sort_unstable();
                b.sort_unstable();
                a == b
            }
        })?;
        let wanted = open[i].clone();
        let (second, first) = (rows.remove(k), rows.remove(i));
        let ([a, b], e) = two(parted(equations, graph, (&first, leading), &wanted, &found)?)?;
        let ([c, d], f) = two(parted(equations, graph, (&second, leading), &wanted, &found)?)?;
        let determinant = cross(graph, [a, d], [b, c]);
        if graph.is_zero(determinant) {
            return None;
        }
        let (x, y) = (cross(graph, [b, f], [d, e]), cross(graph, [c, e], [a, f]));
        let before = found.clone();
        for (j, above) in [(wanted[0], x), (wanted[1], y)] {
            let formula = tidied(equations, graph, [above, determinant]);
            found.push(ratio(equations, graph, (j, formula), &before));
        }
    }
    Some(found)
}

fn two((pivot, rest): (Vec<Expr>, Expr)) -> Option<([Expr; 2], Expr)> {
    Some(([*pivot.first()?, *pivot.get(1)?], rest))
}

/// above/below, both in their textbook form: what lies under the bar is not reached from outside.
fn tidied(equations: &Equations, graph: &mut Graph, parts: [Expr; 2]) -> Expr {
    let constants = equations.parameters.iter().map(|p| p.symbol);
    let mut textbook = Textbook::new(graph, constants, &[]);
    let [above, below] = parts.map(|e| textbook.tidy(graph, e));
    graph.div(above, below)
}

/// a b − c d.
fn cross(graph: &mut Graph, [a, b]: [Expr; 2], [c, d]: [Expr; 2]) -> Expr {
    let (first, second) = (graph.mul(a, b), graph.mul(c, d));
    graph.sub(first, second)
}

/// Whether the conditions hold at rest: none changes with time by itself.
fn rests(equations: &Equations, graph: &mut Graph) -> bool {
    let zero = graph.zero();
    let mut still = Substitution::new(equations.coordinates.iter().map(|c| (c.symbols[1], zero)));
    equations.conditions.iter().all(|c| {
        let e = still.apply(graph, c.rate);
        graph.is_zero(e)
    })
}

/// The factors of the wanted rates in a row, and the sum of the others with their ratios.
fn parted(
    equations: &Equations,
    graph: &mut Graph,
    (row, leading): (&[(usize, Expr)], usize),
    wanted: &[usize],
    found: &[Ratio],
) -> Option<(Vec<Expr>, Expr)> {
    let mut pivots = vec![graph.zero(); wanted.len()];
    let mut rest = Vec::new();
    for (j, factor) in row {
        if let Some(k) = wanted.iter().position(|w| w == j) {
            pivots[k] = *factor;
        } else if *j == leading {
            rest.push(*factor);
        } else {
            let ratio = found.iter().find(|r| r.coordinate == *j)?;
            let letter = if is_constant(equations, graph, ratio.whole) { ratio.whole } else { graph.symbol(ratio.symbol) };
            rest.push(graph.mul(*factor, letter));
        }
    }
    let rest = graph.sum(&rest);
    pivots.iter().all(|p| !graph.is_zero(*p)).then_some((pivots, rest))
}

fn is_constant(equations: &Equations, graph: &Graph, e: Expr) -> bool {
    !graph.contains(e, |s| equations.coordinates.iter().any(|c| c.symbols.contains(&s)))
}

fn ratio(equations: &Equations, graph: &mut Graph, (coordinate, formula): (usize, Expr), before: &[Ratio]) -> Ratio {
    let constants = equations.parameters.iter().map(|p| p.symbol);
    let mut textbook = Textbook::new(graph, constants, &[]);
    let formula = textbook.tidy(graph, formula);
    let mut known = Substitution::new(before.iter().map(|r| (r.symbol, r.whole)));
    let whole = known.apply(graph, formula);
    let name = format!("u_{}", graph.symbol_info(equations.coordinates[coordinate].symbols[0]).name);
    let symbol = graph.symbol_id(&name, 0);
    Ratio { coordinate, symbol, formula, whole }
}

/// uᵀ M u.
fn quadratic(equations: &Equations, u: &[Expr], graph: &mut Graph) -> Expr {
    let n = u.len();
    let mut terms = Vec::new();
    for i in 0..n {
        for j in 0..n {
            terms.push(graph.product(&[equations.mass.get(i, j), u[i], u[j]]));
        }
    }
    graph.sum(&terms)
}

/// Σ u_k ∂e/∂q_k.
fn along(equations: &Equations, e: Expr, u: &[Expr], graph: &mut Graph) -> Expr {
    Derivation::new(equations.coordinates.iter().zip(u).map(|(c, u)| (c.symbols[0], *u))).apply(graph, e)
}

/// Σ u_k Q_k with the rates u_k φ', over letters and over coordinates alone.
fn powers(equations: &Equations, leading: usize, (letters, whole): (&[Expr], &[Expr]), graph: &mut Graph) -> [Expr; 2] {
    let forces: Vec<Expr> = (0..equations.coordinates.len()).map(|i| force(equations, i, graph)).collect();
    let rate = graph.symbol(equations.coordinates[leading].symbols[1]);
    [letters, whole].map(|u| {
        let rates: Vec<(SymbolId, Expr)> = equations.coordinates.iter().zip(u).map(|(c, u)| (c.symbols[1], graph.mul(*u, rate))).collect();
        let mut put = Substitution::new(rates);
        let terms: Vec<Expr> = forces
            .iter()
            .zip(u)
            .map(|(q, u)| {
                let force = put.apply(graph, *q);
                graph.mul(force, *u)
            })
            .collect();
        graph.sum(&terms)
    })
}

/// Q_i − ∂Π/∂q_i − ∂Φ/∂q_i'.
fn force(equations: &Equations, i: usize, graph: &mut Graph) -> Expr {
    let [q, qd, _] = equations.coordinates[i].symbols;
    let potential = Derivation::partial(graph, q).apply(graph, equations.energy.potential);
    let resisting = Derivation::partial(graph, qd).apply(graph, equations.energy.dissipation);
    let mut terms: Vec<Expr> = equations.applied.iter().flat_map(|load| &load.forces).filter(|(k, _)| *k == i).map(|(_, f)| *f).collect();
    terms.push(graph.neg(potential));
    terms.push(graph.neg(resisting));
    graph.sum(&terms)
}

impl Reduced {
    /// How far the equation is from the equations of motion at a state, as a share of its largest term: uᵀ(M (u φ'' + u' φ'²) − h) against
    /// J φ'' + J' φ'²/2 − M. `value` gives a number to every symbol of the model, rates but φ' not asked.
    pub fn deviation(&self, equations: &Equations, value: &dyn Fn(SymbolId) -> f64) -> f64 {
        let mut graph = self.graph.clone();
        let n = equations.coordinates.len();
        let mut u = vec![graph.one(); n];
        self.ratios.iter().for_each(|r| u[r.coordinate] = r.whole);
        let bends: Vec<Expr> = u.clone().into_iter().map(|e| along(equations, e, &u, &mut graph)).collect();
        let rate = graph.symbol(equations.coordinates[self.leading].symbols[1]);
        let square = graph.square(rate);
        let mut put =
            Substitution::new(equations.coordinates.iter().zip(&u).map(|(c, u)| (c.symbols[1], graph.mul(*u, rate))).collect::<Vec<_>>());
        let (mut left, mut right) = (Vec::new(), Vec::new());
        for (i, ratio) in u.iter().enumerate() {
            for (j, bend) in bends.iter().enumerate() {
                left.push(graph.product(&[equations.mass.get(i, j), *ratio, *bend, square]));
            }
            let force = put.apply(&mut graph, equations.force[i]);
            right.push(graph.mul(*ratio, force));
        }
        let half = graph.product(&[self.slope, square]);
        let half = graph.scale(half, &crate::Rational::HALF);
        let (left, right) = (graph.sum(&left), graph.sum(&right));
        let numbers = graph.evaluate(&[left, right, half, self.whole_moment], value);
        let size = numbers.iter().fold(f64::MIN_POSITIVE, |m, v| m.max(v.abs()));
        ((numbers[0] - numbers[1]) - (numbers[2] - numbers[3])).abs() / size
    }
}
