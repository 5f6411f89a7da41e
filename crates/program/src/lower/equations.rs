//! Equations of motion into the tapes of a [`Program`].

use super::arrangement::{Arrangement, Selection};
use super::connections::{Connected, supports};
use super::expressions::{GuardTable, Inputs, Lowering, Switches};
use super::guards::{fill, reserve, surfaces};
use super::inputs::{over_accelerations, over_reactions, over_states, parameters_only, state_symbols};
use super::numbers::Numbers;
use super::steps::steps;
use crate::fault::POSITION;
use crate::passes::select;
use crate::{ENERGY, Fault, Program, Register, Root, Tape};
use std::borrow::Cow;
use std::collections::HashSet;
use std::sync::Arc;
use symbolic::connections::{Friction, Law};
use symbolic::{Derivation, Edge, Equations, Expr, Graph, Substitution, SymbolId};

/// Lowers equations of motion in which all connections take part.
///
/// Without connections M q'' = h stays implicit: the dynamics solve it by one [`crate::Operation::Solve`].
///
/// *Errors*: see [`equations_with`].
pub fn equations(equations: &Equations) -> Result<Program, Fault> {
    equations_with(equations, &Selection::all(equations))
}

/// Lowers equations of motion with the connections that take part.
///
/// *Errors*: P010 for a symbol without a meaning at its place, P011 for cyclic definitions, P012 for sizes that do not match (as many conditions as
/// reactions other than supports, as many balances as supports), P014 for a friction pressed by a reaction that takes no part.
pub fn equations_with(equations: &Equations, selection: &Selection) -> Result<Program, Fault> {
    check(equations)?;
    let names = Names::new(equations);
    let arrangement = Arrangement::new(equations, selection)?;
    let (dynamics, guards) = dynamics(equations, &names, &arrangement)?;
    let outputs = equations.outputs.iter().map(|o| (o.name.clone(), o.formula)).collect();
    // large machines without connections are not to pay for them
    let connected = !(equations.conditions.is_empty() && equations.reactions.is_empty());
    let unknowns: Vec<String> =
        names.accelerations().chain(arrangement.solved.iter().map(|r| equations.reactions[*r].name.clone())).collect();
    Ok(Program {
        coordinates: equations.coordinates.len(),
        auxiliaries: equations.auxiliaries.len(),
        states: names.states.clone(),
        parameters: equations.parameters.iter().map(|p| names.of(p.symbol)).collect(),
        values: equations.parameters.iter().map(|p| p.value).collect(),
        conditions: equations.conditions.len(),
        contacts: contacts(equations).count(),
        reactions: equations.reactions.len(),
        known: known(&arrangement),
        rows: arrangement.rows(equations, &unknowns),
        unknowns,
        forces: Arc::new(forces(equations, &names, &arrangement, &dynamics, &guards)?),
        dynamics: Arc::new(dynamics),
        outputs: Arc::new(observed(equations, &guards, "outputs", outputs)?),
        energy: Arc::new(energy(equations, &guards)?),
        touches: Arc::new(super::touches::touches(equations, &guards)?),
        second: Arc::new(second(equations, &guards)?),
        released: Arc::new(released(equations)?),
        places: Arc::new(places(equations)?),
        statics: Arc::new(statics(equations, &names)?),
        connections: Arc::new(if connected { connections(equations, &names, &guards)? } else { nothing(equations, "connections")? }),
        laws: Arc::new(laws(equations, arrangement.kept())?),
        balances: Arc::new(balances(equations)?),
        start: Arc::new(start(equations, &names)?),
        switches: guards.numbers.iter().map(|n| n.map(|n| n.switch())).collect(),
        guards: guards.guards,
        frictions: frictions(equations).count(),
        joined: arrangement.joined.clone(),
        balanced: arrangement.kept().to_vec(),
        hidden: arrangement.hidden(equations),
        steps: steps(equations).is_some(),
        repeated: arrangement.spare.as_ref().map_or(0, |spare| spare.count as usize),
        solved: arrangement.solved,
    })
}

