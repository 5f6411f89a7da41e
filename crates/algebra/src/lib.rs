//! Numbers for everybody: a thin layer over faer and what it does not give. Small dense systems, ranks and null spaces, eigenproblems with residuals
//! and counts, sparse symmetric matrices, sums in twice the digits.
//!
//! It knows no mechanics and no time, no words for users and no files: what goes wrong is a [`Trouble`], which its callers put into words.
//!
//! Rooms, in order of reading: [`trouble`] (what can be wrong) - [`elementary`], [`complex`] (the same bits on every machine) - [`sum`], [`double`] (twice the digits), [`lanes`], [`simd`] (several numbers at once, the only files that know wide and pulp) - [`vectors`], [`space`], [`lu`], [`cholesky`], [`qr`],
//! [`refined`] (small dense systems) - `kernels` (the only file that knows faer), [`sparse`], [`factor`], [`twofold`] - `modes`, [`refine`], [`lanczos`], [`eigen`], `eigenpair`, [`product`], [`certify`], [`polish`] (eigenproblems) -
//! [`divided`], [`expm`] (exponentials) - [`hill`], [`mathieu`] (equations with periodic coefficients), [`surface`], [`sheet`] (what is dear, and many coefficients, over two parameters) - [`bernstein`], [`gauss`], [`golden`], [`simplex`], [`random`], [`arrange`] (lists).

// the same bits on every machine: see clippy.toml
#![cfg_attr(not(test), deny(clippy::disallowed_methods, clippy::too_many_lines, clippy::fn_params_excessive_bools))]

pub mod arrange;
pub mod bernstein;
pub mod certify;
pub mod cholesky;
pub mod complex;
pub mod divided;
pub mod double;
pub mod eigen;
mod eigenpair;
pub mod elementary;
pub mod expm;
pub mod factor;
pub mod gauss;
pub mod golden;
pub mod hill;
mod kernels;
pub mod lanczos;
pub mod lanes;
pub mod lu;
pub mod mathieu;
mod modes;
pub mod polish;
pub mod product;
pub mod qr;
pub mod random;
pub mod refine;
pub mod refined;
pub mod sheet;
pub mod simd;
pub mod simplex;
pub mod space;
pub mod sparse;
pub mod sum;
pub mod surface;
pub mod trouble;
pub mod twofold;
pub mod vectors;

pub use trouble::Trouble;
