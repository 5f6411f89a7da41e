//! What assembly evaluates.

use std::sync::Arc;

use program::Program;
use program::lower::Selection;
use symbolic::Equations;

use crate::Fault;

/// The program that assembly evaluates: nothing takes part in the equations yet.
///
/// *Errors*: a formula that cannot be lowered.
pub fn conditions(equations: &Equations) -> Result<Arc<Program>, Fault> {
    let none = Selection {
        conditions: vec![false; equations.conditions.len()],
        reactions: vec![false; equations.reactions.len()],
        balances: vec![false; equations.balances.len()],
        repeated: None,
    };
    Ok(Arc::new(program::lower::equations_with(equations, &none)?))
}
