//! The numbers of a machine that nobody gives, found again for other values of its parameters.

use super::build::numbered;
use super::built::Machine;
use analysis::Fault;
use analysis::linear::Sought;
use mechanics::Model;
use std::sync::Arc;
use symbolic::Equations;

/// Unknowns and places at the start of one machine.
#[derive(Debug)]
struct OfMachine {
    model: Model,
    /// With the guesses of the file.
    equations: Equations,
    parameters: Vec<usize>,
}

impl Sought for OfMachine {
    fn parameters(&self) -> &[usize] {
        &self.parameters
    }

    fn found(&self, values: &[f64]) -> Result<Vec<f64>, Fault> {
        let mut equations = self.equations.clone();
        for (i, p) in equations.parameters.iter_mut().enumerate().filter(|(i, _)| !self.parameters.contains(i)) {
            p.value = values[i];
        }
        numbered(&self.model, equations).map(|found| found.parameters.iter().map(|p| p.value).collect())
    }
}

/// How the unknowns and the places at the start of this machine are found; none where the file gives all numbers.
pub fn sought(machine: &Machine) -> Option<Arc<dyn Sought>> {
    let (model, mut equations) = (&machine.model, machine.equations.clone());
    let is_unknown = |p: &symbolic::equations::Parameter| model.unknowns.contains(&p.symbol);
    let unknown = (0..equations.parameters.len()).filter(|i| is_unknown(&equations.parameters[*i]));
    let mut parameters: Vec<usize> = unknown.chain(equations.starts.iter().filter_map(|s| s.parameter)).collect();
    parameters.sort_unstable();
    parameters.dedup();
    for i in &parameters {
        let p = &mut equations.parameters[*i];
        // what was sought is sought again from the same guess; a place at the start has none
        p.value = model.parameters.iter().find(|d| d.symbol == p.symbol).map_or(0.0, |d| d.number.unwrap_or(p.value));
    }
    (!parameters.is_empty()).then(|| Arc::new(OfMachine { model: model.clone(), equations, parameters }) as Arc<dyn Sought>)
}
