//! Studies, one file each.

pub mod equilibrium;
pub mod periodic;
pub mod simulate;
