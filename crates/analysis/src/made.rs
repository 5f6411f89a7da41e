//! The studies of machines, made here once.
//!
//! Studies are generic over what moves. What is called by these names is compiled with this crate, for speed, and not again with each crate and each test above it, of which a
//! release makes small programs.

use crate::dataset::Dataset;
use crate::marks::pushes::Push;
use crate::studies::claims::{Draw, samples};
use crate::studies::cycle::{Cycle, Running, running};
use crate::studies::periodic::{self, Periodic, periodic};
use crate::studies::poincare::{Poincare, poincare};
use crate::studies::pushed::over_cycle;
use crate::studies::simulate::{Made, Outcome, Simulate, Wanted, abreast, confirm, simulate};
use crate::studies::stability::{Lyapunov, Options, Scalar, lyapunov, standing};
use crate::studies::transient::{self, Transient, transient};
use crate::{Fault, Machine};
use std::sync::atomic::AtomicBool;
use symbolic::Equations;
use words::Text;

/// A motion.
pub static SIMULATE: fn(&mut Machine, &[f64], Simulate<'_>) -> Outcome = simulate::<Machine>;
/// Many motions, eight at a time.
pub static ABREAST: fn(&mut [Wanted<'_>], Option<&AtomicBool>) -> Vec<Made> = abreast;
/// A motion once more, and which digits hold.
pub static CONFIRM: fn(&mut Machine, &[f64], &mut Simulate<'_>, &mut Dataset) = confirm::<Machine>;
/// The running of a cycle.
pub static RUNNING: fn(&mut Machine, &[f64], &Cycle) -> Result<Running, Fault> = running::<Machine>;
/// What only pushes over a cycle.
pub static OVER_CYCLE: fn(&mut Machine, &[f64], &Cycle, &[Push]) -> Remarks = over_cycle::<Machine>;
/// A motion in closed form.
pub static TRANSIENT: fn(&mut Machine, &Equations, &[f64], Transient<'_>) -> transient::Found = transient::<Machine>;
/// A periodic regime.
pub static PERIODIC: fn(&mut Machine, &[f64], &Periodic<'_>) -> periodic::Outcome = periodic::<Machine>;
/// Section points.
pub static POINCARE: fn(&mut Machine, &[f64], Poincare<'_>) -> Outcome = poincare::<Machine>;
/// What becomes of disturbances in the long run, and how many directions they have.
pub static LYAPUNOV: fn(&mut Machine, &[f64], &Options<'_>) -> InTheLongRun = lyapunov::<Machine>;
/// Hill's equation about a place of rest.
pub static STANDING: fn(&mut Machine, &[f64], f64) -> Hill = standing::<Machine>;
/// States that a motion passes.
pub static SAMPLES: fn(&mut Machine, &[f64], Draw) -> States = samples::<Machine>;

type InTheLongRun = Result<(Lyapunov, usize), Fault>;
type Hill = Result<Option<Scalar>, Fault>;
type States = Result<Vec<Vec<f64>>, Fault>;
type Remarks = Result<Vec<Text>, Fault>;
