//! The result of a study: named columns with units, audits, events, provenance. It knows no output format.

use algebra::arrange::Arrange;
use words::Text;

use crate::Quantity;

/// A row may lie outside the extremes by this share of them: both come from the same formulas, by different ways through a step.
const BESIDE: f64 = 1e-6;

/// Result of a study.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Dataset {
    /// Where the numbers come from.
    pub provenance: Provenance,
    /// Index of the column that is the axis of the others (time), if there is one.
    pub axis: Option<usize>,
    /// Columns, all of one length.
    pub columns: Vec<Column>,
    /// Checks made on the result.
    pub audits: Vec<Audit>,
    /// Names of the states in the events.
    pub states: Vec<String>,
    /// What happened along the axis.
    pub events: Vec<Event>,
    /// Contacts and frictions, and what they do at the start.
    pub contacts: Vec<Standing>,
    /// Least and greatest values of the motion itself, not of its rows.
    pub extremes: Vec<Extreme>,
    /// Integrals along the axis and last values, of the motion too.
    pub overall: Vec<Overall>,
    /// The same between instants that were asked for.
    pub windows: Vec<Windowed>,
    /// Works that impulses do in impacts and jumps of prescribed rates at the outputs whose works are asked for, J; no number where they are not unique.
    pub struck: Vec<f64>,
    /// What a repetition with other steps confirms.
    pub digits: Option<Digits>,
    /// Rounding of the columns where it was measured, SI: smaller values are zero.
    pub rounding: Vec<f64>,
    /// Work done, by name: steps, evaluations.
    pub counters: Vec<Counter>,
    /// Remarks to show beside the result.
    pub notes: Vec<Text>,
    /// The way of the motion, for pictures.
    pub trail: Trail,
    /// What values of columns mean that are no finite numbers; any other such value is an error of the study.
    pub stated: Vec<Stated>,
    /// Why rows have no numbers: their index, and what is wrong there.
    pub reasons: Vec<(usize, Text)>,
    /// Columns of words, behind those of numbers.
    pub labels: Vec<Labels>,
    /// Whether the study was interrupted or ended by a fault, so that the result is a part of what was asked.
    pub partial: bool,
}

/// States along a motion, closer than the rows of a table where it is quick; for pictures, not for numbers: what is said of a motion comes from its columns.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Trail {
    /// Names of the states.
    pub names: Vec<String>,
    /// Times, or values of the axis, ascending.
    pub times: Vec<f64>,
    /// States, SI, time by time.
    pub states: Vec<f64>,
}

impl Trail {
    /// The states at a time.
    pub fn row(&self, k: usize) -> &[f64] {
        let n = self.names.len();
        &self.states[k * n..(k + 1) * n]
    }
}

/// Model and program behind a result.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Provenance {
    /// Title of the model.
    pub title: Text,
    /// Version of strutt.
    pub version: String,
    /// Hash of the model file.
    pub model_hash: String,
    /// Values of the parameters.
    pub parameters: Vec<ParameterValue>,
}

/// A parameter and its number, SI.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ParameterValue {
    /// Name, symbol, unit, label.
    pub quantity: Quantity,
    /// As the user wrote it.
    pub written: String,
    /// The number, SI.
    pub value: f64,
}

/// A named column.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Column {
    /// Name, symbol, unit, label.
    pub quantity: Quantity,
    /// Values, SI.
    pub values: Vec<f64>,
}

/// A column of words, such as names of regimes.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Labels {
    /// Its name.
    pub name: String,
    /// The words.
    pub words: Vec<String>,
    /// Which of them each row has.
    pub rows: Vec<usize>,
}

/// What the values of a column mean that are no finite numbers.
#[derive(Clone, Debug, PartialEq)]
pub struct Stated {
    /// Name of the column.
    pub column: String,
    /// Which values.
    pub missing: Missing,
    /// What they say.
    pub words: Text,
}

/// Kinds of values that are no finite numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Missing {
    /// Not a number: there is no such quantity here. Empty in tables and files.
    Absent,
    /// Infinite: it grows beyond all bounds.
    Unbounded,
}

