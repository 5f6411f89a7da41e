//! Studies, one file each.

pub mod equilibrium;
pub(crate) mod explain;
pub mod periodic;
pub mod simulate;
