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
    /// A value in SI as `--set` takes it; this form reads back as the same number. A bare number serves where the file uses SI units.
    pub fn written(&self, name: &str, value: f64) -> String {
        if !self.model.scaled.contains_key(name) {
            return format!("{value:e}");
        }
        let parameter = self.model.parameters.iter().find(|p| p.name == name).map(|p| &p.unit);
        let base = name.trim_end_matches('\'');
        let coordinate = || self.model.coordinates.iter().find(|c| c.name == base).and_then(|c| c.units.get(name.len() - base.len()));
        let unit = parameter.or_else(coordinate).map_or("", String::as_str);
        format!("{value:e} {unit}").trim_end().to_owned()
    }

    /// The same machine with other values, SI; names as with `--set`.
    ///
    /// # Errors
    /// Findings about the model with these values.
    pub fn with_values(&self, values: &[(&str, f64)]) -> Result<Machine, Failure> {
        let changed = |name: &str| values.iter().any(|(n, _)| *n == name);
        let kept = self.origin.overrides.iter().filter(|(name, _)| !changed(name)).cloned();
        let set = values.iter().map(|(name, value)| ((*name).to_owned(), self.written(name, *value)));
        let overrides: Vec<(String, String)> = kept.chain(set).collect();
        pipeline::build(&self.origin.source, &overrides, &mut Watch::default())
    }
}
