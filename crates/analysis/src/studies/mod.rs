//! Studies, one file each.

mod balance;
pub mod claims;
pub mod cycle;
pub mod equilibrium;
pub(crate) mod explain;
pub mod extremes;
mod free_motion;
pub mod impedance;
pub mod kinematics;
pub mod least;
pub mod limits;
pub mod modes;
pub mod peaks;
pub mod periodic;
pub mod poincare;
mod polish;
pub mod pushed;
pub mod response;
pub mod rolling;
pub mod simulate;
pub mod statics;
pub mod structure_modes;
pub mod structure_statics;
pub mod superposition;
pub mod tracks;
pub mod transient;
pub mod unknowns;
