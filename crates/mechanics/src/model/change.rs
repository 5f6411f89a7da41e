//! Other numbers for the constants of a model that was read: whether they may be put into it, and putting them.

use super::premises::{Values, at};
use super::{Change, Class, Model, ParameterValue};
use symbolic::{Expr, Rational};

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

    /// The expressions of which the reader took exactly this number: one where a single formula stands behind it.
    pub fn formulas_of(&self, value: f64) -> Vec<Expr> {
        let values = self.numbers();
        let mut list: Vec<Expr> = self.premises.iter().map(|p| p.formula).collect();
        list.dedup();
        let found = at(&self.graph, &list, &values);
        let mut formulas: Vec<Expr> = list.into_iter().zip(found).filter(|(_, v)| v.to_bits() == value.to_bits()).map(|(e, _)| e).collect();
        formulas.sort_unstable();
        formulas.dedup();
        formulas
    }

    /// The number of an expression over constants with the values that they have now.
    pub fn number_of(&self, formula: Expr) -> f64 {
        at(&self.graph, &[formula], &self.numbers())[0]
    }

    fn numbers(&self) -> Values {
        self.parameters.iter().filter_map(|p| Some((p.symbol, p.number?))).collect()
    }

    /// Forgets the studies: other values of parameters then need no reading anew for what only they take of numbers.
    pub fn forget_studies(&mut self) {
        self.studies.clear();
        let own = std::mem::take(&mut self.of_studies);
        self.premises.retain(|p| !own.contains(p));
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
