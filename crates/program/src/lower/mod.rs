//! Lowering: from the expression graph to tapes.

mod arrangement;
mod connections;
mod equations;
mod expressions;
mod forms;
mod guards;
mod inputs;
mod journals;
mod linkage;
mod numbers;
mod signs;
mod steps;
mod touches;

pub use arrangement::{Repeated, Selection};
pub use equations::{equations, equations_with};
pub use expressions::{Inputs, expressions};
pub use linkage::{Drive, LinkageRoots, linkage};
