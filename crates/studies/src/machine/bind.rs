//! What a machine was made from, and the same machine with other values: bound to them where only numbers change, read again where more does.

use super::build::{build, build_as, numbered};
use super::built::Machine;
use crate::failure::Failure;
use crate::frame::renew::Form;
use crate::guards;
use crate::source::Source;
use crate::watch::Watch;
use mechanics::derive::Detail;
use mechanics::model::{Change, unmoved};
use words::Notice;

pub use super::built::Origin;

/// How a machine got its values.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Binding {
    /// Numbers changed, nothing else.
    Numbers,
    /// The file was read again.
    Anew,
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

    /// The machine of another text or other overrides, read with the same studies.
    ///
    /// # Errors
    /// Findings about the model.
    pub fn again(&self, source: Source, overrides: Vec<(String, String)>) -> Result<Machine, Failure> {
        build(Origin { source, overrides, studies: self.origin.studies }, Detail::Equations, &mut Watch::default())
    }

    /// The same machine with other values, SI; names as with `--set`.
    ///
    /// # Errors
    /// Findings about the model with these values.
    pub fn with_values(&self, values: &[(&str, f64)]) -> Result<Machine, Failure> {
        self.again(self.origin.source.clone(), self.overridden(values))
    }

    /// The same machine with every number of its frame as a parameter, for a study that follows a parameter of the frame; none where it is none.
    ///
    /// # Errors
    /// Findings about the model.
    pub fn followed(&self, name: &str) -> Result<Option<Machine>, Failure> {
        let parameter = self.model.parameters.iter().find(|p| p.name == name);
        if !parameter.is_some_and(|p| self.equations.is_mounted_on(p.symbol)) {
            return Ok(None);
        }
        let detail = if self.equations.steps.is_empty() { Detail::Equations } else { Detail::Steps };
        build_as(self.origin.clone(), (detail, Form::Followed), &mut Watch::default()).map(Some)
    }

    /// Gives this machine other values with all that was derived for it, SI; what stands on its sheets (the hash of the file and its own values) stays.
    ///
    /// # Errors
    /// Findings about the model with these values; the machine is as it was then.
    pub fn given(&mut self, values: &[(&str, f64)]) -> Result<(), Failure> {
        let hash = self.model_hash.clone();
        match self.bound(values) {
            Some(done) => done?,
            None => {
                let detail = if self.equations.steps.is_empty() { Detail::Equations } else { Detail::Steps };
                let origin = Origin { overrides: self.overridden(values), ..self.origin.clone() };
                *self = build(origin, detail, &mut Watch::default())?;
            }
        }
        self.model_hash = hash;
        Ok(())
    }

    /// Gives this machine other values, SI; names as with `--set`. The result is that of [`Machine::with_values`] to the last bit; where the values are set
    /// already and nothing but numbers changes, nothing is read, derived or lowered again.
    ///
    /// # Errors
    /// Findings about the model with these values; the machine is as it was then.
    pub fn bind(&mut self, values: &[(&str, f64)]) -> Result<Binding, Failure> {
        match self.bound(values) {
            Some(done) => done.map(|()| Binding::Numbers),
            None => {
                *self = self.with_values(values)?;
                Ok(Binding::Anew)
            }
        }
    }

    /// The same without reading: none where the file has to be read again, and the machine is as it was then.
    ///
    /// # Errors
    /// Values that the machine cannot have.
    pub fn bound(&mut self, values: &[(&str, f64)]) -> Option<Result<(), Failure>> {
        let is_set = |name: &str| self.origin.overrides.iter().any(|(n, _)| n == name);
        // the matrices of a structure are numbers
        if self.model.structure.is_some() || !values.iter().all(|(name, _)| is_set(name)) {
            return None;
        }
        let change = self.model.change(values)?;
        let equations = &self.equations;
        let same = self.model.allows(&change) && unmoved(&equations.graph, &equations.premises, &change.before, &change.after);
        same.then(|| self.put(values, &change).map_err(|fault| Notice::from(fault).into()))
    }

    fn put(&mut self, values: &[(&str, f64)], change: &Change) -> Result<(), analysis::Fault> {
        let mut equations = self.equations.clone();
        for p in &mut equations.parameters {
            // what was sought is sought again from the same guess
            let declared = self.model.parameters.iter().find(|d| d.symbol == p.symbol);
            p.value = change.after.get(&p.symbol).copied().unwrap_or(0.0);
            p.written = declared.map(|d| d.written.clone()).unwrap_or_default();
            if values.iter().any(|(name, _)| declared.is_some_and(|d| d.name == *name)) {
                p.written = declared.map(|d| self.written(&d.name, p.value)).unwrap_or_default();
            }
        }
        let equations = numbered(&self.model, equations)?;
        let numbers: Vec<f64> = equations.parameters.iter().map(|p| p.value).collect();
        self.system = self.system.bound(&equations, &numbers, &|program| guards::names(&equations, program))?;
        self.equations = equations;
        self.origin.overrides = self.overridden(values);
        self.model_hash = self.origin.source.hash(&self.origin.overrides);
        let texts: Vec<(String, String)> = values.iter().map(|(name, value)| ((*name).to_owned(), self.written(name, *value))).collect();
        self.model.put(change, &|name, _| texts.iter().find(|(n, _)| n == name).map(|(_, text)| text.clone()).unwrap_or_default());
        Ok(())
    }

    /// The values set from outside, with these among them.
    fn overridden(&self, values: &[(&str, f64)]) -> Vec<(String, String)> {
        let changed = |name: &str| values.iter().any(|(n, _)| *n == name);
        let kept = self.origin.overrides.iter().filter(|(name, _)| !changed(name)).cloned();
        let set = values.iter().map(|(name, value)| ((*name).to_owned(), self.written(name, *value)));
        kept.chain(set).collect()
    }
}
