//! What is asked of a flow, and what it did.

use words::Text;
use words::digits::number;
use words::limits::TOLERANCES;

use crate::Fault;
use crate::integrate::stiff::Method;

/// Options of a flow.
#[derive(Clone, Debug)]
pub struct Options {
    /// Error of a component within a step, relative to its change within the step. Default 1e-12.
    pub tolerance: f64,
    /// Order of the Taylor polynomials, the same for the whole run; when absent it follows from the tolerance and adapts to the motion.
    pub order: Option<usize>,
    /// Length of the run, s: a time scale for motions that have none of their own (polynomials of time), used only to judge what is small.
    /// Default 1.
    pub span: f64,
    /// Taylor series, the implicit method, or whichever is worth while. Default auto.
    pub method: Method,
    /// Whether steps are checked over their whole length; only a measurement of what that costs goes without.
    #[doc(hidden)]
    pub check: Check,
}

/// Whether a step is held against what its operations do inside it.
#[doc(hidden)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Check {
    /// It is.
    #[default]
    Whole,
    /// Only its last coefficients and its end count.
    Ends,
}

impl Default for Options {
    fn default() -> Options {
        // three digits above rounding: a long motion stays exact to what a page shows
        Options { tolerance: 1e-12, order: None, span: 1.0, method: Method::Auto, check: Check::Whole }
    }
}

/// Work done by a flow.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Work {
    /// Accepted steps.
    pub steps: u64,
    /// Steps taken back.
    pub rejected: u64,
    /// Steps shortened because an operation would have left its polynomial.
    pub shortened: u64,
    /// Expansions of the full order.
    pub expansions: u64,
    /// Expansions that ended with order 1, the rates: for the defect of steps that are taken back or end at an event.
    pub probes: u64,
    /// Changes of mode and impacts.
    pub switches: u64,
    /// Projections that changed the state.
    pub projections: u64,
    /// Sum of the orders of the accepted steps.
    pub orders: u64,
    /// Highest order.
    pub highest_order: usize,
    /// Those of the accepted steps that are implicit.
    pub implicit_steps: u64,
    /// Degree of their polynomials.
    pub stages: usize,
    /// Jacobians.
    pub jacobians: u64,
    /// Factorisations of a matrix of the size of the state.
    pub factorisations: u64,
    /// Newton iterations, each with the rates at all nodes of a step.
    pub newton: u64,
    /// Single rates for the defect between nodes.
    pub rates: u64,
}

impl Work {
    /// Mean order of the Taylor steps, 0 without any.
    pub fn mean_order(&self) -> f64 {
        let taylor = self.steps - self.implicit_steps;
        if taylor > 0 { self.orders as f64 / taylor as f64 } else { 0.0 }
    }
}

/// Refuses a tolerance that cannot be kept.
///
/// *Errors*: the tolerance, with its limits.
pub fn check_tolerance(tolerance: f64) -> Result<(), Fault> {
    if TOLERANCES.contains(&tolerance) {
        return Ok(());
    }
    let n = number(tolerance);
    Err(Fault::option(
        Text::new(
            format!(concat!("tolerance = {} is not between ", words::finest_tolerance!(), " and ", words::coarsest_tolerance!()), n.en),
            format!(concat!("точность {} не лежит между ", words::finest_tolerance!(), " и ", words::coarsest_tolerance!()), n.ru),
        ),
        Text::new("use 1e-12, or 1e-9 when speed matters", "используйте 1e-12 или, если важна скорость, 1e-9"),
    ))
}
