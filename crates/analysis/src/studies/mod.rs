//! Studies, one file each.

pub mod simulate;
