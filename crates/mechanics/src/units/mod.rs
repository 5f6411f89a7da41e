//! Units at run time: dimensions with rational exponents, exact conversion factors, names in both alphabets.
//!
//! Angles are dimensionless in every check. A soft exponent of rad is carried along only to print `rad/s` where `1/s` would mislead.

mod dimension;
mod fit;
mod parse;
mod table;

pub use dimension::{Dimension, si_label, si_label_ru};
pub(crate) use fit::{complaint, in_field, mismatch, mismatch_of_number};
pub use parse::{Quantity, parse_angular_rate, parse_number_or_quantity, parse_quantity, parse_unit};
pub(crate) use parse::{bounded_decimal, doubtful_comma, is_quantity, out_of_range, superscript, written_unit};
pub use table::{Factor, Unit};
pub(crate) use table::{PREFIXES, in_russian, listed};
