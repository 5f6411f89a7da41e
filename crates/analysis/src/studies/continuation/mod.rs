//! Regimes and places of rest along a parameter p: branches over their folds, what happens on them, and the branches that part there.
//!
//! ```text
//! R(u, p) = 0:                u a start and what it leads back to, or a place and its accelerations
//! t · (y - y0 - h t) = 0      y = (u, p), t tangent of the branch, h its step: folds are points like others (pseudo-arclength)
//! ```
//!
//! Between two points of a branch the signs of test functions are compared (`signs.rs`); where one changes, the point is located (`locate.rs`). A step that
//! turns too far, meets more than its test functions tell, or ends on another branch is halved (`curve.rs`). A branch ends with its reason.
//!
//! *Source*: H. B. Keller, Numerical solution of bifurcation and nonlinear eigenvalue problems (1977); E. J. Doedel, H. B. Keller, J. P. Kernévez,
//! Int. J. Bifurcation and Chaos 1 (1991) 493-520, 745-772; R. Seydel, Practical Bifurcation and Stability Analysis, 4-5, 7.

mod backbone;
mod branches;
mod collocation;
mod corrector;
mod crease;
mod curve;
mod diagram;
mod ground;
mod locate;
mod mesh;
mod neutral;
mod normal;
mod orbits;
mod places;
mod relay;
mod signs;
mod switching;
mod touching;
mod turning;
mod zeros;

pub use backbone::{Backbone, backbone};
pub use branches::{regimes, rests};
pub use curve::{Curve, End, Of};
pub use diagram::{Crease, Diagram, Options, Second, Work};
pub use locate::{Special, What};
pub use zeros::{Facts, Family, ON_BRANCH, Place};