impl Missing {
    /// Name in files.
    pub fn key(self) -> &'static str {
        match self {
            Missing::Absent => "absent",
            Missing::Unbounded => "unbounded",
        }
    }
    fn fits(self, value: f64) -> bool {
        match self {
            Missing::Absent => value.is_nan(),
            Missing::Unbounded => value.is_infinite(),
        }
    }
}

/// A check of a result.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Audit {
    /// Name in machine-readable output: `power_balance`.
    pub key: String,
    /// Name for people.
    pub name: Text,
    /// What was found.
    pub value: f64,
    /// What is allowed.
    pub limit: f64,
    /// Whether the check holds.
    pub ok: bool,
}

impl Audit {
    /// A check that a value does not exceed its limit; a value that is not a number fails.
    pub fn at_most(key: &str, name: Text, value: f64, limit: f64) -> Audit {
        Audit { key: key.into(), name, value, limit, ok: value <= limit }
    }
}

/// Least and greatest value of a column, and where on the axis they are taken first.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Extreme {
    /// Index of the column.
    pub column: usize,
    /// Least value, SI.
    pub min: f64,
    /// Its place on the axis: the instant in s, or the driven coordinate.
    pub t_min: f64,
    /// Greatest value, SI.
    pub max: f64,
    /// Its place on the axis.
    pub t_max: f64,
}

/// A column over the whole motion.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Overall {
    /// Index of the column.
    pub column: usize,
    /// ∫ f over the axis, SI.
    pub integral: f64,
    /// Length of the axis.
    pub span: f64,
    /// Value at the beginning; rows may begin later.
    pub first: f64,
    /// Value at the end.
    pub last: f64,
}

/// Least, greatest and mean values between two instants.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Windowed {
    /// From, to, s.
    pub between: [f64; 2],
    /// The quantities; they are counted from 1, as columns behind an axis are.
    pub columns: Vec<Quantity>,
    /// Extremes; empty when the motion ended before the window did.
    pub extremes: Vec<Extreme>,
    /// Integrals; empty when the motion ended before the window did.
    pub overall: Vec<Overall>,
}

impl Overall {
    /// Mean over the axis; the last value where that has no length.
    pub fn mean(&self) -> f64 {
        if self.span > 0.0 { self.integral / self.span } else { self.last }
    }
}

/// How far a motion and its repetition agree.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Digits {
    /// Tolerance of the repetition.
    pub tolerance: f64,
    /// Order of the repetition.
    pub order: usize,
    /// Columns other than the axis.
    pub columns: Vec<Held>,
}

/// Agreement of one column.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Held {
    /// Index of the column.
    pub column: usize,
    /// Digits of its largest value in which all rows agree, at most 15.
    pub digits: i32,
    /// Deviations of the first value, the least, the greatest and the last, SI.
    pub deviations: [f64; 4],
    /// Deviations of the instants of the least and the greatest value, s.
    pub instants: [f64; 2],
    /// First row time at which fewer than four digits are left.
    pub lost: Option<f64>,
    /// Values up to this size are zero but for rounding, SI.
    pub noise: f64,
}

/// Something that happened at an instant.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Event {
    /// When.
    pub t: f64,
    /// The user's name of it; empty for a switch.
    pub name: String,
    /// What, for people.
    pub what: Text,
    /// Index of the guard.
    pub guard: usize,
    /// Signs of the guard before and after.
    pub sides: [f64; 2],
    /// State just before and just after; an impact changes rates.
    pub states: [Vec<f64>; 2],
    /// Selected outputs just before and just after.
    pub outputs: [Vec<f64>; 2],
    /// What became of a contact or a friction; none for other switches.
    pub contact: Option<ContactChange>,
    /// Impulses of reactions where rates jump, once an instant.
    pub impulses: Vec<Impulse>,
}

/// The impulse of a reaction.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Impulse {
    /// The reaction as users write it: `force_x(O)`.
    pub name: String,
    /// SI unit.
    pub unit: String,
    /// SI value.
    pub value: f64,
}

/// A contact or a friction.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Standing {
    /// The user's name of it.
    pub contact: String,
    /// What it is and its name, for people.
    pub label: Text,
    /// At the start, in the words of [`ContactChange::from`].
    pub at_start: &'static str,
    /// Its guard: that of its events.
    pub guard: usize,
    /// Guards of the contacts that alone press a friction: while all are open there is none.
    pub pressed: Vec<usize>,
    /// Whether it is a friction.
    pub friction: bool,
}

