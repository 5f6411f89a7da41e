//! Small numerical tools.

pub mod lu;
pub mod qr;
pub mod random;
pub mod sum;
