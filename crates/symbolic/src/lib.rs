//! Symbolic core: a hash-consed graph of expressions with exact numbers, derivatives, textbook forms, and [`Equations`], the
//! hand-over from mechanics to numerics. It knows no bodies, no files, no output format.

mod build;
pub mod equations;
mod graph;
mod matrix;
mod rational;
mod text;

pub use equations::Equations;
pub use graph::{Expr, Function, Graph, Node, Symbol, SymbolId};
pub use matrix::Matrix;
pub use rational::Rational;
pub use text::Text;
