//! The equations of a machine for averaging: residuals of all coordinates and their derivatives, as formulas.

use crate::machine::Machine;
use analysis::studies::average::{Instant, Place, Turning};
use mechanics::asked::Named;
use symbolic::{Equations, Expr, Graph, SymbolId};
use words::{Notice, Text};

/// Instants of a turn at which it is looked whether auxiliary states matter.
const LOOKED: usize = 7;
/// Difference of what repeats after a turn, as a share of the largest value.
const ROUNDING: f64 = 1e-9;

/// M q'' - h of a machine with its numbers.
#[derive(Clone, Debug)]
pub(super) struct Formulas {
    graph: Graph,
    /// q, q', q'' of the rest.
    rest: Vec<[SymbolId; 3]>,
    /// φ, φ', φ''.
    angle: [SymbolId; 3],
    time: SymbolId,
    /// Residuals of the rest and of the angle, M_φφ, then the derivatives of the former.
    roots: Vec<Expr>,
    /// Nodes below the residuals, and those below all, that change with the turn, operands first.
    order: [Vec<Expr>; 2],
    /// Values of the nodes in which numbers alone occur.
    constants: Vec<f64>,
    /// Numbers of the parameters.
    numbers: Vec<f64>,
    /// Symbols of the equations of the rest.
    of_rest: Vec<SymbolId>,
    /// The instant at which formulas of time stand, s.
    instant: f64,
    /// q'' of the angle is 0 here, auxiliary states too: they must not matter.
    auxiliaries: Vec<SymbolId>,
}

impl Formulas {
    /// *Errors*: S161.
    pub(super) fn of(machine: &Machine, angle: &Named, instant: f64) -> Result<Formulas, Notice> {
        let equations = &machine.equations;
        let Some(own) = equations.coordinates.iter().position(|c| c.symbols[0] == angle.symbol) else {
            return Err(refused(("the angle is none of the coordinates", "угол не входит в число координат")));
        };
        if !equations.conditions.is_empty() {
            return Err(refused((
                "connections, contacts or dry friction tie its coordinates",
                "координаты связаны соединениями, контактами или сухим трением",
            )));
        }
        let mut graph = equations.graph.clone();
        let n = equations.coordinates.len();
        let rest: Vec<[SymbolId; 3]> = (0..n).filter(|i| *i != own).map(|i| equations.coordinates[i].symbols).collect();
        let symbols = equations.coordinates[own].symbols;
        let roots = roots(equations, own, &mut graph);
        // of the angle's own equation and its inertia the answers of the rest do not depend
        let answered: Vec<Expr> = roots.iter().enumerate().filter(|(k, _)| *k != n - 1 && *k != n).map(|(_, e)| *e).collect();
        let of_rest = graph.symbols_in(&answered);
        let auxiliaries: Vec<SymbolId> = equations.auxiliaries.iter().map(|a| a.symbol).collect();
        let moving: Vec<SymbolId> = rest.iter().chain([&symbols]).flatten().chain(&auxiliaries).copied().collect();
        let order = [&roots[..n], &roots[..]].map(|roots| changing(&graph, roots, &moving));
        let mut formulas = Formulas {
            graph,
            rest,
            angle: symbols,
            time: equations.time,
            roots,
            order,
            constants: Vec::new(),
            numbers: Vec::new(),
            of_rest,
            instant,
            auxiliaries,
        };
        formulas.put(equations);
        if formulas.depends_on_clocks() {
            return Err(refused((
                "another rotation (an unbalanced rotor with a speed of its own) acts on it besides the angle",
                "кроме этого угла на неё действует другое вращение (неуравновешенный ротор со своей скоростью)",
            )));
        }
        if !formulas.repeats() {
            return Err(refused((
                "its equations are not the same after a turn of the angle",
                "через оборот этого угла её уравнения другие",
            )));
        }
        Ok(formulas)
    }

    /// Whether the equations are the same a turn further, where angles are rounded.
    fn repeats(&self) -> bool {
        let still = vec![0.0; self.rest.len()];
        let at =
            |angle: f64| self.values(&Place { angle, speed: 1.0, values: &still, rates: &still, accelerations: &still }, 0.0, &self.roots);
        (0..LOOKED).all(|k| {
            let (here, there) = (at(k as f64), at(k as f64 + std::f64::consts::TAU));
            let largest = here.iter().fold(0.0_f64, |l, v| l.max(v.abs()));
            here.iter().zip(&there).all(|(a, b)| (a - b).abs() <= ROUNDING * largest)
        })
    }

    /// Takes over the numbers of the parameters.
    pub(super) fn put(&mut self, equations: &Equations) {
        self.numbers = vec![0.0; self.graph.symbol_count()];
        equations.parameters.iter().for_each(|p| self.numbers[p.symbol.index()] = p.value);
        self.numbers[self.time.index()] = self.instant;
        // what moves stands at 0 here and is put in at each place
        let mut known = vec![0.0; self.graph.len()];
        for e in self.graph.reachable(&self.roots) {
            known[e.index()] = self.graph.evaluate_node(e, &|s| self.numbers[s.index()], &|c| known[c.index()]);
        }
        self.constants = known;
    }

