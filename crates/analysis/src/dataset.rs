//! The result of a study: named columns with units, audits, events, provenance. It knows no output format.

use symbolic::Text;

use crate::Quantity;

/// Result of a study.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Dataset {
    /// Where the numbers come from.
    pub provenance: Provenance,
    /// Index of the column that is the axis of the others (time), if there is one.
    pub axis: Option<usize>,
    /// Columns, all of one length.
    pub columns: Vec<Column>,
    /// Checks made on the result.
    pub audits: Vec<Audit>,
    /// Names of the states in the events.
    pub states: Vec<String>,
    /// What happened along the axis.
    pub events: Vec<Event>,
    /// Work done, by name: steps, evaluations.
    pub counters: Vec<Counter>,
    /// Remarks to show beside the result.
    pub notes: Vec<Text>,
    /// Whether the study was interrupted or ended by a fault, so that the result is a part of what was asked.
    pub partial: bool,
}

/// Model and program behind a result.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Provenance {
    /// Title of the model.
    pub title: Text,
    /// Version of strutt.
    pub version: String,
    /// Hash of the model file.
    pub model_hash: String,
    /// Values of the parameters.
    pub parameters: Vec<ParameterValue>,
}

/// A parameter and its number, SI.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ParameterValue {
    /// Name, symbol, unit, label.
    pub quantity: Quantity,
    /// As the user wrote it.
    pub written: String,
    /// The number, SI.
    pub value: f64,
}

/// A named column.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Column {
    /// Name, symbol, unit, label.
    pub quantity: Quantity,
    /// Values, SI.
    pub values: Vec<f64>,
}

/// A check of a result.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Audit {
    /// Name in machine-readable output: `power_balance`.
    pub key: String,
    /// Name for people.
    pub name: Text,
    /// What was found.
    pub value: f64,
    /// What is allowed.
    pub limit: f64,
    /// Whether the check holds.
    pub ok: bool,
}

impl Audit {
    /// A check that a value does not exceed its limit; a value that is not a number fails.
    pub fn at_most(key: &str, name: Text, value: f64, limit: f64) -> Audit {
        Audit { key: key.into(), name, value, limit, ok: value <= limit }
    }
}

/// Something that happened at an instant.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Event {
    /// When.
    pub t: f64,
    /// What, for people.
    pub what: Text,
    /// Index of the guard.
    pub guard: usize,
    /// Signs of the guard before and after.
    pub sides: [f64; 2],
    /// State just before and just after; an impact changes rates.
    pub states: [Vec<f64>; 2],
    /// Selected outputs just before and just after.
    pub outputs: [Vec<f64>; 2],
}

/// A counter of work.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Counter {
    /// Machine name: `steps`.
    pub key: &'static str,
    /// Name for people.
    pub name: Text,
    /// Value.
    pub value: f64,
}

impl Dataset {
    /// Column with a name.
    pub fn column(&self, name: &str) -> Option<&Column> {
        self.columns.iter().find(|c| c.quantity.name == name)
    }
    /// Value of a counter.
    pub fn counter(&self, key: &str) -> Option<f64> {
        self.counters.iter().find(|c| c.key == key).map(|c| c.value)
    }
    /// Audit with a key.
    pub fn audit(&self, key: &str) -> Option<&Audit> {
        self.audits.iter().find(|a| a.key == key)
    }
}
