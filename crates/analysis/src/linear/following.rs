//! A linear machine that finds what nobody gives anew when its parameters change.

use std::sync::Arc;

use super::machine::LinearMachine;
use super::sought::{Seeking, Sought};
use symbolic::SymbolId;

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
