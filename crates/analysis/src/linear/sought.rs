//! Numbers of a machine that nobody gives: unknown parameters, which statics gives, and places at the start, which connections give.
//!
//! They belong to the values of all other parameters. A study that follows one of these finds them anew at each value, as if the file had been read with it.

use std::fmt::Debug;
use std::sync::Arc;

use super::LinearMachine;
use crate::Fault;
use symbolic::SymbolId;

/// How such numbers are found.
pub trait Sought: Debug + Send + Sync {
    /// The parameters that are found, by index.
    fn parameters(&self) -> &[usize];
    /// All parameters, these found for the values of the others.
    ///
    /// *Errors*: statics or the connections do not give them.
    fn found(&self, values: &[f64]) -> Result<Vec<f64>, Fault>;
}

/// The numbers of a machine that are sought, and what they hang on.
#[derive(Clone, Debug)]
pub(super) struct Seeking {
    how: Arc<dyn Sought>,
    /// By parameter: whether they may change with it.
    reach: Vec<bool>,
}

impl Seeking {
    /// Values with the sought numbers found for them; as they are where nothing changed on which these hang. A sought number that is itself given another value
    /// is what the study follows, and stands.
    ///
    /// *Errors*: those of [`Sought::found`].
    pub(super) fn followed(&self, values: Vec<f64>, before: &[f64]) -> Result<Vec<f64>, Fault> {
        let changed = |i: usize| values[i].to_bits() != before[i].to_bits();
        if (0..values.len()).any(|i| self.reach[i] && changed(i)) { self.how.found(&values) } else { Ok(values) }
    }

    pub(super) fn hangs_on(&self, parameter: usize) -> bool {
        self.reach[parameter]
    }
}

impl LinearMachine {
    /// The same machine, of which these numbers are found anew when others change.
    #[must_use]
    pub fn seeking(mut self, how: Arc<dyn Sought>) -> LinearMachine {
        let reach = (0..self.values.len()).map(|i| !how.parameters().contains(&i) && self.moves_rest(i)).collect();
        self.seeking = Some(Seeking { how, reach });
        self
    }

    /// The same for a machine of the same parameters, another state of its contacts say.
    #[must_use]
    pub(crate) fn seeking_as(mut self, other: &LinearMachine) -> LinearMachine {
        self.seeking.clone_from(&other.seeking);
        self
    }

    /// Whether the balance at the start may change with a parameter. Connections, contacts and friction at rest have more in them than small motions: each
    /// parameter counts.
    fn moves_rest(&self, parameter: usize) -> bool {
        let is_free = self.equations.reactions.is_empty() && self.equations.conditions.is_empty();
        !is_free || self.depends_on(parameter) || self.moves_start(parameter)
    }

    fn moves_start(&self, parameter: usize) -> bool {
        let graph = &self.equations.graph;
        let mut known: Vec<SymbolId> = vec![self.equations.parameters[parameter].symbol];
        for definition in &self.equations.definitions {
            if graph.contains(definition.formula, |s| known.contains(&s)) {
                known.push(definition.symbol);
            }
        }
        self.equations.coordinates.iter().any(|c| graph.contains(c.start, |s| known.contains(&s)))
    }
}
