//! Periodic functions in numbers: panels of Gauss's nodes on which they are smooth, Fourier coefficients, antiderivatives.
//!
//! A period 0...2π is cut where a switch, a sign, an absolute value, a least or a largest value changes, and further until the Legendre
//! coefficients of the function on every panel have died out. Sums over the nodes are then integrals to rounding.

use algebra::elementary;
use std::f64::consts::{PI, TAU};
use std::sync::{Arc, LazyLock};

use program::lower::{self, Inputs};
use program::{Evaluator, Point, Tape};
use symbolic::{Expr, Function, Graph, Node, SymbolId};

use crate::Fault;

/// Nodes of a panel.
pub const NODES: usize = 16;
/// Harmonics that are listed.
pub const LISTED: usize = 40;
/// Panels that a period begins with.
const FIRST: usize = 64;
/// Instants at which a guard is looked at.
const LOOKS: usize = 4096;
/// Panels shorter than this hold nothing.
const SHORTEST: f64 = 1e-12;
/// Share of the largest coefficient below which the last ones have died out.
const RESOLVED: f64 = 1e-12;

/// Gauss-Legendre nodes and weights on -1...1, and what follows from them.
pub struct Rule {
    /// Nodes, ascending.
    pub x: [f64; NODES],
    /// Weights.
    pub w: [f64; NODES],
    /// Row n: (2n + 1)/2 w_i P_n(x_i), values to Legendre coefficients.
    analysis: [[f64; NODES]; NODES],
    /// Row i: integral from -1 to x_i of the interpolant, by value.
    running: [[f64; NODES]; NODES],
}

/// The rule. *Source*: M. Abramowitz, I. Stegun, 25.4.29; nodes by Newton's method.
pub static RULE: LazyLock<Rule> = LazyLock::new(Rule::new);

/// P_0 ... P_NODES at x.
fn legendre(x: f64) -> [f64; NODES + 1] {
    let mut p = [1.0; NODES + 1];
    p[1] = x;
    for n in 1..NODES {
        let k = n as f64;
        p[n + 1] = ((2.0 * k + 1.0) * x * p[n] - k * p[n - 1]) / (k + 1.0);
    }
    p
}

impl Rule {
    fn new() -> Rule {
        let mut rule = Rule { x: [0.0; NODES], w: [0.0; NODES], analysis: [[0.0; NODES]; NODES], running: [[0.0; NODES]; NODES] };
        let n = NODES as f64;
        for i in 0..NODES {
            let mut x = -elementary::cos(PI * (i as f64 + 0.75) / (n + 0.5));
            let mut slope = 1.0;
            for _ in 0..20 {
                let p = legendre(x);
                slope = n * (p[NODES - 1] - x * p[NODES]) / (1.0 - x * x);
                x -= p[NODES] / slope;
            }
            rule.x[i] = x;
            rule.w[i] = 2.0 / ((1.0 - x * x) * slope * slope);
        }
        for i in 0..NODES {
            let p = legendre(rule.x[i]);
            for (k, row) in rule.analysis.iter_mut().enumerate() {
                row[i] = 0.5 * (2 * k + 1) as f64 * rule.w[i] * p[k];
            }
        }
        for i in 0..NODES {
            let p = legendre(rule.x[i]);
            // ∫ P_0 = x + 1, ∫ P_k = (P_(k+1) - P_(k-1))/(2k + 1)
            let integral = |k: usize| if k == 0 { rule.x[i] + 1.0 } else { (p[k + 1] - p[k - 1]) / (2 * k + 1) as f64 };
            let mut row = [0.0; NODES];
            for (j, entry) in row.iter_mut().enumerate() {
                *entry = (0..NODES).map(|k| integral(k) * rule.analysis[k][j]).sum();
            }
            rule.running[i] = row;
        }
        rule
    }

    /// Legendre coefficients of values at the nodes.
    pub fn coefficients(&self, values: &[f64]) -> [f64; NODES] {
        std::array::from_fn(|n| self.analysis[n].iter().zip(values).map(|(a, v)| a * v).sum())
    }
}

