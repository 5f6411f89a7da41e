//! Lowering: from the expression graph to tapes.

mod connections;
mod equations;
mod expressions;
mod forms;
mod inputs;
mod journals;
mod linkage;
mod numbers;
mod steps;
mod touches;

pub use connections::{Repeated, Selection};
pub use equations::{equations, equations_with};
pub use expressions::{Inputs, expressions};
pub use linkage::{Drive, LinkageRoots, linkage};
