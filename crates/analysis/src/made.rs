//! The studies of machines, made here once.
//!
//! Studies are generic over what moves. Below the optimisation of a release a crate takes over what a crate below it has made of a generic function; so what is named here is
//! compiled with this crate and not again with each crate and each test above it. A release, which makes its own, has nothing of this file.

use crate::studies::claims::{Draw, samples};
use crate::studies::equilibrium::{Equilibrium, equilibrium};
use crate::studies::periodic::{self, Periodic, periodic};
use crate::studies::poincare::{Poincare, poincare};
use crate::studies::simulate::{Outcome, Simulate, simulate};
use crate::studies::transient::{self, Transient, transient};
use crate::{Fault, Machine};
use symbolic::Equations;

/// A motion.
pub static SIMULATE: fn(&mut Machine, &[f64], Simulate<'_>) -> Outcome = simulate::<Machine>;
/// A motion in closed form.
pub static TRANSIENT: fn(&mut Machine, &Equations, &[f64], Transient<'_>) -> transient::Found = transient::<Machine>;
/// A periodic regime.
pub static PERIODIC: fn(&mut Machine, &[f64], &Periodic<'_>) -> periodic::Outcome = periodic::<Machine>;
/// Section points.
pub static POINCARE: fn(&mut Machine, &[f64], Poincare<'_>) -> Outcome = poincare::<Machine>;
/// Places of rest.
pub static EQUILIBRIUM: fn(&mut Machine, &[f64], &Equilibrium) -> Outcome = equilibrium::<Machine>;
/// States that a motion passes.
pub static SAMPLES: fn(&mut Machine, &[f64], Draw) -> States = samples::<Machine>;

type States = Result<Vec<Vec<f64>>, Fault>;
