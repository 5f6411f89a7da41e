//! Everything that a file asks for: its machine and the results of its studies.

use crate::machine::Machine;
use crate::results::Results;
use analysis::dataset::Audit;
use words::Text;

/// Everything a file asks for.
#[derive(Clone, Debug)]
pub struct Calculation {
    /// The machine.
    pub machine: Machine,
    /// Results in the order of the studies.
    pub results: Vec<Results>,
    /// Files beside the page: name and what it is.
    pub files: Vec<(String, Text)>,
}

impl Calculation {
    /// All checks of all studies, equal ones once.
    pub fn audits(&self) -> Vec<&Audit> {
        let mut out: Vec<&Audit> = Vec::new();
        for audit in self.results.iter().flat_map(|f| &f.data.audits) {
            if !out.contains(&audit) {
                out.push(audit);
            }
        }
        out
    }
}
