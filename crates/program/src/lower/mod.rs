//! Lowering: from the expression graph to tapes.

pub(crate) mod builder;
mod equations;
mod expressions;
mod forms;

pub use equations::equations;
pub use expressions::{Inputs, expressions};
