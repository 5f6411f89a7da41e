//! Places of rest with their small motions: which are stable, where a free fall ends, how a place follows a parameter and where it changes.
//!
//! [`report`] is the study of equilibrium for machines with connections; [`branch`] follows one place over a parameter, [`changes`] tells what happened there.

pub mod beside;
pub mod branch;
pub mod changes;
pub mod contacts;
pub mod degenerate;
pub mod fall;
mod frictions;
pub mod kinks;
pub mod multiple;
pub mod onesided;
pub mod report;
pub mod stability;
