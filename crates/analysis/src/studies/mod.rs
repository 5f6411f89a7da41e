//! Studies, one file each, and what several of them share.
//!
//! Motions and regimes: [`simulate`], [`poincare`] (section points), [`transient`] (closed form, phase by phase), [`periodic`] (regimes), [`continuation`] (branches over a parameter),
//! [`stability`] (periodic coefficients, disturbances in the long run), [`average`] (over a fast turn), [`threshold`] (where something changes), [`map`] (classes over two parameters); `pace` (runs whose steps grow without end).
//! Small motions: [`modes`], [`rolling`] (with conditions on rates), [`tracks`] with `successors` (modes along a parameter), [`response`], [`superposition`] (all harmonics together); below them
//! [`shapes`], `roots` (what damping couples), `clusters` (several with one shape), `polish`, `sharp` (beside a root with little damping), [`impedance`], [`amplitudes`], `free_motion` (nothing holds), [`extremes`], [`least`], [`swings`], and [`limits`] with `balance` (how far small motions hold).
//! Rest and linkages: [`equilibrium`], [`rest`] (stability of places, what changes along a parameter), [`unknowns`], [`statics`] with `telling`, [`kinematics`], [`cycle`], [`pushed`].
//! Frames: [`structure_statics`], [`structure_modes`]. Formulas against machines: [`claims`]. Codes of all: `explain`.

pub mod amplitudes;
pub mod average;
mod balance;
pub mod claims;
mod clusters;
pub mod continuation;
pub mod cycle;
pub mod equilibrium;
pub(crate) mod explain;
pub mod extremes;
mod free_motion;
pub mod impedance;
pub mod kinematics;
pub mod least;
pub mod limits;
pub mod map;
pub mod modes;
mod pace;
pub mod periodic;
pub mod poincare;
mod polish;
pub mod pushed;
pub mod response;
pub mod rest;
pub mod rolling;
mod roots;
pub mod shapes;
mod sharp;
pub mod simulate;
pub mod stability;
pub mod statics;
pub mod structure_modes;
pub mod structure_statics;
mod successors;
pub mod superposition;
pub mod swings;
mod telling;
pub mod threshold;
pub mod tracks;
pub mod transient;
pub mod unknowns;
