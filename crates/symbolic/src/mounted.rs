//! Numbers among the parameters that no formula gives: those of a structure that was solved beside the equations (entries of M and K, shares of its loads).
//! Whoever gives a parameter another value asks here what follows; a number that stayed behind would be silently wrong.

use crate::SymbolId;
use std::fmt::Debug;
use words::Message;

/// Numbers that follow from parameters through a computation of their own.
pub trait Mounted: Debug + Send + Sync {
    /// Parameters with a number of their own that these numbers follow from, directly or through formulas.
    fn reach(&self) -> &[SymbolId];

    /// The parameters that hold the numbers.
    fn numbers(&self) -> &[SymbolId];

    /// The numbers, SI, in the order of [`Mounted::numbers`], for values (SI) in the order of [`Mounted::reach`].
    ///
    /// *Errors*: the equations stand for other values only; nothing of the kind with these values.
    fn renewed(&self, values: &[f64]) -> Result<Vec<f64>, Box<Message>>;
}