/// A tape without roots.
fn nothing(equations: &Equations, name: &str) -> Result<Tape, Fault> {
    Lowering::new(&equations.graph, &over_states(equations), Switches::Value).tape(name, &[])
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
    /// Names of q''.
    fn accelerations(&self) -> impl Iterator<Item = String> + '_ {
        let n = self.equations.coordinates.len();
        (n..2 * n).map(|i| self.rate(i))
    }
    /// `{letter} x/d y` for all pairs of coordinates.
    fn by_coordinates(&self, letter: &str) -> impl Iterator<Item = String> + use<'_, 'e> {
        let (n, letter) = (self.equations.coordinates.len(), letter.to_owned());
        (0..n * n).map(move |k| format!("{letter} {}/d {}", self.states[k / n], self.states[k % n]))
    }
    fn reaction(&self, r: usize) -> String {
        self.equations.reactions[r].name.clone()
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

/// Gap and restitutions, normal and tangential.
fn contacts(equations: &Equations) -> impl Iterator<Item = (Expr, [Expr; 2])> + '_ {
    equations.reactions.iter().filter_map(|r| match &r.law {
        Law::Contact { gap, restitution, tangential, .. } => Some((*gap, [*restitution, *tangential])),
        _ => None,
    })
}

fn frictions(equations: &Equations) -> impl Iterator<Item = &Friction> + '_ {
    equations.reactions.iter().filter_map(|r| match &r.law {
        Law::Friction(friction) => Some(&**friction),
        _ => None,
    })
}

/// Reactions that have values.
fn known(arrangement: &Arrangement) -> Vec<usize> {
    let mut known = [&arrangement.solved[..], &arrangement.supports[..]].concat();
    known.sort_unstable();
    known
}

fn dynamics(equations: &Equations, names: &Names, arrangement: &Arrangement) -> Result<(Tape, GuardTable), Fault> {
    let n = equations.coordinates.len();
    let steps = steps(equations);
    let graph = steps.as_ref().map_or(&equations.graph, |(graph, _)| graph);
    let mut lowering = Lowering::new(graph, &over_states(equations), Switches::Collect);
    let numbers = reserve(&mut lowering, equations, arrangement)?;
    let first = solution(&mut lowering, equations, arrangement, &numbers)?;
    let solved = |i: usize| Register(first.map_or(0, |f| f.0) + i as u32);
    let mut rates: Vec<Register> = (0..n).map(|i| lowering.state(n + i)).collect();
    rates.extend((0..n).map(solved));
    for auxiliary in &equations.auxiliaries {
        rates.push(lowering.register(auxiliary.rate)?);
    }
    if let Some(first) = first {
        fill(&mut lowering, equations, arrangement, &numbers, first)?;
    }
    let mut roots: Vec<Root> = rates.into_iter().enumerate().map(|(i, register)| Root { name: names.rate(i), register }).collect();
    for (i, r) in arrangement.solved.iter().enumerate() {
        roots.push(Root { name: names.reaction(*r), register: solved(n + i) });
    }
    for (i, e) in steps.iter().flat_map(|(_, list)| list.iter().enumerate()) {
        roots.push(Root { name: format!("prescribed velocity {}", i + 1), register: lowering.register(*e)? });
    }
    lowering.table.numbers = numbers;
    lowering.finish("dynamics", roots)
}

/// First register of q'' and the solved reactions; none without coordinates.
fn solution(
    lowering: &mut Lowering,
    equations: &Equations,
    arrangement: &Arrangement,
    numbers: &[Option<Numbers>],
) -> Result<Option<Register>, Fault> {
    let n = equations.coordinates.len();
    if !arrangement.is_free() {
        return Connected::new(lowering, equations, arrangement).solve(numbers);
    }
    let mut matrix = Vec::with_capacity(n * (n + 1) / 2);
    for i in 0..n {
        for j in 0..=i {
            let entry = lowering.register(equations.mass.get(i, j))?;
            matrix.push((!lowering.is_zero(entry)).then_some(entry));
        }
    }
    let right = equations.force.iter().map(|h| lowering.register(*h)).collect::<Result<Vec<_>, _>>()?;
    Ok((n > 0).then(|| lowering.solve(matrix, right)))
}

