//! What of a model rests on numbers: which values may change without reading the file anew.
//!
//! Formulas hold symbols, never values; yet a reader looks at numbers, too: a mass must not be negative, a study ends at a time, a rod has a length. Every
//! expression whose number it looked at stands here with what was read off it. Where all of that is the same for other values of the parameters, another
//! reading would give the same model.

use super::{Class, Model, ParameterValue};
use rustc_hash::FxHashMap;
use symbolic::{Expr, Graph, Rational, SymbolId};

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
    fn holds(self, before: f64, after: f64) -> bool {
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

fn at(graph: &Graph, list: &[Expr], values: &Values) -> Vec<f64> {
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

impl Model {
    /// The numbers of all constants when some parameters get other values, SI. None where a name is no parameter with a number of its own, or where a
    /// value becomes, or was, zero: zeros switch parts of a machine off.
    pub fn change(&self, values: &[(&str, f64)]) -> Option<Change> {
        let mut change = Change::default();
        for p in self.parameters.iter().filter(|p| p.class == Class::Constant) {
            let before = p.number.unwrap_or(f64::NAN);
            let new = values.iter().find(|(name, _)| *name == p.name).map(|(_, value)| *value);
            let after = match (p.value, new) {
                (ParameterValue::Number { .. }, None) => before,
                (ParameterValue::Number { .. }, Some(new)) => Some(new).filter(|new| *new == before || *new * before != 0.0)?,
                (ParameterValue::Formula(_), Some(_)) => return None,
                (ParameterValue::Formula(formula), None) => at(&self.graph, &[formula], &change.after)[0],
            };
            change.before.insert(p.symbol, before);
            change.after.insert(p.symbol, after);
        }
        let known = |name: &str| self.parameters.iter().any(|p| p.name == name && p.class == Class::Constant);
        values.iter().all(|(name, value)| known(name) && value.is_finite()).then_some(change)
    }

    /// Whether reading the file with the numbers of a change gives this model, but for the numbers.
    pub fn allows(&self, change: &Change) -> bool {
        let formulas: Vec<Expr> = self.premises.iter().map(|p| p.formula).collect();
        let [before, after] = [&change.before, &change.after].map(|values| at(&self.graph, &formulas, values));
        self.premises.iter().zip(before.iter().zip(&after)).all(|(premise, (a, b))| premise.holds(*a, *b))
    }

    /// Gives the constants the numbers of a change. `written` is how the user would write a changed value: its exact value is that of this text's number.
    pub fn put(&mut self, change: &Change, written: &dyn Fn(&str, f64) -> String) {
        for i in 0..self.parameters.len() {
            let Some(after) = change.after.get(&self.parameters[i].symbol).copied() else { continue };
            if self.parameters[i].number == Some(after) {
                continue;
            }
            self.parameters[i].number = Some(after).filter(|a| a.is_finite());
            if let ParameterValue::Number { .. } = self.parameters[i].value
                && let Some(exact) = Rational::parse_decimal(&format!("{after:e}"))
            {
                let si = self.graph.number(exact);
                let text = written(&self.parameters[i].name, after);
                self.parameters[i].value = ParameterValue::Number { si };
                self.parameters[i].written = text;
            }
        }
    }
}
