//! Parts of the tape of energies, each by itself: an audit that asks for one at many points of a step does not pay for the others.

use std::sync::Arc;

use program::{Abreast, Bound, ENERGY, Evaluator, Operation, passes};
use symbolic::Equations;
use symbolic::connections::Law;

use crate::Fault;

/// The parts.
#[derive(Clone, Debug)]
pub(super) struct Flows {
    /// T and Π.
    pub(super) levels: Evaluator,
    /// Loads, drives, dissipated.
    pub(super) supply: Evaluator,
    /// The same at several points at once, where the tape allows it.
    pub(super) supplies: Option<Abreast>,
    /// For each reaction that the supply reads the guard of its contact; none for any other reaction. Reactions cost a solution of the equations, unless
    /// they are those of open contacts, which are nothing.
    pub(super) reads: Vec<Option<usize>>,
    /// The power that each dry friction takes.
    pub(super) rubbed: Evaluator,
    /// dE/dt, made when it is asked for.
    pub(super) rate: Option<Evaluator>,
}

/// The tape of energies with some of its roots.
pub(super) fn part(bound: &Bound, roots: &[usize]) -> Result<Evaluator, Fault> {
    let tape = passes::specialise(&Arc::new(passes::select(&bound.program().energy, roots)), bound.parameters())?;
    Ok(bound.evaluator(&Arc::new(tape))?)
}

/// Places of named powers among the roots.
pub(super) fn roots(names: &[&str]) -> Vec<usize> {
    names.iter().filter_map(|n| ENERGY.iter().position(|e| e == n)).collect()
}

/// The slot of a reaction that an operation reads, among all reactions.
pub(super) fn reaction(operation: &Operation, coordinates: usize) -> Option<usize> {
    match operation {
        Operation::Acceleration(slot) => (*slot as usize).checked_sub(coordinates),
        _ => None,
    }
}

impl Flows {
    /// *Errors*: P020 when a pass broke a tape.
    pub(super) fn new(equations: &Equations, bound: &Bound) -> Result<Flows, Fault> {
        let supply = part(bound, &roots(&["loads", "drives", "dissipated"]))?;
        let contact = |r: usize| match equations.reactions[r].law {
            Law::Contact { .. } => bound.program().switches[r],
            _ => None,
        };
        let n = bound.program().coordinates;
        let reads = supply.tape().body.iter().filter_map(|i| reaction(&i.operation, n)).map(contact).collect();
        let frictions: Vec<usize> = (ENERGY.len()..bound.program().energy.roots.len()).collect();
        let (levels, rubbed) = (part(bound, &roots(&["kinetic", "potential"]))?, part(bound, &frictions)?);
        let supplies = Abreast::new(&supply);
        Ok(Flows { levels, supply, supplies, reads, rubbed, rate: None })
    }
}