/// q'' and all reactions that have values: the system of the dynamics once more, then that of the supports. Without the latter the dynamics themselves.
fn forces(equations: &Equations, names: &Names, arrangement: &Arrangement, dynamics: &Tape, guards: &GuardTable) -> Result<Tape, Fault> {
    let n = equations.coordinates.len();
    if arrangement.supports.is_empty() {
        let states = names.states.len();
        let roots: Vec<usize> = (n..2 * n).chain(states..states + arrangement.solved.len()).collect();
        return Ok(Tape { name: "forces".to_owned(), ..select(dynamics, &roots) });
    }
    let mut lowering = Lowering::new(&equations.graph, &over_states(equations), Switches::Known(guards));
    surfaces(&mut lowering, equations, &guards.numbers)?;
    let first = solution(&mut lowering, equations, arrangement, &guards.numbers)?;
    let supports = supports(&mut lowering, equations, arrangement, first)?;
    let at = |first: Option<Register>, i: usize| Register(first.map_or(0, |f| f.0) + i as u32);
    let mut roots: Vec<Root> = names.accelerations().enumerate().map(|(i, name)| Root { name, register: at(first, i) }).collect();
    for r in known(arrangement) {
        let register = match arrangement.solved.iter().position(|s| *s == r) {
            Some(i) => at(first, n + i),
            None => at(supports, arrangement.supports.iter().position(|s| *s == r).unwrap_or(0)),
        };
        roots.push(Root { name: names.reaction(r), register });
    }
    Ok(lowering.finish("forces", roots)?.0)
}

/// Values and derivatives of all conditions, M, gaps, restitutions, forces: see [`crate::ConnectionRoots`].
fn connections(equations: &Equations, names: &Names, guards: &GuardTable) -> Result<Tape, Fault> {
    let (graph, zero) = equations.graph.with_zero();
    let n = equations.coordinates.len();
    let conditions = || equations.conditions.iter();
    let name = |kind: &str, c: &symbolic::connections::Condition| format!("{kind} {}", c.name.en);
    let mut roots: Vec<(String, Expr)> = conditions().map(|c| (name("place", c), c.place.unwrap_or(zero))).collect();
    roots.extend(conditions().map(|c| (name("rate", c), c.rate)));
    for c in conditions() {
        roots.extend(sparse(&c.columns, n, zero).into_iter().zip(&names.states).map(|(e, q)| (format!("{} by {q}", name("rate", c)), e)));
    }
    for i in 0..n {
        roots.extend((0..=i).map(|j| (format!("mass {} {}", i + 1, j + 1), equations.mass.get(i, j))));
    }
    roots.extend(contacts(equations).map(|c| ("gap".to_owned(), c.0)));
    roots.extend(contacts(equations).flat_map(|c| c.1.map(|e| ("restitution".to_owned(), e))));
    for r in &equations.reactions {
        roots.extend(sparse(&r.forces, n, zero).into_iter().zip(&names.states).map(|(e, q)| (format!("{} on {q}", r.name), e)));
    }
    Lowering::new(&graph, &over_states(equations), Switches::Known(guards)).tape("connections", &roots)
}

/// Laws of friction in an impact: see [`crate::LawRoots`].
fn laws(equations: &Equations, balances: &[usize]) -> Result<Tape, Fault> {
    if balances.is_empty() && frictions(equations).next().is_none() {
        return nothing(equations, "laws");
    }
    let mut graph = equations.graph.clone();
    let (zero, n) = (graph.zero(), equations.coordinates.len());
    let mut roots: Vec<(String, Expr)> = Vec::new();
    let count = equations.reactions.len();
    for friction in frictions(equations) {
        let [back, forth] = friction.kinetic;
        let kinetic = graph.switch(friction.sliding, Edge::Closed, forth, back);
        roots.extend([kinetic, friction.fixed].map(|e| ("law of friction".to_owned(), e)));
        for normal in [&friction.normal, &friction.across] {
            let terms = normal.as_ref().map_or(&[][..], |n| &n.terms);
            roots.extend(sparse(terms, count, zero).into_iter().map(|e| ("normal force".to_owned(), e)));
        }
    }
    for &b in balances {
        let balance = &equations.balances[b];
        roots.extend(sparse(&balance.columns, n, zero).into_iter().map(|e| (format!("inertia in {}", balance.name.en), e)));
        for r in &equations.reactions {
            let entry = r.released.iter().find(|(k, _)| *k == b).map_or(zero, |(_, e)| *e);
            roots.push((format!("{} in {}", r.name, balance.name.en), entry));
        }
        roots.push((format!("carried in {}", balance.name.en), balance.carried.unwrap_or(zero)));
    }
    Lowering::new(&graph, &over_states(equations), Switches::Value).tape("laws", &roots)
}

