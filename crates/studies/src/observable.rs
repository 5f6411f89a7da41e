//! A single number of a result: read once from the text that users write, taken from any [`Results`].

use crate::results::{Fact, Results};
use analysis::reduce::{Reduction, reduce};
use serde_json::Value;
use std::fmt;

/// Which end of a range.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// Least value.
    Least,
    /// Greatest value.
    Greatest,
}

/// A number that a study gives.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Observable {
    /// `max(x)`, `min(x)`: an extreme of an output over the motion, or of a list of places.
    Extreme(Side, String),
    /// `amplitude(x)`: half the distance of both extremes.
    Amplitude(String),
    /// `mean(x)`: over the axis.
    Mean(String),
    /// `last(x)`: at the end.
    Last(String),
    /// `events`: how many there are.
    Events,
    /// A number that the study names itself: `period`, `multipliers.1.abs`.
    Field(Field),
}

/// A number among the named ones of a study.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Field {
    /// As it is written.
    text: String,
    /// The same step by step.
    steps: Vec<Step>,
}

/// One step into an object or a list.
#[derive(Clone, Debug, PartialEq, Eq)]
enum Step {
    Name(String),
    /// Lists count from 0.
    Place(usize),
}

/// Why there is no number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Absent {
    /// The study knows the quantity at its rows only, or not at all.
    AtRowsOnly,
    /// The study has nothing of this name.
    Nothing,
}

impl Observable {
    /// What a text means; an output by its bare name is both of its extremes. `is_output` says which names are outputs.
    pub fn read(text: &str, is_output: &dyn Fn(&str) -> bool) -> Vec<Observable> {
        let text = text.trim();
        let of = |make: &dyn Fn(String) -> Observable, name: &str| vec![make(name.trim().to_owned())];
        match text.strip_suffix(')').and_then(|t| t.split_once('(')) {
            Some(("max", name)) => of(&|n| Observable::Extreme(Side::Greatest, n), name),
            Some(("min", name)) => of(&|n| Observable::Extreme(Side::Least, n), name),
            Some(("amplitude", name)) => of(&Observable::Amplitude, name),
            Some(("mean", name)) => of(&Observable::Mean, name),
            Some(("last", name)) => of(&Observable::Last, name),
            _ if text == "events" => vec![Observable::Events],
            _ if is_output(text) => [Side::Greatest, Side::Least].map(|side| Observable::Extreme(side, text.to_owned())).into(),
            _ => vec![Observable::field(text)],
        }
    }

    /// A number by the name that the study gives it.
    pub fn field(text: &str) -> Observable {
        let step = |key: &str| key.parse().map_or_else(|_| Step::Name(key.to_owned()), Step::Place);
        Observable::Field(Field { text: text.to_owned(), steps: text.split('.').map(step).collect() })
    }

    /// The output that it is made of.
    pub fn column(&self) -> Option<&str> {
        self.reduced().map(|(name, _)| name)
    }

    /// A number of the study itself, as it is written.
    pub fn root(&self) -> Option<&str> {
        if let Observable::Field(field) = self { Some(&field.text) } else { None }
    }

    /// What is made of the output: `max`, `mean`; the whole name otherwise.
    pub fn word(&self) -> &str {
        match self {
            Observable::Extreme(Side::Greatest, _) => "max",
            Observable::Extreme(Side::Least, _) => "min",
            Observable::Amplitude(_) => "amplitude",
            Observable::Mean(_) => "mean",
            Observable::Last(_) => "last",
            Observable::Events => "events",
            Observable::Field(field) => &field.text,
        }
    }

    fn reduced(&self) -> Option<(&str, Reduction)> {
        match self {
            Observable::Extreme(Side::Greatest, name) => Some((name, Reduction::Max)),
            Observable::Extreme(Side::Least, name) => Some((name, Reduction::Min)),
            Observable::Amplitude(name) => Some((name, Reduction::Amplitude)),
            Observable::Mean(name) => Some((name, Reduction::Mean)),
            Observable::Last(name) => Some((name, Reduction::Last)),
            Observable::Events | Observable::Field(_) => None,
        }
    }

    /// The number, SI; NaN where this result does not have what others of its study have.
    ///
    /// # Errors
    /// No result of the study has it.
    pub fn of(&self, results: &Results) -> Result<f64, Absent> {
        if let Some((name, reduction)) = self.reduced() {
            return match reduce(&results.data, name, reduction) {
                None if results.data.axis.is_some() || results.data.column(name).is_none() => Err(Absent::AtRowsOnly),
                found => Ok(found.unwrap_or(f64::NAN)),
            };
        }
        match self {
            Observable::Field(field) => field.of(results).ok_or(Absent::Nothing),
            _ => Ok(results.data.events.len() as f64),
        }
    }
}

impl Field {
    /// The fact of that name.
    pub fn fact<'r>(&self, results: &'r Results) -> Option<&'r Fact> {
        results.facts.iter().find(|fact| fact.quantity.name == self.text)
    }

    /// True is 1, false 0, nothing no number.
    fn of(&self, results: &Results) -> Option<f64> {
        let whole = || results.own.get(&self.text).and_then(number);
        let fact = || self.fact(results).map(|fact| if fact.value.is_finite() { fact.value } else { f64::NAN });
        whole().or_else(fact).or_else(|| self.inside(results))
    }

    fn inside(&self, results: &Results) -> Option<f64> {
        let (first, rest) = self.steps.split_first()?;
        let Step::Name(first) = first else { return None };
        let mut found = results.own.get(first)?;
        for step in rest {
            found = match step {
                Step::Name(name) => found.get(name)?,
                Step::Place(place) => found.get(*place)?,
            };
        }
        number(found)
    }
}

fn number(found: &Value) -> Option<f64> {
    match found {
        Value::Null => Some(f64::NAN),
        Value::Bool(flag) => Some(f64::from(u8::from(*flag))),
        found => found.as_f64(),
    }
}

impl fmt::Display for Observable {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.column() {
            Some(name) => write!(f, "{}({name})", self.word()),
            None => f.write_str(self.word()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    fn read(text: &str) -> Vec<Observable> {
        Observable::read(text, &|name| name == "phi")
    }

    #[test]
    fn texts_become_observables_and_back() {
        for text in ["max(phi)", "min(phi)", "amplitude(phi)", "mean(phi)", "last(phi)", "events", "period", "multipliers.1.abs"] {
            let found = read(text);
            assert_eq!(found.iter().map(ToString::to_string).collect::<Vec<_>>(), [text]);
        }
        assert_eq!(read(" phi ").iter().map(ToString::to_string).collect::<Vec<_>>(), ["max(phi)", "min(phi)"]);
        // a reaction is a number of `statics`
        assert!(matches!(&read("force(A)")[..], [Observable::Field(_)]));
    }

    #[test]
    fn fields_are_found_step_by_step() {
        let mut results = Results::default();
        results.own.insert("multipliers".into(), json!([{"abs": 0.5}, {"abs": 0.25, "real": null}]));
        results.own.insert("stable".into(), json!(true));
        let value = |text: &str| Observable::field(text).of(&results);
        assert_eq!(value("multipliers.1.abs"), Ok(0.25));
        assert_eq!(value("stable"), Ok(1.0));
        assert!(value("multipliers.1.real").is_ok_and(f64::is_nan));
        assert_eq!(value("multipliers.2.abs"), Err(Absent::Nothing));
    }
}
