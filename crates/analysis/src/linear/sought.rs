//! Numbers of a machine that nobody gives: unknown parameters, which statics gives, and places at the start, which connections give.
//!
//! They belong to the values of all other parameters. A study that follows one of these finds them anew at each value, as if the file had been read with it.

use std::fmt::Debug;
use std::sync::Arc;

use crate::Fault;

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
    pub(super) how: Arc<dyn Sought>,
    /// By parameter: whether they may change with it.
    pub(super) reach: Vec<bool>,
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