pub(super) fn sparse(entries: &[(usize, Expr)], length: usize, zero: Expr) -> Vec<Expr> {
    let mut row = vec![zero; length];
    for (i, e) in entries {
        row[*i] = *e;
    }
    row
}

/// Σ released, balances x reactions.
fn balances(equations: &Equations) -> Result<Tape, Fault> {
    let (graph, zero) = equations.graph.with_zero();
    let mut roots = Vec::with_capacity(equations.balances.len() * equations.reactions.len());
    for (b, balance) in equations.balances.iter().enumerate() {
        for r in &equations.reactions {
            let entry = r.released.iter().find(|(k, _)| *k == b).map_or(zero, |(_, e)| *e);
            roots.push((format!("{} in {}", r.name, balance.name.en), entry));
        }
    }
    Lowering::new(&graph, &over_states(equations), Switches::Value).tape("balances", &roots)
}

/// A tape over t, x, q'' that takes the modes of the dynamics where it meets their guards.
fn observed(equations: &Equations, guards: &GuardTable, name: &str, roots: Vec<(String, Expr)>) -> Result<Tape, Fault> {
    Lowering::new(&equations.graph, &over_reactions(equations), Switches::Known(guards)).tape(name, &roots)
}

/// The energies and powers, then the power that each dry friction takes: λ v, v its sliding speed.
fn energy(equations: &Equations, guards: &GuardTable) -> Result<Tape, Fault> {
    let e = &equations.energy;
    let formulas = [e.kinetic, e.potential, e.dissipation, e.dissipated, e.rate, e.loads, e.drives, e.through];
    let mut roots: Vec<(String, Expr)> = ENERGY.iter().map(|n| (*n).to_owned()).zip(formulas).collect();
    // large machines without frictions are not copied
    let mut graph = Cow::Borrowed(&equations.graph);
    for reaction in &equations.reactions {
        if let Law::Friction(friction) = &reaction.law {
            let graph = graph.to_mut();
            let force = graph.symbol(reaction.symbol);
            roots.push((format!("taken by {}", reaction.name), graph.mul(force, friction.sliding)));
        }
    }
    Lowering::new(&graph, &over_reactions(equations), Switches::Known(guards)).tape("energy", &roots)
}

/// Residuals of the second derivation, then those of the first: M q'' - Σ forces λ - h and Σ columns q'' - rest - Σ released λ.
fn second(equations: &Equations, guards: &GuardTable) -> Result<Tape, Fault> {
    let n = equations.coordinates.len();
    let mut lowering = Lowering::new(&equations.graph, &over_reactions(equations), Switches::Known(guards));
    let mut roots = Vec::with_capacity(2 * n);
    for (i, e) in equations.second.iter().enumerate() {
        roots.push(Root { name: format!("second {}", i + 1), register: lowering.register(*e)? });
    }
    for i in 0..n {
        let inertia: Vec<(usize, Expr)> = (0..n).map(|j| (j, equations.mass.get(i.max(j), i.min(j)))).collect();
        let loads = equations.reactions.iter().map(|r| &r.forces[..]);
        let register = residual(&mut lowering, (&inertia, equations.force[i]), n, loads, i)?;
        roots.push(Root { name: format!("first {}", i + 1), register });
    }
    for (i, balance) in equations.balances.iter().enumerate() {
        let loads = equations.reactions.iter().map(|r| &r.released[..]);
        let register = residual(&mut lowering, (&balance.columns, balance.rest), n, loads, i)?;
        roots.push(Root { name: format!("balance {}", i + 1), register });
    }
    Ok(lowering.finish("second", roots)?.0)
}

fn released(equations: &Equations) -> Result<Tape, Fault> {
    let (graph, zero) = equations.graph.with_zero();
    let list = equations.released.expressions(zero);
    let roots: Vec<(String, Expr)> = list.into_iter().enumerate().map(|(i, e)| (format!("released {}", i + 1), e)).collect();
    Lowering::new(&graph, &over_reactions(equations), Switches::Value).tape("released", &roots)
}

