//! Equations of motion into the tapes of a [`Program`].

use super::expressions::{GuardTable, Inputs, Lowering, Switches};
use crate::{ENERGY, Fault, Program, Register, Root, Tape};
use std::collections::HashSet;
use std::sync::Arc;
use symbolic::{Derivation, Equations, Expr, Graph, Substitution, SymbolId};

/// Lowers equations of motion.
///
/// M q'' = h stays implicit: the dynamics solve it by one [`crate::Operation::Solve`].
///
/// *Errors*: P010 for a symbol without a meaning at its place, P011 for cyclic definitions, P012 for sizes that do not match.
pub fn equations(equations: &Equations) -> Result<Program, Fault> {
    check(equations)?;
    let names = Names::new(equations);
    let (dynamics, guards) = dynamics(equations, &names)?;
    let outputs = equations.outputs.iter().map(|o| (o.name.clone(), o.formula)).collect();
    Ok(Program {
        coordinates: equations.coordinates.len(),
        auxiliaries: equations.auxiliaries.len(),
        states: names.states.clone(),
        parameters: equations.parameters.iter().map(|p| names.of(p.symbol)).collect(),
        values: equations.parameters.iter().map(|p| p.value).collect(),
        dynamics: Arc::new(dynamics),
        outputs: Arc::new(observed(equations, &guards, "outputs", outputs)?),
        energy: Arc::new(observed(equations, &guards, "energy", energy(equations))?),
        second: Arc::new(second(equations)?),
        places: Arc::new(places(equations)?),
        statics: Arc::new(statics(equations, &names)?),
        start: Arc::new(start(equations, &names)?),
        guards: guards.guards,
    })
}

/// Names of symbols as users write them.
struct Names<'e> {
    equations: &'e Equations,
    states: Vec<String>,
}