/// The value of a Legendre series at x in -1...1.
pub fn series(coefficients: &[f64; NODES], x: f64) -> f64 {
    legendre(x).iter().zip(coefficients).map(|(p, c)| p * c).sum()
}

/// A period cut into panels.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Panels {
    /// Ends, ascending, from 0 to 2π.
    pub edges: Vec<f64>,
}

impl Panels {
    /// Panels with given ends among them, none longer than `longest`.
    pub fn new(mut edges: Vec<f64>, longest: f64) -> Panels {
        edges.retain(|e| *e > SHORTEST && *e < TAU - SHORTEST);
        edges.extend([0.0, TAU]);
        edges.sort_by(f64::total_cmp);
        edges.dedup_by(|a, b| (*a - *b).abs() <= SHORTEST);
        let mut all = vec![0.0];
        for pair in edges.windows(2) {
            let parts = ((pair[1] - pair[0]) / longest).ceil().max(1.0);
            let count = parts as usize;
            all.extend((1..count).map(|i| pair[0] + (pair[1] - pair[0]) * i as f64 / parts));
            all.push(pair[1]);
        }
        Panels { edges: all }
    }

    /// Number of panels.
    pub fn count(&self) -> usize {
        self.edges.len().saturating_sub(1)
    }

    /// All nodes.
    pub fn nodes(&self) -> Vec<f64> {
        let place = |pair: &[f64]| RULE.x.map(|x| 0.5 * (pair[0] + pair[1]) + 0.5 * (pair[1] - pair[0]) * x);
        self.edges.windows(2).flat_map(place).collect()
    }

    /// The weights of an integral over the period.
    pub fn weights(&self) -> Vec<f64> {
        self.edges.windows(2).flat_map(|pair| RULE.w.map(|w| 0.5 * (pair[1] - pair[0]) * w)).collect()
    }

    /// ∫ from 0 to each node of values at the nodes.
    pub fn integral(&self, values: &[f64]) -> Vec<f64> {
        let mut out = Vec::with_capacity(values.len());
        let mut before = 0.0;
        for (pair, own) in self.edges.windows(2).zip(values.chunks(NODES)) {
            let half = 0.5 * (pair[1] - pair[0]);
            let upto = |row: &[f64; NODES]| before + half * row.iter().zip(own).map(|(a, v)| a * v).sum::<f64>();
            out.extend(RULE.running.iter().map(upto));
            before += half * RULE.w.iter().zip(own).map(|(w, v)| w * v).sum::<f64>();
        }
        out
    }

    /// The antiderivative whose mean is zero.
    pub fn antiderivative(&self, values: &[f64]) -> Vec<f64> {
        let mut out = self.integral(values);
        let mean = out.iter().zip(self.weights()).map(|(v, w)| v * w).sum::<f64>() / TAU;
        out.iter_mut().for_each(|v| *v -= mean);
        out
    }

    /// (1/π) ∫ f cos kθ dθ and (1/π) ∫ f sin kθ dθ.
    pub fn harmonic(&self, values: &[f64], k: usize) -> (f64, f64) {
        let mut sum = (0.0, 0.0);
        for ((x, w), v) in self.nodes().iter().zip(self.weights()).zip(values) {
            let (s, c) = elementary::sin_cos(k as f64 * x);
            sum = (sum.0 + w * v * c, sum.1 + w * v * s);
        }
        (sum.0 / PI, sum.1 / PI)
    }
}

/// A function of the phase θ as a tape, with the guards of its switches.
#[derive(Clone, Debug)]
pub struct Shape {
    tape: Arc<Tape>,
    /// Parameters that it depends on.
    pub parameters: Vec<usize>,
    /// Its period and its Fourier coefficients for the parameters as they are.
    pub wave: Wave,
}

