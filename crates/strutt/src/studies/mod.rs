//! Studies of whole machines, one file each: what the file and the command line ask becomes options of `analysis`, what comes back becomes
//! [`Results`].

pub mod cycle;
pub mod inverse;
mod origin;
pub mod periodic;
mod results;
mod section;
pub mod statics;
pub mod sweep;

pub use origin::Origin;
pub use results::{Fact, Results, Rows};
