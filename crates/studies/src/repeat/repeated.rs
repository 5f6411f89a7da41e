//! The study that is repeated, with what is noted of it.

use super::asking::{Asks, changed, observing};
use super::base;
use super::wanted::{Noted, noted};
use crate::machine::Machine;
use crate::simulate::TOLERANCE;
use mechanics::asked::{Asked, Value};
use words::Notice;

/// The study that is repeated, and what is noted of it.
#[derive(Clone, Debug)]
pub struct Repeated {
    /// As the file reads now.
    pub base: Asked,
    /// Which study of the file it is.
    of: Option<usize>,
    /// What the command line says of it.
    inner: Asked,
    /// What is noted.
    pub noted: Vec<Noted>,
}

impl Repeated {
    /// The study of a machine that has the results.
    ///
    /// # Errors
    /// There is no such study (C032), no such result (C008, S085, S100), or a value for a key that the study does not have (C054).
    pub fn new(machine: &Machine, asks: Asks<'_>) -> Result<Repeated, Notice> {
        let noted = noted(machine, asks.observe, asks.of)?;
        let (base, of) = base::base(machine, asks, &noted)?;
        Ok(Repeated { base, of, inner: asks.inner.clone(), noted })
    }

    /// Gives the repeated study a value of its own.
    pub fn set(&mut self, key: &'static str, value: Value) {
        self.inner.set(key, value.clone());
        self.base.set(key, value);
    }

    /// The tolerance of the repeated study; none where it has no such key.
    pub fn tolerance(&self, machine: &Machine) -> Option<f64> {
        let study = machine.origin.studies.find(self.base.kind)?;
        study.kind().key("tolerance").map(|_| self.base.number("tolerance").unwrap_or(TOLERANCE))
    }

    /// The study as the file reads with the values: its formulas (a period 2*pi/w) may depend on them.
    pub(crate) fn at(&self, machine: &Machine) -> Result<Asked, Notice> {
        let Some(fresh) = self.of.and_then(|k| machine.model.studies.get(k)) else { return Ok(self.base.clone()) };
        let mut fresh = changed(machine, fresh.kind, Some(fresh.clone()), &self.inner)?;
        observing(machine, &mut fresh, &self.noted);
        Ok(fresh)
    }
}
