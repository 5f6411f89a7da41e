//! Units at run time: dimensions with rational exponents, exact conversion factors, names in both alphabets.
//!
//! Angles are dimensionless in every check. A soft exponent of rad is carried along only to print `rad/s` where `1/s` would mislead.

mod dimension;
mod parse;
mod table;

pub use dimension::{Dimension, si_label};
pub use parse::{Quantity, parse_number_or_quantity, parse_quantity, parse_unit};
pub(crate) use parse::{bounded_decimal, is_quantity, out_of_range, superscript};
pub(crate) use table::listed;
pub use table::{Factor, Unit};
