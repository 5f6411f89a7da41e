//! Integration of motions: steps of Taylor series with dense output, an implicit method beside them for stiff motions, and what happens at events.
//!
//! A motion is a row of steps ([`Step`]); [`taylor`] makes them and asks [`stiff`] where an explicit step would be too short; at a switch, an impact or the end of
//! sliding, which [`crossings`] find, `events` decides the modes of the next step.

pub mod crossings;
mod events;
mod series;
mod step;
pub mod stiff;
pub mod taylor;

pub(crate) use series::Series;
pub use step::Step;
pub(crate) use step::{FOUR_TURNS, UNIT_SHARE, increment_and_slope, taken};
pub(crate) use taylor::{MOST_TURNS, Samples, is_smooth, note};
