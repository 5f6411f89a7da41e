//! Studies of whole machines, one file each: what the file and the command line ask becomes options of `analysis`, what comes back becomes
//! [`Results`].

// a study fails once: what it says may be large
#![allow(clippy::result_large_err)]

pub mod cycle;
pub mod inverse;
pub mod kinematics;
mod origin;
pub mod periodic;
mod results;
mod section;
pub mod statics;
pub mod sweep;

pub use origin::{Binding, Origin};
pub use results::{Fact, Results, Rows};