/// A periodic function: mean + Σ cos_k cos kθ + sin_k sin kθ.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Wave {
    /// The mean over a period.
    pub mean: f64,
    /// cos_1 ...; [`LISTED`] of them.
    pub cos: Vec<f64>,
    /// sin_1 ...
    pub sin: Vec<f64>,
    /// Where its panels end.
    pub panels: Panels,
}

impl Shape {
    /// Lowers a function of the phase, for which `phase` stands.
    ///
    /// *Errors*: a symbol without a meaning, a formula without a value somewhere in the period.
    pub fn new(graph: &mut Graph, shape: Expr, phase: SymbolId, inputs: &Inputs, values: &[f64]) -> Result<Shape, Fault> {
        let mut roots = vec![("shape".to_owned(), shape)];
        roots.extend(guards(graph, shape, phase).into_iter().map(|g| ("guard".to_owned(), g)));
        let inputs = Inputs { time: Some(phase), ..inputs.clone() };
        let tape = Arc::new(lower::expressions(graph, "waveform", &inputs, &roots)?);
        let mut open = graph.symbols_in(&[shape]);
        let mut parameters = Vec::new();
        while let Some(symbol) = open.pop() {
            if let Some(i) = inputs.parameters.iter().position(|p| *p == symbol) {
                parameters.push(i);
            } else if let Some((_, formula)) = inputs.definitions.iter().find(|(s, _)| *s == symbol) {
                open.extend(graph.symbols_in(&[*formula]));
            }
        }
        let mut found = Shape { tape, parameters, wave: Wave::default() };
        found.bind(values)?;
        Ok(found)
    }

    /// Takes other numbers for the parameters.
    ///
    /// *Errors*: a formula without a value somewhere in the period.
    pub fn bind(&mut self, values: &[f64]) -> Result<(), Fault> {
        let panels = self.panels(values)?;
        let values = self.values(values, &panels.nodes())?;
        let mean = values.iter().zip(panels.weights()).map(|(v, w)| v * w).sum::<f64>() / TAU;
        let list: Vec<(f64, f64)> = (1..=LISTED).map(|k| panels.harmonic(&values, k)).collect();
        // of a coefficient that vanishes rounding is left
        let largest = values.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
        // some ten units of the last place of the values
        let tidy = |v: f64| if v.abs() <= 1e-14 * largest { 0.0 } else { v };
        let (cos, sin) = (list.iter().map(|c| tidy(c.0)).collect(), list.iter().map(|c| tidy(c.1)).collect());
        self.wave = Wave { mean: tidy(mean), cos, sin, panels };
        Ok(())
    }

    /// The function at phases.
    ///
    /// *Errors*: no finite value there.
    pub fn values(&self, parameters: &[f64], phases: &[f64]) -> Result<Vec<f64>, Fault> {
        let mut evaluator = Evaluator::new(&self.tape, parameters)?;
        let (states, accelerations) = self.still();
        let mut at = |theta: f64| -> Result<f64, Fault> {
            let point = Point { time: theta.rem_euclid(TAU), states: &states, accelerations: &accelerations, ..Point::default() };
            Ok(evaluator.evaluate(&point)?[0])
        };
        phases.iter().map(|theta| at(*theta)).collect()
    }

    /// States and accelerations that it does not depend on.
    fn still(&self) -> (Vec<f64>, Vec<f64>) {
        (vec![0.0; self.tape.shape.states], vec![0.0; self.tape.shape.accelerations])
    }