    /// The numbers in the equations of the rest: where they are the same, its answers are.
    pub(super) fn basis(&self) -> Vec<f64> {
        self.of_rest.iter().map(|symbol| self.numbers[symbol.index()]).collect()
    }

    /// Whether a residual changes with an auxiliary state.
    fn depends_on_clocks(&self) -> bool {
        let still = vec![0.0; self.rest.len()];
        let at = |k: usize, clock: f64| {
            let angle = std::f64::consts::TAU * k as f64 / LOOKED as f64;
            self.values(&Place { angle, speed: 1.0, values: &still, rates: &still, accelerations: &still }, clock, &self.roots)
        };
        (0..LOOKED).any(|k| {
            let before = at(k, 0.0);
            [1.0, 2.3].iter().any(|clock| at(k, *clock)[..=self.rest.len()] != before[..=self.rest.len()])
        })
    }

    /// The first of the roots, or all.
    fn values(&self, place: &Place<'_>, clock: f64, roots: &[Expr]) -> Vec<f64> {
        let mut numbers = self.numbers.clone();
        let mut set = |symbol: SymbolId, value: f64| numbers[symbol.index()] = value;
        set(self.angle[0], place.angle);
        set(self.angle[1], place.speed);
        set(self.angle[2], 0.0);
        self.auxiliaries.iter().for_each(|symbol| set(*symbol, clock));
        for (i, symbols) in self.rest.iter().enumerate() {
            set(symbols[0], place.values[i]);
            set(symbols[1], place.rates[i]);
            set(symbols[2], place.accelerations[i]);
        }
        let mut known = self.constants.clone();
        let value = |s: SymbolId| numbers[s.index()];
        for e in &self.order[usize::from(roots.len() > self.rest.len() + 1)] {
            known[e.index()] = self.graph.evaluate_node(*e, &value, &|c| known[c.index()]);
        }
        roots.iter().map(|e| known[e.index()]).collect()
    }
}

impl Turning for Formulas {
    fn others(&self) -> usize {
        self.rest.len()
    }
    fn at(&self, place: &Place<'_>) -> Instant {
        let all = self.values(place, 0.0, &self.roots);
        let n = self.rest.len() + 1;
        Instant { residuals: all[..n].to_vec(), inertia: all[n], slopes: all[n + 1..].to_vec() }
    }
    fn residuals(&self, place: &Place<'_>) -> Vec<f64> {
        self.values(place, 0.0, &self.roots[..=self.rest.len()])
    }
}

/// Residuals of the rest and of the angle, M_φφ, then the derivatives of the former by q, q', q''.
fn roots(equations: &Equations, own: usize, graph: &mut Graph) -> Vec<Expr> {
    let n = equations.coordinates.len();
    let order: Vec<usize> = (0..n).filter(|i| *i != own).chain([own]).collect();
    let residual = |i: usize, graph: &mut Graph| {
        let mut terms = Vec::with_capacity(n + 1);
        for j in 0..n {
            let (mass, acceleration) = (equations.mass.get(i, j), graph.symbol(equations.coordinates[j].symbols[2]));
            terms.push(graph.mul(mass, acceleration));
        }
        let force = graph.neg(equations.force[i]);
        terms.push(force);
        let sum = graph.sum(&terms);
        equations.inlined(graph, sum)
    };
    let mut roots: Vec<Expr> = order.iter().map(|i| residual(*i, graph)).collect();
    let rest: Vec<[SymbolId; 3]> = order[..n - 1].iter().map(|i| equations.coordinates[*i].symbols).collect();
    let symbols = equations.coordinates[own].symbols;
    let inertia = graph.derivative(roots[n - 1], symbols[2]);
    roots.push(inertia);
    for (i, which) in (0..n - 1).flat_map(|i| (0..3).map(move |which| (i, which))) {
        for other in &rest {
            let slope = graph.derivative(roots[i], other[which]);
            roots.push(slope);
        }
    }
    roots
}

/// The nodes below these that change with the turn, operands first.
fn changing(graph: &Graph, roots: &[Expr], moving: &[SymbolId]) -> Vec<Expr> {
    let mut moves = vec![false; graph.len()];
    let mut below = graph.reachable(roots);
    for e in &below {
        let mut any = graph.as_symbol(*e).is_some_and(|symbol| moving.contains(&symbol));
        graph.for_each_child(*e, |child| any |= moves[child.index()]);
        moves[e.index()] = any;
    }
    below.retain(|e| moves[e.index()]);
    below
}

/// S161.
pub(super) fn refused(why: (&str, &str)) -> Notice {
    Notice::new("S161", "the machine cannot be averaged over this angle", "осреднить машину по этому углу нельзя")
        .because(Text::new(why.0, why.1))
        .help(
            "name an angle that turns freely, of a machine without connections: --angle phi",
            "назовите свободно вращающийся угол машины без связей: --angle phi",
        )
}
