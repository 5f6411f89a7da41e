//! Variants of a model: a table as a course gives it, and the values that its rows and the formulas of the file make.

mod misfit;
mod table;
mod unit;
mod values;

pub use misfit::Misfit;
pub use table::Table;
pub use table::cells;
pub(crate) use unit::turned;
pub use unit::{in_unit, scale};
pub use values::{Given, Row, after_formulas, row, si, symbols};