/// Σ inertia q'' - force - Σ load λ, with λ behind the n accelerations; loads are lists by row, of which `row` is taken.
fn residual<'e>(
    lowering: &mut Lowering,
    (inertia, force): (&[(usize, Expr)], Expr),
    n: usize,
    loads: impl Iterator<Item = &'e [(usize, Expr)]>,
    row: usize,
) -> Result<Register, Fault> {
    let mut items = Vec::with_capacity(inertia.len() + 1);
    let mut add = |lowering: &mut Lowering, sign: f64, factor: Expr, slot: usize| {
        let factor = lowering.value(factor)?;
        let input = lowering.acceleration(slot);
        items.push((sign, lowering.times(factor, input)));
        Ok::<(), Fault>(())
    };
    for (j, e) in inertia {
        add(lowering, 1.0, *e, *j)?;
    }
    for (r, load) in loads.enumerate() {
        for (_, e) in load.iter().filter(|(i, _)| *i == row) {
            add(lowering, -1.0, *e, n + r)?;
        }
    }
    items.push((-1.0, lowering.value(force)?));
    let sum = lowering.sum(&items);
    Ok(lowering.whole(sum))
}

/// What must exist wherever the machine goes.
fn places(equations: &Equations) -> Result<Tape, Fault> {
    let roots: Vec<(String, Expr)> = equations.places.iter().enumerate().map(|(i, e)| (format!("{POSITION}{}", i + 1), *e)).collect();
    Lowering::new(&equations.graph, &over_accelerations(equations), Switches::Value).tape("places", &roots)
}

/// The equations with all rates zero, ready to be differentiated by coordinates. Rates are replaced before differentiation, which leaves little of
/// most systems.
struct AtRest<'e> {
    equations: &'e Equations,
    graph: Graph,
    rest: Substitution,
    definitions: Vec<(SymbolId, Expr)>,
    /// Those that depend on coordinates.
    moving: Vec<(SymbolId, Expr)>,
}

impl<'e> AtRest<'e> {
    fn new(equations: &'e Equations) -> AtRest<'e> {
        let mut graph = equations.graph.clone();
        let zero = graph.zero();
        let mut rest = Substitution::new(equations.coordinates.iter().map(|c| (c.symbols[1], zero)));
        let definitions: Vec<(SymbolId, Expr)> =
            equations.definitions.iter().map(|d| (d.symbol, rest.apply(&mut graph, d.formula))).collect();
        let moving = over_coordinates(equations, &graph, &definitions);
        AtRest { equations, graph, rest, definitions, moving }
    }

    fn value(&mut self, e: Expr) -> Expr {
        self.rest.apply(&mut self.graph, e)
    }

    /// ∂formulas[i]/∂q_j, row by row.
    fn jacobian(&mut self, formulas: &[Expr]) -> Vec<Expr> {
        let n = self.equations.coordinates.len();
        let mut entries = vec![self.graph.zero(); formulas.len() * n];
        for (j, coordinate) in self.equations.coordinates.iter().enumerate() {
            let mut derivation = Derivation::through(&mut self.graph, &self.moving, coordinate.symbols[0]);
            for (i, formula) in formulas.iter().enumerate() {
                entries[i * n + j] = derivation.apply(&mut self.graph, *formula);
            }
        }
        entries
    }

    fn tape(self, name: &str, inputs: Inputs, roots: &[(String, Expr)]) -> Result<Tape, Fault> {
        let inputs = Inputs { definitions: self.definitions, ..inputs };
        Lowering::new(&self.graph, &inputs, Switches::Value).tape(name, roots)
    }
}

/// h(q, 0, s, t) and ∂h/∂q.
fn statics(equations: &Equations, names: &Names) -> Result<Tape, Fault> {
    let mut rest = AtRest::new(equations);
    let force: Vec<Expr> = equations.force.iter().map(|h| rest.value(*h)).collect();
    let derivatives = rest.jacobian(&force);
    let mut roots: Vec<(String, Expr)> = names.states.iter().map(|s| format!("h {s}")).zip(force).collect();
    roots.extend(names.by_coordinates("dh").zip(derivatives));
    rest.tape("statics", over_states(equations), &roots)
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

/// x at the start, over parameters.
fn start(equations: &Equations, names: &Names) -> Result<Tape, Fault> {
    let coordinates = || equations.coordinates.iter();
    let formulas = coordinates().map(|c| c.start).chain(coordinates().map(|c| c.rate)).chain(equations.auxiliaries.iter().map(|a| a.start));
    let roots: Vec<(String, Expr)> = names.states.iter().cloned().zip(formulas).collect();
    Lowering::new(&equations.graph, &parameters_only(equations), Switches::Value).tape("start", &roots)
}
