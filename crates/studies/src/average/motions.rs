//! Motions of the machine itself beside the averaged theory: the mean speed that each settles to.

use crate::machine::Machine;
use crate::repeat::{Asks, At, Repeated, number, one};
use crate::simulate;
use crate::watch::Watch;
use mechanics::asked::{Asked, Value};
use words::Notice;

/// Share of a motion over which its mean speed is taken: its last fifth.
const LAST: f64 = 0.2;

/// Motions of a machine.
pub(super) struct Motions {
    at: At,
    repeated: Repeated,
}

impl Motions {
    /// Over a time from the start of the file.
    pub(super) fn new(machine: &Machine, angle: &str, until: f64) -> Result<Motions, Notice> {
        let mut inner = Asked::new(simulate::KIND.name);
        inner.set("until", Value::Number(until));
        let observe = [format!("mean({angle}', {} s, {until} s)", (1.0 - LAST) * until)];
        // a motion of the file that ends earlier would be another one
        let mut plain = machine.clone();
        plain.model.studies.clear();
        let repeated = Repeated::new(&plain, Asks { observe: &observe, of: None, inner: &inner })?;
        Ok(Motions { at: At::of(&plain), repeated })
    }

    /// The mean speed at the end, with other values.
    pub(super) fn speed(&mut self, values: &[(String, f64)], watch: &Watch) -> Result<f64, Notice> {
        let mut inner = Watch { interrupt: watch.interrupt, ..Watch::default() };
        let found = one(&mut self.at, &self.repeated, values, &mut inner)?;
        let (_, wanted) = &self.repeated.noted[0];
        number(&found, wanted).map(|(value, _)| value)
    }
}
