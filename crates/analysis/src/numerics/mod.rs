//! Small numerical tools.

pub mod certify;
pub mod complex;
pub mod complex_lu;
pub mod divided;
pub mod eigen;
pub mod expm;
pub mod factor;
pub(crate) mod gauss;
mod kernels;
pub mod lanczos;
pub mod lu;
mod newton;
pub mod qr;
pub mod random;
pub mod rank;
pub(crate) mod refine;
pub(crate) mod refined;
pub mod simplex;
pub mod sparse;
pub mod sum;
pub mod trouble;
