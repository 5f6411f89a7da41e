//! Eight motions at once: values and Taylor series of machines with one layout, one machine a lane.
//!
//! A [`Layout`] says what is done; an [`Ensemble`] has numbers, modes and series of eight lanes. At each order every operation is done for all lanes by the widest registers of the
//! processor ([`algebra::simd`]). A lane sees the operations on its own numbers in one order, whatever the other lanes hold: its bits depend on its own machine alone. What has no value in a lane is not a
//! number there; who reads the lane does the motion by the scalar path, which knows why.

mod faithful;
mod layout;
mod motions;
mod rows;
mod series;
mod values;

pub use layout::{Layout, Parts};
pub use motions::{Ensemble, Rule, Span, Values};
pub use rows::LANES;
