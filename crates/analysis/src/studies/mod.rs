//! Studies, one file each.

pub mod equilibrium;
pub mod modes;
pub mod simulate;
pub mod tracks;
pub mod transient;
