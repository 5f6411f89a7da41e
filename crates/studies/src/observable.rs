//! A single number of a result: read once from the text that users write, taken from any [`Results`].

use crate::results::{Fact, Results};
use analysis::dataset::Event;
use analysis::marks::endless::endless;
use analysis::reduce::{NAMES, Reduction, reduce, within};
use mechanics::asked::observed::observed;
use serde_json::Value;
use std::fmt;
use words::Notice;

/// A number that a study gives.
#[derive(Clone, Debug, PartialEq)]
pub enum Observable {
    /// `max(x)`, `mean(x, 20 s, 30 s)`: made of a quantity over the motion, or over a list of places.
    Reduced(Reduced),
    /// `events`: how many there are.
    Events,
    /// `events(hit)`: how many of a named event, or changes of a contact, a rope or a friction.
    EventsOf(String),
    /// A number that the study names itself: `period`, `multipliers.1.abs`.
    Field(Field),
}

/// A number made of a quantity.
#[derive(Clone, Debug, PartialEq)]
pub struct Reduced {
    /// What is made of it.
    pub reduction: Reduction,
    /// The quantity.
    pub of: String,
    /// From, to, s; everywhere without it.
    pub window: Option<[f64; 2]>,
    /// As it is written.
    text: String,
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
    /// The study does not look between two instants.
    NoWindow,
    /// The motion ended before the window did, or the quantity has no value somewhere in it.
    Unfinished,
}

impl Observable {
    /// What a text means; an output by its bare name is both of its extremes. `is_output` says which names are outputs.
    ///
    /// # Errors
    /// M377: a window without two ascending instants.
    pub fn read(text: &str, is_output: &dyn Fn(&str) -> bool) -> Result<Vec<Observable>, Notice> {
        let found = observed(text)?;
        let text = text.trim();
        let reduction = found.word.and_then(|word| NAMES.iter().find(|(name, _)| *name == word));
        Ok(match reduction {
            Some((_, reduction)) => vec![Observable::made(*reduction, found.of, found.window, text.to_owned())],
            None if text == "events" => vec![Observable::Events],
            None if named(text).is_some() => named(text).into_iter().map(|name| Observable::EventsOf(name.to_owned())).collect(),
            None if is_output(text) => [Reduction::Max, Reduction::Min].map(|r| Observable::of_quantity(r, text)).into(),
            None => vec![Observable::field(text)],
        })
    }

    fn made(reduction: Reduction, of: String, window: Option<[f64; 2]>, text: String) -> Observable {
        // without a window one way of writing it is as good as another
        let text = if window.is_some() { text } else { format!("{}({of})", name(reduction)) };
        Observable::Reduced(Reduced { reduction, of, window, text })
    }

    /// A number made of a quantity over all of the motion.
    pub fn of_quantity(reduction: Reduction, of: &str) -> Observable {
        Observable::made(reduction, of.to_owned(), None, String::new())
    }

    /// A number by the name that the study gives it.
    pub fn field(text: &str) -> Observable {
        let step = |key: &str| key.parse().map_or_else(|_| Step::Name(key.to_owned()), Step::Place);
        Observable::Field(Field { text: text.to_owned(), steps: text.split('.').map(step).collect() })
    }

    /// What it is made of.
    pub fn reduced(&self) -> Option<&Reduced> {
        if let Observable::Reduced(reduced) = self { Some(reduced) } else { None }
    }

    /// The output that it is made of.
    pub fn column(&self) -> Option<&str> {
        self.reduced().map(|reduced| reduced.of.as_str())
    }

    /// A number of the study itself, as it is written.
    pub fn root(&self) -> Option<&str> {
        if let Observable::Field(field) = self { Some(&field.text) } else { None }
    }

    /// What is made of the output: `max`, `mean`; the whole name otherwise.
    pub fn word(&self) -> &str {
        match self {
            Observable::Reduced(reduced) => name(reduced.reduction),
            Observable::Events | Observable::EventsOf(_) => "events",
            Observable::Field(field) => &field.text,
        }
    }

    /// The number, SI; NaN where this result does not have what others of its study have.
    ///
    /// # Errors
    /// No result of the study has it.
    pub fn of(&self, results: &Results) -> Result<f64, Absent> {
        match self {
            Observable::Reduced(reduced) => reduced.of(results),
            Observable::Field(field) => field.of(results).ok_or(Absent::Nothing),
            Observable::Events => Ok(count(results, &|_| true)),
            Observable::EventsOf(name) => {
                let is = |event: &Event| event.name == *name || event.contact.as_ref().is_some_and(|change| change.contact == *name);
                Ok(count(results, &is))
            }
        }
    }
}

impl Reduced {
    fn of(&self, results: &Results) -> Result<f64, Absent> {
        let data = &results.data;
        let Some(window) = self.window else {
            return match reduce(data, &self.of, self.reduction) {
                // it was followed, and has no value
                None if data.overall(&self.of).is_some() => Err(Absent::Unfinished),
                None if data.axis.is_some() || data.column(&self.of).is_none() => Err(Absent::AtRowsOnly),
                found => Ok(found.unwrap_or(f64::NAN)),
            };
        };
        match within(data, &self.of, self.reduction, window).filter(|value| value.is_finite()) {
            Some(value) => Ok(value),
            None if data.windows.is_empty() => Err(Absent::NoWindow),
            None => Err(Absent::Unfinished),
        }
    }
}

/// How many events are such; without end where they go along with infinitely many impacts, of which only those above rounding are listed.
fn count(results: &Results, is: &dyn Fn(&Event) -> bool) -> f64 {
    let events = &results.data.events;
    if endless(events, is).is_some() { f64::INFINITY } else { events.iter().filter(|event| is(event)).count() as f64 }
}

/// The name in `events(name)`.
fn named(text: &str) -> Option<&str> {
    text.strip_prefix("events(")?.strip_suffix(')').map(str::trim).filter(|name| !name.is_empty())
}

/// The name of what is made of a quantity.
fn name(reduction: Reduction) -> &'static str {
    NAMES.iter().find(|(_, own)| *own == reduction).map_or("", |(name, _)| name)
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
        match self {
            Observable::Reduced(reduced) => f.write_str(&reduced.text),
            Observable::EventsOf(name) => write!(f, "events({name})"),
            _ => f.write_str(self.word()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    fn read(text: &str) -> Vec<Observable> {
        Observable::read(text, &|name| name == "phi").unwrap()
    }

    #[test]
    fn texts_become_observables_and_back() {
        for text in [
            "max(phi)",
            "min(phi)",
            "amplitude(phi)",
            "mean(phi)",
            "last(phi)",
            "events",
            "events(hit)",
            "period",
            "multipliers.1.abs",
            "mean(phi', 20 s, 30 s)",
        ] {
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