/// A change of a contact or a friction.
#[derive(Clone, Debug, PartialEq)]
pub struct ContactChange {
    /// The user's name of it.
    pub contact: String,
    /// Before: `open`, `closed`, `slack`, `taut`, `sticking`, `forward`, `backward`, `pushes`.
    pub from: &'static str,
    /// After.
    pub to: &'static str,
    /// Impulse of an impact, N s or N m s.
    pub impulse: Option<f64>,
    /// Whether it stands for infinitely many impacts, of which those before it are the first.
    pub endless: bool,
}

/// A counter of work.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Counter {
    /// Machine name: `steps`.
    pub key: &'static str,
    /// Name for people.
    pub name: Text,
    /// Value.
    pub value: f64,
}

impl Dataset {
    /// Column with a name.
    pub fn column(&self, name: &str) -> Option<&Column> {
        self.columns.iter().find(|c| c.quantity.name == name)
    }
    /// Names of the columns, each once: a later column with the name of an earlier one is `f.1`, the next `f.2` (a coordinate `f` beside the frequency).
    pub fn names(&self) -> Vec<String> {
        let mut names: Vec<String> = Vec::with_capacity(self.columns.len());
        let own: std::collections::HashSet<&str> = self.columns.iter().map(|c| c.quantity.name.as_str()).collect();
        let mut seen = std::collections::HashMap::new();
        for column in &self.columns {
            let name = column.quantity.name.as_str();
            let count: &mut usize = seen.entry(name).or_default();
            let mut distinct = if *count == 0 { name.to_owned() } else { format!("{name}.{count}") };
            while *count > 0 && own.contains(distinct.as_str()) {
                *count += 1;
                distinct = format!("{name}.{count}");
            }
            *count += 1;
            names.push(distinct);
        }
        names
    }
    /// Value of a counter.
    pub fn counter(&self, key: &str) -> Option<f64> {
        self.counters.iter().find(|c| c.key == key).map(|c| c.value)
    }
    /// The table with two rows more at every switch: the columns just before and just after it.
    pub fn with_switches(&self) -> Dataset {
        let Some(axis) = self.axis else { return self.clone() };
        let mut rows: Vec<Vec<f64>> = (0..self.columns[axis].values.len())
            .map(|k| self.columns.iter().map(|c| c.values.get(k).copied().unwrap_or(f64::NAN)).collect())
            .collect();
        for event in self.events.iter().filter(|e| e.name.is_empty()) {
            for side in &event.outputs {
                let mut values = side.iter().copied();
                let row = (0..self.columns.len()).map(|i| if i == axis { event.t } else { values.next().unwrap_or(f64::NAN) });
                rows.push(row.collect());
            }
        }
        // stable: before stays before after, and rows of the table at the same instant stand first
        rows.arrange_by(|a, b| a[axis].total_cmp(&b[axis]));
        let column = |(i, c): (usize, &Column)| Column { values: rows.iter().map(|row| row[i]).collect(), ..c.clone() };
        Dataset { columns: self.columns.iter().enumerate().map(column).collect(), ..self.clone() }
    }
    /// Leaves out columns; what speaks of the others by their index follows. Values at events stand beside all columns but the axis.
    pub fn keep_columns(&mut self, keep: impl FnMut(&Column) -> bool) {
        let kept: Vec<bool> = self.columns.iter().map(keep).collect();
        let moved = |i: usize| kept.get(i).filter(|k| **k).map(|_| kept[..i].iter().filter(|k| **k).count());
        let outputs: Vec<bool> = (0..kept.len()).filter(|i| Some(*i) != self.axis).map(|i| kept[i]).collect();
        for side in self.events.iter_mut().flat_map(|e| &mut e.outputs) {
            let mut at = outputs.iter();
            side.retain(|_| at.next().is_none_or(|k| *k));
        }
        let mut at = kept.iter();
        self.columns.retain(|_| at.next().is_none_or(|k| *k));
        self.axis = self.axis.and_then(moved);
        self.extremes.retain_mut(|e| moved(e.column).map(|i| e.column = i).is_some());
        self.overall.retain_mut(|o| moved(o.column).map(|i| o.column = i).is_some());
        let mut at = kept.iter();
        self.rounding.retain(|_| at.next().is_none_or(|k| *k));
        if let Some(digits) = &mut self.digits {
            digits.columns.retain_mut(|h| moved(h.column).map(|i| h.column = i).is_some());
        }
    }
    /// Name of a column of which a row lies outside its extremes, by more than rounding: the extremes belong to another column.
    pub fn outside_extremes(&self) -> Option<&str> {
        let outside = |e: &&Extreme| {
            let Some(column) = self.columns.get(e.column) else { return true };
            let size = e.min.abs().max(e.max.abs());
            let beyond = |v: &f64| {
                v.is_finite() && (*v < e.min - BESIDE * size - f64::MIN_POSITIVE || *v > e.max + BESIDE * size + f64::MIN_POSITIVE)
            };
            column.values.iter().any(beyond)
        };
        let name = |e: &Extreme| self.columns.get(e.column).map_or("extremes", |c| c.quantity.name.as_str());
        self.extremes.iter().find(outside).map(name)
    }
    /// Says what values of a column mean that are no finite numbers; nothing where the column has none of that kind.
    pub fn state(&mut self, column: &str, missing: Missing, words: Text) {
        if self.misses(column, missing) {
            self.stated.push(Stated { column: column.into(), missing, words });
        }
    }
    /// Whether a row of the column or a value at an event is missing so.
    fn misses(&self, column: &str, missing: Missing) -> bool {
        let outputs = (0..self.columns.len()).filter(|i| Some(*i) != self.axis);
        let place = outputs.map(|i| self.columns[i].quantity.name.as_str()).position(|name| name == column);
        let at_events = || self.events.iter().flat_map(|e| &e.outputs).filter_map(|side| side.get(place?)).any(|v| missing.fits(*v));
        self.column(column).is_some_and(|c| c.values.iter().any(|v| missing.fits(*v))) || at_events()
    }
    /// Whether the result says what this value of a column means: a finite number, or one that is stated.
    pub fn explains(&self, column: &str, value: f64) -> bool {
        value.is_finite() || self.stated.iter().any(|s| s.column == column && s.missing.fits(value))
    }
    /// Name of a number that is infinite or undefined without a word: of a column, a value at an event, an extreme, a counter.
    pub fn unexplained(&self) -> Option<&str> {
        let name = |i: usize| self.columns[i].quantity.name.as_str();
        let outputs = || (0..self.columns.len()).filter(|i| Some(*i) != self.axis);
        let of_columns = self.columns.iter().find(|c| c.values.iter().any(|v| !self.explains(&c.quantity.name, *v)));
        let of_events = || {
            let sides = self.events.iter().flat_map(|e| &e.outputs);
            sides.flat_map(|side| outputs().zip(side)).find(|(i, v)| !self.explains(name(*i), **v)).map(|(i, _)| name(i))
        };
        let of_extremes = || {
            let wrong = |e: &&Extreme| [e.min, e.max, e.t_min, e.t_max].iter().any(|v| !v.is_finite());
            self.extremes.iter().find(wrong).map(|e| name(e.column))
        };
        let of_counters = || self.counters.iter().find(|c| !c.value.is_finite()).map(|c| c.key);
        of_columns.map(|c| c.quantity.name.as_str()).or_else(of_events).or_else(of_extremes).or_else(of_counters)
    }
    /// Extremes of the column with a name.
    pub fn extreme(&self, name: &str) -> Option<&Extreme> {
        self.extremes.iter().find(|e| self.columns.get(e.column).is_some_and(|c| c.quantity.name == name))
    }
    /// Integral, mean and last value of the column with a name.
    pub fn overall(&self, name: &str) -> Option<&Overall> {
        self.overall.iter().find(|e| self.columns.get(e.column).is_some_and(|c| c.quantity.name == name))
    }
    /// Audit with a key.
    pub fn audit(&self, key: &str) -> Option<&Audit> {
        self.audits.iter().find(|a| a.key == key)
    }
}
