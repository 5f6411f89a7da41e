//! Stiff motions: collocation at Radau's nodes, whose polynomial is the dense output.
//!
//! A step of length h looks for the polynomial u of degree s with u(t) = x and
//!
//! ```text
//! u'(t + c_i h) = f(t + c_i h, u(t + c_i h))     i = 1 ... s
//! ```
//!
//! Damping that is fast beside the motion does not limit h: the method is L-stable. What limits it is whether u follows the motion *over its whole
//! length*, because outputs and events are read from u everywhere, not only at the end, where the order is 2s - 1. So a step is accepted on the decay of
//! the Legendre coefficients of u, by the same majorant as in the Taylor integrator (`taylor/length.rs`), on the equations halfway between the nodes
//! (`defect.rs`), on both for the guards, and on what the operations of the equations do between all these points (`seen.rs`). The number of stages follows from the tolerance: 13 at 1e-12.
//!
//! *Source*: E. Hairer, G. Wanner, Solving Ordinary Differential Equations II, Springer 1996, IV.8; the control of the whole polynomial is ours.

mod collocation;
mod defect;
mod dense;
mod newton;
mod nodes;
pub mod radau;
mod scales;
mod seen;

pub(crate) use collocation::{Collocation, Verdict};
pub(crate) use nodes::Base;

/// How a motion is integrated.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Method {
    /// Taylor series; the implicit method where it is worth while.
    #[default]
    Auto,
    /// Taylor series only.
    Taylor,
    /// The implicit method, except for the first step after an event.
    Stiff,
}

impl Method {
    /// The methods with their names in files and on the command line.
    pub const ALL: [(Method, &'static str); 3] = [(Method::Auto, "auto"), (Method::Taylor, "taylor"), (Method::Stiff, "stiff")];

    /// Its name.
    pub fn name(self) -> &'static str {
        Method::ALL.iter().find(|row| row.0 == self).map_or("", |row| row.1)
    }

    /// The method of that name.
    pub fn named(name: &str) -> Option<Method> {
        Method::ALL.iter().find(|row| row.1 == name).map(|row| row.0)
    }
}
