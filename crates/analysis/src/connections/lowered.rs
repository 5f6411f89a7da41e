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
    Ok(Arc::new(program::lower::equations_with(equations, &nothing(equations))?))
}

/// The program of the equations in which `selection` takes part: that of assembly where nothing does.
///
/// *Errors*: those of [`program::lower::equations_with`].
pub fn selected(equations: &Equations, selection: &Selection, conditions: &Arc<Program>) -> Result<Arc<Program>, Fault> {
    if *selection == nothing(equations) {
        return Ok(Arc::clone(conditions));
    }
    Ok(Arc::new(program::lower::equations_with(equations, selection)?))
}

/// No connection takes part.
fn nothing(equations: &Equations) -> Selection {
    Selection {
        conditions: vec![false; equations.conditions.len()],
        reactions: vec![false; equations.reactions.len()],
        balances: vec![false; equations.balances.len()],
        repeated: None,
    }
}
