//! Motions of the machine itself beside the averaged theory: the mean speed that each settles to.

use crate::failure::in_words;
use crate::machine::Machine;
use crate::repeat::{Asks, At, Repeated, number, one};
use crate::simulate;
use crate::watch::Watch;
use mechanics::asked::{Asked, Value};
use symbolic::equations::Role;
use words::{Notice, Text};

/// Share of a motion over which its mean speed is taken: its last fifth.
const LAST: f64 = 0.2;
/// Motions over a parameter, each from the start of the file.
const MOTIONS: usize = 13;
/// Motions over a parameter one way, each from the end of the one before: the steps of a slow run.
const STEPS: usize = 25;

/// Where a motion begins.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Way {
    /// At the start of the file.
    Start,
    /// Where the one at the value before ended, from the first value to the last.
    Up,
    /// The same from the last value back.
    Down,
}

impl Way {
    pub(super) const ALL: [Way; 3] = [Way::Start, Way::Up, Way::Down];

    /// Name of its column and its word in JSON.
    pub(super) fn names(self) -> (&'static str, &'static str) {
        match self {
            Way::Start => ("motion", "start"),
            Way::Up => ("motion_forth", "forth"),
            Way::Down => ("motion_back", "back"),
        }
    }

    /// What it is, in words.
    pub(super) fn label(self) -> Text {
        match self {
            Way::Start => Text::new("mean speed of the motion itself", "средняя скорость самого движения"),
            Way::Up => Text::new("motion itself, slow run forth", "само движение, медленный проход вперёд"),
            Way::Down => Text::new("motion itself, slow run back", "само движение, медленный проход назад"),
        }
    }
}

/// A motion over the parameter: its mean speed at its end.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Ran {
    pub(super) value: f64,
    pub(super) speed: f64,
    pub(super) way: Way,
}

/// Motions of a machine.
pub(super) struct Motions {
    at: At,
    repeated: Repeated,
    /// Coordinates and rates, noted behind the mean speed.
    state: Vec<String>,
}

impl Motions {
    /// Over a time from the start of the file.
    pub(super) fn new(machine: &Machine, angle: &str, until: f64) -> Result<Motions, Notice> {
        Motions::noting(machine, (angle, until), Vec::new())
    }

    /// The same with the state at the end.
    fn with_ends(machine: &Machine, angle: &str, until: f64) -> Result<Motions, Notice> {
        // coordinates first, as a state has them
        let of = |role: Role| machine.equations.outputs.iter().filter(move |o| o.role == role).map(|o| o.name.clone());
        Motions::noting(machine, (angle, until), of(Role::Coordinate).chain(of(Role::Rate)).collect())
    }

    fn noting(machine: &Machine, (angle, until): (&str, f64), state: Vec<String>) -> Result<Motions, Notice> {
        let mut inner = Asked::new(simulate::KIND.name);
        inner.set("until", Value::Number(until));
        let mut observe = vec![format!("mean({angle}', {} s, {until} s)", (1.0 - LAST) * until)];
        observe.extend(state.iter().map(|name| format!("last({name})")));
        // a motion of the file that ends earlier would be another one
        let mut plain = machine.clone();
        plain.model.studies.clear();
        let repeated = Repeated::new(&plain, Asks { observe: &observe, of: None, inner: &inner })?;
        Ok(Motions { at: At::of(&plain), repeated, state })
    }

    /// The mean speed at the end, with other values.
    pub(super) fn speed(&mut self, values: &[(String, f64)], watch: &Watch) -> Result<f64, Notice> {
        Ok(self.run(values, watch)?.0)
    }

    /// The same, and the state at the end.
    fn run(&mut self, values: &[(String, f64)], watch: &Watch) -> Result<(f64, Vec<(String, f64)>), Notice> {
        let mut inner = Watch { interrupt: watch.interrupt, ..Watch::default() };
        let found = one(&mut self.at, &self.repeated, values, &mut inner)?;
        let noted = |k: usize| number(&found, &self.repeated.noted[k].1).map(|(value, _)| value);
        let ends = self.state.iter().enumerate().map(|(k, name)| Ok((name.clone(), noted(k + 1)?)));
        Ok((noted(0)?, ends.collect::<Result<_, Notice>>()?))
    }
}

/// What is run over a parameter.
pub(super) struct Runs<'a> {
    /// The parameter.
    pub(super) name: &'a str,
    /// The fast angle.
    pub(super) angle: &'a str,
    /// First and last value.
    pub(super) ends: [f64; 2],
    /// How long each motion takes, s.
    pub(super) until: f64,
}

impl Runs<'_> {
    fn values(&self, count: usize) -> impl DoubleEndedIterator<Item = f64> + use<> {
        let [from, to] = self.ends;
        (0..count).map(move |k| if k + 1 == count { to } else { from + (to - from) * k as f64 / (count - 1) as f64 })
    }

    /// Mean speeds of motions from the start of the file, at equally spaced values.
    pub(super) fn motions_from_start(&self, machine: &Machine, watch: &Watch) -> Result<Vec<Ran>, Notice> {
        let mut motions = Motions::new(machine, self.angle, self.until)?;
        let mut all = Vec::with_capacity(MOTIONS);
        for value in self.values(MOTIONS) {
            if watch.is_interrupted() {
                break;
            }
            all.push(Ran { value, speed: motions.speed(&[(self.name.to_owned(), value)], watch)?, way: Way::Start });
        }
        Ok(all)
    }

    /// Mean speeds of a slow run by steps to the last value and back: each motion begins where the one before ended.
    pub(super) fn forth_and_back(&self, machine: &Machine, watch: &Watch) -> Result<Vec<Ran>, Notice> {
        let mut motions = Motions::with_ends(machine, self.angle, self.until)?;
        // the first motion begins at the start of the file, told as numbers like all others
        let mut first = machine.clone();
        first.bind(&[(self.name, self.ends[0])]).map_err(in_words)?;
        let start = first.system.start().map_err(|fault| crate::machine::explained(fault, &first.equations))?;
        let mut state: Vec<(String, f64)> = motions.state.iter().cloned().zip(start).collect();
        let mut all = Vec::with_capacity(2 * STEPS);
        let forth = self.values(STEPS).map(|value| (value, Way::Up));
        for (value, way) in forth.chain(self.values(STEPS).rev().map(|value| (value, Way::Down))) {
            if watch.is_interrupted() {
                break;
            }
            let mut values = vec![(self.name.to_owned(), value)];
            values.append(&mut state);
            let (speed, ends) = motions.run(&values, watch)?;
            all.push(Ran { value, speed, way });
            state = ends;
        }
        Ok(all)
    }
}
