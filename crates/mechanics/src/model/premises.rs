//! What of a model rests on numbers: which values may change without reading the file anew.
//!
//! Formulas hold symbols, never values; yet a reader looks at numbers, too: a mass must not be negative, a study ends at a time, a rod has a length. Every
//! expression whose number it looked at stands here with what was read off it. Where all of that is the same for other values of the parameters, another
//! reading would give the same model.

use rustc_hash::FxHashMap;
use symbolic::{Expr, Graph, SymbolId};

/// What was read off a number.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Reliance {
    /// The number itself.
    Value,
    /// Its sign.
    Sign,
    /// Whether it lies from 0 to 1, and that it is not zero.
    Share,
    /// That it is finite, and no zero by underflow.
    Finite,
}

/// An expression over constants and what was read off its number.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Premise {
    /// The expression.
    pub formula: Expr,
    /// What was read off it.
    pub reliance: Reliance,
}

impl Premise {
    /// Whether what was read off a number holds for another one.
    pub(super) fn holds(self, before: f64, after: f64) -> bool {
        let same = before.to_bits() == after.to_bits() || before.is_nan() && after.is_nan();
        match self.reliance {
            _ if same => true,
            Reliance::Value => false,
            Reliance::Sign => after.is_finite() && after != 0.0 && before != 0.0 && (after < 0.0) == (before < 0.0),
            Reliance::Share => [before, after].iter().all(|v| *v > 0.0 && *v <= 1.0),
            Reliance::Finite => after.is_finite() && after.abs() >= f64::MIN_POSITIVE,
        }
    }
}

/// Values of symbols; those without one are not a number.
pub type Values = FxHashMap<SymbolId, f64>;

/// Whether expressions have numbers, and the same ones for other values of their symbols.
pub fn unmoved(graph: &Graph, list: &[Expr], before: &Values, after: &Values) -> bool {
    let [before, after] = [before, after].map(|values| at(graph, list, values));
    before.iter().zip(&after).all(|(a, b)| a == b)
}

pub(super) fn at(graph: &Graph, list: &[Expr], values: &Values) -> Vec<f64> {
    graph.evaluate(list, &|s| values.get(&s).copied().unwrap_or(f64::NAN))
}

/// The numbers of a model's constants before and after a change.
#[derive(Clone, Debug, Default)]
pub struct Change {
    /// Before.
    pub before: Values,
    /// After.
    pub after: Values,
}
