//! Studies, one file each.

pub mod equilibrium;
pub mod simulate;
pub mod structure_modes;
