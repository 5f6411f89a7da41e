//! Where a guard passes zero inside a step: the first root of its polynomial, what its first coefficients say, and what happened there, as data and in words.

mod bounds;
mod happened;
pub mod roots;
pub mod words;

pub(in crate::integrate) use bounds::{BoundState, REACHED, SIGNIFICANT_LEAVING, STILL, judge_bound, leading_term, size};
pub use happened::{Change, Rival, Switch};
pub(crate) use happened::{Hit, opposite};
pub(in crate::integrate) use happened::{Impact, Verdict};
