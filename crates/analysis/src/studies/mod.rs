//! Studies, one file each.

pub mod equilibrium;
pub mod extremes;
pub mod modes;
pub mod peaks;
pub mod response;
pub mod simulate;
pub mod tracks;