    fn panels(&self, parameters: &[f64]) -> Result<Panels, Fault> {
        let mut evaluator = Evaluator::new(&self.tape, parameters)?;
        let (states, accelerations) = self.still();
        let roots = self.tape.roots.len();
        let mut at = |root: usize, theta: f64| -> Result<f64, Fault> {
            let point = Point { time: theta, states: &states, accelerations: &accelerations, ..Point::default() };
            Ok(evaluator.evaluate(&point)?[root])
        };
        let mut edges = Vec::new();
        for guard in 1..roots {
            edges.extend(zeros(&mut |theta| at(guard, theta))?);
        }
        let mut open = Panels::new(edges, TAU / FIRST as f64).edges.windows(2).map(|p| [p[0], p[1]]).collect::<Vec<_>>();
        let mut done = Vec::new();
        while let Some([a, b]) = open.pop() {
            let values: Vec<f64> = RULE.x.iter().map(|x| at(0, 0.5 * (a + b) + 0.5 * (b - a) * x)).collect::<Result<_, _>>()?;
            let c = RULE.coefficients(&values);
            let largest = values.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
            let resolved = c[NODES - 3..].iter().all(|c| c.abs() <= RESOLVED * largest);
            if resolved || b - a <= 1e4 * SHORTEST || done.len() + open.len() > 20_000 {
                done.push(a);
            } else {
                let middle = 0.5 * (a + b);
                open.extend([[middle, b], [a, middle]]);
            }
        }
        Ok(Panels::new(done, TAU))
    }
}

/// Where a function of the phase changes its sign: between instants close together, and at least values that dip through zero between them.
fn zeros(f: &mut dyn FnMut(f64) -> Result<f64, Fault>) -> Result<Vec<f64>, Fault> {
    let place = |k: usize| TAU * k as f64 / LOOKS as f64;
    let values: Vec<f64> = (0..=LOOKS).map(|k| f(place(k))).collect::<Result<_, _>>()?;
    let mut found = Vec::new();
    for k in 0..LOOKS {
        let [a, b] = [values[k], values[k + 1]];
        if a == 0.0 {
            found.push(place(k));
        } else if a * b < 0.0 {
            found.push(bisect(f, [place(k), place(k + 1)], a)?);
        } else if k > 0 && a.abs() < values[k - 1].abs() && a.abs() <= b.abs() {
            let (mut low, mut high) = (place(k - 1), place(k + 1));
            for _ in 0..60 {
                let (x, y) = (low + 0.382 * (high - low), low + 0.618 * (high - low));
                if f(x)?.abs() < f(y)?.abs() { high = y } else { low = x }
            }
            let dip = 0.5 * (low + high);
            if f(dip)? * a < 0.0 {
                found.extend([bisect(f, [place(k - 1), dip], values[k - 1])?, bisect(f, [dip, place(k + 1)], -a)?]);
            }
        }
    }
    Ok(found)
}

fn bisect(f: &mut dyn FnMut(f64) -> Result<f64, Fault>, [mut a, mut b]: [f64; 2], at_a: f64) -> Result<f64, Fault> {
    for _ in 0..100 {
        let middle = 0.5 * (a + b);
        if middle <= a || middle >= b {
            break;
        }
        if f(middle)? * at_a > 0.0 { a = middle } else { b = middle }
    }
    Ok(0.5 * (a + b))
}

/// What decides the switches of a function of the phase.
fn guards(graph: &mut Graph, shape: Expr, phase: SymbolId) -> Vec<Expr> {
    let mut found = Vec::new();
    for e in graph.reachable(&[shape]) {
        let guard = match graph.node(e).clone() {
            Node::Switch { guard, .. } => guard,
            Node::Call { function: Function::Abs | Function::Sign, arguments } => arguments[0],
            Node::Call { function: Function::Min | Function::Max, arguments } => graph.sub(arguments[0], arguments[1]),
            _ => continue,
        };
        if graph.contains(guard, |s| s == phase) && !found.contains(&guard) {
            found.push(guard);
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nodes_integrate_and_antiderivatives_return() {
        let panels = Panels::new(vec![1.0], 0.5);
        let values: Vec<f64> = panels.nodes().iter().map(|x| (3.0 * x).cos()).collect();
        let (c, s) = panels.harmonic(&values, 3);
        // sums of a few dozen terms
        assert!((c - 1.0).abs() < 1e-14 && s.abs() < 1e-14);
        let twice = panels.antiderivative(&panels.antiderivative(&values));
        let worst = twice.iter().zip(&values).fold(0.0_f64, |m, (a, v)| m.max((a + v / 9.0).abs()));
        // units of the last place
        assert!(worst < 1e-15, "{worst}");
    }
}
