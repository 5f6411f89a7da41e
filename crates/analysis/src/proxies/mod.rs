//! Polynomials that stand for a quantity over a step, with a bound of what they leave out: see [`proxy`], and [`behind`] for how the operations behind the quantity
//! are looked at between the points.

pub mod behind;
pub(crate) mod points;
pub mod proxy;