impl<'e> Names<'e> {
    fn new(equations: &'e Equations) -> Names<'e> {
        let mut names = Names { equations, states: Vec::new() };
        names.states = state_symbols(equations).iter().map(|s| names.of(*s)).collect();
        names
    }
    fn of(&self, s: SymbolId) -> String {
        let symbol = self.equations.graph.symbol_info(s);
        format!("{}{}", symbol.name, "'".repeat(usize::from(symbol.primes)))
    }
    /// Name of the rate of state `i`.
    fn rate(&self, i: usize) -> String {
        format!("{}'", self.states[i])
    }
}

fn check(equations: &Equations) -> Result<(), Fault> {
    let n = equations.coordinates.len();
    let sizes = [equations.mass.rows(), equations.mass.columns(), equations.force.len()];
    if sizes == [n; 3] {
        return Ok(());
    }
    Err(Fault::about("P012", format!("n = {n}, M {} x {}, h {}", sizes[0], sizes[1], sizes[2])))
}

/// q, q', s.
fn state_symbols(equations: &Equations) -> Vec<SymbolId> {
    let coordinates = || equations.coordinates.iter();
    let q = coordinates().map(|c| c.symbols[0]);
    q.chain(coordinates().map(|c| c.symbols[1])).chain(equations.auxiliaries.iter().map(|a| a.symbol)).collect()
}

fn parameters_only(equations: &Equations) -> Inputs {
    Inputs {
        parameters: equations.parameters.iter().map(|p| p.symbol).collect(),
        definitions: equations.definitions.iter().map(|d| (d.symbol, d.formula)).collect(),
        ..Inputs::default()
    }
}

fn over_states(equations: &Equations) -> Inputs {
    Inputs { time: Some(equations.time), states: state_symbols(equations), ..parameters_only(equations) }
}

fn over_accelerations(equations: &Equations) -> Inputs {
    Inputs { accelerations: equations.coordinates.iter().map(|c| c.symbols[2]).collect(), ..over_states(equations) }
}

fn dynamics(equations: &Equations, names: &Names) -> Result<(Tape, GuardTable), Fault> {
    let n = equations.coordinates.len();
    let mut lowering = Lowering::new(&equations.graph, &over_states(equations), Switches::Collect);
    let mut matrix = Vec::with_capacity(n * (n + 1) / 2);
    for i in 0..n {
        for j in 0..=i {
            let entry = lowering.register(equations.mass.get(i, j))?;
            matrix.push((!lowering.is_zero(entry)).then_some(entry));
        }
    }
    let right = equations.force.iter().map(|h| lowering.register(*h)).collect::<Result<Vec<_>, _>>()?;
    let mut rates: Vec<Register> = (0..n).map(|i| lowering.state(n + i)).collect();
    if n > 0 {
        let first = lowering.solve(matrix, right);
        rates.extend((0..n).map(|i| Register(first.0 + i as u32)));
    }
    for auxiliary in &equations.auxiliaries {
        rates.push(lowering.register(auxiliary.rate)?);
    }
    let roots = rates.into_iter().enumerate().map(|(i, register)| Root { name: names.rate(i), register }).collect();
    lowering.finish("dynamics", roots)
}

/// A tape over t, x, q'' that takes the modes of the dynamics where it meets their guards.
fn observed(equations: &Equations, guards: &GuardTable, name: &str, roots: Vec<(String, Expr)>) -> Result<Tape, Fault> {
    Lowering::new(&equations.graph, &over_accelerations(equations), Switches::Known(guards)).tape(name, &roots)
}

fn energy(equations: &Equations) -> Vec<(String, Expr)> {
    let e = &equations.energy;
    let formulas = [e.kinetic, e.potential, e.dissipation, e.dissipated, e.rate, e.loads, e.drives];
    ENERGY.iter().map(|n| (*n).to_owned()).zip(formulas).collect()
}

/// Residuals of the second derivation, then M q'' - h.
fn second(equations: &Equations) -> Result<Tape, Fault> {
    let n = equations.coordinates.len();
    let mut lowering = Lowering::new(&equations.graph, &over_accelerations(equations), Switches::Value);
    let mut roots = Vec::with_capacity(2 * n);
    for (i, e) in equations.second.iter().enumerate() {
        roots.push(Root { name: format!("second {}", i + 1), register: lowering.register(*e)? });
    }
    for i in 0..n {
        let entries: Vec<Expr> = (0..n).map(|j| equations.mass.get(i.max(j), i.min(j))).collect();
        let register = lowering.residual(&entries, equations.force[i])?;
        roots.push(Root { name: format!("first {}", i + 1), register });
    }
    Ok(lowering.finish("second", roots)?.0)
}

/// What must exist wherever the machine goes.
fn places(equations: &Equations) -> Result<Tape, Fault> {
    let roots: Vec<(String, Expr)> = equations.places.iter().enumerate().map(|(i, e)| (format!("position {}", i + 1), *e)).collect();
    Lowering::new(&equations.graph, &over_accelerations(equations), Switches::Value).tape("places", &roots)
}

/// h(q, 0, s, t) and ∂h/∂q. Rates are replaced by zero before differentiation, which leaves little of most systems.
fn statics(equations: &Equations, names: &Names) -> Result<Tape, Fault> {
    let mut graph = equations.graph.clone();
    let zero = graph.zero();
    let mut rest = Substitution::new(equations.coordinates.iter().map(|c| (c.symbols[1], zero)));
    let force: Vec<Expr> = equations.force.iter().map(|h| rest.apply(&mut graph, *h)).collect();
    let definitions: Vec<(SymbolId, Expr)> = equations.definitions.iter().map(|d| (d.symbol, rest.apply(&mut graph, d.formula))).collect();
    let moving = over_coordinates(equations, &graph, &definitions);

    let mut roots: Vec<(String, Expr)> = names.states.iter().map(|s| format!("h {s}")).zip(force.iter().copied()).collect();
    let mut columns = Vec::with_capacity(force.len());
    for coordinate in &equations.coordinates {
        let mut derivation = chain_rule(&mut graph, coordinate.symbols[0], &moving);
        columns.push(force.iter().map(|h| derivation.apply(&mut graph, *h)).collect::<Vec<_>>());
    }
    for i in 0..force.len() {
        for (j, column) in columns.iter().enumerate() {
            roots.push((format!("dh {}/d {}", names.states[i], names.states[j]), column[i]));
        }
    }
    let inputs = Inputs { definitions, ..over_states(equations) };
    Lowering::new(&graph, &inputs, Switches::Value).tape("statics", &roots)
}

/// The definitions that depend on a coordinate, directly or through earlier ones.
fn over_coordinates(equations: &Equations, graph: &Graph, definitions: &[(SymbolId, Expr)]) -> Vec<(SymbolId, Expr)> {
    let mut varying: HashSet<SymbolId> = equations.coordinates.iter().map(|c| c.symbols[0]).collect();
    let mut moving = Vec::new();
    for (symbol, formula) in definitions {
        if graph.contains(*formula, |s| varying.contains(&s)) {
            varying.insert(*symbol);
            moving.push((*symbol, *formula));
        }
    }
    moving
}

/// ∂/∂symbol where definitions are functions of it: D d is the derivative of its formula, earlier definitions first.
fn chain_rule(graph: &mut Graph, symbol: SymbolId, definitions: &[(SymbolId, Expr)]) -> Derivation {
    let mut seeds = vec![(symbol, graph.one())];
    for (definition, formula) in definitions {
        let inner = Derivation::new(seeds.iter().copied()).apply(graph, *formula);
        if !graph.is_zero(inner) {
            seeds.push((*definition, inner));
        }
    }
    Derivation::new(seeds)
}

/// x at the start, over parameters.
fn start(equations: &Equations, names: &Names) -> Result<Tape, Fault> {
    let coordinates = || equations.coordinates.iter();
    let formulas = coordinates().map(|c| c.start).chain(coordinates().map(|c| c.rate)).chain(equations.auxiliaries.iter().map(|a| a.start));
    let roots: Vec<(String, Expr)> = names.states.iter().cloned().zip(formulas).collect();
    Lowering::new(&equations.graph, &parameters_only(equations), Switches::Value).tape("start", &roots)
}
