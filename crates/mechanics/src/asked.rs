//! What a file may ask of its machine: kinds of studies with their keys, declared by whoever carries them out, and the values that a file gives.
//! This crate knows quantities, names and formulas; what a study does with them it does not know.

pub mod observed;
mod table;
mod values;

pub use table::STUDY;
pub use values::{FrequencyVariable, Plot, SweepRange, Times};

pub use crate::keys::Words;
use crate::keys::{Field, TableSpec, Type};
use crate::units::Dimension;
use std::ops::Range;
use symbolic::{Expr, SymbolId};
use words::Text;

/// A kind of study as whoever carries it out declares it.
#[derive(Clone, Copy, Debug)]
pub struct Kind {
    /// Name: `kind = "simulate"`, `strutt simulate`.
    pub name: &'static str,
    /// What it does, in a line of help.
    pub about: Words,
    /// Its keys.
    pub keys: &'static [Key],
    /// What the values contradict together.
    pub check: fn(&Asked) -> Vec<Objection>,
}

impl Kind {
    /// A kind without keys.
    pub const fn new(name: &'static str, about: Words) -> Kind {
        Kind { name, about, keys: &[], check: |_| Vec::new() }
    }
    /// With these keys.
    pub const fn keys(mut self, keys: &'static [Key]) -> Kind {
        self.keys = keys;
        self
    }
    /// With a check of the values together.
    pub const fn check(mut self, check: fn(&Asked) -> Vec<Objection>) -> Kind {
        self.check = check;
        self
    }
    /// The key of that name.
    pub fn key(&self, name: &str) -> Option<&'static Key> {
        self.keys.iter().find(|k| k.name == name)
    }
}

/// A key of a study.
#[derive(Clone, Copy, Debug)]
pub struct Key {
    /// Key in the file; an option outside has the same name with hyphens.
    pub name: &'static str,
    /// What its value is.
    pub takes: Takes,
    /// Whether it must be there.
    pub required: bool,
    /// What holds without it; empty when nothing.
    pub default: Words,
    /// Meaning.
    pub about: Words,
    /// An example, as written after `=`.
    pub example: &'static str,
    /// Another key that excludes it, with the code of the complaint.
    pub excluded: Option<(&'static str, &'static str)>,
    /// How it is given outside the file; none where only the file has it.
    pub option: Option<Line>,
}

/// A key as an option outside the file.
#[derive(Clone, Copy, Debug)]
pub struct Line {
    /// Its name where it is not that of the key.
    pub name: Option<&'static str>,
    /// Another name that means the same.
    pub also: Option<&'static str>,
    /// One line of help.
    pub help: Words,
    /// The word that a bare option stands for.
    pub sets: Option<&'static str>,
    /// Another option without which it means nothing.
    pub needs: Option<&'static str>,
    /// How its value comes to the study.
    pub way: Way,
}

/// How the value of an option comes to a study.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Way {
    /// In place of that of the file's study.
    Instead,
    /// It is written as in a file where a new study begins, otherwise in place of that of the file's study.
    Written,
    /// It begins a new study, which is written as in a file.
    Begins,
}

impl Key {
    /// A key that may be there.
    pub const fn new(name: &'static str, takes: Takes, about: Words, example: &'static str) -> Key {
        Key { name, takes, required: false, default: ("", ""), about, example, excluded: None, option: None }
    }
    /// It must be there.
    pub const fn required(mut self) -> Key {
        self.required = true;
        self
    }
    /// What holds without it.
    pub const fn default(mut self, en: &'static str, ru: &'static str) -> Key {
        self.default = (en, ru);
        self
    }
    /// Another key that excludes it, with the code of the complaint.
    pub const fn not_with(mut self, other: &'static str, code: &'static str) -> Key {
        self.excluded = Some((other, code));
        self
    }
    const fn line(mut self, name: Option<&'static str>, help: Words, sets: Option<&'static str>) -> Key {
        self.option = Some(Line { name, also: None, help, sets, needs: None, way: Way::Instead });
        self
    }
    /// Outside the file it is an option with this help.
    pub const fn option(self, en: &'static str, ru: &'static str) -> Key {
        self.line(None, (en, ru), None)
    }
    /// Outside the file it is a bare option that stands for a word.
    pub const fn flag(self, name: &'static str, word: &'static str, help: Words) -> Key {
        self.line(Some(name), help, Some(word))
    }
    /// Its option has another name, which its help says.
    pub const fn also(mut self, name: &'static str) -> Key {
        if let Some(line) = &mut self.option {
            line.also = Some(name);
        }
        self
    }
    /// Its option means nothing without another.
    pub const fn needs(mut self, other: &'static str) -> Key {
        if let Some(line) = &mut self.option {
            line.needs = Some(other);
        }
        self
    }
    /// How its option comes to the study.
    pub const fn way(mut self, way: Way) -> Key {
        if let Some(line) = &mut self.option {
            line.way = way;
        }
        self
    }
    /// The row of the reference.
    pub fn field(&self) -> Field {
        let (ty, dimension) = self.takes.described();
        Field { key: self.name, ty, dimension, required: self.required, default: self.default.0, about: self.about, example: self.example }
    }
}

