//! What tapes are evaluated over.

use super::expressions::Inputs;
use symbolic::{Equations, SymbolId};

/// q, q', s.
pub(super) fn state_symbols(equations: &Equations) -> Vec<SymbolId> {
    let coordinates = || equations.coordinates.iter();
    let q = coordinates().map(|c| c.symbols[0]);
    q.chain(coordinates().map(|c| c.symbols[1])).chain(equations.auxiliaries.iter().map(|a| a.symbol)).collect()
}

pub(super) fn parameters_only(equations: &Equations) -> Inputs {
    Inputs {
        parameters: equations.parameters.iter().map(|p| p.symbol).collect(),
        definitions: equations.definitions.iter().map(|d| (d.symbol, d.formula)).collect(),
        ..Inputs::default()
    }
}

pub(super) fn over_states(equations: &Equations) -> Inputs {
    Inputs { time: Some(equations.time), states: state_symbols(equations), ..parameters_only(equations) }
}

pub(super) fn over_accelerations(equations: &Equations) -> Inputs {
    Inputs { accelerations: equations.coordinates.iter().map(|c| c.symbols[2]).collect(), ..over_states(equations) }
}

/// q'' and reactions.
pub(super) fn over_reactions(equations: &Equations) -> Inputs {
    let mut inputs = over_accelerations(equations);
    inputs.accelerations.extend(equations.reactions.iter().map(|r| r.symbol));
    inputs
}
