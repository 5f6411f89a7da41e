//! From equations to numbers: a flat tape, an interpreter, and Taylor coefficients.
//!
//! ```text
//! Equations --lower::equations--> Program (tapes) --Bound::new--> Bound (parameters in) --> Evaluator (a value), Jets (a series)
//! ```

mod fault;
mod guard;
mod interpret;
mod jets;
pub mod lower;
mod program;
mod solve;
mod tape;

pub use fault::{EXPLANATIONS, Fault};
pub use guard::{Guard, GuardKind, Mode};
pub use interpret::{Evaluator, Point};
pub use jets::Jets;
pub use program::{Bound, ENERGY, Program};
pub use tape::{By, Coefficient, Instruction, Operation, Real, Register, Root, Shape, Tape, Unary};
