//! Events: the first root of a guard inside a step, impacts, and the modes that hold after it.

mod bounds;
mod contacts;
mod happened;
mod impacts;
mod modes;
mod nearest;
mod rivals;
mod sides;
pub(crate) use bounds::{BoundState, STILL, size};
pub use happened::{Change, Rival, Switch};
pub(crate) use happened::{Hit, opposite};
pub mod roots;
pub mod words;
