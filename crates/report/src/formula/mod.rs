//! Printing of symbolic expressions and equations the way a textbook sets them.
//!
//! ```text
//! Expr --compose--> Layout --text / latex / mathml / typst--> String
//!         ^ names (`phi1` -> φ₁), order of factors and terms, signs, fractions, numbers
//! ```
//!
//! One layout serves the four writers, so the forms never disagree about order or signs. All choices of taste live in two files:
//! `order.rs` (what stands before what) and `product.rs` (signs, fractions, functions). Start with [`Printer::of`].

mod classes;
mod compose;
mod language;
mod latex;
mod layout;
mod lines;
mod mathml;
mod measure;
mod names;
mod numeral;
mod omml;
mod order;
mod pieces;
mod printed;
mod printer;
mod product;
mod set;
mod steps;
mod switch;
#[cfg(test)]
mod tests;
mod text;
mod typst;

pub use classes::SymbolClass;
pub(crate) use latex::greek;
pub use layout::{Bare, Bracket, Identifier, Index, Layout, Placement, Relation, Row, Shape, Sign};
pub(crate) use measure::width;
pub use numeral::value;
pub use printer::Printer;
pub use set::{Form, Formula};
pub use words::Language;

/// A math font for pages (WOFF2, 32 kB): without one, browsers lose the dots over letters and the growing brackets of MathML.
/// Name it `Strutt Math` in `@font-face` and use it as `math { font-family: "Strutt Math", math }`. Licence: SIL OFL 1.1, text in
/// `assets/math-font/LICENSE.txt`.
pub const MATH_FONT: &[u8] = include_bytes!("../../assets/math-font/strutt-math.woff2");
