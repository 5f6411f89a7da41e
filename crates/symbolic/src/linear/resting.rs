//! What acts at rest.

use super::timing::{Form, Stills, Timing, averaged, moving, split, still};
use crate::equations::Definition;
use crate::{Equations, Expr, Graph, Substitution, SymbolId};

/// Equations with what acts at rest: the means of loads that repeat.
#[derive(Clone, Debug)]
pub struct Resting {
    /// The equations with time-free forces, balances and second derivation; `second` is empty where it has no mean.
    pub equations: Equations,
    /// Waveforms whose means stand in them as symbols.
    pub forms: Vec<Form>,
    /// Definitions that the waveforms may use.
    pub definitions: Vec<(SymbolId, Expr)>,
    /// How time was treated.
    pub timing: Timing,
}

/// What acts at rest, as [`Linear`](crate::Linear) has it: loads that repeat by their means over a period, all loads as they stand at t = 0 where one of them does not
/// repeat. Rates and accelerations are zero.
pub fn at_rest(equations: &Equations) -> Resting {
    let mut out = equations.clone();
    let mut graph = equations.graph.clone();
    let moving = moving(equations, &mut graph);
    let definitions = still(equations, &moving);
    let zero = graph.zero();
    let mut inline = Substitution::new(moving.iter().copied());
    let mut rest = Substitution::new(equations.coordinates.iter().flat_map(|c| [(c.symbols[1], zero), (c.symbols[2], zero)]));
    let (mut forms, mut stills, mut timing) = (Vec::new(), Stills { list: Vec::new(), time: equations.time }, Timing::default());
    let mut mean = |graph: &mut Graph, list: &[Expr], timing: &mut Timing| -> Vec<Expr> {
        let list: Vec<Expr> = list
            .iter()
            .map(|e| {
                let e = inline.apply(graph, *e);
                rest.apply(graph, e)
            })
            .collect();
        let parts = split(equations, graph, &list, timing);
        timing.averaged |= parts.iter().any(|h| !h.is_still());
        parts.iter().map(|h| averaged(graph, (&mut forms, &mut stills), h)).collect()
    };
    let acting: Vec<Expr> = equations.force.iter().copied().chain(equations.balances.iter().map(|b| b.rest)).collect();
    let mut acting = mean(&mut graph, &acting, &mut timing);
    let balances = acting.split_off(equations.force.len());
    out.force = acting;
    out.balances.iter_mut().zip(balances).for_each(|(b, e)| b.rest = e);
    let mut other = Timing::default();
    let second = mean(&mut graph, &equations.second, &mut other);
    out.second = if other.frozen == timing.frozen { second } else { Vec::new() };
    for condition in &equations.conditions {
        let held = condition.place.unwrap_or(condition.rate);
        let held = inline.apply(&mut graph, held);
        timing.driven |= graph.contains(held, |s| s == equations.time);
    }
    out.graph = graph;
    let label = || words::Text::new("whether a rate is zero", "обращается ли частота в нуль");
    let definition = |(symbol, formula): (SymbolId, Expr)| Definition { symbol, formula, unit: "1".into(), label: label(), shown: false };
    out.definitions.extend(stills.list.into_iter().map(definition));
    Resting { equations: out, forms, definitions, timing }
}