/// Which numbers a key takes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Limits {
    /// Any.
    None,
    /// Not zero (M071).
    NotZero,
    /// Between 0 and 2, without both (M071).
    UpToTwo,
}

/// Of what dimension a quantity is.
#[derive(Clone, Copy, Debug)]
pub enum Like {
    /// Of this one.
    Is(Dimension, &'static str),
    /// That of the coordinate or parameter under another key.
    Of(&'static str),
    /// That of its rate.
    RateOf(&'static str),
}

/// Words of which one is meant.
#[derive(Clone, Copy, Debug)]
pub struct Choice {
    /// The words.
    pub words: &'static [&'static str],
    /// What stands for one of them in help: `METHOD`.
    pub metavar: &'static str,
    /// Code of the complaint about another word.
    pub code: &'static str,
    /// That complaint; `{}` is the word.
    pub unknown: Words,
    /// Its cure.
    pub help: Words,
}

/// What a key takes.
#[derive(Clone, Copy, Debug)]
pub enum Takes {
    /// End of a motion, s: positive in a file.
    End,
    /// Step of time, s: not more rows than fit up to the end under `until`.
    Step,
    /// Ascending times, s.
    Moments,
    /// A positive time, s.
    Duration,
    /// A time that may be zero, s.
    Wait,
    /// A pure number.
    Number(Limits),
    /// A relative tolerance of the integrator.
    Tolerance,
    /// A whole number from this least one to 1000000; the code of the complaint.
    Count(&'static str, usize),
    /// A quantity.
    Quantity(Like, Limits),
    /// true or false.
    Flag,
    /// One of several words.
    Word(&'static Choice),
    /// Name of a coordinate (M013).
    Coordinate,
    /// Name of a constant parameter that is looked for (M072).
    Sought,
    /// Name of a constant parameter that is changed step by step (M092).
    Varied,
    /// Any name.
    Name,
    /// Two quantities, the first smaller, of the dimension of what another key names.
    RangeOf(&'static str),
    /// The same, given apart from each other on the command line.
    Between(&'static str),
    /// Name of a parameter, a coordinate (its start) or a rate (its start), which is given other values.
    Changed,
    /// Two frequencies, the first smaller, rad/s.
    FrequencyRange,
    /// Frequencies, rad/s.
    Frequencies,
    /// Names of results.
    Results,
    /// Numbers of results, or one; those of formulas of the motion become results of the machine.
    Observed,
    /// Plots over time; names are results of a motion.
    Plots,
    /// Plots over what the study goes over; names may be results that only the study knows.
    OwnPlots,
    /// Values of coordinates by name.
    Guess,
    /// Formulas of the coordinate under another key, by coordinate.
    Driven(&'static str),
    /// The name of an angle, or a formula over coordinates, rates and time that passes zero from below.
    Section,
    /// Formulas over coordinates, rates and time.
    Formulas,
    /// `{ z = "m*k^2/c" }`.
    FrequencyVariable,
    /// Values of parameters, starts and starting rates.
    Ranges,
    /// A parameter, a start or a starting rate between two values: `m=2 g..60 g`.
    Stretch,
    /// Name of a kind of study that may be repeated.
    Repeatable,
}

impl Takes {
    /// What the value is in the reference, with the SI label of its dimension.
    pub fn described(self) -> (Type, &'static str) {
        match self {
            Takes::End | Takes::Step | Takes::Duration | Takes::Wait => (Type::Formula, "s"),
            Takes::Moments => (Type::Quantities, "s"),
            Takes::Number(_) | Takes::Tolerance | Takes::Count(..) => (Type::Formula, "1"),
            Takes::Quantity(Like::Is(_, unit), _) => (Type::Formula, unit),
            Takes::Quantity(..) | Takes::Section => (Type::Formula, ""),
            Takes::Flag => (Type::Bool, ""),
            Takes::Word(_) => (Type::String, ""),
            Takes::Coordinate | Takes::Sought | Takes::Varied | Takes::Changed | Takes::Name | Takes::Repeatable => (Type::Name, ""),
            Takes::RangeOf(_) | Takes::Between(_) => (Type::Quantities, ""),
            Takes::FrequencyRange | Takes::Frequencies => (Type::Quantities, "rad/s"),
            Takes::Results => (Type::Names, ""),
            Takes::Observed => (Type::NameOrNames, ""),
            Takes::Plots | Takes::OwnPlots => (Type::Plots, ""),
            Takes::Guess | Takes::Driven(_) | Takes::FrequencyVariable => (Type::Guess, ""),
            Takes::Formulas => (Type::Formulas, ""),
            Takes::Ranges | Takes::Stretch => (Type::Ranges, ""),
        }
    }
}

/// A coordinate by its name.
#[derive(Clone, Debug, PartialEq)]
pub struct Named {
    /// Its name.
    pub name: String,
    /// Its symbol.
    pub symbol: SymbolId,
    /// Its dimension.
    pub dimension: Option<Dimension>,
}

impl Named {
    /// Whether it is an angle.
    pub fn is_angle(&self) -> bool {
        self.dimension.as_ref().is_some_and(Dimension::is_angular)
    }
}

/// A formula with its text and the SI label of its value.
#[derive(Clone, Debug, PartialEq)]
pub struct Written {
    /// As it stands in the file.
    pub text: String,
    /// Over coordinates, rates, time and parameters.
    pub formula: Expr,
    /// SI label.
    pub unit: String,
}

/// A value; numbers are SI.
#[derive(Clone, Debug)]
pub enum Value {
    /// A number, a quantity, a count.
    Number(f64),
    /// Several.
    Numbers(Vec<f64>),
    /// true or false.
    Flag(bool),
    /// A name or a word.
    Word(String),
    /// Several.
    Words(Vec<String>),
    /// A coordinate.
    Coordinate(Named),
    /// Numbers by coordinate.
    Guess(Vec<(SymbolId, f64)>),
    /// Formulas by coordinate.
    Driven(Vec<(SymbolId, Expr)>),
    /// A formula.
    Formula(Expr),
    /// Formulas.
    Formulas(Vec<Written>),
    /// Unknown of the frequency equation.
    Variable(FrequencyVariable),
    /// Values of parameters.
    Ranges(Vec<SweepRange>),
    /// Plots.
    Plots(Vec<Plot>),
    /// Results between two instants, s; whoever repeats a motion asks for them.
    Windows(Vec<(String, [f64; 2])>),
}

/// A study as it is asked for.
#[derive(Clone, Debug, Default)]
pub struct Asked {
    /// Its kind.
    pub kind: &'static str,
    /// The values, by key.
    values: Vec<(&'static str, Value)>,
    /// Keys that are there, also those whose values are wrong.
    given: Vec<&'static str>,
    /// Place in the file.
    pub span: Range<usize>,
}

impl Asked {
    /// A study without any value.
    pub fn new(kind: &'static str) -> Asked {
        Asked { kind, ..Asked::default() }
    }
    /// Notes that a key is there.
    pub(crate) fn note(&mut self, key: &'static str) {
        if !self.has(key) {
            self.given.push(key);
        }
    }
    /// Puts a value in the place of an earlier one.
    pub fn set(&mut self, key: &'static str, value: Value) {
        self.note(key);
        match self.values.iter_mut().find(|(k, _)| *k == key) {
            Some((_, old)) => *old = value,
            None => self.values.push((key, value)),
        }
    }
    /// The same with a value.
    #[must_use]
    pub fn with(mut self, key: &'static str, value: Value) -> Asked {
        self.set(key, value);
        self
    }
    /// Takes a key away.
    pub fn unset(&mut self, key: &str) {
        self.values.retain(|(k, _)| *k != key);
        self.given.retain(|k| *k != key);
    }
    /// All values, in order.
    pub fn values(&self) -> &[(&'static str, Value)] {
        &self.values
    }
    /// Whether a key is there.
    pub fn has(&self, key: &str) -> bool {
        self.given.contains(&key)
    }
    /// A value.
    pub fn get(&self, key: &str) -> Option<&Value> {
        self.values.iter().find(|(k, _)| *k == key).map(|(_, value)| value)
    }
    /// A number, SI.
    pub fn number(&self, key: &str) -> Option<f64> {
        if let Some(Value::Number(value)) = self.get(key) { Some(*value) } else { None }
    }
    /// A whole number.
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)]
    pub fn count(&self, key: &str) -> Option<usize> {
        self.number(key).map(|n| n as usize)
    }
    /// Numbers, SI.
    pub fn numbers(&self, key: &str) -> Option<&[f64]> {
        if let Some(Value::Numbers(values)) = self.get(key) { Some(values) } else { None }
    }
    /// Whether a key is true.
    pub fn flag(&self, key: &str) -> bool {
        matches!(self.get(key), Some(Value::Flag(true)))
    }
    /// A name or a word.
    pub fn word(&self, key: &str) -> Option<&str> {
        if let Some(Value::Word(word)) = self.get(key) { Some(word) } else { None }
    }
    /// Names; none without the key.
    pub fn words(&self, key: &str) -> &[String] {
        if let Some(Value::Words(words)) = self.get(key) { words } else { &[] }
    }
    /// A coordinate.
    pub fn coordinate(&self, key: &str) -> Option<&Named> {
        if let Some(Value::Coordinate(named)) = self.get(key) { Some(named) } else { None }
    }
    /// Numbers by coordinate.
    pub fn guess(&self) -> &[(SymbolId, f64)] {
        if let Some(Value::Guess(guess)) = self.get("guess") { guess } else { &[] }
    }
    /// The plots wanted.
    pub fn plots(&self) -> &[Plot] {
        if let Some(Value::Plots(plots)) = self.get("plot") { plots } else { &[] }
    }
    /// Results between two instants.
    pub fn windows(&self) -> &[(String, [f64; 2])] {
        if let Some(Value::Windows(windows)) = self.get("windows") { windows } else { &[] }
    }
    /// The times wanted.
    pub fn times(&self) -> Times {
        match (self.numbers("at"), self.number("every")) {
            (Some(at), _) => Times::At(at.to_vec()),
            (None, Some(step)) => Times::Every(step),
            (None, None) => Times::Automatic,
        }
    }
}

/// What values contradict together.
#[derive(Clone, Debug)]
pub struct Objection {
    /// Code of the explanation.
    pub code: &'static str,
    /// At which key; none for the study as a whole.
    pub at: Option<&'static str>,
    /// What is wrong.
    pub what: Text,
    /// The likely cause; may be empty.
    pub why: Text,
    /// The cure; may be empty.
    pub help: Text,
}

impl Objection {
    /// At a key.
    pub fn at(key: &'static str, code: &'static str, en: impl Into<String>, ru: impl Into<String>) -> Objection {
        Objection { at: Some(key), ..Objection::whole(code, en, ru) }
    }
    /// About the study as a whole.
    pub fn whole(code: &'static str, en: impl Into<String>, ru: impl Into<String>) -> Objection {
        Objection { code, at: None, what: Text::new(en, ru), why: Text::default(), help: Text::default() }
    }
    /// With the likely cause.
    pub fn why(mut self, en: impl Into<String>, ru: impl Into<String>) -> Objection {
        self.why = Text::new(en, ru);
        self
    }
    /// With the cure.
    pub fn help(mut self, en: impl Into<String>, ru: impl Into<String>) -> Objection {
        self.help = Text::new(en, ru);
        self
    }
    /// A key that needs an angle.
    pub fn no_angle(key: &'static str) -> Objection {
        Objection::at(key, "M071", format!("`{key}` needs an angle"), format!("ключу `{key}` нужен угол"))
            .why("only an angle makes turns", "обороты совершает только угол")
    }
}

/// The kinds of studies that a reading knows.
#[derive(Debug)]
pub struct Kinds {
    /// In the order of messages and of the reference.
    pub list: Vec<&'static Kind>,
    /// Names of those that a study which repeats another may name.
    pub repeated: Vec<&'static str>,
    /// All their keys, as one table of the file.
    pub(crate) spec: &'static TableSpec,
}

impl Kinds {
    /// Made once for the life of the program: what the reader knows of tables is static.
    pub fn new(list: Vec<&'static Kind>, repeated: Vec<&'static str>) -> Kinds {
        let mut fields: Vec<Field> = STUDY.fields.to_vec();
        for key in list.iter().flat_map(|kind| kind.keys) {
            if !fields.iter().any(|f| f.key == key.name) {
                // whether it must be there is a matter of the kind
                fields.push(Field { required: false, ..key.field() });
            }
        }
        let spec = TableSpec { fields: Box::leak(fields.into_boxed_slice()), ..STUDY };
        Kinds { list, repeated, spec: Box::leak(Box::new(spec)) }
    }
    /// The kind of that name.
    pub fn find(&self, name: &str) -> Option<&'static Kind> {
        self.list.iter().find(|kind| kind.name == name).copied()
    }
}
