//! How wide a formula becomes when it is set (MathML, LaTeX): an estimate from above, good enough to choose where to break it.

use super::layout::{Bare, Identifier, Layout};
use super::pieces::{Joint, Piece};

/// Em of one character of the text form, the unit in which callers state the width of a line.
const CHARACTER: f64 = 0.45;
/// Letters and digits, in em.
const LETTER: f64 = 0.56;
const DIGIT: f64 = 0.5;
/// Indices and exponents, relative to the line.
const SCRIPT: f64 = 0.72;
/// A binary sign or a relation with its spaces; a minus in front.
const SIGN: f64 = 1.25;
const MINUS: f64 = 0.8;
const BRACKETS: f64 = 0.75;
const THIN: f64 = 0.17;

/// Room of a piece, in characters of the text form.
pub(super) fn piece_length(piece: &Piece) -> usize {
    let joint = if piece.joint == Joint::Start { 0.0 } else { SIGN };
    let minus = if piece.minus { MINUS } else { 0.0 };
    ((joint + minus + width(piece.body)) / CHARACTER).ceil() as usize
}

/// Width of a layout on one line, em.
pub fn width(layout: &Layout) -> f64 {
    match layout {
        Layout::Number { mantissa, exponent } => {
            let power = exponent.map_or(0.0, |n| 1.6 + SCRIPT * DIGIT * n.to_string().len() as f64);
            DIGIT * count(mantissa) + power
        }
        Layout::Symbol(identifier) => symbol(identifier),
        Layout::Words(words) => DIGIT * count(words),
        Layout::Row(items) => items.iter().map(width).sum(),
        Layout::Sum(terms) => terms.iter().map(|(_, body)| SIGN + width(body)).sum::<f64>() - SIGN + MINUS,
        Layout::Product(factors) => factors.iter().map(|f| width(f) + THIN).sum(),
        Layout::Fraction(above, below) => width(above).max(width(below)) + 0.2,
        Layout::Power(base, exponent) => width(base) + SCRIPT * width(exponent),
        Layout::Exponential(argument) => DIGIT + SCRIPT * width(argument),
        Layout::Root { radicand, .. } => 0.9 + width(radicand),
        Layout::Fence(_, inner) => BRACKETS + width(inner),
        Layout::Call { name, power, argument, bare } => {
            let brackets = if *bare == Bare::Never { BRACKETS } else { THIN };
            DIGIT * count(name) + power.as_deref().map_or(0.0, |p| SCRIPT * DIGIT * count(p)) + brackets + width(argument)
        }
        Layout::List(items, _) => items.iter().map(|item| width(item) + 0.6).sum(),
        Layout::Related(left, _, right) => width(left) + SIGN + width(right),
        Layout::Cases(rows) => 2.0 + rows.iter().map(|row| width(&row.value) + 1.0 + width(&row.condition)).fold(0.0, f64::max),
    }
}

fn symbol(identifier: &Identifier) -> f64 {
    let index: f64 = identifier.subscript.iter().map(|i| count(&i.text)).sum();
    LETTER * count(&identifier.base) + SCRIPT * LETTER * index + 0.3 * identifier.raised_primes() as f64
}

fn count(text: &str) -> f64 {
    text.chars().count() as f64
}
