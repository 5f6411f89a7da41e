//! What a machine was made from, so that it can be made again with other values.

use crate::failure::Failure;
use crate::pipeline::{self, Machine};
use crate::source::Source;
use crate::watch::Watch;

/// File and overrides of a machine.
#[derive(Clone, Debug)]
pub struct Origin {
    /// The file.
    pub source: Source,
    /// Values set from outside.
    pub overrides: Vec<(String, String)>,
}

impl Machine {
    /// The same machine with other values, SI; names as with `--set`.
    ///
    /// # Errors
    /// Findings about the model with these values.
    pub fn with_values(&self, values: &[(&str, f64)]) -> Result<Machine, Failure> {
        let changed = |name: &str| values.iter().any(|(n, _)| *n == name);
        let kept = self.origin.overrides.iter().filter(|(name, _)| !changed(name)).cloned();
        // bare numbers are SI, and this form reads back as the same number
        let set = values.iter().map(|(name, value)| ((*name).to_owned(), format!("{value:e}")));
        let overrides: Vec<(String, String)> = kept.chain(set).collect();
        pipeline::build(&self.origin.source, &overrides, &mut Watch::default())
    }
}
